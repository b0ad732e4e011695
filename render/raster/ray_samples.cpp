#include "render/raster/ray_samples.h"

#include <algorithm>
#include <array>
#include <bit>

#include "render/path/dielectric.h"

namespace lagomorph::render::raster {
namespace {

constexpr float alike = 0.1F;  // luminance, up to which a pixel's first samples are

}  // namespace

RaySamples::RaySamples(std::size_t pixels, int first)
    : first_(first), lights_(pixels * most, Color::Zero()), met_(pixels, 0), counts_(pixels, first) {}

Vec2 RaySamples::place(int k) {
  static constexpr std::array<std::array<float, 2>, 4> rotated = {
      {{0.375F, 0.875F}, {0.875F, 0.625F}, {0.125F, 0.375F}, {0.625F, 0.125F}}};
  const auto& coarse = rotated[static_cast<std::size_t>(k % 4)];
  if (k < fewest) return {coarse[0], coarse[1]};
  const auto& fine = rotated[static_cast<std::size_t>(k / 4 % 4)];
  return {coarse[0] + 0.25F * (fine[0] - 0.5F), coarse[1] + 0.25F * (fine[1] - 0.5F)};
}

void RaySamples::want_more() {
  for (std::size_t k = 0; k < counts_.size(); ++k) {
    float least = 1.0F, brightest = 0.0F;
    for (std::size_t s = 0; s < static_cast<std::size_t>(first_); ++s) {
      if ((met_[k] >> s & 1U) == 0) continue;
      const float seen = std::clamp(path::luminance(path::f3(lights_[k * most + s])), 0.0F, 1.0F);
      least = std::min(least, seen), brightest = std::max(brightest, seen);
    }
    if (brightest - least > alike) counts_[k] = most;
  }
}

Color RaySamples::mean(std::size_t pixel, bool evenly) const {
  const std::uint32_t met = met_[pixel];
  if (met == 0) return Color::Zero();
  Color sum = Color::Zero();
  float weights = 0.0F;
  for (std::size_t s = 0; s < static_cast<std::size_t>(counts_[pixel]); ++s) {
    if ((met >> s & 1U) == 0) continue;
    const Color& light = lights_[pixel * most + s];
    const float weight = evenly ? 1.0F : 1.0F / std::max(light.maxCoeff(), 1.0F);
    sum += weight * light;
    weights += weight;
  }
  const auto of_opengl = static_cast<float>(std::popcount(met & ((1U << fewest) - 1U)));
  return of_opengl / (fewest * weights) * sum;
}

}  // namespace lagomorph::render::raster
