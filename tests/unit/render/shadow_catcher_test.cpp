#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "render/channels.h"
#include "render/renderer.h"
#include "tests/unit/render/path/shapes.h"

/// The ground that is not seen, with shadows that are alpha, by both back ends.
namespace lagomorph::render {
namespace shadow_catcher_test {

constexpr int width = 160, height = 120;

struct Drawn {
  std::vector<float> color, alpha, ids;
  float alpha_at(int x, int y) const { return alpha[static_cast<std::size_t>(y * width + x)]; }
};

Drawn draw(const std::string& backend, const RenderScene& scene, const CameraSettings& camera,
           bool transparent = true, std::optional<PixelRegion> region = std::nullopt) {
  RenderSettings s;
  s.backend = backend;
  s.width = width;
  s.height = height;
  s.samples = 64;
  s.path.bounces = 0;
  s.transparent = transparent;
  s.path.filter = "box";
  s.path.filter_radius = 0.5F;
  s.channels = {alpha_channel, body_id_channel};
  const auto renderer = make_renderer(s, 2);
  renderer->set_scene(scene);
  const Image image = renderer->render(Camera(camera, width, height), {.region = region});
  return {image.find(color_channel)->values, image.find(alpha_channel)->values,
          image.find(body_id_channel)->values};
}

/// A sphere over the ground, under a light and a sky.
RenderScene sphere() {
  RenderScene scene;
  scene.meshes = {make_sphere(4, 0.4F, Vec3(0, 0.5F, 0))};
  scene.ground.radius = 6.0F;
  scene.ground.fade_start = 3.0F;
  scene.ground.shadow_catcher = true;
  scene.lights.resize(1);
  return scene;
}

CameraSettings above() {
  CameraSettings c;
  c.position = Vec3(0.4F, 2.0F, 3.0F);
  c.look_at = Vec3(0, 0.2F, 0);
  return c;
}

/// Whether nothing of a body is in a pixel or beside it.
bool is_free(const Drawn& d, int x, int y) {
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i)
      if (d.ids[static_cast<std::size_t>(j * width + i)] >= 0.0F) return false;
  return true;
}

TEST(ShadowCatcher, BothBackEndsAgree) {
  const RenderScene scene = sphere();
  const Drawn raster = draw("raster", scene, above()), path = draw("path", scene, above());
  double sum = 0.0;
  float most = 0.0F;
  int seen = 0;
  for (std::size_t i = 0; i < path.alpha.size(); ++i)
    sum += std::abs(static_cast<double>(raster.alpha[i]) - static_cast<double>(path.alpha[i]));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!is_free(raster, x, y)) continue;
      ++seen;
      most = std::max(most, path.alpha_at(x, y));
      const auto i = static_cast<std::size_t>(y * width + x);
      for (const Drawn* d : {&raster, &path}) {
        ASSERT_GE(d->alpha[i], 0.0F);
        ASSERT_LE(d->alpha[i], 1.0F);
        for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(d->color[3 * i + c], 0.0F) << x << " " << y;
      }
    }
  }
  EXPECT_GT(seen, width * height / 2);
  EXPECT_GT(most, 0.5F) << "in the middle of the shadow";
  EXPECT_LT(sum / static_cast<double>(path.alpha.size()), 0.01) << "mean";
  // The sphere hides next to nothing of the sky from the picture's corners, nothing from where it is far
  // away.
  for (const Drawn* d : {&raster, &path}) {
    for (const int x : {2, width - 3}) {
      EXPECT_LT(d->alpha_at(x, height - 3), 0.03F);
      EXPECT_LT(d->alpha_at(x, 2), 0.005F);
    }
  }
}

/// What it mirrors, and its texture, are not its shadow.
TEST(ShadowCatcher, IsTheSameOnAPolishedChecker) {
  RenderScene checkered = sphere();
  checkered.ground.material.roughness = 0.1F;
  checkered.ground.texture = "checker";
  checkered.ground.texture_color = Color::Constant(0.02F);
  for (const char* backend : {"raster", "path"}) {
    const Drawn plain = draw(backend, sphere(), above()), polished = draw(backend, checkered, above());
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (!is_free(plain, x, y)) continue;
        ASSERT_NEAR(polished.alpha_at(x, y), plain.alpha_at(x, y), 2e-3F) << backend << " " << x << " " << y;
      }
    }
  }
}

/// A board between the ground and one of two equal lights, and no sky: half of the light is gone below it.
TEST(ShadowCatcher, AlphaIsThePartOfTheLightThatIsTaken) {
  RenderScene scene;
  scene.ground.shadow_catcher = true;
  scene.sky.strength = 0.0F;
  AreaLight light;
  light.size = Vec2(0.1F, 0.1F);
  light.look_at = Vec3::Zero();
  light.position = Vec3(-2, 2, 0);
  scene.lights = {light, light};
  scene.lights[1].position = Vec3(2, 2, 0);
  scene.meshes = {
      make_box(Vec3(-1.1F, 0.7F, -0.5F), Vec3(-0.3F, 0.71F, 0.5F))};  // between the first and (0, 0, 0)
  CameraSettings camera;
  camera.position = Vec3(0, 0.6F, 3.0F);
  camera.look_at = Vec3::Zero();
  camera.fov = 20.0F;
  for (const char* backend : {"raster", "path"}) {
    const Drawn two = draw(backend, scene, camera);
    EXPECT_NEAR(two.alpha_at(width / 2, height / 2), 0.5F, 0.02F) << backend;
    RenderScene one = scene;
    one.lights.resize(1);
    EXPECT_NEAR(draw(backend, one, camera).alpha_at(width / 2, height / 2), 1.0F, 0.01F) << backend;
    one.meshes.front().material.opacity = 0.25F;
    const float dim = draw(backend, one, camera).alpha_at(width / 2, height / 2);
    EXPECT_GT(dim, 0.2F) << backend;  // of one or two sides of the board
    EXPECT_LT(dim, 0.5F) << backend;
    one.lights.clear();
    EXPECT_EQ(draw(backend, one, camera).alpha_at(width / 2, height / 2), 0.0F)
        << backend << ": no light at all";
  }
}

/// Where one of many lights is picked, of suns, and under the picture of a sky.
TEST(ShadowCatcher, AllLightsCount) {
  RenderScene scene = sphere();
  scene.sky.strength = 0.0F;
  scene.lights.clear();
  scene.suns.resize(2);
  scene.suns[0].direction = Vec3(0, -1, 0);  // its shadow is below the sphere
  scene.suns[1].direction = Vec3(-10, -1, 0);
  scene.suns[0].irradiance = 1.0F;
  scene.suns[1].irradiance = std::sqrt(101.0F);  // on the ground as much
  CameraSettings camera;
  camera.position = Vec3(0, 0.25F, 4.0F);
  camera.look_at = Vec3::Zero();
  camera.fov = 4.0F;
  const auto middle = [&](const char* backend) {
    return draw(backend, scene, camera).alpha_at(width / 2, height / 2);
  };
  for (const char* backend : {"raster", "path"}) EXPECT_NEAR(middle(backend), 0.5F, 0.06F) << backend;
  scene.suns.clear();
  AreaLight light;
  light.size = Vec2(0.1F, 0.1F);
  light.look_at = Vec3::Zero();
  for (int i = 0; i < 6; ++i) {  // the first two above the sphere, the others beside it
    light.position = i < 2 ? Vec3(0, 3, 0) : Vec3(6, 3, 0);
    light.radiance = i < 2 ? 2.0F : 10.0F;
    scene.lights.push_back(light);
  }
  // Radiance times cosine over the squared distance; the lights face the point.
  const float hidden = 2 * 2.0F / 9.0F, arrives = 4 * 10.0F * (3.0F / std::sqrt(45.0F)) / 45.0F;
  EXPECT_NEAR(middle("path"), hidden / (hidden + arrives), 0.06F);
}

/// What is drawn of a part of the picture is what the whole has there.
TEST(ShadowCatcher, OfARegionIsThatOfTheWhole) {
  for (const char* backend : {"raster", "path"}) {
    const PixelRegion region{40, 50, 121, 93};
    const Drawn whole = draw(backend, sphere(), above()),
                part = draw(backend, sphere(), above(), true, region);
    for (int y = region.y0; y < region.y1; ++y)
      for (int x = region.x0; x < region.x1; ++x)
        ASSERT_EQ(part.alpha_at(x, y), whole.alpha_at(x, y)) << backend << " " << x << " " << y;
  }
}

/// Laid over the ground without bodies it is the picture with them: of the rasterizer to rounding, of the
/// path tracer, whose direct light is of other samples, in the mean.
TEST(ShadowCatcher, OverTheEmptyGroundItIsTheShadowThere) {
  RenderScene caught = sphere();
  caught.meshes[0].material.base_color = Color::Zero();  // sends nothing back to the ground,
  caught.ground.material.roughness = 1.0F;               // which mirrors nothing
  caught.ground.material.ior = 1.0F;
  RenderScene seen = caught, empty = caught;
  seen.ground.shadow_catcher = empty.ground.shadow_catcher = false;
  empty.meshes.clear();
  for (const std::string backend : {"raster", "path"}) {
    const Drawn shadows = draw(backend, caught, above()), whole = draw(backend, seen, above()),
                ground = draw(backend, empty, above());
    int compared = 0;
    double sum = 0.0, light = 0.0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto i = static_cast<std::size_t>(y * width + x);
        // Where the ground is whole, so that nothing of it is behind another.
        if (!is_free(whole, x, y) || ground.alpha[i] < 1.0F) continue;
        ++compared;
        const auto luminance = [&](const Drawn& d) {
          return 0.2126F * d.color[3 * i] + 0.7152F * d.color[3 * i + 1] + 0.0722F * d.color[3 * i + 2];
        };
        const float difference = (1.0F - shadows.alpha[i]) * luminance(ground) - luminance(whole);
        sum += static_cast<double>(difference);
        light += static_cast<double>(luminance(whole));
        if (backend == "raster") {
          ASSERT_NEAR(difference, 0.0F, 2e-3F) << x << " " << y;
        } else {
          ASSERT_LT(std::abs(difference), 0.25F * luminance(ground)) << x << " " << y;
        }
      }
    }
    EXPECT_GT(compared, width * height / 3);
    EXPECT_LT(std::abs(sum), 0.003 * light) << backend;
  }
}

/// Bodies are lit as with the ground seen, and nothing is left of it in pictures that are not transparent.
TEST(ShadowCatcher, BodiesAndOpaquePicturesStayAsTheyAre) {
  for (const char* backend : {"raster", "path"}) {
    RenderScene seen = sphere();
    seen.ground.shadow_catcher = false;
    const Drawn caught = draw(backend, sphere(), above()), whole = draw(backend, seen, above());
    const std::size_t middle = 3 * static_cast<std::size_t>((height / 2 - 6) * width + width / 2);
    ASSERT_EQ(caught.ids[middle / 3], 0.0F);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(caught.color[middle + c], whole.color[middle + c]) << backend;
    EXPECT_EQ(caught.alpha[middle / 3], 1.0F);
    EXPECT_EQ(draw(backend, sphere(), above(), false).color, draw(backend, seen, above(), false).color);
  }
}

}  // namespace shadow_catcher_test
}  // namespace lagomorph::render
