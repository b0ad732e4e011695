#include "apps/plot/drawing.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "apps/overlay/stroke_font.h"
#include "apps/page/html.h"

namespace lagomorph::apps {
namespace {

constexpr double capitals = 0.72;  // height of capitals over the size of a common sans-serif font

std::string hex(const Color& c) { return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]); }

bool joins(const Segment& s, const Segment& next) { return s.b.x == next.a.x && s.b.y == next.a.y; }

std::string svg_of(const Stroke& stroke) {
  std::string path;
  for (std::size_t i = 0; i < stroke.segments.size(); ++i) {
    const Segment& s = stroke.segments[i];
    if (i == 0 || !joins(stroke.segments[i - 1], s)) path += fmt::format("M{:.2f} {:.2f}", s.a.x, s.a.y);
    path += fmt::format("L{:.2f} {:.2f}", s.b.x, s.b.y);
  }
  return fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"{:g}\"/>\n", path, hex(stroke.color),
                     stroke.width);
}

std::string svg_of(const Words& words) {
  constexpr const char* anchors[] = {"start", "middle", "end"};
  return fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.1f}\" fill=\"{}\" text-anchor=\"{}\"{}>{}</text>\n",
      words.at.x, words.at.y, words.height / capitals, hex(words.color),
      anchors[static_cast<int>(words.anchor)], words.bold ? " font-weight=\"bold\"" : "",
      html_text(words.text));
}

void draw(render::Picture& picture, const Stroke& stroke) {
  draw_strokes(picture, stroke.segments, stroke.width, stroke.color);
}

void draw(render::Picture& picture, const Words& words) {
  const double shift = words.anchor == Anchor::start ? 0.0 : words.anchor == Anchor::middle ? 0.5 : 1.0;
  const double x = words.at.x - shift * text_width(words.text, words.height);
  draw_text(picture, x, words.at.y, words.text,
            {.height = words.height, .color = words.color, .bold = words.bold});
}

Point between(const Segment& s, double along) {
  return {s.a.x + along * (s.b.x - s.a.x), s.a.y + along * (s.b.y - s.a.y)};
}

}  // namespace

std::string svg_text(const Drawing& drawing) {
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"Helvetica, Arial, sans-serif\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n"
      "<g stroke-linecap=\"round\" stroke-linejoin=\"round\" fill=\"none\">\n",
      drawing.width, drawing.height);
  for (const auto& shape : drawing.shapes) text += std::visit([](const auto& s) { return svg_of(s); }, shape);
  return text + "</g>\n</svg>\n";
}

render::Picture picture_of(const Drawing& drawing) {
  render::Picture picture{drawing.width, drawing.height, {}};
  picture.rgb.assign(3 * static_cast<std::size_t>(drawing.width) * static_cast<std::size_t>(drawing.height),
                     255);
  for (const auto& shape : drawing.shapes) std::visit([&](const auto& s) { draw(picture, s); }, shape);
  return picture;
}

std::vector<Segment> dashed(const std::vector<Segment>& line, double on, double off) {
  std::vector<Segment> all;
  double phase = 0;  // along the pattern [pixels]
  for (const Segment& s : line) {
    const double length = std::hypot(s.b.x - s.a.x, s.b.y - s.a.y);
    for (double at = 0; at < length;) {
      const bool drawn = phase < on;
      const double step = std::min(length - at, (drawn ? on : on + off) - phase);
      if (drawn) all.push_back({between(s, at / length), between(s, (at + step) / length)});
      at += step, phase += step;
      if (phase >= on + off - 1e-9) phase = 0;
      if (step <= 0) phase = drawn ? on : 0;  // rounding
    }
  }
  return all;
}

}  // namespace lagomorph::apps
