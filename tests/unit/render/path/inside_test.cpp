#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "render/backends.h"
#include "render/path/dielectric.h"
#include "render/path/medium.h"
#include "render/path/random_walk.h"
#include "tests/unit/render/path/shapes.h"

namespace lagomorph::render {
namespace inside_test {

using path::scattering_albedo;

RenderSettings settings(int size, int samples, int bounces = 4, int clear = 64) {
  RenderSettings s;
  s.backend = "path";
  s.width = size;
  s.height = size;
  s.samples = samples;
  s.path.bounces = bounces;
  s.path.transmission_bounces = clear;
  s.path.filter = "box";
  s.path.filter_radius = 0.5F;
  return s;
}

RenderScene furnace(Mesh mesh, const Material& material) {
  RenderScene scene;
  mesh.material = material;
  scene.meshes = {std::move(mesh)};
  scene.ground.enabled = false;
  scene.sky = {Color::Ones(), Color::Ones(), 1.0F};
  return scene;
}

CameraSettings camera(const Vec3& position, float fov) {
  CameraSettings c;
  c.position = position;
  c.look_at = Vec3::Zero();
  c.fov = fov;
  return c;
}

Eigen::Array3d mean_color(const RenderScene& scene, const CameraSettings& c, const RenderSettings& s) {
  const auto renderer = make_path_renderer(s, 2);
  renderer->set_scene(scene);
  const Image image = renderer->render(Camera(c, s.width, s.height), {0, 0.0});
  const std::vector<float>& values = image.find("color")->values;
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (std::size_t i = 0; i < values.size(); i += 3)
    sum += Eigen::Array3d(values[i], values[i + 1], values[i + 2]);
  return sum / (static_cast<double>(values.size()) / 3.0);
}

Material glass(float roughness, float ior = 1.5F) {
  Material m;
  m.transmission = 1.0F;
  m.roughness = roughness;
  m.ior = ior;
  return m;
}

TEST(ClearInside, AGlassSphereVanishesInAWhiteFurnace) {
  for (const float roughness : {0.0F, 0.3F, 0.6F, 1.0F}) {
    const RenderScene scene = furnace(make_sphere(4, 1.0F, Vec3::Zero()), glass(roughness));
    const Eigen::Array3d mean = mean_color(scene, camera({0, 0, 4}, 24.0F), settings(16, 256));
    EXPECT_NEAR(mean.y(), 1.0, 0.01) << roughness;
  }
}

TEST(ClearInside, ASlabAbsorbsByItsClosedForm) {
  // Seen straight: with F of one face and the slab's transmittance a, (1 - F)^2 a / (1 - F^2 a^2) goes
  // through and F + F (1 - F)^2 a^2 / (1 - F^2 a^2) comes back.
  Material m = glass(0.0F, 1.5F);
  m.absorption_color = Color(0.7F, 0.4F, 1.0F);
  m.absorption_distance = 0.5F;
  const RenderScene scene = furnace(make_box({-5, -5, -0.2F}, {5, 5, 0.2F}), m);
  const Eigen::Array3d mean = mean_color(scene, camera({0, 0, 4}, 1.0F), settings(8, 4096));
  for (int k = 0; k < 3; ++k) {
    const double f = 0.04, a = std::pow(static_cast<double>(m.absorption_color[k]), 0.4 / 0.5);
    const double rest = (1.0 - f) * (1.0 - f) / (1.0 - f * f * a * a);
    EXPECT_NEAR(mean[k], a * rest + f + f * a * a * rest, 2e-3) << k;
  }
}

TEST(ClearInside, AnEyeInTheBodySeesItsColour) {
  Material m = glass(0.0F, 1.001F);
  m.absorption_color = Color(0.5F, 0.8F, 1.0F);
  m.absorption_distance = 1.0F;
  const RenderScene scene = furnace(make_box({-50, -50, -2}, {50, 50, 2}), m);
  CameraSettings c = camera({0, 0, 0.5F}, 1.0F);
  c.look_at = Vec3(0, 0, 5);
  const Eigen::Array3d mean = mean_color(scene, c, settings(4, 64));
  // Radiance over n^2 stays as it enters.
  const double n2 = 1.001 * 1.001;
  EXPECT_NEAR(mean.x(), n2 * std::pow(0.5, 1.5), 2e-4);
  EXPECT_NEAR(mean.y(), n2 * std::pow(0.8, 1.5), 2e-4);
  EXPECT_NEAR(mean.z(), n2, 2e-4);
}

TEST(ClearInside, LightBehindAWindowIsFoundByTheScatteredRayAlone) {
  // A lamp behind a pane of glass lights a wall as without it but for what the pane reflects.
  RenderScene scene;
  scene.ground.enabled = false;
  scene.sky.strength = 0.0F;
  Mesh wall = make_quad({-3, -3, -1}, {6, 0, 0}, {0, 6, 0});
  wall.material = {Color(0.5F, 0.5F, 0.5F), 1.0F, 0.0F, 1.0F};
  AreaLight lamp;
  lamp.position = Vec3(0, 0, 2);
  lamp.look_at = Vec3(0, 0, -1);
  lamp.size = Vec2(3, 3);
  scene.lights = {lamp};
  scene.meshes = {wall};
  CameraSettings c = camera({0.8F, 0, -0.3F}, 20.0F);
  c.look_at = Vec3(0, 0, -1);
  const double open = mean_color(scene, c, settings(8, 1024)).y();
  Mesh pane = make_box({-9, -9, 0.5F}, {9, 9, 0.6F});
  pane.material = glass(0.0F);
  scene.meshes.push_back(pane);
  const double behind = mean_color(scene, c, settings(8, 4096)).y();
  EXPECT_LT(behind, 0.96 * open);
  EXPECT_GT(behind, 0.80 * open);
}

/// Mean and standard error of the weights with which walks come out of a half space again.
struct Reflected {
  Eigen::Array3d mean, error;
};
Reflected half_space(float target, const Color& radius, int n) {
  Material m;
  m.subsurface = 1.0F;
  m.subsurface_color = Color::Constant(target);
  m.subsurface_radius = radius;
  RenderScene scene;
  scene.meshes = {make_box({-1, -1, -1}, {1, 1, 0})};
  scene.meshes[0].material = m;
  scene.ground.enabled = false;
  path::SceneGeometry geometry(scene);
  geometry.commit();
  const path::CloudyInside inside(m);
  path::RandomWalk walks;
  const path::FrameSamples numbers(11, 0, n);
  for (int k = 0; k < n; ++k) {
    const path::PathSamples p = numbers.path(0, 0, k);
    Vec3 d = path::sample_cosine(p.pair(0));
    d.z() = -d.z();
    walks.begin({Vec3(0, 0, -1e-6F), d}, 0, inside, p, 0);
  }
  Eigen::Array3d sum = Eigen::Array3d::Zero(), squares = Eigen::Array3d::Zero();
  for (const path::RandomWalk::Exit& exit : walks.finish(geometry)) {
    if (!exit.found) continue;
    EXPECT_GT(exit.normal.z(), 0.99F);
    sum += exit.weight.cast<double>() / n;
    squares += exit.weight.cast<double>().square() / n;
  }
  return {sum, ((squares - sum.square()) / n).sqrt()};
}

TEST(CloudyInside, SingleScatteringsGiveTheAlbedoOfAThickPiece) {
  EXPECT_FLOAT_EQ(scattering_albedo(0.0F), 0.0F);
  EXPECT_FLOAT_EQ(scattering_albedo(1.0F), 1.0F);
  for (const float target : {0.1F, 0.3F, 0.5F, 0.8F, 0.95F}) {
    const Reflected all = half_space(target, Color::Constant(1e-3F), 32768);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(all.mean[k], target, 0.005 * target + 1e-3) << target << " " << k;
  }
}

TEST(CloudyInside, ColoursOfDifferentPathsHaveTheirAlbedoToo) {
  for (const float target : {0.3F, 0.8F}) {
    const Reflected all = half_space(target, Color(1e-3F, 2e-3F, 5e-3F), 65536);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(all.mean[k], target, 4.0 * all.error[k]) << target << " " << k;
      EXPECT_LT(all.error[k], 0.01);
    }
  }
}

TEST(CloudyInside, AWhiteOneVanishesInAWhiteFurnace) {
  Material m;
  m.subsurface = 1.0F;
  m.subsurface_color = Color::Ones();
  m.subsurface_radius = Color(0.1F, 0.3F, 1.0F);
  const RenderScene scene = furnace(make_sphere(4, 1.0F, Vec3::Zero()), m);
  const Eigen::Array3d mean = mean_color(scene, camera({0, 0, 4}, 24.0F), settings(16, 256, 16));
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(mean[k], 1.0, 0.01) << k;
}

TEST(CloudyInside, AThickOneIsAsBrightAsADiffuseOneOfItsColour) {
  Material diffuse;
  diffuse.base_color = Color(0.8F, 0.5F, 0.2F);
  Material cloudy = diffuse;
  cloudy.subsurface = 1.0F;
  cloudy.subsurface_color = diffuse.base_color;
  cloudy.subsurface_radius = Color::Constant(1e-3F);
  const Mesh box = make_box({-1, -1, -1}, {1, 1, 1});
  const CameraSettings c = camera({0.3F, 0.2F, 4}, 10.0F);
  const Eigen::Array3d a = mean_color(furnace(box, diffuse), c, settings(8, 1024));
  for (const float part : {0.5F, 1.0F}) {
    cloudy.subsurface = part;
    const Eigen::Array3d b = mean_color(furnace(box, cloudy), c, settings(8, 1024));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(b[k], a[k], 0.01) << part << " " << k;
  }
}

TEST(CloudyInside, LightBleedsIntoTheShadow) {
  // Lit from the left only, the right side of a sphere is dark, unless light walks through.
  RenderScene scene;
  scene.ground.enabled = false;
  scene.sky.strength = 0.0F;
  AreaLight lamp;
  lamp.position = Vec3(-4, 0, 0);
  lamp.look_at = Vec3::Zero();
  scene.lights = {lamp};
  Mesh ball = make_sphere(4, 1.0F, Vec3::Zero());
  CameraSettings c = camera({4, 0, 0}, 5.0F);
  ball.material.subsurface = 0.0F;
  scene.meshes = {ball};
  EXPECT_EQ(mean_color(scene, c, settings(4, 64)).y(), 0.0);
  ball.material.subsurface = 1.0F;
  ball.material.subsurface_radius = Color(0.5F, 0.1F, 0.02F);
  scene.meshes = {ball};
  const Eigen::Array3d through = mean_color(scene, c, settings(8, 512));
  EXPECT_GT(through.x(), 2.0 * through.y());
  EXPECT_GT(through.y(), 2.0 * through.z());
}

TEST(Clamp, CutsIndirectLightAloneAndOnlyWhenItIsOn) {
  RenderScene scene = furnace(make_quad({-5, 0, -5}, {0, 0, 10}, {10, 0, 0}), Material{});
  scene.sky.strength = 10.0F;
  const CameraSettings c = camera({0, 3, 1}, 30.0F);
  RenderSettings s = settings(8, 64);
  const double open = mean_color(scene, c, s).y();
  s.path.clamp = 0.5F;
  EXPECT_EQ(mean_color(scene, c, s).y(), open);  // it is direct
  Mesh wall = make_quad({-5, 0, -1}, {10, 0, 0}, {0, 10, 0});
  scene.meshes.push_back(wall);
  const double cut = mean_color(scene, c, s).y();
  s.path.clamp = 0.0F;
  const double whole = mean_color(scene, c, s).y();
  EXPECT_LT(cut, 0.97 * whole);
  s.path.clamp = 1e5F;
  EXPECT_EQ(mean_color(scene, c, s).y(), whole);
}

TEST(InsideOfBodies, AnyNumberOfThreadsDrawsTheSame) {
  Material m = glass(0.3F);
  m.transmission = 0.5F;
  m.subsurface = 0.5F;
  m.coat = 0.5F;
  m.sheen = 0.5F;
  const RenderScene scene = furnace(make_sphere(3, 1.0F, Vec3::Zero()), m);
  const RenderSettings s = settings(70, 4);
  std::vector<float> one;
  for (const int threads : {1, 2}) {
    const auto renderer = make_path_renderer(s, threads);
    renderer->set_scene(scene);
    const Image image = renderer->render(Camera(camera({0, 0, 4}, 40.0F), s.width, s.height), {0, 0.0});
    if (one.empty()) one = image.find("color")->values;
    EXPECT_EQ(image.find("color")->values, one);
  }
}

}  // namespace inside_test
}  // namespace lagomorph::render
