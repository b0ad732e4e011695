#include "render/raster/shaders/shaders.h"

namespace lagomorph::render::raster::shaders {

// The sky's light is a table by the normal's height (sky_model.h), or of a map of the sky (SKY_MAP,
// sky_light.h) cubes by direction, times the part of it that the meshes leave (sky_visibility.h). From below
// comes what the ground reflects, or the horizon, or the map.
const char* const sky = R"(
layout(binding = 2) uniform sampler2D sky_table;
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

// Part of the sky's light that the meshes leave: of open_sky(), and of what is mirrored; and of what is mirrored from
// below.
struct SkySeen {
  vec3 diffuse, mirrored;
  float below;
};

// Irradiance of the sky, of which the part `seen` is, and from below. What hides the sky is lit as this point is and of
// that colour.
vec3 ambient_light(vec3 open, vec3 seen, vec3 from_below, vec3 albedo) {
  vec3 hidden = open * (1.0 - seen) / (open + from_below + 1e-6);
  return (open * seen + from_below) / max(1.0 - hidden * albedo, 0.05);
}

vec2 ground_map_at(vec3 x) { return x.xz * ground_map.x + ground_map.zw; }

// Mean radiance from below the horizon on the ground itself, see radiance_from_below().
vec4 radiance_below_ground(vec3 n) {
#ifdef SKY_MAP
  return vec4(n.y > 0.0 ? open_sky(n) / PI : open_below(n), 1.0);
#else
  return vec4(horizon.rgb, 1.0);
#endif
}

// Mean radiance from below the horizon: the ground's, averaged over about the point's height above it, or beyond
// it the horizon's. Of a map the ground's alone; w: part that it has, the map has the rest.
vec4 radiance_from_below(vec3 x, vec3 n) {
  float height = x.y - ground.x;
#ifdef SKY_MAP
  if (ground.w < 0.5 || height < 0.0) return vec4(0.0);
#else
  if (ground.w < 0.5 || height < 0.0) return vec4(horizon.rgb, 1.0);
#endif
  float level = log2(max(0.75 * height / ground_map.y, 1.0));
  vec3 bounce = textureLod(ground_bounce, ground_map_at(x + 0.7 * height * vec3(n.x, 0.0, n.z)), level).rgb;
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

#ifdef SHEEN
layout(binding = 3) uniform sampler2D sheen_table;  // albedo, exponent and scale by cosine, a row a sheen

// Fibres that stand up, see path/sheen.h [1/sr].
float sheen_of(vec3 n, vec3 v, vec3 l, vec4 entry) {
  float nl = dot(n, l), nv = max(dot(n, v), 1e-3);
  if (nl <= 0.0) return 0.0;
  float nh = dot(n, normalize(v + l));
  float d = (2.0 + entry.y) * pow(max(1.0 - nh * nh, 1e-6), 0.5 * entry.y) / (2.0 * PI);
  return entry.z * d / (4.0 * (nl + nv - nl * nv));
}
#endif

struct Point {
  vec3 x;       // [m]
  vec3 normal;  // to shade with
};

// A surface as it is seen from one direction.
struct Finish {
  Coat coat;
  vec3 mirrors;          // the coat's albedo
  float nv;              // cosine of the view's angle
  float out_of_base;     // see into_base()
  float mean_into_base;
  vec3 multiple;         // part that a metal's facets reflect more than once, see path/brdf.h
  float mean_lost;
};
Finish finish_of(Surface surface, vec3 n, vec3 v) {
  Finish f;
  f.coat = make_coat(surface);
  f.nv = clamp(dot(n, v), 1e-3, 1.0);
  vec4 at_eye = texture(coat_table, vec2(f.nv, f.coat.roughness));
  f.mirrors = f.coat.shown * (f.coat.f0 * at_eye.r + f.coat.f90 * at_eye.g);
  f.out_of_base = into_base(f.coat, at_eye.rg);
  f.mean_into_base = into_base(f.coat, at_eye.ba);
  f.mean_lost = max(1.0 - at_eye.b - at_eye.a, 1e-6);
  vec3 mean = surface.color.rgb + (1.0 - surface.color.rgb) / 21.0;
  f.multiple = surface.finish.y * max(1.0 - at_eye.r - at_eye.g, 0.0) * mean * mean * (1.0 - f.mean_lost) /
               (1.0 - mean * f.mean_lost);
  return f;
}

// Radiance towards v of a light that nothing hides.
vec3 sent_of_light(int i, Finish f, Point p, vec3 v) {
  vec3 direction;
  float irradiance = rectangle_irradiance(lights[i], p.x, p.normal, direction);
  vec4 at_light = texture(coat_table, vec2(clamp(dot(p.normal, direction), 0.0, 1.0), f.coat.roughness));
  vec3 reflected =
      f.coat.diffuse * (f.out_of_base * into_base(f.coat, at_light.rg) / (PI * f.mean_into_base) * irradiance);
  reflected += f.multiple * (max(1.0 - at_light.r - at_light.g, 0.0) / (PI * f.mean_lost) * irradiance);
  float shown = lights[i].normal.w > 0.0 && lights[i].normal.w < SMALL_SUN ? 1.0 : f.coat.shown;
  reflected += shown * rectangle_reflection(lights[i], p.x, p.normal, v, f.nv, f.coat);
  return lights[i].radiance.rgb * reflected;
}

// Irradiance from under the horizon; `below` is the mean radiance there, see radiance_from_below().
vec3 light_from_below(vec3 n, vec4 below) {
#ifdef SKY_MAP
  return 0.5 * PI * (1.0 - n.y) * mix(open_below(n), below.rgb, below.w);
#else
  return 0.5 * PI * (1.0 - n.y) * below.rgb;
#endif
}

// What comes from all around: irradiance from above and below, and radiance in the coat's mirror, of the sky, of a mesh
// before it over the light on that, and from below, likewise.
struct SkyLight {
  vec3 open, from_below;
  vec3 mirrored, mirrored_mesh, mirrored_below, mesh_below;
};
SkyLight sky_light(Finish f, vec3 n, vec3 v, vec4 below) {
  SkyLight sky;
  sky.open = open_sky(n);
  sky.from_below = light_from_below(n, below);
  float roughness = f.coat.roughness;
  vec3 r = mirrored_view(v, n);
#ifdef SKY_MAP
  float level = float(textureQueryLevels(sky_lobes_above) - 1) * roughness;
  vec4 above = textureLod(sky_lobes_above, r, level);
  sky.mirrored = above.rgb;
  sky.mirrored_mesh = above.w * (f.coat.diffuse + f.coat.f0) / PI;
  sky.mesh_below = (1.0 - above.w) * (f.coat.diffuse + f.coat.f0) / PI;
  sky.mirrored_below = mix(textureLod(sky_lobes_below, r, level).rgb, (1.0 - above.w) * below.rgb, below.w);
#else
  float above = smoothstep(-roughness, roughness + 1e-3, r.y);
  sky.mirrored = mix(above * sky_radiance(r), open_sky(r) / PI, roughness);
  sky.mirrored_mesh = mix(above, 0.5 * (1.0 + r.y), roughness) * (f.coat.diffuse + f.coat.f0) / PI;
  float downward = mix(1.0 - above, 0.5 * (1.0 - r.y), roughness);
  sky.mesh_below = downward * (f.coat.diffuse + f.coat.f0) / PI;
  sky.mirrored_below = downward * below.rgb;
#endif
  return sky;
}

// Radiance towards the viewer of the light from all around, of which the meshes leave the part `seen`.
vec3 sent_of_sky(Finish f, SkyLight sky, SkySeen seen) {
  vec3 ambient = ambient_light(sky.open, seen.diffuse, sky.from_below, f.coat.diffuse);
  vec3 mesh = sky.mirrored_mesh * (1.0 - seen.mirrored) + sky.mesh_below * (1.0 - seen.below);
  vec3 in_mirror = sky.mirrored * seen.mirrored + sky.mirrored_below * seen.below + mesh * ambient;
  return (f.coat.diffuse * f.out_of_base + f.multiple) / PI * ambient + f.mirrors * in_mirror;
}

// Radiance towards v of a surface under all lights and the sky, of which these parts are seen.
vec3 shade(Point p, vec3 v, Surface surface, vec4 lights_seen, SkySeen seen, vec4 below) {
  Finish f = finish_of(surface, p.normal, v);
  SkyLight sky = sky_light(f, p.normal, v, below);
  vec3 radiance = sent_of_sky(f, sky, seen);
  int count = int(counts.x);
#ifdef SHEEN
  vec2 size = vec2(textureSize(sheen_table, 0));
  vec4 entry = texture(sheen_table, vec2((0.5 + (size.x - 1.0) * f.nv) / size.x, surface.sheen.w));
  vec3 sheen = surface.sheen.rgb;
  float under = 1.0 - max(sheen.r, max(sheen.g, sheen.b)) * entry.x;
  radiance = under * radiance + sheen * entry.x / PI * (sky.open * seen.diffuse + sky.from_below);
  for (int i = 0; i < count; ++i) {
    vec3 direction;
    float irradiance = rectangle_irradiance(lights[i], p.x, p.normal, direction);
    vec3 fuzz = sheen * sheen_of(p.normal, v, direction, entry) * irradiance * lights[i].radiance.rgb;
    radiance += lights_seen[i] * (under * sent_of_light(i, f, p, v) + fuzz);
  }
  return radiance;
#endif
  for (int i = 0; i < count; ++i) {
    radiance += lights_seen[i] * sent_of_light(i, f, p, v);
  }
  return radiance;
}
)";

}  // namespace lagomorph::render::raster::shaders
