#include "render/raster/shaders/shaders.h"

namespace lagomorph::render::raster::shaders {

// The sky's light is a table by the normal's height (sky_model.h), or of a map of the sky (SKY_MAP,
// sky_light.h) cubes by direction, times the part of it that the meshes leave, seen through depth maps from
// directions over the sky. From below comes what the ground reflects, or the horizon, or the map.
const char* const sky = R"(
layout(binding = 1) uniform sampler2DArray sky_maps;
layout(binding = 2) uniform sampler2D sky_table;
layout(binding = 3) uniform sampler2D ground_ambient;
layout(binding = 4) uniform sampler2D ground_bounce;

#ifdef SKY_MAP
layout(binding = 7) uniform samplerCube sky_irradiance_above;
layout(binding = 8) uniform samplerCube sky_radiance_below;
layout(binding = 9) uniform samplerCube sky_lobes_above;
layout(binding = 10) uniform samplerCube sky_lobes_below;
layout(binding = 11) uniform sampler2D sky_map_picture;

vec3 sky_radiance(vec3 direction) {
  vec2 at = vec2(0.5 + atan(direction.x, -direction.z) / (2.0 * PI) - sky_picture.x, acos(clamp(direction.y, -1.0, 1.0)) / PI);
  return sky_picture.z * textureLod(sky_map_picture, at, sky_picture.y).rgb;
}
#else
vec3 sky_radiance(vec3 direction) {
  return mix(horizon.rgb, zenith.rgb, sqrt(max(direction.y, 0.0)));
}
#endif

#ifdef SUN_DISCS
// The suns that are seen in the sky, their edges as wide as a pixel. Distances are chords on the unit sphere.
vec3 sun_discs(vec3 direction) {
  float pixel = eye.w > 0.5 ? 1e-6 : 2.0 * length(up.xyz) * viewport.w;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < int(counts.x); ++i) {
    if (lights[i].radiance.w < 0.5) continue;
    float inside = sqrt(lights[i].normal.w / PI) - distance(direction, -lights[i].normal.xyz);
    sum += clamp(0.5 + inside / pixel, 0.0, 1.0) * lights[i].radiance.rgb;
  }
  return sum;
}
#else
vec3 sun_discs(vec3 direction) { return vec3(0.0); }
#endif

// What the camera sees where nothing is.
vec3 background_radiance(vec3 direction) {
  if (background.w > 0.5) return background.rgb;
  direction = normalize(direction);
  return sky_radiance(direction) + sun_discs(direction);
}

#ifdef SKY_MAP
// Irradiance of the sky above the horizon with nothing before it.
vec3 open_sky(vec3 n) { return textureLod(sky_irradiance_above, n, 0.0).rgb; }
// Mean radiance from below the horizon with nothing before it.
vec3 open_below(vec3 n) { return textureLod(sky_radiance_below, n, 0.0).rgb; }
#else
vec3 open_sky(vec3 n) {
  vec2 size = vec2(textureSize(sky_table, 0));
  vec2 weight = texture(sky_table, vec2((0.5 + (size.x - 1.0) * (0.5 * n.y + 0.5)) / size.x, 0.5)).rg;
  return weight.x * horizon.rgb + weight.y * zenith.rgb;
}
#endif

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

// Part of the sky's light that the meshes leave: of open_sky(), and of what is mirrored.
struct SkySeen {
  vec3 diffuse, mirrored;
};

#ifdef SKY_MAP
// Mirrored: of a lobe around r, no narrower than a direction's part of the sky.
SkySeen sky_seen(vec3 x, vec3 n, vec3 r, float roughness) {
  SkySeen total = SkySeen(vec3(1e-6), vec3(1e-6));
  SkySeen seen = total;
  float sharpness = mix(12.0, 2.0, roughness);
  int count = int(counts.z);
  for (int i = 0; i < count; ++i) {
    Sightline from = sightline(i, x, n);
    float open = 1.0 - hidden_through(i, from, from.at.xy).x;
    vec3 light = max(from.normal.z, 0.0) * sky_directions[i].radiance.rgb;
    total.diffuse += light;
    seen.diffuse += light * open;
    light = exp(sharpness * (dot(r, sky_directions[i].direction.xyz) - 1.0)) * smoothstep(0.0, 0.2, from.normal.z) *
            sky_directions[i].radiance.rgb;
    total.mirrored += light;
    seen.mirrored += light * open;
  }
  return SkySeen(seen.diffuse / total.diffuse, seen.mirrored / total.mirrored);
}
#else
SkySeen sky_seen(vec3 x, vec3 n, vec3 r, float roughness) {
  vec3 total = vec3(1e-6);
  vec3 seen = vec3(1e-6);
  int count = int(counts.z);
  for (int i = 0; i < count; ++i) {
    Sightline from = sightline(i, x, n);
    vec3 light = max(from.normal.z, 0.0) * sky_directions[i].radiance.rgb;
    total += light;
    seen += light * (1.0 - hidden_through(i, from, from.at.xy).x);
  }
  seen /= total;
  return SkySeen(seen, seen);
}
#endif

#ifdef FRAGMENT
// The same where a plane would show the edges of each direction's shadow: a direction stands for all within some 20
// degrees of it, and what hides it is looked for, then measured, within the spread that they have at its distance.
vec3 sky_seen_softly(vec3 x, vec3 n) {
#ifndef SKY_MAP
  const float spread = 0.36;
#endif
  const int taps = 4;
  vec3 total = vec3(1e-6);
  vec3 seen = vec3(1e-6);
  int count = int(counts.z);
  for (int i = 0; i < count; ++i) {
    Sightline from = sightline(i, x, n);
#ifdef SKY_MAP
    float spread = sky_directions[i].direction.w;
#endif
    float turns = 0.25 * quad_index();
    float angle = 2.3999632 * (float(i) + turns);
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
      hidden += hidden_through(i, from, from.at.xy + reach * sqrt((float(k) + 0.125 + turns) / float(taps)) * turn).x;
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

// Part of the sky that a place of the ground's map sees. The mean over half a texel to all sides counts the four pixels of
// a quad alike, wherever it is, so that nothing is left of their different points.
vec3 ground_seen(vec2 at) {
  float half_texel = 0.5 / counts.w;
  vec3 sum = vec3(0.0);
  for (int k = 0; k < 4; ++k)
    sum += texture(ground_ambient, at + half_texel * (2.0 * vec2(k & 1, k >> 1) - 1.0)).rgb;
  return 0.25 * sum;
}

// Mean radiance from below the horizon: the ground's, averaged over about the point's height above it, or beyond
// it the horizon's. Of a map the ground's alone; w: part that it has, the map has the rest.
vec4 radiance_from_below(vec3 x) {
  float height = x.y - ground.x;
#ifdef SKY_MAP
  if (ground.w < 0.5 || height < 0.0) return vec4(0.0);
#else
  if (ground.w < 0.5 || height < 0.0) return vec4(horizon.rgb, 1.0);
#endif
  float level = log2(max(1.5 * height / ground_map.y, 1.0));
  vec3 bounce = textureLod(ground_bounce, ground_map_at(x), level).rgb;
  float reach = 0.5 * (ground.y + ground.z);
  float part = reach * reach / (reach * reach + height * height);
#ifdef SKY_MAP
  return vec4(bounce, part);
#else
  return vec4(mix(horizon.rgb, bounce, part), 1.0);
#endif
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

// Radiance towards v of a surface under all lights and the sky, of which the part `sky` is seen. `below` is the mean
// radiance from under the horizon, see radiance_from_below().
vec3 shade(Point p, vec3 v, Surface surface, SkySeen sky, vec4 below) {
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
#ifdef SKY_MAP
  vec3 from_below = 0.5 * PI * (1.0 - n.y) * mix(open_below(n), below.rgb, below.w);
#else
  vec3 from_below = 0.5 * PI * (1.0 - n.y) * below.rgb;
#endif
  vec3 seen = sky.diffuse;
  vec3 hidden = open * (1.0 - seen) / (open + from_below + 1e-6);
  vec3 ambient = (open * seen + from_below) / max(1.0 - hidden * coat.diffuse, 0.05);
  radiance += coat.diffuse / PI * ambient * out_of_base;

  float roughness = coat.roughness;
#ifdef SKY_MAP
  vec3 r = mirrored_view(v, n);
  float level = float(textureQueryLevels(sky_lobes_above) - 1) * roughness;
  vec4 above = textureLod(sky_lobes_above, r, level);
  vec3 beneath = mix(textureLod(sky_lobes_below, r, level).rgb, (1.0 - above.w) * below.rgb, below.w);
  vec3 itself = above.w * (1.0 - sky.mirrored) * (coat.diffuse + coat.f0) * ambient / PI;  // what hides the sky, as above
  radiance += (coat.f0 * split.x + coat.f90 * split.y) * (above.rgb * sky.mirrored + itself + beneath);
#else
  vec3 r = reflect(-v, n);
  vec3 mirrored = mix(below.rgb, sky_radiance(r), smoothstep(-roughness, roughness + 1e-3, r.y));
  vec3 rough = (open_sky(r) + 0.5 * PI * (1.0 - r.y) * below.rgb) / PI;
  radiance += (coat.f0 * split.x + coat.f90 * split.y) * mix(mirrored, rough, roughness) * sky.mirrored;
#endif
  return radiance;
}
)";

}  // namespace lagomorph::render::raster::shaders
