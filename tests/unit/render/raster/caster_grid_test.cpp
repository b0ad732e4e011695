#include "render/raster/caster_grid.h"

#include <gtest/gtest.h>

#include "tests/unit/render/raster/shapes.h"

namespace lagomorph::render::raster {
namespace caster_grid_test {

TEST(CasterGrid, MeetsWhatWasAddedAndNothingElse) {
  CasterGrid grid;
  EXPECT_FALSE(grid.meets(Vec2(0.0F, 0.0F), Vec2(1.0F, 1.0F)));
  grid.add(Vec2(0.30F, 0.52F), Vec2(0.34F, 0.56F));
  EXPECT_TRUE(grid.meets(Vec2(0.0F, 0.0F), Vec2(1.0F, 1.0F)));
  EXPECT_TRUE(grid.meets(Vec2(0.33F, 0.55F), Vec2(0.9F, 0.9F)));
  EXPECT_FALSE(grid.meets(Vec2(0.36F, 0.0F), Vec2(1.0F, 1.0F)));
  EXPECT_FALSE(grid.meets(Vec2(0.0F, 0.58F), Vec2(1.0F, 1.0F)));
  EXPECT_FALSE(grid.meets(Vec2(0.0F, 0.0F), Vec2(0.28F, 1.0F)));
  EXPECT_FALSE(grid.meets(Vec2(0.0F, 0.0F), Vec2(1.0F, 0.5F)));
}

TEST(CasterGrid, HasBordersThatAreMetFromInsideOnly) {
  CasterGrid grid;
  grid.add(Vec2(-2.0F, -2.0F), Vec2(-0.1F, 0.5F));  // beyond
  EXPECT_FALSE(grid.meets(Vec2(-9.0F, -9.0F), Vec2(9.0F, 9.0F)));
  grid.add(Vec2(0.99F, 0.99F), Vec2(3.0F, 3.0F));
  EXPECT_TRUE(grid.meets(Vec2(0.995F, 0.995F), Vec2(1.0F, 1.0F)));
  EXPECT_FALSE(grid.meets(Vec2(1.1F, 0.0F), Vec2(2.0F, 2.0F)));
  grid.fill();
  EXPECT_TRUE(grid.meets(Vec2(0.0F, 0.0F), Vec2(0.0F, 0.0F)));
}

TEST(CasterGrid, HoldsEveryPointOfAMeshAsTheLightSeesIt) {
  AreaLight light;
  light.position = Vec3(1.5F, 2.5F, -0.7F);
  light.look_at = Vec3(-0.2F, 0.4F, 0.1F);
  const LightFrame frame = light_frame(light);
  const Mesh mesh = sphere(Vec3(0.0F, 0.5F, 0.0F), 0.4F, 12);
  const std::vector<std::vector<Vec3>> positions = {mesh.positions};
  const LightView view = fit_light_view(light, positions, 1024);
  CasterGrid grid;
  add_casters(light, view, mesh.positions, mesh.triangles, grid);
  for (const Triangle& t : mesh.triangles) {
    const Vec3 middle = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0F;
    for (const Vec3& p : {mesh.positions[t[0]], middle}) {
      const Vec3 d = p - light.position;
      const float z = d.dot(frame.normal);
      const Vec2 at = (Vec2(d.dot(frame.right), d.dot(frame.up)) / z).cwiseProduct(view.map.head<2>()) +
                      view.map.tail<2>();
      EXPECT_TRUE(grid.meets(at, at)) << at.transpose();
    }
  }
  EXPECT_FALSE(grid.meets(Vec2(0.0F, 0.0F), Vec2(0.02F, 0.02F)));  // a corner, where no disc reaches
}

TEST(CasterGrid, IsFullWhereATriangleReachesTheLightsPlane) {
  AreaLight light;
  light.position = Vec3(0.0F, 1.0F, 0.0F);
  light.look_at = Vec3::Zero();
  const std::vector<std::vector<Vec3>> positions = {
      {Vec3(0.1F, 0.0F, 0.0F), Vec3(0.2F, 0.1F, 0.1F), Vec3(0.1F, 2.0F, 0.3F)}};
  CasterGrid grid;
  add_casters(light, fit_light_view(light, positions, 256), positions[0], std::vector<Triangle>{{0, 1, 2}},
              grid);
  for (int i = 0; i < CasterGrid::size; ++i) {
    const Vec2 at = Vec2::Constant((static_cast<float>(i) + 0.5F) / static_cast<float>(CasterGrid::size));
    EXPECT_TRUE(grid.meets(at, at));
  }
}

}  // namespace caster_grid_test
}  // namespace lagomorph::render::raster
