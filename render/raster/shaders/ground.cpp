#include "render/raster/shaders/shaders.h"

namespace lagomorph::render::raster::shaders {

// The square around the disc.
const char* const ground_vertex = R"(
void main() {
  vec2 at = ground_at.xz + ground.y * (2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0);
  gl_Position = clip_from_world * vec4(at.x, ground.x, at.y, 1.0);
}
)";

// Where this pixel's ray meets the ground's plane; false where it does not.
const char* const ground_point = R"(
bool meet_ground(out vec3 x, out float depth) {
  vec3 origin, direction;
  pixel_ray(origin, direction);
  depth = (ground.x - origin.y) / direction.y;
  bool met = depth > 0.0 && depth < 1e9;
  x = origin + (met ? depth : 0.0) * direction;
  x.y = ground.x;
  return met;
}
// How far x and z go with two independent standard deviations of the path tracer's filter, a Blackman-Harris window of
// 1.5 pixels to all sides unless it is told otherwise: 0.416 pixels to the right and up [m].
mat2 ground_spread(float depth) {
  vec3 origin, direction;
  pixel_ray(origin, direction);
  vec3 right_by = 2.0 * viewport.z * right.xyz, up_by = 2.0 * viewport.w * up.xyz;  // the ray, a pixel on
  float scale = 0.416 * (eye.w > 0.5 ? 1.0 : depth);
  return mat2(scale * (right_by - right_by.y / direction.y * direction).xz,
              scale * (up_by - up_by.y / direction.y * direction).xz);
}
float ground_distance(vec3 x) { return length(x.xz - ground_at.xz); }
float ground_fade(vec3 x) {
  float t = clamp((ground_distance(x) - ground.z) / (ground.y - ground.z), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}
// Towards the viewer.
vec3 ground_normal(vec3 v) { return vec3(0.0, v.y > 0.0 ? 1.0 : -1.0, 0.0); }
)";

// The picture without the meshes, and what they can take from the ground in it, times the part of the ground
// that does not fade: see still_parts.h. Highlights end where half floats do, so that a shadow leaves
// nothing of them.
//
// With CELLS at the corners of cells of pixels, of ground that does not fade, before nothing and of one
// colour.
const char* const still_fragment = R"(
layout(location = 0) out vec4 picture;   // CELLS: what the ground sends; w 1 where it is met
layout(location = 1) out vec4 diffuse;   // what the sky's light on the ground becomes
layout(location = 2) out vec4 mirrored;  // of the sky
#if LIGHTS > 0
layout(location = 3) out vec4 lit[LIGHTS];
#endif
layout(location = 3 + LIGHTS) out vec4 mirrored_mesh;  // what the light on a mesh before the sky becomes
const float most = 65504.0;
#ifdef CELLS
uniform bool in_texture_color;
#endif
void main() {
  vec3 origin, direction;
  pixel_ray(origin, direction);
#ifdef CELLS
  picture = vec4(0.0);
#else
  picture = vec4(background_radiance(direction), 1.0);
#endif
  diffuse = vec4(0.0);
  mirrored = vec4(0.0);
  mirrored_mesh = vec4(0.0);
#if LIGHTS > 0
  for (int i = 0; i < LIGHTS; ++i) lit[i] = vec4(0.0);
#endif
  Point p;
  float depth;
  bool met = meet_ground(p.x, depth) && ground.w > 0.5;
#ifdef CELLS
  float part = met ? 1.0 : 0.0;
#else
  float part = met ? 1.0 - ground_fade(p.x) : 0.0;
#endif
  if (part <= 0.0) return;
  vec3 v = towards_eye(p.x);
  p.normal = ground_normal(v);
  Surface surface = surfaces[0];
#ifdef CELLS
  if (in_texture_color) surface.color.rgb = texture_color.rgb;
#else
  surface.color.rgb = ground_color_at(p.x, ground_spread(depth));
#endif
  Finish finish = finish_of(surface, p.normal, v);
  SkyLight sky = sky_light(finish, p.normal, v, radiance_below_ground(p.normal));
  vec3 sent = part * sent_of_sky(finish, sky, SkySeen(vec3(1.0), vec3(1.0), 1.0));
#if LIGHTS > 0
  for (int i = 0; i < LIGHTS; ++i) {
    lit[i].rgb = min(part * sent_of_light(i, finish, p, v), most);
    sent += lit[i].rgb;
  }
#endif
#ifdef CELLS
  picture = vec4(sent, 1.0);
#else
  picture.rgb = (1.0 - part) * picture.rgb + sent;
#endif
  diffuse.rgb = min(part / PI * (finish.out_of_base * finish.coat.diffuse + finish.multiple), most);
  mirrored.rgb = min(part * finish.mirrors * sky.mirrored, most);
  mirrored_mesh.rgb = min(part * finish.mirrors * sky.mirrored_mesh, most);
}
)";

// Tiles of the picture, one beside the other in a square of 16 by 16 of them; TILE is their side [pixels].
const char* const tiles_vertex = R"(
uniform ivec2 tiles[256];
flat out vec2 tile_offset;  // [pixels]
void main() {
  vec2 slot = vec2(gl_InstanceID % 16, gl_InstanceID / 16);
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4((slot + corner) / 8.0 - 1.0, 0.0, 1.0);
  tile_offset = TILE * (vec2(tiles[gl_InstanceID]) - slot);
}
)";

// Of the picture without the meshes what has no cells: the background, and the texture's part of the ground's
// colour.
const char* const backdrop_fragment = R"(
out vec4 backdrop;
void main() {
  vec3 x, origin, direction;
  float depth;
  pixel_ray(origin, direction);
  backdrop = vec4(background_radiance(direction), 0.0);
#if GROUND_TEXTURE > 0
  if (meet_ground(x, depth)) backdrop.w = ground_texture_at(x, ground_spread(depth));
#endif
}
)";

// Irradiance on the ground of all the sky and from below.
const char* const ground_light_fragment = R"(
layout(location = 0) out vec4 open;
layout(location = 1) out vec4 from_below;
void main() {
  vec3 n = ground_normal(eye.w > 0.5 ? -forward.xyz : eye.xyz - ground_at.xyz);
  open = vec4(open_sky(n), 1.0);
  from_below = vec4(light_from_below(n, radiance_below_ground(n)), 1.0);
}
)";

// Depth only, to hide what is below; the part that fades is none of its business.
const char* const ground_cover_fragment = R"(
void main() {
  vec3 x;
  float depth;
  if (!meet_ground(x, depth) || ground_distance(x) > ground.z) discard;
}
)";

const char* const ground_depth_fragment = R"(
out float depth;
void main() {
  vec3 x;
  if (!meet_ground(x, depth) || ground_distance(x) > ground.y) discard;
}
)";

// On the square of ground under the meshes: the radiance sent up, of squares of two by two of the map's
// texels, for from above it is seen blurred.
const char* const ground_map_fragment = R"(
layout(binding = 1) uniform sampler2DArray seen_of_texel;  // of lights and sky
layout(location = 0) out vec4 bounce;
vec4 seen_here(int layer) {
  ivec3 at = ivec3(2 * ivec2(gl_FragCoord.xy), layer);
  return 0.25 * (texelFetch(seen_of_texel, at, 0) + texelFetch(seen_of_texel, at + ivec3(1, 0, 0), 0) +
                 texelFetch(seen_of_texel, at + ivec3(0, 1, 0), 0) + texelFetch(seen_of_texel, at + ivec3(1, 1, 0), 0));
}
void main() {
  vec2 at = 2.0 * gl_FragCoord.xy / counts.w;
  vec3 x = vec3((at.x - ground_map.z) / ground_map.x, ground.x, (at.y - ground_map.w) / ground_map.x);
  vec3 n = vec3(0.0, 1.0, 0.0);
  vec4 lights_seen = seen_here(0);
  vec3 light = ambient_light(open_sky(n), seen_here(1).rgb, vec3(0.0), mesh_albedo.rgb);
  for (int i = 0; i < int(counts.x); ++i) {
    vec3 direction;
    light += lights[i].radiance.rgb * rectangle_irradiance(lights[i], x, n, direction) * lights_seen[i];
  }
  bounce = vec4(ground_color_at(x, mat2(2.0 * ground_map.y / sqrt(12.0))) / PI * light, 1.0);  // a metal's too, spread
}
)";

}  // namespace lagomorph::render::raster::shaders
