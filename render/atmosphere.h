#pragma once

#include "render/render_scene.h"

namespace lagomorph::render {

/// A clear sky and its sun: single scattering of sunlight by air and haze around a round Earth, with ozone
/// [Nishita et al. 1993, "Display of the Earth taking into account atmospheric scattering"; coefficients of
/// Rayleigh and ozone at 680, 550 and 440 nm as in Bruneton and Neyret 2008 and Hillaire 2020]. Light that is
/// scattered twice and more is left out, so that the real sky is a little brighter and whiter near the
/// horizon.
struct Atmosphere {
  float elevation = 35.0F;  // of the sun above the horizon [degrees], in [-5, 90]
  float azimuth = 60.0F;    // of the sun [degrees]: 0 is -z, 90 is +x
  float turbidity = 3.0F;   // 1: air without haze, 10: hazy
};

/// Radiance and sunlight for a sun of irradiance 1 above the air. Below the horizon the map goes on as at it.
SkyMap atmosphere_map(const Atmosphere&, int width = 256, int height = 128);
/// The sun as it is seen from the ground: its direction, and its irradiance as a colour.
Sun atmosphere_sun(const Atmosphere&);

}  // namespace lagomorph::render
