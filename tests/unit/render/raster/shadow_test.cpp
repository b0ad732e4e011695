#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/render/raster/shapes.h"

namespace lagomorph::render::raster {
namespace shadow_test {

CameraSettings from_above() {
  CameraSettings camera;
  camera.position = Vec3(0.0F, 6.0F, 0.0F);
  camera.look_at = Vec3::Zero();
  camera.up = Vec3(0.0F, 0.0F, -1.0F);
  camera.fov = 40.0F;
  return camera;
}

/// A square of 1 m at height 1 under a square light at height 4, seen from a corner between them and the
/// ground; its umbra and penumbra follow from similar triangles.
RenderScene square_over_ground(float light_size) {
  RenderScene scene = empty_scene();
  scene.ground.enabled = true;
  AreaLight light;
  light.position = Vec3(0.0F, 4.0F, 0.0F);
  light.look_at = Vec3::Zero();
  light.size = Vec2(light_size, light_size);
  light.radiance = 20.0F / (light_size * light_size);
  scene.lights = {light};
  scene.meshes = {rectangle(Vec3(0.0F, 1.0F, 0.0F), 0.5F * Vec3::UnitZ(), 0.5F * Vec3::UnitX())};
  return scene;
}

/// Part of the light that reaches the ground along +x at z = 0, by the ratio to the same without the square.
/// The camera is beside, below the square.
std::vector<float> visibility_along_x(const RenderScene& scene, int count, float step) {
  CameraSettings camera;
  camera.position = Vec3(0.0F, 0.9F, 6.0F);
  camera.look_at = Vec3(0.5F, 0.0F, 0.0F);
  camera.fov = 20.0F;
  RenderSettings settings = small_settings(640, 320);
  settings.raster.shadow_map = 1024;
  const Image with = draw(scene, camera, settings);
  RenderScene bare = scene;
  bare.meshes.clear();
  const Image without = draw(bare, camera, settings);
  const Camera view(camera, 640, 320);
  std::vector<float> visibility;
  for (int i = 0; i < count; ++i) {
    const Vec3 p(static_cast<float>(i) * step, 0.0F, 0.0F);
    visibility.push_back(color_of(with, view, p)[0] / color_of(without, view, p)[0]);
  }
  return visibility;
}

TEST(RasterShadow, FallsWhereTheLightIsHidden) {
  // The edge at x = 0.5, y = 1 throws its shadow to x = 0.5 * 4 / 3.
  const std::vector<float> v = visibility_along_x(square_over_ground(0.02F), 101, 0.01F);
  for (int i = 0; i <= 100; ++i) {
    const float x = 0.01F * static_cast<float>(i);
    if (x < 0.64F) {
      EXPECT_LT(v[static_cast<std::size_t>(i)], 0.01F) << x;
    } else if (x > 0.70F) {
      EXPECT_GT(v[static_cast<std::size_t>(i)], 0.99F) << x;
    }
  }
}

TEST(RasterShadow, ALightOfSizeHasItsPenumbra) {
  // The light's edges at +-0.6 throw the edge to 2/3 -+ 0.2: visibility is linear between, since the light is
  // a rectangle with sides along the edge.
  const std::vector<float> v = visibility_along_x(square_over_ground(1.2F), 121, 0.01F);
  for (int i = 0; i <= 120; ++i) {
    const float x = 0.01F * static_cast<float>(i);
    const float expected = std::clamp((x - 2.0F / 3.0F + 0.2F) / 0.4F, 0.0F, 1.0F);
    EXPECT_NEAR(v[static_cast<std::size_t>(i)], expected, 0.04F) << x;
  }
}

/// Where the shadow is full, along the beginnings of its penumbra.
TEST(RasterShadow, TheUmbraHasNoSpecksOfLight) {
  const RenderScene scene = square_over_ground(0.3F);  // as one map sees it
  CameraSettings camera;
  camera.position = Vec3(0.4F, 1.1F, 4.0F);
  camera.look_at = Vec3(0.0F, 0.0F, 0.45F);
  camera.fov = 25.0F;
  RenderSettings settings = small_settings(960, 480);
  settings.raster.shadow_map = 1024;
  const Image image = draw(scene, camera, settings);
  const Camera view(camera, settings.width, settings.height);
  float most = 0.0F, open = 0.0F;
  for (float x = -0.6F; x < 0.6F; x += 0.002F) {
    for (const float z : {0.56F, 0.57F, 0.58F, 0.59F, 0.6F, 0.605F})
      most = std::max(most, color_of(image, view, Vec3(x, 0.0F, z))[0]);
    open = std::max(open, color_of(image, view, Vec3(x, 0.0F, 0.9F))[0]);
  }
  EXPECT_LT(most / open, 0.025F);  // 0.099 where cells blur them
}

/// Of a small sun, at a low camera to which an edge of the shadow is nearly level: from column to column the
/// lit part of the pixels above one another grows as the edge rises, not by whole pixels.
TEST(RasterShadow, ASmallSunsEdgeHasNoStepsOfPixels) {
  RenderScene scene = empty_scene();
  scene.ground.enabled = true;
  scene.suns.resize(1);
  scene.suns[0].direction = Vec3(0.0F, -1.0F, -0.2F);
  scene.suns[0].angle = 0.3F;
  scene.meshes = {rectangle(Vec3(0.0F, 0.1F, 0.0F), 0.5F * Vec3::UnitZ(), 0.5F * Vec3(1.0F, 0.0F, 0.1F))};
  CameraSettings camera;
  camera.position = Vec3(0.0F, 0.35F, 3.5F);
  camera.look_at = Vec3(0.0F, 0.0F, 0.4F);
  camera.fov = 20.0F;
  RenderSettings settings = small_settings(320, 200);
  settings.raster.shadow_map = 2048;
  const Image image = draw(scene, camera, settings);
  const Camera view(camera, settings.width, settings.height);
  const int left = static_cast<int>(view.project(Vec3(-0.4F, 0.0F, 0.45F)).x());
  const int right = static_cast<int>(view.project(Vec3(0.4F, 0.0F, 0.45F)).x());
  const int middle = static_cast<int>(view.project(Vec3(0.0F, 0.0F, 0.45F)).y());
  const auto lit = [&](int x) {
    double sum = 0.0;
    for (int y = middle - 6; y < middle + 7; ++y)
      sum += static_cast<double>(color_at(image, x, y)[0] / color_at(image, x, middle + 20)[0]);
    return sum;
  };
  double most = 0.0;
  for (int x = left; x < right; ++x) most = std::max(most, std::abs(lit(x + 1) - lit(x)));
  EXPECT_GT(std::abs(lit(right) - lit(left)), 0.5);
  EXPECT_LT(most, 0.1);  // 0.53 where a pixel is lit at its middle
}

constexpr float ground_pixel = 0.005F;  // [m]
/// A small sun's shadow 1 m beside what throws it at a height of 1 m, which is out of the picture.
RenderScene under_a_small_sun() {
  RenderScene scene = empty_scene();
  scene.suns.resize(1);
  scene.suns[0].direction = Vec3(1.0F, -1.0F, 0.0F);
  scene.suns[0].angle = 0.1F;
  return scene;
}
Image of_ground_below(const RenderScene& scene) {
  RenderSettings settings = small_settings(256, 160);
  settings.raster.shadow_map = 2048;
  CameraSettings camera = from_above();
  camera.position.x() = 1.0F;
  camera.look_at.x() = 1.0F;
  camera.orthographic = static_cast<float>(settings.height) * ground_pixel;
  return draw(scene, camera, settings);
}
/// Of that picture's pixel, from the middle [m].
float right_of_middle(const Image& image, int x) {
  return ground_pixel * (static_cast<float>(x) + 0.5F - 0.5F * static_cast<float>(image.width()));
}
float below_middle(const Image& image, int y) {
  return ground_pixel * (static_cast<float>(y) + 0.5F - 0.5F * static_cast<float>(image.height()));
}

/// To take the shadow where the ground is not.
Mesh plate() { return box(Vec3(0.2F, -0.2F, -0.8F), Vec3(1.9F, 0.0F, 0.8F)); }

/// On the ground and on a body.
class SmallSunsShadow : public ::testing::TestWithParam<bool> {
protected:
  static RenderScene scene_with(std::initializer_list<Mesh> meshes) {
    RenderScene scene = under_a_small_sun();
    scene.ground.enabled = GetParam();
    scene.meshes = meshes;
    if (!GetParam()) scene.meshes.push_back(plate());
    return scene;
  }
};
INSTANTIATE_TEST_SUITE_P(On, SmallSunsShadow, ::testing::Bool(),
                         [](const auto& on) { return on.param ? "Ground" : "Body"; });

/// However it lies to tiles and cells: nothing of it is more than two pixels beside it.
TEST_P(SmallSunsShadow, IsSharpWhereverItIs) {
  constexpr float half = 0.3F;  // [m]
  const Image open = of_ground_below(scene_with({}));
  for (int k = 0; k < 16; ++k) {
    const float shift = 1.17F * ground_pixel * static_cast<float>(k - 8);
    const Image image = of_ground_below(
        scene_with({rectangle(Vec3(shift, 1.0F, 0.7F * shift), half * Vec3::UnitZ(), half * Vec3::UnitX())}));
    int lit = 0, dark = 0, wrong = 0;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const float beyond = std::max(std::abs(right_of_middle(image, x) - shift),
                                      std::abs(below_middle(image, y) - 0.7F * shift)) -
                             half;
        if (std::abs(beyond) < 2.0F * ground_pixel) continue;
        const float seen = color_at(image, x, y)[0] / color_at(open, x, y)[0];
        (beyond > 0.0F ? lit : dark) += 1;
        wrong += std::abs(seen - (beyond > 0.0F ? 1.0F : 0.0F)) > 0.02F ? 1 : 0;
      }
    }
    EXPECT_GT(lit, 10000);
    EXPECT_GT(dark, 10000);
    EXPECT_EQ(wrong, 0) << k;
  }
}

/// Of a rod that is narrower than cells are, and so is what falls between them.
TEST_P(SmallSunsShadow, HasNoGapsWhereItIsThin) {
  constexpr float half_length = 0.3F, half_width = 0.7F * ground_pixel;
  const Image open = of_ground_below(scene_with({}));
  for (const float slope : {0.0F, 0.05F, 0.3F}) {
    for (int k = 0; k < 6; ++k) {
      const float shift = 0.83F * ground_pixel * static_cast<float>(k - 3);
      const Image image = of_ground_below(scene_with({rectangle(
          Vec3(0.0F, 1.0F, shift), half_width * Vec3::UnitZ(), half_length * Vec3(1.0F, 0.0F, slope))}));
      double least = 1e9, most = 0.0;
      for (int x = 0; x < image.width(); ++x) {
        if (std::abs(right_of_middle(image, x)) > half_length - 3.0F * ground_pixel) continue;
        double hidden = 0.0;  // of the column [pixels]
        for (int y = 0; y < image.height(); ++y)
          hidden += 1.0 - static_cast<double>(color_at(image, x, y)[0] / color_at(open, x, y)[0]);
        least = std::min(least, hidden);
        most = std::max(most, hidden);
      }
      EXPECT_GT(least, 1.0) << slope << " " << k;
      EXPECT_LT(most, 1.8) << slope << " " << k;
    }
  }
}

TEST(RasterShadow, StandsAtTheFootOfABody) {
  RenderScene scene = square_over_ground(0.05F);
  scene.meshes = {box(Vec3(-0.5F, 0.0F, -0.5F), Vec3(0.5F, 1.0F, 0.5F))};
  scene.lights[0].position =
      Vec3(-3.0F, 3.0F, 0.0F);  // 45 degrees: the shadow reaches from the foot to x = 1.5
  scene.lights[0].look_at = Vec3::Zero();
  const RenderSettings settings = small_settings(400, 400);
  const Camera camera(from_above(), 400, 400);
  const Image image = draw(scene, from_above(), settings);
  // From above, the box's top hides the ground up to x = 0.6.
  EXPECT_LT(color_of(image, camera, Vec3(0.61F, 0.0F, 0.0F))[0], 0.01F);
  EXPECT_GT(color_of(image, camera, Vec3(0.0F, 0.0F, 0.65F))[0], 0.05F);
  EXPECT_LT(color_of(image, camera, Vec3(2.1F, 0.0F, 0.0F))[0], 0.01F);
  EXPECT_GT(color_of(image, camera, Vec3(2.35F, 0.0F, 0.0F))[0], 0.05F);
}

TEST(RasterShadow, LeavesNoLineOfLightAtTheFoot) {
  // Seen from the shadow's side, the ground is dark from the wall on.
  RenderScene scene = square_over_ground(0.05F);
  scene.meshes = {box(Vec3(-0.5F, 0.0F, -0.5F), Vec3(0.5F, 1.0F, 0.5F))};
  scene.lights[0].position = Vec3(-3.0F, 3.0F, 0.0F);
  scene.lights[0].look_at = Vec3::Zero();
  CameraSettings settings;
  settings.position = Vec3(2.5F, 0.6F, 0.0F);
  settings.look_at = Vec3(0.5F, 0.0F, 0.0F);
  settings.fov = 6.0F;
  const Image image = draw(scene, settings, small_settings(200, 200));
  for (int y = 0; y < 200; ++y) EXPECT_LT(color_at(image, 100, y)[0], 0.01F) << y;
}

TEST(RasterShadow, ABodyInsideOutCastsTheSame) {
  RenderScene scene = square_over_ground(0.3F);
  scene.meshes = {sphere(Vec3(0.0F, 1.0F, 0.0F), 0.5F, 24)};
  const std::vector<float> expected = visibility_along_x(scene, 100, 0.01F);
  for (Triangle& t : scene.meshes[0].triangles) std::swap(t[1], t[2]);
  const std::vector<float> found = visibility_along_x(scene, 100, 0.01F);
  EXPECT_LT(expected[0], 0.01F);
  EXPECT_GT(expected[99], 0.9F);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_NEAR(found[i], expected[i], 0.05F) << i;
}

TEST(RasterShadow, EachLightHasItsOwn) {
  RenderScene scene = square_over_ground(0.05F);
  AreaLight side = scene.lights[0];
  side.position = Vec3(4.0F, 4.0F, 0.0F);
  side.radiance *= 2.0F;
  scene.lights.push_back(side);
  const std::vector<float> v = visibility_along_x(scene, 1, 0.1F);
  // At the origin only the light at the side shines: (0, 1/2) from it meets the square's plane at x = 1.
  const auto strength = [](const Vec3& light) {  // cos cos / d^2 of a light that looks at the origin
    return light.normalized().y() / light.squaredNorm();
  };
  const float from_side = 2.0F * strength(side.position);
  EXPECT_NEAR(v[0], from_side / (from_side + strength(Vec3(0.0F, 4.0F, 0.0F))), 0.01F);
}

/// Where the vertices' normals face the light, triangles that are turned away from it are lit: not in a
/// shadow.
TEST(RasterShadow, FallsOnTrianglesThatAreTurnedAway) {
  RenderScene scene = square_over_ground(0.05F);
  scene.ground.enabled = false;
  scene.lights[0].position.y() = 40.0F;  // its light falls along the triangles at the sphere's equator
  scene.lights[0].radiance *= 100.0F;
  scene.meshes.push_back(sphere(Vec3(0.0F, 0.5F, 0.0F), 0.4F, 9));
  CameraSettings camera;
  camera.position = Vec3(0.0F, 0.5F, 3.0F);
  camera.look_at = Vec3(0.0F, 0.5F, 0.0F);
  camera.fov = 18.0F;
  const RenderSettings settings = small_settings(200, 160);
  const auto brightest = [&] {
    const Image image = draw(scene, camera, settings);
    const std::vector<float>& c = image.find("color")->values;
    const auto from = static_cast<std::ptrdiff_t>(3 * 200 * 40);  // below the square
    return *std::max_element(c.begin() + from, c.end());
  };
  EXPECT_LT(brightest(), 0.01F);  // 0.034 by the triangles' planes alone
  scene.meshes.erase(scene.meshes.begin());
  EXPECT_GT(brightest(), 0.1F);
}

/// A bowl of n x n squares, 1 m wide and 12 cm deep, whose sides are seen.
Mesh bowl(int n) {
  Mesh mesh;
  mesh.name = "bowl";
  mesh.material = matte(0.5F);
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const float x = static_cast<float>(i) / static_cast<float>(n) - 0.5F;
      const float z = static_cast<float>(j) / static_cast<float>(n) - 0.5F;
      mesh.positions.emplace_back(x, 0.24F * (x * x + z * z), z);
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const auto at = [&](int di, int dj) { return static_cast<std::uint32_t>((j + dj) * (n + 1) + i + di); };
      mesh.triangles.push_back({at(0, 0), at(0, 1), at(1, 0)});
      mesh.triangles.push_back({at(1, 0), at(0, 1), at(1, 1)});
    }
  }
  return mesh;
}

/// Under a light of size that grazes it, a hollow of large triangles looks as one of small ones does.
TEST(RasterShadow, AHollowShowsNoTriangles) {
  RenderScene scene = square_over_ground(1.5F);
  scene.ground.enabled = false;
  scene.lights[0].position = Vec3(-3.0F, 0.6F, 0.3F);
  CameraSettings camera;
  camera.position = Vec3(0.3F, 2.6F, 1.8F);
  camera.look_at = Vec3::Zero();
  camera.fov = 17.0F;
  const auto drawn = [&](int squares) {
    scene.meshes = {bowl(squares)};
    return draw(scene, camera, small_settings(240, 160));
  };
  const Image coarse = drawn(12), fine = drawn(96);
  double apart = 0.0, light = 0.0;
  for (int y = 30; y < 130; ++y) {
    for (int x = 60; x < 180; ++x) {
      // The steps from pixel to pixel, for the triangles' edges are to be seen in them.
      apart += static_cast<double>(std::abs(color_at(coarse, x + 2, y)[0] - color_at(coarse, x, y)[0] -
                                            color_at(fine, x + 2, y)[0] + color_at(fine, x, y)[0]));
      light += static_cast<double>(color_at(fine, x, y)[0]);
    }
  }
  EXPECT_LT(apart / light, 0.003);  // 0.017 by the triangles' planes
}

/// A light whose lower half is under a surface's horizon: what hides the upper half hides all that it gets.
TEST(RasterShadow, CountsOnlyWhatIsAboveTheHorizonOfALight) {
  RenderScene scene = square_over_ground(2.0F);
  scene.ground.enabled = false;
  scene.lights[0].position = Vec3(-3.0F, 0.0F, 0.0F);
  scene.lights[0].look_at = Vec3::Zero();
  scene.meshes = {rectangle(Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitX())};
  CameraSettings camera;
  camera.position = Vec3(1.0F, 2.0F, 3.0F);
  camera.look_at = Vec3::Zero();
  camera.fov = 40.0F;
  const Camera view(camera, 160, 120);
  const Vec3 point(0.3F, 0.0F, 0.0F);
  const float open = color_of(draw(scene, camera, small_settings(160, 120)), view, point)[0];
  scene.meshes.push_back(box(Vec3(-0.7F, 0.001F, -2.0F), Vec3(-0.6F, 1.0F, 2.0F)));
  const float hidden = color_of(draw(scene, camera, small_settings(160, 120)), view, point)[0];
  EXPECT_GT(open, 0.01F);
  EXPECT_LT(hidden / open, 0.06F);  // 0.56 where what is below the horizon counts
}

/// The pixels of a quad share what they find, and yet have each their own place in the penumbra.
TEST(RasterShadow, APenumbraHasNoStepsOfTwoPixels) {
  const RenderScene scene = square_over_ground(1.2F);
  CameraSettings camera;
  camera.position = Vec3(0.0F, 0.9F, 6.0F);
  camera.look_at = Vec3(0.0F, 0.0F, 0.0F);
  camera.fov = 20.0F;
  const Image image = draw(scene, camera, small_settings(640, 320));
  const Camera view(camera, 640, 320);
  const int y = static_cast<int>(view.project(Vec3::Zero()).y());
  const int left = static_cast<int>(view.project(Vec3(0.5F, 0.0F, 0.0F)).x()) / 2 * 2;
  const int right = static_cast<int>(view.project(Vec3(0.83F, 0.0F, 0.0F)).x()) / 2 * 2;
  float within = 0.0F, between = 0.0F;
  for (int x = left; x < right; x += 2) {
    within += color_at(image, x + 1, y)[0] - color_at(image, x, y)[0];
    between += color_at(image, x + 2, y)[0] - color_at(image, x + 1, y)[0];
  }
  EXPECT_GT(between, 0.05F);
  EXPECT_NEAR(within / between, 1.0F, 0.1F);  // 0 where a quad is of one value
}

/// A ball that touches the ground under the sky alone.
RenderScene sphere_on_ground(int rings) {
  RenderScene scene = empty_scene();
  scene.ground.enabled = true;
  scene.sky.strength = 1.0F;
  scene.meshes = {sphere(Vec3(0.0F, 0.5F, 0.0F), 0.5F, rings)};
  scene.meshes[0].material = scene.ground.material =
      matte(0.02F);  // so that hardly any light goes between them
  return scene;
}

TEST(RasterShadow, TheSkyIsDimmedUnderABody) {
  const RenderScene scene = sphere_on_ground(24);
  CameraSettings camera;
  camera.position = Vec3(0.0F, 0.6F, 4.0F);
  camera.look_at = Vec3(0.0F, 0.3F, 0.0F);
  const Image image = draw(scene, camera, small_settings(320, 200));
  const Camera view(camera, 320, 200);
  const float open = color_of(image, view, Vec3(-2.0F, 0.0F, 0.0F))[0];
  // A sphere that touches the ground takes sin^2 of its half angle times the cosine of its direction: beside
  // it at distance d, r^2 / (r^2 + d^2) * r / sqrt(r^2 + d^2).
  for (const float d : {0.55F, 0.8F, 1.2F}) {
    const float taken = 0.25F / (0.25F + d * d) * 0.5F / std::sqrt(0.25F + d * d);
    EXPECT_NEAR(color_of(image, view, Vec3(d, 0.0F, 0.0F))[0] / open, 1.0F - taken, 0.08F) << d;
  }
}

/// Near where a body touches the ground, where hardly anything of the sky is seen.
TEST(RasterShadow, TheSkyIsHiddenAtAContact) {
  RenderScene scene = sphere_on_ground(48);
  scene.ground.radius = 40.0F;
  scene.ground.fade_start = 30.0F;
  CameraSettings camera;
  camera.position = Vec3(0.0F, 0.3F, 3.0F);
  camera.look_at = Vec3(0.0F, 0.05F, 0.0F);
  camera.fov = 20.0F;
  const Image image = draw(scene, camera, small_settings(320, 200));
  const Camera view(camera, 320, 200);
  CameraSettings aside = camera;
  aside.position.x() = aside.look_at.x() = 8.0F;
  const float open = color_of(draw(scene, aside, small_settings(320, 200)), Camera(aside, 320, 200),
                              Vec3(8.0F, 0.0F, 0.3F))[0];
  for (const float d : {0.15F, 0.2F, 0.3F, 0.4F}) {  // as above
    const float taken = 0.25F / (0.25F + d * d) * 0.5F / std::sqrt(0.25F + d * d);
    EXPECT_NEAR(color_of(image, view, Vec3(0.0F, 0.0F, d))[0] / open, 1.0F - taken, 0.05F) << d;
  }
}

/// Of a bar over the ground: no pattern of the points along which it is looked for.
TEST(RasterShadow, TheSkysIsSmoothOnTheGround) {
  RenderScene scene = empty_scene();
  scene.ground.enabled = true;
  scene.ground.radius = 20.0F;
  scene.ground.fade_start = 15.0F;
  scene.sky = Sky{};
  scene.sky.strength = 1.0F;
  scene.meshes = {box(Vec3(-0.5F, 0.4F, -0.1F), Vec3(0.5F, 0.6F, 0.1F))};
  CameraSettings camera;
  camera.position = Vec3(0.0F, 0.3F, 2.0F);
  camera.look_at = Vec3(0.0F, -0.1F, 0.0F);
  const RenderSettings settings = small_settings(240, 160);
  const Image image = draw(scene, camera, settings);
  double bend = 0.0, light = 0.0;
  for (int y = settings.height / 2; y < settings.height - 2; ++y) {
    for (int x = 2; x < settings.width - 2; ++x) {
      const Color c = color_at(image, x, y);
      const Color around = 0.25F * (color_at(image, x - 2, y) + color_at(image, x + 2, y) +
                                    color_at(image, x, y - 2) + color_at(image, x, y + 2));
      bend += static_cast<double>((c - around).abs().sum());
      light += static_cast<double>(c.sum());
    }
  }
  EXPECT_LT(bend / light, 5e-4);  // 1e-3 with the points of single texels
}

}  // namespace shadow_test
}  // namespace lagomorph::render::raster
