#pragma once

#include "apps/overlay/strokes.h"
#include "render/color.h"

/// What is written over a finished picture. Sizes in pixels, colours in sRGB.
namespace lagomorph::apps {

struct Rectangle {
  double left = 0, top = 0, right = 0, bottom = 0;
};

inline bool overlap(const Rectangle& a, const Rectangle& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

/// Sizes that go with a picture or panel: a hundredth of its shorter side.
double overlay_unit(int width, int height);
/// Height of capitals, large enough to read.
double overlay_text_height(int width, int height);
inline double overlay_unit(const render::Picture& p) { return overlay_unit(p.width, p.height); }
inline double overlay_text_height(const render::Picture& p) { return overlay_text_height(p.width, p.height); }

/// Blends a colour into one pixel of the picture.
void blend(render::Picture&, int x, int y, const Color&, double opacity);

/// Blends a colour in; pixels that are covered in part take their part. What lies outside is cut off.
void fill_rectangle(render::Picture&, const Rectangle&, const Color&, double opacity = 1.0);

/// What text stands on: dark, and light writing on it reads on any picture.
void draw_plate(render::Picture&, const Rectangle&);
inline constexpr Color plate_ink = {244, 244, 246};

}  // namespace lagomorph::apps
