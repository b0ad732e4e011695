#include "render/raster/light_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "render/raster/stand_ins.h"
#include "tests/unit/render/raster/shapes.h"

namespace lagomorph::render::raster {
namespace light_parts_test {

/// Straight above a small box, so far from its top.
AreaLight light_above(const Vec2& size, float distance) {
  AreaLight light;
  light.position = Vec3(0.0F, 0.2F + distance, 0.0F);
  light.look_at = Vec3::Zero();
  light.size = size;
  return light;
}
std::vector<Mesh> small_box() { return {box(Vec3(-0.1F, 0.0F, -0.1F), Vec3(0.1F, 0.2F, 0.1F))}; }

LightSplit split_above(const Vec2& size, float distance) {
  return split_of(light_above(size, distance), small_box(), Ground());
}

TEST(LightSplit, IsOfWhatIsLargeBesideItsDistance) {
  EXPECT_EQ(split_above(Vec2(0.4F, 0.4F), 3.0F).count(), 1);
  EXPECT_EQ(split_above(Vec2(0.02F, 0.02F), 0.2F).count(), 1);
  const LightSplit metre = split_above(Vec2(1.0F, 1.0F), 1.8F);
  EXPECT_EQ(metre.across, 4);
  EXPECT_EQ(metre.up, 4);
  const LightSplit strip = split_above(Vec2(0.1F, 1.0F), 1.8F);
  EXPECT_EQ(strip.across, 1);
  EXPECT_EQ(strip.up, 4);
  EXPECT_EQ(split_above(Vec2(50.0F, 50.0F), 0.1F).count(), 36);
}

TEST(LightSplit, MindsOnlyWhatTheLightShinesOn) {
  std::vector<Mesh> meshes = small_box();
  meshes.push_back(box(Vec3(-1.0F, 3.3F, -1.0F), Vec3(1.0F, 3.4F, 1.0F)));  // a ceiling behind the light
  EXPECT_EQ(split_of(light_above(Vec2(0.4F, 0.4F), 3.0F), meshes, Ground()).count(), 1);
  EXPECT_EQ(split_of(light_above(Vec2(1.5F, 1.5F), 3.0F), {}, Ground()).count(), 1);
}

TEST(LightSplit, KnowsWhetherTheGroundHidesSome) {
  AreaLight light;
  light.position = Vec3(3.0F, 0.5F, 0.0F);
  light.look_at = Vec3(0.0F, 0.5F, 0.0F);
  light.size = Vec2(2.0F, 0.9F);
  Ground ground;
  EXPECT_FALSE(split_of(light, small_box(), ground).below_ground);
  light.size = Vec2(0.9F, 1.1F);
  EXPECT_TRUE(split_of(light, small_box(), ground).below_ground);
  ground.enabled = false;
  EXPECT_FALSE(split_of(light, small_box(), ground).below_ground);
}

TEST(LightSplit, IsOfSunsByTheirAngle) {
  const auto parts = [](float angle) {
    Sun sun;
    sun.angle = angle;
    const LightSplit split = split_of_sun(solid_angle(sun));
    EXPECT_EQ(split.across, split.up);
    return split.across;
  };
  EXPECT_EQ(parts(0.53F), 1);
  EXPECT_EQ(parts(3.8F), 1);
  EXPECT_EQ(parts(5.0F), 2);
  EXPECT_EQ(parts(8.0F), 3);
  EXPECT_EQ(parts(90.0F), 6);
}

TEST(LightSplit, HasPartsThatCoverTheLight) {
  LightBlock light{};
  light.position = Vec4(1.0F, 2.0F, 3.0F, 1.0F);
  light.right = Vec4(0.0F, 0.0F, 1.0F, 0.6F);
  light.up = Vec4(0.0F, 1.0F, 0.0F, 0.4F);
  const LightSplit split{3, 2, false};
  Vec3 low = Vec3::Constant(1e9F), high = -low, middle = Vec3::Zero();
  float area = 0.0F;
  for (int k = 0; k < split.count(); ++k) {
    const LightBlock part = part_of(light, split, k);
    const Vec3 at = part.position.head<3>();
    const Vec3 half = part.right.w() * part.right.head<3>() + part.up.w() * part.up.head<3>();
    low = low.cwiseMin(at - half);
    high = high.cwiseMax(at + half);
    middle += at / static_cast<float>(split.count());
    area += 4.0F * part.right.w() * part.up.w();
  }
  EXPECT_LT((low - Vec3(1.0F, 1.6F, 2.4F)).norm(), 1e-5F);
  EXPECT_LT((high - Vec3(1.0F, 2.4F, 3.6F)).norm(), 1e-5F);
  EXPECT_LT((middle - Vec3(1.0F, 2.0F, 3.0F)).norm(), 1e-5F);
  EXPECT_NEAR(area, 4.0F * 0.6F * 0.4F, 1e-5F);
}

/// In a plane parallel to the ground, by x and z.
struct Rectangle {
  double left, near, right, far;
};
Rectangle around(double x, double z, double half) { return {x - half, z - half, x + half, z + half}; }
Rectangle common(const Rectangle& a, const Rectangle& b) {
  return {std::max(a.left, b.left), std::max(a.near, b.near), std::min(a.right, b.right),
          std::min(a.far, b.far)};
}

/// Form factor of a rectangle at a height over a point of the ground, parallel to it [Howell, B-4].
double form_factor(const Rectangle& r, double height, double x, double z) {
  if (r.right <= r.left || r.far <= r.near) return 0.0;
  const auto corner = [&](double cx, double cz) {
    const double a = (cx - x) / height, b = (cz - z) / height;
    const double of_a = std::sqrt(1.0 + a * a), of_b = std::sqrt(1.0 + b * b);
    return (a / of_a * std::atan(b / of_a) + b / of_b * std::atan(a / of_b)) / (2.0 * std::numbers::pi);
  };
  return corner(r.right, r.far) - corner(r.left, r.far) - corner(r.right, r.near) + corner(r.left, r.near);
}

struct Sheet {
  double x, z, half, height;
};
constexpr std::array<Sheet, 2> sheets = {{{0.0, 0.0, 0.2, 0.15}, {0.15, 0.0, 0.25, 0.6}}};
/// Part of a square light's irradiance that goes past both sheets.
double seen_past_sheets(double light_size, double light_height, double x, double z) {
  const Rectangle light = around(0.0F, 0.0F, 0.5 * light_size);
  std::array<Rectangle, 2> hidden;
  for (std::size_t i = 0; i < 2; ++i) {  // as they appear on the light's plane
    const Sheet& s = sheets[i];
    const double grown = light_height / s.height;
    hidden[i] = common(light, around(x + grown * (s.x - x), z + grown * (s.z - z), grown * s.half));
  }
  const auto factor = [&](const Rectangle& r) { return form_factor(r, light_height, x, z); };
  const double taken = factor(hidden[0]) + factor(hidden[1]) - factor(common(hidden[0], hidden[1]));
  return 1.0 - taken / factor(light);
}

/// Mean of |seen - closed form| over the mean of the latter, where a tenth or more is hidden.
double shadow_error(RenderScene scene, double light_size, double light_height) {
  scene.ground.enabled = true;
  CameraSettings camera;
  camera.position = Vec3(0.0F, 1.5F, 3.0F);
  camera.look_at = Vec3(0.0F, 0.0F, 0.2F);
  camera.fov = 30.0F;
  RenderSettings settings = small_settings(640, 480);
  settings.raster.shadow_map = 2048;
  const Image open = draw(scene, camera, settings);
  for (const Sheet& s : sheets) {
    const auto half = static_cast<float>(s.half);
    const Vec3 middle = Eigen::Vector3d(s.x, s.height, s.z).cast<float>();
    scene.meshes.push_back(rectangle(middle, half * Vec3::UnitZ(), half * Vec3::UnitX()));
  }
  const Image image = draw(scene, camera, settings);
  const Camera view(camera, settings.width, settings.height);
  double apart = 0.0, light = 0.0;
  int count = 0;
  for (float z = -0.05F; z < 0.75F; z += 0.05F) {
    for (float x = -0.8F; x < 0.85F; x += 0.05F) {
      const double expected = seen_past_sheets(light_size, light_height, x, z);
      if (expected > 0.9) continue;
      const Vec3 p(x, 0.0F, z);
      const float seen = color_of(image, view, p)[0] / color_of(open, view, p)[0];
      apart += std::abs(static_cast<double>(seen) - expected);
      light += expected;
      ++count;
    }
  }
  EXPECT_GT(count, 50);
  return apart / light;
}

TEST(LargeLights, HaveTheClosedFormsShadows) {
  const auto error = [](float light_size) {
    constexpr float height = 1.2F;
    RenderScene scene = empty_scene();
    scene.lights = {light_above(Vec2(light_size, light_size), height - 0.2F)};
    return shadow_error(scene, static_cast<double>(light_size), static_cast<double>(height));
  };
  EXPECT_LT(error(1.0F), 0.015);  // 0.19 with one map
  EXPECT_LT(error(2.0F), 0.01);   // 0.21 with one map
}

TEST(LargeLights, SunsHaveTheClosedFormsShadows) {
  const auto error = [](float angle) {
    constexpr double height = 600.0;
    RenderScene scene = empty_scene();
    scene.suns.resize(1);
    scene.suns[0].direction = -Vec3::UnitY();
    scene.suns[0].angle = angle;
    return shadow_error(scene, height * std::sqrt(static_cast<double>(solid_angle(scene.suns[0]))), height);
  };
  EXPECT_LT(error(20.0F), 0.025);  // 0.051 with one map
  EXPECT_LT(error(45.0F), 0.018);  // 0.087 with one map
}

/// A wall before a light whose lower half is below a black ground, and before one of its upper half.
TEST(LargeLights, DoNotShineThroughTheGround) {
  RenderScene scene = empty_scene();
  scene.ground.enabled = true;
  scene.ground.material = matte(0.0F);
  scene.meshes = {rectangle(Vec3(0.0F, 0.55F, 0.0F), 0.5F * Vec3::UnitY(), 0.5F * Vec3::UnitZ())};
  CameraSettings camera;
  camera.position = Vec3(3.0F, 0.9F, 1.0F);
  camera.look_at = Vec3(0.0F, 0.5F, 0.0F);
  const Camera view(camera, 160, 120);
  const auto wall = [&](float middle, float height, float distance) {
    AreaLight light;
    light.position = Vec3(distance, middle, 0.0F);
    light.look_at = Vec3(0.0F, middle, 0.0F);
    light.size = Vec2(0.25F, height) * distance;
    scene.lights = {light};
    return draw(scene, camera, small_settings(160, 120));
  };
  for (const float distance : {1.2F, 3.0F}) {  // in parts and as one
    const float height = distance > 2.0F ? 0.5F : 1.6F;
    const Image half = wall(0.0F, height, distance);
    const Image upper = wall(0.25F * height * distance, 0.5F * height, distance);
    for (const float y : {0.15F, 0.5F, 0.95F}) {
      const Vec3 p(0.0F, y, 0.1F);
      EXPECT_NEAR(color_of(half, view, p)[0] / color_of(upper, view, p)[0], 1.0F, 0.005F)
          << distance << ' ' << y;
    }
  }
}

}  // namespace light_parts_test
}  // namespace lagomorph::render::raster
