#include "render/raster/shaders/shaders.h"

namespace lagomorph::render::raster::shaders {

const char* const full_screen_vertex = R"(
void main() {
  vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(p, 0.0, 1.0);
}
)";

const char* const mesh_vertex = R"(
#ifdef PEEL
#define VARYING sample out
#else
#define VARYING out
#endif
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
#ifdef COLORS
layout(location = 2) in vec3 color;
VARYING vec3 vertex_color;
#endif
#ifdef MOTION
layout(location = 3) in vec3 previous;
uniform bool moves;
out vec3 before;  // where the point was at the frame before
#endif
VARYING vec3 world;
VARYING vec3 smooth_normal;
VARYING float tangent_plane;  // its distance from the origin [m]
void main() {
  world = position;
  smooth_normal = normal;
  tangent_plane = dot(position, normal);
#ifdef MOTION
  before = moves ? previous : position;
#endif
#ifdef COLORS
  vertex_color = color;
#endif
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)";

const char* const emitter_vertex = R"(
uniform vec3 middle, half_right, half_up;
out vec3 world;
void main() {
  // From the front, right and up are mirrored.
  vec2 corner = vec2(gl_VertexID >> 1, gl_VertexID & 1) * 2.0 - 1.0;
  world = middle + corner.x * half_right + corner.y * half_up;
  gl_Position = clip_from_world * vec4(world, 1.0);
}
)";

// What is seen in each sample: depth, the two normals, and 1 + the number of the surface in the lower half of
// the last value; with COLORS the vertices' colour where they have one, w 1. Triangles are small and their
// pixels many, so that nothing is lit here. The upper half is how far the smooth surface that the vertices'
// normals stand for is above the triangle [m], as in the path tracer [Hanika 2021]: half of the mean distance
// to the vertices' tangent planes.
//
// With PEEL: of the surfaces that are not opaque, the next one behind that of the pass before, in each sample
// for itself [Everitt 2001]. The upper half of the last value is then what those before it let through.
const char* const seen_fragment = R"(
#ifdef PEEL
#if SAMPLES > 1
layout(binding = 13) uniform usampler2DMS peeled_samples;  // of the pass before
#define SAMPLE gl_SampleID
#else
layout(binding = 13) uniform usampler2D peeled_samples;
#define SAMPLE 0
#endif
uniform bool is_first;
#define VARYING sample in
#else
#define VARYING in
#endif
#ifndef EMITTER
VARYING vec3 smooth_normal;
VARYING float tangent_plane;
uniform bool is_smooth;
#endif
VARYING vec3 world;
uniform uint surface;
#ifdef COLORS
#ifndef EMITTER
VARYING vec3 vertex_color;
uniform bool is_colored;
#endif
layout(location = 1) out vec4 tint;
#endif
layout(location = 0) out uvec4 texel;

// Unit vectors on the octahedron, unfolded [Meyer et al. 2010].
uint octahedral(vec3 n) {
  n /= abs(n.x) + abs(n.y) + abs(n.z);
  vec2 p = n.z >= 0.0 ? n.xy : (1.0 - abs(n.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(n.xy, vec2(0.0)));
  return packSnorm2x16(p);
}

void main() {
  vec3 flat_normal = normalize(cross(dFdx(world), dFdy(world)));  // towards the viewer
  vec3 n = flat_normal;
  float raised = 0.0;
#ifndef EMITTER
  if (is_smooth) {
    float side = gl_FrontFacing ? 1.0 : -1.0;
    n = normalize(side * smooth_normal);
    raised = max(0.5 * side * (tangent_plane - dot(world, smooth_normal)), 0.0);
  }
#endif
  float depth = dot(world - eye.xyz, forward.xyz);
  uint id = surface + 1u;
#ifdef PEEL
  float passed = 1.0;
  if (!is_first) {
    uvec4 before = texelFetch(peeled_samples, ivec2(gl_FragCoord.xy), SAMPLE);
    if (before.w == 0u || depth <= uintBitsToFloat(before.x)) discard;
    passed = unpackUnorm2x16(before.w).y * (1.0 - surfaces[(before.w & 0xffffu) - 1u].finish.w);
    if (passed < 1.0 / 4096.0) discard;
  }
  id |= packUnorm2x16(vec2(0.0, passed));
  vec4 clip = clip_from_world * vec4(world, 1.0);
  gl_FragDepth = 0.5 * clip.z / clip.w + 0.5;  // in the order of `depth`
#else
  id |= packHalf2x16(vec2(0.0, raised));
#endif
  texel = uvec4(floatBitsToUint(depth), octahedral(n), octahedral(flat_normal), id);
#ifdef COLORS
  tint = vec4(0.0);
#ifndef EMITTER
  if (is_colored) tint = vec4(clamp(vertex_color, 0.0, 1.0), 1.0);
#endif
#endif
}
)";

const char* const octahedron = R"(
vec3 direction_of(vec2 p) {
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(n.xy, vec2(0.0)));
  return normalize(n);
}
)";

// The samples of a pixel, sorted into layers: one a surface that is seen in it, seldom more than one.
const char* const layers = R"(
#if SAMPLES > 1
layout(binding = 6) uniform usampler2DMS seen_samples;
#ifdef COLORS
layout(binding = 12) uniform sampler2DMS tint_samples;
#endif
#else
layout(binding = 6) uniform usampler2D seen_samples;
#ifdef COLORS
layout(binding = 12) uniform sampler2D tint_samples;
#endif
#endif

struct Sample {
  float depth;
  vec4 normals;  // both, on the octahedron
  uint id;       // 1 + the surface's number, 0: nothing is seen
#ifdef PEEL
  float weight;  // what the surfaces before it let through, times its opacity
#else
  float raised;  // see seen_fragment
#endif
};
struct Layers {
  Sample samples[SAMPLES];
  int layer[SAMPLES];
  int count;
};

// Of the same body, not one behind the other, and alike in direction (where the octahedron is not cut).
bool same_surface(Sample a, Sample b) {
  vec4 turn = abs(a.normals - b.normals);
  return a.id == b.id && abs(a.depth - b.depth) < 8.0 * pixel_footprint(a.depth) &&
         max(max(turn.x, turn.y), max(turn.z, turn.w)) < 0.4;
}

Layers sort_samples() {
  Layers l;
  l.count = 0;
  for (int s = 0; s < SAMPLES; ++s) {
    uvec4 texel = texelFetch(seen_samples, ivec2(gl_FragCoord.xy), s);
    uint id = texel.w & 0xffffu;
#ifdef PEEL
    float weight = id != 0u ? unpackUnorm2x16(texel.w).y * surfaces[id - 1u].finish.w : 0.0;
    l.samples[s] = Sample(uintBitsToFloat(texel.x), vec4(unpackSnorm2x16(texel.y), unpackSnorm2x16(texel.z)), id, weight);
#else
    l.samples[s] = Sample(uintBitsToFloat(texel.x), vec4(unpackSnorm2x16(texel.y), unpackSnorm2x16(texel.z)),
                          id, unpackHalf2x16(texel.w).y);
#endif
    l.layer[s] = -1;
    for (int r = 0; r < s; ++r) {
      if (l.layer[s] < 0 && same_surface(l.samples[r], l.samples[s])) l.layer[s] = l.layer[r];
    }
    if (l.layer[s] < 0 && texel.w != 0u) l.layer[s] = l.count++;
  }
  return l;
}
)";

const char* const layer_vertex = R"(
uniform int layer;
void main() {
  vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(p, 2.0 * (0.125 * float(layer) + 0.0625) - 1.0, 1.0);
}
)";

// One layer of a pixel, the mean of its samples.
const char* const layer_point = R"(
struct LayerPoint {
  float count;    // its samples
  float depth;
  vec4 normals;   // both, on the octahedron
  uint id;        // 1 + the surface's number
};
LayerPoint layer_point(Layers l, int layer) {
  LayerPoint p = LayerPoint(0.0, 0.0, vec4(0.0), 1u);
  for (int s = 0; s < SAMPLES; ++s) {
    if (l.layer[s] != layer) continue;
    p.count += 1.0;
    p.depth += l.samples[s].depth;
    p.normals += l.samples[s].normals;
    p.id = l.samples[s].id;
  }
  p.depth /= max(p.count, 1.0);
  p.normals /= max(p.count, 1.0);
  return p;
}
)";

// The first layer's surface, for the CPU to find what it sees of the lights and the sky: SurfaceTexel of
// receivers.h. Point and plane are those of one sample, for the mean of two triangles' is on neither. The
// number of the pixel's layers is its depth, so that the passes that light them skip all others: 0.125 for
// each, 0.05 for none; layer_vertex is before those that have its layer. Where there is one, as in most, and
// nothing but the texel is needed to light it, it is 0.01: only there plain_vertex, at 0.03, is behind.
const char* const surface_fragment = R"(
uniform bool singles_are_plain;
out uvec4 texel;
void main() {
  Layers l = sort_samples();
  gl_FragDepth = l.count == 0 ? 0.05 : 0.125 * float(l.count);
  texel = uvec4(0u);
  if (l.count == 0) return;
  LayerPoint p = layer_point(l, 0);
  Surface surface = surfaces[p.id - 1u];
  int middle = 0;
  float nearest = 1e30;
  for (int s = 0; s < SAMPLES; ++s) {
    float away = 0.0;  // from the others
    for (int r = 0; r < SAMPLES; ++r) away += l.layer[r] == 0 ? abs(l.samples[r].depth - l.samples[s].depth) : 0.0;
    if (l.layer[s] != 0 || away >= nearest) continue;
    middle = s;
    nearest = away;
  }
  Sample sample_of = l.samples[middle];
  uint finish = 1u + uint(65534.0 * clamp(surface.finish.x, 0.0, 1.0) + 0.5);
  float raised = 0.0;
#ifndef PEEL
  raised = sample_of.raised;
#endif
  bool is_light = surface.color.w > 0.5;
  if (singles_are_plain && l.count == 1 && !is_light) gl_FragDepth = 0.01;
  texel = uvec4(floatBitsToUint(sample_of.depth), packSnorm2x16(p.normals.xy),
                packHalf2x16(vec2(raised, 0.0)) | (p.id - 1u) << 16u,
                (is_light ? 0u : finish) | uint(p.count) << 16u);
}
)";

// What the CPU found that a pixel sees.
const char* const parts_seen = R"(
layout(binding = 0) uniform sampler2DArray seen_of_pixel;  // parts seen of four lights, of the sky, and mirrored
layout(binding = 15) uniform usampler2D surface_of_pixel;  // see surface_fragment
SkySeen parts_seen(ivec2 pixel, out vec4 lights_seen) {
  SkySeen sky;
  lights_seen = texelFetch(seen_of_pixel, ivec3(pixel, 0), 0);
  vec4 of_sky = texelFetch(seen_of_pixel, ivec3(pixel, 1), 0);
  sky.diffuse = of_sky.rgb;
  sky.below = of_sky.w;
#ifdef SKY_MAP
  sky.mirrored = texelFetch(seen_of_pixel, ivec3(pixel, 2), 0).rgb;
#else
  sky.mirrored = sky.diffuse;
#endif
  return sky;
}
)";

// Behind the depth of plain pixels (surface_fragment) and before that of all others.
const char* const plain_vertex = R"(
void main() {
  vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(p, 2.0 * 0.03 - 1.0, 1.0);
}
)";

// A pixel of one layer before the ground: its samples need not be looked at again.
const char* const plain_fragment = R"(
out vec4 color;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uvec4 texel = texelFetch(surface_of_pixel, pixel, 0);
  vec3 origin, direction;
  pixel_ray(origin, direction);
  Point p;
  p.x = origin + uintBitsToFloat(texel.x) * direction;
  p.normal = direction_of(unpackSnorm2x16(texel.y));
  vec4 lights_seen;
  SkySeen sky = parts_seen(pixel, lights_seen);
  vec3 lit = shade(p, -normalize(direction), surfaces[texel.z >> 16u], lights_seen, sky,
                   radiance_from_below(p.x, p.normal));
  color = float(texel.w >> 16u) / float(SAMPLES) * vec4(lit, 1.0);
}
)";

// Lights one layer of the pixel and adds it to what is behind. The first layer makes room for all. Behind the
// ground, only what its fading edge lets through is seen, instead of the background there.
const char* const layer_fragment = R"(
uniform int layer;
out vec4 color;

// The pixel whose parts seen are those of this layer: for the first this one; the others are cut by edges, beyond which
// they are a neighbour's first. x < 0: none is like it.
ivec2 pixel_like(LayerPoint p) {
  ivec2 here = ivec2(gl_FragCoord.xy);
  ivec2 best = ivec2(-1);
  float least = 1e30;
  int count = layer == 0 ? 1 : 9;
  for (int k = 0; k < count; ++k) {
    int place = (k + 4) % 9;  // from the middle on
    ivec2 at = clamp(here + ivec2(place % 3 - 1, place / 3 - 1), ivec2(0), ivec2(viewport.xy) - 1);
    uvec4 there = texelFetch(surface_of_pixel, at, 0);
    if ((there.w & 0xffffu) == 0u) continue;
    vec2 turn = abs(unpackSnorm2x16(there.y) - p.normals.xy);
    float unlike = abs(uintBitsToFloat(there.x) - p.depth) / pixel_footprint(p.depth) + 8.0 * (turn.x + turn.y);
    if (unlike >= least) continue;
    best = at;
    least = unlike;
  }
  return best;
}

void main() {
  vec3 on_ground;
  float to_ground;
  if (ground.w < 0.5 || !meet_ground(on_ground, to_ground)) to_ground = 1e30;
  Layers l = sort_samples();
  LayerPoint mean = layer_point(l, layer);
  float before_ground = 0.0;  // of this layer's samples
  float covered = 0.0;        // of all layers' before the ground
#ifdef PEEL
  float weight_before = 0.0;  // of this layer's samples before and behind the ground
  float weight_behind = 0.0;
#endif
#ifdef COLORS
  vec4 tint = vec4(0.0);
#endif
  for (int s = 0; s < SAMPLES; ++s) {
    float before = l.samples[s].depth < to_ground ? 1.0 : 0.0;
    if (l.layer[s] >= 0) covered += before;
    if (l.layer[s] != layer) continue;
    before_ground += before;
#ifdef PEEL
    weight_before += before * l.samples[s].weight;
    weight_behind += (1.0 - before) * l.samples[s].weight;
#endif
#ifdef COLORS
    tint += texelFetch(tint_samples, ivec2(gl_FragCoord.xy), s);
#endif
  }
  vec3 origin, direction;
  pixel_ray(origin, direction);
  Point p;
  p.x = origin + mean.depth * direction;
  p.normal = direction_of(mean.normals.xy);
  vec3 v = -normalize(direction);
  Surface surface = surfaces[mean.id - 1u];
#ifdef COLORS
  if (tint.w > 0.0) surface.color.rgb = tint.rgb / tint.w;
#endif
  ivec2 pixel = pixel_like(mean);
  vec4 lights_seen = vec4(1.0);
  SkySeen sky = SkySeen(vec3(1.0), vec3(1.0), 1.0);
  if (pixel.x >= 0) sky = parts_seen(pixel, lights_seen);
  vec3 lit = shade(p, v, surface, lights_seen, sky, radiance_from_below(p.x, p.normal));
#ifdef PEEL
  color = vec4(weight_before * lit, weight_before);
  if (weight_behind > 0.0)
    color.rgb += weight_behind * ground_fade(on_ground) * (lit - background_radiance(direction));
  color /= float(SAMPLES);
  return;
#endif
  if (surface.color.w > 0.5) lit = surface.color.rgb;
  color.rgb = before_ground * lit;
  if (before_ground < mean.count)
    color.rgb += (mean.count - before_ground) * ground_fade(on_ground) * (lit - background_radiance(direction));
  color = vec4(color.rgb, layer == 0 ? covered : 0.0) / float(SAMPLES);
}
)";

// What the peeled surfaces send, over the picture.
const char* const composite_fragment = R"(
layout(binding = 13) uniform sampler2D peeled;
out vec4 color;
void main() { color = texelFetch(peeled, ivec2(gl_FragCoord.xy), 0); }
)";

const char* const mesh_depth_fragment = R"(
in vec3 world;
in vec3 smooth_normal;
out float depth;
void main() { depth = dot(world - eye.xyz, forward.xyz); }
)";

const char* const mesh_number_fragment = R"(
in vec3 world;
in vec3 smooth_normal;
uniform uint surface;
out float number;
void main() { number = float(surface); }
)";

}  // namespace lagomorph::render::raster::shaders
