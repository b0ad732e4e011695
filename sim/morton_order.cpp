#include "sim/morton_order.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace lagomorph::sim {

namespace {

constexpr int kBitsAnAxis = 16;

/// Bits of the three coordinates in turn.
std::uint64_t interleaved(const Vec3& x) {
  std::uint64_t key = 0;
  for (int bit = kBitsAnAxis - 1; bit >= 0; --bit)
    for (int k = 0; k < 3; ++k) key = key << 1 | (static_cast<std::uint64_t>(x[k]) >> bit & 1U);
  return key;
}

}  // namespace

std::vector<std::size_t> morton_order(const TetMesh& mesh, const std::vector<int>& tets) {
  std::vector<std::size_t> order(tets.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (tets.empty()) return order;
  const Vec3 low = mesh.X.colwise().minCoeff(), size = mesh.X.colwise().maxCoeff().transpose() - low;
  const double scale = ((1 << kBitsAnAxis) - 1) / std::max(size.maxCoeff(), 1e-300);
  std::vector<std::uint64_t> keys;
  keys.reserve(tets.size());
  for (const int j : tets) {
    Vec3 centroid = Vec3::Zero();
    for (const int v : mesh.tets[static_cast<std::size_t>(j)]) centroid += 0.25 * mesh.X.row(v).transpose();
    keys.push_back(interleaved(scale * (centroid - low).cwiseMax(0.0)));
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  return order;
}

}  // namespace lagomorph::sim
