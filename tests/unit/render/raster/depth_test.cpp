#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/render/raster/shapes.h"

namespace lagomorph::render::raster {
namespace depth_test {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Distance along a ray to a mesh, by every triangle in double precision; negative where none is met.
double trace(const Mesh& mesh, const Ray& ray) {
  double nearest = -1.0;
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.positions[t[0]].cast<double>();
    const Eigen::Vector3d e1 = mesh.positions[t[1]].cast<double>() - a;
    const Eigen::Vector3d e2 = mesh.positions[t[2]].cast<double>() - a;
    const Eigen::Vector3d d = ray.direction.cast<double>();
    const Eigen::Vector3d p = d.cross(e2);
    const Eigen::Vector3d s = ray.origin.cast<double>() - a;
    const Eigen::Vector3d q = s.cross(e1);
    const double det = e1.dot(p);
    const double u = s.dot(p) / det;
    const double v = d.dot(q) / det;
    const double distance = e2.dot(q) / det;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || !(distance > 0.0)) continue;
    if (nearest < 0.0 || distance < nearest) nearest = distance;
  }
  return nearest;
}

/// Depths agree with rays through the pixels' centres to 1e-4, but for a pixel's width at outlines.
void expect_traced_depth(const Mesh& mesh, const CameraSettings& settings) {
  RenderScene scene = empty_scene();
  scene.meshes = {mesh};
  const Image image = draw(scene, settings, small_settings());
  const Camera camera(settings, 96, 64);
  const auto traced = [&](float px, float py) {
    const Ray ray = camera.ray(px, py);
    const double t = trace(mesh, ray);
    return t < 0.0 ? -1.0 : t * static_cast<double>(ray.direction.dot(camera.forward()));
  };
  int seen = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 96; ++x) {
      const float cx = static_cast<float>(x) + 0.5F;
      const float cy = static_cast<float>(y) + 0.5F;
      const double expected = traced(cx, cy);
      const float found = depth_at(image, x, y);
      if ((expected > 0.0) != std::isfinite(found)) {
        // Then within a pixel the other answer is right.
        bool near_outline = false;
        for (const float dx : {-1.0F, 0.0F, 1.0F}) {
          for (const float dy : {-1.0F, 0.0F, 1.0F})
            near_outline = near_outline || (traced(cx + dx, cy + dy) > 0.0) == std::isfinite(found);
        }
        EXPECT_TRUE(near_outline) << x << " " << y;
      } else if (expected > 0.0) {
        EXPECT_NEAR(found, expected, 1e-4 * expected) << x << " " << y;
        ++seen;
      }
    }
  }
  EXPECT_GT(seen, 800);
}

TEST(RasterDepth, IsThatOfTheRayInPerspective) {
  expect_traced_depth(sphere(Vec3(0.1F, 0.4F, 0.0F), 0.6F, 12), three_quarter());
}

TEST(RasterDepth, IsThatOfTheRayInOrthographicProjection) {
  CameraSettings settings = three_quarter();
  settings.orthographic = 1.6F;
  expect_traced_depth(sphere(Vec3(0.1F, 0.4F, 0.0F), 0.6F, 12), settings);
}

TEST(RasterDepth, OfAPlaneAtAGlance) {
  // Nearly edge-on, from 1 m to 9 m in one picture.
  expect_traced_depth(rectangle(Vec3(0.0F, -0.35F, 0.0F), 20.0F * Vec3::UnitZ(), 20.0F * Vec3::UnitX()),
                      three_quarter());
}

TEST(RasterDepth, OfASphereMeetsItsOutline) {
  RenderScene scene = empty_scene();
  scene.meshes = {sphere(Vec3::Zero(), 0.5F, 96)};
  CameraSettings settings;
  settings.position = Vec3(0.0F, 0.0F, 2.5F);
  settings.look_at = Vec3::Zero();
  settings.fov = 40.0F;
  const Image image = draw(scene, settings, small_settings(200, 200));
  const Camera camera(settings, 200, 200);
  const float outline = std::asin(0.5F / 2.5F);  // half angle of the cone that touches the sphere
  const float pixel = camera.pixel_size(1.0F);
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      const Vec3 d = camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F).direction;
      const float angle = std::acos(d.dot(camera.forward()));
      if (angle < outline - pixel) {
        EXPECT_TRUE(std::isfinite(depth_at(image, x, y))) << x << " " << y;
      } else if (angle > outline + pixel) {
        EXPECT_EQ(depth_at(image, x, y), infinity) << x << " " << y;
      }
    }
  }
}

// Both back ends tell the same body but along outlines; one behind the ground or another body is not seen.
TEST(BodyId, IsTheSameInBothBackEnds) {
  RenderScene scene = empty_scene();
  scene.ground.enabled = true;
  scene.meshes = {sphere(Vec3(-0.3F, 0.3F, 0), 0.4F, 24),
                  box(Vec3(0.1F, -0.2F, -0.2F), Vec3(0.6F, 0.3F, 0.2F)), sphere(Vec3(0, -0.8F, 0), 0.3F, 12)};
  scene.meshes[0].body_id = 7;
  scene.meshes[1].body_id = 0;
  scene.meshes[2].body_id = 3;
  RenderSettings settings = small_settings();
  settings.channels = {body_id_channel, depth_channel};
  settings.samples = 1;
  std::vector<Image> images;
  for (const char* backend : {"raster", "path"}) {
    settings.backend = backend;
    const auto renderer = make_renderer(settings, 2);
    renderer->set_scene(scene);
    images.push_back(renderer->render(Camera(three_quarter(), settings.width, settings.height), {0, 0.0}));
  }
  const std::vector<float>&a = images[0].find(body_id_channel)->values,
        &b = images[1].find(body_id_channel)->values;
  std::map<float, int> seen;
  int differ = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    differ += a[i] != b[i] ? 1 : 0;
    ++seen[a[i]];
    if (a[i] >= 0) {
      EXPECT_TRUE(std::isfinite(images[0].find(depth_channel)->values[i]));
    }
  }
  EXPECT_LT(differ, 30);
  EXPECT_EQ(seen.size(), 3U);
  EXPECT_GT(seen[-1], 1000);
  EXPECT_GT(seen[7], 300);
  EXPECT_GT(seen[0], 100);
}

TEST(RasterDepth, TheGroundIsADiscAndASurface) {
  RenderScene scene = empty_scene();
  scene.ground.enabled = true;
  scene.ground.height = -0.3F;
  scene.ground.center = Vec3(0.4F, 0.0F, -0.2F);
  scene.ground.radius = 2.0F;
  scene.ground.fade_start = 0.5F;
  for (const bool orthographic : {false, true}) {
    CameraSettings settings = three_quarter();
    if (orthographic) settings.orthographic = 3.0F;
    const Image image = draw(scene, settings, small_settings());
    const Camera camera(settings, 96, 64);
    int inside = 0;
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 96; ++x) {
        const Ray ray = camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
        const double t = (-0.3 - ray.origin.y()) / ray.direction.y();
        const double r = std::hypot(ray.origin.x() + t * ray.direction.x() - 0.4,
                                    ray.origin.z() + t * ray.direction.z() + 0.2);
        const double depth = t * static_cast<double>(ray.direction.dot(camera.forward()));
        if (t > 0.0 && r < 1.999) {
          EXPECT_NEAR(depth_at(image, x, y), depth, 1e-4 * depth) << x << " " << y;
          ++inside;
        } else if (t < 0.0 || r > 2.001) {
          EXPECT_EQ(depth_at(image, x, y), infinity) << x << " " << y;
        }
      }
    }
    EXPECT_GT(inside, 500);
  }
}

}  // namespace depth_test
}  // namespace lagomorph::render::raster
