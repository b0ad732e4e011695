#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/overlay/overlay.h"

namespace lagomorph::apps {

/// Where the overlays of one picture, or of one panel, stand: each takes room at its edge or corner, as near
/// to there as those before it leave some, so that none lie over each other. Sizes in pixels.
class OverlayLayout {
public:
  OverlayLayout(int width, int height);

  double unit() const { return unit_; }                // see overlay_unit()
  double text_height() const { return text_height_; }  // see overlay_text_height()
  /// Of captions, where their lines have room for so tall capitals; text_height() unless it is set.
  double caption_height() const { return caption_height_; }
  void set_caption_height(double pixels) { caption_height_ = pixels; }
  double margin() const;  // between them and the picture's edge
  int width() const { return width_; }
  int height() const { return height_; }

  /// What is there already.
  void occupy(const Rectangle& r) { taken_.push_back(r); }
  const std::vector<Rectangle>& taken() const { return taken_; }
  /// Takes room of whole pixels at a place as a caption's, or "right", the middle of that edge. None where
  /// there is not enough.
  std::optional<Rectangle> take(double width, double height, const std::string& place);

private:
  int width_, height_;
  double unit_, text_height_, caption_height_;
  std::vector<Rectangle> taken_;
};

}  // namespace lagomorph::apps
