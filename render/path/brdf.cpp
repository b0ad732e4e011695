#include "render/path/brdf.h"

#include <algorithm>
#include <cmath>

#include "render/path/microfacet.h"

namespace lagomorph::render::path {
namespace {

float pow5(float x) {
  const float x2 = x * x;
  return x2 * x2 * x;
}

float luminance(const Color& c) { return 0.2126F * c.x() + 0.7152F * c.y() + 0.0722F * c.z(); }

/// cos_w (1 + 2 Lambda(w)) = sqrt(alpha^2 sin^2 + cos^2).
float smith_root(const Vec3& w, float alpha) {
  return std::sqrt(alpha * alpha * (w.x() * w.x() + w.y() * w.y()) + w.z() * w.z());
}

}  // namespace

Brdf::Brdf(const Material& m, float base_share) : metallic_(m.metallic), base_share_(base_share) {
  const float r = (m.ior - 1.0F) / (m.ior + 1.0F);
  coat_f0_ = r * r;
  coat_f90_ = std::min(1.0F, 50.0F * coat_f0_);
  alpha_ = std::max(m.roughness * m.roughness, 1e-3F);  // sharper is a mirror but for what float resolves
  for (int i = 0; i <= intervals; ++i) {
    const float cosine = static_cast<float>(i) / intervals;
    CoatAlbedo& a = albedo_[static_cast<std::size_t>(i)];
    a = coat_albedo(cosine, m.roughness);
    mean_into_base_ += 2.0F * into_base(a) * cosine * (i == intervals ? 0.5F : 1.0F) / intervals;
  }
  tint_ = tint(m.base_color);
}

Brdf::Tint Brdf::tint(const Color& base_color) const {
  const Color f0 = (1.0F - metallic_) * Color::Constant(coat_f0_) + metallic_ * base_color;
  return {(1.0F - metallic_) * inv_pi / mean_into_base_ * base_color * base_share_, f0,
          std::min(1.0F, 50.0F * f0.maxCoeff())};
}

CoatAlbedo Brdf::albedo(float cosine) const {
  const float x = std::min(cosine, 0x1.fffffep-1F) * intervals;
  const int i = static_cast<int>(x);
  const float t = x - static_cast<float>(i);
  const CoatAlbedo& a = albedo_[static_cast<std::size_t>(i)];
  const CoatAlbedo& b = albedo_[static_cast<std::size_t>(i) + 1];
  return {a.scale + t * (b.scale - a.scale), a.offset + t * (b.offset - a.offset)};
}

Brdf::View Brdf::view(const Vec3& wo, float least_alpha, const Color* base_color) const {
  const Tint t = base_color == nullptr ? tint_ : tint(*base_color);
  const CoatAlbedo a = albedo(std::max(wo.z(), 0.0F));
  const Color base = t.base * into_base(a);
  const float coat = luminance(t.f0) * a.scale + t.f90 * a.offset;
  const float all = coat + std::numbers::pi_v<float> * luminance(base);
  const float alpha = std::max(alpha_, least_alpha);
  return {wo, base, t.f0, t.f90, all > 0.0F ? coat / all : 0.0F, alpha, smith_root(wo, alpha), all};
}

Brdf::Value Brdf::evaluate(const View& view, const Vec3& wi) const {
  const Vec3& wo = view.wo;
  if (wi.z() <= 0.0F || wo.z() <= 0.0F) return {};
  const Vec3 h = (wo + wi).normalized();
  const float d = ggx(h, view.alpha);
  const float visibility = 0.5F / (wo.z() * smith_root(wi, view.alpha) + wi.z() * view.root);
  const Color coat =
      (view.f0 + (view.f90 - view.f0) * pow5(1.0F - std::min(wo.dot(h), 1.0F))) * (d * visibility);
  const Color base = view.base * into_base(albedo(wi.z()));
  // Density of reflecting at a visible normal: G1(o) D / (4 cos_o), G1 = 2 cos_o / (cos_o + root).
  const float coat_pdf = d / (2.0F * (wo.z() + view.root));
  const float p = view.coat_probability;
  return {(base + coat) * wi.z(), p * coat_pdf + (1.0F - p) * wi.z() * inv_pi};
}

Brdf::Sample Brdf::sample(const View& view, Pair s) const {
  const float p = view.coat_probability;
  Vec3 wi;
  if (s.u < p) {
    const Vec3 h = sample_visible_normal(view.wo, view.alpha, {s.u / p, s.v});
    wi = 2.0F * view.wo.dot(h) * h - view.wo;
  } else {
    wi = sample_cosine({std::min((s.u - p) / (1.0F - p), 0x1.fffffep-1F), s.v});
  }
  return {wi, evaluate(view, wi)};
}

Vec3 sample_visible_normal(const Vec3& wo, float alpha, Pair s) {
  const Vec3 stretched = Vec3(alpha * wo.x(), alpha * wo.y(), wo.z()).normalized();
  const float phi = 2.0F * std::numbers::pi_v<float> * s.u;
  const float z = (1.0F - s.v) * (1.0F + stretched.z()) - stretched.z();
  const float radius = std::sqrt(std::clamp(1.0F - z * z, 0.0F, 1.0F));
  const Vec3 h = Vec3(radius * std::cos(phi), radius * std::sin(phi), z) + stretched;
  return Vec3(alpha * h.x(), alpha * h.y(), std::max(h.z(), 1e-7F)).normalized();
}

Vec3 sample_cosine(Pair s) {
  const float radius = std::sqrt(s.u);
  const float phi = 2.0F * std::numbers::pi_v<float> * s.v;
  return {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(std::max(1.0F - s.u, 0.0F))};
}

void make_frame(const Vec3& n, Vec3& t, Vec3& b) {
  const float sign = std::copysign(1.0F, n.z());
  const float a = -1.0F / (sign + n.z());
  const float c = n.x() * n.y() * a;
  t = Vec3(1.0F + sign * n.x() * n.x() * a, sign * c, -sign * n.x());
  b = Vec3(c, sign + n.y() * n.y() * a, -n.y());
}

}  // namespace lagomorph::render::path
