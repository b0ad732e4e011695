#include "render/raster/shaders/shaders.h"

namespace lagomorph::render::raster::shaders {

// The same surface as the path tracer's: Lambert under a GGX coat, or a metal [glTF 2.0, appendix B], with
// Smith's height-correlated masking [Heitz 2014] and f90 fading with f0 below 2 %.
const char* const brdf = R"(
struct Coat {
  vec3 diffuse;       // albedo of the base
  vec3 f0;
  float f90;
  vec2 dielectric;    // f0, f90
  float alpha2;
  float roughness;
};

float pow5(float x) {
  float x2 = x * x;
  return x2 * x2 * x;
}

Coat make_coat(Surface s) {
  float alpha = max(s.finish.x * s.finish.x, 1e-3);
  vec3 f0 = mix(vec3(s.finish.z), s.color.rgb, s.finish.y);
  float f90 = min(1.0, 50.0 * max(f0.r, max(f0.g, f0.b)));
  return Coat((1.0 - s.finish.y) * s.color.rgb, f0, f90, vec2(s.finish.z, min(1.0, 50.0 * s.finish.z)),
              alpha * alpha, s.finish.x);
}

// GGX times Smith's masking over 4 cos cos: D V [1/sr].
float ggx(float nh, float nv, float nl, float a2) {
  float k = nh * nh * (a2 - 1.0) + 1.0;
  float d = a2 / (PI * k * k);
  float root_v = sqrt(a2 + (1.0 - a2) * nv * nv);
  float root_l = sqrt(a2 + (1.0 - a2) * nl * nl);
  return d * 0.5 / (nl * root_v + nv * root_l);
}

// acos(c) / sin(acos(c)): a polynomial to 2e-5 of itself where c >= 0.
float angle_over_sine(float c) {
  float a = abs(c);
  float f = 1.5707675 + a * (-0.9978972 + a * (0.7592518 + a * (-0.5393959 + a * (0.2731272 - a * 0.0658685))));
  return c < 0.0 ? PI * inversesqrt(max(1.0 - c * c, 1e-12)) - f : f;
}

// Irradiance on a surface at x with normal n of a whole rectangle of radiance 1, by Lambert's formula; where the
// surface's horizon cuts the rectangle, that of the sphere with the same form factor [Snyder 1996].
float rectangle_irradiance(Light light, vec3 x, vec3 n, out vec3 direction) {
  if (light.normal.w > 0.0) {
    direction = -light.normal.xyz;
    return light.normal.w * max(dot(n, direction), 0.0);
  }
  vec3 c = light.position.xyz - x;
  vec3 r = light.right.w * light.right.xyz;
  vec3 u = light.up.w * light.up.xyz;
  vec3 a = normalize(c - r - u);
  vec3 b = normalize(c + r - u);
  vec3 d = normalize(c + r + u);
  vec3 e = normalize(c - r + u);
  vec3 f = cross(a, b) * angle_over_sine(dot(a, b)) + cross(b, d) * angle_over_sine(dot(b, d)) +
           cross(d, e) * angle_over_sine(dot(d, e)) + cross(e, a) * angle_over_sine(dot(e, a));
  f *= 0.5;
  float size = length(f);
  direction = size > 0.0 ? f / size : n;
  if (dot(c, light.normal.xyz) >= 0.0) return 0.0;
  float s2 = min(size / PI, 1.0);
  float cosine = dot(n, direction);
  if (cosine * cosine >= s2) return PI * s2 * max(cosine, 0.0);
  float sine = sqrt(1.0 - cosine * cosine);
  float k = sqrt(1.0 / s2 - 1.0);
  float y = clamp(-k * cosine / sine, -1.0, 1.0);
  float q = sine * sqrt(1.0 - y * y);
  return max((cosine * acos(y) - k * q) * s2 + atan(q / k), 0.0);
}

// What the coat reflects of a rectangle of radiance 1: four points of it, each a quarter wide, so that the lobe is
// widened by the quarter's own spread.
vec3 rectangle_reflection(Light light, vec3 x, vec3 n, vec3 v, float nv, Coat coat) {
  vec3 sum = vec3(0.0);
  float area = light.right.w * light.up.w;
  for (int k = 0; k < 4; ++k) {
    float i = float(k & 1) - 0.5;
    float j = float(k >> 1) - 0.5;
    vec3 c = light.position.xyz + i * light.right.w * light.right.xyz + j * light.up.w * light.up.xyz - x;
    float d2 = dot(c, c);
    vec3 l = c * inversesqrt(d2);
    float nl = dot(n, l);
    float solid_angle = area * max(-dot(l, light.normal.xyz), 0.0) / d2;
    vec3 h = normalize(l + v);
    float a2 = min(coat.alpha2 + solid_angle / 24.0, 1.0);
    float fresnel = pow5(1.0 - clamp(dot(h, v), 0.0, 1.0));
    float lobe = nl > 0.0 ? ggx(clamp(dot(n, h), 0.0, 1.0), nv, nl, a2) * nl * solid_angle : 0.0;
    sum += lobe * (coat.f0 + (coat.f90 - coat.f0) * fresnel);
  }
  return sum;
}
)";

// Percentage-closer soft shadows [Fernando 2005] with the light's own rectangle for a filter. Seen from a
// light's centre, a point at tangents t and distance z, and the rectangle's point s: what lies between them
// at distance b appears at t + s (1/b - 1/z). So reciprocal distances, which the depth map holds up to a
// scale, are averaged. A texel blocks if the surface that it saw is nearer than the receiver and above the
// receiver's plane: no surface can shadow itself by the map's resolution, and nothing needs to be pushed away
// from the light.
const char* const shadow = R"(
layout(binding = 0) uniform sampler2DArray shadow_maps;

// Point k of n of a Fibonacci lattice on [-1, 1]^2.
vec2 lattice(float k, float n) { return 2.0 * vec2((k + 0.5) / n, fract(0.5 + 0.6180339887 * k)) - 1.0; }

#ifdef SEE_THROUGH
const float least_reach = 4.0;  // texels: over so many the dots of see_through_depth_map_fragment even out
#else
const float least_reach = 1.0;
#endif

struct Receiver {
  vec3 normal;       // in the light's frame
  vec2 tangent;
  float reciprocal;  // 1 / z
  float plane;       // distance of the plane that blockers are above from the light
};

#ifndef SEE_THROUGH
// 1 / distance of what blocks the light through a point of the map, or 0.
float blocker(int i, Light light, Receiver at, vec2 tangent, float size) {
  vec2 texel = clamp(floor((tangent * light.map.xy + light.map.zw) * size), 0.0, size - 1.0);
  float d = texelFetch(shadow_maps, ivec3(texel, i), 0).r;
  float reciprocal = d * light.depth.x + light.depth.y;
  vec2 centre = ((texel + 0.5) / size - light.map.zw) / light.map.xy;
  bool blocks = d < 1.0 && reciprocal > at.reciprocal &&
                dot(at.normal, vec3(centre, 1.0)) > at.plane * reciprocal;
  return blocks ? reciprocal : 0.0;
}
#endif

// The sum of 1 / distance over what blocks the light through a point of the map, and how much does.
vec2 blockers(int i, Light light, Receiver at, vec2 tangent, float size) {
#ifdef SEE_THROUGH
  // Four texels, for some only have dots.
  vec2 corner = floor((tangent * light.map.xy + light.map.zw) * size - 0.5);
  vec4 d = textureGather(shadow_maps, vec3((corner + 1.0) / size, float(i)));
  vec4 reciprocal = d * light.depth.x + light.depth.y;
  vec4 x = ((corner.x + vec4(0.5, 1.5, 1.5, 0.5)) / size - light.map.z) / light.map.x;
  vec4 y = ((corner.y + vec4(1.5, 1.5, 0.5, 0.5)) / size - light.map.w) / light.map.y;
  vec4 above = at.normal.x * x + at.normal.y * y + at.normal.z - at.plane * reciprocal;
  vec4 blocks = vec4(lessThan(d, vec4(1.0))) * vec4(greaterThan(reciprocal, vec4(at.reciprocal))) *
                vec4(greaterThan(above, vec4(0.0)));
  return 0.25 * vec2(dot(blocks, reciprocal), dot(blocks, vec4(1.0)));
#else
  float b = blocker(i, light, at, tangent, size);
  return vec2(b, b > 0.0 ? 1.0 : 0.0);
#endif
}

// Part of a light's rectangle that is seen from x on a plane with normal n. The pixels of a quad share their samples
// where their depths are alike; `footprint` is the size of a pixel there [m].
float light_visibility(int i, vec3 x, vec3 n, float depth, float footprint) {
  Light light = lights[i];
  float size = float(textureSize(shadow_maps, 0).x);
  vec3 p = x - light.position.xyz;
  vec3 q = vec3(dot(p, light.right.xyz), dot(p, light.up.xyz), dot(p, light.normal.xyz));
  Receiver at;
  at.normal = vec3(dot(n, light.right.xyz), dot(n, light.up.xyz), dot(n, light.normal.xyz));
  at.reciprocal = 1.0 / max(q.z, 1e-6);
  at.tangent = q.xy * at.reciprocal;
  at.plane = dot(at.normal, q) + light.depth.w + 2.0 * footprint;
  vec2 half_size = vec2(light.right.w, light.up.w);
  vec2 texel = least_reach / (size * light.map.xy);
  float first = quad_index();  // the quad's pixels take every fourth point each

  vec2 reach = half_size * max(light.depth.z - at.reciprocal, 0.0) + texel;
  vec2 low = (at.tangent - reach) * light.map.xy + light.map.zw;
  vec2 high = (at.tangent + reach) * light.map.xy + light.map.zw;
  bool inside = q.z > 0.0 && at.reciprocal < light.depth.z && all(lessThan(low, vec2(1.0))) &&
                all(greaterThan(high, vec2(0.0)));
  const int search_taps = 16;
  int taps = inside ? search_taps : 0;
  float count = 0.0;
  float sum = 0.0;
  for (int k = 0; k < taps; ++k) {
    vec2 s = lattice(4.0 * float(k) + first, 4.0 * float(search_taps));
    vec2 b = blockers(i, light, at, at.tangent + s * reach, size);
    count += b.y;
    sum += b.x;
  }
  float tolerance = 10.0 * footprint;
  vec2 found = quad_sum(vec2(sum, count), depth, tolerance);
  taps = found.y > 0.0 ? int(counts.y) : 0;
  vec2 spread = max(half_size * (found.x / max(found.y, 1.0) - at.reciprocal), texel);
  float blocked = 0.0;
  for (int k = 0; k < taps; ++k) {
    vec2 s = lattice(4.0 * float(k) + first, 4.0 * counts.y);
    blocked += blockers(i, light, at, at.tangent + s * spread, size).y;
  }
  // Where the penumbra is hardly wider than a pixel, the quad's mean would only make blocks.
  vec2 shared_blocked = quad_sum(vec2(blocked, counts.y), depth, tolerance);
  float pixels = min(spread.x, spread.y) * max(q.z, 0.0) / footprint;
  return 1.0 - mix(blocked / counts.y, shared_blocked.x / shared_blocked.y, clamp(0.5 * pixels - 0.5, 0.0, 1.0));
}
)";

}  // namespace lagomorph::render::raster::shaders
