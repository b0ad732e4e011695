#pragma once

#include <string>
#include <vector>

#include "render/color.h"
#include "render/colormap.h"

namespace lagomorph::apps {

/// What colours of a field mean.
struct ColorBar {
  std::string title;  // ASCII
  std::string unit;   // "" for a pure number
  const render::Colormap* map;
  double low = 0.0, high = 1.0;  // shown in the map's first and last colour; low < high
};

struct BarLabel {
  double value;  // in low .. high
  std::string text;
};
/// What is written beside a bar: round numbers, in a unit with a prefix that makes them short.
struct BarLabels {
  std::string title;  // with the unit
  std::vector<BarLabel> ticks;
};
/// Some `steps` or fewer apart.
BarLabels labels_of(const ColorBar&, int steps = 8);

/// Draws the bars at the right edge of the picture, each left of the one before; nothing in a picture that is
/// too small for them. How far from that edge the bars and the gap beside them reach [pixels].
double draw_color_bars(render::Picture&, const std::vector<ColorBar>&);

}  // namespace lagomorph::apps
