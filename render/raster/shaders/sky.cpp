#include "render/raster/shaders/shaders.h"

namespace lagomorph::render::raster::shaders {

// The sky's light is a table by the normal's height (sky_model.h) times the part of it that the meshes leave,
// seen through depth maps from directions over the sky. From below comes what the ground reflects, or the
// horizon.
const char* const sky = R"(
layout(binding = 1) uniform sampler2DArray sky_maps;
layout(binding = 2) uniform sampler2D sky_table;
layout(binding = 3) uniform sampler2D ground_ambient;
layout(binding = 4) uniform sampler2D ground_bounce;

vec3 sky_radiance(vec3 direction) {
  return mix(horizon.rgb, zenith.rgb, sqrt(max(direction.y, 0.0)));
}

// Irradiance of the sky above the horizon with nothing before it.
vec3 open_sky(vec3 n) {
  vec2 size = vec2(textureSize(sky_table, 0));
  vec2 weight = texture(sky_table, vec2((0.5 + (size.x - 1.0) * (0.5 * n.y + 0.5)) / size.x, 0.5)).rg;
  return weight.x * horizon.rgb + weight.y * zenith.rgb;
}

// How much of one direction of the sky is seen, bilinear over four texels. The same test as for the lights.
float direction_visibility(int i, vec3 at, vec3 n) {
  SkyDirection sky = sky_directions[i];
  vec3 s = vec3(dot(at, sky.right.xyz), dot(at, sky.up.xyz), dot(at, sky.direction.xyz));
  vec3 m = vec3(dot(n, sky.right.xyz), dot(n, sky.up.xyz), dot(n, sky.direction.xyz));
  float size = float(textureSize(sky_maps, 0).x);
  vec2 g = (0.5 * s.xy + 0.5) * size - 0.5;
  vec2 corner = floor(g);
  vec2 f = g - corner;
  vec4 depth = textureGather(sky_maps, vec3((corner + 1.0) / size, float(i)));
  vec4 rise = mix(1.0 - 2.0 * depth, vec4(-1e9), greaterThanEqual(depth, vec4(1.0))) - s.z;
  vec2 step_low = -f * 2.0 / size;
  vec2 step_high = (1.0 - f) * 2.0 / size;
  vec4 dx = vec4(step_low.x, step_high.x, step_high.x, step_low.x);
  vec4 dy = vec4(step_high.y, step_high.y, step_low.y, step_low.y);
  float least = 0.004;  // of the meshes' radius
  vec4 open = vec4(lessThan(min(rise, m.x * dx + m.y * dy + m.z * rise), vec4(least)));
  vec2 upper = mix(open.xw, open.yz, f.x);
  return mix(upper.y, upper.x, f.y);
}

// Part of open_sky() that the meshes leave.
vec3 sky_seen(vec3 x, vec3 n) {
  vec3 at = (x - sky_map.xyz) * sky_map.w;
  vec3 total = vec3(1e-6);
  vec3 seen = vec3(1e-6);
  int count = int(counts.z);
  for (int i = 0; i < count; ++i) {
    vec3 light = max(dot(n, sky_directions[i].direction.xyz), 0.0) * sky_directions[i].radiance.rgb;
    total += light;
    seen += light * direction_visibility(i, at, n);
  }
  return seen / total;
}

vec2 ground_map_at(vec3 x) { return x.xz * ground_map.x + ground_map.zw; }

// Mean radiance from below the horizon: the ground's, averaged over about the point's height above it, or beyond
// it the horizon's.
vec3 radiance_from_below(vec3 x) {
  float height = x.y - ground.x;
  if (ground.w < 0.5 || height < 0.0) return horizon.rgb;
  float level = log2(max(1.5 * height / ground_map.y, 1.0));
  vec3 bounce = textureLod(ground_bounce, ground_map_at(x), level).rgb;
  float reach = 0.5 * (ground.y + ground.z);
  return mix(horizon.rgb, bounce, reach * reach / (reach * reach + height * height));
}
)";

const char* const shade = R"(
layout(binding = 5) uniform sampler2D coat_table;

// Radiance towards v of a surface under all lights and the sky. `seen` is the part of the sky that it sees,
// `flat_normal` the normal of its triangle.
vec3 shade(vec3 x, vec3 n, vec3 flat_normal, vec3 v, vec3 seen, vec3 below) {
  Coat coat = make_coat();
  float nv = clamp(dot(n, v), 1e-3, 1.0);
  vec3 radiance = vec3(0.0);
  int count = int(counts.x);
  for (int i = 0; i < count; ++i) {
    vec3 direction;
    float irradiance = rectangle_irradiance(lights[i], x, n, direction);
    float visibility = light_visibility(i, x, flat_normal);
    vec3 h = normalize(direction + v);
    float fresnel = pow5(1.0 - clamp(dot(h, v), 0.0, 1.0));
    float base = 1.0 - mix(coat.dielectric.x, coat.dielectric.y, fresnel);
    vec3 reflected = coat.diffuse * (base / PI * irradiance);
    reflected += rectangle_reflection(lights[i], x, n, v, nv, coat);
    radiance += visibility * lights[i].radiance.rgb * reflected;
  }

  // What hides the sky is lit as this point is and of its colour.
  vec3 open = open_sky(n);
  vec3 from_below = 0.5 * PI * (1.0 - n.y) * below;
  vec3 hidden = open * (1.0 - seen) / (open + from_below + 1e-6);
  vec3 ambient = (open * seen + from_below) / max(1.0 - hidden * coat.diffuse, 0.05);
  vec2 split = texture(coat_table, vec2(nv, finish.x)).rg;
  radiance += coat.diffuse / PI * ambient * (1.0 - dot(coat.dielectric, split));

  vec3 r = reflect(-v, n);
  float roughness = finish.x;
  vec3 mirrored = mix(below, sky_radiance(r), smoothstep(-roughness, roughness + 1e-3, r.y));
  vec3 rough = (open_sky(r) + 0.5 * PI * (1.0 - r.y) * below) / PI;
  radiance += (coat.f0 * split.x + coat.f90 * split.y) * mix(mirrored, rough, roughness) * seen;
  return radiance;
}
)";

}  // namespace lagomorph::render::raster::shaders
