#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "render/colormap_tables.h"
#include "render/types.h"

namespace lagomorph::render {

/// Colours for numbers in [0, 1].
struct Colormap {
  const char* name;
  const ColorTable* table;  // nullptr: from black to white in even steps of sRGB
  bool diverging;           // its middle is a value of its own, such as 0 or 1
};

/// viridis, magma, plasma, inferno, cividis, coolwarm, gray.
std::vector<std::string> colormap_names();
/// Throws SettingsError that lists the names for one that is none.
const Colormap& find_colormap(std::string_view name);

/// sRGB in [0, 1], linear between the table's steps; within 0.5 / 255 of the published map. Values are
/// clamped, NaN is 0.
std::array<float, 3> srgb_of(const Colormap&, float value);
/// The same as linear light.
Color color_of(const Colormap&, float value);

}  // namespace lagomorph::render
