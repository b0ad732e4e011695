#include "render/raster/ray_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "render/channels.h"
#include "render/raster/optics_stand_in.h"
#include "render/renderer.h"
#include "tests/unit/render/path/shapes.h"

/// What the rasterizer draws by rays.
namespace lagomorph::render::raster {
namespace ray_pass_test {

constexpr int width = 160, height = 120;

CameraSettings camera_of_test() {
  CameraSettings c;
  c.position = Vec3(0.4F, 1.1F, 3.2F);
  c.look_at = Vec3(0, 0.4F, 0);
  return c;
}

/// A matte sphere behind one more, on a checkered floor under a sky and a lamp.
RenderScene scene_with(const Material& material) {
  RenderScene scene;
  scene.meshes = {make_sphere(4, 0.5F, Vec3(-0.1F, 0.52F, 0.4F)),
                  make_sphere(4, 0.4F, Vec3(0.6F, 0.42F, -0.7F))};
  scene.meshes[0].material = material;
  scene.meshes[1].material = {Color(0.8F, 0.3F, 0.1F), 1.0F, 0.0F, 1.0F};
  scene.meshes[1].body_id = 1;
  scene.ground.texture = "checker";
  scene.ground.texture_size = 0.4F;
  scene.ground.material = {Color::Constant(0.6F), 1.0F, 0.0F, 1.0F};
  scene.lights.resize(1);
  scene.lights[0].position = Vec3(1.5F, 2.5F, 2.0F);
  scene.lights[0].size = Vec2(0.8F, 0.8F);
  return scene;
}

Material glass(float roughness = 0.0F) {
  Material m;
  m.transmission = 1.0F;
  m.roughness = roughness;
  m.absorption_color = Color(0.4F, 0.9F, 0.6F);
  return m;
}

Image draw(const std::string& backend, const RenderScene& scene, std::optional<PixelRegion> region = {}) {
  RenderSettings s;
  s.backend = backend;
  s.width = width;
  s.height = height;
  s.samples = 256;
  s.path.bounces = 6;
  s.path.filter = "box";
  s.path.filter_radius = 0.5F;
  const auto renderer = make_renderer(s, 2);
  renderer->set_scene(scene);
  return renderer->render(Camera(camera_of_test(), width, height), {.frame = 1, .region = region});
}

/// Mean of |a - b| over that of b, of the pixels where a mesh is seen, of colours up to 1.
double apart(const Image& a, const Image& b, const RenderScene& scene, std::size_t mesh) {
  const Camera camera(camera_of_test(), width, height);
  const std::vector<float>&x = a.find(color_channel)->values, &y = b.find(color_channel)->values;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : scene.meshes[mesh].positions) middle += p;
  middle /= static_cast<float>(scene.meshes[mesh].positions.size());
  const float radius = (scene.meshes[mesh].positions[0] - middle).norm();
  double sum = 0.0, light = 0.0;
  for (int k = 0; k < width * height; ++k) {
    const Ray ray = camera.ray(static_cast<float>(k % width) + 0.5F, static_cast<float>(k / width) + 0.5F);
    const Vec3 to = middle - ray.origin;
    if ((to - to.dot(ray.direction) * ray.direction).norm() > radius) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = 3 * static_cast<std::size_t>(k) + c;
      sum += std::abs(std::min(x[i], 1.0F) - std::min(y[i], 1.0F));
      light += std::min(y[i], 1.0F);
    }
  }
  return sum / light;
}

TEST(ByRays, GlassLooksAsThePathTracerDrawsIt) {
  for (const float roughness : {0.0F, 0.25F}) {
    const RenderScene scene = scene_with(glass(roughness));
    EXPECT_LT(apart(draw("raster", scene), draw("path", scene), scene, 0), 0.08) << roughness;
  }
}

/// The base sees what comes through it, as often as that is sent to and fro.
TEST(ByRays, HalfClearBodiesLookAsThePathTracerDrawsThem) {
  for (const float transmission : {0.25F, 0.5F, 0.8F}) {
    Material half = glass();
    half.transmission = transmission;
    half.absorption_color = Color::Ones();
    half.base_color = Color(0.8F, 0.35F, 0.1F);
    const RenderScene scene = scene_with(half);
    EXPECT_LT(apart(draw("raster", scene), draw("path", scene), scene, 0), 0.06) << transmission;
  }
}

/// As far as plain matte spheres of those base colours do, on this floor: 0.08.
TEST(ByRays, SheenAndCoatLookAsThePathTracerDrawsThem) {
  Material cloth{Color(0.1F, 0.1F, 0.3F), 0.9F, 0.0F, 1.0F};
  cloth.sheen = 0.8F;
  cloth.sheen_tint = Color(0.9F, 0.7F, 0.6F);
  RenderScene scene = scene_with(cloth);
  EXPECT_LT(apart(draw("raster", scene), draw("path", scene), scene, 0), 0.08);
  Material varnished{Color(0.5F, 0.1F, 0.1F), 0.6F, 0.0F, 1.5F};
  varnished.coat = 0.8F;
  varnished.coat_roughness = 0.05F;
  scene = scene_with(varnished);
  EXPECT_LT(apart(draw("raster", scene), draw("path", scene), scene, 0), 0.08);
}

TEST(ByRays, AMetalMirrorsFloorSphereAndItself) {
  const RenderScene scene = scene_with({Color(0.9F, 0.8F, 0.6F), 0.05F, 1.0F, 1.5F});
  EXPECT_LT(apart(draw("raster", scene), draw("path", scene), scene, 0), 0.05);
}

TEST(ByRays, ASmoothFloorMirrorsMeshes) {
  RenderScene scene = scene_with({Color(0.2F, 0.3F, 0.8F), 1.0F, 0.0F, 1.0F});
  scene.ground.material = {Color::Constant(0.7F), 0.1F, 1.0F, 1.5F};
  const Image raster = draw("raster", scene), path = draw("path", scene);
  // Where the spheres are mirrored, much of that from where the camera sees only the other side.
  RenderScene below = scene;
  for (Mesh& mesh : below.meshes) {
    for (Vec3& p : mesh.positions) p.y() = -p.y();
  }
  EXPECT_LT(apart(raster, path, below, 0), 0.32);  // 1.5 without
  EXPECT_LT(apart(raster, path, below, 1), 0.2);   // likewise
}

/// But for what its two thousand facets leave of an index of 1.001.
TEST(ByRays, ThroughAnIndexOfOneTheSceneIsSeenAsItIs) {
  Material air;
  air.transmission = 1.0F;
  air.ior = 1.0F;
  air.roughness = 0.0F;
  RenderScene scene = scene_with(air);
  scene.ground.texture = "none";  // pictures of pictures blur its edges
  RenderScene without = scene;
  without.meshes.erase(without.meshes.begin());
  EXPECT_LT(apart(draw("raster", scene), draw("raster", without), scene, 0), 0.01);
}

/// The channel tells the material as it is, in both back ends.
TEST(ByRays, GlassHasTheAlbedoOfItsInside) {
  Material half = glass();
  half.transmission = 0.5F;
  half.coat = 1.0F;
  for (const Material& material : {glass(), half}) {
    const RenderScene scene = scene_with(material);
    const auto middle = [&](const std::string& backend) -> Color {
      RenderSettings s;
      s.backend = backend;
      s.width = width;
      s.height = height;
      s.samples = 4;
      s.channels = {albedo_channel};
      const auto renderer = make_renderer(s, 1);
      renderer->set_scene(scene);
      const Camera camera(camera_of_test(), width, height);
      const Image image = renderer->render(camera, {.frame = 1});
      const Vec2 at = camera.project(Vec3(-0.1F, 0.52F, 0.4F));
      const float* v = image.find(albedo_channel)->values.data() +
                       3 * (static_cast<std::size_t>(at.y()) * width + static_cast<std::size_t>(at.x()));
      return {v[0], v[1], v[2]};
    };
    EXPECT_LT((middle("raster") - middle("path")).abs().maxCoeff(), 1e-4F);
  }
}

/// New colours of a metal's vertices are what it mirrors by.
TEST(ByRays, AMetalMirrorsByItsVerticesColours) {
  RenderScene scene = scene_with({Color(0.9F, 0.9F, 0.9F), 0.05F, 1.0F, 1.5F});
  scene.meshes[0].colors.assign(scene.meshes[0].positions.size(), Color(0.9F, 0.9F, 0.9F));
  const std::vector<Color> red(scene.meshes[0].positions.size(), Color(0.9F, 0.1F, 0.1F));
  RenderSettings s;
  s.width = width;
  s.height = height;
  const auto renderer = make_renderer(s, 1);
  renderer->set_scene(scene);
  renderer->update_colors(0, red);
  const Image later = renderer->render(Camera(camera_of_test(), width, height), {.frame = 1});
  scene.meshes[0].colors = red;
  EXPECT_EQ(apart(later, draw("raster", scene), scene, 0), 0.0);
}

TEST(ByRays, ARegionIsTheWholePictures) {
  RenderScene scene = scene_with(glass());
  scene.ground.material.roughness = 0.1F;
  scene.ground.material.ior = 1.5F;
  const Image whole = draw("raster", scene);
  const PixelRegion region{50, 40, 90, 100};
  const Image part = draw("raster", scene, region);
  for (int y = region.y0; y < region.y1; ++y) {
    for (int x = region.x0; x < region.x1; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t i = 3 * static_cast<std::size_t>(y * width + x) + c;
        ASSERT_EQ(part.find(color_channel)->values[i], whole.find(color_channel)->values[i]) << x << " " << y;
      }
    }
  }
}

TEST(ByRays, AreLeftOutBesideSeeThroughMeshesAndOfColouredInsides) {
  RenderScene scene = scene_with(glass());
  const auto by_rays = [&](std::size_t mesh) { return drawn_by_rays(scene, RasterSettings{}).meshes[mesh]; };
  EXPECT_TRUE(by_rays(0).behind);
  EXPECT_TRUE(by_rays(0).mirrored);
  EXPECT_FALSE(by_rays(1).any());
  scene.meshes[0].material.roughness = 0.4F;
  EXPECT_TRUE(by_rays(0).behind);
  EXPECT_FALSE(by_rays(0).mirrored);
  scene.meshes[0].colors.assign(scene.meshes[0].positions.size(), Color::Ones());
  EXPECT_FALSE(by_rays(0).behind);
  scene.meshes[0].colors.clear();
  scene.meshes[1].material.opacity = 0.5F;
  EXPECT_FALSE(by_rays(0).any());
}

TEST(ByRays, AreOfNothingWhereTheyAreOff) {
  RenderScene scene = scene_with(glass());
  scene.ground.material = {Color::Constant(0.6F), 0.1F, 0.0F, 1.5F};
  EXPECT_TRUE(drawn_by_rays(scene, RasterSettings{}).ground);
  RasterSettings off;
  off.rays = false;
  EXPECT_FALSE(drawn_by_rays(scene, off).any());
}

/// Beer and Lambert's law times two Fresnel transmissions, and what is not bent away.
TEST(ByRays, LightThroughIsLessTheThickerAnInsideIs) {
  Material m = glass();
  m.absorption_color = Color::Constant(0.5F);
  m.absorption_distance = 0.2F;
  EXPECT_NEAR(light_through(m, 0.4F) / light_through(m, 0.2F), 0.5, 1e-5);
  m.transmission = 0.5F;
  EXPECT_NEAR(light_through(m, 0.0F), 0.4 * 0.5 * 0.95 * 0.95, 0.01);
  m.ior = 1.0F;
  EXPECT_NEAR(light_through(m, 0.0F), 0.5, 1e-3);
}

}  // namespace ray_pass_test
}  // namespace lagomorph::render::raster
