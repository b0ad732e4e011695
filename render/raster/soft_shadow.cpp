#include "render/raster/soft_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/raster/light_parts.h"
#include "render/raster/light_visibility.h"
#include "render/simd.h"

namespace lagomorph::render::raster {
namespace {

/// Pixels [left, right) x [lower, upper).
struct Bounds {
  int left = 0, right = 0, lower = 0, upper = 0;
};

/// Around all quads.
Bounds bounds_of(const ReceiverBlocks& at) {
  Bounds b{at.width, 0, at.height, 0};
  for (const ReceiverBlock& block : at.blocks) {
    block.for_lanes([&](std::size_t, int x, int y) {
      b.left = std::min(b.left, x), b.right = std::max(b.right, x + 1);
      b.lower = std::min(b.lower, y), b.upper = std::max(b.upper, y + 1);
    });
  }
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

  /// Pixel x of the row is at [x - left].
  float* row(int y) { return values_.data() + place(y); }
  const float* row(int y) const { return values_.data() + place(y); }
  void put(const ReceiverBlock& at, const Lanes& from) {
    std::size_t lane = 0;
    for (const QuadPlace& quad : at.used_places()) {
      float* const lower = values_.data() + place(quad);
      float* const upper = lower + stride_;
      lower[0] = from[lane], lower[1] = from[lane + 1];
      upper[0] = from[lane + 2], upper[1] = from[lane + 3];
      lane += raster::quad;
    }
  }
  /// The other lanes stay.
  void get(const ReceiverBlock& at, Lanes& to) const {
    std::size_t lane = 0;
    for (const QuadPlace& quad : at.used_places()) {
      const float* const lower = values_.data() + place(quad);
      const float* const upper = lower + stride_;
      to[lane] = lower[0], to[lane + 1] = lower[1];
      to[lane + 2] = upper[0], to[lane + 3] = upper[1];
      lane += raster::quad;
    }
  }

private:
  std::ptrdiff_t place(int y) const { return stride_ * (y - at_.lower + 1) + 1; }
  std::ptrdiff_t place(const QuadPlace& at) const { return place(at.y) + at.x - at_.left; }

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

/// Pixels [first, last) of a row, from the left bound, between which its quads are.
struct Span {
  int first = 0, last = 0;
};
std::vector<Span> spans_of(const ReceiverBlocks& at, const Bounds& bounds) {
  std::vector<Span> spans(static_cast<std::size_t>(bounds.upper - bounds.lower));
  for (const ReceiverBlock& block : at.blocks) {
    block.for_lanes([&](std::size_t, int x, int y) {
      Span& span = spans[static_cast<std::size_t>(y - bounds.lower)];
      const int here = x - bounds.left;
      span.first = span.last == 0 ? here : std::min(span.first, here);
      span.last = std::max(span.last, here + 1);
    });
  }
  return spans;
}

constexpr float unlike_all = -3e9F;

bool any_positive(const Lanes& values) {
  return std::any_of(values.begin(), values.end(), [](float v) { return v > 0.0F; });
}

/// Of what is blocked for a receiver alone, and for its neighbours as well by a share of their mean.
LAGOMORPH_RENDER_SIMD void part_seen(const Lanes& alone, const Lanes& share, const Lanes& sum,
                                     const Lanes& count, Lanes& seen) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const float mean = count[l] > 0.0F ? sum[l] / count[l] : alone[l];
    seen[l] = 1.0F - (alone[l] + share[l] * (mean - alone[l]));
  }
}

/// What is seen of one part of a light after another.
class PartShadow {
public:
  explicit PartShadow(const ReceiverBlocks& at)
      : at_(at),
        bounds_(bounds_of(at)),
        spans_(spans_of(at, bounds_)),
        hidden_(at.blocks.size(), 0),
        depth_(bounds_, unlike_all),
        tolerance_(bounds_, 0.0F),
        one_(bounds_, 1.0F),
        nearness_(bounds_, 0.0F),
        taps_(bounds_, 0.0F),
        shared_nearness_(bounds_, 0.0F),
        shared_taps_(bounds_, 0.0F) {
    Lanes reach{};
    for (const ReceiverBlock& block : at.blocks) {
      const Lanes& footprint = block.at.footprint;
      std::transform(footprint.begin(), footprint.end(), reach.begin(),
                     [](float f) { return one_surface * f; });
      tolerance_.put(block, reach);
    }
  }

  /// Returns false, with nothing found, where all of it is seen by all. See soft_shadow() for `hard`.
  bool find(const DepthMaps& maps, std::size_t part, std::span<LaneBits> hard) {
    if (!search(maps, part)) return false;
    share(nearness_, taps_);
    Plane& blocked = nearness_;  // their room
    Plane& shared = taps_;
    const auto spacing = static_cast<float>(at_.step);
    for (std::size_t b = 0; b < at_.blocks.size(); ++b) {
      const ReceiverBlock& block = at_.blocks[b];
      Blockers found{};
      shared_taps_.get(block, found.taps);
      hidden_[b] = any_positive(found.taps) ? 1 : 0;
      if (hidden_[b] == 0) continue;  // its planes are 0 there
      shared_nearness_.get(block, found.nearness);
      Shadow shadow;
      filter_shadow(maps, part, block.at, found, spacing, shadow);
      hard[b] |= shadow.hard;
      blocked.put(block, shadow.blocked);
      shared.put(block, shadow.share);
    }
    share(blocked, one_);
    return true;
  }
  /// The part that is seen by a block; returns false, with nothing found, where that is all.
  bool get(std::size_t block, Lanes& seen) const {
    if (hidden_[block] == 0) return false;
    const ReceiverBlock& at = at_.blocks[block];
    Lanes alone{}, share{}, sum{}, count{};
    nearness_.get(at, alone);
    taps_.get(at, share);
    shared_nearness_.get(at, sum);
    shared_taps_.get(at, count);
    part_seen(alone, share, sum, count, seen);
    return true;
  }

private:
  bool search(const DepthMaps& maps, std::size_t part) {
    const auto spacing = static_cast<float>(at_.step);
    bool any_blocked = false;
    for (const ReceiverBlock& block : at_.blocks) {
      Blockers found;
      find_blockers(maps, part, block.at, spacing, found);
      depth_.put(block, found.depth);
      nearness_.put(block, found.nearness);
      taps_.put(block, found.taps);
      any_blocked |= any_positive(found.taps);
    }
    return any_blocked;
  }
  /// Sums over neighbours.
  void share(const Plane& a, const Plane& b) {
    for (int y = bounds_.lower; y < bounds_.upper; ++y) {
      const Span& span = spans_[static_cast<std::size_t>(y - bounds_.lower)];
      add_neighbours({depth_, y}, tolerance_.row(y), {a, y}, {b, y}, span.first, span.last,
                     shared_nearness_.row(y), shared_taps_.row(y));
    }
  }

  const ReceiverBlocks& at_;
  Bounds bounds_;
  std::vector<Span> spans_;
  std::vector<char> hidden_;  // some of the part may be from the block
  Plane depth_, tolerance_, one_, nearness_, taps_, shared_nearness_, shared_taps_;
};

constexpr std::int32_t all_seen = -1;

/// Of all parts, by what each gives; `of_parts` numbers what is seen of each, or is all_seen.
void put_together(const FrameBlock& frame, const DepthMaps& maps, const LightParts& parts,
                  const std::int32_t* of_parts, std::span<const Lanes> parts_seen, const Receivers& r,
                  Lanes& seen) {
  Lanes given{}, arriving{};
  for (std::size_t k = 0; k < parts.count; ++k) {
    PartLight light;
    light_of_part(frame, maps.parts[parts.first + k].light, r, light);
    Lanes part_seen;
    part_seen.fill(1.0F);
    if (of_parts[k] != all_seen) part_seen = parts_seen[static_cast<std::size_t>(of_parts[k])];
    for (std::size_t l = 0; l < lanes; ++l) {
      given[l] += light.whole[l];
      arriving[l] += light.past_ground[l] * part_seen[l];
    }
  }
  for (std::size_t l = 0; l < lanes; ++l) {
    if (given[l] > 0.0F) seen[l] = arriving[l] / given[l];
  }
}

}  // namespace

void soft_shadow(const FrameBlock& frame, const DepthMaps& maps, int light, const ReceiverBlocks& at,
                 std::vector<Lanes>& seen, std::span<LaneBits> hard) {
  const LightParts& parts = maps.lights[static_cast<std::size_t>(light)];
  Lanes all;
  all.fill(1.0F);
  seen.assign(at.blocks.size(), all);
  if (at.empty()) return;
  PartShadow shadow(at);
  if (parts.count == 1 && !parts.below_ground) {
    if (!shadow.find(maps, parts.first, hard)) return;
    for (std::size_t b = 0; b < at.blocks.size(); ++b) shadow.get(b, seen[b]);
    return;
  }
  std::vector<Lanes> parts_seen;  // where they are not seen whole
  std::vector<std::int32_t> of_parts(at.blocks.size() * parts.count, all_seen);
  for (std::size_t k = 0; k < parts.count; ++k) {
    if (!shadow.find(maps, parts.first + k, hard)) continue;
    for (std::size_t b = 0; b < at.blocks.size(); ++b) {
      Lanes of_part;
      if (!shadow.get(b, of_part)) continue;
      of_parts[b * parts.count + k] = static_cast<std::int32_t>(parts_seen.size());
      parts_seen.push_back(of_part);
    }
  }
  for (std::size_t b = 0; b < at.blocks.size(); ++b) {
    const std::int32_t* of_block = of_parts.data() + b * parts.count;
    const Receivers& r = at.blocks[b].at;
    const bool hidden = std::any_of(of_block, of_block + parts.count, [](auto n) { return n != all_seen; });
    if (hidden || (parts.below_ground && !r.is_ground))
      put_together(frame, maps, parts, of_block, parts_seen, r, seen[b]);
  }
}

}  // namespace lagomorph::render::raster
