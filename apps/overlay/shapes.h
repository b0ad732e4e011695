#pragma once

#include <span>
#include <string_view>

#include "apps/overlay/strokes.h"
#include "render/color.h"

namespace lagomorph::apps {

/// Fills a disc, smoothed at its border; what lies outside is cut off. Opacity in [0, 1].
void fill_disc(render::Picture&, Point center, double radius, const Color&, double opacity = 1.0);

/// Fills a convex polygon, likewise; its corners go around either way.
void fill_convex(render::Picture&, std::span<const Point> corners, const Color&, double opacity = 1.0);

/// Light text with a dark rim that reads on any picture, its middle at a point. Height of capitals in pixels.
void draw_rimmed_text(render::Picture&, Point middle, std::string_view text, double height, const Color&);

/// What lies under light lines and signs, so that they are seen on light pictures.
inline constexpr Color rim_color = {16, 18, 22};

}  // namespace lagomorph::apps
