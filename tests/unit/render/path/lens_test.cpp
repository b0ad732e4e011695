#include "render/path/lens.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "render/backends.h"
#include "render/error.h"
#include "tests/unit/render/path/shapes.h"

namespace lagomorph::render::path {
namespace lens_test {

constexpr double pi = std::numbers::pi;

CameraSettings focused(float f_stop, float distance) {
  CameraSettings c;
  c.position = Vec3(0, 0, 4);
  c.look_at = Vec3::Zero();
  c.fov = 20.0F;
  c.f_stop = f_stop;
  c.sensor_height = 0.2F;
  c.focus_distance = distance;
  return c;
}

TEST(Lens, ItsRadiusFollowsFromFieldOfViewAndSensor) {
  // 24 mm seen under 26.5 degrees: 50.96 mm; f/2 opens 25.48 mm.
  CameraSettings c;
  c.fov = 26.5F;
  EXPECT_EQ(Camera(c, 16, 9).lens_radius(), 0.0F);
  c.f_stop = 2.0F;
  EXPECT_NEAR(Camera(c, 16, 9).lens_radius(), 0.012 / std::tan(13.25 * pi / 180.0) / 4.0, 1e-7);
  EXPECT_FLOAT_EQ(Camera(c, 16, 9).focus_distance(), (c.look_at - c.position).norm());
  c.orthographic = 1.0F;
  EXPECT_EQ(Camera(c, 16, 9).lens_radius(), 0.0F);
}

TEST(Lens, RaysOfAPixelMeetInThePlaneOfFocus) {
  const Camera camera(focused(0.5F, 3.0F), 80, 60);
  const Ray middle = camera.ray(13.0F, 44.0F);
  const Vec3 sharp = middle.origin + 3.0F / middle.direction.dot(camera.forward()) * middle.direction;
  for (const Vec2& at : {Vec2(0, 0), Vec2(1, 0), Vec2(-0.3F, 0.8F), Vec2(0, -1)}) {
    const Ray ray = camera.ray(13.0F, 44.0F, at);
    EXPECT_NEAR((ray.origin - camera.position()).norm(), camera.lens_radius() * at.norm(), 1e-6);
    const Vec3 d = sharp - ray.origin;
    EXPECT_LT(d.cross(ray.direction).norm(), 1e-5F);
  }
}

TEST(Lens, AperturesAreFilledEvenly) {
  // Moments of a disc: <x^2> = <y^2> = 1/4; of a regular n-gon of circumradius 1: (2 + cos(2 pi / n)) / 12.
  for (const int blades : {0, 3, 5, 6}) {
    CameraSettings c = focused(1.0F, 4.0F);
    c.blades = blades;
    c.blade_rotation = 20.0F;
    const Aperture aperture(Camera(c, 4, 4));
    const FrameSamples numbers(0, 0, 4096);
    double x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0, largest = 0.0;
    for (int s = 0; s < 4096; ++s) {
      const Eigen::Vector2d p = aperture.point(numbers.path(0, 0, s).pair(0)).cast<double>();
      x += p.x(), y += p.y(), xx += p.x() * p.x(), yy += p.y() * p.y(), xy += p.x() * p.y();
      largest = std::max(largest, p.norm());
    }
    const double second = blades == 0 ? 0.25 : (2.0 + std::cos(2.0 * pi / blades)) / 12.0;
    EXPECT_NEAR(x / 4096, 0.0, 2e-3) << blades;
    EXPECT_NEAR(y / 4096, 0.0, 2e-3) << blades;
    EXPECT_NEAR(xx / 4096, second, 2e-3) << blades;
    EXPECT_NEAR(yy / 4096, second, 2e-3) << blades;
    EXPECT_NEAR(xy / 4096, 0.0, 2e-3) << blades;
    EXPECT_LE(largest, 1.0 + 1e-6) << blades;
    EXPECT_GT(largest, 0.98) << blades;
  }
  CameraSettings two;
  two.blades = 2;
  EXPECT_THROW(Camera(two, 4, 4), SettingsError);
}

constexpr float spread = 0.04F;  // side of the quad over its distance: some 50 pixels, so that noise is small

/// Rms radius of the picture of a small bright quad at a distance before the camera [pixels], and its light.
struct Spot {
  double radius, light;
};
Spot spot_of(const CameraSettings& camera, float distance) {
  RenderScene scene;
  scene.ground.enabled = false;
  scene.sky.zenith = scene.sky.horizon = Color::Ones();
  scene.sky.strength = 1.0F;
  scene.background = Color::Zero();
  const float size = spread * distance;
  scene.meshes = {make_quad(Vec3(-size / 2, -size / 2, 4.0F - distance), Vec3(size, 0, 0), Vec3(0, size, 0))};
  scene.meshes[0].material = {Color::Ones(), 1.0F, 0.0F, 1.0F};
  RenderSettings s;
  s.backend = "path";
  s.width = s.height = 64;
  s.samples = 1024;
  s.path.bounces = 0;
  s.path.filter = "box";
  s.path.filter_radius = 0.5F;
  const auto renderer = make_path_renderer(s, 2);
  renderer->set_scene(scene);
  const Image image = renderer->render(Camera(camera, s.width, s.height), {});
  double sum = 0.0, squares = 0.0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const double v = image.find("color")->values[static_cast<std::size_t>(3 * (64 * y + x))];
      sum += v;
      squares += v * (std::pow(x + 0.5 - 32.0, 2.0) + std::pow(y + 0.5 - 32.0, 2.0));
    }
  }
  return {std::sqrt(squares / sum), sum};
}

TEST(Lens, TheCircleOfConfusionIsThatOfTheThinLens) {
  // A point at z, focus at f, lens of radius R: its picture at the plane of focus is a disc of radius R |z -
  // f| / z, whose rms is that over sqrt(2); a pixel is 2 f tan(fov/2) / height there.
  const CameraSettings camera = focused(1.0F, 4.0F);
  const Camera c(camera, 64, 64);
  const double pixel = 2.0 * 4.0 * std::tan(10.0 * pi / 180.0) / 64.0;
  for (const float z : {2.5F, 3.0F, 6.0F}) {
    const double disc = static_cast<double>(c.lens_radius()) * std::abs(z - 4.0) / z / pixel;
    ASSERT_GT(disc, 4.0);
    const double own = static_cast<double>(spread) * 4.0 / pixel;  // side of the quad, seen there
    const double expected = std::sqrt(disc * disc / 2.0 + own * own / 6.0 + 1.0 / 6.0);
    EXPECT_NEAR(spot_of(camera, z).radius, expected, 0.01 * expected) << z;
  }
}

TEST(Lens, WhatIsInFocusStaysSharpAndNoLightIsLost) {
  CameraSettings pinhole = focused(0.0F, 4.0F);
  const Spot sharp = spot_of(pinhole, 4.0F);
  const Spot focus = spot_of(focused(1.0F, 4.0F), 4.0F);
  EXPECT_NEAR(focus.radius, sharp.radius, 0.01 * sharp.radius);
  EXPECT_NEAR(focus.light, sharp.light, 0.01 * sharp.light);
  EXPECT_NEAR(spot_of(focused(1.0F, 4.0F), 3.0F).light, spot_of(pinhole, 3.0F).light, 0.01 * sharp.light);
}

}  // namespace lens_test
}  // namespace lagomorph::render::path
