#include "apps/overlay/stroke_font.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "apps/overlay/glyphs.h"
#include "apps/overlay/strokes.h"

namespace lagomorph::apps {
namespace {

constexpr double cap_units = 12.0;  // of the glyphs' grid, from the baseline to the top of capitals
constexpr double letter_space = 3.4;
constexpr double word_space = 4.0;
constexpr double pen = 0.135;  // width of a stroke over the height of capitals

constexpr unsigned first_accent = 0x300, last_accent = 0x36F;  // that go with the letter before
constexpr unsigned no_break_space = 0xA0;

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

std::string_view ascii_glyph(char c) {
  const auto code = static_cast<unsigned char>(c);
  return code >= 0x20 && code < 0x20 + glyphs.size() ? glyphs[code - 0x20U] : box_glyph;
}

/// Calls with the glyphs that stand for the characters of a text, one after another.
template <class Take>
void for_each_glyph(std::string_view text, Take take) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (continues_character(text[i])) continue;
    const std::string_view rest = text.substr(i);
    const auto first = static_cast<unsigned char>(rest[0]);
    if (first < 0x80U) {
      take(ascii_glyph(rest[0]));
      continue;
    }
    const auto sign = std::find_if(signs.begin(), signs.end(),
                                   [&](const Sign& s) { return rest.starts_with(s.character); });
    if (sign != signs.end()) {
      take(sign->glyph);
      continue;
    }
    unsigned code = 0;
    if (first >= 0xC2U && first < 0xE0U && rest.size() > 1 && continues_character(rest[1]))
      code = (first & 0x1FU) << 6U | (static_cast<unsigned char>(rest[1]) & 0x3FU);
    if (code >= first_accent && code <= last_accent) continue;
    if (code == no_break_space) {
      take(ascii_glyph(' '));
    } else if (code >= 0xC0U && code < 0xC0U + base_letters.size() && !base_letters[code - 0xC0U].empty()) {
      for (const char c : base_letters[code - 0xC0U]) take(ascii_glyph(c));
    } else {
      take(box_glyph);
    }
  }
}

double advance(std::string_view glyph) {
  if (glyph.empty()) return word_space + letter_space;
  double most = 0;
  for (const char c : glyph) {
    if (c >= '0' && c <= '9') most = std::max(most, static_cast<double>(c - '0'));
  }
  return most + letter_space;
}

/// A glyph's segments in pixels, its left edge at x, its baseline at y.
std::vector<Segment> segments_of(std::string_view glyph, double x, double y, double unit) {
  std::vector<Segment> segments;
  std::vector<Point> stroke;
  for (std::size_t i = 0; i + 1 < glyph.size();) {
    if (glyph[i] == ' ') {
      stroke.clear();
      ++i;
      continue;
    }
    stroke.push_back({x + unit * (glyph[i] - '0'), y - unit * (glyph[i + 1] - 'e')});
    if (stroke.size() > 1) segments.push_back({stroke[stroke.size() - 2], stroke.back()});
    i += 2;
  }
  return segments;
}

}  // namespace

double text_width(std::string_view text, double height) {
  double units = 0;
  for_each_glyph(text, [&](std::string_view glyph) { units += advance(glyph); });
  return std::max(0.0, units - letter_space) * height / cap_units;
}

void draw_text(render::Picture& picture, double x, double y, std::string_view text, const TextStyle& style) {
  const double unit = style.height / cap_units,
               width = std::max(1.0, (style.bold ? 1.5 : 1.0) * pen * style.height);
  for_each_glyph(text, [&](std::string_view glyph) {
    draw_strokes(picture, segments_of(glyph, x, y, unit), width, style.color);
    x += unit * advance(glyph);
  });
}

std::string fitting_text(std::string_view text, double height, double width) {
  if (text_width(text, height) <= width) return std::string(text);
  std::string shorter(text);
  while (!shorter.empty() && text_width(shorter + "...", height) > width) shorter.pop_back();
  while (!shorter.empty() && continues_character(text[shorter.size()])) shorter.pop_back();  // none in half
  return shorter + "...";
}

}  // namespace lagomorph::apps
