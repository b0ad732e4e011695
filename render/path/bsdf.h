#pragma once

#include <memory>

#include "render/path/brdf.h"
#include "render/path/dielectric.h"
#include "render/path/medium.h"
#include "render/path/sheen.h"

namespace lagomorph::render::path {

/// All of a material: a Brdf, and where it has them the layers of the principled material. From above,
///   f = coat + min(c(o), c(i)) sheen + min(u(o), u(i)) (t dielectric + (1 - t) brdf) + a L(o) L(i) / (pi
///   mean L)
/// with t = transmission (1 - metallic), c = 1 - the directional albedo of the coat, u = c (1 - that of the
/// sheen) (with their weights; 1 of directions inside), and L what the other terms lose over a white base on
/// the side of o and i, which the layers reflect back to it: of a base of albedo r the part
/// a = r^2 (1 - mean L) / (1 - r mean L) comes out after all, as in [Kulla and Conty 2017]. So f is
/// reciprocal and over a white base reflects exactly what arrives. Directions are unit vectors that point
/// away from the surface. The frame's z is along the normal on the side of the arrival, but where the
/// material transmits it points outside and wo may be below.
class Bsdf {
public:
  explicit Bsdf(const Material&);
  Bsdf(Bsdf&&) noexcept;
  ~Bsdf();

  bool has_layers() const { return layers_ != nullptr; }
  const Brdf& brdf() const { return brdf_; }
  bool transmits() const { return transmits_; }
  bool is_cloudy() const { return is_cloudy_; }
  const Absorption& absorption() const;
  const CloudyInside& cloudy_inside() const;

  struct View {
    Brdf::View base;
    Vec3 wo;
    bool emerging = false;  // light that leaves a cloudy inside: wo has no meaning
    float base_pick = 1.0F, glass_pick = 0.0F, coat_pick = 0.0F, sheen_pick = 0.0F;  // of sample()
    float again_pick = 0.0F;
    float over = 1.0F;            // u(wo)
    Color again = Color::Zero();  // a L(wo) / (pi mean L)
    Brdf::View coat = {};
    Dielectric::View glass = {};
  };
  /// `base_color`: in place of the material's.
  View view(const Vec3& wo, float least_alpha, const Color* base_color = nullptr) const;
  /// Of light that leaves the cloudy inside, spread as what the surface lets out.
  View emerging_view() const;

  /// Times |cos_i|; what goes through the dielectric scales radiance by n_o^2 / n_i^2.
  Brdf::Value evaluate(const View& v, const Vec3& wi) const {
    return has_layers() ? evaluate_layers(v, wi) : brdf_.evaluate(v.base, wi);
  }
  struct Sample {
    Vec3 direction;
    Brdf::Value value;   // pdf = 0: no direction, the path ends
    bool clear = false;  // by the dielectric
  };
  /// `lobe` and `choice` only matter with layers.
  Sample sample(const View&, Pair direction, Pair lobe, Pair choice) const;

  /// Light that enters the cloudy inside, spread as the cosine: the part of what arrives from wo, and the
  /// probability with which to follow it.
  struct Entry {
    Color part = Color::Zero();
    float pick = 0.0F;
  };
  Entry entry(const View&) const;
  /// n^2 of the sides of wi over wo.
  float index_squared(const Vec3& wo, const Vec3& wi) const;

private:
  struct Layers;
  Brdf::Value evaluate_layers(const View&, const Vec3& wi) const;

  Brdf brdf_;
  std::unique_ptr<const Layers> layers_;  // nullptr: there is only the Brdf
  bool transmits_ = false;
  bool is_cloudy_ = false;
};

}  // namespace lagomorph::render::path
