#pragma once

#include "render/path/light_formulas.h"
#include "render/path/sampler.h"
#include "render/render_scene.h"

namespace lagomorph::render::path {

/// A sun as a sampler of directions: a cone around the way to its middle, of one radiance.
class SunLight {
public:
  explicit SunLight(const Sun&);

  /// Its irradiance E, over pi sin^2 of half its angle: so much that a surface that faces it gets E.
  Color radiance() const { return color(disc_.radiance); }
  bool visible() const { return visible_; }
  /// Luminance of its irradiance, to pick one of several.
  float strength() const { return strength_; }

  /// A direction towards it, uniform in solid angle.
  Vec3 sample(Pair) const;
  /// sample()'s density of each direction towards it [1/sr].
  float pdf() const { return disc_.pdf; }
  /// Whether a unit direction points into its disc.
  bool contains(const Vec3& direction) const {
    return (direction - vec3(disc_.middle)).squaredNorm() <= chord2_;
  }

  const SunDisc& disc() const { return disc_; }

private:
  SunDisc disc_;
  float chord2_;  // squared distance of its border from its middle on the unit sphere
  float strength_;
  bool visible_;
};

}  // namespace lagomorph::render::path
