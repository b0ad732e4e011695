#pragma once

#include "render/path/sampler.h"
#include "render/render_scene.h"

namespace lagomorph::render::path {

/// A material ready to be evaluated: Lambert under a GGX coat, or a metal. Directions are unit vectors in the
/// surface's frame, z along the normal, both pointing away from the surface; z > 0 for both.
///   f = (1 - metallic) base / pi (1 - F_d(cos_o)) (1 - F_d(cos_i)) / (1 - mean F_d) + F(h.o) D V
/// with Schlick's F(c) = f0 + (f90 - f0) (1 - c)^5, F_d the dielectric's. D is GGX, V = G2 / (4 cos_o cos_i)
/// with Smith's height-correlated G2 [Heitz 2014]. The base gets what the coat lets in and out [Kelemen and
/// Szirmay-Kalos 2001], so that no more is reflected than arrives; weighing it by 1 - F(h.o) alone, as is
/// common, gives 40 % too much light at grazing angles. f90 fades to 0 with f0 below 2 % [Lagarde and de
/// Rousiers 2014]: ior = 1 is no coat at all.
class Brdf {
public:
  Brdf() = default;
  explicit Brdf(const Material&);
  /// The same with a coat at least as rough as alpha.
  Brdf roughened(float alpha) const;

  struct Value {
    Color f_cos = Color::Zero();  // BRDF times cos_i [1/sr]
    float pdf = 0.0F;             // of sample() for this direction [1/sr]
  };
  struct Sample {
    Vec3 direction;
    Value value;  // pdf = 0: no direction, the path ends
  };
  Value evaluate(const Vec3& wo, const Vec3& wi) const;
  Sample sample(const Vec3& wo, Pair) const;

private:
  float coat_probability(float cos_o) const;

  float into_base(float cosine) const;

  Color base_ = Color::Zero();  // its BRDF without what the coat takes
  Color f0_ = Color::Zero();    // of the coat or metal
  float f90_ = 0.0F;
  float coat_f0_ = 0.0F;  // of the dielectric
  float coat_f90_ = 0.0F;
  float alpha_ = 1.0F;
};

/// Visible normals of GGX by spherical caps [Dupuy and Benyoub 2023]; the distribution of [Heitz 2018].
Vec3 sample_visible_normal(const Vec3& wo, float alpha, Pair);
/// Direction with density cos / pi over the hemisphere around z.
Vec3 sample_cosine(Pair);

/// Tangents t and b so that (t, b, n) is a right-handed frame [Duff et al. 2017].
void make_frame(const Vec3& n, Vec3& t, Vec3& b);

}  // namespace lagomorph::render::path
