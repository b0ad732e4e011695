#include "render/normals.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace lagomorph::render {

VertexNormals::VertexNormals(std::span<const Triangle> triangles, std::size_t vertex_count)
    : first_(vertex_count + 1, 0), corners_(3 * triangles.size()) {
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) ++first_[v + 1];
  }
  for (std::size_t v = 0; v < vertex_count; ++v) first_[v + 1] += first_[v];
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      corners_[next[triangles[i][c]]++] = static_cast<std::uint32_t>(3 * i + c);
  }
}

void VertexNormals::compute(std::span<const Triangle> triangles, std::span<const Vec3> positions,
                            std::vector<Vec3>& normals) const {
  const std::size_t vertex_count = first_.size() - 1;
  normals.resize(vertex_count);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, vertex_count, 1024), [&](const auto& range) {
    for (std::size_t v = range.begin(); v != range.end(); ++v) {
      Vec3 sum = Vec3::Zero();
      for (std::uint32_t k = first_[v]; k < first_[v + 1]; ++k) {
        const Triangle& t = triangles[corners_[k] / 3];
        const std::size_t c = corners_[k] % 3;
        const Vec3& x = positions[t[c]];
        const Vec3 a = positions[t[(c + 1) % 3]] - x;
        const Vec3 b = positions[t[(c + 2) % 3]] - x;
        const Vec3 n = a.cross(b);
        const float length = n.norm();
        if (length > 0.0F) sum += n * (std::atan2(length, a.dot(b)) / length);
      }
      const float length = sum.norm();
      normals[v] = length > 0.0F ? Vec3(sum / length) : Vec3(0.0F, 1.0F, 0.0F);
    }
  });
}

}  // namespace lagomorph::render
