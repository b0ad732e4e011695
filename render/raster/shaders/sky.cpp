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

// What the camera sees where nothing is.
vec3 background_radiance(vec3 direction) {
  return background.w > 0.5 ? background.rgb : sky_radiance(normalize(direction));
}

// Irradiance of the sky above the horizon with nothing before it.
vec3 open_sky(vec3 n) {
  vec2 size = vec2(textureSize(sky_table, 0));
  vec2 weight = texture(sky_table, vec2((0.5 + (size.x - 1.0) * (0.5 * n.y + 0.5)) / size.x, 0.5)).rg;
  return weight.x * horizon.rgb + weight.y * zenith.rgb;
}

// A point and its normal, seen along one direction of the sky; lengths in radii of the meshes' sphere.
struct Sightline {
  vec3 at, normal;
};
Sightline sightline(int i, vec3 x, vec3 n) {
  SkyDirection sky = sky_directions[i];
  vec3 at = (x - sky_map.xyz) * sky_map.w;
  return Sightline(vec3(dot(at, sky.right.xyz), dot(at, sky.up.xyz), dot(at, sky.direction.xyz)),
                   vec3(dot(n, sky.right.xyz), dot(n, sky.up.xyz), dot(n, sky.direction.xyz)));
}

// What hides the sky through a point of a direction's map, bilinear over four texels: how much, and that times how far
// above the receiver. The same test as for the lights.
vec2 hidden_through(int i, Sightline from, vec2 through) {
  float size = float(textureSize(sky_maps, 0).x);
  vec2 g = (0.5 * through + 0.5) * size - 0.5;
  vec2 corner = floor(g);
  vec2 f = g - corner;
  vec4 depth = textureGather(sky_maps, vec3((corner + 1.0) / size, float(i)));
  vec4 rise = mix(1.0 - 2.0 * depth, vec4(-1e9), greaterThanEqual(depth, vec4(1.0))) - from.at.z;
  vec2 low = through - from.at.xy - f * 2.0 / size;
  vec2 high = low + 2.0 / size;
  vec4 above = from.normal.x * vec4(low.x, high.x, high.x, low.x) +
               from.normal.y * vec4(high.y, high.y, low.y, low.y) + from.normal.z * rise;
  float least = 0.004;
  vec4 hides = vec4(greaterThan(min(rise, above), vec4(least)));
  vec4 weight = vec4(f.y, f.y, 1.0 - f.y, 1.0 - f.y) * vec4(1.0 - f.x, f.x, f.x, 1.0 - f.x);
  return vec2(dot(weight, hides), dot(weight, hides * max(rise, 0.0)));
}

// Part of open_sky() that the meshes leave.
vec3 sky_seen(vec3 x, vec3 n) {
  vec3 total = vec3(1e-6);
  vec3 seen = vec3(1e-6);
  int count = int(counts.z);
  for (int i = 0; i < count; ++i) {
    Sightline from = sightline(i, x, n);
    vec3 light = max(from.normal.z, 0.0) * sky_directions[i].radiance.rgb;
    total += light;
    seen += light * (1.0 - hidden_through(i, from, from.at.xy).x);
  }
  return seen / total;
}

#ifdef FRAGMENT
// The same where a plane would show the edges of each direction's shadow: a direction stands for all within some 20
// degrees of it, and what hides it is looked for, then measured, within the spread that they have at its distance.
vec3 sky_seen_softly(vec3 x, vec3 n) {
  const float spread = 0.36;
  const int taps = 4;
  vec3 total = vec3(1e-6);
  vec3 seen = vec3(1e-6);
  int count = int(counts.z);
  for (int i = 0; i < count; ++i) {
    Sightline from = sightline(i, x, n);
    float angle = 2.3999632 * (float(i) + 0.25 * quad_index());
    vec2 turn = vec2(cos(angle), sin(angle));
    vec2 found = hidden_through(i, from, from.at.xy);
    float reach = 0.5 * spread * max(1.0 - from.at.z, 0.0);
    vec2 offset = reach * turn;
    for (int k = 0; k < 4; ++k) {
      found += hidden_through(i, from, from.at.xy + offset);
      offset = vec2(-offset.y, offset.x);
    }
    reach = spread * found.y / max(found.x, 1e-6);
    float hidden = 0.0;
    for (int k = 0; k < taps; ++k) {
      hidden += hidden_through(i, from, from.at.xy + reach * sqrt((float(k) + 0.5) / float(taps)) * turn).x;
      turn = vec2(-0.7373688 * turn.x - 0.6754902 * turn.y, 0.6754902 * turn.x - 0.7373688 * turn.y);
    }
    vec3 light = max(from.normal.z, 0.0) * sky_directions[i].radiance.rgb;
    total += light;
    seen += light * (1.0 - hidden / float(taps));
  }
  return seen / total;
}
#endif

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
layout(binding = 5) uniform sampler2D coat_table;  // scale and offset of the coat's albedo, then their means

// Part of the light that the dielectric coat lets through, into the base or out of it (coat_albedo.h): a direction's, or
// the mean over the hemisphere.
float into_base(Coat coat, vec2 albedo) { return 1.0 - dot(coat.dielectric, albedo); }

struct Point {
  vec3 x;            // [m]
  vec3 normal;       // to shade with
  vec3 flat_normal;  // of the triangle
  float depth;       // along the view axis [m]
  float footprint;   // size of a pixel there [m]
};

// Radiance towards v of a surface under all lights and the sky, of which the part `seen` is seen. `below` is the mean
// radiance from under the horizon.
vec3 shade(Point p, vec3 v, Surface surface, vec3 seen, vec3 below) {
  Coat coat = make_coat(surface);
  vec3 x = p.x;
  vec3 n = p.normal;
  float nv = clamp(dot(n, v), 1e-3, 1.0);
  vec4 at_eye = texture(coat_table, vec2(nv, coat.roughness));
  vec2 split = at_eye.rg;
  float out_of_base = into_base(coat, split);
  float mean_into_base = into_base(coat, at_eye.ba);
  vec3 radiance = vec3(0.0);
  int count = int(counts.x);
  for (int i = 0; i < count; ++i) {
    vec3 direction;
    float irradiance = rectangle_irradiance(lights[i], x, n, direction);
#ifdef SHADOWS
    float visibility = light_visibility(i, x, p.flat_normal, p.depth, p.footprint);
#else
    float visibility = 1.0;
#endif
    vec4 at_light = texture(coat_table, vec2(clamp(dot(n, direction), 0.0, 1.0), coat.roughness));
    vec3 reflected = coat.diffuse * (out_of_base * into_base(coat, at_light.rg) / (PI * mean_into_base) * irradiance);
    reflected += rectangle_reflection(lights[i], x, n, v, nv, coat);
    radiance += visibility * lights[i].radiance.rgb * reflected;
  }

  // What hides the sky is lit as this point is and of its colour.
  vec3 open = open_sky(n);
  vec3 from_below = 0.5 * PI * (1.0 - n.y) * below;
  vec3 hidden = open * (1.0 - seen) / (open + from_below + 1e-6);
  vec3 ambient = (open * seen + from_below) / max(1.0 - hidden * coat.diffuse, 0.05);
  radiance += coat.diffuse / PI * ambient * out_of_base;

  vec3 r = reflect(-v, n);
  float roughness = coat.roughness;
  vec3 mirrored = mix(below, sky_radiance(r), smoothstep(-roughness, roughness + 1e-3, r.y));
  vec3 rough = (open_sky(r) + 0.5 * PI * (1.0 - r.y) * below) / PI;
  radiance += (coat.f0 * split.x + coat.f90 * split.y) * mix(mirrored, rough, roughness) * seen;
  return radiance;
}
)";

}  // namespace lagomorph::render::raster::shaders
