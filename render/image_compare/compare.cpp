#include "render/image_compare/compare.h"

#include <algorithm>
#include <string>

#include "render/error.h"
#include "render/image_compare/flip.h"
#include "render/image_compare/linear_pair.h"
#include "render/image_compare/ssim.h"

namespace lagomorph::render {
namespace {

AlphaFigures alpha_figures(const Pixels& a, const Pixels& b) {
  const ErrorMap map = alpha_map(a, b);
  return {mean(map), range(map).most, largest_tile_mean(map)};
}

Comparison compare_alike(const Pixels& a, const Pixels& b, double pixels_per_degree) {
  Comparison result;
  Figures& figures = result.figures;
  figures = figures_of_equals(a.width, a.height, a.alpha || b.alpha);
  if (figures.alpha) figures.alpha = alpha_figures(a, b);
  figures.differences = color_differences(a, b);
  figures.equal = figures.differences.most == 0;
  if (figures.equal) return result;
  result.flip = flip_map(*linear_pair(a, b), pixels_per_degree);
  figures.flip_mean = mean(result.flip);
  figures.flip_quartiles = weighted_quartiles(result.flip);
  const Range values = range(result.flip);
  figures.flip_min = values.least;
  figures.flip_max = values.most;
  figures.flip_tile = largest_tile_mean(result.flip);
  figures.ssim = ssim(a, b);
  return result;
}

}  // namespace

Figures figures_of_equals(int width, int height, bool alpha) {
  Figures figures;
  figures.flip_tile.tile = {0, 0, std::min(tile_size, width), std::min(tile_size, height)};
  figures.differences.samples = 3 * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (std::min(width, height) < ssim_window) figures.ssim = std::nullopt;
  if (alpha) figures.alpha = AlphaFigures{0, 0, figures.flip_tile};
  return figures;
}

Comparison compare_pictures(const Pixels& a, const Pixels& b, double pixels_per_degree) {
  check_pixels_per_degree(pixels_per_degree);
  if (a.width != b.width || a.height != b.height) {
    const auto size = [](const Pixels& p) {
      return std::to_string(p.width) + "x" + std::to_string(p.height);
    };
    throw SettingsError("pictures of " + size(a) + " and " + size(b) + " pixels cannot be compared");
  }
  if (a.bit_depth() == b.bit_depth()) return compare_alike(a, b, pixels_per_degree);
  return compare_alike(widened(a), widened(b), pixels_per_degree);
}

}  // namespace lagomorph::render
