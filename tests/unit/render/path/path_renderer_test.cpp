#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "render/backends.h"
#include "render/error.h"
#include "render/path/brdf.h"
#include "tests/unit/render/path/shapes.h"

namespace lagomorph::render {
namespace path_renderer_test {

constexpr double pi = std::numbers::pi;

RenderSettings settings(int width, int height, int samples, int bounces = 4) {
  RenderSettings s;
  s.backend = "path";
  s.width = width;
  s.height = height;
  s.samples = samples;
  s.path.bounces = bounces;
  s.path.filter = "box";
  s.path.filter_radius = 0.5F;
  return s;
}

Image draw(const RenderScene& scene, const CameraSettings& camera, const RenderSettings& s, int frame = 0,
           int threads = 2) {
  const auto renderer = make_path_renderer(s, threads);
  renderer->set_scene(scene);
  return renderer->render(Camera(camera, s.width, s.height), {frame, 0.0});
}

Eigen::Array3d mean_color(const Image& image) {
  const std::vector<float>& values = image.find("color")->values;
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (std::size_t i = 0; i < values.size(); i += 3) {
    sum += Eigen::Array3d(values[i], values[i + 1], values[i + 2]);
  }
  return sum / (static_cast<double>(values.size()) / 3.0);
}

/// Looks straight at a small square of the ground around (x, 0, z), from above.
CameraSettings above(float x, float z, float size) {
  CameraSettings c;
  c.position = Vec3(x, 5.0F, z);
  c.look_at = Vec3(x, 0.0F, z);
  c.up = Vec3(0, 0, -1);
  c.orthographic = size;
  return c;
}

Sky uniform_sky(float radiance) {
  Sky sky;
  sky.zenith = sky.horizon = Color::Ones();
  sky.strength = radiance;
  return sky;
}

AreaLight ceiling(float width, float depth, float height, float radiance) {
  AreaLight light;
  light.position = Vec3(0.0F, height, 0.0F);
  light.look_at = Vec3::Zero();
  light.size = Vec2(width, depth);
  light.radiance = radiance;
  return light;
}

Material lambert(const Color& color) { return {color, 1.0F, 0.0F, 1.0F}; }

RenderScene empty_scene() {
  RenderScene scene;
  scene.ground.enabled = false;
  scene.sky = uniform_sky(0.0F);
  return scene;
}

TEST(PathRenderer, AWhiteSphereVanishesInAWhiteFurnace) {
  RenderScene scene = empty_scene();
  scene.sky = uniform_sky(1.0F);
  scene.meshes = {make_sphere(4, 1.0F, Vec3::Zero())};
  scene.meshes[0].material = lambert(Color::Ones());
  CameraSettings camera;
  camera.position = Vec3(0, 0, 4);
  camera.look_at = Vec3::Zero();
  const Image image = draw(scene, camera, settings(48, 48, 64));
  for (const float v : image.find("color")->values) ASSERT_NEAR(v, 1.0F, 2e-3F);
}

TEST(PathRenderer, NoMaterialShinesInAFurnace) {
  CameraSettings camera;
  camera.position = Vec3(0, 0, 4);
  camera.look_at = Vec3::Zero();
  for (const float roughness : {0.1F, 0.5F, 1.0F}) {
    for (const float metallic : {0.0F, 1.0F}) {
      RenderScene scene = empty_scene();
      scene.sky = uniform_sky(1.0F);
      scene.meshes = {make_sphere(4, 1.0F, Vec3::Zero())};
      scene.meshes[0].material = {Color::Ones(), roughness, metallic, 1.5F};
      const Image image = draw(scene, camera, settings(32, 32, 256));
      for (const float v : image.find("color")->values) ASSERT_LT(v, 1.05F) << roughness << " " << metallic;
      EXPECT_LT(mean_color(image).maxCoeff(), 1.003) << roughness << " " << metallic;
      EXPECT_GT(mean_color(image).minCoeff(), 0.99) << roughness << " " << metallic;
    }
  }
}

TEST(PathRenderer, LayersVanishInAWhiteFurnaceToo) {
  CameraSettings camera;
  camera.position = Vec3(0, 0, 4);
  camera.look_at = Vec3::Zero();
  for (const auto& [coat, sheen, metallic, subsurface] :
       {std::array{1.0F, 0.0F, 0.0F, 0.0F}, std::array{1.0F, 0.0F, 1.0F, 0.0F},
        std::array{0.0F, 1.0F, 0.0F, 0.0F}, std::array{1.0F, 1.0F, 0.0F, 0.0F},
        std::array{1.0F, 0.5F, 0.0F, 1.0F}}) {
    RenderScene scene = empty_scene();
    scene.sky = uniform_sky(1.0F);
    scene.meshes = {make_sphere(4, 1.0F, Vec3::Zero())};
    Material& m = scene.meshes[0].material;
    m = {Color::Ones(), 0.5F, metallic, 1.5F};
    m.coat = coat;
    m.coat_roughness = 0.3F;
    m.sheen = sheen;
    m.subsurface = subsurface;
    m.subsurface_color = Color::Ones();
    m.subsurface_radius = Color::Constant(2.0F);
    EXPECT_NEAR(mean_color(draw(scene, camera, settings(16, 16, 256, 16))).y(), 1.0, 0.01)
        << coat << " " << sheen << " " << metallic << " " << subsurface;
  }
}

TEST(PathRenderer, AMatteSphereBesideASmoothOneVanishesInAWhiteFurnace) {
  CameraSettings camera;
  camera.position = Vec3(0, 0, 5);
  camera.look_at = Vec3::Zero();
  for (const float metallic : {0.0F, 1.0F}) {
    RenderScene scene = empty_scene();
    scene.sky = uniform_sky(1.0F);
    scene.meshes = {make_sphere(4, 1.0F, Vec3::Zero()), make_sphere(4, 40.0F, Vec3(0.0F, -41.0F, 0.0F))};
    scene.meshes[0].material = lambert(Color::Ones());
    scene.meshes[1].material = {Color::Ones(), 0.05F, metallic, 1.5F};
    EXPECT_NEAR(mean_color(draw(scene, camera, settings(32, 32, 64, 32))).y(), 1.0, 2e-3) << metallic;
  }
}

TEST(PathRenderer, AGlossySphereHasItsDirectionalAlbedo) {
  // Where the camera looks straight at the sphere, a furnace shows the albedo at normal incidence: by
  // quadrature.
  const Material material{Color(0.9F, 0.6F, 0.3F), 0.6F, 0.7F, 1.5F};
  const path::Brdf brdf(material);
  Eigen::Array3d expected = Eigen::Array3d::Zero();
  const int rings = 1000, spokes = 64;
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < spokes; ++j) {
      const double z = (i + 0.5) / rings, phi = 2.0 * pi * j / spokes, r = std::sqrt(1.0 - z * z);
      const Vec3 wi = Eigen::Vector3d(r * std::cos(phi), r * std::sin(phi), z).cast<float>();
      expected +=
          brdf.evaluate(brdf.view(Vec3(0, 0, 1)), wi).f_cos.cast<double>() * 2.0 * pi / (rings * spokes);
    }
  }
  RenderScene scene = empty_scene();
  scene.sky = uniform_sky(1.0F);
  scene.meshes = {make_sphere(5, 1.0F, Vec3::Zero())};
  scene.meshes[0].material = material;
  CameraSettings camera;
  camera.position = Vec3(0, 0, 4);
  camera.look_at = Vec3::Zero();
  camera.orthographic = 0.02F;
  const Eigen::Array3d color = mean_color(draw(scene, camera, settings(8, 8, 1024)));
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(color[k], expected[k], 3e-3 * expected[k]);
}

TEST(PathRenderer, ARectangleLightsTheGroundByItsFormFactor) {
  RenderScene scene = empty_scene();
  scene.ground.enabled = true;
  scene.ground.material = lambert(Color(0.5F, 0.25F, 1.0F));
  scene.lights = {ceiling(1.5F, 1.0F, 2.0F, 3.0F)};
  // Under the middle: four corners' form factors, each from a quarter of 0.75 x 0.5 at height 2.
  const double a = 0.75, b = 0.5, h = 2.0, p = std::hypot(a, h), q = std::hypot(b, h);
  const double form = 4.0 * (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2.0 * pi);
  const Eigen::Array3d color = mean_color(draw(scene, above(0, 0, 0.01F), settings(8, 8, 256)));
  EXPECT_NEAR(color.x(), 3.0 * 0.5 * form, 1e-3 * 3.0 * 0.5 * form);
  EXPECT_NEAR(color.y(), 3.0 * 0.25 * form, 1e-3 * 3.0 * 0.25 * form);
  EXPECT_NEAR(color.z(), 3.0 * form, 1e-3 * 3.0 * form);
}

TEST(PathRenderer, SkyLightsTheGroundByItsGradient) {
  // E = integral of (horizon + (zenith - horizon) sqrt(y)) y over the hemisphere: pi horizon + 0.8 pi (zenith
  // - horizon).
  RenderScene scene = empty_scene();
  scene.ground.enabled = true;
  scene.ground.radius = 1000.0F;
  scene.ground.fade_start = 999.0F;
  scene.ground.material = lambert(Color::Ones());
  scene.sky.horizon = Color(0.2F, 1.0F, 0.0F);
  scene.sky.zenith = Color(1.0F, 0.2F, 0.5F);
  scene.sky.strength = 2.0F;
  const Eigen::Array3d color = mean_color(draw(scene, above(0, 0, 0.01F), settings(8, 8, 256)));
  const Eigen::Array3d horizon = scene.sky.horizon.cast<double>(), zenith = scene.sky.zenith.cast<double>();
  const Eigen::Array3d expected = 2.0 * (horizon + 0.8 * (zenith - horizon));
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(color[k], expected[k], 1e-3);
}

/// Reflected radiance of a rectangle above the ground's origin, towards wo, by the midpoint rule over the
/// light.
double reflected(const path::Brdf& brdf, const Vec3& to_eye, const AreaLight& light) {
  // The surface's frame: x = (1, 0, 0), y = (0, 0, -1), z = up.
  const auto local = [](const Vec3& w) { return Vec3(w.x(), -w.z(), w.y()); };
  const path::Brdf::View view = brdf.view(local(to_eye));
  const int n = 800;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const float u = (static_cast<float>(i) + 0.5F) / n - 0.5F,
                  v = (static_cast<float>(j) + 0.5F) / n - 0.5F;
      const Vec3 d = light.position + Vec3(u * light.size.x(), 0.0F, v * light.size.y());
      const double r2 = d.squaredNorm(), cosine = d.y() / std::sqrt(r2);
      sum += brdf.evaluate(view, local(d.normalized())).f_cos.x() * cosine / r2;
    }
  }
  return sum * light.size.x() * light.size.y() / (n * n) * light.radiance;
}

TEST(PathRenderer, EveryRoughnessReflectsTheLightAsQuadratureSays) {
  // Rough coats are found by sampling the light, smooth ones by sampling the BRDF: both and their weights
  // must be right.
  for (const float roughness : {0.12F, 0.3F, 0.6F, 1.0F}) {
    for (const float metallic : {0.0F, 1.0F}) {
      RenderScene scene = empty_scene();
      scene.ground.enabled = true;
      scene.ground.material = {Color::Constant(0.8F), roughness, metallic, 1.5F};
      scene.lights = {ceiling(1.0F, 0.8F, 1.5F, 2.0F)};
      CameraSettings camera;
      camera.position = Vec3(0.6F, 4.0F, 0.9F);
      camera.look_at = Vec3::Zero();
      camera.orthographic = 0.002F;
      const double expected =
          reflected(path::Brdf(scene.ground.material), camera.position.normalized(), scene.lights[0]);
      const Eigen::Array3d color = mean_color(draw(scene, camera, settings(8, 8, 1024)));
      EXPECT_NEAR(color.x(), expected, 5e-3 * expected) << roughness << " " << metallic;
    }
  }
}

TEST(PathRenderer, ManyLightsAddUp) {
  // More than are sampled at once; one is dim, one black.
  RenderScene scene = empty_scene();
  scene.ground.enabled = true;
  scene.ground.material = lambert(Color::Ones());
  Eigen::Array3d expected = Eigen::Array3d::Zero();
  for (int i = 0; i < 7; ++i) {
    AreaLight light = ceiling(0.5F, 0.5F, 2.0F + static_cast<float>(i), static_cast<float>(i * i));
    light.color = Color(1.0F, 0.5F, static_cast<float>(i) / 6.0F);
    const double a = 0.25, h = 2.0 + i, p = std::hypot(a, h);
    const double form = 4.0 * 2.0 * (a / p * std::atan(a / p)) / (2.0 * pi);
    expected += (light.radiance * light.color).cast<double>() * form;
    scene.lights.push_back(light);
  }
  const Eigen::Array3d color = mean_color(draw(scene, above(0, 0, 0.01F), settings(16, 16, 1024)));
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(color[k], expected[k], 5e-3 * expected[k]);
}

TEST(PathRenderer, BouncesAreAsManyAsAskedFor) {
  // Inside a closed grey shell under a uniform light of its own: a sphere seen from inside gets from each
  // bounce albedo times the one before. The light is a small ceiling; the ratio of successive orders at one
  // place tends to the albedo.
  RenderScene scene = empty_scene();
  scene.meshes = {make_sphere(3, 1.0F, Vec3::Zero())};
  scene.meshes[0].material = lambert(Color::Constant(0.5F));
  scene.lights = {ceiling(0.2F, 0.2F, 0.5F, 20.0F)};
  CameraSettings camera;
  camera.position = Vec3(0, 0, 0.2F);
  camera.look_at = Vec3(0, 0.1F, -1);
  camera.fov = 60.0F;
  double last = 0.0;
  std::vector<double> orders;
  for (const int bounces : {0, 1, 2, 3, 8}) {
    const double mean = mean_color(draw(scene, camera, settings(16, 16, 256, bounces))).x();
    orders.push_back(mean - last);
    last = mean;
  }
  // In a sphere indirect light is uniform: each order is exactly the albedo times the one before it, from the
  // first indirect one on; the orders 4 to 8 sum up to o3 (0.5 + ... + 0.5^5).
  EXPECT_GT(orders[0], 0.0);
  EXPECT_NEAR(orders[2] / orders[1], 0.5, 0.01);
  EXPECT_NEAR(orders[3] / orders[2], 0.5, 0.02);
  EXPECT_NEAR(orders[4] / orders[3], 0.5 + 0.25 + 0.125 + 0.0625 + 0.03125, 0.04);
}

TEST(PathRenderer, NothingLeaksIntoAClosedShell) {
  for (const bool smooth : {false, true}) {
    RenderScene scene = empty_scene();
    scene.sky = uniform_sky(1000.0F);
    scene.lights = {ceiling(1.0F, 1.0F, 5.0F, 1000.0F)};
    scene.meshes = {make_sphere(3, 1.0F, Vec3(0, 0.3F, 0)), make_box(Vec3(-3, -3, -3), Vec3(3, 3, 3))};
    for (Mesh& mesh : scene.meshes) mesh.smooth = smooth;
    CameraSettings camera;
    camera.position = Vec3(1.5F, 0.5F, 2.0F);
    camera.look_at = Vec3(0, 0, 0);
    camera.fov = 80.0F;
    const Image image = draw(scene, camera, settings(64, 64, 16));
    for (const float v : image.find("color")->values) ASSERT_EQ(v, 0.0F) << smooth;
  }
}

TEST(PathRenderer, ABodyThatStandsOnTheGroundIsDarkBelow) {
  // Seen from below through no ground at all, a box on the ground: the ground hides its underside.
  RenderScene scene = empty_scene();
  scene.ground.enabled = true;
  scene.ground.material = lambert(Color::Zero());
  scene.sky = uniform_sky(1.0F);
  scene.background = Color::Zero();
  Mesh box = make_box(Vec3(-0.5F, 0, -0.5F), Vec3(0.5F, 1, 0.5F));
  box.material = lambert(Color::Ones());
  scene.meshes = {box};
  // A box without its lid, seen from above: its floor is its underside's other side and sees the sky.
  scene.meshes[0].triangles.erase(scene.meshes[0].triangles.begin() + 6,
                                  scene.meshes[0].triangles.begin() + 8);
  const Image lit = draw(scene, above(0, 0, 0.2F), settings(8, 8, 64));
  EXPECT_GT(mean_color(lit).x(), 0.3);
  scene.meshes[0] = box;
  scene.meshes[0].material = lambert(Color::Ones());
  CameraSettings inside = above(0, 0, 0.2F);
  inside.position = Vec3(0, 0.5F, 0);
  const Image dark = draw(scene, inside, settings(8, 8, 64));
  EXPECT_EQ(mean_color(dark).maxCoeff(), 0.0);
}

TEST(PathRenderer, GroundFadesIntoWhatIsBehind) {
  RenderScene scene = empty_scene();
  scene.ground.enabled = true;
  scene.ground.radius = 4.0F;
  scene.ground.fade_start = 1.0F;
  scene.ground.material = lambert(Color::Constant(0.5F));
  scene.sky = uniform_sky(1.0F);
  scene.background = Color(0.0F, 2.0F, 0.0F);
  for (const float r : {0.5F, 1.5F, 2.5F, 3.5F, 4.5F}) {
    const Eigen::Array3d color = mean_color(draw(scene, above(r, 0, 0.001F), settings(4, 4, 64)));
    const double w = ground_fade(scene.ground, Vec3(r, 0, 0));
    EXPECT_NEAR(color.x(), (1.0 - w) * 0.5, 2e-3) << r;
    EXPECT_NEAR(color.y(), (1.0 - w) * 0.5 + w * 2.0, 2e-3) << r;
  }
  // A mesh behind it shows through as much.
  Mesh quad = make_quad(Vec3(-9, -1, 9), Vec3(18, 0, 0), Vec3(0, 0, -18));
  quad.material = lambert(Color::Zero());
  scene.meshes = {quad};
  const double w = ground_fade(scene.ground, Vec3(2.5F, 0, 0));
  const Eigen::Array3d color = mean_color(draw(scene, above(2.5F, 0, 0.001F), settings(4, 4, 4096)));
  EXPECT_NEAR(color.x(), (1.0 - w) * 0.5, 3e-3);
  EXPECT_NEAR(color.y(), (1.0 - w) * 0.5, 3e-3);
}

TEST(PathRenderer, LightComesThroughTheFadedGround) {
  // A light below the disc, and a white ceiling over it that sees the light through the fading ground only.
  RenderScene scene = empty_scene();
  scene.ground.enabled = true;
  scene.ground.radius = 2.0F;
  scene.ground.fade_start = 0.0F;
  scene.ground.material = lambert(Color::Zero());
  AreaLight light;
  light.position = Vec3(1.0F, -2.0F, 0.0F);
  light.look_at = Vec3(1.0F, 1.0F, 0.0F);
  light.size = Vec2(0.02F, 0.02F);
  light.radiance = 1e4F;
  scene.lights = {light};
  Mesh quad = make_quad(Vec3(-2, 1, -2), Vec3(4, 0, 0), Vec3(0, 0, 4));
  quad.material = lambert(Color::Ones());
  scene.meshes = {quad};
  CameraSettings camera = above(1, 0, 0.001F);
  camera.position.y() = 0.5F;
  camera.look_at.y() = 1.0F;
  const double covered = mean_color(draw(scene, camera, settings(4, 4, 256, 0))).x();
  scene.ground.enabled = false;
  const double open = mean_color(draw(scene, camera, settings(4, 4, 256, 0))).x();
  EXPECT_NEAR(open, 1e4 * 4e-4 / (9.0 * pi), 2e-2 * open);
  EXPECT_NEAR(covered / open, 0.5, 1e-2);  // the fade half way
}

TEST(PathRenderer, LightsAreSeenAsTheySay) {
  RenderScene scene = empty_scene();
  scene.background = Color(0.0F, 0.0F, 0.3F);
  AreaLight light;
  light.position = Vec3::Zero();
  light.look_at = Vec3(0, 0, 1);
  light.size = Vec2(1.0F, 1.0F);
  light.radiance = 5.0F;
  light.color = Color(1.0F, 0.5F, 0.25F);
  scene.lights = {light};
  CameraSettings camera;
  camera.position = Vec3(0, 0, 2);
  camera.look_at = Vec3::Zero();
  camera.orthographic = 0.5F;
  const auto color = [&] { return mean_color(draw(scene, camera, settings(4, 4, 16))); };
  EXPECT_NEAR(color().z(), 0.3, 1e-6);
  EXPECT_NEAR(color().x(), 0.0, 1e-6);
  scene.lights[0].visible = true;
  EXPECT_NEAR(color().x(), 5.0, 1e-5);
  EXPECT_NEAR(color().z(), 1.25, 1e-5);      // opaque: the background does not add
  scene.lights[0].look_at = Vec3(0, 0, -1);  // from behind
  EXPECT_NEAR(color().x(), 0.0, 1e-6);
  scene.lights[0].look_at = Vec3(0, 0, 1);  // behind a mesh
  scene.meshes = {make_quad(Vec3(-1, -1, 1), Vec3(2, 0, 0), Vec3(0, 2, 0))};
  scene.meshes[0].material = lambert(Color::Zero());
  EXPECT_NEAR(color().x(), 0.0, 1e-6);
}

TEST(PathRenderer, NoiseFallsAtLeastAsTheReciprocalOfSamples) {
  RenderScene scene;
  scene.meshes = {make_sphere(3, 0.5F, Vec3(0, 0.5F, 0))};
  scene.lights = {AreaLight{}};
  CameraSettings camera;
  const Image truth = draw(scene, camera, settings(24, 16, 4096), 1000);
  const auto error = [&](int samples) {
    const Image image = draw(scene, camera, settings(24, 16, samples));
    double sum = 0.0;
    for (std::size_t i = 0; i < 3 * 24 * 16; ++i) {
      sum += std::pow(image.find("color")->values[i] - truth.find("color")->values[i], 2.0);
    }
    return sum;
  };
  const double e4 = error(4), e16 = error(16), e64 = error(64);
  EXPECT_LT(e16, e4 / 3.8);
  EXPECT_LT(e64, e16 / 3.8);
}

/// A scene with everything, its mesh in one of several poses.
RenderScene busy_scene() {
  RenderScene scene;
  scene.meshes = {make_sphere(3, 0.5F, Vec3(0, 0.5F, 0)), make_box(Vec3(0.5F, 0, 0), Vec3(0.9F, 0.4F, 0.4F))};
  scene.meshes[1].material = {Color(0.9F, 0.7F, 0.3F), 0.3F, 1.0F, 1.5F};
  scene.lights = {AreaLight{}, ceiling(0.5F, 0.5F, 2.0F, 3.0F)};
  return scene;
}

std::vector<Vec3> pose(const Mesh& mesh, int k) {
  std::vector<Vec3> positions = mesh.positions;
  for (Vec3& p : positions) {
    p.y() *= 1.0F + 0.1F * static_cast<float>(k);
    p.x() += 0.05F * static_cast<float>(k) * std::sin(7.0F * p.y());
  }
  return positions;
}

std::vector<float> frame(Renderer& renderer, const RenderScene& scene, int k) {
  for (int m = 0; m < 2; ++m)
    renderer.update_positions(m, pose(scene.meshes[static_cast<std::size_t>(m)], k));
  return renderer.render(Camera({}, 70, 41), {k, 0.0}).find("color")->values;
}

TEST(PathRenderer, SameBitsForAnyThreadsAndAnyOrderOfFrames) {
  const RenderScene scene = busy_scene();
  RenderSettings s = settings(70, 41, 10);
  s.path.filter = "blackman_harris";
  s.path.filter_radius = 1.5F;
  const auto forward = make_path_renderer(s, 2);
  forward->set_scene(scene);
  std::vector<std::vector<float>> frames;
  for (int k = 0; k < 4; ++k) frames.push_back(frame(*forward, scene, k));
  EXPECT_NE(frames[0], frames[1]);
  const auto backward = make_path_renderer(s, 1);
  backward->set_scene(scene);
  for (int k = 3; k >= 0; --k)
    EXPECT_EQ(frame(*backward, scene, k), frames[static_cast<std::size_t>(k)]) << k;
  const auto alone = make_path_renderer(s, 3);
  alone->set_scene(scene);
  EXPECT_EQ(frame(*alone, scene, 2), frames[2]);
  alone->set_scene(scene);
  EXPECT_EQ(frame(*alone, scene, 3), frames[3]);
}

TEST(PathRenderer, SeedsAndFramesHaveOtherNoise) {
  const RenderScene scene = busy_scene();
  RenderSettings s = settings(16, 16, 4);
  const std::vector<float> first = draw(scene, {}, s, 0).find("color")->values;
  EXPECT_EQ(draw(scene, {}, s, 0).find("color")->values, first);
  EXPECT_NE(draw(scene, {}, s, 1).find("color")->values, first);
  s.path.seed = 1;
  EXPECT_NE(draw(scene, {}, s, 0).find("color")->values, first);
}

TEST(PathRenderer, DepthIsThatOfTheSphereAndTheGround) {
  RenderScene scene;
  const Vec3 center(0.1F, 0.6F, -0.2F);
  const double radius = 0.5;
  scene.meshes = {make_sphere(6, 0.5F, center)};
  scene.ground.radius = 2.0F;
  scene.ground.fade_start = 0.5F;
  RenderSettings s = settings(97, 64, 1, 0);
  s.channels = {"depth"};
  CameraSettings camera;
  camera.position = Vec3(0.4F, 1.2F, 2.5F);
  for (const bool orthographic : {false, true}) {
    if (orthographic) camera.orthographic = 3.0F;
    const Image image = draw(scene, camera, s);
    const std::vector<float>& depth = image.find("depth")->values;
    const Camera c(camera, s.width, s.height);
    int sphere = 0, ground = 0, nothing = 0, edge = 0;
    for (int y = 0; y < s.height; ++y) {
      for (int x = 0; x < s.width; ++x) {
        const Ray ray = c.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
        const Eigen::Vector3d o = ray.origin.cast<double>(), d = ray.direction.cast<double>();
        double t = std::numeric_limits<double>::infinity();
        const double to_ground = -o.y() / d.y();
        if (to_ground > 0.0 && std::hypot((o + to_ground * d).x(), (o + to_ground * d).z()) <= 2.0)
          t = to_ground;
        const Eigen::Vector3d oc = o - center.cast<double>();
        const double b = oc.dot(d), discriminant = b * b - oc.squaredNorm() + radius * radius;
        // The tessellation's outline is not the sphere's.
        const double miss = std::sqrt(std::max(oc.squaredNorm() - b * b, 0.0));
        if (std::abs(miss - radius) < 0.01) {
          ++edge;
          continue;
        }
        const bool on_sphere = discriminant > 0.0;
        if (on_sphere) t = -b - std::sqrt(discriminant);
        const float value = depth[static_cast<std::size_t>(y * s.width + x)];
        if (std::isinf(t)) {
          EXPECT_EQ(value, std::numeric_limits<float>::infinity());
          ++nothing;
          continue;
        }
        (on_sphere ? sphere : ground) += 1;
        const double expected = t * d.dot(c.forward().cast<double>());
        // The facets lie within 1e-4 m of the sphere but the ray may graze them.
        EXPECT_NEAR(value, expected, on_sphere ? 1e-3 : 1e-6 * expected) << x << " " << y;
        if (on_sphere && discriminant > 0.1) {
          EXPECT_NEAR(value, expected, 1e-4 * expected) << x << " " << y;
        }
      }
    }
    EXPECT_GT(sphere, 200);
    EXPECT_GT(ground, 500);
    EXPECT_GT(nothing, 500);
    EXPECT_LT(edge, 100);
  }
}

TEST(PathRenderer, OrthographicViewsHaveNoPerspective) {
  RenderScene scene = empty_scene();
  scene.background = Color::Zero();
  scene.sky = uniform_sky(1.0F);
  // Two quads of one size at different distances cover as many pixels.
  scene.meshes = {make_quad(Vec3(-0.9F, -0.4F, 0.0F), Vec3(0.8F, 0, 0), Vec3(0, 0.8F, 0)),
                  make_quad(Vec3(0.1F, -0.4F, -5.0F), Vec3(0.8F, 0, 0), Vec3(0, 0.8F, 0))};
  for (Mesh& mesh : scene.meshes) mesh.material = lambert(Color::Ones());
  CameraSettings camera;
  camera.position = Vec3(0, 0, 3);
  camera.look_at = Vec3::Zero();
  camera.orthographic = 1.0F;
  const std::vector<float> values = draw(scene, camera, settings(40, 20, 16)).find("color")->values;
  double left = 0.0, right = 0.0;
  for (std::size_t i = 0; i < 800; ++i) (i % 40 < 20 ? left : right) += values[3 * i];
  EXPECT_NEAR(left, 256.0, 0.5);  // samples on the very edge
  EXPECT_NEAR(right, 256.0, 0.5);
}

TEST(PathRenderer, ErrorsNameTheValue) {
  const auto message = [](const std::function<void()>& act) {
    try {
      act();
    } catch (const SettingsError& error) {
      return std::string(error.what());
    }
    return std::string("nothing thrown");
  };
  const auto make = [](const RenderSettings& s) { return make_path_renderer(s, 1); };
  RenderSettings s = settings(4, 4, 0);
  EXPECT_EQ(message([&] { make(s); }), "render.samples = 0 must be in 1..65536");
  s.samples = 65537;
  EXPECT_EQ(message([&] { make(s); }), "render.samples = 65537 must be in 1..65536");
  s.samples = 1;
  s.path.bounces = 65;
  EXPECT_EQ(message([&] { make(s); }), "render.path.bounces = 65 must be in 0..64");
  s.path.bounces = -1;
  EXPECT_EQ(message([&] { make(s); }), "render.path.bounces = -1 must be in 0..64");
  s.path.bounces = 64;
  s.path.filter_radius = 5.0F;
  EXPECT_EQ(message([&] { make(s); }), "render.path.filter_radius = 5.000000 must be in (0, 4] pixels");

  const auto renderer = make(settings(4, 4, 1));
  EXPECT_EQ(message([&] { renderer->render(Camera({}, 4, 4), {}); }), "the path tracer has no scene");
  EXPECT_EQ(message([&] { renderer->update_positions(0, {}); }), "mesh 0 is not one of the scene's 0");
  RenderScene scene = empty_scene();
  scene.meshes = {make_quad(Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0))};
  renderer->set_scene(scene);
  std::vector<Vec3> positions(3, Vec3::Zero());
  EXPECT_EQ(message([&] { renderer->update_positions(0, positions); }),
            "mesh 'quad' has 4 positions; 3 were given");
  positions.assign(4, Vec3(0.0F, std::nanf(""), 0.0F));
  EXPECT_EQ(message([&] { renderer->update_positions(0, positions); }),
            "mesh 'quad' has a position that is not finite");
  scene.meshes[0].triangles[1][2] = 4;
  EXPECT_THROW(renderer->set_scene(scene), SettingsError);
}

TEST(PathRenderer, TellsWhatItsBitsDependOn) {
  const auto renderer = make_path_renderer(settings(4, 4, 1), 1);
  EXPECT_EQ(renderer->name(), "path");
  const std::string before = renderer->description();
  EXPECT_NE(before.find("Embree 3."), std::string::npos);
  renderer->set_scene(busy_scene());
  EXPECT_EQ(renderer->description(), before);
}

}  // namespace path_renderer_test
}  // namespace lagomorph::render
