#include "render/path/bsdf.h"

#include <algorithm>
#include <cmath>

#include "render/path/microfacet.h"

namespace lagomorph::render::path {
namespace {

/// What is not clear: of the part 1 - transmission (1 - metallic), so that it weighs as it should.
Material opaque_part(const Material& m) {
  Material opaque = m;
  const float part = 1.0F - m.transmission * (1.0F - m.metallic);
  if (part > 0.0F) opaque.metallic = std::min(m.metallic / part, 1.0F);
  return opaque;
}

Material coat_material(const Material& m) { return {Color::Zero(), m.coat_roughness, 0.0F, 1.5F}; }

}  // namespace

struct Bsdf::Layers {
  explicit Layers(const Material& m)
      : transmission(m.transmission * (1.0F - m.metallic)),
        cloudy(m.subsurface),
        coat(m.coat),
        sheen_color(m.sheen * m.sheen_tint),
        sheen(sheen_color.maxCoeff()),
        glass(transmission > 0.0F ? m.ior : 1.5F, m.roughness),
        coat_lobe(coat_material(m)),
        sheen_lobe(m.sheen_roughness),
        absorption(m),
        inside(m),
        opaque_metallic(opaque_part(m).metallic) {}

  /// 1 - C; of the coat alone.
  float under_coat(float cosine) const {
    return coat > 0.0F ? 1.0F - coat * (1.0F - coat_lobe.let_in(cosine)) : 1.0F;
  }
  float under_sheen(float cosine) const {
    return sheen > 0.0F ? 1.0F - sheen * sheen_lobe.albedo(cosine) : 1.0F;
  }
  float under(float cosine) const { return cosine > 0.0F ? under_coat(cosine) * under_sheen(cosine) : 1.0F; }

  float transmission, cloudy, coat;
  Color sheen_color;
  float sheen;
  Dielectric glass;
  Brdf coat_lobe;
  Sheen sheen_lobe;
  Absorption absorption;
  CloudyInside inside;
  float opaque_metallic;
};

Bsdf::Bsdf(const Material& m)
    : brdf_(opaque_part(m), 1.0F - m.subsurface),
      transmits_(m.transmission * (1.0F - m.metallic) > 0.0F),
      is_cloudy_(m.subsurface > 0.0F && m.metallic < 1.0F && m.transmission < 1.0F) {
  if (transmits_ || is_cloudy_ || m.coat > 0.0F || m.sheen > 0.0F)
    layers_ = std::make_unique<const Layers>(m);
}

Bsdf::Bsdf(Bsdf&&) noexcept = default;
Bsdf::~Bsdf() = default;

const Absorption& Bsdf::absorption() const { return layers_->absorption; }
const CloudyInside& Bsdf::cloudy_inside() const { return layers_->inside; }

Bsdf::View Bsdf::view(const Vec3& wo, float least_alpha, const Color* base_color) const {
  View v{};
  v.wo = wo;
  const bool outside = wo.z() > 0.0F;
  v.base = brdf_.view(outside || !transmits_ ? wo : mirrored(wo), least_alpha, base_color);
  if (!layers_) return v;
  const Layers& l = *layers_;
  const float cosine = wo.z();
  v.over = l.under(cosine);
  if (outside && l.coat > 0.0F) {
    v.coat = l.coat_lobe.view(wo, least_alpha);
    v.coat_pick = 1.0F - l.under_coat(cosine);
  }
  if (outside && l.sheen > 0.0F) v.sheen_pick = l.under_coat(cosine) * (1.0F - l.under_sheen(cosine));
  const float base = v.over * (1.0F - l.transmission) * brdf_.reflectance(v.base);
  float glass = 0.0F;
  if (transmits_) {
    v.glass = l.glass.view(wo, least_alpha);
    glass = v.over * l.transmission;
  }
  const float all = v.coat_pick + v.sheen_pick + base + glass;
  if (all <= 0.0F) return v;
  v.base_pick = base / all;
  v.glass_pick = glass / all;
  v.coat_pick /= all;
  v.sheen_pick /= all;
  return v;
}

Bsdf::View Bsdf::emerging_view() const {
  View v{};
  v.wo = Vec3::UnitZ();
  v.emerging = true;
  return v;
}

Brdf::Value Bsdf::evaluate_layers(const View& v, const Vec3& wi) const {
  const Layers& l = *layers_;
  if (v.emerging) {
    if (wi.z() <= 0.0F) return {};
    const float pdf = wi.z() * inv_pi;
    return {Color::Constant(pdf * l.under(wi.z()) * brdf_.let_out(wi.z())), pdf};
  }
  const bool outside = v.wo.z() > 0.0F;
  const bool back = (wi.z() > 0.0F) == outside;
  const float between = v.over * l.under(wi.z());
  Brdf::Value sum;
  const auto add = [&](const Brdf::Value& lobe, const Color& weight, float pick) {
    sum.f_cos += weight * lobe.f_cos;
    sum.pdf += pick * lobe.pdf;
  };
  if (back && (outside || transmits_)) {
    const Brdf::Value base = brdf_.evaluate(v.base, outside ? wi : mirrored(wi));
    add(base, Color::Constant(between * (1.0F - l.transmission)), v.base_pick);
  }
  if (transmits_) add(l.glass.evaluate(v.glass, wi), Color::Constant(between * l.transmission), v.glass_pick);
  if (!back || !outside) return sum;
  if (l.coat > 0.0F) add(l.coat_lobe.evaluate(v.coat, wi), Color::Constant(l.coat), v.coat_pick);
  if (l.sheen > 0.0F) {
    const float coats = l.under_coat(v.wo.z()) * l.under_coat(wi.z());
    const Brdf::Value lobe{Color::Constant(l.sheen_lobe.evaluate(v.wo, wi) * wi.z()), 0.5F * inv_pi};
    add(lobe, coats * l.sheen_color, v.sheen_pick);
  }
  return sum;
}

Bsdf::Sample Bsdf::sample(const View& v, Pair s, Pair lobe, Pair choice) const {
  if (!has_layers()) {
    const Brdf::Sample only = brdf_.sample(v.base, s);
    return {only.direction, only.value};
  }
  const Layers& l = *layers_;
  if (v.emerging) {
    const Vec3 wi = sample_cosine(s);
    return {wi, evaluate_layers(v, wi)};
  }
  Vec3 wi;
  if (lobe.u < v.glass_pick) {
    const Brdf::Sample glass = l.glass.sample(v.glass, s, choice);
    if (glass.value.pdf <= 0.0F) return {glass.direction, {}};
    if (v.glass_pick >= 1.0F) {
      // Nothing else scatters: with the microfacet as it was sampled.
      const float between = v.over * l.under(glass.direction.z()) * l.transmission;
      return {glass.direction, {between * glass.value.f_cos, glass.value.pdf}, true};
    }
    return {glass.direction, evaluate_layers(v, glass.direction), true};
  }
  const float left = lobe.u - v.glass_pick;
  if (left < v.coat_pick) {
    wi = l.coat_lobe.sample(v.coat, s).direction;
  } else if (left - v.coat_pick < v.sheen_pick) {
    const float sine = std::sqrt(std::max(1.0F - s.u * s.u, 0.0F));
    wi = Vec3(sine * std::cos(2.0F * pi * s.v), sine * std::sin(2.0F * pi * s.v), s.u);
  } else {
    wi = brdf_.sample(v.base, s).direction;
    if (wi.z() <= 0.0F) return {wi, {}};
    if (v.wo.z() <= 0.0F) wi = mirrored(wi);
    return {wi, evaluate_layers(v, wi)};
  }
  if (wi.z() <= 0.0F) return {wi, {}};
  return {wi, evaluate_layers(v, wi)};
}

Bsdf::Entry Bsdf::entry(const View& v) const {
  if (!is_cloudy_ || v.wo.z() <= 0.0F) return {};
  const Layers& l = *layers_;
  const float opaque = v.over * (1.0F - l.transmission);
  const float part = opaque * (1.0F - l.opaque_metallic) * l.cloudy * brdf_.let_in(v.wo.z());
  // As bright as what leaves again, against all that scatters.
  const Color& albedo = l.inside.albedo;
  const float in = part * std::max(albedo.maxCoeff(), 0.05F);
  const float other = 1.0F - l.under(v.wo.z()) + opaque * brdf_.reflectance(v.base) + v.over * l.transmission;
  return {Color::Constant(part), in / (in + other)};
}

float Bsdf::index_squared(const Vec3& wo, const Vec3& wi) const {
  if (!transmits_ || (wo.z() > 0.0F) == (wi.z() > 0.0F)) return 1.0F;
  const float n2 = layers_->glass.ior() * layers_->glass.ior();
  return wi.z() > 0.0F ? 1.0F / n2 : n2;
}

}  // namespace lagomorph::render::path
