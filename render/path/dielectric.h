#pragma once

#include <array>

#include "render/path/brdf.h"
#include "render/path/sampler.h"
#include "render/types.h"

namespace lagomorph::render::path {

/// Reflectance of a smooth interface for unpolarized light [Fresnel]: `cosine` >= 0 of the arriving
/// direction, `eta` the index behind the interface over that before it. 1 at total reflection.
float fresnel(float cosine, float eta);
/// Mirrored on the microfacet h.
Vec3 reflected(const Vec3& wo, const Vec3& h);
/// Snell: through the microfacet h, above which wo is; `eta` as of fresnel(). Zero at total reflection.
Vec3 refracted(const Vec3& wo, const Vec3& h, float eta);

/// A rough interface between air, z > 0, and a clear inside, z < 0 [Walter et al. 2007], GGX with visible
/// normals. Directions are unit vectors that point away from the surface, on either side.
///
/// Light of single scattering only would be lost between the microfacets: L(c) = 1 - E(c) of it at a cosine
/// c, with E the directional albedo. It comes back spread as L on both sides [Kulla and Conty 2017]:
///   flux(o -> i) = share(o's side to i's side) L(o) L(i) / (pi mean L of i's side)
/// with the shares of transmission T so that T n^2 (mean L) is the same both ways, n the side's index. So all
/// light is scattered and f / n^2 is reciprocal.
class Dielectric {
public:
  /// `roughness` is perceptual. An index under 1.001 is drawn as 1.001.
  Dielectric(float ior, float roughness);

  /// What only depends on the direction of the eye.
  struct View {
    Vec3 wo;
    float alpha;
    float level;                     // in the tables of lost light
    float lost;                      // L(wo)
    std::array<float, 2> mean_lost;  // of outside, inside
    float multiple_through;          // T from wo's side
  };
  /// `least_alpha`, up to 0.5: the interface is taken to be at least as rough.
  View view(const Vec3& wo, float least_alpha = 0.0F) const;

  /// BSDF times |cos_i| [1/sr] for radiance, which is scaled by n_o^2 / n_i^2 where it goes through.
  Brdf::Value evaluate(const View&, const Vec3& wi) const;
  /// `choice`: u which lobe, v reflected or transmitted.
  Brdf::Sample sample(const View&, Pair direction, Pair choice) const;

  float ior() const { return ior_; }

private:
  static constexpr int intervals = 64;
  static constexpr int levels = 6;
  using Table = std::array<float, intervals + 1>;  // at cosines 0 .. 1

  Brdf::Value scatter_once(const View&, const Vec3& wi, const Vec3& h) const;
  Brdf::Value scatter_often(const View&, const Vec3& wi) const;
  float lost(int side, float cosine, float level) const;
  float alpha_of(int level) const;

  float ior_;
  float alpha_;
  float through_;  // part of diffuse light from outside that enters a smooth interface
  std::array<std::array<Table, levels>, 2> lost_;       // [outside, inside][level]
  std::array<std::array<float, levels>, 2> mean_lost_;  // 2 int L c dc
};

}  // namespace lagomorph::render::path
