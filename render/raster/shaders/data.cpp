#include "render/raster/shaders/shaders.h"

namespace lagomorph::render::raster::shaders {

// What DataPass reads of a pixel.
const char* const data_outputs = R"(
uniform mat4 clip_before;  // of the camera at the frame before
layout(location = 0) out vec4 position_and_triangle;
layout(location = 1) out vec4 normal_and_motion_x;
layout(location = 2) out vec4 albedo_and_motion_y;

// In pixels, y up, from the picture's middle.
vec2 seen_at(mat4 clip, vec3 x) {
  vec4 c = clip * vec4(x, 1.0);
  return 0.5 * viewport.xy * c.xy / c.w;
}
void put(vec3 x, vec3 before_x, float triangle, vec3 n, vec3 albedo) {
  vec2 motion = seen_at(clip_from_world, x) - seen_at(clip_before, before_x);
  position_and_triangle = vec4(x, triangle);
  normal_and_motion_x = vec4(n, motion.x);
  albedo_and_motion_y = vec4(albedo, motion.y);
}
)";

const char* const data_fragment = R"(
in vec3 world;
in vec3 before;
in vec3 smooth_normal;
uniform uint surface;
uniform bool is_smooth;
#ifdef COLORS
in vec3 vertex_color;
uniform bool is_colored;
#endif
void main() {
  vec3 n = is_smooth ? (gl_FrontFacing ? smooth_normal : -smooth_normal) : cross(dFdx(world), dFdy(world));
  vec3 albedo = surfaces[surface].albedo.rgb;
#ifdef COLORS
  if (is_colored) albedo = clamp(vertex_color, 0.0, 1.0);
#endif
  put(world, before, float(gl_PrimitiveID), normalize(n), albedo);
}
)";

const char* const ground_data_fragment = R"(
void main() {
  vec3 x;
  float depth;
  if (!meet_ground(x, depth) || ground_distance(x) > ground.y) discard;
  put(x, x, -1.0, vec3(0.0, towards_eye(x).y > 0.0 ? 1.0 : -1.0, 0.0), ground_color_at(x, mat2(0.0)));
}
)";

// How much of a pixel meshes and visible lights cover, and in the rest the ground as it is opaque. Behind the
// ground's fading edge they are seen as much as the ground is not.
const char* const alpha_fragment = R"(
#if SAMPLES > 1
layout(binding = 6) uniform usampler2DMS seen_samples;
#else
layout(binding = 6) uniform usampler2D seen_samples;
#endif
#ifdef PEEL
layout(binding = 13) uniform sampler2D peeled;
#endif
uniform bool catches_shadows;  // the ground's part is put in later
out float alpha;
void main() {
  float covered = 0.0;
  for (int s = 0; s < SAMPLES; ++s)
    covered += texelFetch(seen_samples, ivec2(gl_FragCoord.xy), s).w != 0u ? 1.0 / float(SAMPLES) : 0.0;
  vec3 x;
  float depth;
  bool on_floor = !catches_shadows && ground.w > 0.5 && meet_ground(x, depth);
  float floor_part = on_floor ? 1.0 - ground_fade(x) : 0.0;
  alpha = covered + (1.0 - covered) * floor_part;
#ifdef PEEL
  alpha += (1.0 - alpha) * texelFetch(peeled, ivec2(gl_FragCoord.xy), 0).w;
#endif
}
)";

}  // namespace lagomorph::render::raster::shaders
