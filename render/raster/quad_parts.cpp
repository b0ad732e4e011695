#include "render/raster/quad_parts.h"

#include <algorithm>
#include <cmath>

namespace lagomorph::render::raster {
namespace {

/// Neighbouring quads whose parts differ by more are found pixel by pixel: shadows whose edges are narrower
/// than some 20 pixels.
constexpr float most_difference = 0.1F;

/// Cosine of the angle from which on two normals are of different surfaces.
constexpr float least_alike = 0.9F;

}  // namespace

QuadParts::QuadParts(const ReceiverBlocks& quads) : width_(quads.width()), height_(quads.height()) {
  const auto count = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  SeenParts all;
  all.fill(1.0F);
  parts_.assign(count, all);
  surfaces_.assign(count, {Vec3::UnitY(), 1e9F});
  rough_.assign(count, 0);
  quads.for_each([&](int x, int y, const Receivers& r) {
    for (int lane = 0; lane < lanes; ++lane) {
      const auto l = static_cast<std::size_t>(lane);
      if (r.there[l] != 0)
        surfaces_[index(x + column(lane), y + row(lane))] = {r.normal.at(lane), r.depth[l]};
    }
  });
}

void QuadParts::finish(const ReceiverBlocks& quads) {
  quads.for_each([&](int x0, int y0, const Receivers&) {
    for (int y = y0; y < std::min(y0 + block_height, height_ - 1); ++y) {
      for (int x = x0; x < std::min(x0 + block_width, width_ - 1); ++x) {
        const SeenParts& a = parts_[index(x, y)];
        float most = 0.0F;
        for (const std::size_t other : {index(x + 1, y), index(x, y + 1), index(x + 1, y + 1)}) {
          const SeenParts& b = parts_[other];
          const bool there = surfaces_[other].depth < 1e9F;
          float difference = 0.0F;
          for (std::size_t k = 0; k < seen_parts; ++k)
            difference = std::max(difference, std::abs(a[k] - b[k]));
          most = std::max(most, there ? difference : 0.0F);
        }
        rough_[index(x, y)] = most > most_difference ? 1 : 0;
      }
    }
  });
}

bool QuadParts::find(int x, int y, float depth, const Vec3& normal, float reach, SeenParts& seen) const {
  const int qx = x >> 1, qy = y >> 1;
  if (rough_[index(qx, qy)] != 0) return false;
  seen.fill(0.0F);
  float count = 0.0F;
  for (int j = 0; j <= (y & 1); ++j) {
    for (int i = 0; i <= (x & 1); ++i) {
      const std::size_t q = index(qx + i, qy + j);
      const Surface& s = surfaces_[q];
      if (std::abs(s.depth - depth) > reach || s.normal.dot(normal) < least_alike) continue;
      for (std::size_t k = 0; k < seen_parts; ++k) seen[k] += parts_[q][k];
      count += 1.0F;
    }
  }
  if (count == 0.0F) return false;
  for (float& part : seen) part /= count;
  return true;
}

}  // namespace lagomorph::render::raster
