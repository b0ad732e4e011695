#include "render/raster/light_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "render/simd.h"

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

/// Of a pixel, on [-1, 1]^2, as many points as taps: of all pixels the same, so that edges are smooth
/// [Roberts 2018].
const std::array<Vec2, most_taps>& pixel_points() {
  static const std::array<Vec2, most_taps> points = [] {
    std::array<Vec2, most_taps> made;
    for (int k = 0; k < most_taps; ++k) {
      const double x = 0.5 + 0.7548776662466927 * k, y = 0.5 + 0.5698402909980532 * k;
      made[static_cast<Index>(k)] = Vec2(static_cast<float>(2.0 * (x - std::floor(x)) - 1.0),
                                         static_cast<float>(2.0 * (y - std::floor(y)) - 1.0));
    }
    return made;
  }();
  return points;
}

/// What a pixel covers in the light's view, as tangents: half its width and half its height.
struct alignas(64) Footprint {
  Lanes width_x, width_y, height_x, height_y;
};

/// The light's map as the taps read it, and the receivers in the light's frame.
struct alignas(64) LightTaps {
  const DepthMap::value_type* map;
  int size;
  float scale_x, scale_y, offset_x, offset_y;    // tangents to texels
  float tangent_x, tangent_y, first_x, first_y;  // and back
  float reciprocal_scale, reciprocal_offset;     // depths to 1 / distance
  float closest;                                 // 1 / distance that a texel is as wide for as the light
  float half_x, half_y;                          // of the light [m]
  float least_x, least_y;                        // of any reach, as tangents
  Lanes tangent_at_x, tangent_at_y, reciprocal;
  Lanes plane;  // distance of the plane that blockers are above
  Lanes3 normal;
  Lanes height, height_x, height_y;  // of the light's points (x, y) of [-1, 1]^2 above that plane [m]
  Lanes rise;                        // of a blocker at `closest`, from its height to how much it hides
};

/// Over the lattice, of points within `reach` of each receiver: how much blocks the light, and of a search
/// the sum of 1 / distance over that, else how much could; nothing where it is not wanted. What is seen at a
/// tap counts only where the receiver sees it before the light, or not further beside it than `slack` times
/// the light's size. A search counts what is nearer to the receiver more, which hides more of the light; else
/// a point of the light counts by its height above the surface, as its light does. `covers`: each tap is of
/// another point of the pixel.
template <bool see_through, bool search, bool covers = false>
LAGOMORPH_INLINE void add_taps(const LightTaps& t, const Lattice& points, int taps, const Lanes& reach_x,
                               const Lanes& reach_y, float slack, const std::array<int, lanes>& wanted,
                               Lanes& sum, Lanes& count, const Footprint* pixel = nullptr) {
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
      [[maybe_unused]] float across = 0.0F, up = 0.0F;
      if constexpr (covers) {
        const Vec2& q = pixel_points()[static_cast<Index>(see_through ? first : first + row)];
        across = q.x(), up = q.y();
      }
      for (Index l = 0; l < all; ++l) {
        const float shift = see_through ? 0.5F : 0.0F;
        float tangent_x = t.tangent_at_x[l] + p.x[l] * reach_x[l];
        float tangent_y = t.tangent_at_y[l] + p.y[l] * reach_y[l];
        if constexpr (covers) {
          tangent_x += across * pixel->width_x[l] + up * pixel->height_x[l];
          tangent_y += across * pixel->width_y[l] + up * pixel->height_y[l];
        }
        const float u = tangent_x * t.scale_x + t.offset_x - shift;
        const float v = tangent_y * t.scale_y + t.offset_y - shift;
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
      const Lattice::Row& p = points.rows[static_cast<Index>(see_through ? first : first + row)];
      const Index base = static_cast<Index>(row) * all;
      for (Index l = 0; l < all; ++l) {
        const float reciprocal =
            static_cast<float>(depth[base + l]) * t.reciprocal_scale + t.reciprocal_offset;
        const float centre_x = (static_cast<float>(texel_x[base + l]) + 0.5F) * t.tangent_x + t.first_x;
        const float centre_y = (static_cast<float>(texel_y[base + l]) + 0.5F) * t.tangent_y + t.first_y;
        const float nearer = reciprocal - t.reciprocal[l];
        const bool before = both(std::abs(p.x[l]) * reach_x[l] < slack * t.half_x * nearer + t.least_x,
                                 std::abs(p.y[l]) * reach_y[l] < slack * t.half_y * nearer + t.least_y);
        const float above =
            t.normal.x[l] * centre_x + t.normal.y[l] * centre_y + t.normal.z[l] - t.plane[l] * reciprocal;
        const bool blocks =
            both(both(depth[base + l] != no_depth, both(before, nearer > 0.0F)), above > 0.0F);
        float weight, rise;
        if constexpr (search) {
          weight = t.closest / (std::max(nearer, 0.0F) + t.closest);
          rise = t.rise[l] * weight;
        } else {
          weight = std::max(t.height[l] + p.x[l] * t.height_x[l] + p.y[l] * t.height_y[l], 0.0F);
          rise = t.rise[l];
          s[l] += part * weight;
        }
        const float blocked = blocks ? part * weight * std::min(above * rise, 1.0F) : 0.0F;
        if constexpr (search) s[l] += blocked * reciprocal;
        c[l] += blocked;
      }
    }
  }
  for (Index l = 0; l < all; ++l) {
    sum[l] = wanted[l] != 0 ? s[l] : 0.0F;
    count[l] = wanted[l] != 0 ? c[l] : 0.0F;
  }
}

/// The same; `pixel` is nullptr where nothing of it is worth the while.
template <bool see_through, bool search>
LAGOMORPH_INLINE void add_taps_over(const Footprint* pixel, const LightTaps& t, int taps,
                                    const Lanes& reach_x, const Lanes& reach_y, float slack,
                                    const std::array<int, lanes>& wanted, Lanes& sum, Lanes& count) {
  const Lattice& points = lattice(taps);
  if (pixel != nullptr) {
    add_taps<see_through, search, true>(t, points, taps, reach_x, reach_y, slack, wanted, sum, count, pixel);
  } else {
    add_taps<see_through, search>(t, points, taps, reach_x, reach_y, slack, wanted, sum, count);
  }
}

/// Of the light's size, see add_taps().
struct Slack {
  float search, filter;
};
// Bodies go on below what the light sees of them, which reaches into the light from further beside it. With
// more, a hollow's own sides, low above the receiver, would count as well; the ground has none.
constexpr Slack slack_of_bodies = {3.0F, 1.5F}, slack_of_ground = {1e9F, 1e9F};
LAGOMORPH_INLINE const Slack& slack_of(const Receivers& at) {
  return at.is_ground ? slack_of_ground : slack_of_bodies;
}

/// What is lower above the receiver's horizon than this part of the light's highest point hides less, down to
/// nothing: light from there is hardly any, and in a hollow, where the triangles around lie that low, which
/// of them are above the horizon would show.
constexpr float low_part = 0.15F;

/// The rectangle that blockers are looked for in.
struct alignas(64) Search {
  LightTaps taps;
  Lanes distance, reach_x, reach_y;
  std::array<int, lanes> lit, beyond;  // the light is not behind the surface; something may be before it
};

/// Half of it, as a tangent. What is nearer to the light than its width, as a floor that goes on beneath it,
/// is found only before it: of the taps of a wider search few would be left for all that is farther away.
constexpr float widest_search = 0.25F;

// Over so many texels the dots of what is seen through even out.
template <bool see_through>
constexpr float least_reach = see_through ? 4.0F : 1.0F;
// A light's only shadow on a plane: so that an edge aslant to the texels shows no steps.
template <bool see_through>
constexpr float least_reach_of_edges = see_through ? 4.0F : 1.5F;

/// Half of `pixels` pixels, by the differences in each quad of receivers `spacing` apart on one surface.
LAGOMORPH_INLINE void cover_pixels(const LightTaps& t, const Receivers& at, float spacing, float pixels,
                                   Footprint& pixel) {
  const float half = 0.5F * pixels / spacing;
  for (Index q = 0; q < all; q += quad) {
    float low = at.depth[q], high = at.depth[q];
    bool whole = at.there[q] != 0;
    for (Index l = q + 1; l < q + quad; ++l) {
      whole = both(whole, at.there[l] != 0);
      low = std::min(low, at.depth[l]);
      high = std::max(high, at.depth[l]);
    }
    const float scale = both(whole, high - low < one_surface * spacing * at.footprint[q]) ? half : 0.0F;
    for (Index l = q; l < q + quad; ++l) {
      const Index left = l & ~Index{1}, lower = l & ~Index{2};
      pixel.width_x[l] = scale * (t.tangent_at_x[left + 1] - t.tangent_at_x[left]);
      pixel.width_y[l] = scale * (t.tangent_at_y[left + 1] - t.tangent_at_y[left]);
      pixel.height_x[l] = scale * (t.tangent_at_x[lower + 2] - t.tangent_at_x[lower]);
      pixel.height_y[l] = scale * (t.tangent_at_y[lower + 2] - t.tangent_at_y[lower]);
    }
  }
}

/// Narrower penumbras [receivers] are hard edges.
constexpr float least_penumbra = 2.0F;

/// Less beside a filter's reach is not worth the while.
constexpr float least_cover = 0.25F;

/// Along the axes, half of it.
LAGOMORPH_INLINE float covered_x(const Footprint& p, Index l) {
  return std::abs(p.width_x[l]) + std::abs(p.height_x[l]);
}
LAGOMORPH_INLINE float covered_y(const Footprint& p, Index l) {
  return std::abs(p.width_y[l]) + std::abs(p.height_y[l]);
}

/// Leaves what is worth the while beside a reach; returns whether any is. Each by itself, whatever its
/// companions in the block do.
LAGOMORPH_INLINE bool keep_wide(const LightTaps& t, const Lanes& reach_x, const Lanes& reach_y,
                                Footprint& pixel) {
  alignas(64) std::array<int, lanes> wide;
  for (Index l = 0; l < all; ++l) {
    // Within some texels: what is seen very much aslant is no reason.
    wide[l] = static_cast<int>(std::min(covered_x(pixel, l), 64.0F * t.least_x) > least_cover * reach_x[l]) |
              static_cast<int>(std::min(covered_y(pixel, l), 64.0F * t.least_y) > least_cover * reach_y[l]);
    const float kept = wide[l] != 0 ? 1.0F : 0.0F;
    for (Lanes* side : {&pixel.width_x, &pixel.width_y, &pixel.height_x, &pixel.height_y}) (*side)[l] *= kept;
  }
  return any(wide);
}

template <bool see_through>
LAGOMORPH_INLINE void look_from_light(const DepthMaps& maps, Index part, const Receivers& at,
                                      Search& search) {
  const LightBlock& light = maps.parts[part].light;
  const auto size = static_cast<float>(maps.parts[part].map_size);
  LightTaps& t = search.taps;
  t.map = maps.parts_maps[part].data();
  t.size = maps.parts[part].map_size;
  t.scale_x = size * light.map[0], t.scale_y = size * light.map[1];
  t.offset_x = size * light.map[2], t.offset_y = size * light.map[3];
  t.tangent_x = 1.0F / t.scale_x, t.tangent_y = 1.0F / t.scale_y;
  t.first_x = -light.map[2] / light.map[0], t.first_y = -light.map[3] / light.map[1];
  t.reciprocal_scale = light.depth[0] / no_depth, t.reciprocal_offset = light.depth[1];
  const float half_x = light.right[3], half_y = light.up[3];
  t.half_x = half_x, t.half_y = half_y;
  const float texels =
      at.is_ground && maps.parts[part].alone ? least_reach_of_edges<see_through> : least_reach<see_through>;
  t.least_x = texels * t.tangent_x, t.least_y = texels * t.tangent_y;
  t.closest = std::max(t.least_x / half_x, t.least_y / half_y);
  for (Index l = 0; l < all; ++l) {
    const float px = at.point.x[l] - light.position[0];
    const float py = at.point.y[l] - light.position[1];
    const float pz = at.point.z[l] - light.position[2];
    const float nx = at.normal.x[l], ny = at.normal.y[l], nz = at.normal.z[l];
    const float qx = px * light.right[0] + py * light.right[1] + pz * light.right[2];
    const float qy = px * light.up[0] + py * light.up[1] + pz * light.up[2];
    const float qz = px * light.normal[0] + py * light.normal[1] + pz * light.normal[2];
    const float across = nx * light.right[0] + ny * light.right[1] + nz * light.right[2];
    const float along = nx * light.up[0] + ny * light.up[1] + nz * light.up[2];
    t.normal.x[l] = across;
    t.normal.y[l] = along;
    t.normal.z[l] = nx * light.normal[0] + ny * light.normal[1] + nz * light.normal[2];
    t.reciprocal[l] = 1.0F / std::max(qz, 1e-6F);
    t.tangent_at_x[l] = qx * t.reciprocal[l];
    t.tangent_at_y[l] = qy * t.reciprocal[l];
    t.plane[l] = t.normal.x[l] * qx + t.normal.y[l] * qy + t.normal.z[l] * qz + light.depth[3] +
                 at.footprint[l] + at.raised[l];
    t.height[l] = -(nx * px + ny * py + nz * pz);
    t.height_x[l] = across * half_x;
    t.height_y[l] = along * half_y;
    // A surface that the whole rectangle is behind gets none of its light.
    const float highest = t.height[l] + std::abs(t.height_x[l]) + std::abs(t.height_y[l]);
    search.lit[l] = static_cast<int>(at.there[l] != 0) & static_cast<int>(highest > 0.0F);
    t.rise[l] = 1.0F / (low_part * t.closest * std::max(highest, 1e-6F));
    search.distance[l] = std::max(qz, 0.0F);
    const float farther = std::max(light.depth[2] - t.reciprocal[l], 0.0F);
    search.reach_x[l] = std::min(half_x * farther, widest_search) + t.least_x;
    search.reach_y[l] = std::min(half_y * farther, widest_search) + t.least_y;
    search.beyond[l] = static_cast<int>(qz > 0.0F) & static_cast<int>(t.reciprocal[l] < light.depth[2]);
  }
}

/// Whether the rectangle that is searched, over all of a pixel, meets the map.
LAGOMORPH_INLINE bool is_inside(const Search& search, const Footprint& pixel, Index l) {
  const LightTaps& t = search.taps;
  const auto size = static_cast<float>(t.size);
  const float reach_x = search.reach_x[l] + covered_x(pixel, l);
  const float reach_y = search.reach_y[l] + covered_y(pixel, l);
  return both(both((t.tangent_at_x[l] - reach_x) * t.scale_x + t.offset_x < size,
                   (t.tangent_at_y[l] - reach_y) * t.scale_y + t.offset_y < size),
              both((t.tangent_at_x[l] + reach_x) * t.scale_x + t.offset_x > 0.0F,
                   (t.tangent_at_y[l] + reach_y) * t.scale_y + t.offset_y > 0.0F));
}

template <bool see_through>
LAGOMORPH_INLINE void blockers_of(const DepthMaps& maps, Index part, const Receivers& at, float spacing,
                                  Blockers& found) {
  Search search;
  look_from_light<see_through>(maps, part, at, search);
  const LightTaps& t = search.taps;
  Footprint pixel{};
  bool covers = false;
  if (maps.parts[part].alone) {
    // Up to the next receivers, or what is narrower than from one to another would be missed.
    cover_pixels(t, at, spacing, spacing > 1.0F ? 2.0F * spacing : 1.0F, pixel);
    covers = keep_wide(t, search.reach_x, search.reach_y, pixel);
  }
  alignas(64) std::array<int, lanes> wanted;
  for (Index l = 0; l < all; ++l) {
    found.depth[l] = search.lit[l] != 0 ? at.depth[l] : -1e9F;
    wanted[l] = search.lit[l] & search.beyond[l] & static_cast<int>(is_inside(search, pixel, l));
  }
  found.nearness.fill(0.0F);
  found.taps.fill(0.0F);
  if (!any(wanted)) return;
  add_taps_over<see_through, true>(covers ? &pixel : nullptr, t, maps.parts[part].search_taps, search.reach_x,
                                   search.reach_y, slack_of(at).search, wanted, found.nearness, found.taps);
}

template <bool see_through>
LAGOMORPH_INLINE void shadow_of(const DepthMaps& maps, Index part, const Receivers& at, const Blockers& found,
                                float spacing, Shadow& shadow) {
  shadow.blocked.fill(0.0F);
  shadow.share.fill(0.0F);
  shadow.hard = 0;
  alignas(64) std::array<int, lanes> wanted;
  for (Index l = 0; l < all; ++l) wanted[l] = static_cast<int>(found.taps[l] > 0.0F);
  if (!any(wanted)) return;
  Search search;
  look_from_light<see_through>(maps, part, at, search);
  const LightTaps& t = search.taps;
  alignas(64) Lanes spread_x, spread_y, total, blocked;
  for (Index l = 0; l < all; ++l) {
    const float nearer = found.nearness[l] / std::max(found.taps[l], 1e-12F) - t.reciprocal[l];
    search.taps.rise[l] *= t.closest / std::max(nearer, 1e-3F * t.closest);
    spread_x[l] = std::max(t.half_x * nearer, t.least_x);
    spread_y[l] = std::max(t.half_y * nearer, t.least_y);
    const float pixels =
        std::min(spread_x[l], spread_y[l]) * search.distance[l] / (spacing * at.footprint[l]);
    // Of what is found alone; the others in the block see all, as they do in one where nothing is wanted.
    const float most = wanted[l] != 0 ? 1.0F : 0.0F;
    shadow.share[l] = std::min(std::max(0.5F * pixels - 0.5F, 0.0F), most);
  }
  Footprint pixel{};
  bool covers = false;
  alignas(64) std::array<int, lanes> hard{};
  if (maps.parts[part].alone) {
    cover_pixels(t, at, spacing, 1.0F, pixel);
    for (Index l = 0; l < all; ++l) {
      // What is seen aslant is farther from its neighbours than its footprint says.
      const float pixels = std::min(spread_x[l] / std::max(covered_x(pixel, l), 1e-12F),
                                    spread_y[l] / std::max(covered_y(pixel, l), 1e-12F));
      shadow.share[l] = std::min(shadow.share[l], std::max(0.5F * pixels / spacing - 0.25F, 0.0F));
      hard[l] = wanted[l] & static_cast<int>(pixels < least_penumbra * spacing);
    }
    covers = keep_wide(t, spread_x, spread_y, pixel);
  }
  add_taps_over<see_through, false>(covers ? &pixel : nullptr, t, maps.parts[part].filter_taps, spread_x,
                                    spread_y, slack_of(at).filter, wanted, total, blocked);
  for (Index l = 0; l < all; ++l) shadow.blocked[l] = blocked[l] / std::max(total[l], 1e-12F);
  for (Index l = 0; l < all; ++l) shadow.hard = static_cast<LaneBits>(shadow.hard | hard[l] << l);
}

/// See light_of_part(); `hides`: some of the part is below the ground.
template <bool hides>
LAGOMORPH_INLINE void light_of(const FrameBlock& frame, const LightBlock& light, const Receivers& at,
                               PartLight& found) {
  constexpr int points = 2;  // along a side
  const float half_x = light.right[3] / points, half_y = light.up[3] / points;
  const float half_height = std::abs(half_x * light.right[1]) + std::abs(half_y * light.up[1]);
  alignas(64) Lanes whole{}, past{};
  for (int k = 0; k < points * points; ++k) {
    const int across = k % points, up = k / points;
    const float i = half_x * static_cast<float>(2 * across + 1 - points);
    const float j = half_y * static_cast<float>(2 * up + 1 - points);
    const float px = light.position[0] + i * light.right[0] + j * light.up[0];
    const float py = light.position[1] + i * light.right[1] + j * light.up[1];
    const float pz = light.position[2] + i * light.right[2] + j * light.up[2];
    // Of the point's quarter, what is below the ground.
    const float over = 0.5F * (py - frame.ground[0]) / std::max(half_height, 1e-6F);
    const float below = std::min(std::max(0.5F - over, 0.0F), 1.0F);
    for (Index l = 0; l < all; ++l) {
      const float dx = px - at.point.x[l], dy = py - at.point.y[l], dz = pz - at.point.z[l];
      const float square = dx * dx + dy * dy + dz * dz;
      const float height = at.normal.x[l] * dx + at.normal.y[l] * dy + at.normal.z[l] * dz;
      // The light's own cosine is one distance, that from its plane, over the point's.
      const float weight = std::max(height, 0.0F) / std::max(square * square, 1e-12F);
      whole[l] += weight;
      if constexpr (hides) {
        const float above = at.point.y[l] - frame.ground[0];
        const float way = std::min(std::max(above, 0.0F) / std::max(-dy, 1e-6F), 1.0F);
        const float gx = at.point.x[l] + way * dx - frame.ground_at[0];
        const float gz = at.point.z[l] + way * dz - frame.ground_at[2];
        const float fade = fade_at(std::sqrt(gx * gx + gz * gz), frame.ground[2], frame.ground[1]);
        past[l] += weight * (above < 0.0F ? 1.0F : 1.0F - below * (1.0F - fade));
      } else {
        past[l] += weight;
      }
    }
  }
  found.whole = whole;
  found.past_ground = past;
}

}  // namespace

LAGOMORPH_RENDER_SIMD void light_of_part(const FrameBlock& frame, const LightBlock& light,
                                         const Receivers& at, PartLight& found) {
  const float low =
      light.position[1] - std::abs(light.right[3] * light.right[1]) - std::abs(light.up[3] * light.up[1]);
  const bool hides = frame.ground[3] > 0.5F && !at.is_ground && low < frame.ground[0];
  hides ? light_of<true>(frame, light, at, found) : light_of<false>(frame, light, at, found);
}

LAGOMORPH_RENDER_SIMD void find_blockers(const DepthMaps& maps, Index part, const Receivers& at,
                                         float spacing, Blockers& found) {
  maps.see_through ? blockers_of<true>(maps, part, at, spacing, found)
                   : blockers_of<false>(maps, part, at, spacing, found);
}

LAGOMORPH_RENDER_SIMD void filter_shadow(const DepthMaps& maps, Index part, const Receivers& at,
                                         const Blockers& found, float spacing, Shadow& shadow) {
  maps.see_through ? shadow_of<true>(maps, part, at, found, spacing, shadow)
                   : shadow_of<false>(maps, part, at, found, spacing, shadow);
}

}  // namespace lagomorph::render::raster
