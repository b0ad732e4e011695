#pragma once

#include "render/render_scene.h"

namespace lagomorph::render::path {

/// Beer and Lambert's law: what a clear inside lets through, color^(d / distance).
class Absorption {
public:
  explicit Absorption(const Material&);
  bool is_clear() const { return is_clear_; }
  Color transmittance(float distance) const { return (-distance * coefficient_).exp(); }

private:
  Color coefficient_;  // [1/m]
  bool is_clear_;
};

/// A cloudy inside: isotropic scattering, by colour.
struct CloudyInside {
  explicit CloudyInside(const Material&);
  Color extinction;  // [1/m], 1 / mean free path
  Color albedo;      // of a single scattering
};

/// Albedo of a single isotropic scattering with which a half space reflects the part `reflectance` of light
/// that enters it spread as the cosine: van de Hulst's A = (1 - s)(1 - 0.139 s) / (1 + 1.17 s) with
/// s^2 = 1 - albedo [van de Hulst 1980], inverted [Kulla and Conty 2017].
float scattering_albedo(float reflectance);

}  // namespace lagomorph::render::path
