#pragma once

#include <array>

#include "render/render_scene.h"

/// What the shaders read of a frame: the uniform block `Frame` of shaders/frame.cpp, in std140 layout
/// (everything is a vec4 or a mat4, so that both sides agree).
namespace lagomorph::render::raster {

using Vec4 = Eigen::Matrix<float, 4, 1, Eigen::DontAlign>;
using Mat4Column = Eigen::Matrix<float, 4, 4, Eigen::ColMajor | Eigen::DontAlign>;

inline Vec4 vec4(const Vec3& v, float w) { return {v.x(), v.y(), v.z(), w}; }
inline Vec4 vec4(const Color& c, float w) { return {c.x(), c.y(), c.z(), w}; }

constexpr int most_lights = 4;
constexpr int most_sky_directions = 16;

struct LightBlock {
  Vec4 position;  // xyz [m]
  Vec4 right;     // xyz unit, w half the width [m]
  Vec4 up;        // xyz unit, w half the height [m]
  Vec4 normal;    // xyz unit; w solid angle of what is so far that it is the same everywhere, a sun; 0
                  // otherwise [sr]
  Vec4 radiance;  // rgb [W/(sr m^2)], w 1 for a sun whose disc is seen in the sky
  Vec4 map;       // tangents (x/z, y/z) to the shadow map's [0, 1]: scale xy, offset zw
  Vec4 depth;  // 1/z = d x + y of a depth d in the map; z: the largest 1/z of a caster; w: least height of a
               // blocker above the receiver's plane [m]
};

struct SkyDirectionBlock {
  Vec4 right;      // xyz unit
  Vec4 up;         // xyz unit
  Vec4 direction;  // xyz unit, towards the sky; of a map, w tangent of the angle that it stands for
  Vec4 radiance;   // rgb of the sky there, or of a map the light of all that it stands for
};

/// A row of the shaders' table of surfaces (std430).
struct SurfaceBlock {
  Vec4 color;   // base colour, or radiance of a light; w 1 for a light, -1 where rays show what is mirrored
  Vec4 finish;  // roughness, metallic, the dielectric's f0, opacity
  Vec4 albedo;  // rgb, to tell it by, see render::albedo()
  Vec4 sheen;   // rgb; w its row in the table of sheens, in [0, 1]
};

struct FrameBlock {
  Mat4Column clip_from_world;
  Vec4 eye;             // xyz [m], w 1 for an orthographic camera
  Vec4 forward;         // xyz unit
  Vec4 right;           // xyz, half the view's width long (at depth 1 when perspective)
  Vec4 up;              // xyz, half the view's height long
  Vec4 viewport;        // width, height [pixels] and their reciprocals
  Vec4 zenith;          // rgb, with the sky's strength
  Vec4 horizon;         // rgb, likewise
  Vec4 background;      // rgb, w 1 where it is a colour, 0 where it is the sky
  Vec4 ground;          // height, radius, fade_start [m], 1 where there is ground
  Vec4 ground_at;       // xyz centre [m]
  Vec4 ground_texture;  // side of a square, width of lines [m]
  Vec4 texture_color;   // rgb, of its other squares or lines
  Vec4 ground_map;      // world xz to the ground map's [0, 1]: scale x, offset zw; y: size of a texel [m]
  Vec4 sky_map;         // xyz centre [m], w 1 / radius of the meshes' sphere [1/m]
  Vec4 counts;          // lights, 0, 1 where there are meshes, size of the ground map
  Vec4 sky_picture;     // of a map: turns of its middle from -z, level of detail at a pixel, strength
  Vec4 mesh_albedo;     // rgb, the mean of the meshes'
  std::array<LightBlock, most_lights> lights;
  std::array<SkyDirectionBlock, most_sky_directions> sky;
};

}  // namespace lagomorph::render::raster
