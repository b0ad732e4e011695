#pragma once

#include <string>
#include <variant>
#include <vector>

#include "apps/overlay/strokes.h"

namespace lagomorph::apps {

/// Segments of one stroke: lines with round ends; of no length, dots. Sizes in pixels.
struct Stroke {
  std::vector<Segment> segments;
  double width = 1.0;
  Color color = {0, 0, 0};
};

enum class Anchor { start, middle, end };

/// A line of ASCII text, its baseline at `at`.
struct Words {
  Point at;
  std::string text;
  double height = 12.0;  // of capitals [pixels]
  Color color = {0, 0, 0};
  Anchor anchor = Anchor::start;
  bool bold = false;
};

/// What is drawn, in its order, on a white background. Sizes in pixels.
struct Drawing {
  int width = 0;
  int height = 0;
  std::vector<std::variant<Stroke, Words>> shapes;
};

/// A file of its own, with text as text.
std::string svg_text(const Drawing&);
/// The same pixels on every machine.
render::Picture picture_of(const Drawing&);

/// The polyline with gaps after every `off` pixels of `on` drawn.
std::vector<Segment> dashed(const std::vector<Segment>&, double on, double off);

}  // namespace lagomorph::apps
