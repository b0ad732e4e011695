#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "render/channels.h"
#include "render/error.h"
#include "render/renderer.h"
#include "tests/unit/render/path/shapes.h"

/// Surfaces that are not opaque, in both back ends.
namespace lagomorph::render {
namespace see_through_test {

constexpr int width = 96, height = 72;

CameraSettings camera_of_test() {
  CameraSettings c;
  c.position = Vec3(0.9F, 0.9F, 2.6F);
  c.look_at = Vec3(0, 0.45F, 0);
  return c;
}

struct Drawn {
  std::string backend;
  int samples = 1, bounces = 0, multisample = 4;
  bool transparent = false;
  std::vector<std::string> channels = {};
};

Image draw(const Drawn& how, const RenderScene& scene, const CameraSettings& camera = camera_of_test()) {
  RenderSettings s;
  s.backend = how.backend;
  s.width = width;
  s.height = height;
  s.samples = how.samples;
  s.transparent = how.transparent;
  s.channels = how.channels;
  s.path.bounces = how.bounces;
  s.path.filter = "box";
  s.path.filter_radius = 0.5F;
  s.raster.multisample = how.multisample;
  const auto renderer = make_renderer(s, 2);
  renderer->set_scene(scene);
  return renderer->render(Camera(camera, width, height), {});
}

const std::vector<float>& light_of(const Image& image) { return image.find(color_channel)->values; }
double middle(const std::vector<float>& values, std::size_t components) {
  return static_cast<double>(values[components * (height / 2 * width + width / 2)]);
}

/// Black sheets across the view before a white background, the nearest first.
RenderScene sheets(const std::vector<float>& opacities) {
  RenderScene scene;
  scene.ground.enabled = false;
  scene.sky.strength = 0.0F;
  scene.background = Color::Ones();
  for (std::size_t i = 0; i < opacities.size(); ++i) {
    Mesh sheet = make_quad(Vec3(-2, -2, -static_cast<float>(i)), Vec3(4, 0, 0), Vec3(0, 4, 0));
    sheet.material = {Color::Zero(), 1.0F, 0.0F, 1.0F};
    sheet.material.opacity = opacities[i];
    sheet.body_id = static_cast<int>(i);
    scene.meshes.push_back(sheet);
  }
  return scene;
}

CameraSettings from_front() {
  CameraSettings c;
  c.position = Vec3(0.1F, 0.2F, 3);
  c.look_at = Vec3::Zero();
  return c;
}

TEST(SeeThrough, SheetsMultiply) {
  const RenderScene scene = sheets({0.25F, 0.5F, 0.4F});
  const double left = 0.75 * 0.5 * 0.6;
  for (const int multisample : {1, 4}) {
    const Image raster = draw({.backend = "raster", .multisample = multisample}, scene, from_front());
    EXPECT_NEAR(middle(light_of(raster), 3), left, 1e-4);
  }
  // Each pixel's mean of 1024 yes or no: 0.013 around the truth, 4 times less over 16 pixels.
  const Image path = draw({.backend = "path", .samples = 1024}, scene, from_front());
  double mean = 0.0;
  for (int k = 0; k < 16; ++k)
    mean +=
        static_cast<double>(light_of(path)[static_cast<std::size_t>(3 * ((20 + k) * width + 30 + k))]) / 16.0;
  EXPECT_NEAR(mean, left, 0.01);
}

TEST(SeeThrough, AlphaIsWhatIsThere) {
  const RenderScene scene = sheets({0.25F, 0.5F});
  const double there = 1.0 - 0.75 * 0.5;
  const Image raster = draw({.backend = "raster", .transparent = true}, scene, from_front());
  EXPECT_NEAR(middle(raster.find(alpha_channel)->values, 1), there, 1e-4);
  const Image path = draw({.backend = "path", .samples = 1024, .transparent = true}, scene, from_front());
  EXPECT_NEAR(middle(path.find(alpha_channel)->values, 1), there, 0.05);
}

/// As of an opaque one in its place.
TEST(SeeThrough, ChannelsOfOneRayAreOfTheFirstSurface) {
  RenderScene scene = sheets({1.0F, 1.0F}), glass = scene;
  glass.meshes[0].material.opacity = 0.25F;
  RenderScene jelly = scene;
  jelly.meshes[0].material.transmission = 1.0F;
  const std::vector<std::string> channels = {depth_channel, normal_channel, position_channel, body_id_channel,
                                             triangle_id_channel};
  for (const char* backend : {"raster", "path"}) {
    const Drawn how = {.backend = backend, .channels = channels};
    const Image solid = draw(how, scene, from_front());
    EXPECT_EQ(middle(solid.find(body_id_channel)->values, 1), 0.0);
    for (const RenderScene* other : {&glass, &jelly}) {
      const Image first = draw(how, *other, from_front());
      for (const std::string& channel : channels)
        EXPECT_EQ(first.find(channel)->values, solid.find(channel)->values) << backend << channel;
    }
  }
}

/// A floor under a sheet that the sun shines through.
TEST(SeeThrough, ShadowsAreOfWhatIsThere) {
  RenderScene scene = sheets({0.3F, 0.6F});
  scene.background = Color::Zero();
  scene.meshes[0] = make_quad(Vec3(-1, 1, -1), Vec3(0, 0, 2), Vec3(2, 0, 0));
  scene.meshes[0].material.opacity = 0.3F;
  scene.meshes[1] = make_quad(Vec3(-1, 1.5F, -1), Vec3(0, 0, 2), Vec3(2, 0, 0));
  scene.meshes[1].material.opacity = 0.6F;
  scene.meshes[1].body_id = 1;
  scene.meshes.push_back(make_quad(Vec3(-3, 0, -3), Vec3(0, 0, 6), Vec3(6, 0, 0)));
  scene.meshes[2].material = {Color::Constant(0.5F), 1.0F, 0.0F, 1.0F};
  scene.suns.resize(1);
  scene.suns[0].direction = Vec3(0, -1, 0);
  CameraSettings camera;
  camera.position = Vec3(0, 0.6F, 1.4F);
  camera.look_at = Vec3(0, 0, 0);
  RenderScene open = scene;
  open.meshes = {scene.meshes[2]};
  for (const char* backend : {"raster", "path"}) {
    const Image lit = draw({.backend = backend, .samples = 64}, open, camera);
    const Image shadowed = draw({.backend = backend, .samples = 64}, scene, camera);
    double a = 0.0, b = 0.0;
    for (int y = height / 2 - 8; y < height / 2 + 8; ++y) {
      for (int x = width / 2 - 8; x < width / 2 + 8; ++x) {
        a += static_cast<double>(light_of(lit)[static_cast<std::size_t>(3 * (y * width + x))]);
        b += static_cast<double>(light_of(shadowed)[static_cast<std::size_t>(3 * (y * width + x))]);
      }
    }
    EXPECT_NEAR(b / a, 0.7 * 0.4, backend == std::string("path") ? 1e-3 : 0.01) << backend;
  }
}

TEST(SeeThrough, WhatIsNotThereIsNotSeen) {
  RenderScene scene;
  scene.meshes = {make_sphere(3, 0.2F, Vec3(0, 0.2F, 0)), make_sphere(3, 0.5F, Vec3(0, 0.5F, 0))};
  scene.lights.resize(1);
  const Image without = [&] {
    RenderScene alone = scene;
    alone.meshes.pop_back();
    return draw({.backend = "path", .samples = 4, .bounces = 2}, alone);
  }();
  scene.meshes[1].material.opacity = 0.0F;
  const Image with = draw({.backend = "path", .samples = 4, .bounces = 2}, scene);
  double apart = 0.0, light = 0.0;
  for (std::size_t i = 0; i < light_of(with).size(); ++i) {
    apart += std::abs(static_cast<double>(light_of(with)[i] - light_of(without)[i]));
    light += static_cast<double>(light_of(without)[i]);
  }
  EXPECT_LT(apart, 1e-4 * light);
}

/// A see-through sphere in another one, with a solid box beside, that the outer one covers in part.
RenderScene nested() {
  RenderScene scene;
  scene.meshes = {make_sphere(4, 0.45F, Vec3(0, 0.47F, 0)), make_sphere(3, 0.22F, Vec3(0.05F, 0.45F, 0)),
                  make_box(Vec3(-0.9F, 0, -0.6F), Vec3(-0.2F, 0.6F, -0.5F))};
  scene.meshes[0].material.base_color = Color(0.2F, 0.4F, 0.8F);
  scene.meshes[0].material.opacity = 0.35F;
  scene.meshes[1].material.base_color = Color(0.8F, 0.3F, 0.1F);
  scene.meshes[1].material.opacity = 0.7F;
  for (int i = 0; i < 3; ++i) scene.meshes[static_cast<std::size_t>(i)].body_id = i;
  scene.ground.radius = 4.0F;
  scene.ground.fade_start = 1.0F;
  scene.lights.resize(1);
  return scene;
}

TEST(SeeThrough, TheOrderOfMeshesChangesNoByteOfTheRasterPicture) {
  RenderScene scene = nested();
  const Image before = draw({.backend = "raster", .transparent = true}, scene);
  std::swap(scene.meshes[0], scene.meshes[1]);
  const Image swapped = draw({.backend = "raster", .transparent = true}, scene);
  EXPECT_EQ(light_of(before), light_of(swapped));
  EXPECT_EQ(before.find(alpha_channel)->values, swapped.find(alpha_channel)->values);
}

TEST(SeeThrough, BackEndsAgree) {
  for (const bool colored : {false, true}) {
    RenderScene scene = nested();
    if (colored) scene.meshes[1].colors.assign(scene.meshes[1].positions.size(), Color(0.1F, 0.7F, 0.2F));
    const Image raster = draw({.backend = "raster", .transparent = true}, scene);
    const Image path = draw({.backend = "path", .samples = 256, .bounces = 4, .transparent = true}, scene);
    double apart = 0.0, bias = 0.0, light = 0.0, alpha = 0.0;
    const std::vector<float>&a = light_of(raster), &b = light_of(path);
    for (std::size_t i = 0; i < a.size(); ++i) {
      apart += std::abs(static_cast<double>(a[i] - b[i]));
      bias += static_cast<double>(a[i] - b[i]);
      light += static_cast<double>(b[i]);
      alpha += std::abs(static_cast<double>(raster.find(alpha_channel)->values[i / 3] -
                                            path.find(alpha_channel)->values[i / 3])) /
               3.0;
    }
    EXPECT_LT(apart / light, 0.03) << colored;
    EXPECT_LT(std::abs(bias) / light, 0.01) << colored;
    EXPECT_LT(alpha / (width * height), 0.002) << colored;
  }
}

TEST(SeeThrough, OpacityHasARange) {
  RenderScene scene = nested();
  scene.meshes[0].material.opacity = 1.5F;
  EXPECT_THROW(check_scene(scene), SettingsError);
}

}  // namespace see_through_test
}  // namespace lagomorph::render
