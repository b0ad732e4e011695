#include "render/raster/shaders/shaders.h"

namespace lagomorph::render::raster::shaders {

const char* const full_screen_vertex = R"(
void main() {
  vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(p, 0.0, 1.0);
}
)";

const char* const mesh_vertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
out vec3 world;
out vec3 smooth_normal;
void main() {
  world = position;
  smooth_normal = normal;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)";

const char* const shadow_vertex = R"(
layout(location = 0) in vec3 position;
uniform mat4 clip_from_world;
void main() { gl_Position = clip_from_world * vec4(position, 1.0); }
)";

// A square around the disc; the fragments know the disc.
const char* const ground_vertex = R"(
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  vec2 xz = ground_at.xz + ground.y * corner;
  gl_Position = clip_from_world * vec4(xz.x, ground.x, xz.y, 1.0);
}
)";

const char* const emitter_vertex = R"(
uniform int light;
void main() {
  // From the front, right and up are mirrored.
  vec2 corner = vec2(gl_VertexID >> 1, gl_VertexID & 1) * 2.0 - 1.0;
  vec3 x = lights[light].position.xyz + corner.x * lights[light].right.w * lights[light].right.xyz +
           corner.y * lights[light].up.w * lights[light].up.xyz;
  gl_Position = clip_from_world * vec4(x, 1.0);
}
)";

const char* const background_fragment = R"(
out vec4 color;
void main() {
  vec3 origin, direction;
  pixel_ray(origin, direction);
  color = vec4(background.w > 0.5 ? background.rgb : sky_radiance(normalize(direction)), 1.0);
}
)";

const char* const mesh_fragment = R"(
in vec3 world;
in vec3 smooth_normal;
out vec4 color;
uniform bool is_smooth;
void main() {
  vec3 v = towards_eye(world);
  vec3 flat_normal = normalize(cross(dFdx(world), dFdy(world)));  // towards the viewer
  vec3 n = is_smooth ? normalize(gl_FrontFacing ? smooth_normal : -smooth_normal) : flat_normal;
  color = vec4(shade(world, n, flat_normal, v, sky_seen(world, n), radiance_from_below(world)), 1.0);
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
float ground_distance(vec3 x) { return length(x.xz - ground_at.xz); }
)";

const char* const ground_fragment = R"(
out vec4 color;
void main() {
  vec3 x;
  float depth;
  bool met = meet_ground(x, depth);
  float t = clamp((ground_distance(x) - ground.z) / (ground.y - ground.z), 0.0, 1.0);
  float fade = met ? t * t * (3.0 - 2.0 * t) : 1.0;
  vec3 v = towards_eye(x);
  vec3 n = vec3(0.0, v.y > 0.0 ? 1.0 : -1.0, 0.0);
  vec2 at = ground_map_at(x);
  vec3 seen = vec3(1.0);
  if (all(greaterThan(at, vec2(0.0))) && all(lessThan(at, vec2(1.0)))) seen = texture(ground_ambient, at).rgb;
  color = vec4(shade(x, n, n, v, seen, horizon.rgb), 1.0 - fade);
}
)";

// On the square of ground under the meshes: the part of the sky that is seen, and the radiance sent up.
const char* const ground_map_fragment = R"(
layout(location = 0) out vec4 ambient;
layout(location = 1) out vec4 bounce;
void main() {
  vec2 at = gl_FragCoord.xy / counts.w;
  vec3 x = vec3((at.x - ground_map.z) / ground_map.x, ground.x, (at.y - ground_map.w) / ground_map.x);
  vec3 n = vec3(0.0, 1.0, 0.0);
  vec3 seen = sky_seen(x, n);
  // Outside of the map all is seen; meet that at its border.
  vec2 edge = smoothstep(0.0, 0.1, min(at, 1.0 - at));
  seen = mix(vec3(1.0), seen, edge.x * edge.y);
  vec3 light = seen * open_sky(n);
  for (int i = 0; i < int(counts.x); ++i) {
    vec3 direction;
    light += lights[i].radiance.rgb * rectangle_irradiance(lights[i], x, n, direction) * light_visibility(i, x, n);
  }
  ambient = vec4(seen, 1.0);
  bounce = vec4(ground_color.rgb / PI * light, 1.0);
}
)";

const char* const emitter_fragment = R"(
uniform int light;
out vec4 color;
void main() { color = vec4(lights[light].radiance.rgb, 1.0); }
)";

const char* const shadow_fragment = R"(
void main() {}
)";

const char* const resolve_fragment = R"(
layout(binding = 0) uniform sampler2DMS samples;
out vec4 color;
void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  color = 0.25 * ((texelFetch(samples, p, 0) + texelFetch(samples, p, 1)) +
                  (texelFetch(samples, p, 2) + texelFetch(samples, p, 3)));
}
)";

const char* const mesh_depth_fragment = R"(
in vec3 world;
in vec3 smooth_normal;
out float depth;
void main() { depth = dot(world - eye.xyz, forward.xyz); }
)";

const char* const ground_depth_fragment = R"(
out float depth;
void main() {
  vec3 x;
  if (!meet_ground(x, depth) || ground_distance(x) > ground.y) discard;
}
)";

}  // namespace lagomorph::render::raster::shaders
