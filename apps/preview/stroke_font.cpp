#include "apps/preview/stroke_font.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/preview/glyphs.h"

namespace lagomorph::apps {
namespace {

constexpr double cap_units = 12.0;  // of the glyphs' grid, from the baseline to the top of capitals
constexpr double letter_space = 3.4;
constexpr double word_space = 4.0;
constexpr double pen = 0.135;  // width of a stroke over the height of capitals

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

std::string_view glyph_of(char c) {
  const auto code = static_cast<unsigned char>(c);
  return code >= 0x20 && code < 0x20 + glyphs.size() ? glyphs[code - 0x20U] : box_glyph;
}

double advance(std::string_view glyph) {
  if (glyph.empty()) return word_space + letter_space;
  double most = 0;
  for (const char c : glyph) {
    if (c >= '0' && c <= '9') most = std::max(most, static_cast<double>(c - '0'));
  }
  return most + letter_space;
}

struct Point {
  double x = 0, y = 0;
};

/// Distance of a point to the segment a b.
double distance(Point p, Point a, Point b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double length2 = dx * dx + dy * dy;
  const double along =
      length2 > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - along * dx, p.y - a.y - along * dy);
}

struct Segment {
  Point a, b;
};

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

void draw(render::Picture& picture, const std::vector<Segment>& segments, const TextStyle& style) {
  const double radius = std::max(0.5, 0.5 * pen * style.height);
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  for (const Segment& s : segments) {
    left = std::min({left, s.a.x, s.b.x}), right = std::max({right, s.a.x, s.b.x});
    top = std::min({top, s.a.y, s.b.y}), bottom = std::max({bottom, s.a.y, s.b.y});
  }
  const int x0 = std::max(0, static_cast<int>(left - radius - 1)),
            x1 = std::min(picture.width - 1, static_cast<int>(right + radius + 1)),
            y0 = std::max(0, static_cast<int>(top - radius - 1)),
            y1 = std::min(picture.height - 1, static_cast<int>(bottom + radius + 1));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      double nearest = 1e9;
      for (const Segment& s : segments) nearest = std::min(nearest, distance({x + 0.5, y + 0.5}, s.a, s.b));
      const double cover = std::clamp(radius + 0.5 - nearest, 0.0, 1.0);
      if (cover == 0) continue;
      const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                  static_cast<std::size_t>(x));
      for (std::size_t c = 0; c < 3; ++c) {
        std::uint8_t& value = picture.rgb[at + c];
        value = static_cast<std::uint8_t>(std::lround(value + cover * (style.color[c] - value)));
      }
    }
  }
}

}  // namespace

double text_width(std::string_view text, double height) {
  double units = 0;
  for (const char c : text) {
    if (!continues_character(c)) units += advance(glyph_of(c));
  }
  return std::max(0.0, units - letter_space) * height / cap_units;
}

void draw_text(render::Picture& picture, double x, double y, std::string_view text, const TextStyle& style) {
  const double unit = style.height / cap_units;
  for (const char c : text) {
    if (continues_character(c)) continue;
    const std::vector<Segment> segments = segments_of(glyph_of(c), x, y, unit);
    if (!segments.empty()) draw(picture, segments, style);
    x += unit * advance(glyph_of(c));
  }
}

std::string fitting_text(std::string_view text, double height, double width) {
  if (text_width(text, height) <= width) return std::string(text);
  std::string shorter(text);
  while (!shorter.empty() && text_width(shorter + "...", height) > width) shorter.pop_back();
  while (!shorter.empty() && continues_character(text[shorter.size()])) shorter.pop_back();  // none in half
  return shorter + "...";
}

}  // namespace lagomorph::apps
