#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/plot/drawing.h"

namespace lagomorph::apps {

/// What an axis shows, and how. Without limits it spans the values, with round numbers at its ends.
struct Axis {
  std::string label;      // "time"
  std::string unit = {};  // "s"; empty: a pure number
  bool log = false;       // decades; values <= 0 are left out
  bool whole = false;     // of integers: no ticks between them
  std::optional<double> low = {}, high = {};
};

/// A line through points, or dots at them, with its name beside its end.
struct Curve {
  std::string name;
  std::vector<double> x, y;  // of one size; where either is not finite the line is broken
  bool dots = false;         // for measured or reference values over lines
};

/// A diagram of curves over one pair of axes.
struct Figure {
  std::string title;
  Axis x, y;
  std::vector<Curve> curves;
};

/// The figure on a light background, in colours that colour-blind people tell apart; beyond these, dashed.
/// Curves are named at their ends; one alone by the title. ASCII text.
Drawing draw_figure(const Figure&, int width = 1200, int height = 800);

/// All figures on one sheet, in two columns.
Drawing draw_overview(const std::vector<Figure>&, int width = 1800);

}  // namespace lagomorph::apps
