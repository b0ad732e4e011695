#include "render/raster/view_range.h"

#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/render/raster/shapes.h"

namespace lagomorph::render::raster {
namespace view_range_test {

CameraSettings from_the_front() {
  CameraSettings camera;
  camera.position = Vec3(0.0F, 0.0F, 3.0F);
  camera.look_at = Vec3::Zero();
  camera.fov = 40.0F;
  return camera;
}

TEST(ViewRange, FitsWhatIsThere) {
  const std::vector<std::vector<Vec3>> positions = {sphere(Vec3::Zero(), 0.5F).positions};
  const ViewRange range = view_range(Camera(from_the_front(), 64, 64), positions, empty_scene());
  EXPECT_LE(range.near, 2.5F);
  EXPECT_GT(range.near, 2.4F);
  EXPECT_GE(range.far, 3.5F);
  EXPECT_LT(range.far, 3.6F);
}

TEST(ViewRange, StaysBeforeTheCameraOnAWideGround) {
  RenderScene scene = empty_scene();
  scene.ground.enabled = true;
  CameraSettings settings = from_the_front();
  settings.position.y() = 1.0F;
  const ViewRange range = view_range(Camera(settings, 64, 64), {}, scene);
  EXPECT_GT(range.near, 0.0F);
  EXPECT_LT(range.near, 0.01F);
  EXPECT_GT(range.far, 12.0F);
  settings.orthographic = 2.0F;
  EXPECT_EQ(view_range(Camera(settings, 64, 64), {}, scene).near, 0.0F);
}

TEST(SeenRectangle, HoldsEveryProjection) {
  const std::vector<std::vector<Vec3>> positions = {sphere(Vec3(0.3F, -0.2F, 0.1F), 0.3F).positions};
  const Camera camera(from_the_front(), 200, 100);
  const PixelRectangle r = seen_rectangle(camera, positions, empty_scene());
  float left = 1e9F;
  for (const Vec3& p : positions[0]) {
    const Vec2 at = camera.project(p);
    EXPECT_GT(at.x(), static_cast<float>(r.x + 1));
    EXPECT_LT(at.x(), static_cast<float>(r.x + r.width - 1));
    EXPECT_GT(100.0F - at.y(), static_cast<float>(r.y + 1));
    EXPECT_LT(100.0F - at.y(), static_cast<float>(r.y + r.height - 1));
    left = std::min(left, at.x());
  }
  EXPECT_LT(left - static_cast<float>(r.x), 4.0F);
}

TEST(SeenRectangle, IsAllOrNothingAtTheExtremes) {
  const Camera camera(from_the_front(), 200, 100);
  const std::vector<std::vector<Vec3>> around = {sphere(Vec3::Zero(), 5.0F).positions};
  const PixelRectangle all = seen_rectangle(camera, around, empty_scene());
  EXPECT_EQ(all.width, 200);
  EXPECT_EQ(all.height, 100);
  const std::vector<std::vector<Vec3>> aside = {sphere(Vec3(50.0F, 0.0F, 0.0F), 0.5F).positions};
  EXPECT_EQ(seen_rectangle(camera, aside, empty_scene()).width, 0);
  EXPECT_EQ(seen_rectangle(camera, {}, empty_scene()).width, 0);
}

}  // namespace view_range_test
}  // namespace lagomorph::render::raster
