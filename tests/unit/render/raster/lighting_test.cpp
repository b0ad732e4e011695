// Pictures of scenes whose radiance has a closed form.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "render/path/brdf.h"
#include "render/raster/sky_model.h"
#include "tests/unit/render/raster/shapes.h"

namespace lagomorph::render::raster {
namespace lighting_test {

/// Looks straight down at the origin from 3 m, +x to the right, -z up.
CameraSettings from_above() {
  CameraSettings camera;
  camera.position = Vec3(0.0F, 3.0F, 0.0F);
  camera.look_at = Vec3::Zero();
  camera.up = Vec3(0.0F, 0.0F, -1.0F);
  camera.fov = 40.0F;
  return camera;
}

AreaLight small_far_light() {
  AreaLight light;
  light.position = Vec3(3.0F, 4.0F, 2.0F);
  light.look_at = Vec3(0.3F, 0.0F, -0.4F);
  light.size = Vec2(0.1F, 0.05F);
  light.color = Color(1.0F, 0.5F, 0.25F);
  light.radiance = 2000.0F;
  return light;
}

/// Irradiance of a light so small that it is a point.
float point_irradiance(const AreaLight& light, const Vec3& x, const Vec3& n) {
  const Vec3 d = light.position - x;
  const Vec3 l = d.normalized();
  return light.radiance * light.size.prod() * std::max(n.dot(l), 0.0F) *
         std::max(-l.dot(light_frame(light).normal), 0.0F) / d.squaredNorm();
}

RenderScene with_ground(const AreaLight& light) {
  RenderScene scene = empty_scene();
  scene.ground.enabled = true;
  scene.lights = {light};
  return scene;
}

TEST(RasterLight, AMatteGroundUnderASmallFarLightHasItsClosedForm) {
  const AreaLight light = small_far_light();
  const RenderSettings settings = small_settings();
  const Camera camera(from_above(), settings.width, settings.height);
  const Image image = draw(with_ground(light), from_above(), settings);
  for (const auto& [x, y] : {std::pair{48, 32}, {5, 5}, {90, 60}, {70, 11}}) {
    const Ray ray = camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
    const Vec3 p = ray.origin - ray.origin.y() / ray.direction.y() * ray.direction;
    const Color expected = 0.5F / pi * point_irradiance(light, p, Vec3::UnitY()) * light.color;
    const Color found = color_at(image, x, y);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 2e-3F * expected[c]);
  }
}

TEST(RasterLight, ACoatedGroundReflectsAsThePathTracersMaterialDoes) {
  const AreaLight light = small_far_light();
  const RenderSettings settings = small_settings();
  const Camera camera(from_above(), settings.width, settings.height);
  for (const float roughness : {0.3F, 0.6F, 1.0F}) {
    RenderScene scene = with_ground(light);
    scene.ground.material = Material{Color(0.9F, 0.5F, 0.1F), roughness, 0.0F, 1.5F};
    const path::Brdf brdf(scene.ground.material);
    const Image image = draw(scene, from_above(), settings);
    for (const auto& [x, y] : {std::pair{48, 32}, {5, 5}, {90, 60}, {70, 11}}) {
      const Ray ray = camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      const Vec3 p = ray.origin - ray.origin.y() / ray.direction.y() * ray.direction;
      const Vec3 l = (light.position - p).normalized();
      const auto local = [](const Vec3& d) { return Vec3(d.z(), d.x(), d.y()); };  // z along the normal
      const Color f = brdf.evaluate(brdf.view(local(-ray.direction)), local(l)).f_cos / l.y();
      const Color expected = point_irradiance(light, p, Vec3::UnitY()) * f * light.color;
      const Color found = color_at(image, x, y);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 0.01F * expected[c]) << roughness;
    }
  }
}

TEST(RasterLight, AMeshIsLitAsTheGroundIs) {
  const AreaLight light = small_far_light();
  const RenderSettings settings = small_settings();
  RenderScene scene = empty_scene();
  scene.lights = {light};
  scene.meshes = {rectangle(Vec3::Zero(), 5.0F * Vec3::UnitZ(), 5.0F * Vec3::UnitX())};
  const Image a = draw(with_ground(light), from_above(), settings);
  const Image b = draw(scene, from_above(), settings);
  const std::vector<float>& x = a.find("color")->values;
  const std::vector<float>& y = b.find("color")->values;
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], y[i], 1e-3F * x[i]) << i;
}

/// Irradiance / radiance of a parallel rectangle a x b at distance c over one of its corners.
double corner_over(double a, double b, double c) {
  const double x = a / std::hypot(a, c);
  const double y = b / std::hypot(b, c);
  return 0.5 * (x * std::atan(b / std::hypot(a, c)) + y * std::atan(a / std::hypot(b, c)));
}

TEST(RasterLight, ALargeNearLightHasLambertsClosedForm) {
  AreaLight light;
  light.position = Vec3(0.0F, 0.8F, 0.0F);
  light.look_at = Vec3::Zero();
  light.size = Vec2(2.0F, 2.0F);
  light.radiance = 3.0F;
  const RenderSettings settings = small_settings();
  CameraSettings below_light = from_above();
  below_light.position.y() = 0.79F;
  below_light.fov = 100.0F;
  const Camera camera(below_light, settings.width, settings.height);
  const Image image = draw(with_ground(light), below_light, settings);
  for (const auto& [x, y] : {std::pair{48, 32}, {20, 10}, {90, 60}}) {
    const Ray ray = camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
    const Vec3 p = ray.origin - ray.origin.y() / ray.direction.y() * ray.direction;
    // The four quarters that meet above p, with sign where p is beside the rectangle.
    double e = 0.0;
    for (const float sx : {-1.0F, 1.0F}) {
      for (const float sz : {-1.0F, 1.0F}) {
        const double a = 1.0 + sx * p.x();
        const double b = 1.0 + sz * p.z();
        e += std::copysign(1.0, a) * std::copysign(1.0, b) * corner_over(std::abs(a), std::abs(b), 0.8);
      }
    }
    const double expected = 0.5 / pi * 3.0 * e;
    EXPECT_NEAR(color_at(image, x, y)[0], expected, 2e-3 * expected) << p.transpose();
  }
}

TEST(RasterLight, WhereTheHorizonCutsALightItsUpperPartShines) {
  // A wall x = 0 that faces +x under a light whose centre is in the wall's plane: half of the light is above
  // its horizon. By quadrature over that half.
  AreaLight light;
  light.position = Vec3(0.0F, 1.5F, 0.0F);
  light.look_at = Vec3::Zero();
  light.size = Vec2(1.0F, 1.0F);
  light.radiance = 5.0F;
  RenderScene scene = empty_scene();
  scene.lights = {light};
  scene.meshes = {rectangle(Vec3::Zero(), 0.5F * Vec3::UnitY(), 0.5F * Vec3::UnitZ())};
  CameraSettings camera;
  camera.position = Vec3(3.0F, 0.0F, 0.0F);
  camera.look_at = Vec3::Zero();
  const Image image = draw(scene, camera, small_settings());
  double e = 0.0;
  constexpr int steps = 200;
  for (int i = 0; i < steps; ++i) {
    for (int k = 0; k < steps; ++k) {
      const double x = 0.5 * (i + 0.5) / steps;
      const double z = (k + 0.5) / steps - 0.5;
      const double d2 = x * x + z * z + 2.25;
      e += x * 1.5 / (d2 * d2) * 0.5 / (steps * steps);
    }
  }
  // A sphere of the same form factor stands for the rectangle there.
  const double expected = 0.5 / pi * 5.0 * e;
  EXPECT_NEAR(color_at(image, 48, 32)[0], expected, 0.08 * expected);
}

TEST(RasterLight, AMetalReflectsASmallLightByItsBrdf) {
  AreaLight light = small_far_light();
  light.color = Color::Ones();
  RenderScene scene = with_ground(light);
  scene.ground.material = {Color(0.9F, 0.6F, 0.3F), 0.5F, 1.0F, 1.5F};
  const RenderSettings settings = small_settings();
  const Camera camera(from_above(), settings.width, settings.height);
  const Image image = draw(scene, from_above(), settings);
  for (const auto& [px, py] : {std::pair{48, 32}, {80, 20}, {60, 50}}) {
    const Ray ray = camera.ray(static_cast<float>(px) + 0.5F, static_cast<float>(py) + 0.5F);
    const Vec3 p = ray.origin - ray.origin.y() / ray.direction.y() * ray.direction;
    const Eigen::Vector3d v = (-ray.direction).cast<double>();
    const Eigen::Vector3d l = (light.position - p).normalized().cast<double>();
    const Eigen::Vector3d h = (v + l).normalized();
    const double a2 = std::pow(0.5, 4.0);
    const double d = a2 / (pi * std::pow(h.y() * h.y() * (a2 - 1.0) + 1.0, 2.0));
    const double masking = 0.5 / (l.y() * std::sqrt(a2 + (1.0 - a2) * v.y() * v.y()) +
                                  v.y() * std::sqrt(a2 + (1.0 - a2) * l.y() * l.y()));
    const double fresnel = std::pow(1.0 - v.dot(h), 5.0);
    const double irradiance = point_irradiance(light, p, Vec3::UnitY());
    // More than once by the path tracer's formula, which is tested there.
    const path::Brdf brdf(scene.ground.material);
    const auto cosine = static_cast<float>(v.y());
    const path::F3 multiple = brdf.view(Vec3(std::sqrt(1.0F - cosine * cosine), 0.0F, cosine)).multiple;
    const float lost = path::look_up(brdf.constants().lost, static_cast<float>(l.y()));
    for (int c = 0; c < 3; ++c) {
      const double f0 = scene.ground.material.base_color[c];
      const double once = (f0 + (1.0 - f0) * fresnel) * d * masking;
      const double expected = (once + static_cast<double>(lost * path::color(multiple)[c])) * irradiance;
      EXPECT_NEAR(color_at(image, px, py)[c], expected, 5e-3 * expected);
    }
  }
}

TEST(RasterLight, TheSkyLightsByTheNormal) {
  RenderScene scene = empty_scene();
  scene.sky = {{0.2F, 0.5F, 1.0F}, {1.0F, 0.8F, 0.3F}, 0.7F};
  for (const float angle : {0.0F, 0.6F, 1.5708F, 2.6F}) {
    const Vec3 n(std::sin(angle), std::cos(angle), 0.0F);
    const Vec3 across(std::cos(angle), -std::sin(angle), 0.0F);
    scene.meshes = {rectangle(Vec3::Zero(), Vec3::UnitZ(), across)};
    ASSERT_NEAR(Vec3::UnitZ().cross(across).dot(n), 1.0F, 1e-6F);
    CameraSettings camera;
    camera.position = 3.0F * n;
    camera.look_at = Vec3::Zero();
    camera.up = Vec3::UnitZ();
    const Color found = color_at(draw(scene, camera, small_settings()), 48, 32);
    const SkyIrradiance e = sky_irradiance(n.y());
    const float below = pi * (1.0F - n.y()) / 2.0F;
    const Color expected =
        0.5F / pi * 0.7F * ((e.horizon + below) * scene.sky.horizon + e.zenith * scene.sky.zenith);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 3e-3F) << angle;
  }
}

TEST(RasterLight, AConvexBodyNeverShadowsItself) {
  AreaLight light = small_far_light();
  light.color = Color::Ones();
  RenderScene scene = empty_scene();
  scene.lights = {light};
  scene.meshes = {sphere(Vec3::Zero(), 1.0F, 64)};
  RenderSettings settings = small_settings(160, 160);
  for (const Vec3& from : {Vec3(3.0F, 4.0F, 2.0F), Vec3(-2.0F, 3.0F, 4.0F)}) {
    CameraSettings camera;
    camera.position = from;
    camera.look_at = Vec3::Zero();
    const Image image = draw(scene, camera, settings);
    const Camera view(camera, 160, 160);
    int compared = 0;
    for (int y = 0; y < 160; ++y) {
      for (int x = 0; x < 160; ++x) {
        const float depth = depth_at(image, x, y);
        if (!std::isfinite(depth)) continue;
        const Ray ray = view.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
        const Vec3 p = ray.origin + ray.direction * (depth / ray.direction.dot(view.forward()));
        const Vec3 n = p.normalized();
        if (n.dot(-ray.direction) < 0.2F) continue;  // the silhouette's pixels mix
        const float expected = 0.5F / pi * point_irradiance(light, p, n);
        EXPECT_NEAR(color_at(image, x, y)[0], expected, 0.03F * expected + 0.01F) << x << " " << y;
        ++compared;
      }
    }
    EXPECT_GT(compared, 6000);
  }
}

TEST(RasterLight, AnOpenMeshIsLitFromBothSides) {
  AreaLight light = small_far_light();
  RenderScene scene = empty_scene();
  scene.lights = {light};
  Mesh mesh = rectangle(Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitX());
  for (const bool smooth : {false, true}) {
    mesh.smooth = smooth;
    scene.meshes = {mesh};
    const Color front = color_at(draw(scene, from_above(), small_settings()), 48, 32);
    for (Triangle& t : scene.meshes[0].triangles) std::swap(t[1], t[2]);
    const Color back = color_at(draw(scene, from_above(), small_settings()), 48, 32);
    EXPECT_GT(front[0], 0.03F);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(front[c], back[c], 1e-4F);
  }
}

TEST(RasterLight, AVisibleLightIsSeenFromItsFrontOnly) {
  AreaLight light = small_far_light();
  light.position = Vec3(0.0F, 0.0F, 0.0F);
  light.look_at = Vec3(0.0F, 0.0F, 1.0F);
  light.size = Vec2(1.0F, 0.5F);
  light.radiance = 4.0F;
  RenderScene scene = empty_scene();
  scene.lights = {light};
  CameraSettings camera;
  camera.position = Vec3(0.0F, 0.0F, 3.0F);
  camera.look_at = Vec3::Zero();
  EXPECT_EQ(color_at(draw(scene, camera, small_settings()), 48, 32)[0], 0.0F);
  scene.lights[0].visible = true;
  const Image image = draw(scene, camera, small_settings());
  const Camera view(camera, 96, 64);
  for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(color_at(image, 48, 32)[c], 4.0F * light.color[c]);
  EXPECT_GT(color_of(image, view, Vec3(0.45F, 0.2F, 0.0F))[0], 3.9F);
  EXPECT_EQ(color_of(image, view, Vec3(0.2F, 0.45F, 0.0F))[0], 0.0F);
  camera.position.z() = -3.0F;
  EXPECT_EQ(color_at(draw(scene, camera, small_settings()), 48, 32)[0], 0.0F);
}

}  // namespace lighting_test
}  // namespace lagomorph::render::raster
