#include "render/raster/ground_tiles.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "render/raster/pixel_ray.h"
#include "tests/unit/render/raster/shapes.h"

namespace lagomorph::render::raster {
namespace ground_tiles_test {

constexpr int width = 320, height = 180, map_size = 1024;

/// A camera that sees the ground up to its horizon, as the rasterizer tells the shaders.
FrameBlock frame_of(const CameraSettings& settings) {
  const Camera camera(settings, width, height);
  const Mat4 projection = camera.projection(0.1F, 100.0F);
  FrameBlock frame{};
  frame.eye = vec4(camera.position(), camera.is_orthographic() ? 1.0F : 0.0F);
  frame.forward = vec4(camera.forward(), 0.0F);
  frame.right = vec4(Vec3(camera.right() / projection(0, 0)), 0.0F);
  frame.up = vec4(Vec3(camera.up() / projection(1, 1)), 0.0F);
  frame.viewport = Vec4(width, height, 1.0F / width, 1.0F / height);
  frame.ground = Vec4(0.0F, 20.0F, 18.0F, 1.0F);
  frame.ground_at = Vec4::Zero();
  frame.ground_map = Vec4(1e3F, 1.0F, -1e6F, -1e6F);  // none of it is in the picture
  frame.counts = Vec4(1.0F, 0.0F, 1.0F, 128.0F);
  return frame;
}

struct LitSquare {
  AreaLight light;
  FrameBlock frame;
  CasterGrid casters;
};
/// A square of 1 m at height 1 under a light at height 4.
LitSquare lit_square(const CameraSettings& camera) {
  LitSquare s;
  s.light.position = Vec3(1.0F, 4.0F, 0.5F);
  s.light.look_at = Vec3::Zero();
  s.light.size = Vec2(0.8F, 0.4F);
  s.frame = frame_of(camera);
  const Mesh mesh = rectangle(Vec3(0.0F, 1.0F, 0.0F), 0.5F * Vec3::UnitZ(), 0.5F * Vec3::UnitX());
  const std::vector<std::vector<Vec3>> positions = {mesh.positions};
  const LightView view = fit_light_view(s.light, positions, map_size);
  const LightFrame f = light_frame(s.light);
  LightBlock& block = s.frame.lights[0];
  block.position = vec4(s.light.position, 1.0F);
  block.right = vec4(f.right, 0.5F * s.light.size.x());
  block.up = vec4(f.up, 0.5F * s.light.size.y());
  block.normal = vec4(f.normal, 0.0F);
  block.map = view.map;
  block.depth = view.depth;
  add_casters(s.light, view, mesh.positions, mesh.triangles, s.casters);
  return s;
}

/// Whether the square is between a point of the ground and one of 9 x 9 of the light.
bool is_shadowed(const LitSquare& s, const Vec3& x) {
  const LightFrame f = light_frame(s.light);
  for (int i = 0; i < 81; ++i) {
    const Vec3 from = s.light.position +
                      (static_cast<float>(i % 9) / 8.0F - 0.5F) * s.light.size.x() * f.right +
                      (static_cast<float>(i / 9) / 8.0F - 0.5F) * s.light.size.y() * f.up;
    const Vec3 at = x + (from - x) / from.y();  // at height 1
    if (std::abs(at.x()) <= 0.5F && std::abs(at.z()) <= 0.5F) return true;
  }
  return false;
}

CameraSettings towards_the_horizon(bool orthographic) {
  CameraSettings camera;
  camera.position = Vec3(0.3F, 1.2F, 5.0F);
  camera.look_at = Vec3(0.0F, orthographic ? 0.0F : 1.0F, 0.0F);
  camera.fov = 50.0F;
  if (orthographic) camera.orthographic = 4.0F;
  return camera;
}

class GroundTiles : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Cameras, GroundTiles, testing::Bool());

TEST_P(GroundTiles, HoldEveryShadowedPixelAndNotMuchElse) {
  const LitSquare s = lit_square(towards_the_horizon(GetParam()));
  const std::vector<TileRun> runs = touched_tiles(s.frame, {&s.casters, 1}, map_size, {0, 0, width, height});
  const auto bit_at = [&](float x, float y) {
    for (const TileRun& run : runs) {
      if (x >= run.left && x < run.right && y >= run.lower && y < run.upper) return run.lights_hidden == 1;
    }
    return false;
  };
  int shadowed = 0, marked = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float px = static_cast<float>(x) + 0.5F, py = static_cast<float>(y) + 0.5F;
      const auto ground = ground_at_pixel(s.frame, px, py);
      const bool dark = ground && is_shadowed(s, ground->point);
      const bool bit = bit_at(px, py);
      EXPECT_TRUE(!dark || bit) << x << ' ' << y;
      shadowed += dark ? 1 : 0;
      marked += bit ? 1 : 0;
    }
  }
  EXPECT_GT(shadowed, 500);
  EXPECT_LT(marked, width * height / 3);
}

TEST(GroundTilesOf, TheGroundsMapAreTouchedWithoutAnyLight) {
  LitSquare s = lit_square(towards_the_horizon(false));
  s.frame.ground_map = Vec4(0.25F, 0.03F, 0.5F, 0.5F);  // 4 m around the middle
  const std::vector<TileRun> runs = touched_tiles(s.frame, {}, map_size, {0, 0, width, height});
  ASSERT_FALSE(runs.empty());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float px = static_cast<float>(x) + 0.5F, py = static_cast<float>(y) + 0.5F;
      const auto ground = ground_at_pixel(s.frame, px, py);
      if (!ground || ground->point.cwiseAbs().maxCoeff() > 2.0F) continue;
      EXPECT_TRUE(std::any_of(runs.begin(), runs.end(),
                              [&](const TileRun& run) {
                                return px >= run.left && px < run.right && py >= run.lower && py < run.upper;
                              }))
          << x << ' ' << y;
    }
  }
  for (const TileRun& run : runs) EXPECT_EQ(run.lights_hidden, 0U);
}

TEST(GroundTilesOf, ASceneWithoutMeshesOrGroundAreNone) {
  LitSquare s = lit_square(towards_the_horizon(false));
  s.frame.counts.z() = 0.0F;
  EXPECT_TRUE(touched_tiles(s.frame, {&s.casters, 1}, map_size, {0, 0, width, height}).empty());
  s = lit_square(towards_the_horizon(false));
  s.frame.ground.w() = 0.0F;
  EXPECT_TRUE(touched_tiles(s.frame, {&s.casters, 1}, map_size, {0, 0, width, height}).empty());
}

}  // namespace ground_tiles_test
}  // namespace lagomorph::render::raster
