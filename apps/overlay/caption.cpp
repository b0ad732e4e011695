#include "apps/overlay/caption.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/args.h>
#include <fmt/format.h>

#include "apps/error.h"
#include "apps/overlay/overlay.h"
#include "apps/overlay/stroke_font.h"

namespace lagomorph::apps {
namespace {

constexpr double line_height = 1.9;  // of capitals
constexpr double least_width = 6.0;  // of a line that is made narrower, over the height of capitals

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

/// Of a line, were all its digits the widest one.
double steady_width(std::string line, double height) {
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c >= '0' && c <= '9'; }, '0');
  return text_width(line, height);
}

/// Of the widest line.
double steady_width(const std::vector<std::string>& lines, double height) {
  double width = 0.0;
  for (const std::string& line : lines) width = std::max(width, steady_width(line, height));
  return width;
}

double plate_height(std::size_t lines, double height) {
  return 3.0 * height + line_height * height * static_cast<double>(lines - 1);
}

bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

/// Where the character at a place ends.
std::size_t character_end(const std::string& text, std::size_t begin) {
  do {
    ++begin;
  } while (begin < text.size() && !begins_character(text[begin]));
  return begin;
}

/// How much of the beginning of a line fits: up to a space, or where there is none, what there is room for;
/// one character at least.
std::size_t fitting_length(const std::string& line, double height, double width) {
  const auto fits = [&](std::size_t length) { return steady_width(line.substr(0, length), height) <= width; };
  const std::size_t first = std::min(line.find_first_not_of(' '), line.size());
  std::size_t end = 0;
  for (std::size_t next = line.find(' ', first); next != std::string::npos && fits(next);
       next = line.find(' ', next + 1))
    end = next;
  if (end > 0) return end;
  end = character_end(line, 0);
  while (end < line.size() && fits(character_end(line, end))) end = character_end(line, end);
  return end;
}

/// The lines, those that are too wide as several, cut at spaces.
std::vector<std::string> wrapped_lines(const std::vector<std::string>& lines, double height, double width) {
  std::vector<std::string> narrow;
  for (std::string line : lines) {
    bool is_rest = false;
    while (steady_width(line, height) > width) {
      const std::size_t length = fitting_length(line, height, width);
      narrow.push_back(line.substr(0, length));
      line.erase(0, std::min(line.find_first_not_of(' ', length), line.size()));
      is_rest = true;
    }
    if (!line.empty() || !is_rest) narrow.push_back(std::move(line));
  }
  return narrow;
}

/// The first so many lines, with dots where the others were; none where nothing but dots has room.
std::vector<std::string> cut_to(std::vector<std::string> lines, std::size_t count, double height,
                                double width) {
  if (lines.size() <= count) return lines;
  lines.resize(count);
  std::string& last = lines.back();
  while (!last.empty() && (last.back() == ' ' || steady_width(last + "...", height) > width)) {
    while (!begins_character(last.back()) && last.size() > 1) last.pop_back();
    last.pop_back();
  }
  if (last.empty() && count == 1) return {};
  last += "...";
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

std::optional<Caption> place_caption(OverlayLayout& layout, const std::string& text,
                                     const std::string& place) {
  if (text.empty()) return std::nullopt;
  double height = layout.caption_height();
  const auto placed = [&](std::vector<std::string> lines) -> std::optional<Caption> {
    if (lines.empty()) return std::nullopt;
    const std::optional<Rectangle> plate =
        layout.take(steady_width(lines, height) + 2.0 * height, plate_height(lines.size(), height), place);
    if (!plate) return std::nullopt;
    return Caption{*plate, std::move(lines), height};
  };
  const std::vector<std::string> given = lines_of(text);
  while (height > layout.text_height()) {
    if (std::optional<Caption> caption = placed(given)) return caption;
    height *= 0.95;
  }
  height = layout.text_height();
  const double pad = height;
  if (std::optional<Caption> caption = placed(given)) return caption;
  // Where not all of the width is free, narrower lines may have room.
  const double widest = layout.width() - 2.0 * layout.margin() - 2.0 * pad;
  std::vector<double> widths;
  for (const double part : {1.0, 0.85, 0.7, 0.55, 0.4}) {
    if (part * widest >= least_width * height) widths.push_back(std::floor(part * widest));
  }
  std::size_t most = 0;
  for (const double width : widths) {
    std::vector<std::string> lines = wrapped_lines(given, height, width);
    most = std::max(most, lines.size());
    if (std::optional<Caption> caption = placed(std::move(lines))) return caption;
  }
  while (most > 1 && plate_height(most, height) > layout.height()) --most;
  for (std::size_t count = most; count > 0; --count) {
    for (const double width : widths) {
      if (std::optional<Caption> caption =
              placed(cut_to(wrapped_lines(given, height, width), count, height, width)))
        return caption;
    }
  }
  return std::nullopt;
}

void draw_caption(render::Picture& picture, const Caption& caption) {
  draw_plate(picture, caption.plate);
  const Rectangle& plate = caption.plate;
  const double height = caption.height, pad = height;
  const double left = plate.left + 0.5 * (plate.right - plate.left - steady_width(caption.lines, height));
  const TextStyle style{.height = height, .color = plate_ink};
  for (std::size_t i = 0; i < caption.lines.size(); ++i)
    draw_text(picture, left, plate.top + pad + height + line_height * height * static_cast<double>(i),
              caption.lines[i], style);
}

}  // namespace lagomorph::apps
