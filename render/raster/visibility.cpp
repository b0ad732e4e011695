#include "render/raster/visibility.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "render/simd.h"

#if defined(__GNUC__) && !defined(__clang__)
#define LAGOMORPH_SCALAR __attribute__((noinline, optimize("no-tree-vectorize", "no-tree-slp-vectorize")))
#else
#define LAGOMORPH_SCALAR
#endif

namespace lagomorph::render::raster {
namespace {

using Index = std::size_t;
constexpr Index all = lanes;
constexpr int most_taps = 64;

/// Point k of n of a Fibonacci lattice on [-1, 1]^2.
Vec2 lattice_point(int k, int n) {
  const double across = (k + 0.5) / n, up = 0.5 + 0.61803398874989485 * k;
  return {static_cast<float>(2.0 * across - 1.0), static_cast<float>(2.0 * (up - std::floor(up)) - 1.0)};
}

/// Of 4 n points, the n that each pixel of a quad takes: every fourth.
struct Lattice {
  struct alignas(64) Row {
    Lanes x, y;
  };
  std::array<Row, most_taps> rows;

  explicit Lattice(int taps) {
    for (int k = 0; k < taps; ++k) {
      for (int l = 0; l < lanes; ++l) {
        const Vec2 p = lattice_point(4 * k + l % 4, 4 * taps);
        rows[static_cast<Index>(k)].x[static_cast<Index>(l)] = p.x();
        rows[static_cast<Index>(k)].y[static_cast<Index>(l)] = p.y();
      }
    }
  }
};

/// Kept for all numbers of taps that occur; each is made once.
const Lattice& lattice(int taps) {
  static const std::vector<Lattice> lattices = [] {
    std::vector<Lattice> made;
    for (int n = 1; n <= most_taps; ++n) made.emplace_back(n);
    return made;
  }();
  return lattices[static_cast<Index>(taps - 1)];
}

/// Without a branch.
LAGOMORPH_INLINE bool both(bool a, bool b) { return (static_cast<int>(a) & static_cast<int>(b)) != 0; }

LAGOMORPH_INLINE bool any(const std::array<int, lanes>& mask) {
  int sum = 0;
  for (Index l = 0; l < all; ++l) sum |= mask[l];
  return sum != 0;
}

/// Sums over those of the quad's four pixels that see the same surface, to judge by their depths.
LAGOMORPH_INLINE void quad_sum(const Lanes& depth, const Lanes& tolerance, const Lanes& a, const Lanes& b,
                               Lanes& sum_a, Lanes& sum_b) {
  for (Index l = 0; l < all; ++l) {
    sum_a[l] = a[l];
    sum_b[l] = b[l];
    for (Index other = 1; other < 4; ++other) {
      const Index k = l ^ other;
      const bool alike = std::abs(depth[k] - depth[l]) < tolerance[l];
      sum_a[l] += alike ? a[k] : 0.0F;
      sum_b[l] += alike ? b[k] : 0.0F;
    }
  }
}

/// The light's map as the taps read it, and the receivers in the light's frame.
struct alignas(64) LightTaps {
  const DepthMap::value_type* map;
  int size;
  float scale_x, scale_y, offset_x, offset_y;    // tangents to texels
  float tangent_x, tangent_y, first_x, first_y;  // and back
  float reciprocal_scale, reciprocal_offset;     // depths to 1 / distance
  Lanes tangent_at_x, tangent_at_y, reciprocal,
      plane;  // `plane`: distance of the plane that blockers are above
  Lanes3 normal;
};

/// Texels of one batch: of four taps or the four around a tap, all lanes of one after those of another.
constexpr int batch = 4;
using BatchIndices = std::array<std::int32_t, batch * lanes>;

/// One by one: gathering by vector instructions takes twice as long.
LAGOMORPH_SCALAR void look_up(const DepthMap::value_type* map, const std::int32_t* at, Index count,
                              std::int32_t* values) {
  for (Index i = 0; i < count; ++i) values[i] = map[at[i]];
}

/// Over the lattice, of points within `reach` of each receiver: the sum of 1 / distance over what blocks the
/// light, and how much does; nothing where it is not wanted.
template <bool see_through>
LAGOMORPH_INLINE void add_taps(const LightTaps& t, const Lattice& points, int taps, const Lanes& reach_x,
                               const Lanes& reach_y, const std::array<int, lanes>& wanted, Lanes& sum,
                               Lanes& count) {
  alignas(64) Lanes s{}, c{};
  alignas(64) BatchIndices at;
  alignas(64) std::array<std::int32_t, batch * lanes> texel_x, texel_y;
  alignas(64) BatchIndices depth;
  const std::int32_t last = t.size - 1;
  const auto limit = static_cast<float>(last);
  // Where a tap looks: one texel, or four, for some only have dots.
  constexpr int texels = see_through ? batch : 1;
  constexpr float part = 1.0F / static_cast<float>(texels);
  for (int first = 0; first < taps; first += batch / texels) {
    const int rows = see_through ? batch : std::min(batch, taps - first);
    for (int row = 0; row < rows; ++row) {
      const Lattice::Row& p = points.rows[static_cast<Index>(see_through ? first : first + row)];
      const Index base = static_cast<Index>(row) * all;
      for (Index l = 0; l < all; ++l) {
        const float shift = see_through ? 0.5F : 0.0F;
        const float u = (t.tangent_at_x[l] + p.x[l] * reach_x[l]) * t.scale_x + t.offset_x - shift;
        const float v = (t.tangent_at_y[l] + p.y[l] * reach_y[l]) * t.scale_y + t.offset_y - shift;
        auto x = static_cast<std::int32_t>(std::min(std::max(u, 0.0F), limit));
        auto y = static_cast<std::int32_t>(std::min(std::max(v, 0.0F), limit));
        if constexpr (see_through) {
          x = std::min(x + (row & 1), last);
          y = std::min(y + (row >> 1), last);
        }
        texel_x[base + l] = x;
        texel_y[base + l] = y;
        at[base + l] = y * t.size + x;
      }
    }
    look_up(t.map, at.data(), static_cast<Index>(rows) * all, depth.data());
    for (int row = 0; row < rows; ++row) {
      const Index base = static_cast<Index>(row) * all;
      for (Index l = 0; l < all; ++l) {
        const float reciprocal =
            static_cast<float>(depth[base + l]) * t.reciprocal_scale + t.reciprocal_offset;
        const float centre_x = (static_cast<float>(texel_x[base + l]) + 0.5F) * t.tangent_x + t.first_x;
        const float centre_y = (static_cast<float>(texel_y[base + l]) + 0.5F) * t.tangent_y + t.first_y;
        const bool blocks = both(
            both(depth[base + l] != no_depth, reciprocal > t.reciprocal[l]),
            t.normal.x[l] * centre_x + t.normal.y[l] * centre_y + t.normal.z[l] > t.plane[l] * reciprocal);
        s[l] += blocks ? part * reciprocal : 0.0F;
        c[l] += blocks ? part : 0.0F;
      }
    }
  }
  for (Index l = 0; l < all; ++l) {
    sum[l] = wanted[l] != 0 ? s[l] : 0.0F;
    count[l] = wanted[l] != 0 ? c[l] : 0.0F;
  }
}

template <bool see_through>
LAGOMORPH_INLINE void visibility_of(const FrameBlock& frame, const DepthMaps& maps, int number,
                                    const Receivers& at, Lanes& seen) {
  const LightBlock& light = frame.lights[static_cast<Index>(number)];
  seen.fill(1.0F);
  const auto size = static_cast<float>(maps.light_size);
  // Over so many texels the dots of what is seen through even out.
  constexpr float least_reach = see_through ? 4.0F : 1.0F;
  LightTaps t;
  t.map = maps.lights[static_cast<Index>(number)].data();
  t.size = maps.light_size;
  t.scale_x = size * light.map[0], t.scale_y = size * light.map[1];
  t.offset_x = size * light.map[2], t.offset_y = size * light.map[3];
  t.tangent_x = 1.0F / t.scale_x, t.tangent_y = 1.0F / t.scale_y;
  t.first_x = -light.map[2] / light.map[0], t.first_y = -light.map[3] / light.map[1];
  t.reciprocal_scale = light.depth[0] / no_depth, t.reciprocal_offset = light.depth[1];
  const float half_x = light.right[3], half_y = light.up[3];
  const float least_x = least_reach * t.tangent_x, least_y = least_reach * t.tangent_y;

  alignas(64) Lanes distance, depth, tolerance, reach_x, reach_y;
  alignas(64) std::array<int, lanes> wanted;
  for (Index l = 0; l < all; ++l) {
    const float px = at.point.x[l] - light.position[0];
    const float py = at.point.y[l] - light.position[1];
    const float pz = at.point.z[l] - light.position[2];
    const float nx = at.flat_normal.x[l], ny = at.flat_normal.y[l], nz = at.flat_normal.z[l];
    const float qx = px * light.right[0] + py * light.right[1] + pz * light.right[2];
    const float qy = px * light.up[0] + py * light.up[1] + pz * light.up[2];
    const float qz = px * light.normal[0] + py * light.normal[1] + pz * light.normal[2];
    t.normal.x[l] = nx * light.right[0] + ny * light.right[1] + nz * light.right[2];
    t.normal.y[l] = nx * light.up[0] + ny * light.up[1] + nz * light.up[2];
    t.normal.z[l] = nx * light.normal[0] + ny * light.normal[1] + nz * light.normal[2];
    t.reciprocal[l] = 1.0F / std::max(qz, 1e-6F);
    t.tangent_at_x[l] = qx * t.reciprocal[l];
    t.tangent_at_y[l] = qy * t.reciprocal[l];
    t.plane[l] = t.normal.x[l] * qx + t.normal.y[l] * qy + t.normal.z[l] * qz + light.depth[3] +
                 2.0F * at.footprint[l];
    // A surface that the whole rectangle is behind gets none of its light.
    const float sx = at.normal.x[l], sy = at.normal.y[l], sz = at.normal.z[l];
    const float above = std::abs(sx * light.right[0] + sy * light.right[1] + sz * light.right[2]) * half_x +
                        std::abs(sx * light.up[0] + sy * light.up[1] + sz * light.up[2]) * half_y -
                        (sx * px + sy * py + sz * pz);
    const int lit = static_cast<int>(at.there[l] != 0) & static_cast<int>(above > 0.0F);
    distance[l] = std::max(qz, 0.0F);
    depth[l] = lit != 0 ? at.depth[l] : -1e9F;  // unlike the others'
    tolerance[l] = 10.0F * at.footprint[l];
    const float farther = std::max(light.depth[2] - t.reciprocal[l], 0.0F);
    reach_x[l] = half_x * farther + least_x;
    reach_y[l] = half_y * farther + least_y;
    const int inside = static_cast<int>(qz > 0.0F) & static_cast<int>(t.reciprocal[l] < light.depth[2]) &
                       static_cast<int>((t.tangent_at_x[l] - reach_x[l]) * t.scale_x + t.offset_x < size) &
                       static_cast<int>((t.tangent_at_y[l] - reach_y[l]) * t.scale_y + t.offset_y < size) &
                       static_cast<int>((t.tangent_at_x[l] + reach_x[l]) * t.scale_x + t.offset_x > 0.0F) &
                       static_cast<int>((t.tangent_at_y[l] + reach_y[l]) * t.scale_y + t.offset_y > 0.0F);
    wanted[l] = lit & inside;
  }
  if (!any(wanted)) return;
  alignas(64) Lanes sum, count, found_sum, found_count;
  const int search_taps = static_cast<int>(frame.shadow_taps[0]);
  add_taps<see_through>(t, lattice(search_taps), search_taps, reach_x, reach_y, wanted, sum, count);
  quad_sum(depth, tolerance, sum, count, found_sum, found_count);
  for (Index l = 0; l < all; ++l) wanted[l] = static_cast<int>(found_count[l] > 0.0F);
  if (!any(wanted)) return;
  alignas(64) Lanes spread_x, spread_y, taken, blocked, shared, shared_taken;
  const int filter_taps = static_cast<int>(frame.shadow_taps[1]);
  for (Index l = 0; l < all; ++l) {
    const float nearer = found_sum[l] / std::max(found_count[l], 1.0F / 64.0F) - t.reciprocal[l];
    spread_x[l] = std::max(half_x * nearer, least_x);
    spread_y[l] = std::max(half_y * nearer, least_y);
    taken[l] = static_cast<float>(filter_taps);
  }
  add_taps<see_through>(t, lattice(filter_taps), filter_taps, spread_x, spread_y, wanted, sum, blocked);
  // Where the penumbra is hardly wider than a pixel, the quad's mean would only make blocks.
  quad_sum(depth, tolerance, blocked, taken, shared, shared_taken);
  for (Index l = 0; l < all; ++l) {
    const float pixels = std::min(spread_x[l], spread_y[l]) * distance[l] / at.footprint[l];
    const float share = std::min(std::max(0.5F * pixels - 0.5F, 0.0F), 1.0F);
    const float alone = blocked[l] / taken[l];
    seen[l] = 1.0F - (alone + share * (shared[l] / shared_taken[l] - alone));
  }
}

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

/// What hides the sky through points of a direction's map, bilinear over four texels: how much, and that
/// times how far above the receiver. The same test as for the lights.
LAGOMORPH_INLINE void add_hidden(const DepthMap::value_type* map, int size, const Sightlines& from,
                                 const Lanes& offset_x, const Lanes& offset_y, Lanes& hidden, Lanes& height) {
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
  for (int corner = 0; corner < batch; ++corner) {
    const bool right = (corner & 1) != 0, upper = (corner >> 1) != 0;
    const Index base = static_cast<Index>(corner) * all;
    for (Index l = 0; l < all; ++l) {
      const float dx = offset_x[l] - part_x[l] * step + (right ? step : 0.0F);
      const float dy = offset_y[l] - part_y[l] * step + (upper ? step : 0.0F);
      const float weight = (right ? part_x[l] : 1.0F - part_x[l]) * (upper ? part_y[l] : 1.0F - part_y[l]);
      const float rise = depth[base + l] == no_depth
                             ? -1e9F
                             : 1.0F - scale * static_cast<float>(depth[base + l]) - from.at.z[l];
      const float above = from.normal.x[l] * dx + from.normal.y[l] * dy + from.normal.z[l] * rise;
      const bool hides = both(rise > least, above > least);
      hidden[l] += hides ? weight : 0.0F;
      height[l] += hides ? weight * rise : 0.0F;
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

}  // namespace

LAGOMORPH_RENDER_SIMD void light_visibility(const FrameBlock& frame, const DepthMaps& maps, int light,
                                            const Receivers& at, Lanes& seen) {
  maps.see_through ? visibility_of<true>(frame, maps, light, at, seen)
                   : visibility_of<false>(frame, maps, light, at, seen);
}

LAGOMORPH_RENDER_SIMD void sky_seen(const FrameBlock& frame, const DepthMaps& maps, const Receivers& at,
                                    SkySeen& seen) {
  alignas(64) Lanes3 total, left, total_mirrored, left_mirrored;
  for (Lanes3* sum : {&total, &left, &total_mirrored, &left_mirrored}) fill(*sum, 1e-6F);
  alignas(64) constexpr Lanes nowhere{};
  alignas(64) Lanes light, open, hidden, height;
  Sightlines from;
  for (Index i = 0; i < maps.sky.size(); ++i) {
    look_along(frame, i, at, from);
    float highest = -1.0F;
    for (Index l = 0; l < all; ++l) highest = std::max(highest, from.normal.z[l]);
    if (highest <= 0.0F) continue;  // its light falls on their backs
    hidden.fill(0.0F);
    height.fill(0.0F);
    add_hidden(maps.sky[i].data(), maps.sky_size, from, nowhere, nowhere, hidden, height);
    for (Index l = 0; l < all; ++l) {
      light[l] = std::max(from.normal.z[l], 0.0F);
      open[l] = light[l] * (1.0F - hidden[l]);
    }
    add_light(frame.sky[i].radiance, light, total);
    add_light(frame.sky[i].radiance, open, left);
    if (!maps.sky_is_map) continue;
    // Of a lobe around the mirrored view, no narrower than a direction's part of the sky.
    const Vec4& d = frame.sky[i].direction;
    for (Index l = 0; l < all; ++l) {
      const float sharpness = 12.0F - 10.0F * at.roughness[l];
      const float cosine = at.mirrored.x[l] * d[0] + at.mirrored.y[l] * d[1] + at.mirrored.z[l] * d[2];
      const float s = std::min(std::max(5.0F * from.normal.z[l], 0.0F), 1.0F);
      light[l] = std::exp(sharpness * (cosine - 1.0F)) * s * s * (3.0F - 2.0F * s);
      open[l] = light[l] * (1.0F - hidden[l]);
    }
    add_light(frame.sky[i].radiance, light, total_mirrored);
    add_light(frame.sky[i].radiance, open, left_mirrored);
  }
  divide(left, total, seen.diffuse);
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
  alignas(64) Lanes light, open, hidden, height, offset_x, offset_y, reach;
  Sightlines from;
  for (Index i = 0; i < maps.sky.size(); ++i) {
    look_along(frame, i, at, from);
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
    alignas(64) Lanes found{}, found_height{};
    if (meets) {
      offset_x.fill(0.0F);
      offset_y.fill(0.0F);
      add_hidden(maps.sky[i].data(), maps.sky_size, from, offset_x, offset_y, found, found_height);
      for (Index l = 0; l < all; ++l) {
        offset_x[l] = reach[l] * turn_x[l % 4];
        offset_y[l] = reach[l] * turn_y[l % 4];
      }
      for (int k = 0; k < 4; ++k) {
        add_hidden(maps.sky[i].data(), maps.sky_size, from, offset_x, offset_y, found, found_height);
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
      for (Index l = 0; l < all; ++l) reach[l] = spread * found_height[l] / std::max(found[l], 1e-6F);
      for (int k = 0; k < taps; ++k) {
        for (Index l = 0; l < all; ++l) {
          const float turns = 0.25F * static_cast<float>(l % 4);
          const float r =
              reach[l] * std::sqrt((static_cast<float>(k) + 0.125F + turns) / static_cast<float>(taps));
          offset_x[l] = r * turn_x[l % 4];
          offset_y[l] = r * turn_y[l % 4];
        }
        add_hidden(maps.sky[i].data(), maps.sky_size, from, offset_x, offset_y, hidden, height);
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
}

}  // namespace lagomorph::render::raster
