#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "render/channels.h"
#include "render/renderer.h"
#include "tests/unit/render/path/shapes.h"

/// Both back ends draw one scene: the same surfaces in the same pixels, with the same data, in the same
/// light.
namespace lagomorph::render {
namespace agreement_test {

constexpr int width = 160, height = 120;

/// A smooth and a coloured sphere and a box with flat sides on the ground, which fades behind them.
RenderScene scene_of_test() {
  RenderScene scene;
  scene.meshes = {make_sphere(3, 0.5F, Vec3(-0.5F, 0.6F, 0)),
                  make_box(Vec3(0.3F, 0, -0.6F), Vec3(0.9F, 0.8F, 0)),
                  make_sphere(2, 0.25F, Vec3(0.35F, 0.3F, 0.6F))};
  for (int i = 0; i < 3; ++i) scene.meshes[static_cast<std::size_t>(i)].body_id = i;
  scene.meshes[0].material.base_color = Color(0.7F, 0.3F, 0.2F);
  scene.meshes[1].material.metallic = 1.0F;
  scene.meshes[1].material.base_color = Color(0.9F, 0.8F, 0.4F);
  for (const Vec3& p : scene.meshes[2].positions)
    scene.meshes[2].colors.push_back(
        Color(0.5F + p.x() - 0.35F, 0.5F + p.y() - 0.3F, 0.5F).max(0.0F).min(1.0F));
  scene.ground.radius = 4.0F;
  scene.ground.fade_start = 1.0F;
  scene.lights.resize(1);
  return scene;
}

CameraSettings camera_of_test(bool orthographic) {
  CameraSettings c;
  c.position = Vec3(0.8F, 1.5F, 3.0F);
  c.look_at = Vec3(0, 0.4F, 0);
  if (orthographic) c.orthographic = 2.2F;
  return c;
}

/// Where the meshes are in the frame before: each elsewhere, the second turned.
std::vector<Vec3> before(const Mesh& mesh, int number) {
  std::vector<Vec3> x = mesh.positions;
  const Eigen::AngleAxisf turn(0.1F * static_cast<float>(number), Vec3::UnitY());
  for (Vec3& p : x) p = turn * p + Vec3(0.03F, -0.02F, 0.01F) * static_cast<float>(number + 1);
  return x;
}

Image draw(const std::string& backend, const RenderScene& scene, const CameraSettings& settings,
           const std::vector<std::string>& channels, bool moving = true, int samples = 1, int bounces = 0) {
  RenderSettings s;
  s.backend = backend;
  s.width = width;
  s.height = height;
  s.samples = samples;
  s.path.bounces = bounces;
  s.path.filter = "box";
  s.path.filter_radius = 0.5F;
  s.channels = channels;
  const auto renderer = make_renderer(s, 2);
  renderer->set_scene(scene);
  for (std::size_t i = 0; moving && i < scene.meshes.size(); ++i) {
    renderer->update_positions(static_cast<int>(i), scene.meshes[i].positions);
    renderer->set_previous(static_cast<int>(i), before(scene.meshes[i], static_cast<int>(i)));
  }
  CameraSettings elsewhere = settings;
  elsewhere.position += Vec3(0.05F, 0.02F, 0);
  const Camera camera(settings, width, height), camera_before(elsewhere, width, height);
  return renderer->render(camera,
                          {.frame = 1, .time = 0.1, .camera_before = moving ? &camera_before : nullptr});
}

const std::vector<std::string> data = {depth_channel,  normal_channel,  albedo_channel,     position_channel,
                                       motion_channel, body_id_channel, triangle_id_channel};

struct Pair {
  Image raster, path;

  static float value(const Image& image, const char* channel, std::size_t i) {
    return image.find(channel)->values[i];
  }
  static Vec3 vector(const Image& image, const char* channel, std::size_t pixel) {
    const float* v = image.find(channel)->values.data() + 3 * pixel;
    return {v[0], v[1], v[2]};
  }
  /// Of body and triangle.
  static bool same_ids(const Image& a, std::size_t i, const Image& b, std::size_t j) {
    return value(a, body_id_channel, i) == value(b, body_id_channel, j) &&
           value(a, triangle_id_channel, i) == value(b, triangle_id_channel, j) &&
           std::isinf(value(a, depth_channel, i)) == std::isinf(value(b, depth_channel, j));
  }
  /// Whether what one sees at (x, y) the other sees within a pixel of it.
  static bool is_near(const Image& a, const Image& b, int x, int y) {
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j) {
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i) {
        if (same_ids(a, static_cast<std::size_t>(y * width + x), b, static_cast<std::size_t>(j * width + i)))
          return true;
      }
    }
    return false;
  }
};

/// The furthest that data of the same surfaces lie apart.
struct Apart {
  float depth = 0, normal = 0, albedo = 0, position = 0, motion = 0;
  int elsewhere = 0;  // pixels that see another surface
};

Apart compare(const Pair& pair, float pixel) {
  Apart apart;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(y * width + x);
      if (!Pair::same_ids(pair.raster, i, pair.path, i)) {
        ++apart.elsewhere;
        EXPECT_TRUE(Pair::is_near(pair.raster, pair.path, x, y) &&
                    Pair::is_near(pair.path, pair.raster, x, y))
            << x << ", " << y;
        continue;
      }
      if (std::isinf(Pair::value(pair.raster, depth_channel, i))) {
        for (const char* channel : {normal_channel, albedo_channel, position_channel}) {
          EXPECT_EQ(Pair::vector(pair.raster, channel, i), Vec3::Zero()) << channel;
          EXPECT_EQ(Pair::vector(pair.path, channel, i), Vec3::Zero()) << channel;
        }
        continue;
      }
      const auto distance = [&](const char* channel) {
        return (Pair::vector(pair.raster, channel, i) - Pair::vector(pair.path, channel, i)).norm();
      };
      const float depth = Pair::value(pair.path, depth_channel, i);
      // Seen edge-on, a step of the rasterizer's grid along the picture is a long way on the surface.
      const float slope = std::max(
          0.05F, -Pair::vector(pair.path, normal_channel, i).dot(Vec3(-0.8F, -1.1F, -3.0F).normalized()));
      apart.depth =
          std::max(apart.depth, std::abs(depth - Pair::value(pair.raster, depth_channel, i)) * slope / pixel);
      apart.position = std::max(apart.position, distance(position_channel) * slope / pixel);
      apart.normal = std::max(apart.normal, distance(normal_channel));
      apart.albedo = std::max(apart.albedo, distance(albedo_channel));
      for (std::size_t k = 2 * i; k < 2 * i + 2; ++k) {
        apart.motion = std::max(apart.motion, std::abs(Pair::value(pair.raster, motion_channel, k) -
                                                       Pair::value(pair.path, motion_channel, k)));
      }
    }
  }
  return apart;
}

TEST(BackEndsAgree, OnWhatIsSeenThroughEachPixel) {
  for (const bool orthographic : {false, true}) {
    const CameraSettings settings = camera_of_test(orthographic);
    const Pair pair{draw("raster", scene_of_test(), settings, data),
                    draw("path", scene_of_test(), settings, data)};
    const float pixel = Camera(settings, width, height).pixel_size(3.3F);
    const Apart apart = compare(pair, pixel);
    EXPECT_LE(apart.elsewhere, width * height / 2000);
    EXPECT_LT(apart.depth, 0.001F);  // pixels
    EXPECT_LT(apart.position, 0.001F);
    EXPECT_LT(apart.normal, 1e-4F);
    EXPECT_LT(apart.albedo, 1e-4F);
    EXPECT_LT(apart.motion, 0.002F);  // pixels
  }
}

TEST(BackEndsAgree, ThatWhatStandsStillHasNoMotion) {
  for (const char* backend : {"raster", "path"}) {
    const Image image = draw(backend, scene_of_test(), camera_of_test(false), {motion_channel}, false);
    for (const float v : image.find(motion_channel)->values) ASSERT_EQ(v, 0.0F) << backend;
  }
}

TEST(BackEndsAgree, OnMotionFromTheFrameBefore) {
  RenderScene scene;
  scene.ground.enabled = false;
  scene.meshes = {make_quad(Vec3(-1, -1, 0), Vec3(2, 0, 0), Vec3(0, 2, 0))};
  CameraSettings camera;
  camera.position = Vec3(0, 0, 4);
  camera.look_at = Vec3::Zero();
  camera.orthographic = 3.0F;  // 40 pixels a metre
  for (const char* backend : {"raster", "path"}) {
    RenderSettings s;
    s.backend = backend;
    s.width = width;
    s.height = height;
    s.samples = 1;
    s.channels = {motion_channel};
    const auto renderer = make_renderer(s, 1);
    renderer->set_scene(scene);
    std::vector<Vec3> old = scene.meshes[0].positions;
    for (Vec3& p : old) p += Vec3(-0.1F, -0.05F, 0);  // it goes right and up
    renderer->set_previous(0, old);
    const Image moved = renderer->render(Camera(camera, width, height), {});
    const float* motion = moved.find(motion_channel)->values.data() + 2 * (height / 2 * width + width / 2);
    EXPECT_NEAR(motion[0], 4.0F, 1e-3F) << backend;
    EXPECT_NEAR(motion[1], 2.0F, 1e-3F) << backend;
    EXPECT_EQ(moved.find(motion_channel)->values[0], 0.0F);  // nothing is there
    renderer->update_positions(0, scene.meshes[0].positions);
    const Image still = renderer->render(Camera(camera, width, height), {});
    for (const float v : still.find(motion_channel)->values) ASSERT_EQ(v, 0.0F) << backend;
  }
}

TEST(BackEndsAgree, OnCoverage) {
  const std::vector<std::string> channels = {alpha_channel, body_id_channel, depth_channel,
                                             triangle_id_channel};
  RenderScene scene = scene_of_test();
  scene.lights[0].visible = true;
  scene.lights[0].position = Vec3(-1.5F, 1.2F, -1.0F);
  scene.lights[0].look_at = Vec3(0.8F, 1.5F, 3.0F);
  scene.lights[0].size = Vec2(0.5F, 0.5F);
  for (const float eye : {1.5F, -0.7F}) {  // also from below, through the ground's fading edge
    CameraSettings camera = camera_of_test(false);
    camera.position.y() = eye;
    const Image raster = draw("raster", scene, camera, channels, false);
    const Image path = draw("path", scene, camera, channels, false, 64);
    const std::vector<float>&a = raster.find(alpha_channel)->values, &b = path.find(alpha_channel)->values;
    double sum = 0.0, bias = 0.0;
    float most = 0.0F;
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_TRUE(a[i] >= 0.0F && a[i] <= 1.0F && b[i] >= 0.0F && b[i] <= 1.0F);
      sum += static_cast<double>(std::abs(a[i] - b[i]));
      bias += static_cast<double>(a[i] - b[i]);
      most = std::max(most, std::abs(a[i] - b[i]));
    }
    EXPECT_LT(sum / static_cast<double>(a.size()), 0.0015);
    EXPECT_LT(std::abs(bias) / static_cast<double>(a.size()), 2e-4);
    EXPECT_LT(most, 0.35F);  // 4 samples a pixel against 64
    EXPECT_EQ(*std::min_element(a.begin(), a.end()), 0.0F);
    EXPECT_EQ(*std::max_element(a.begin(), a.end()), 1.0F);
  }
}

/// Matte things alone, lit directly.
RenderScene matte_scene() {
  RenderScene scene;
  scene.ground.enabled = false;  // the rasterizer knows of the light that it sends up
  scene.sky.strength = 0.0F;
  scene.background = Color::Zero();
  scene.meshes = {make_sphere(3, 0.5F, Vec3(-0.4F, 0.6F, 0)), make_box(Vec3(-3, -0.1F, -3), Vec3(3, 0, 3))};
  for (Mesh& mesh : scene.meshes) {
    mesh.material.ior = 1.0F;  // no coat
    mesh.material.roughness = 1.0F;
    mesh.material.base_color = Color(0.6F, 0.5F, 0.4F);
  }
  return scene;
}

/// Mean of |raster - path| over the mean of the path tracer's light, and the same of the difference.
std::array<double, 2> light_apart(const RenderScene& scene, int bounces = 0) {
  const CameraSettings camera = camera_of_test(false);
  const Image raster = draw("raster", scene, camera, {}, false),
              path = draw("path", scene, camera, {}, false, 256, bounces);
  const std::vector<float>&a = raster.find(color_channel)->values, &b = path.find(color_channel)->values;
  double sum = 0.0, bias = 0.0, light = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
    bias += static_cast<double>(a[i]) - static_cast<double>(b[i]);
    light += static_cast<double>(b[i]);
  }
  return {sum / light, bias / light};
}

TEST(BackEndsAgree, OnDirectLightOfARectangle) {
  RenderScene scene = matte_scene();
  scene.lights.resize(1);
  const auto [apart, bias] = light_apart(scene);
  EXPECT_LT(apart, 0.009);
  EXPECT_LT(std::abs(bias), 0.002);
}

/// Lights up to as wide as they are far, which bodies hide in parts that no one point of a light tells, over
/// a floor that goes on beneath and behind them.
TEST(BackEndsAgree, OnTheShadowsOfNearLights) {
  for (const float size : {0.6F, 1.0F, 2.0F}) {
    RenderScene scene = matte_scene();
    scene.lights.resize(1);
    scene.lights[0].position = Vec3(0.9F, 1.5F, 0.7F);
    scene.lights[0].look_at = Vec3(-0.4F, 0.5F, 0);
    scene.lights[0].size = Vec2(size, size);
    const auto [apart, bias] = light_apart(scene);
    EXPECT_LT(apart, size < 1.0F ? 0.012 : 0.008) << size;  // 0.05 where they are missing
    EXPECT_LT(std::abs(bias), 0.003) << size;
  }
}

TEST(BackEndsAgree, OnDirectLightOfASun) {
  for (const float angle : {3.0F, 8.0F, 20.0F}) {  // as one, in 9 and in 36 parts
    RenderScene scene = matte_scene();
    scene.suns.resize(1);
    scene.suns[0].angle = angle;
    const auto [apart, bias] = light_apart(scene);
    EXPECT_LT(apart, 0.004) << angle;  // 0.008 of 20 degrees with one map
    EXPECT_LT(std::abs(bias), 0.001) << angle;
  }
}

/// Dim blue above, brown below, and a bright patch of 40 x 30 degrees at one side, which the rotation turns.
Sky one_sided_sky(float rotation) {
  constexpr int columns = 128, rows = 64;
  std::vector<Color> texels;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const bool patch = std::abs(x - 96) < 7 && std::abs(y - 20) < 5;
      texels.push_back(patch          ? Color(16.0F, 13.0F, 9.0F)
                       : y < rows / 2 ? Color(0.25F, 0.35F, 0.6F)
                                      : Color(0.3F, 0.2F, 0.1F));
    }
  }
  Sky sky;
  sky.strength = 1.0F;
  sky.map = std::make_shared<const SkyMap>(columns, rows, std::move(texels), rotation);
  return sky;
}

/// A sphere under that sky.
RenderScene sphere_under_sky(float metallic, float roughness) {
  RenderScene scene;
  scene.ground.enabled = false;
  scene.sky = one_sided_sky(0.0F);
  scene.meshes = {make_sphere(4, 0.6F, Vec3(0, 0.4F, 0))};
  scene.meshes[0].material = {Color(0.7F, 0.6F, 0.5F), roughness, metallic, metallic > 0.0F ? 1.5F : 1.0F};
  return scene;
}

TEST(BackEndsAgree, OnTheLightOfASkyMap) {
  // The background, which is the map itself, counts as well.
  const auto [matte, matte_bias] = light_apart(sphere_under_sky(0.0F, 1.0F));
  EXPECT_LT(matte, 0.006);
  EXPECT_LT(std::abs(matte_bias), 0.001);
  const auto [satin, satin_bias] = light_apart(sphere_under_sky(1.0F, 0.5F));
  EXPECT_LT(satin, 0.04);
  EXPECT_LT(std::abs(satin_bias), 0.03);
  const auto [mirror, mirror_bias] = light_apart(sphere_under_sky(1.0F, 0.15F));
  EXPECT_LT(mirror, 0.035);
  EXPECT_LT(std::abs(mirror_bias), 0.005);
}

/// Seen from below: a metal that mirrors a body before the sky, not the dark.
TEST(BackEndsAgree, OnABodyInAMetal) {
  RenderScene scene;
  scene.lights.clear();
  scene.sky.strength = 1.0F;
  scene.meshes = {make_sphere(4, 0.5F, Vec3(0, 1.2F, 0)), make_box(Vec3(-2, 1.75F, -2), Vec3(2, 1.85F, 2))};
  for (Mesh& mesh : scene.meshes) mesh.material = {Color::Constant(0.9F), 0.2F, 1.0F, 1.5F};
  CameraSettings camera;
  camera.position = Vec3(0, 0.3F, 2.5F);
  camera.look_at = Vec3(0, 1.2F, 0);
  camera.fov = 20.0F;
  const Image raster = draw("raster", scene, camera, {}, false),
              path = draw("path", scene, camera, {}, false, 256, 4);
  // The normal there halves the angle between the camera and what is straight up or so.
  const Vec2 at =
      Camera(camera, width, height).project(Vec3(0, 1.2F, 0) + 0.5F * Vec3(0, 0.3F, 0.95F).normalized());
  const auto pixel = 3 * (static_cast<std::size_t>(at.y()) * width + static_cast<std::size_t>(at.x()));
  const float seen = raster.find(color_channel)->values[pixel],
              expected = path.find(color_channel)->values[pixel];
  EXPECT_GT(expected, 0.1F);
  EXPECT_GT(seen / expected, 0.75F);  // 0.43 where what hides the sky is black
  EXPECT_LT(seen / expected, 1.25F);
}

TEST(BackEndsAgree, OnTheShadowOfASkyMapsBrightPatch) {
  RenderScene scene = sphere_under_sky(0.0F, 1.0F);
  scene.ground.enabled = true;
  scene.ground.height = -0.3F;
  scene.ground.material = scene.meshes[0].material;
  const auto [apart, bias] = light_apart(scene, 4);
  EXPECT_LT(apart, 0.06);
  EXPECT_LT(std::abs(bias), 0.025);
}

/// A sun of 3 degrees in a picture of the sky.
TEST(BackEndsAgree, OnTheShadowOfASkyMapsSun) {
  RenderScene scene = sphere_under_sky(0.0F, 1.0F);
  scene.ground.enabled = true;
  scene.ground.height = -0.3F;
  scene.ground.material = scene.meshes[0].material;
  constexpr int columns = 360, rows = 180;
  std::vector<Color> texels(static_cast<std::size_t>(columns * rows), Color(0.2F, 0.3F, 0.5F));
  for (int k = 0; k < 9; ++k)
    texels[static_cast<std::size_t>((50 + k / 3) * columns + 225 + k % 3)] = Color(900.0F, 800.0F, 600.0F);
  scene.sky.map = std::make_shared<const SkyMap>(columns, rows, std::move(texels));
  const auto [apart, bias] = light_apart(scene, 4);
  EXPECT_LT(apart, 0.035);  // 0.053 where the sun is left in the sky
  EXPECT_LT(std::abs(bias), 0.025);
}

TEST(RasterSkyMap, TurnsWithItsRotation) {
  RenderScene scene = sphere_under_sky(0.5F, 0.4F);
  scene.meshes[0] = make_sphere(5, 0.6F, Vec3::Zero());
  const auto seen_from = [&](float azimuth, float rotation) {
    scene.sky = one_sided_sky(rotation);
    CameraSettings camera;
    const float a = azimuth * std::numbers::pi_v<float> / 180.0F;
    camera.position = Vec3(-3.0F * std::sin(a), 0.5F, 3.0F * std::cos(a));  // it looks to that azimuth
    camera.look_at = Vec3::Zero();
    return draw("raster", scene, camera, {}, false).find(color_channel)->values;
  };
  const auto difference = [](const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0.0, light = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      sum += std::abs(static_cast<double>(a[i] - b[i]));
      light += static_cast<double>(a[i]);
    }
    return sum / light;
  };
  const std::vector<float> before = seen_from(0.0F, 0.0F);
  EXPECT_LT(difference(before, seen_from(90.0F, 90.0F)), 0.005);
  EXPECT_LT(difference(before, seen_from(37.0F, 37.0F)), 0.02);  // aslant to the cube's faces
  EXPECT_GT(difference(before, seen_from(0.0F, 180.0F)), 0.2);
}

}  // namespace agreement_test
}  // namespace lagomorph::render
