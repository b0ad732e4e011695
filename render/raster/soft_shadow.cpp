#include "render/raster/soft_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "render/raster/light_visibility.h"
#include "render/simd.h"

namespace lagomorph::render::raster {
namespace {

/// A value a pixel, with a border of one.
class Plane {
public:
  Plane(int width, int height, float value)
      : stride_(static_cast<std::size_t>(width) + 2),
        values_(stride_ * (static_cast<std::size_t>(height) + 2), value) {}

  float* row(int y) { return values_.data() + stride_ * static_cast<std::size_t>(y + 1) + 1; }
  const float* row(int y) const { return values_.data() + stride_ * static_cast<std::size_t>(y + 1) + 1; }
  void put(int x, int y, const Lanes& from) {
    for (int lane = 0; lane < lanes; ++lane)
      row(y + raster::row(lane))[x + column(lane)] = from[static_cast<std::size_t>(lane)];
  }
  void get(int x, int y, Lanes& to) const {
    for (int lane = 0; lane < lanes; ++lane)
      to[static_cast<std::size_t>(lane)] = row(y + raster::row(lane))[x + column(lane)];
  }

private:
  std::size_t stride_;
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

/// Pixels [first, last) of each row that are in blocks with something in them; none where last is 0.
struct Span {
  int first = 0, last = 0;
};
std::vector<Span> spans_of(const ReceiverBlocks& at) {
  std::vector<Span> spans(static_cast<std::size_t>(at.height()));
  for (int k = 0; k < at.rows * at.columns; ++k) {
    if (at.empty[static_cast<std::size_t>(k)] != 0) continue;
    const int x = k % at.columns * block_width, y = k / at.columns * block_height;
    for (int row = y; row < y + block_height; ++row) {
      Span& span = spans[static_cast<std::size_t>(row)];
      if (span.last == 0) span.first = x;
      span.last = x + block_width;
    }
  }
  return spans;
}

constexpr float unlike_all = -3e9F;

/// Of a part of a light, which soft_shadow() puts together.
void shadow_of_part(const DepthMaps& maps, std::size_t part, const ReceiverBlocks& at, float spacing,
                    std::vector<float>& seen) {
  const int width = at.width(), height = at.height();
  Plane depth(width, height, unlike_all), tolerance(width, height, 0.0F), nearness(width, height, 0.0F),
      taps(width, height, 0.0F);
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
  seen.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 1.0F);
  if (!any_blocked) return;
  const std::vector<Span> spans = spans_of(at);
  Plane shared_nearness(width, height, 0.0F), shared_taps(width, height, 0.0F);
  for (int y = 0; y < height; ++y) {
    const Span span = spans[static_cast<std::size_t>(y)];
    add_neighbours({depth, y}, tolerance.row(y), {nearness, y}, {taps, y}, span.first, span.last,
                   shared_nearness.row(y), shared_taps.row(y));
  }
  Plane blocked(width, height, 0.0F), share(width, height, 0.0F);
  at.for_each([&](int x, int y, const Receivers& r) {
    Blockers found;
    shared_nearness.get(x, y, found.nearness);
    shared_taps.get(x, y, found.taps);
    Shadow shadow;
    filter_shadow(maps, part, r, found, spacing, shadow);
    blocked.put(x, y, shadow.blocked);
    share.put(x, y, shadow.share);
  });
  const Plane one(width, height, 1.0F);
  std::vector<float> sum(static_cast<std::size_t>(width)), count(sum.size());
  for (int y = 0; y < height; ++y) {
    const Span span = spans[static_cast<std::size_t>(y)];
    add_neighbours({depth, y}, tolerance.row(y), {blocked, y}, {one, y}, span.first, span.last, sum.data(),
                   count.data());
    for (int x = span.first; x < span.last; ++x) {
      const auto i = static_cast<std::size_t>(x);
      const float alone = blocked.row(y)[x];
      const float mean = count[i] > 0.0F ? sum[i] / count[i] : alone;
      seen[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + i] =
          1.0F - (alone + share.row(y)[x] * (mean - alone));
    }
  }
}

}  // namespace

void soft_shadow(const FrameBlock& frame, const DepthMaps& maps, int light, const ReceiverBlocks& at,
                 std::vector<float>& seen) {
  const LightParts& parts = maps.lights[static_cast<std::size_t>(light)];
  if (parts.count == 1 && !parts.below_ground) {
    shadow_of_part(maps, parts.first, at, static_cast<float>(at.step), seen);
    return;
  }
  std::vector<std::vector<float>> of_parts(parts.count);
  for (std::size_t k = 0; k < parts.count; ++k)
    shadow_of_part(maps, parts.first + k, at, static_cast<float>(at.step), of_parts[k]);
  const auto width = static_cast<std::size_t>(at.width());
  seen.assign(width * static_cast<std::size_t>(at.height()), 1.0F);
  at.for_each([&](int x, int y, const Receivers& r) {
    const auto pixel = [&](int lane) {
      return static_cast<std::size_t>(y + row(lane)) * width + static_cast<std::size_t>(x + column(lane));
    };
    const bool may_be_below_ground = parts.below_ground && !r.is_ground;
    if (!may_be_below_ground &&
        std::all_of(of_parts.begin(), of_parts.end(), [&](const std::vector<float>& of_part) {
          for (int lane = 0; lane < lanes; ++lane) {
            if (of_part[pixel(lane)] < 1.0F) return false;
          }
          return true;
        }))
      return;
    Lanes given{}, arriving{};
    for (std::size_t k = 0; k < parts.count; ++k) {
      PartLight light;
      light_of_part(frame, maps.parts[parts.first + k].light, r, light);
      for (int lane = 0; lane < lanes; ++lane) {
        const auto l = static_cast<std::size_t>(lane);
        given[l] += light.whole[l];
        arriving[l] += light.past_ground[l] * of_parts[k][pixel(lane)];
      }
    }
    for (int lane = 0; lane < lanes; ++lane) {
      const auto l = static_cast<std::size_t>(lane);
      if (given[l] > 0.0F) seen[pixel(lane)] = arriving[l] / given[l];
    }
  });
}

}  // namespace lagomorph::render::raster
