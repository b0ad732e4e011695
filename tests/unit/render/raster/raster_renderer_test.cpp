#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "render/error.h"
#include "tests/unit/render/raster/shapes.h"

namespace lagomorph::render::raster {
namespace raster_renderer_test {

constexpr float infinity = std::numeric_limits<float>::infinity();

RenderScene lively_scene() {
  RenderScene scene;
  scene.meshes = {sphere(Vec3(0.0F, 0.6F, 0.0F), 0.5F, 24),
                  box(Vec3(0.6F, 0.0F, -0.2F), Vec3(0.9F, 0.5F, 0.3F))};
  scene.lights.resize(2);
  scene.lights[1].position = Vec3(-3.0F, 1.5F, 1.0F);
  return scene;
}

const std::vector<float>& values(const Image& image, const char* channel) {
  return image.find(channel)->values;
}

/// Of the colour and depth, in hexadecimal.
std::string hash(const Image& image) {
  std::uint64_t h = 14695981039346656037ULL;  // FNV-1a
  for (const Channel& c : image.channels()) {
    for (const float v : c.values) {
      std::uint32_t bits = 0;
      std::memcpy(&bits, &v, sizeof bits);
      h = (h ^ bits) * 1099511628211ULL;
    }
  }
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(h));
  return text.data();
}

TEST(RasterRenderer, AnEmptySceneIsItsBackground) {
  RenderScene scene = empty_scene();
  scene.background = Color(0.25F, 0.5F, 2.0F);
  const Image image = draw(scene, three_quarter(), small_settings());
  for (int y = 0; y < 64; y += 7) {
    for (int x = 0; x < 96; x += 7) {
      EXPECT_TRUE((color_at(image, x, y) == *scene.background).all());
      EXPECT_EQ(depth_at(image, x, y), infinity);
    }
  }
}

TEST(RasterRenderer, TheSkyIsSeenAlongEachRay) {
  RenderScene scene = empty_scene();
  scene.background.reset();
  scene.sky = {{0.2F, 0.5F, 1.0F}, {1.0F, 0.8F, 0.3F}, 0.7F};
  CameraSettings settings = three_quarter();
  settings.look_at.y() = 1.5F;
  settings.fov = 90.0F;
  const Image image = draw(scene, settings, small_settings());
  const Camera camera(settings, 96, 64);
  for (int y = 0; y < 64; y += 5) {
    for (int x = 0; x < 96; x += 5) {
      const Vec3 direction = camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F).direction;
      const Color expected = background_radiance(scene, direction);
      EXPECT_LT((color_at(image, x, y) - expected).abs().maxCoeff(), 2e-4F) << x << " " << y;
    }
  }
}

TEST(RasterRenderer, TheGroundFadesIntoTheBackground) {
  RenderScene scene;
  scene.ground.fade_start = 1.0F;
  scene.ground.radius = 3.0F;
  scene.lights.resize(1);
  scene.background = Color(0.1F, 0.2F, 0.9F);
  CameraSettings settings = three_quarter();
  settings.position = Vec3(0.0F, 5.0F, 5.0F);
  const Camera camera(settings, 96, 64);
  const Image faded = draw(scene, settings, small_settings());
  scene.ground.radius = 50.0F;
  scene.ground.fade_start = 49.0F;
  const Image opaque = draw(scene, settings, small_settings());
  scene.ground.radius = 3.0F;
  scene.ground.fade_start = 1.0F;
  for (const float r : {0.0F, 0.9F, 1.3F, 2.0F, 2.6F, 3.2F}) {
    const Vec2 at = camera.project(Vec3(r, 0.0F, 0.0F));
    const int x = static_cast<int>(at.x());
    const int y = static_cast<int>(at.y());
    const Ray ray = camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
    const Vec3 p = ray.origin - ray.origin.y() / ray.direction.y() * ray.direction;
    const float w = ground_fade(scene.ground, p);
    const Color expected = (1.0F - w) * color_at(opaque, x, y) + w * *scene.background;
    EXPECT_LT((color_at(faded, x, y) - expected).abs().maxCoeff(), 2e-3F) << r;
  }
}

TEST(RasterRenderer, WhatIsUnderTheGroundShowsThroughItsFadeOnly) {
  RenderScene scene = empty_scene();
  scene.ground.enabled = true;
  scene.ground.fade_start = 1.0F;
  scene.ground.radius = 3.0F;
  AreaLight light;
  light.position = Vec3(0.0F, 5.0F, 0.1F);
  light.look_at = Vec3::Zero();
  scene.lights = {light};
  scene.background = Color(0.1F, 0.2F, 0.9F);
  Mesh floor = rectangle(Vec3(0.0F, -0.01F, 0.0F), 10.0F * Vec3::UnitZ(), 10.0F * Vec3::UnitX());
  CameraSettings settings;
  settings.position = Vec3(0.0F, 5.0F, 0.1F);
  settings.look_at = Vec3::Zero();
  settings.fov = 80.0F;
  const Camera camera(settings, 96, 64);
  const Image bare = draw(scene, settings, small_settings());
  RenderScene only = scene;
  only.ground.enabled = false;
  only.meshes = {floor};
  const Image alone = draw(only, settings, small_settings());
  scene.meshes = {floor};
  const Image both = draw(scene, settings, small_settings());
  for (const float r : {0.0F, 0.9F, 2.0F, 3.5F}) {
    const Vec3 p(r, 0.0F, 0.0F);
    const Vec2 at = camera.project(p);
    const Ray ray = camera.ray(std::floor(at.x()) + 0.5F, std::floor(at.y()) + 0.5F);
    const float w =
        ground_fade(scene.ground, ray.origin - ray.origin.y() / ray.direction.y() * ray.direction);
    // The same light falls on both, 1 cm apart.
    const Color expected = color_of(bare, camera, p) + w * (color_of(alone, camera, p) - *scene.background);
    EXPECT_LT((color_of(both, camera, p) - expected).abs().maxCoeff(), 0.01F) << r;
  }
}

/// A white disc on black: the sphere's outline, flat white by a sky of one colour all around.
Image outline(int multisample, int supersample = 1, const std::vector<std::string>& channels = {}) {
  RenderScene scene = empty_scene();
  scene.sky = {Color::Ones(), Color::Ones(), 1.0F};
  scene.meshes = {sphere(Vec3::Zero(), 0.5F, 96)};
  scene.meshes[0].material = matte(1.0F);
  CameraSettings camera;
  camera.position = Vec3(0.0F, 0.0F, 2.5F);
  camera.look_at = Vec3::Zero();
  camera.orthographic = 1.25F;
  RenderSettings settings = small_settings(100, 100);
  settings.raster.multisample = multisample;
  settings.raster.supersample = supersample;
  settings.channels = channels;
  return draw(scene, camera, settings);
}

TEST(RasterRenderer, MultisamplingCoversEdgesByQuarters) {
  const Image image = outline(4);
  std::array<int, 5> quarters{};
  double area = 0.0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      const float c = color_at(image, x, y)[0];
      const float k = std::round(4.0F * c);
      EXPECT_NEAR(4.0F * c, k, 0.03F) << x << " " << y;
      ++quarters.at(static_cast<std::size_t>(k));
      area += c;
    }
  }
  for (const int count : quarters) EXPECT_GT(count, 20);
  EXPECT_NEAR(area, pi * 40.0 * 40.0, 0.005 * pi * 40.0 * 40.0);  // 0.5 m are 40 pixels
}

TEST(RasterRenderer, ASingleSampleIsThereOrNot) {
  const Image image = outline(1);
  for (const float c : values(image, "color")) EXPECT_TRUE(c < 0.01F || c > 0.99F) << c;
}

TEST(RasterRenderer, SupersamplingCoversEdgesMoreFinely) {
  const Image image = outline(4, 2, {"depth", "alpha"});
  EXPECT_EQ(image.width(), 100);
  double area = 0.0;
  int between_quarters = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      const float c = color_at(image, x, y)[0];
      EXPECT_NEAR(16.0F * c, std::round(16.0F * c), 0.1F) << x << " " << y;
      between_quarters += std::abs(4.0F * c - std::round(4.0F * c)) > 0.1F ? 1 : 0;
      area += c;
    }
  }
  EXPECT_GT(between_quarters, 60);
  EXPECT_NEAR(area, pi * 40.0 * 40.0, 0.002 * pi * 40.0 * 40.0);
  EXPECT_EQ(values(image, "depth"), values(outline(4, 1, {"depth"}), "depth")) << "of the pixels' centres";
  const std::vector<float>&alpha = values(image, "alpha"), &color = values(image, "color");
  for (std::size_t k = 0; k < alpha.size(); ++k) EXPECT_NEAR(alpha[k], color[3 * k], 0.01F);
}

TEST(RasterRenderer, ABodyBeforeAnotherKeepsBothColoursAtItsEdge) {
  // A near box before a far plane of another colour; in a pixel of the edge both are mixed by quarters.
  RenderScene scene = empty_scene();
  scene.sky = {Color::Ones(), Color::Ones(), 1.0F};
  scene.meshes = {rectangle(Vec3(0.0F, 0.0F, -1.0F), 5.0F * Vec3::UnitX(), 5.0F * Vec3::UnitY()),
                  rectangle(Vec3(0.013F, 0.0F, 0.0F), 0.2F * Vec3::UnitX(), 0.2F * Vec3::UnitY())};
  scene.meshes[0].material.base_color = Color(1.0F, 0.0F, 0.0F);
  scene.meshes[1].material.base_color = Color(0.0F, 1.0F, 0.0F);
  CameraSettings camera;
  camera.position = Vec3(0.0F, 0.0F, 3.0F);
  camera.look_at = Vec3(0.1F, 0.05F, 0.0F);
  camera.fov = 20.0F;
  RenderSettings settings = small_settings();
  const Image image = draw(scene, camera, settings);
  int mixed = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 96; ++x) {
      const Color c = color_at(image, x, y);
      EXPECT_LT(c[2], 1e-4F);
      if (c[0] > 0.1F && c[1] > 0.1F) ++mixed;
    }
  }
  EXPECT_GT(mixed, 30);
}

/// Pixels of one surface are lit by a shader of their own; where vertices have colours there is none.
TEST(RasterRenderer, PixelsOfOneSurfaceAreLitAsThoseOfMore) {
  const RenderSettings settings = small_settings(192, 128);
  RenderScene scene = lively_scene();
  const Image plain = draw(scene, three_quarter(), settings);
  for (Mesh& mesh : scene.meshes) mesh.colors.assign(mesh.positions.size(), mesh.material.base_color);
  const Image layers = draw(scene, three_quarter(), settings);
  const std::vector<float>&a = values(plain, "color"), &b = values(layers, "color");
  ASSERT_EQ(a.size(), b.size());
  // But for those at edges that samples cover in part: there the points are not the same.
  std::size_t apart = 0;
  for (std::size_t i = 0; i < a.size(); i += 3) {
    float most = 0.0F;
    for (std::size_t c = i; c < i + 3; ++c) most = std::max(most, std::abs(a[c] - b[c]));
    EXPECT_LT(most, 0.03F);
    apart += most > 1e-3F ? 1 : 0;
  }
  EXPECT_LT(apart, 80U);
}

/// Whatever cells and blocks a part of the picture has of its own; the lamp is seen as parts, and the edge of
/// its shadow goes through the borders.
TEST(RasterRenderer, ARegionIsTheWholePictures) {
  const RenderSettings settings = small_settings(192, 128);
  RenderScene scene = lively_scene();
  scene.lights[0].position = Vec3(0.3F, 2.0F, 0.5F);
  scene.lights[0].size = Vec2(1.5F, 1.5F);
  scene.sky = {Color::Ones(), Color::Ones(), 0.3F};
  const auto renderer = make_raster_renderer(settings, 2);
  renderer->set_scene(scene);
  const Camera camera(three_quarter(), settings.width, settings.height);
  const Image whole = renderer->render(camera, {});
  for (int k = 0; k < 24; ++k) {
    const PixelRegion region{8 + 3 * k, 20 + 2 * k, 75 + 4 * k, 70 + 2 * k};
    const Image part = renderer->render(camera, {.region = region});
    int unlike = 0;
    for (int y = region.y0; y < region.y1; ++y) {
      for (int x = region.x0; x < region.x1; ++x)
        unlike += (color_at(part, x, y) == color_at(whole, x, y)).all() ? 0 : 1;
    }
    EXPECT_EQ(unlike, 0) << k;
  }
}

TEST(RasterRenderer, DrawsTheSameBytesEachTime) {
  const RenderSettings settings = small_settings();
  const Camera camera(three_quarter(), settings.width, settings.height);
  RenderScene scene = lively_scene();
  const auto renderer = make_raster_renderer(settings, 2);
  renderer->set_scene(scene);
  const std::string first = hash(renderer->render(camera, {}));
  EXPECT_EQ(hash(renderer->render(camera, {7, 0.25})), first);
  // There and back again, and through another size.
  std::vector<Vec3> moved = scene.meshes[0].positions;
  for (Vec3& p : moved) p.x() += 0.3F;
  renderer->update_positions(0, moved);
  const std::string second = hash(renderer->render(camera, {}));
  EXPECT_NE(second, first);
  renderer->render(Camera(three_quarter(), 50, 70), {});
  renderer->update_positions(0, scene.meshes[0].positions);
  EXPECT_EQ(hash(renderer->render(camera, {})), first);
  // Another renderer that begins with the moved mesh.
  scene.meshes[0].positions = moved;
  EXPECT_EQ(hash(draw(scene, three_quarter(), settings)), second);
}

TEST(RasterRenderer, ACameraThatMovesSeesWhatAnotherRendererWould) {
  const RenderSettings settings = small_settings();
  const auto renderer = make_raster_renderer(settings, 2);
  renderer->set_scene(lively_scene());
  CameraSettings camera = three_quarter();
  for (int i = 0; i < 3; ++i) {
    camera.position.x() += 0.1F * static_cast<float>(i % 2);
    camera.fov += static_cast<float>(i / 2);
    EXPECT_EQ(hash(renderer->render(Camera(camera, settings.width, settings.height), {})),
              hash(draw(lively_scene(), camera, settings)))
        << i;
  }
}

TEST(RasterRenderer, ASceneAfterAnotherLeavesNoTrace) {
  const RenderSettings settings = small_settings();
  const Camera camera(three_quarter(), settings.width, settings.height);
  const auto renderer = make_raster_renderer(settings, 2);
  renderer->set_scene(lively_scene());
  renderer->render(camera, {});
  RenderScene other = empty_scene();
  other.meshes = {sphere(Vec3::Zero(), 0.5F, 12)};
  other.lights.resize(1);
  renderer->set_scene(other);
  EXPECT_EQ(hash(renderer->render(camera, {})), hash(draw(other, three_quarter(), settings)));
}

TEST(RasterRenderer, TwoAtOnceDoNotMindEachOther) {
  const RenderSettings settings = small_settings();
  const Camera camera(three_quarter(), settings.width, settings.height);
  const std::string expected = hash(draw(lively_scene(), three_quarter(), settings));
  const auto a = make_raster_renderer(settings, 2);
  const auto b = make_raster_renderer(settings, 2);
  a->set_scene(lively_scene());
  b->set_scene(empty_scene());
  const std::string of_b = hash(b->render(camera, {}));
  EXPECT_EQ(hash(a->render(camera, {})), expected);
  EXPECT_EQ(hash(b->render(camera, {})), of_b);
}

TEST(RasterRenderer, ServesAnotherThread) {
  const std::string expected = hash(draw(lively_scene(), three_quarter(), small_settings()));
  std::string found;
  std::thread([&] { found = hash(draw(lively_scene(), three_quarter(), small_settings())); }).join();
  EXPECT_EQ(found, expected);
}

/// What the next test runs in processes of their own, since Mesa counts its threads once a process.
TEST(RasterThreads, OnePictureForTheComparison) {
  RenderScene scene = lively_scene();
  scene.lights[1].size = Vec2(4.0F, 4.0F);  // it is split, and reaches below the ground
  std::printf("picture %s\n", hash(draw(scene, three_quarter(), small_settings(320, 200))).c_str());
}

TEST(RasterThreads, DrawTheSameBytesWhateverTheirNumber) {
  const auto run = [](const std::string& threads) {
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    const std::string command = "unset GTEST_TOTAL_SHARDS GTEST_SHARD_INDEX; LP_NUM_THREADS=" + threads +
                                " '" + program + "' --gtest_filter=RasterThreads.OnePictureForTheComparison";
    std::string output;
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::array<char, 256> line{};
    while (pipe && std::fgets(line.data(), static_cast<int>(line.size()), pipe.get())) {
      if (std::strncmp(line.data(), "picture ", 8) == 0) output = line.data();
    }
    return output;
  };
  const std::string one = run("1");
  EXPECT_EQ(one.size(), std::strlen("picture 0123456789abcdef\n"));
  EXPECT_EQ(run("0"), one);
  EXPECT_EQ(run("2"), one);
  EXPECT_EQ(run("5"), one);
}

TEST(RasterRenderer, SaysWhatDrew) {
  const auto renderer = make_raster_renderer(small_settings(), 2);
  EXPECT_EQ(renderer->name(), "raster");
  const std::string text = renderer->description();
  for (const char* part : {"OSMesa", "llvmpipe", "LLVM", "Mesa 2"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

void expect_error(const char* part, const std::function<void()>& action) {
  try {
    action();
    ADD_FAILURE() << "no error about " << part;
  } catch (const SettingsError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

TEST(RasterRenderer, RefusesSettingsOutOfRange) {
  const auto with = [](auto&& change) {
    return [=] {
      RenderSettings settings = small_settings();
      change(settings.raster);
      make_raster_renderer(settings, 2);
    };
  };
  expect_error("multisample = 2", with([](RasterSettings& s) { s.multisample = 2; }));
  expect_error("multisample = 8", with([](RasterSettings& s) { s.multisample = 8; }));
  expect_error("supersample = 5", with([](RasterSettings& s) { s.supersample = 5; }));
  expect_error("shadow_map = 1000", with([](RasterSettings& s) { s.shadow_map = 1000; }));
  expect_error("shadow_map = 128", with([](RasterSettings& s) { s.shadow_map = 128; }));
  expect_error("shadow_samples = 0", with([](RasterSettings& s) { s.shadow_samples = 0; }));
  expect_error("shadow_samples = 65", with([](RasterSettings& s) { s.shadow_samples = 65; }));
}

TEST(RasterRenderer, RefusesWhatDoesNotFitTheScene) {
  const auto renderer = make_raster_renderer(small_settings(), 2);
  RenderScene scene = lively_scene();
  renderer->set_scene(scene);
  std::vector<Vec3> positions = scene.meshes[0].positions;
  expect_error("mesh 2", [&] { renderer->update_positions(2, positions); });
  expect_error("mesh -1", [&] { renderer->update_positions(-1, positions); });
  positions[5].z() = infinity;
  expect_error("finite", [&] { renderer->update_positions(0, positions); });
  positions.pop_back();
  expect_error("positions", [&] { renderer->update_positions(0, positions); });
  scene = lively_scene();
  scene.meshes[0].triangles[0][0] = 1000000;
  expect_error("triangle 0", [&] { renderer->set_scene(scene); });
}

}  // namespace raster_renderer_test
}  // namespace lagomorph::render::raster
