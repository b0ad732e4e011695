#include "apps/overlay/caption.h"

#include <algorithm>
#include <cmath>
#include <string_view>

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

Rectangle caption_plate(const render::Picture& picture, const std::string& text, const std::string& place) {
  if (text.empty()) return {};
  const std::string_view where = place;
  const double height = overlay_text_height(picture), pad = height, margin = 3.0 * overlay_unit(picture);
  const std::vector<std::string> lines = lines_of(text);
  double width = 0.0;
  for (const std::string& line : lines) width = std::max(width, text_width(line, height));
  // In steps, so that a plate does not change with each digit.
  const double step = 4.0 * height;
  const double plate = std::ceil(width / step) * step + 2.0 * pad;
  const double tall = 2.0 * pad + height + line_height * height * static_cast<double>(lines.size() - 1);
  double left = std::round(0.5 * (picture.width - plate));
  if (where.ends_with("left")) left = margin;
  if (where.ends_with("right")) left = picture.width - margin - plate;
  const double top = where.starts_with("top") ? margin : picture.height - margin - tall;
  if (left < 0.0 || top < 0.0 || left + plate > picture.width || top + tall > picture.height) return {};
  return {left, top, left + plate, top + tall};
}

void draw_caption(render::Picture& picture, const std::string& text, const std::string& place) {
  const Rectangle plate = caption_plate(picture, text, place);
  if (plate.right <= plate.left) return;
  draw_plate(picture, plate);
  const double height = overlay_text_height(picture), pad = height;
  const std::vector<std::string> lines = lines_of(text);
  const TextStyle style{.height = height, .color = plate_ink};
  for (std::size_t i = 0; i < lines.size(); ++i)
    draw_text(picture, plate.left + pad,
              plate.top + pad + height + line_height * height * static_cast<double>(i), lines[i], style);
}

}  // namespace lagomorph::apps
