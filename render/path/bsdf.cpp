#include "render/path/bsdf.h"

#include <algorithm>
#include <cmath>

#include "render/albedo.h"
#include "render/path/microfacet.h"
#include "render/path/sampler.h"

namespace lagomorph::render::path {
/// Part of the light along a cosine that layers do not let out of the base below, and its mean over the
/// hemisphere, 2 int L c dc.
struct LayersLoss {
  CosineTable at{};
  float mean = 0.0F;
};

namespace {

/// What is not clear: of the part 1 - transmission (1 - metallic), so that it weighs as it should.
Material opaque_part(const Material& m) {
  Material opaque = m;
  const float part = 1.0F - m.transmission * (1.0F - m.metallic);
  if (part > 0.0F) opaque.metallic = std::min(m.metallic / part, 1.0F);
  return opaque;
}

Material white_base(Material m) {
  m.base_color = Color::Ones();
  return m;
}

/// `loss` of the direction out with a cosine.
template <typename Loss>
LayersLoss layers_loss(const Loss& loss) {
  LayersLoss table;
  for (int i = 0; i <= CosineTable::intervals; ++i) {
    const float z = std::max(CosineTable::cosine(i), 1e-3F);
    table.at.at[i] = std::max(loss(Vec3(std::sqrt(1.0F - z * z), 0.0F, z)), 0.0F);
    table.mean += table.at.at[i] * CosineTable::weight(i);
  }
  return table;
}

/// Mean of `value` of a path's random numbers, always the same ones.
template <typename Value>
float sampled_mean(const Value& value) {
  constexpr int count = 256;
  const FrameSamples numbers(0, 0, count);
  double sum = 0.0;
  for (int k = 0; k < count; ++k) sum += static_cast<double>(value(numbers.path(0, 0, k)));
  return static_cast<float>(sum / count);
}

Vec3 sample_hemisphere(Pair s) {
  const float sine = std::sqrt(std::max(1.0F - s.u * s.u, 0.0F));
  return {sine * std::cos(2.0F * pi * s.v), sine * std::sin(2.0F * pi * s.v), s.u};
}

}  // namespace

struct Bsdf::Layers {
  explicit Layers(const Material& m)
      : transmission(clear_part(m)),
        cloudy(m.subsurface),
        coat(m.coat),
        sheen_color(m.sheen * m.sheen_tint),
        sheen(sheen_color.maxCoeff()),
        glass(transmission > 0.0F ? m.ior : 1.5F, m.roughness),
        coat_lobe(coat_of(m)),
        sheen_lobe(m.sheen_roughness),
        absorption(m),
        inside(m),
        opaque_metallic(opaque_part(m).metallic) {
    if (coat <= 0.0F && sheen <= 0.0F) return;
    const Brdf white(opaque_part(white_base(m)), 1.0F - cloudy);
    outside_loss = layers_loss([&](const Vec3& wo) { return lost_outside(wo, white); });
    if (transmission > 0.0F)
      inside_loss = layers_loss([&](const Vec3& wo) { return lost_inside(mirrored(wo)); });
    // Of light that leaves a cloudy inside, spread as let_out: as much as enters under the layers.
    mean_under = 0.0F;
    for (int i = 1; i <= CosineTable::intervals; ++i) {
      const float cosine = CosineTable::cosine(i);
      mean_under += CosineTable::weight(i) * white.let_out(cosine) * under(cosine);
    }
  }

  /// What the terms of sheen and base lose over a white base, since less of theirs leaves along wi than
  /// arrives from wo.
  float lost_outside(const Vec3& wo, const Brdf& white) const {
    const Brdf::View base = white.view(wo);
    const Dielectric::View clear = glass.view(wo);
    const auto less = [&](float from, float to) { return std::max(from - to, 0.0F); };
    const float coats = under_coat(wo.z()), over = under(wo.z());
    return sampled_mean([&](const PathSamples& p) {
      float lost = 0.0F;
      if (transmission < 1.0F) {
        const Brdf::Sample s = white.sample(base, p.pair(0));
        if (s.value.pdf > 0.0F)
          lost +=
              (1.0F - transmission) * s.value.f_cos.y() / s.value.pdf * less(over, under(s.direction.z()));
      }
      if (transmission > 0.0F) {
        const Brdf::Sample s = glass.sample(clear, p.pair(0), p.pair(1));
        if (s.value.pdf > 0.0F && s.direction.z() > 0.0F)
          lost += transmission * s.value.f_cos.y() / s.value.pdf * less(over, under(s.direction.z()));
      }
      if (sheen > 0.0F && coat > 0.0F) {
        const Vec3 wi = sample_hemisphere(p.pair(0));
        lost += sheen * sheen_lobe.evaluate(wo, wi) * wi.z() * 2.0F * pi * less(coats, under_coat(wi.z()));
      }
      return lost;
    });
  }
  /// Likewise of light that goes out through the clear surface.
  float lost_inside(const Vec3& wo) const {
    const Dielectric::View clear = glass.view(wo);
    const float n2 = glass.ior() * glass.ior();
    return sampled_mean([&](const PathSamples& p) {
      const Brdf::Sample s = glass.sample(clear, p.pair(0), p.pair(1));
      if (s.value.pdf <= 0.0F || s.direction.z() <= 0.0F) return 0.0F;
      return transmission * s.value.f_cos.y() / n2 / s.value.pdf * (1.0F - under(s.direction.z()));
    });
  }

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
  LayersLoss outside_loss, inside_loss;
  float mean_under = 1.0F;  // 2 int let_out under c dc
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
  const LayersLoss& loss = outside ? l.outside_loss : l.inside_loss;
  float again = 0.0F;
  if (loss.mean > 0.0F) {
    const float lost = look_up(loss.at, std::abs(cosine));
    const Color opaque = base_color == nullptr ? color(brdf_.constants().base_color) : *base_color;
    const Color r = outside ? Color(l.transmission + (1.0F - l.transmission) * opaque) : Color(Color::Ones());
    const Color back = r * r * (1.0F - loss.mean) / (1.0F - r * loss.mean);
    v.again = lost * inv_pi / loss.mean * back;
    again = lost * luminance(f3(back));
  }
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
  const float all = v.coat_pick + v.sheen_pick + base + glass + again;
  if (all <= 0.0F) return v;
  v.base_pick = base / all;
  v.glass_pick = glass / all;
  v.coat_pick /= all;
  v.sheen_pick /= all;
  v.again_pick = again / all;
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
    return {Color::Constant(pdf * l.under(wi.z()) / l.mean_under * brdf_.let_out(wi.z())), pdf};
  }
  const bool outside = v.wo.z() > 0.0F;
  const bool back = (wi.z() > 0.0F) == outside;
  const float between = std::min(v.over, l.under(wi.z()));
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
  if (back && v.again_pick > 0.0F) {
    const float cosine = std::abs(wi.z());
    const float lost = look_up(outside ? l.outside_loss.at : l.inside_loss.at, cosine);
    add({Color::Constant(lost * cosine), cosine * inv_pi}, v.again, v.again_pick);
  }
  if (!back || !outside) return sum;
  if (l.coat > 0.0F) add(l.coat_lobe.evaluate(v.coat, wi), Color::Constant(l.coat), v.coat_pick);
  if (l.sheen > 0.0F) {
    const float coats = std::min(l.under_coat(v.wo.z()), l.under_coat(wi.z()));
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
      const float between = std::min(v.over, l.under(glass.direction.z())) * l.transmission;
      return {glass.direction, {between * glass.value.f_cos, glass.value.pdf}, true};
    }
    return {glass.direction, evaluate_layers(v, glass.direction), true};
  }
  const float left = lobe.u - v.glass_pick;
  if (left < v.coat_pick) {
    wi = l.coat_lobe.sample(v.coat, s).direction;
  } else if (left - v.coat_pick < v.sheen_pick) {
    wi = sample_hemisphere(s);
  } else if (left - v.coat_pick - v.sheen_pick < v.again_pick) {
    wi = sample_cosine(s);
    if (wi.z() <= 0.0F) return {wi, {}};
    if (v.wo.z() <= 0.0F) wi = mirrored(wi);
    return {wi, evaluate_layers(v, wi)};
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
