#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/raster/frame_block.h"

/// What points of surfaces see of the lights and the sky through depth maps, which OpenGL draws: eight by two
/// pixels at a time, for the software rasterizer takes ten times as long to look a texel up. The same bits on
/// every processor.
namespace lagomorph::render::raster {

constexpr int block_width = 8, block_height = 2;   // pixels
constexpr int lanes = block_width * block_height;  // four quads, pixel (x, y) of quad q in lane 4 q + 2 y + x
using Lanes = std::array<float, lanes>;
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

/// Points with their surfaces. Pixels of a quad share what they sample where their depths are alike.
struct alignas(64) Receivers {
  Lanes3 point;                  // [m]
  Lanes3 flat_normal;            // of the triangle
  Lanes3 normal;                 // to shade with
  Lanes3 mirrored;               // the view's mirror image, of a sky that is a map
  Lanes roughness;               // likewise
  Lanes depth;                   // along the view axis [m]
  Lanes footprint;               // size of a pixel there [m]
  std::array<int, lanes> there;  // 0: nothing; its other values are finite all the same
};

/// Rows from below, depths from 0 to 1 in steps of 1 / no_depth: half the memory of floats, which is what
/// looking them up takes its time for.
using DepthMap = std::vector<std::uint16_t>;
constexpr std::uint16_t no_depth = 65535;  // nothing is there

/// Those of one frame.
struct DepthMaps {
  int light_size = 0;            // [texels]
  std::vector<DepthMap> lights;  // one a light
  int sky_size = 0;
  std::vector<DepthMap> sky;  // one a direction; none: there are no meshes
  bool see_through = false;   // some meshes are drawn as dots, see see_through_depth_map_fragment
  bool sky_is_map = false;
};

/// Part of the light's rectangle that each point sees on its triangle's plane: percentage-closer soft shadows
/// [Fernando 2005] with the light's own rectangle for a filter. Seen from the light's centre, a point at
/// tangents t and distance z, and the rectangle's point s: what lies between them at distance b appears at t
/// + s (1/b - 1/z). So reciprocal distances, which the depth map holds up to a scale, are averaged. A texel
/// blocks if the surface that it saw is nearer than the receiver and above the receiver's plane: no surface
/// can shadow itself by the map's resolution, and nothing needs to be pushed away from the light.
void light_visibility(const FrameBlock&, const DepthMaps&, int light, const Receivers&, Lanes& seen);

/// Part of the sky's light that the meshes leave: of what falls on the surface, and of what is mirrored.
struct SkySeen {
  Lanes3 diffuse, mirrored;
};
/// Through the middle of each direction's part of the sky.
void sky_seen(const FrameBlock&, const DepthMaps&, const Receivers&, SkySeen&);
/// The same (but for the mirrored) where a plane would show the edges of each direction's shadow: a direction
/// stands for all within some 20 degrees of it, and what hides it is looked for, then measured, within the
/// spread that they have at its distance.
void sky_seen_softly(const FrameBlock&, const DepthMaps&, const Receivers&, SkySeen&);

}  // namespace lagomorph::render::raster
