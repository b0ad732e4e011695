#include "apps/check/mask.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <type_traits>

#include <fmt/format.h>

#include "apps/check/light_statistics.h"
#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/npy.h"
#include "render/channels.h"
#include "render/png_read.h"

namespace lagomorph::apps {
namespace {

/// Whether a pixel of a mask's picture is brighter than half.
bool is_bright(const render::Pixels& picture, std::size_t pixel) {
  return std::visit(
      [&](const auto& samples) {
        using Sample = typename std::decay_t<decltype(samples)>::value_type;
        constexpr std::uint32_t half = std::numeric_limits<Sample>::max() / 2;
        const std::size_t at = pixel * static_cast<std::size_t>(picture.samples_per_pixel());
        return samples[at] > half || samples[at + 1] > half || samples[at + 2] > half;
      },
      picture.samples);
}

void add(std::vector<std::uint8_t>& mask, int width, const render::Tile& r) {
  for (int y = r.y; y < r.y + r.height; ++y) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(y) * width + r.x;
    std::fill_n(mask.begin() + first, r.width, std::uint8_t{1});
  }
}

/// The pixels of a body, of which a golden without the channel, or with another one, tells nothing.
void add_body(std::vector<std::uint8_t>& mask, const std::filesystem::path& golden, int width, int height,
              const MaskRule& rule, std::vector<CheckFailure>& failures) {
  const std::filesystem::path file = channel_beside(golden, render::body_id_channel);
  try {
    const NpyFloats ids = read_npy_floats(read_file(file), file.string());
    const std::size_t shape[] = {static_cast<std::size_t>(height), static_cast<std::size_t>(width)};
    if (!std::equal(ids.shape.begin(), ids.shape.end(), std::begin(shape), std::end(shape))) {
      failures.push_back({"mask",
                          fmt::format("{} has the shape {}, the picture is {}x{}", file.string(),
                                      shape_text(ids.shape), width, height),
                          "", rule.from});
      return;
    }
    const auto id = static_cast<float>(*rule.body_id);
    for (std::size_t i = 0; i < mask.size(); ++i) {
      if (ids.values[i] == id) mask[i] = 1;
    }
  } catch (const Error& error) {
    if (error.status != ExitStatus::wrong_input) throw;
    failures.push_back(
        {"mask",
         fmt::format("{}; approve takes it from a run with render.channels = [\"body_id\"]", error.what()),
         "", rule.from});
  }
}

/// The part of a rectangle that lies in the picture.
render::Tile clipped(const render::Tile& r, int width, int height) {
  const int x = std::min(r.x, width), y = std::min(r.y, height);
  return {x, y, std::min(r.width, width - x), std::min(r.height, height - y)};
}

}  // namespace

Masks::Masks(std::span<const MaskRule> rules) : rules_(rules) {
  for (const MaskRule& rule : rules) {
    if (rule.png.empty() || rule.body_id || pictures_.contains(rule.png)) continue;
    pictures_[rule.png] = render::read_png(read_file(rule.png), rule.png.string());
  }
}

std::vector<std::uint8_t> Masks::of(int frame, const std::filesystem::path& golden, int width, int height,
                                    std::vector<CheckFailure>& failures) const {
  std::vector<std::uint8_t> mask;
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (const MaskRule& rule : rules_) {
    if (!rule.applies_to(frame)) continue;
    mask.resize(count);
    if (rule.body_id) {
      add_body(mask, golden, width, height, rule, failures);
      continue;
    }
    if (rule.png.empty()) {
      add(mask, width, clipped(rule.rectangle, width, height));
      continue;
    }
    const render::Pixels& picture = pictures_.at(rule.png);
    if (picture.width != width || picture.height != height) {
      failures.push_back({"mask",
                          fmt::format("{} is {}x{}, the picture {}x{}", rule.png.filename().string(),
                                      picture.width, picture.height, width, height),
                          "", rule.from});
      continue;
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (is_bright(picture, i)) mask[i] = 1;
    }
  }
  if (!mask.empty() && masked_share(mask) == 1.0)
    failures.push_back({"mask", "leaves nothing to compare", "", ""});
  return mask;
}

void cover(const std::vector<std::uint8_t>& mask, const render::Pixels& golden, render::Pixels& fresh) {
  const auto step = static_cast<std::size_t>(golden.samples_per_pixel());
  std::visit(
      [&](auto& samples) {
        const auto& from = std::get<std::decay_t<decltype(samples)>>(golden.samples);
        for (std::size_t i = 0; i < mask.size(); ++i) {
          if (mask[i] != 0)
            std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(i * step), step,
                        samples.begin() + static_cast<std::ptrdiff_t>(i * step));
        }
      },
      fresh.samples);
}

double masked_share(const std::vector<std::uint8_t>& mask) {
  if (mask.empty()) return 0;
  return static_cast<double>(std::count(mask.begin(), mask.end(), 1)) / static_cast<double>(mask.size());
}

}  // namespace lagomorph::apps
