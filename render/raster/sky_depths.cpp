#include "render/raster/sky_depths.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

namespace lagomorph::render::raster {
namespace {

/// x and y in texels, z the depth in steps of a DepthMap.
struct MapPoint {
  float x, y, z;
};

/// As see_through_depth_map_fragment.
bool is_dot(const SkyCaster& mesh, bool front, int x, int y) {
  if (mesh.opacity >= 1.0F) return true;
  constexpr std::array<std::array<float, 2>, 4> steps = {{{0.7548776662F, 0.5698402910F},
                                                          {0.4301597090F, 0.7548776662F},
                                                          {0.3819660113F, 0.2360679775F},
                                                          {0.1458980338F, 0.6180339887F}}};
  const int sheet = 2 * mesh.body + (front ? 0 : 1);
  const std::array<float, 2>& s = steps[static_cast<std::size_t>(sheet % 4)];
  const int round = sheet / 4;  // of the four
  const float at =
      static_cast<float>(x) * s[0] + static_cast<float>(y) * s[1] + 0.6180339887F * static_cast<float>(round);
  return at - std::floor(at) < mesh.opacity;
}

void draw_triangle(const SkyCaster& mesh, MapPoint a, MapPoint b, const MapPoint& c, int size,
                   DepthMap& map) {
  float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  const bool front = area > 0.0F;
  if (area == 0.0F || (!front && mesh.closed && mesh.opacity >= 1.0F)) return;
  if (!front) {
    std::swap(a, b);
    area = -area;
  }
  // Texels whose middles may be inside.
  const auto first = [](float low) { return std::max(static_cast<int>(std::ceil(low - 0.5F)), 0); };
  const auto last = [&](float high) { return std::min(static_cast<int>(std::floor(high - 0.5F)), size - 1); };
  const int x0 = first(std::min({a.x, b.x, c.x})), x1 = last(std::max({a.x, b.x, c.x}));
  const int y0 = first(std::min({a.y, b.y, c.y})), y1 = last(std::max({a.y, b.y, c.y}));
  for (int y = y0; y <= y1; ++y) {
    const float py = static_cast<float>(y) + 0.5F;
    for (int x = x0; x <= x1; ++x) {
      const float px = static_cast<float>(x) + 0.5F;
      // Twice the areas of the parts; edges are inside, for the nearest depth counts anyway.
      const float of_a = (c.x - b.x) * (py - b.y) - (c.y - b.y) * (px - b.x);
      const float of_b = (a.x - c.x) * (py - c.y) - (a.y - c.y) * (px - c.x);
      const float of_c = area - of_a - of_b;
      if (of_a < 0.0F || of_b < 0.0F || of_c < 0.0F || !is_dot(mesh, front, x, y)) continue;
      const float z = (of_a * a.z + of_b * b.z + of_c * c.z) / area;
      const auto depth =
          static_cast<std::uint16_t>(std::clamp(z + 0.5F, 0.0F, static_cast<float>(no_depth - 1)));
      std::uint16_t& there =
          map[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)];
      there = std::min(there, depth);
    }
  }
}

}  // namespace

void draw_sky_depths(const FrameBlock& frame, std::span<const SkyCaster> meshes, int size,
                     std::vector<DepthMap>& maps) {
  maps.resize(frame.sky.size());
  tbb::parallel_for(std::size_t{0}, maps.size(), [&](std::size_t i) {
    const SkyDirectionBlock& sky = frame.sky[i];
    DepthMap& map = maps[i];
    map.assign(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), no_depth);
    const float half = 0.5F * static_cast<float>(size);
    const Vec3 x_axis = half * frame.sky_map[3] * sky.right.head<3>();
    const Vec3 y_axis = half * frame.sky_map[3] * sky.up.head<3>();
    const Vec3 z_axis = -0.5F * static_cast<float>(no_depth) * frame.sky_map[3] * sky.direction.head<3>();
    const Vec3 middle = frame.sky_map.head<3>();
    std::vector<MapPoint> points;
    for (const SkyCaster& mesh : meshes) {
      points.clear();
      points.reserve(mesh.positions.size());
      for (const Vec3& p : mesh.positions) {
        const Vec3 d = p - middle;
        points.push_back({d.dot(x_axis) + half, d.dot(y_axis) + half,
                          d.dot(z_axis) + 0.5F * static_cast<float>(no_depth)});
      }
      for (const Triangle& t : mesh.triangles)
        draw_triangle(mesh, points[t[0]], points[t[1]], points[t[2]], size, map);
    }
  });
}

}  // namespace lagomorph::render::raster
