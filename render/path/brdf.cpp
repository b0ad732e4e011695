#include "render/path/brdf.h"

#include <algorithm>
#include <cmath>

#include "render/albedo.h"
#include "render/coat_albedo.h"

namespace lagomorph::render::path {

Brdf::Brdf(const Material& m, float base_share) {
  BrdfConstants& c = constants_;
  c.coat_f0 = dielectric_f0(m);
  const float coat_f90 = std::min(1.0F, 50.0F * c.coat_f0);
  c.alpha = std::max(m.roughness * m.roughness, 1e-3F);  // sharper is a mirror but for what float resolves
  constexpr int intervals = CosineTable::intervals;
  for (int i = 0; i <= intervals; ++i) {
    const float cosine = CosineTable::cosine(i);
    const CoatAlbedo a = coat_albedo(cosine, m.roughness);
    c.scale.at[i] = a.scale;
    c.offset.at[i] = a.offset;
    c.into_base.at[i] = 1.0F - c.coat_f0 * a.scale - coat_f90 * a.offset;
    c.lost.at[i] = std::max(1.0F - a.scale - a.offset, 0.0F);
    const float weight = CosineTable::weight(i);
    mean_into_base_ += c.into_base.at[i] * weight;
    c.mean_lost += c.lost.at[i] * weight;
  }
  c.base_color = f3(m.base_color);
  c.metallic = m.metallic;
  c.base_scale = (1.0F - m.metallic) * inv_pi / mean_into_base_ * base_share;
}

Brdf::View Brdf::view(const Vec3& wo, float least_alpha, const Color* base_color) const {
  const SeenBrdf seen = view_brdf(constants_, coat_albedo_by_roughness(), f3(wo), least_alpha,
                                  base_color == nullptr ? constants_.base_color : f3(*base_color));
  return {seen.view, seen.reflectance};
}

Brdf::Value Brdf::evaluate(const View& view, const Vec3& wi) const {
  if (wi.z() <= 0.0F || view.wo.z <= 0.0F) return {};
  const BrdfValue f = evaluate_brdf(view, f3(wi), constants_);
  return {color(f.f_cos), f.pdf};
}

Brdf::Sample Brdf::sample(const View& view, Pair s) const {
  const Vec3 wi = vec3(brdf_direction(view, s.u, s.v));
  return {wi, evaluate(view, wi)};
}

const CoatAlbedoTable& coat_albedo_by_roughness() {
  static const CoatAlbedoTable table = [] {
    using Table = CoatAlbedoTable;
    Table t{};
    for (int j = 0; j <= Table::rows; ++j) {
      const float roughness = std::max(Table::roughest * static_cast<float>(j) / Table::rows, 0.0316F);
      for (int i = 0; i <= Table::columns; ++i) {
        const CoatAlbedo a = coat_albedo(static_cast<float>(i) / Table::columns, roughness);
        t.scale[j * (Table::columns + 1) + i] = a.scale;
        t.offset[j * (Table::columns + 1) + i] = a.offset;
      }
    }
    return t;
  }();
  return table;
}

Vec3 sample_visible_normal(const Vec3& wo, float alpha, Pair s) {
  return vec3(visible_normal(f3(wo), alpha, s.u, s.v));
}

Vec3 sample_cosine(Pair s) { return vec3(cosine_direction(s.u, s.v)); }

void make_frame(const Vec3& n, Vec3& t, Vec3& b) {
  const Frame frame = frame_of(f3(n));
  t = vec3(frame.t);
  b = vec3(frame.b);
}

}  // namespace lagomorph::render::path
