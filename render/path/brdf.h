#pragma once

#include <algorithm>

#include "render/path/brdf_formulas.h"
#include "render/path/sampler.h"
#include "render/render_scene.h"

namespace lagomorph::render::path {

/// A material ready to be evaluated: Lambert under a GGX coat, or a metal. Directions are unit vectors in the
/// surface's frame, z along the normal, both pointing away from the surface; z > 0 for both.
///   f = (1 - metallic) base / pi (1 - E(cos_o)) (1 - E(cos_i)) / (1 - mean E) + F(h.o) D V
///     + metallic M (1 - E1(cos_o)) (1 - E1(cos_i)) / (pi (1 - mean E1))
/// with Schlick's F(c) = f0 + (f90 - f0) (1 - c)^5. D is GGX, V = G2 / (4 cos_o cos_i) with Smith's
/// height-correlated G2 [Heitz 2014]. E is the dielectric coat's directional albedo: the base gets what the
/// coat lets in and out [Kelemen and Szirmay-Kalos 2001], so that a white one reflects exactly all that
/// arrives. E1 is that of a white mirror as rough, and M what comes out of a metal's facets after more than
/// one reflection [Kulla and Conty 2017], so that a white metal does so too. f90 fades to 0 with f0 below 2 %
/// [Lagarde and de Rousiers 2014]: ior = 1 is no coat at all.
class Brdf {
public:
  /// Of the base only the part `base_share` is drawn.
  explicit Brdf(const Material&, float base_share = 1.0F);

  /// What only depends on the direction of the eye.
  struct View : BrdfView {
    float reflectance;  // about, in luminance
  };
  /// `least_alpha`, up to 0.5: the coat is taken to be at least as rough, and to reflect as much as it does.
  /// `base_color`: in place of the material's.
  View view(const Vec3& wo, float least_alpha = 0.0F, const Color* base_color = nullptr) const;

  struct Value {
    Color f_cos = Color::Zero();  // BRDF times cos_i [1/sr]
    float pdf = 0.0F;             // of sample() for this direction [1/sr]
  };
  struct Sample {
    Vec3 direction;
    Value value;  // pdf = 0: no direction, the path ends
  };
  Value evaluate(const View&, const Vec3& wi) const;
  Sample sample(const View&, Pair) const;

  /// Part of the light along a cosine that passes the dielectric coat to its base.
  float let_in(float cosine) const { return into_base(cosine); }
  /// Likewise of light that is spread as the cosine below, with what the coat reflects back to the base
  /// coming again: 1 in the cosine's mean.
  float let_out(float cosine) const { return let_in(cosine) / mean_into_base_; }
  /// Estimate of the luminance reflected of all that arrives.
  float reflectance(const View& v) const { return v.reflectance; }

  const BrdfConstants& constants() const { return constants_; }

private:
  /// Part of the light from a direction that the dielectric coat lets through.
  float into_base(float cosine) const { return look_up(constants_.into_base, std::max(cosine, 0.0F)); }

  BrdfConstants constants_{};
  float mean_into_base_ = 0.0F;  // 2 int into_base(c) c dc
};

/// Made when it is asked for first.
const CoatAlbedoTable& coat_albedo_by_roughness();

/// Visible normals of GGX by spherical caps [Dupuy and Benyoub 2023]; the distribution of [Heitz 2018].
Vec3 sample_visible_normal(const Vec3& wo, float alpha, Pair);
/// Direction with density cos / pi over the hemisphere around z.
Vec3 sample_cosine(Pair);

/// Tangents t and b so that (t, b, n) is a right-handed frame [Duff et al. 2017].
void make_frame(const Vec3& n, Vec3& t, Vec3& b);

}  // namespace lagomorph::render::path
