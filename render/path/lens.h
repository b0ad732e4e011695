#pragma once

#include "render/camera.h"
#include "render/path/sampler.h"

namespace lagomorph::render::path {

/// The opening of a lens: a disc, or a regular polygon in it whose corners touch its border.
class Aperture {
public:
  explicit Aperture(const Camera&);
  /// A point of it, spread evenly over its area, in radii along right and up: on the disc by concentric
  /// squares [Shirley and Chiu 1997], in a polygon by its triangles.
  Vec2 point(Pair) const;

private:
  int blades_;
  float rotation_;  // [rad]
};

}  // namespace lagomorph::render::path
