#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "render/camera.h"
#include "render/render_scene.h"

namespace lagomorph::render {

/// Unit sphere by subdividing an icosahedron, scaled and moved.
inline Mesh make_sphere(int subdivisions, float radius, const Vec3& center) {
  const float g = (1.0F + std::sqrt(5.0F)) / 2.0F;
  Mesh mesh;
  mesh.name = "sphere";
  mesh.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                    {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [place, fresh] = middles.try_emplace(std::minmax(a, b), mesh.positions.size());
      if (fresh) mesh.positions.push_back((mesh.positions[a] + mesh.positions[b]).normalized());
      return place->second;
    };
    for (Vec3& p : mesh.positions) p.normalize();
    std::vector<Triangle> finer;
    for (const Triangle& t : mesh.triangles) {
      const std::uint32_t a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], a, c}, {t[1], b, a}, {t[2], c, b}, {a, b, c}});
    }
    mesh.triangles = finer;
  }
  for (Vec3& p : mesh.positions) p = center + radius * p.normalized();
  return mesh;
}

/// Two triangles, from a corner along two edges; the normal is u x v.
inline Mesh make_quad(const Vec3& corner, const Vec3& u, const Vec3& v) {
  Mesh mesh;
  mesh.name = "quad";
  mesh.positions = {corner, corner + u, corner + u + v, corner + v};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.smooth = false;
  return mesh;
}

/// Axis-aligned box with shared vertices.
inline Mesh make_box(const Vec3& low, const Vec3& high) {
  Mesh mesh;
  mesh.name = "box";
  for (int i = 0; i < 8; ++i) {
    mesh.positions.emplace_back((i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z());
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  mesh.smooth = false;
  return mesh;
}

inline std::vector<Mesh> two_spheres() {
  return {make_sphere(2, 0.8F, Vec3::Zero()), make_sphere(2, 0.5F, Vec3(0.6F, 0.5F, 0.4F))};
}

/// From all around, at what is near the origin.
inline std::vector<Ray> random_rays(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 from = 2.0F * Vec3(normal(random), normal(random), normal(random));
    const Vec3 to = 0.5F * Vec3(normal(random), normal(random), normal(random));
    rays.push_back({from, (to - from).normalized()});
  }
  return rays;
}

}  // namespace lagomorph::render
