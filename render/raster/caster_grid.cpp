#include "render/raster/caster_grid.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lagomorph::render::raster {
namespace {

/// Of cells along one axis; empty (last < first) where the interval does not meet the map.
struct CellRange {
  int first, last;
};
CellRange cells(float low, float high) {
  constexpr auto end = static_cast<float>(CasterGrid::size);
  if (!(high >= 0.0F && low <= 1.0F)) return {0, -1};
  const auto cell = [&](float x) {
    return std::min(static_cast<int>(std::clamp(x, 0.0F, 1.0F) * end), CasterGrid::size - 1);
  };
  return {cell(low), cell(high)};
}

/// Bits first..last.
std::uint64_t bits(const CellRange& range) {
  const int count = range.last - range.first + 1;
  return (~std::uint64_t{0} >> (CasterGrid::size - count)) << range.first;
}

}  // namespace

void CasterGrid::add(const Vec2& low, const Vec2& high) {
  const CellRange x = cells(low.x(), high.x()), y = cells(low.y(), high.y());
  if (x.last < x.first) return;
  const std::uint64_t row = bits(x);
  for (int k = y.first; k <= y.last; ++k) rows_[static_cast<std::size_t>(k)] |= row;
}

bool CasterGrid::meets(const Vec2& low, const Vec2& high) const {
  const CellRange x = cells(low.x(), high.x()), y = cells(low.y(), high.y());
  if (x.last < x.first) return false;
  const std::uint64_t row = bits(x);
  for (int k = y.first; k <= y.last; ++k) {
    if ((rows_[static_cast<std::size_t>(k)] & row) != 0) return true;
  }
  return false;
}

void add_casters(const AreaLight& light, const LightView& view, std::span<const Vec3> positions,
                 std::span<const Triangle> triangles, CasterGrid& grid) {
  const LightFrame frame = light_frame(light);
  const Vec2 scale = view.map.head<2>(), offset = view.map.tail<2>();
  // Nearer than the fitted view the map shows nothing; what is behind the light's plane hides nothing of it.
  const float nearest = view.depth.z() > 0.0F ? 0.5F / view.depth.z() : 0.0F;
  std::vector<Vec2> at;
  at.reserve(positions.size());
  std::vector<bool> before(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3 d = positions[i] - light.position;
    const float along = d.dot(frame.normal);
    before[i] = along > nearest;
    const Vec2 tangent = Vec2(d.dot(frame.right), d.dot(frame.up)) / (before[i] ? along : 1.0F);
    at.push_back(tangent.cwiseProduct(scale) + offset);
  }
  for (const Triangle& t : triangles) {
    Vec2 low = at[static_cast<std::size_t>(t[0])], high = low;
    int count = 0;
    for (const auto v : t) {
      const auto i = static_cast<std::size_t>(v);
      low = low.cwiseMin(at[i]);
      high = high.cwiseMax(at[i]);
      count += before[i] ? 1 : 0;
    }
    if (count == 3) {
      grid.add(low, high);
    } else if (count > 0) {
      grid.fill();
      return;
    }
  }
}

}  // namespace lagomorph::render::raster
