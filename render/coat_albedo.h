#pragma once

namespace lagomorph::render {

/// What the coat reflects of light that comes alike from all over: f0 * scale + f90 * offset (the split sum
/// of [Karis 2013]), GGX with Smith's height-correlated masking.
struct CoatAlbedo {
  float scale, offset;
};
CoatAlbedo coat_albedo(float cos_view, float roughness);
}  // namespace lagomorph::render
