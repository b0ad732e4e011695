#pragma once

#include "render/path/sampler.h"
#include "render/render_scene.h"

namespace lagomorph::render::path {

/// A sun as a sampler of directions: a cone around the way to its middle, of one radiance.
class SunLight {
public:
  explicit SunLight(const Sun&);

  /// Its irradiance E, over pi sin^2 of half its angle: so much that a surface that faces it gets E.
  const Color& radiance() const { return radiance_; }
  bool visible() const { return visible_; }
  /// Luminance of its irradiance, to pick one of several.
  float strength() const { return strength_; }

  /// A direction towards it, uniform in solid angle.
  Vec3 sample(Pair) const;
  /// sample()'s density of each direction towards it [1/sr].
  float pdf() const { return pdf_; }
  /// Whether a unit direction points into its disc.
  bool contains(const Vec3& direction) const { return (direction - middle_).squaredNorm() <= chord2_; }

private:
  Vec3 middle_, t_, b_;  // unit; the way to its middle, and across
  float height_;         // 1 - cos of half its angle
  float chord2_;         // squared distance of its border from its middle on the unit sphere
  float pdf_, strength_;
  Color radiance_;
  bool visible_;
};

}  // namespace lagomorph::render::path
