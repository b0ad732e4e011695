#pragma once

#include "render/camera.h"
#include "render/path/light_formulas.h"
#include "render/path/sampler.h"
#include "render/render_scene.h"

namespace lagomorph::render::path {

/// A one-sided rectangle that shines, as a sampler of directions. It is no obstacle to light.
class RectangleLight {
public:
  explicit RectangleLight(const AreaLight&);

  const Color& radiance() const { return radiance_; }
  bool visible() const { return visible_; }
  /// Radiant power per pi: area times the luminance of its radiance.
  float power() const;

  struct Sample {
    Vec3 direction = Vec3::Zero();
    float distance = 0.0F;  // [m]
    float pdf = 0.0F;       // of the direction [1/sr]; 0 where the light does not shine
  };
  /// A point of the rectangle seen from p: uniform in solid angle [Ureña, Fajardo and King 2013], or in area
  /// where the rectangle is so small from there that both are alike.
  Sample sample(const Vec3& p, Pair) const;

  struct Hit {
    float distance = 0.0F;  // [m]; 0: no hit on the shining side
    Vec3 point = Vec3::Zero();
  };
  Hit intersect(const Ray&) const;
  /// sample()'s density of the direction from p to a point of the rectangle [1/sr].
  float pdf(const Vec3& p, const Vec3& point) const;

  const Rectangle& shape() const { return shape_; }

private:
  Rectangle shape_;
  Color radiance_;
  bool visible_;
};

}  // namespace lagomorph::render::path
