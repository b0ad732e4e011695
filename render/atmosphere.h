#pragma once

#include "render/render_scene.h"

namespace lagomorph::render {

/// A clear sky and its sun: sunlight scattered by air and haze around a round Earth, with ozone and a ground
/// of albedo 0.3: once as by [Nishita et al. 1993, "Display of the Earth taking into account atmospheric
/// scattering"], twice and more as if from all sides alike [Hillaire 2020, "A scalable and production ready
/// sky and atmosphere rendering technique"]. Coefficients of Rayleigh and ozone at 680, 550 and 440 nm as in
/// Bruneton and Neyret 2008 and Hillaire 2020.
struct Atmosphere {
  float elevation = 35.0F;  // of the sun above the horizon [degrees], in [-5, 90]
  float azimuth = 60.0F;    // of the sun [degrees]: 0 is -z, 90 is +x
  float turbidity = 3.0F;   // 1: air without haze, 10: hazy
};

/// Radiance and sunlight for a sun of irradiance 1 above the air. Below the horizon the map goes on as at it.
SkyMap atmosphere_map(const Atmosphere&, int width = 512, int height = 256);
/// The sun as it is seen from the ground: its direction, and its irradiance as a colour.
Sun atmosphere_sun(const Atmosphere&);

}  // namespace lagomorph::render
