#include "apps/overlay/swatches.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/overlay/stroke_font.h"

namespace lagomorph::apps {
namespace {

constexpr double widest_key = 0.37;   // plate, of the picture's width
constexpr double widest_names = 0.2;  // names, likewise, but for what a short one needs
constexpr double short_name = 12.0;   // of text heights

}  // namespace

Swatches::Swatches(int width, int height, std::string title, std::vector<Swatch> rows)
    : title_(std::move(title)),
      rows_(std::move(rows)),
      text_(overlay_text_height(width, height)),
      pad_(1.2 * text_) {
  const double room = widest_key * width - 2.0 * pad_;
  const double names = std::min(room - side() - gap(), std::max(widest_names * width, short_name * text_));
  title_ = fitting_text(title_, text_, room);
  inner_ = text_width(title_, text_);
  for (Swatch& row : rows_) {
    row.name = fitting_text(row.name, text_, names);
    inner_ = std::max(inner_, side() + gap() + text_width(row.name, text_));
  }
  const double margin = 3.0 * overlay_unit(width, height);
  fits_ = this->height() <= height - 2.0 * margin && inner_ <= room;
}

double Swatches::height() const {
  const auto rows = static_cast<double>(rows_.size());
  return 2.0 * pad_ + text_ + 0.9 * pad_ + pitch() * (rows - 1.0) + side();
}

void Swatches::draw(render::Picture& picture, const Rectangle& plate) const {
  draw_plate(picture, plate);
  const TextStyle style{.height = text_, .color = plate_ink};
  const double left = std::round(plate.left + pad_);
  draw_text(picture, left, plate.top + pad_ + text_, title_, style);
  const double line = std::max(1.0, std::round(0.1 * text_));
  double y = std::round(plate.top + 1.9 * pad_ + text_);
  for (const Swatch& row : rows_) {
    const Rectangle color{left + line, y + line, left + std::round(side()) - line,
                          y + std::round(side()) - line};
    fill_rectangle(picture, {color.left - line, color.top - line, color.right + line, color.bottom + line},
                   plate_ink, 0.5);
    fill_rectangle(picture, color, row.color);
    draw_text(picture, left + side() + gap(), y + 0.5 * (side() + text_), row.name, style);
    y += std::round(pitch());
  }
}

}  // namespace lagomorph::apps
