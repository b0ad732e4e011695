#include "render/raster/shaders/shaders.h"

namespace lagomorph::render::raster::shaders {

// The ground's colour, the mean over a normal distribution around x; the columns of `spread` are what two
// independent standard deviations of it add to x and z [m]. See ground_texture.h. A box would let a quarter
// of what is finer than it through, as moire at the horizon.
const char* const ground_color = R"(
#if GROUND_TEXTURE == 0
vec3 ground_color_at(vec3 x, mat2 spread) { return surfaces[0].color.rgb; }
#else
// Of a standard deviation of 1 [Abramowitz and Stegun 1964, 7.1.26].
vec2 normal_below(vec2 x) {
  vec2 z = abs(x) * 0.70710678;
  vec2 t = 1.0 / (1.0 + 0.3275911 * z);
  vec2 beyond = t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429))));
  return 0.5 + 0.5 * sign(x) * (1.0 - beyond * exp(-z * z));
}

// Mean of what is 1 on lines of that width at multiples of `period` and 0 elsewhere: of the three nearest lines, or
// where they run into each other the first wave of their Fourier series, which is all that is left of it.
vec2 on_lines(vec2 x, vec2 deviation, float period, float line) {
  line = min(line, period);
  vec2 from = x - period * floor(x / period + 0.5);
  vec2 spread = max(deviation, 1e-5 * period);
  vec2 lines = vec2(0.0);
  for (int k = -1; k <= 1; ++k) {
    vec2 d = from - float(k) * period;
    lines += normal_below((d + 0.5 * line) / spread) - normal_below((d - 0.5 * line) / spread);
  }
  vec2 waves = spread / period;
  vec2 wave = line / period + 2.0 / PI * sin(PI * line / period) * exp(-2.0 * PI * PI * waves * waves) *
                                  cos(2.0 * PI * from / period);
  return mix(lines, wave, greaterThan(waves, vec2(0.3)));
}

#if GROUND_TEXTURE == 1
// A checker is the product of two square waves, its signs. Seen aslant x and z are correlated; the product's Fourier
// series knows of that.
float checker_waves(vec2 x, mat2 spread, float size) {
  vec2 at = PI * x / size;
  spread *= PI / size;
  float sum = 0.0;
  for (int k = 1; k <= 9; k += 2) {
    for (int l = 1; l <= 9; l += 2) {
      vec2 falling = vec2(k, -l) * spread, rising = vec2(k, l) * spread;  // of these waves' phases
      sum += 8.0 / (PI * PI * float(k * l)) *
             (cos(float(k) * at.x - float(l) * at.y) * exp(-0.5 * dot(falling, falling)) -
              cos(float(k) * at.x + float(l) * at.y) * exp(-0.5 * dot(rising, rising)));
    }
  }
  return sum;
}
float checker_signs(vec2 x, mat2 spread, vec2 deviation, float size) {
  vec2 mean_sign = 1.0 - 2.0 * on_lines(x - 0.5 * size, deviation, 2.0 * size, size);
  float edges = mean_sign.x * mean_sign.y;
  float blurred = smoothstep(0.1, 0.2, min(deviation.x, deviation.y) / size);
  return blurred > 0.0 ? mix(edges, checker_waves(x, spread, size), blurred) : edges;
}
#endif

// Part that texture_color has.
float ground_texture_at(vec3 x, mat2 spread) {
  float size = ground_texture.x;
  vec2 deviation = sqrt(spread[0] * spread[0] + spread[1] * spread[1]);
#if GROUND_TEXTURE == 1
  return 0.5 - 0.5 * checker_signs(x.xz, spread, deviation, size);
#else
  vec2 fine = on_lines(x.xz, deviation, size, ground_texture.y);
  vec2 metres = on_lines(x.xz, deviation, 1.0, 3.0 * ground_texture.y);
  vec2 line = max(fine, metres);
  return 1.0 - (1.0 - line.x) * (1.0 - line.y);
#endif
}

vec3 ground_color_at(vec3 x, mat2 spread) {
  return mix(surfaces[0].color.rgb, texture_color.rgb, ground_texture_at(x, spread));
}
#endif
)";

}  // namespace lagomorph::render::raster::shaders
