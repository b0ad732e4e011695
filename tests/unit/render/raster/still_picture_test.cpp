#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "render/raster/still_cells.h"
#include "tests/unit/render/raster/shapes.h"

namespace lagomorph::render::raster {
namespace still_picture_test {

/// A ball in a corner of light and shadow, of two lights and the sky, up to the horizon and beyond the
/// ground's edge.
RenderScene ball_over_ground(const char* texture, float roughness) {
  RenderScene scene = empty_scene();
  scene.background.reset();
  scene.sky.strength = 0.5F;
  scene.ground.enabled = true;
  scene.ground.fade_start = 3.0F;
  scene.ground.radius = 6.0F;
  scene.ground.texture = texture;
  scene.ground.texture_color = Color(0.7F, 0.2F, 0.1F);
  scene.ground.material = {Color(0.2F, 0.3F, 0.4F), roughness, 0.0F, 1.5F};
  AreaLight light;
  light.position = Vec3(1.0F, 2.0F, -1.5F);
  light.look_at = Vec3::Zero();
  light.size = Vec2(0.8F, 0.5F);
  light.radiance = 10.0F;
  scene.lights.push_back(light);
  light.position = Vec3(-1.5F, 2.5F, 1.0F);
  scene.lights.push_back(light);
  scene.meshes = {sphere(Vec3(0.0F, 0.5F, 0.0F), 0.5F)};
  return scene;
}

std::vector<float> colors_of(const RenderScene& scene, const CameraSettings& camera) {
  return draw(scene, camera, small_settings(250, 170)).find(color_channel)->values;
}

/// A ground that is as smooth as this is drawn pixel by pixel, one that is hardly rougher by cells.
TEST(StillPicture, OfCellsIsThatOfPixels) {
  CameraSettings flat = three_quarter();
  flat.position = Vec3(0.5F, 0.6F, 4.0F);
  CameraSettings parallel = three_quarter();
  parallel.orthographic = 6.0F;
  for (const char* texture : {"none", "checker", "grid"}) {
    for (const CameraSettings& camera : {three_quarter(), flat, parallel}) {
      const std::vector<float> pixels = colors_of(ball_over_ground(texture, 0.14999F), camera);
      const std::vector<float> cells = colors_of(ball_over_ground(texture, 0.15001F), camera);
      ASSERT_EQ(pixels.size(), cells.size());
      std::size_t other = 0;
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        EXPECT_NEAR(cells[i], pixels[i], 0.02F * pixels[i] + 1e-3F) << texture << ' ' << i;
        other += cells[i] != pixels[i] ? 1 : 0;
      }
      EXPECT_GT(other, pixels.size() / 10) << texture;  // there are cells
    }
  }
}

/// Corners that are smooth, or bent at one place.
StillCells plane_of_cells(int bent_column) {
  StillCells cells;
  cells.columns = 2 * still_cells_of_tile + 1, cells.rows = still_cells_of_tile + 1;
  cells.met.assign(cells.corners(), 1);
  for (int c = 0; c < 3; ++c) {
    for (int y = 0; y < cells.rows; ++y) {
      for (int x = 0; x < cells.columns; ++x)
        cells.planes[0].push_back(1.0F + 0.1F * static_cast<float>(x) + (x == bent_column ? 0.1F : 0.0F));
    }
  }
  return cells;
}

/// A camera that looks down on the ground, 2 m wide, two tiles beside each other.
FrameBlock from_above() {
  FrameBlock frame{};
  frame.eye = Vec4(0.0F, 1.0F, 0.0F, 1.0F);
  frame.forward = Vec4(0.0F, -1.0F, 0.0F, 0.0F);
  frame.right = Vec4(1.0F, 0.0F, 0.0F, 0.0F);
  frame.up = Vec4(0.0F, 0.0F, -0.5F, 0.0F);
  frame.viewport = Vec4(32.0F, 16.0F, 1.0F / 32.0F, 1.0F / 16.0F);
  frame.ground = Vec4(0.0F, 10.0F, 8.0F, 1.0F);
  frame.ground_at = Vec4::Zero();
  return frame;
}

TEST(StillTiles, AreDrawnPixelByPixelWhereTheyBend) {
  using Tiles = std::vector<StillTile>;
  EXPECT_EQ(still_tiles(from_above(), plane_of_cells(-1), false),
            (Tiles{StillTile::solid, StillTile::solid}));
  EXPECT_EQ(still_tiles(from_above(), plane_of_cells(1), false),
            (Tiles{StillTile::each_pixel, StillTile::solid}));
  EXPECT_EQ(still_tiles(from_above(), plane_of_cells(-1), true),
            (Tiles{StillTile::each_pixel, StillTile::each_pixel}));
}

TEST(StillTiles, KnowTheGroundsEdge) {
  using Tiles = std::vector<StillTile>;
  FrameBlock frame = from_above();
  frame.ground_at = Vec4(0.5F, 0.0F, 0.0F, 0.0F);
  frame.ground = Vec4(0.0F, 0.45F, 0.2F, 1.0F);
  EXPECT_EQ(still_tiles(frame, plane_of_cells(-1), false), (Tiles{StillTile::background, StillTile::fading}));
  frame.ground.w() = 0.0F;
  EXPECT_EQ(still_tiles(frame, plane_of_cells(-1), false),
            (Tiles{StillTile::background, StillTile::background}));
  frame.ground.w() = 1.0F;
  StillCells at_horizon = plane_of_cells(-1);
  at_horizon.met.back() = 0;
  EXPECT_EQ(still_tiles(frame, at_horizon, false), (Tiles{StillTile::background, StillTile::each_pixel}));
}

}  // namespace still_picture_test
}  // namespace lagomorph::render::raster
