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
  float shown;        // part of what it mirrors, but for small suns
};

float pow5(float x) {
  float x2 = x * x;
  return x2 * x2 * x;
}

Coat make_coat(Surface s) {
  float alpha = max(s.finish.x * s.finish.x, 1e-3);
  vec3 f0 = mix(vec3(s.finish.z), s.color.rgb, s.finish.y);
  float f90 = min(1.0, 50.0 * max(f0.r, max(f0.g, f0.b)));
  float shown = s.color.w < -0.5 ? 0.0 : 1.0;  // the rest is seen to by rays
  return Coat((1.0 - s.finish.y) * s.color.rgb, f0, f90, vec2(s.finish.z, min(1.0, 50.0 * s.finish.z)),
              alpha * alpha, s.finish.x, shown);
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

}  // namespace lagomorph::render::raster::shaders
