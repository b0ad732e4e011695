#include "render/raster/mesh_buffers.h"

#include <utility>

#include <gtest/gtest.h>

#include "tests/unit/render/raster/shapes.h"

namespace lagomorph::render::raster {
namespace mesh_buffers_test {

TEST(IsClosed, KnowsAnInside) {
  EXPECT_TRUE(is_closed(sphere(Vec3(5.0F, 0.0F, 0.0F), 1.0F, 8).triangles,
                        sphere(Vec3(5.0F, 0.0F, 0.0F), 1.0F, 8).positions));
  Mesh mesh = box(Vec3::Zero(), Vec3::Ones());
  EXPECT_TRUE(is_closed(mesh.triangles, mesh.positions));
}

TEST(IsClosed, NotWithAHoleATurnedTriangleOrInsideOut) {
  const Mesh whole = box(Vec3::Zero(), Vec3::Ones());
  Mesh mesh = whole;
  mesh.triangles.pop_back();
  EXPECT_FALSE(is_closed(mesh.triangles, mesh.positions));
  mesh = whole;
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  EXPECT_FALSE(is_closed(mesh.triangles, mesh.positions));
  mesh = whole;
  for (Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
  EXPECT_FALSE(is_closed(mesh.triangles, mesh.positions));
  mesh = whole;
  mesh.triangles.insert(mesh.triangles.end(), whole.triangles.begin(), whole.triangles.end());
  EXPECT_FALSE(is_closed(mesh.triangles, mesh.positions));
  EXPECT_FALSE(is_closed({}, {}));
}

}  // namespace mesh_buffers_test
}  // namespace lagomorph::render::raster
