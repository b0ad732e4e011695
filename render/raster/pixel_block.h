#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/render_scene.h"
#include "render/simd.h"

/// Four quads of two by two pixels at a time, a lane each: what points of surfaces see of the lights and the
/// sky through depth maps, which OpenGL draws, is found on the CPU, for the software rasterizer takes ten
/// times as long to look a texel up. The same bits on every processor.
namespace lagomorph::render::raster {

constexpr int quad = 4, quads = 4;  // pixel (x, y) of quad q in lane 4 q + 2 y + x
constexpr int lanes = quad * quads;
using Lanes = std::array<float, lanes>;
using LaneBits = std::uint16_t;  // 1 << lane
struct alignas(64) Lanes3 {
  Lanes x, y, z;
  Vec3 at(int lane) const {
    const auto i = static_cast<std::size_t>(lane);
    return {x[i], y[i], z[i]};
  }
  void set(int lane, const Vec3& v) {
    const auto i = static_cast<std::size_t>(lane);
    x[i] = v.x(), y[i] = v.y(), z[i] = v.z();
  }
};

/// Difference in depth within which a surface goes on from a pixel to its neighbours [footprints].
constexpr float one_surface = 10.0F;

/// Of a lane in its quad, from below.
constexpr int row(int lane) { return (lane >> 1) & 1; }

/// Points with their surfaces.
struct alignas(64) Receivers {
  Lanes3 point;                  // [m]
  Lanes3 normal;                 // to shade with
  Lanes3 mirrored;               // the view's mirror image
  Lanes raised;                  // of the smooth surface above the triangle [m]
  Lanes roughness;               // of the mirror
  Lanes depth;                   // along the view axis [m]; pixels share what they sample where it is alike
  Lanes footprint;               // size of a pixel there [m]
  std::array<int, lanes> there;  // 0: nothing; its other values are finite all the same
  bool is_ground = false;        // a plane, which nothing of itself is above
};

/// Without a branch.
LAGOMORPH_INLINE bool both(bool a, bool b) { return (static_cast<int>(a) & static_cast<int>(b)) != 0; }

LAGOMORPH_INLINE bool any(const std::array<int, lanes>& mask) {
  int sum = 0;
  for (const int m : mask) sum |= m;
  return sum != 0;
}

}  // namespace lagomorph::render::raster
