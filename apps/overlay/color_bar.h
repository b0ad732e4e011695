#pragma once

#include <string>
#include <vector>

#include "apps/overlay/layout.h"
#include "apps/overlay/overlay.h"
#include "render/color.h"
#include "render/colormap.h"

namespace lagomorph::apps {

/// A value that stands for something with a name.
struct Category {
  std::string name;
  double value;
};

/// What colours of a field mean.
struct ColorBar {
  std::string title;  // ASCII
  std::string unit;   // "" for a pure number
  const render::Colormap* map;
  double low = 0.0, high = 1.0;       // shown in the map's first and last colour; low < high
  bool given = false;                 // the range, so that values may lie beyond it: room is kept to tell it
  bool below = false, above = false;  // whether some drawn ones do; only of a given range
  /// All values that there are, where none lie between: their colours and names take the bar's place where
  /// all have room.
  std::vector<Category> categories = {};
};

struct BarLabel {
  double value;  // in low .. high
  std::string text;
};
/// What is written beside a bar: round numbers, in a unit with a prefix that makes them short. The ends
/// instead, where fewer than two are in the range; an end beyond which values lie is always there, after a
/// sign.
struct BarLabels {
  std::string title;  // with the unit
  std::vector<BarLabel> ticks;
};
/// Some `steps` or fewer apart, and at least `apart` of the bar from each other.
BarLabels labels_of(const ColorBar&, int steps = 8, double apart = 0.07);
/// Those of a bar in a picture or panel of a size: as many as its height has room for.
BarLabels labels_in(int width, int height, const ColorBar&);

/// Takes room for the plates of bars at the right edge, each left of the one before where there is some; of
/// as many of them as have room.
std::vector<Rectangle> place_color_bars(OverlayLayout&, const std::vector<ColorBar>&);
/// Draws the bars on their plates.
void draw_color_bars(render::Picture&, const std::vector<ColorBar>&, const std::vector<Rectangle>& plates);

/// The part of a picture's width, from its right edge, in which the bars stand. In [0, 1].
double color_bar_strip(int width, int height, const std::vector<ColorBar>&);

}  // namespace lagomorph::apps
