#include "apps/preview/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "apps/file_io.h"
#include "apps/overlay/stroke_font.h"
#include "apps/preview/story.h"
#include "render/png_read.h"

namespace lagomorph::apps {
namespace {

constexpr std::size_t most_frames = 20;
constexpr Size thumbnail_box = {320, 240};
constexpr int narrowest = 112;  // column: room for the caption
constexpr int margin = 32, gap = 18, caption = 30;
constexpr int head = 84;  // title and the line below it

using Color = std::array<std::uint8_t, 3>;
constexpr Color ground = {20, 22, 26}, empty = {38, 41, 47}, bright = {240, 241, 243},
                muted = {150, 156, 166}, warning = {240, 170, 90};

/// Where everything lies.
struct Layout {
  int columns = 1, rows = 1;
  Size thumbnail, cell, sheet;
};

Layout layout_of(const Shown& shown, std::size_t frames) {
  Layout l;
  const int n = static_cast<int>(frames);
  l.columns = n <= 3 ? n : n == 4 ? 2 : n <= 9 ? 3 : n <= 16 ? 4 : 5;
  l.rows = (n + l.columns - 1) / l.columns;
  l.thumbnail = size_within(shown.size, thumbnail_box);
  l.cell = {std::max(l.thumbnail.width, narrowest), l.thumbnail.height + caption};
  l.sheet = {std::max(2 * margin + l.columns * (l.cell.width + gap) - gap, 480),
             head + l.rows * (l.cell.height + gap) - gap + margin};
  return l;
}

void draw_head(render::Picture& sheet, const PreviewMaterial& m) {
  const std::string line = headline(m);
  const double width = sheet.width - 2 * margin;
  const std::string name = m.name;
  const std::string rest = line.substr(std::min(line.size(), name.size() + 2));
  draw_text(sheet, margin, 44, fitting_text(name, 18, width), {18, bright});
  draw_text(sheet, margin, 68, fitting_text(rest, 9.5, width), {9.5, muted});
}

void draw_frame(render::Picture& sheet, const PreviewMaterial& m, const ShownFrame& frame, const Layout& l,
                int x, int y) {
  const int left = x + (l.cell.width - l.thumbnail.width) / 2;
  if (frame.small.empty()) {
    put_picture(sheet, left, y, filled(l.thumbnail, empty));
    const std::string text = fitting_text("unreadable", 9, l.thumbnail.width);
    draw_text(sheet, left + (l.thumbnail.width - text_width(text, 9)) / 2, y + 0.5 * l.thumbnail.height + 4,
              text, {9, warning});
  } else {
    const render::Pixels small = render::read_png(read_file(frame.small), frame.small.string());
    put_picture(sheet, left, y, resized(opaque_picture(small), l.thumbnail));
  }
  const double baseline = y + l.thumbnail.height + 19;
  draw_text(sheet, left, baseline, fmt::format("frame {}", frame.frame), {9.5, bright});
  if (!m.info) return;  // a time would be a guess
  const std::string time = fmt::format("{:.2f} s", frame_time(m, frame.frame));
  draw_text(sheet, left + std::max(l.thumbnail.width, narrowest) - text_width(time, 9.5), baseline, time,
            {9.5, muted});
}

}  // namespace

std::vector<const ShownFrame*> sheet_frames(const Shown& shown) {
  std::vector<const ShownFrame*> chosen;
  for (const std::size_t i : evenly(shown.frames.size(), most_frames)) chosen.push_back(&shown.frames[i]);
  return chosen;
}

render::Picture contact_sheet(const PreviewMaterial& m, const Shown& shown) {
  const std::vector<const ShownFrame*> frames = sheet_frames(shown);
  const Layout l = layout_of(shown, frames.size());
  render::Picture sheet = filled(l.sheet, ground);
  draw_head(sheet, m);
  int i = 0;
  for (const ShownFrame* frame : frames) {
    draw_frame(sheet, m, *frame, l, margin + i % l.columns * (l.cell.width + gap),
               head + i / l.columns * (l.cell.height + gap));
    ++i;
  }
  return sheet;
}

}  // namespace lagomorph::apps
