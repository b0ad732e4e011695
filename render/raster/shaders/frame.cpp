#include "render/raster/shaders/shaders.h"

namespace lagomorph::render::raster::shaders {

// The block is FrameBlock of frame_block.h.
const char* const frame = R"(
const float PI = 3.14159265;

struct Light {
  vec4 position, right, up, normal, radiance, map, depth;
};
struct SkyDirection {
  vec4 right, up, direction, radiance;
};
struct Surface {
  vec4 color;   // base colour, or radiance of a light; w 1 for a light
  vec4 finish;  // roughness, metallic, the dielectric's f0, opacity
  vec4 albedo;  // rgb, for the channel
  vec4 sheen;   // rgb; w its row in sheen_table
};
layout(std140, binding = 0) uniform Frame {
  mat4 clip_from_world;
  vec4 eye, forward, right, up, viewport;
  vec4 zenith, horizon, background;
  vec4 ground, ground_at, ground_texture, texture_color, ground_map;
  vec4 sky_map;
  vec4 counts;
  vec4 sky_picture;
  vec4 mesh_albedo;
  Light lights[4];
  SkyDirection sky_directions[16];
};

layout(std430, binding = 0) readonly buffer Surfaces { Surface surfaces[]; };  // the ground's is the first

#ifdef FRAGMENT
#ifndef AT_PIXEL
#define AT_PIXEL gl_FragCoord.xy
#endif
// The camera's ray through this pixel's centre; the direction has length 1 along the view axis.
void pixel_ray(out vec3 origin, out vec3 direction) {
  vec2 p = 2.0 * AT_PIXEL * viewport.zw - 1.0;
  vec3 across = p.x * right.xyz + p.y * up.xyz;
  bool parallel_rays = eye.w > 0.5;
  origin = eye.xyz + (parallel_rays ? across : vec3(0.0));
  direction = parallel_rays ? forward.xyz : forward.xyz + across;
}

// Unit vector from a point to the camera.
vec3 towards_eye(vec3 x) { return eye.w > 0.5 ? -forward.xyz : normalize(eye.xyz - x); }

// Size of a pixel at a depth along the view axis [m].
float pixel_footprint(float depth) {
  return 2.0 * length(up.xyz) * viewport.w * (eye.w > 0.5 ? 1.0 : depth);
}

// The mirrored view, of a normal that is bent as little as needed for v to be above the surface.
vec3 mirrored_view(vec3 v, vec3 n) {
  const float least = 1e-3;
  float cosine = dot(n, v);
  return reflect(-v, cosine < least ? normalize(n + (least - cosine) * v) : n);
}
#endif
)";

}  // namespace lagomorph::render::raster::shaders
