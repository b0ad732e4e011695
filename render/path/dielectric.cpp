#include "render/path/dielectric.h"

#include <algorithm>
#include <cmath>

#include "render/path/microfacet.h"

namespace lagomorph::render::path {
namespace {

constexpr float roughest_stand_in = 0.5F;  // alpha

float square(float x) { return x * x; }

/// 1 + 2 Lambda(w), so that G1 = 2 / (1 + this) [Heitz 2014].
float masking(const Vec3& w, float alpha) {
  return std::sqrt(1.0F + alpha * alpha * (w.x() * w.x() + w.y() * w.y()) / (w.z() * w.z()));
}

/// G2 / G1(wo): Smith's height-correlated one where light is reflected, the product where it goes through.
float masking_of_arrival(const Vec3& wo, const Vec3& wi, float alpha, bool reflected) {
  const float i = masking(wi, alpha);
  if (!reflected) return 2.0F / (1.0F + i);
  const float o = masking(wo, alpha);
  return (1.0F + o) / (o + i);
}

/// Probability of following the reflection of the part f. From outside lamps are seen in it that no other
/// sample finds where the surface is smooth.
float reflection_pick(float f, bool outside) { return outside ? std::max(f, 0.15F) : f; }

/// Part of the light along a cosine that single scattering lets go, over a lattice of visible normals.
float directional_albedo(float cosine, float alpha, float eta) {
  constexpr int samples = 256;
  constexpr double golden = 0.61803398874989485;
  const float c = std::max(cosine, 1e-3F);
  const Vec3 wo(std::sqrt(1.0F - c * c), 0.0F, c);
  double sum = 0.0;
  for (int k = 0; k < samples; ++k) {
    const double u = golden * k;
    const Pair s{static_cast<float>(u - std::floor(u)), (static_cast<float>(k) + 0.5F) / samples};
    const Vec3 h = sample_visible_normal(wo, alpha, s);
    const float f = fresnel(std::max(wo.dot(h), 0.0F), eta);
    const Vec3 back = reflected(wo, h);
    if (back.z() > 0.0F) sum += f * masking_of_arrival(wo, back, alpha, true);
    if (f >= 1.0F) continue;
    const Vec3 on = refracted(wo, h, eta);
    if (on.z() < 0.0F) sum += (1.0F - f) * masking_of_arrival(wo, on, alpha, false);
  }
  return static_cast<float>(sum / samples);
}

}  // namespace

Vec3 reflected(const Vec3& wo, const Vec3& h) { return 2.0F * wo.dot(h) * h - wo; }

Vec3 refracted(const Vec3& wo, const Vec3& h, float eta) {
  const float c = wo.dot(h);
  const float sine2 = (1.0F - c * c) / (eta * eta);
  if (sine2 >= 1.0F) return Vec3::Zero();
  return (c / eta - std::sqrt(1.0F - sine2)) * h - wo / eta;
}

float fresnel(float cosine, float eta) {
  const float sine2 = (1.0F - cosine * cosine) / (eta * eta);
  if (sine2 >= 1.0F) return 1.0F;
  const float behind = std::sqrt(1.0F - sine2);
  const float s = (cosine - eta * behind) / (cosine + eta * behind);
  const float p = (eta * cosine - behind) / (eta * cosine + behind);
  return 0.5F * (s * s + p * p);
}

Dielectric::Dielectric(float ior, float roughness)
    : ior_(std::max(ior, 1.001F)), alpha_(std::max(square(roughness), 1e-3F)), through_(0.0F) {
  for (int k = 0; k < intervals; ++k) {
    const float c = (static_cast<float>(k) + 0.5F) / intervals;
    through_ += 2.0F * c * (1.0F - fresnel(c, ior_)) / intervals;
  }
  for (int side = 0; side < 2; ++side) {
    const float eta = side == 0 ? ior_ : 1.0F / ior_;
    for (int level = 0; level < levels; ++level) {
      Table& table = lost_[side][level];
      for (int i = 0; i <= intervals; ++i) {
        const float albedo = directional_albedo(static_cast<float>(i) / intervals, alpha_of(level), eta);
        table[i] = std::max(1.0F - albedo, 0.0F);
      }
      // Of the table as it is read, linear between its entries.
      double mean = 0.0;
      for (int i = 0; i < intervals; ++i) {
        const double c0 = static_cast<double>(i) / intervals;
        const double c1 = static_cast<double>(i + 1) / intervals;
        const double middle = 0.25 * (static_cast<double>(table[i]) + table[i + 1]) * (c0 + c1);
        mean += (c0 * table[i] + 4.0 * middle + c1 * table[i + 1]) / (3.0 * intervals);
      }
      mean_lost_[side][level] = static_cast<float>(mean);
    }
  }
}

float Dielectric::alpha_of(int level) const {
  return alpha_ + static_cast<float>(level) / (levels - 1) * (std::max(alpha_, roughest_stand_in) - alpha_);
}

float Dielectric::lost(int side, float cosine, float level) const {
  const float x = std::min(cosine, 0x1.fffffep-1F) * intervals;
  const int i = static_cast<int>(x);
  const float t = x - static_cast<float>(i);
  const int k = std::min(static_cast<int>(level), levels - 2);
  const float s = level - static_cast<float>(k);
  const Table& a = lost_[side][k];
  const Table& b = lost_[side][k + 1];
  const float low = a[i] + t * (a[i + 1] - a[i]);
  const float high = b[i] + t * (b[i + 1] - b[i]);
  return low + s * (high - low);
}

Dielectric::View Dielectric::view(const Vec3& wo, float least_alpha) const {
  View v{};
  v.wo = wo;
  v.alpha = std::max(alpha_, std::min(least_alpha, roughest_stand_in));
  const float range = std::max(alpha_, roughest_stand_in) - alpha_;
  v.level = range > 0.0F ? (v.alpha - alpha_) / range * (levels - 1) : 0.0F;
  const int side = wo.z() > 0.0F ? 0 : 1;
  const int k = std::min(static_cast<int>(v.level), levels - 2);
  const float s = v.level - static_cast<float>(k);
  for (int m = 0; m < 2; ++m)
    v.mean_lost[m] = mean_lost_[m][k] + s * (mean_lost_[m][k + 1] - mean_lost_[m][k]);
  const float outside = v.mean_lost[0];
  const float inside = v.mean_lost[1] * ior_ * ior_;  // times n^2
  if (outside <= 1e-7F || inside <= 1e-7F) return v;  // nothing to speak of is lost
  v.lost = lost(side, std::abs(wo.z()), v.level);
  const float in = std::min(through_, inside / outside);
  v.multiple_through = side == 0 ? in : in * outside / inside;
  return v;
}

/// Through or off the microfacet h, whose normal is on wo's side. All with wo.z > 0.
Brdf::Value Dielectric::scatter_once(const View& view, const Vec3& wi_given, const Vec3& h) const {
  const bool outside = view.wo.z() > 0.0F;
  const Vec3 wo = outside ? view.wo : mirrored(view.wo);
  const Vec3 wi = outside ? wi_given : mirrored(wi_given);
  const float eta = outside ? ior_ : 1.0F / ior_;
  const float oh = wo.dot(h);
  const float ih = wi.dot(h);
  const bool back = wi.z() > 0.0F;
  if (oh <= 0.0F || h.z() <= 0.0F || (back ? ih <= 0.0F : ih >= 0.0F)) return {};
  const float f = fresnel(std::min(oh, 1.0F), eta);
  const float part = back ? f : 1.0F - f;
  if (part <= 0.0F) return {};
  // Density of h, of wi where h is the visible normal [Walter et al. 2007, Eqs. 14, 17].
  const float normals = 2.0F / (1.0F + masking(wo, view.alpha)) * oh * ggx(h, view.alpha) / wo.z();
  const float jacobian = back ? 0.25F / oh : eta * eta * -ih / square(oh + eta * ih);
  const float pick = reflection_pick(f, outside);
  const float pdf = (back ? pick : 1.0F - pick) * normals * jacobian;
  const float scale = back ? 1.0F : 1.0F / (eta * eta);
  const float f_cos = part * normals * jacobian * masking_of_arrival(wo, wi, view.alpha, back) * scale;
  return {Color::Constant(f_cos), pdf};
}

Brdf::Value Dielectric::scatter_often(const View& view, const Vec3& wi) const {
  if (view.lost <= 0.0F) return {};
  const bool outside = view.wo.z() > 0.0F;
  const bool back = (wi.z() > 0.0F) == outside;
  const int side = wi.z() > 0.0F ? 0 : 1;
  const float cosine = std::abs(wi.z());
  const float share = back ? 1.0F - view.multiple_through : view.multiple_through;
  const float pdf = share * cosine * inv_pi;
  const float n = outside ? ior_ : 1.0F / ior_;
  const float scale = back ? 1.0F : 1.0F / (n * n);
  return {Color::Constant(view.lost * pdf * lost(side, cosine, view.level) / view.mean_lost[side] * scale),
          pdf};
}

Brdf::Value Dielectric::evaluate(const View& view, const Vec3& wi) const {
  if (view.wo.z() == 0.0F || wi.z() == 0.0F) return {};
  const bool outside = view.wo.z() > 0.0F;
  const bool back = (wi.z() > 0.0F) == outside;
  Vec3 h = back ? Vec3(view.wo + wi) : Vec3(view.wo + (outside ? ior_ : 1.0F / ior_) * wi);
  if (!outside) h = mirrored(h);
  if (h.z() < 0.0F) h = -h;
  const Brdf::Value once = scatter_once(view, wi, h.normalized());
  const Brdf::Value often = scatter_often(view, wi);
  return {once.f_cos + often.f_cos, (1.0F - view.lost) * once.pdf + view.lost * often.pdf};
}

Brdf::Sample Dielectric::sample(const View& view, Pair s, Pair choice) const {
  if (view.wo.z() == 0.0F) return {Vec3::UnitZ(), {}};
  const bool outside = view.wo.z() > 0.0F;
  const Vec3 wo = outside ? view.wo : mirrored(view.wo);
  Vec3 wi;
  if (choice.u < view.lost) {
    wi = sample_cosine(s);
    if (choice.v < view.multiple_through) wi = mirrored(wi);
    if (!outside) wi = mirrored(wi);
    return {wi, evaluate(view, wi)};
  }
  const float eta = outside ? ior_ : 1.0F / ior_;
  const Vec3 h = sample_visible_normal(wo, view.alpha, s);
  const float oh = wo.dot(h);
  if (oh <= 0.0F) return {Vec3::UnitZ(), {}};
  const bool back = choice.v < reflection_pick(fresnel(std::min(oh, 1.0F), eta), outside);
  wi = back ? reflected(wo, h) : refracted(wo, h, eta);
  if (back ? wi.z() <= 0.0F : wi.z() >= 0.0F) return {Vec3::UnitZ(), {}};
  wi.normalize();
  if (!outside) wi = mirrored(wi);
  // With h as it is: near an index of 1 it cannot be had back from the directions.
  const Brdf::Value once = scatter_once(view, wi, h);
  if (once.pdf <= 0.0F) return {wi, {}};
  const Brdf::Value often = scatter_often(view, wi);
  return {wi, {once.f_cos + often.f_cos, (1.0F - view.lost) * once.pdf + view.lost * often.pdf}};
}

}  // namespace lagomorph::render::path
