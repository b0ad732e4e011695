#include "render/raster/sky_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "render/simd.h"

namespace lagomorph::render::raster {
namespace {

using Index = std::size_t;
constexpr Index all = lanes;

/// Points and normals along one direction of the sky; lengths in radii of the meshes' sphere.
struct alignas(64) Sightlines {
  Lanes3 at, normal;
};
LAGOMORPH_INLINE void look_along(const FrameBlock& frame, Index i, const Receivers& r, Sightlines& s) {
  const SkyDirectionBlock& d = frame.sky[i];
  const float scale = frame.sky_map[3];
  for (Index l = 0; l < all; ++l) {
    const float x = (r.point.x[l] - frame.sky_map[0]) * scale;
    const float y = (r.point.y[l] - frame.sky_map[1]) * scale;
    const float z = (r.point.z[l] - frame.sky_map[2]) * scale;
    s.at.x[l] = x * d.right[0] + y * d.right[1] + z * d.right[2];
    s.at.y[l] = x * d.up[0] + y * d.up[1] + z * d.up[2];
    s.at.z[l] = x * d.direction[0] + y * d.direction[1] + z * d.direction[2];
    const float nx = r.normal.x[l], ny = r.normal.y[l], nz = r.normal.z[l];
    s.normal.x[l] = nx * d.right[0] + ny * d.right[1] + nz * d.right[2];
    s.normal.y[l] = nx * d.up[0] + ny * d.up[1] + nz * d.up[2];
    s.normal.z[l] = nx * d.direction[0] + ny * d.direction[1] + nz * d.direction[2];
  }
}

/// What hides the sky through points of a direction's map, bilinear over four texels: how much, and with the
/// map from below, times how far above the receiver it begins and ends. The same test as for the lights.
/// `downward`: what hides what is there on the other side, by the map from below.
template <bool with_height, bool downward = false>
LAGOMORPH_INLINE void add_hidden(const DepthMap::value_type* map, const DepthMap::value_type* from_below,
                                 int size, const Sightlines& from, const Lanes& offset_x,
                                 const Lanes& offset_y, Lanes& hidden, Lanes& lowest, Lanes& highest) {
  const auto texels = static_cast<float>(size);
  const float step = 2.0F / texels;
  constexpr float scale = 2.0F / no_depth;
  constexpr float least = 0.004F;
  alignas(64) BatchIndices at;
  alignas(64) BatchIndices depth;
  alignas(64) Lanes part_x, part_y;
  const std::int32_t last = size - 1;
  for (Index l = 0; l < all; ++l) {
    const float through_x = from.at.x[l] + offset_x[l], through_y = from.at.y[l] + offset_y[l];
    const float u = (0.5F * through_x + 0.5F) * texels - 0.5F, v = (0.5F * through_y + 0.5F) * texels - 0.5F;
    // Far outside, all four texels are the border's, where nothing is.
    const float bounded_u = std::min(std::max(u, -1.0F), texels),
                bounded_v = std::min(std::max(v, -1.0F), texels);
    const std::int32_t x = static_cast<std::int32_t>(bounded_u + 1.0F) - 1;  // floor
    const std::int32_t y = static_cast<std::int32_t>(bounded_v + 1.0F) - 1;
    part_x[l] = bounded_u - static_cast<float>(x);
    part_y[l] = bounded_v - static_cast<float>(y);
    const std::int32_t x0 = std::min(std::max(x, 0), last), x1 = std::min(x + 1, last);
    const std::int32_t y0 = std::min(std::max(y, 0), last) * size, y1 = std::min(y + 1, last) * size;
    at[l] = y0 + x0;
    at[all + l] = y0 + x1;
    at[2 * all + l] = y1 + x0;
    at[3 * all + l] = y1 + x1;
  }
  look_up(map, at.data(), at.size(), depth.data());
  alignas(64) BatchIndices below;
  if constexpr (with_height) {
    std::int32_t nearest = no_depth;
    for (Index i = 0; i < depth.size(); ++i) nearest = std::min(nearest, depth[i]);
    if (nearest == no_depth) return;
    look_up(from_below, at.data(), at.size(), below.data());
  }
  for (int corner = 0; corner < batch; ++corner) {
    const bool right = (corner & 1) != 0, upper = (corner >> 1) != 0;
    const Index base = static_cast<Index>(corner) * all;
    for (Index l = 0; l < all; ++l) {
      const float dx = offset_x[l] - part_x[l] * step + (right ? step : 0.0F);
      const float dy = offset_y[l] - part_y[l] * step + (upper ? step : 0.0F);
      const float weight = (right ? part_x[l] : 1.0F - part_x[l]) * (upper ? part_y[l] : 1.0F - part_y[l]);
      const float height = 1.0F - scale * static_cast<float>(depth[base + l]);
      const float rise = depth[base + l] == no_depth ? -1e9F
                         : downward                  ? from.at.z[l] + height
                                                     : height - from.at.z[l];
      const float along = downward ? -rise : rise;
      const float above = from.normal.x[l] * dx + from.normal.y[l] * dy + from.normal.z[l] * along;
      const bool hides = both(rise > least, above > least);
      hidden[l] += hides ? weight : 0.0F;
      if constexpr (with_height) {
        const float low = scale * static_cast<float>(below[base + l]) - 1.0F - from.at.z[l];
        lowest[l] += hides ? weight * std::max(std::min(low, rise), 0.0F) : 0.0F;
        highest[l] += hides ? weight * rise : 0.0F;
      }
    }
  }
}

LAGOMORPH_INLINE void divide(const Lanes3& a, const Lanes3& b, Lanes3& ratio) {
  for (Index l = 0; l < all; ++l) {
    ratio.x[l] = a.x[l] / b.x[l];
    ratio.y[l] = a.y[l] / b.y[l];
    ratio.z[l] = a.z[l] / b.z[l];
  }
}

LAGOMORPH_INLINE void add_light(const Vec4& radiance, const Lanes& part, Lanes3& sum) {
  for (Index l = 0; l < all; ++l) {
    sum.x[l] += part[l] * radiance[0];
    sum.y[l] += part[l] * radiance[1];
    sum.z[l] += part[l] * radiance[2];
  }
}

void fill(Lanes3& v, float value) {
  v.x.fill(value);
  v.y.fill(value);
  v.z.fill(value);
}

/// No wider than this around a direction's middle.
constexpr float usual_spread = 0.36F;

/// Weight of a direction along which light is mirrored, `cosine` from where it is mirrored most: e to the
/// exponent, a lobe no narrower than a direction's part of the sky, times what is left of it where it faces
/// the surface with a cosine `facing`.
LAGOMORPH_INLINE float mirrored_exponent(float cosine, float roughness) {
  return (12.0F - 10.0F * roughness) * (cosine - 1.0F);
}
LAGOMORPH_INLINE float beside_horizon(float facing) {
  const float s = std::min(std::max(5.0F * facing, 0.0F), 1.0F);
  return s * s * (3.0F - 2.0F * s);
}

/// Along the opposites of the sky's directions, around each, so that the edges of its shadow do not show.
/// Where a surface is seen aslant: elsewhere a dielectric mirrors little.
LAGOMORPH_RENDER_SIMD void below_seen(const FrameBlock& frame, const DepthMaps& maps, const Receivers& at,
                                      Lanes& seen) {
  constexpr float aslant = 0.25F, from_above = 0.5F;  // cosines of the view to the normal
  constexpr float reach = 0.07F;
  // Directions of less weight are not looked along.
  constexpr float least_weight = 0.15F, least_exponent = -1.9F;
  constexpr int taps = 4;
  alignas(64) Lanes fade, total, left, weight, hidden, offset_x, offset_y;
  float most = 0.0F;
  for (Index l = 0; l < all; ++l) {
    const float cosine = at.mirrored.x[l] * at.normal.x[l] + at.mirrored.y[l] * at.normal.y[l] +
                         at.mirrored.z[l] * at.normal.z[l];
    const float t = std::min(std::max((from_above - cosine) / (from_above - aslant), 0.0F), 1.0F);
    fade[l] = t * t * (3.0F - 2.0F * t);
    most = std::max(most, fade[l]);
  }
  seen.fill(1.0F);
  if (most <= 0.0F) return;
  total.fill(1e-6F);
  left.fill(1e-6F);
  Sightlines from;
  for (Index i = 0; i < maps.sky.size(); ++i) {
    const Vec4& d = frame.sky[i].direction;
    // Most are too far from where light is mirrored from.
    most = -1e9F;
    for (Index l = 0; l < all; ++l) {
      const float cosine = at.mirrored.x[l] * d[0] + at.mirrored.y[l] * d[1] + at.mirrored.z[l] * d[2];
      weight[l] = mirrored_exponent(-cosine, at.roughness[l]);
      most = std::max(most, fade[l] > 0.0F ? weight[l] : -1e9F);
    }
    if (most < least_exponent) continue;
    most = 0.0F;
    for (Index l = 0; l < all; ++l) {
      const float facing = at.normal.x[l] * d[0] + at.normal.y[l] * d[1] + at.normal.z[l] * d[2];
      weight[l] = fade[l] * std::max(std::exp(weight[l]) * beside_horizon(-facing) - least_weight, 0.0F);
      most = std::max(most, weight[l]);
    }
    if (most <= 0.0F) continue;
    look_along(frame, i, at, from);
    hidden.fill(0.0F);
    float x = reach * std::cos(static_cast<float>(i)), y = reach * std::sin(static_cast<float>(i));
    const DepthMap::value_type* map = maps.sky_from_below[i].data();
    for (int k = 0; k < taps; ++k) {
      offset_x.fill(x);
      offset_y.fill(y);
      add_hidden<false, true>(map, nullptr, maps.sky_size, from, offset_x, offset_y, hidden, hidden, hidden);
      x = std::exchange(y, x);
      x = -x;
    }
    for (Index l = 0; l < all; ++l) {
      total[l] += weight[l];
      left[l] += weight[l] * (1.0F - hidden[l] / static_cast<float>(taps));
    }
  }
  for (Index l = 0; l < all; ++l) seen[l] = 1.0F - fade[l] * (1.0F - left[l] / total[l]);
}

}  // namespace

LAGOMORPH_RENDER_SIMD void sky_seen(const FrameBlock& frame, const DepthMaps& maps, const Receivers& at,
                                    SkySeen& seen) {
  alignas(64) Lanes3 total, left, total_mirrored, left_mirrored;
  for (Lanes3* sum : {&total, &left, &total_mirrored, &left_mirrored}) fill(*sum, 1e-6F);
  alignas(64) constexpr Lanes nowhere{};
  alignas(64) Lanes light, open, hidden;
  Sightlines from;
  for (Index i = 0; i < maps.sky.size(); ++i) {
    look_along(frame, i, at, from);
    float highest = -1.0F;
    for (Index l = 0; l < all; ++l) highest = std::max(highest, from.normal.z[l]);
    if (highest <= 0.0F) continue;  // its light falls on their backs
    hidden.fill(0.0F);
    if (maps.see_through) {
      // Over four by four texels the dots of what is seen through even out.
      alignas(64) Lanes offset_x, offset_y;
      const float texel = 2.0F / static_cast<float>(maps.sky_size);
      for (int k = 0; k < 4; ++k) {
        offset_x.fill((k & 1) == 0 ? -texel : texel);
        offset_y.fill((k >> 1) == 0 ? -texel : texel);
        add_hidden<false>(maps.sky[i].data(), nullptr, maps.sky_size, from, offset_x, offset_y, hidden,
                          hidden, hidden);
      }
      for (Index l = 0; l < all; ++l) hidden[l] *= 0.25F;
    } else {
      add_hidden<false>(maps.sky[i].data(), nullptr, maps.sky_size, from, nowhere, nowhere, hidden, hidden,
                        hidden);
    }
    for (Index l = 0; l < all; ++l) {
      light[l] = std::max(from.normal.z[l], 0.0F);
      open[l] = light[l] * (1.0F - hidden[l]);
    }
    add_light(frame.sky[i].radiance, light, total);
    add_light(frame.sky[i].radiance, open, left);
    if (!maps.sky_is_map) continue;
    const Vec4& d = frame.sky[i].direction;
    for (Index l = 0; l < all; ++l) {
      const float cosine = at.mirrored.x[l] * d[0] + at.mirrored.y[l] * d[1] + at.mirrored.z[l] * d[2];
      light[l] = std::exp(mirrored_exponent(cosine, at.roughness[l])) * beside_horizon(from.normal.z[l]);
      open[l] = light[l] * (1.0F - hidden[l]);
    }
    add_light(frame.sky[i].radiance, light, total_mirrored);
    add_light(frame.sky[i].radiance, open, left_mirrored);
  }
  divide(left, total, seen.diffuse);
  below_seen(frame, maps, at, seen.below);
  if (maps.sky_is_map) {
    divide(left_mirrored, total_mirrored, seen.mirrored);
  } else {
    seen.mirrored = seen.diffuse;
  }
}

LAGOMORPH_RENDER_SIMD void sky_seen_softly(const FrameBlock& frame, const DepthMaps& maps,
                                           const Receivers& at, SkySeen& seen) {
  constexpr int taps = 4;
  alignas(64) Lanes3 total, left;
  fill(total, 1e-6F);
  fill(left, 1e-6F);
  alignas(64) Lanes light, open, hidden, offset_x, offset_y, reach;
  Sightlines from;
  for (Index i = 0; i < maps.sky.size(); ++i) {
    look_along(frame, i, at, from);
    const DepthMap::value_type *map = maps.sky[i].data(), *from_below = maps.sky_from_below[i].data();
    const float spread = maps.sky_is_map ? frame.sky[i].direction[3] : usual_spread;
    alignas(64) std::array<float, 4> turn_x, turn_y;  // of each pixel of a quad
    for (int q = 0; q < 4; ++q) {
      const float angle = 2.3999632F * (static_cast<float>(i) + 0.25F * static_cast<float>(q));
      turn_x[static_cast<Index>(q)] = std::cos(angle);
      turn_y[static_cast<Index>(q)] = std::sin(angle);
    }
    bool meets = false;  // the map, from anywhere
    for (Index l = 0; l < all; ++l) {
      reach[l] = 0.5F * spread * std::max(1.0F - from.at.z[l], 0.0F);
      meets |= std::max(std::abs(from.at.x[l]), std::abs(from.at.y[l])) < 1.0F + reach[l];
    }
    alignas(64) Lanes found{}, low{}, high{}, low_here{}, found_here{};
    if (meets) {
      offset_x.fill(0.0F);
      offset_y.fill(0.0F);
      add_hidden<true>(map, from_below, maps.sky_size, from, offset_x, offset_y, found, low, high);
      found_here = found;
      low_here = low;
      for (Index l = 0; l < all; ++l) {
        offset_x[l] = reach[l] * turn_x[l % 4];
        offset_y[l] = reach[l] * turn_y[l % 4];
      }
      for (int k = 0; k < 4; ++k) {
        add_hidden<true>(map, from_below, maps.sky_size, from, offset_x, offset_y, found, low, high);
        for (Index l = 0; l < all; ++l) {
          const float x = offset_x[l];
          offset_x[l] = -offset_y[l];
          offset_y[l] = x;
        }
      }
    }
    hidden.fill(0.0F);
    float most = 0.0F;
    for (Index l = 0; l < all; ++l) most = std::max(most, found[l]);
    if (most > 0.0F) {
      for (Index l = 0; l < all; ++l) {
        // How far away what hides the sky is decides how blurred its shadow is: where a body's border is seen
        // along the direction, that is in the middle between its two sides; under it its lower side, so that
        // nothing shines in where it touches the ground.
        const float middle = 0.5F * (low[l] + high[l]) / std::max(found[l], 1e-6F);
        reach[l] = spread * (low_here[l] + (1.0F - found_here[l]) * middle);
      }
      for (int k = 0; k < taps; ++k) {
        for (Index l = 0; l < all; ++l) {
          const float turns = 0.25F * static_cast<float>(l % 4);
          const float r =
              reach[l] * std::sqrt((static_cast<float>(k) + 0.125F + turns) / static_cast<float>(taps));
          offset_x[l] = r * turn_x[l % 4];
          offset_y[l] = r * turn_y[l % 4];
        }
        add_hidden<false>(map, from_below, maps.sky_size, from, offset_x, offset_y, hidden, hidden, hidden);
        for (Index q = 0; q < 4; ++q) {
          const float x = turn_x[q];
          turn_x[q] = -0.7373688F * x - 0.6754902F * turn_y[q];
          turn_y[q] = 0.6754902F * x - 0.7373688F * turn_y[q];
        }
      }
    }
    for (Index l = 0; l < all; ++l) {
      light[l] = std::max(from.normal.z[l], 0.0F);
      // Where nothing was found, the taps are all at the middle, where nothing is.
      open[l] = light[l] * (1.0F - hidden[l] / static_cast<float>(taps));
    }
    add_light(frame.sky[i].radiance, light, total);
    add_light(frame.sky[i].radiance, open, left);
  }
  divide(left, total, seen.diffuse);
  seen.mirrored = seen.diffuse;
  seen.below.fill(1.0F);
}

}  // namespace lagomorph::render::raster
