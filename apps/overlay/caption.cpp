#include "apps/overlay/caption.h"

#include <algorithm>

#include <fmt/args.h>
#include <fmt/format.h>

#include "apps/error.h"
#include "apps/overlay/overlay.h"
#include "apps/overlay/stroke_font.h"

namespace lagomorph::apps {
namespace {

constexpr double line_height = 1.9;  // of capitals

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines(1);
  for (const char c : text) {
    if (c == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += c;
    }
  }
  return lines;
}

/// Of the widest line, were all its digits the widest one.
double steady_width(std::vector<std::string> lines, double height) {
  double width = 0.0;
  for (std::string& line : lines) {
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c >= '0' && c <= '9'; }, '0');
    width = std::max(width, text_width(line, height));
  }
  return width;
}

}  // namespace

std::string caption_text(const std::string& form, const CaptionValues& v) {
  fmt::dynamic_format_arg_store<fmt::format_context> values;
  values.push_back(fmt::arg("name", v.name));
  values.push_back(fmt::arg("frame", v.frame));
  values.push_back(fmt::arg("frames", v.frames));
  values.push_back(fmt::arg("time", v.time));
  values.push_back(fmt::arg("kinetic", v.kinetic));
  values.push_back(fmt::arg("elastic", v.elastic));
  values.push_back(fmt::arg("gravitational", v.gravitational));
  values.push_back(fmt::arg("total", v.total));
  values.push_back(fmt::arg("iterations", v.iterations));
  values.push_back(fmt::arg("min_J", v.min_J));
  try {
    return fmt::vformat(form, values);
  } catch (const fmt::format_error& e) {
    throw Error(ExitStatus::wrong_input,
                fmt::format("{} in '{}'; values are {{name}}, {{frame}}, {{frames}}, {{time}}, {{kinetic}}, "
                            "{{elastic}}, {{gravitational}}, {{total}}, {{iterations}} and {{min_J}}",
                            e.what(), form));
  }
}

std::vector<std::string> caption_places() {
  return {"top_left", "top", "top_right", "bottom_left", "bottom", "bottom_right"};
}

std::optional<Rectangle> place_caption(OverlayLayout& layout, const std::string& text,
                                       const std::string& place) {
  if (text.empty()) return std::nullopt;
  const double height = layout.text_height(), pad = height;
  const std::vector<std::string> lines = lines_of(text);
  const double tall = 2.0 * pad + height + line_height * height * static_cast<double>(lines.size() - 1);
  return layout.take(steady_width(lines, height) + 2.0 * pad, tall, place);
}

void draw_caption(render::Picture& picture, const std::string& text, const Rectangle& plate) {
  draw_plate(picture, plate);
  const double height = overlay_text_height(picture), pad = height;
  const std::vector<std::string> lines = lines_of(text);
  const double left = plate.left + 0.5 * (plate.right - plate.left - steady_width(lines, height));
  const TextStyle style{.height = height, .color = plate_ink};
  for (std::size_t i = 0; i < lines.size(); ++i)
    draw_text(picture, left, plate.top + pad + height + line_height * height * static_cast<double>(i),
              lines[i], style);
}

}  // namespace lagomorph::apps
