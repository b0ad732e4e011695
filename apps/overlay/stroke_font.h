#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "render/color.h"

namespace lagomorph::apps {

/// How a text is written: the height of its capitals [pixels], its colour (sRGB).
struct TextStyle {
  double height = 12.0;
  std::array<std::uint8_t, 3> color = {255, 255, 255};
  bool bold = false;
};

/// Width of a text [pixels]. ASCII has letters, and so have ≤ ≥ ° · × ± µ ε λ ν π ρ σ; accented Latin letters
/// are written without their accents, ligatures as two letters; any other character of UTF-8 is an empty box.
double text_width(std::string_view text, double height);

/// Writes a text into a picture, its first letter's left edge at x, its baseline at y; what lies outside is
/// cut off. Its lines are smoothed, and the same everywhere.
void draw_text(render::Picture&, double x, double y, std::string_view text, const TextStyle&);

/// The text, or as much of its beginning as fits into `width` with three dots after it.
std::string fitting_text(std::string_view text, double height, double width);

}  // namespace lagomorph::apps
