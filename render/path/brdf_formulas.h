#pragma once

#include "render/path/lane_math.h"
#include "render/path/microfacet.h"
#include "render/path/sampler.h"

/// The formulas of Brdf for one lane; brdf.h says what they mean.
namespace lagomorph::render::path {

/// A Brdf seen from a direction.
struct BrdfView {
  F3 wo;
  F3 base;      // 1/sr, but for what depends on wi
  F3 multiple;  // likewise, of light that a metal's facets reflect more than once
  F3 f0;        // of the coat or metal
  float f90;
  float coat_probability;  // of sampling the coat
  float alpha;
  float root;  // cos_o (1 + 2 Lambda(wo))
};

/// Values at cosines 0 .. 1, between which it is linear.
struct CosineTable {
  static constexpr int intervals = 64;
  float at[intervals + 1];

  static constexpr float cosine(int i) { return static_cast<float>(i) / intervals; }
  /// Of value i in the mean over the hemisphere, 2 int f(c) c dc.
  static constexpr float weight(int i) {
    return 2.0F * cosine(i) * (i == intervals ? 0.5F : 1.0F) / intervals;
  }
};
LAGOMORPH_INLINE float look_up(const CosineTable& table, float cosine) {
  const float x = std::min(cosine, 0x1.fffffep-1F) * CosineTable::intervals;
  // Within the table even where a lane has no number.
  const std::int32_t i = std::min(std::max(static_cast<std::int32_t>(x), 0), CosineTable::intervals - 1);
  const float a = table.at[i];
  return a + (x - static_cast<float>(i)) * (table.at[i + 1] - a);
}

/// cos_w (1 + 2 Lambda(w)) = sqrt(alpha^2 sin^2 + cos^2).
LAGOMORPH_INLINE float smith_root(F3 w, float alpha) {
  return std::sqrt(alpha * alpha * (w.x * w.x + w.y * w.y) + w.z * w.z);
}

/// A material.
struct BrdfConstants {
  CosineTable scale, offset;  // the coat's directional albedo: f0 * scale + f90 * offset
  CosineTable into_base;      // part of the light along a cosine that passes the dielectric coat
  CosineTable lost;           // part that a mirror of the same roughness does not reflect at once
  float mean_lost;            // 2 int lost(c) c dc
  F3 base_color;
  float metallic;
  float coat_f0;     // of the dielectric
  float base_scale;  // of the base colour: (1 - metallic) / pi / the mean of into_base, of the part drawn
  float alpha;
};

/// Part of what a metal of this f0 does not reflect at once that comes out after more reflections [Kulla and
/// Conty 2017; Hill 2018]; all of it of a white one.
LAGOMORPH_INLINE float reflected_again(float f0, float mean_lost) {
  const float mean = f0 + (1.0F - f0) / 21.0F;  // Schlick's, over the cosine
  return mean * mean * (1.0F - mean_lost) / (1.0F - mean * mean_lost);
}

/// CoatAlbedo by cosine and roughness, bilinear.
struct CoatAlbedoTable {
  static constexpr int rows = 32;
  static constexpr int columns = CosineTable::intervals;
  static constexpr float roughest =
      0.70710678F;  // alpha = 0.5, as far as a surface is drawn rougher than it is
  float scale[(rows + 1) * (columns + 1)];
  float offset[(rows + 1) * (columns + 1)];
};
LAGOMORPH_INLINE float look_up(const float* table, float cosine, float roughness) {
  constexpr int rows = CoatAlbedoTable::rows, columns = CoatAlbedoTable::columns;
  const float x = std::min(cosine, 0x1.fffffep-1F) * columns;
  const float y = roughness * (rows / CoatAlbedoTable::roughest);
  const std::int32_t i = std::min(std::max(static_cast<std::int32_t>(x), 0), columns - 1);
  const std::int32_t j = std::min(std::max(static_cast<std::int32_t>(y), 0), rows - 1);
  const float px = x - static_cast<float>(i), py = y - static_cast<float>(j);
  const std::int32_t at = j * (columns + 1) + i, above = at + columns + 1;
  const float low = table[at] + px * (table[at + 1] - table[at]);
  return low + py * (table[above] + px * (table[above + 1] - table[above]) - low);
}

struct SeenBrdf {
  BrdfView view;
  float reflectance;  // about, in luminance
};
/// `least_alpha`, up to 0.5: the coat is taken to be at least as rough, and to reflect as much as it does; of
/// the light from wo, for a rougher one sends more of it into its own facets.
/// `base_color`: in place of the material's.
LAGOMORPH_INLINE SeenBrdf view_brdf(const BrdfConstants& m, const CoatAlbedoTable& rougher, F3 wo,
                                    float least_alpha, F3 base_color) {
  const float dielectric = (1.0F - m.metallic) * m.coat_f0;
  const F3 f0 = F3{dielectric, dielectric, dielectric} + m.metallic * base_color;
  const float f90 = std::min(1.0F, 50.0F * max_of(f0));
  const float cosine = std::max(wo.z, 0.0F);
  const F3 base = (m.base_scale * look_up(m.into_base, cosine)) * base_color;
  const float lost = look_up(m.lost, cosine);
  const F3 again = {reflected_again(base_color.x, m.mean_lost), reflected_again(base_color.y, m.mean_lost),
                    reflected_again(base_color.z, m.mean_lost)};
  const F3 multiple = (m.metallic * lost * inv_pi / std::max(m.mean_lost, 1e-6F)) * again;
  const float scale = look_up(m.scale, cosine), offset = look_up(m.offset, cosine);
  const float coat = luminance(f0) * scale + f90 * offset;
  const float all = coat + std::numbers::pi_v<float> * luminance(base) + m.metallic * lost * luminance(again);
  const float alpha = std::max(m.alpha, least_alpha);
  const float probability = all > 0.0F ? coat / all : 0.0F;
  const float roughness = std::sqrt(alpha);
  const bool as_it_is = alpha <= m.alpha;
  const float by_scale = as_it_is ? 1.0F : scale / std::max(look_up(rougher.scale, cosine, roughness), 1e-6F);
  const float by_offset =
      as_it_is ? 1.0F : offset / std::max(look_up(rougher.offset, cosine, roughness), 1e-6F);
  return {{wo, base, multiple, by_scale * f0, by_offset * f90, probability, alpha, smith_root(wo, alpha)},
          all};
}

struct BrdfValue {
  F3 f_cos;
  float pdf;
};
/// Of wi with wi.z > 0 and wo.z > 0; else it means nothing.
LAGOMORPH_INLINE BrdfValue evaluate_brdf(const BrdfView& v, F3 wi, const BrdfConstants& m) {
  const F3 h = normalized(v.wo + wi);
  const float a2 = v.alpha * v.alpha;
  const float k = (h.x * h.x + h.y * h.y) / a2 + h.z * h.z;
  const float d = inv_pi / (a2 * k * k);
  const float visibility = 0.5F / (v.wo.z * smith_root(wi, v.alpha) + wi.z * v.root);
  const float c = 1.0F - std::min(dot(v.wo, h), 1.0F);
  const float c2 = c * c;
  const float schlick = c2 * c2 * c;
  const float dv = d * visibility;
  const float in = look_up(m.into_base, std::max(wi.z, 0.0F));
  const float lost = look_up(m.lost, std::max(wi.z, 0.0F));
  const auto lobe = [&](float base, float multiple, float f0) {
    return (base * in + multiple * lost + (f0 + (v.f90 - f0) * schlick) * dv) * wi.z;
  };
  // Density of reflecting at a visible normal: G1(o) D / (4 cos_o), G1 = 2 cos_o / (cos_o + root).
  const float coat_pdf = d / (2.0F * (v.wo.z + v.root));
  const float p = v.coat_probability;
  return {{lobe(v.base.x, v.multiple.x, v.f0.x), lobe(v.base.y, v.multiple.y, v.f0.y),
           lobe(v.base.z, v.multiple.z, v.f0.z)},
          p * coat_pdf + (1.0F - p) * wi.z * inv_pi};
}

/// Direction with density cos / pi over the hemisphere around z.
LAGOMORPH_INLINE F3 cosine_direction(float u, float v) {
  const float radius = std::sqrt(u);
  const SinCos phi = sincos_of_turns(v);
  return {radius * phi.cosine, radius * phi.sine, std::sqrt(std::max(1.0F - u, 0.0F))};
}

/// Visible normals of GGX by spherical caps [Dupuy and Benyoub 2023]; the distribution of [Heitz 2018].
LAGOMORPH_INLINE F3 visible_normal(F3 wo, float alpha, float u, float v) {
  const F3 stretched = normalized({alpha * wo.x, alpha * wo.y, wo.z});
  const SinCos phi = sincos_of_turns(u);
  const float z = (1.0F - v) * (1.0F + stretched.z) - stretched.z;
  const float radius = std::sqrt(std::max(std::min(1.0F - z * z, 1.0F), 0.0F));
  const F3 h = F3{radius * phi.cosine, radius * phi.sine, z} + stretched;
  return normalized({alpha * h.x, alpha * h.y, std::max(h.z, 1e-7F)});
}

/// Direction by the coat or the base; evaluate_brdf() gives its density.
LAGOMORPH_INLINE F3 brdf_direction(const BrdfView& view, float u, float v) {
  const float p = view.coat_probability;
  const F3 h = visible_normal(view.wo, view.alpha, std::min(u / std::max(p, 1e-30F), 0x1.fffffep-1F), v);
  const F3 mirrored = 2.0F * dot(view.wo, h) * h - view.wo;
  const F3 cosine =
      cosine_direction(std::max(std::min((u - p) / std::max(1.0F - p, 1e-30F), 0x1.fffffep-1F), 0.0F), v);
  return select(u < p, mirrored, cosine);
}

}  // namespace lagomorph::render::path
