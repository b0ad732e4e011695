#include "render/raster/soft_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "render/raster/light_parts.h"
#include "render/raster/light_visibility.h"
#include "render/simd.h"

namespace lagomorph::render::raster {
namespace {

/// Pixels [left, right) x [lower, upper), whole blocks.
struct Bounds {
  int left = 0, right = 0, lower = 0, upper = 0;
};

/// Around the blocks that have something in them.
Bounds bounds_of(const ReceiverBlocks& at) {
  Bounds b{at.width(), 0, at.height(), 0};
  at.for_each([&](int x, int y, const Receivers&) {
    b.left = std::min(b.left, x), b.right = std::max(b.right, x + block_width);
    b.lower = std::min(b.lower, y), b.upper = std::max(b.upper, y + block_height);
  });
  return b;
}

/// A value for each of those pixels, with a border of one. Places are those of the whole.
class Plane {
public:
  Plane(const Bounds& at, float value)
      : at_(at),
        stride_(at.right - at.left + 2),
        values_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(at.upper - at.lower + 2),
                value) {}

  /// Pixel x of the row is at [x - left()].
  float* row(int y) { return values_.data() + place(y); }
  const float* row(int y) const { return values_.data() + place(y); }
  int left() const { return at_.left; }
  void put(int x, int y, const Lanes& from) {
    for (int lane = 0; lane < lanes; ++lane)
      row(y + raster::row(lane))[x - at_.left + column(lane)] = from[static_cast<std::size_t>(lane)];
  }
  void get(int x, int y, Lanes& to) const {
    for (int lane = 0; lane < lanes; ++lane)
      to[static_cast<std::size_t>(lane)] = row(y + raster::row(lane))[x - at_.left + column(lane)];
  }

private:
  std::ptrdiff_t place(int y) const { return stride_ * (y - at_.lower + 1) + 1; }

  Bounds at_;
  std::ptrdiff_t stride_;
  std::vector<float> values_;
};

/// Of rows y - 1, y and y + 1.
struct Rows {
  std::array<const float*, 3> of;
  Rows(const Plane& plane, int y) : of{plane.row(y - 1), plane.row(y), plane.row(y + 1)} {}
};

/// Weighted sums of two values over pixels of the same surface, of pixels [first, last) of a row.
LAGOMORPH_RENDER_SIMD void add_neighbours(const Rows& depth, const float* tolerance, const Rows& a,
                                          const Rows& b, std::ptrdiff_t first, std::ptrdiff_t last,
                                          float* sum_a, float* sum_b) {
  constexpr std::array<float, 3> weights = {1.0F, 2.0F, 1.0F};
  const Rows d = depth, of_a = a, of_b = b;
  LAGOMORPH_ROWS
  for (std::ptrdiff_t x = first; x < last; ++x) {
    const float here = d.of[1][x], reach = tolerance[x];
    float total_a = 0.0F, total_b = 0.0F;
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::ptrdiff_t at = x + static_cast<std::ptrdiff_t>(i) - 1;
        const float part = std::abs(d.of[j][at] - here) < reach ? weights[j] * weights[i] : 0.0F;
        total_a += part * of_a.of[j][at];
        total_b += part * of_b.of[j][at];
      }
    }
    sum_a[x] = total_a;
    sum_b[x] = total_b;
  }
}

/// Pixels [first, last) of each row, from the left bound, that are in blocks with something in them.
struct Span {
  int first = 0, last = 0;
};
std::vector<Span> spans_of(const ReceiverBlocks& at, const Bounds& bounds) {
  std::vector<Span> spans(static_cast<std::size_t>(bounds.upper - bounds.lower));
  at.for_each([&](int x, int y, const Receivers&) {
    for (int row = y; row < y + block_height; ++row) {
      Span& span = spans[static_cast<std::size_t>(row - bounds.lower)];
      if (span.last == 0) span.first = x - bounds.left;
      span.last = x - bounds.left + block_width;
    }
  });
  return spans;
}

constexpr float unlike_all = -3e9F;

/// Of a part of a light, which soft_shadow() puts together; nothing where all is seen.
std::optional<Plane> shadow_of_part(const DepthMaps& maps, std::size_t part, const ReceiverBlocks& at,
                                    const Bounds& bounds) {
  const auto spacing = static_cast<float>(at.step);
  Plane depth(bounds, unlike_all), tolerance(bounds, 0.0F), nearness(bounds, 0.0F), taps(bounds, 0.0F);
  bool any_blocked = false;
  at.for_each([&](int x, int y, const Receivers& r) {
    Blockers found;
    find_blockers(maps, part, r, spacing, found);
    Lanes reach;
    std::transform(r.footprint.begin(), r.footprint.end(), reach.begin(), [](float f) { return 10.0F * f; });
    depth.put(x, y, found.depth);
    tolerance.put(x, y, reach);
    nearness.put(x, y, found.nearness);
    taps.put(x, y, found.taps);
    any_blocked |= std::any_of(found.taps.begin(), found.taps.end(), [](float t) { return t > 0.0F; });
  });
  if (!any_blocked) return std::nullopt;
  const std::vector<Span> spans = spans_of(at, bounds);
  const auto for_rows = [&](const auto& row) {
    for (int y = bounds.lower; y < bounds.upper; ++y)
      row(y, spans[static_cast<std::size_t>(y - bounds.lower)]);
  };
  Plane shared_nearness(bounds, 0.0F), shared_taps(bounds, 0.0F);
  for_rows([&](int y, const Span& span) {
    add_neighbours({depth, y}, tolerance.row(y), {nearness, y}, {taps, y}, span.first, span.last,
                   shared_nearness.row(y), shared_taps.row(y));
  });
  Plane& blocked = nearness;  // their room
  Plane& share = taps;
  at.for_each([&](int x, int y, const Receivers& r) {
    Blockers found;
    shared_nearness.get(x, y, found.nearness);
    shared_taps.get(x, y, found.taps);
    Shadow shadow;
    filter_shadow(maps, part, r, found, spacing, shadow);
    blocked.put(x, y, shadow.blocked);
    share.put(x, y, shadow.share);
  });
  const Plane one(bounds, 1.0F);
  Plane &sum = shared_nearness, &count = shared_taps;
  for_rows([&](int y, const Span& span) {
    add_neighbours({depth, y}, tolerance.row(y), {blocked, y}, {one, y}, span.first, span.last, sum.row(y),
                   count.row(y));
  });
  for_rows([&](int y, const Span& span) {
    float* const seen = sum.row(y);
    for (int x = span.first; x < span.last; ++x) {
      const float alone = blocked.row(y)[x];
      const float mean = count.row(y)[x] > 0.0F ? seen[x] / count.row(y)[x] : alone;
      seen[x] = 1.0F - (alone + share.row(y)[x] * (mean - alone));
    }
  });
  return std::move(sum);
}

/// Of all parts, by what each gives.
void put_together(const FrameBlock& frame, const DepthMaps& maps, const LightParts& parts,
                  const std::vector<std::optional<Plane>>& of_parts, const Receivers& r, int x, int y,
                  Lanes& seen) {
  std::array<Lanes, most_parts_along * most_parts_along> part_seen;
  bool any_hidden = parts.below_ground && !r.is_ground;
  for (std::size_t k = 0; k < parts.count; ++k) {
    part_seen[k].fill(1.0F);
    if (of_parts[k]) of_parts[k]->get(x, y, part_seen[k]);
    any_hidden |= std::any_of(part_seen[k].begin(), part_seen[k].end(), [](float s) { return s < 1.0F; });
  }
  seen.fill(1.0F);
  if (!any_hidden) return;
  Lanes given{}, arriving{};
  for (std::size_t k = 0; k < parts.count; ++k) {
    PartLight light;
    light_of_part(frame, maps.parts[parts.first + k].light, r, light);
    for (std::size_t l = 0; l < lanes; ++l) {
      given[l] += light.whole[l];
      arriving[l] += light.past_ground[l] * part_seen[k][l];
    }
  }
  for (std::size_t l = 0; l < lanes; ++l) {
    if (given[l] > 0.0F) seen[l] = arriving[l] / given[l];
  }
}

}  // namespace

void soft_shadow(const FrameBlock& frame, const DepthMaps& maps, int light, const ReceiverBlocks& at,
                 std::vector<float>& seen) {
  const LightParts& parts = maps.lights[static_cast<std::size_t>(light)];
  const auto width = static_cast<std::size_t>(at.width());
  seen.assign(width * static_cast<std::size_t>(at.height()), 1.0F);
  const Bounds bounds = bounds_of(at);
  if (bounds.right <= bounds.left) return;
  std::vector<std::optional<Plane>> of_parts;
  of_parts.reserve(parts.count);
  for (std::size_t k = 0; k < parts.count; ++k)
    of_parts.push_back(shadow_of_part(maps, parts.first + k, at, bounds));
  const bool alone = parts.count == 1 && !parts.below_ground;
  if (alone && !of_parts[0]) return;
  at.for_each([&](int x, int y, const Receivers& r) {
    Lanes of_block;
    if (alone) {
      of_parts[0]->get(x, y, of_block);
    } else {
      put_together(frame, maps, parts, of_parts, r, x, y, of_block);
    }
    for (int lane = 0; lane < lanes; ++lane) {
      seen[static_cast<std::size_t>(y + row(lane)) * width + static_cast<std::size_t>(x + column(lane))] =
          of_block[static_cast<std::size_t>(lane)];
    }
  });
}

}  // namespace lagomorph::render::raster
