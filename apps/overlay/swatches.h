#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/overlay/overlay.h"
#include "render/color.h"

namespace lagomorph::apps {

/// A colour and what it stands for.
struct Swatch {
  std::string name;
  Color color;
};

/// Names beside their colours under a title, on a plate: the key of what has no values in between.
class Swatches {
public:
  /// In a picture or panel of a size; names are cut where they would take more than their part of its width.
  Swatches(int width, int height, std::string title, std::vector<Swatch> rows);

  double width() const { return 2.0 * pad_ + inner_; }
  double height() const;
  /// Whether all rows have room.
  bool fits() const { return fits_; }
  void draw(render::Picture&, const Rectangle& plate) const;

private:
  double side() const { return 1.6 * text_; }
  double pitch() const { return 2.3 * text_; }  // from row to row
  double gap() const { return 0.9 * text_; }

  std::string title_;
  std::vector<Swatch> rows_;
  double text_, pad_, inner_ = 0.0;
  bool fits_ = false;
};

}  // namespace lagomorph::apps
