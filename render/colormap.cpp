#include "render/colormap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/color.h"
#include "render/error.h"

namespace lagomorph::render {
namespace {

/// The explicit table: a new colour map is one row.
constexpr Colormap maps[] = {{"viridis", &viridis_table, false},
                             {"magma", &magma_table, false},
                             {"plasma", &plasma_table, false},
                             {"inferno", &inferno_table, false},
                             {"cividis", &cividis_table, false},
                             {"coolwarm", &coolwarm_table, true},
                             {"gray", nullptr, false}};

}  // namespace

std::vector<std::string> colormap_names() {
  std::vector<std::string> names;
  for (const Colormap& map : maps) names.emplace_back(map.name);
  return names;
}

const Colormap& find_colormap(std::string_view name) {
  std::string names;
  for (const Colormap& map : maps) {
    if (name == map.name) return map;
    names += (names.empty() ? "" : ", ") + std::string(map.name);
  }
  throw SettingsError("unknown colormap '" + std::string(name) + "'; known are " + names);
}

std::array<float, 3> srgb_of(const Colormap& map, float value) {
  const float x = std::isnan(value) ? 0.0F : std::clamp(value, 0.0F, 1.0F);
  if (map.table == nullptr) return {x, x, x};
  const float place = x * static_cast<float>(map.table->size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), map.table->size() - 2);
  const float along = place - static_cast<float>(below);
  std::array<float, 3> rgb{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto byte = [&](std::size_t i) {
      return static_cast<float>(((*map.table)[i] >> (16 - 8 * c)) & 0xFFU);
    };
    rgb[c] = (byte(below) + along * (byte(below + 1) - byte(below))) / 255.0F;
  }
  return rgb;
}

Color color_of(const Colormap& map, float value) {
  const std::array<float, 3> rgb = srgb_of(map, value);
  return {linear_from_srgb(rgb[0]), linear_from_srgb(rgb[1]), linear_from_srgb(rgb[2])};
}

}  // namespace lagomorph::render
