#include "render/path/scene_geometry.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/unit/render/path/shapes.h"

namespace lagomorph::render::path {
namespace scene_geometry_test {

/// The surface that a ray meets; there is one.
SurfacePoint surface(const SceneGeometry& geometry, const Ray& ray) {
  MeshHit hit;
  geometry.caster().intersect({&ray, 1}, Coherence::incoherent, {&hit, 1});
  EXPECT_NE(hit.mesh, MeshHit::none);
  return geometry.arrive(ray, hit, geometry.meet(ray, hit));
}

RenderScene with(const Mesh& mesh, bool ground = false) {
  RenderScene scene;
  scene.meshes = {mesh};
  scene.ground.enabled = ground;
  return scene;
}

TEST(SceneGeometry, RaysGoOnFromTheSideOfTheirArrival) {
  SceneGeometry geometry(with(make_quad(Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2))));
  geometry.commit();
  const SurfacePoint above = surface(geometry, {Vec3(0.1F, 1.0F, 0.2F), Vec3(0, -1, 0)});
  EXPECT_EQ(above.normal, Vec3(0, 1, 0));
  EXPECT_GT(above.origin.y(), 0.0F);
  EXPECT_LT(above.origin.y(), 1e-4F);
  const SurfacePoint below = surface(geometry, {Vec3(0.1F, -1.0F, 0.2F), Vec3(0, 1, 0)});
  EXPECT_EQ(below.normal, Vec3(0, -1, 0));
  EXPECT_LT(below.origin.y(), 0.0F);
}

TEST(SceneGeometry, RaysDoNotMeetTheSurfaceTheyLeave) {
  // A fan of large and small triangles, far off the origin, left in all directions of the upper hemisphere.
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
  for (const float far : {0.0F, 1.0F, 100.0F}) {
    for (const float size : {0.01F, 1.0F, 50.0F}) {
      const Vec3 n = Vec3(0.3F, 0.9F, -0.2F).normalized();
      const Vec3 u = n.cross(Vec3(1, 0, 0)).normalized();
      Mesh quad = make_quad(Vec3(far, -far, far) - size * (u + n.cross(u)), 2.0F * size * u,
                            2.0F * size * n.cross(u));
      SceneGeometry geometry(with(quad));
      geometry.commit();
      std::vector<Ray> rays;
      for (int i = 0; i < 2000; ++i) {
        const Vec3 target =
            Vec3(far, -far, far) + 0.9F * size * (uniform(random) * u + uniform(random) * n.cross(u));
        const Vec3 from = target + 3.0F * size * n;
        const Vec3 out = (n + 0.999F * Vec3(uniform(random), uniform(random), uniform(random)).normalized());
        rays.push_back({surface(geometry, {from, (target - from).normalized()}).origin, out.normalized()});
      }
      std::vector<MeshHit> hits(rays.size());
      geometry.caster().intersect(rays, Coherence::incoherent, hits);
      for (const MeshHit& hit : hits) ASSERT_EQ(hit.mesh, MeshHit::none) << far << " " << size;
    }
  }
}

TEST(SceneGeometry, DistanceIsThatOfDoublePrecision) {
  const Mesh quad = make_quad(Vec3(-4, 0.3F, 4), Vec3(8, 0.7F, 0), Vec3(0.2F, 0, -8));
  const SceneGeometry geometry(with(quad));
  const Eigen::Vector3d n = Eigen::Vector3d(8, 0.7F, 0).cross(Eigen::Vector3d(0.2F, 0, -8));
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
  for (int i = 0; i < 500; ++i) {
    const Ray ray{Vec3(uniform(random), 5.0F, uniform(random)),
                  Vec3(0.3F * uniform(random), -1.0F, 0.2F).normalized()};
    MeshHit hit;
    geometry.caster().intersect({&ray, 1}, Coherence::incoherent, {&hit, 1});
    ASSERT_EQ(hit.mesh, 0U);
    const TriangleHit at = geometry.meet(ray, hit);
    const double expected = n.dot(quad.positions[0].cast<double>() - ray.origin.cast<double>()) /
                            n.dot(ray.direction.cast<double>());
    EXPECT_NEAR(at.t, expected, 1e-6 * expected);  // the two triangles' planes differ by float's rounding
    EXPECT_TRUE(at.u >= -1e-6 && at.v >= -1e-6 && at.u + at.v <= 1.0 + 1e-6);
  }
}

TEST(SceneGeometry, ACoarseSphereContinuesOnItsSmoothSurface) {
  const float radius = 1.0F;
  SceneGeometry geometry(with(make_sphere(1, radius, Vec3::Zero())));
  geometry.commit();
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  double facet = 0.0, smooth = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 out = Vec3(normal(random), normal(random), normal(random)).normalized();
    const Ray ray{3.0F * out, -out};
    MeshHit hit;
    geometry.caster().intersect({&ray, 1}, Coherence::incoherent, {&hit, 1});
    const TriangleHit at = geometry.meet(ray, hit);
    const SurfacePoint p = geometry.arrive(ray, hit, at);
    EXPECT_GT(p.normal.dot(out), 0.999F);
    facet += std::abs(3.0 - at.t - radius) / 1000.0;
    smooth += std::abs(p.origin.norm() - radius) / 1000.0;
    // A ray along the sphere is free, though facets stand up before it.
    const Ray along{p.origin, (out.cross(Vec3(1, 2, 3)).normalized() + 0.01F * out).normalized()};
    geometry.caster().intersect({&along, 1}, Coherence::incoherent, {&hit, 1});
    EXPECT_EQ(hit.mesh, MeshHit::none);
  }
  EXPECT_LT(smooth, 0.25 * facet);
}

/// A sphere on an arc, turning, in three straight pieces.
Vec3 on_its_way(const Vec3& x, float t) {
  const Eigen::AngleAxisf turn(1.2F * t, Vec3(0.3F, 1.0F, 0.2F).normalized());
  return turn * x + Vec3(std::cos(2.0F * t), std::sin(2.0F * t), 0.5F * t);
}

/// Hits at a time are those of the mesh that stands where Embree's time steps have it then.
TEST(SceneGeometry, WhatMovesIsMetWhereItIsAtTheRaysTime) {
  constexpr int segments = 3;
  const Mesh sphere = make_sphere(2, 0.7F, Vec3::Zero());
  RenderScene scene = with(sphere);
  scene.motion_segments = segments;
  SceneGeometry geometry(scene);
  std::vector<std::vector<Vec3>> steps(segments + 1, sphere.positions);
  for (int step = 0; step <= segments; ++step)
    for (Vec3& x : steps[static_cast<std::size_t>(step)])
      x = on_its_way(x, static_cast<float>(step) / segments);
  geometry.move(0, steps.back());
  geometry.set_motion(0, std::span(steps).first(segments));
  geometry.commit();
  std::mt19937 random(6);
  std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
  int met = 0;
  for (int i = 0; i < 1500; ++i) {
    const float time = i == 0 ? 1.0F : 0.5F + 0.4999F * uniform(random);
    const int step = std::min(static_cast<int>(time * segments), segments - 1);
    const float part = time * segments - static_cast<float>(step);
    Mesh there = sphere;
    Vec3 middle = Vec3::Zero();
    for (std::size_t k = 0; k < there.positions.size(); ++k) {
      const Vec3 &a = steps[static_cast<std::size_t>(step)][k],
                 &b = steps[static_cast<std::size_t>(step) + 1][k];
      there.positions[k] = a + part * (b - a);
      middle += there.positions[k] / static_cast<float>(there.positions.size());
    }
    Ray ray{Vec3(3.0F * uniform(random), 3.0F * uniform(random), 4.0F), Vec3::Zero()};
    const Vec3 target = middle + 0.6F * Vec3(uniform(random), uniform(random), uniform(random));
    ray.direction = (target - ray.origin).normalized();
    ray.time = time;
    MeshHit hit, of_still;
    geometry.caster().intersect({&ray, 1}, Coherence::incoherent, {&hit, 1});
    RenderScene stands = with(there);
    SceneGeometry still(stands);
    still.commit();
    still.caster().intersect({&ray, 1}, Coherence::incoherent, {&of_still, 1});
    ASSERT_EQ(hit.mesh == MeshHit::none, of_still.mesh == MeshHit::none) << i;
    if (hit.mesh == MeshHit::none) continue;
    const TriangleHit at = geometry.meet(ray, hit), expected = still.meet(ray, of_still);
    ASSERT_NEAR(at.t, expected.t, 1e-4) << i;
    ASSERT_TRUE(at.u >= -1e-4 && at.v >= -1e-4 && at.u + at.v <= 1.0 + 1e-4) << i;
    const SurfacePoint p = geometry.arrive(ray, hit, at), q = still.arrive(ray, of_still, expected);
    ASSERT_LT((p.origin - q.origin).norm(), 2e-3F) << i;
    // Normals are those of the time steps, turned on between them.
    ASSERT_GT(p.unbent.dot(q.unbent), 0.995F) << i;
    ASSERT_GT(p.unbent.dot((p.origin - middle).normalized()), 0.98F) << i;
    ASSERT_LT(
        (geometry.behind(ray, hit, at) - (ray.origin + static_cast<float>(at.t) * ray.direction)).norm(),
        1e-3F);
    ++met;
  }
  EXPECT_GT(met, 800);
}

TEST(SceneGeometry, AHollowContinuesOnItsFacets) {
  // Seen from inside, the smooth surface lies behind the facets: rays start on these.
  SceneGeometry geometry(with(make_sphere(1, 1.0F, Vec3::Zero())));
  geometry.commit();
  const Ray ray{Vec3(0.1F, 0.05F, 0.0F), Vec3(0.3F, 0.9F, 0.2F).normalized()};
  MeshHit hit;
  geometry.caster().intersect({&ray, 1}, Coherence::incoherent, {&hit, 1});
  const TriangleHit at = geometry.meet(ray, hit);
  const Vec3 point = ray.origin + static_cast<float>(at.t) * ray.direction;
  EXPECT_LT((geometry.arrive(ray, hit, at).origin - point).norm(), 1e-4F);
}

TEST(SceneGeometry, FlatMeshesHaveTheNormalOfTheTriangle) {
  Mesh sphere = make_sphere(1, 1.0F, Vec3::Zero());
  sphere.smooth = false;
  SceneGeometry geometry(with(sphere));
  geometry.commit();
  const Ray ray{Vec3(0.2F, 3.0F, 0.1F), Vec3(0, -1, 0)};
  MeshHit hit;
  geometry.caster().intersect({&ray, 1}, Coherence::incoherent, {&hit, 1});
  const Triangle& t = sphere.triangles[hit.triangle];
  const Vec3 e1 = sphere.positions[t[1]] - sphere.positions[t[0]],
             e2 = sphere.positions[t[2]] - sphere.positions[t[0]];
  EXPECT_LT((surface(geometry, ray).normal - e1.cross(e2).normalized()).norm(), 1e-6F);
}

TEST(SceneGeometry, GroundIsADiscSeenFromBothSides) {
  RenderScene scene;
  scene.ground.height = 0.5F;
  scene.ground.center = Vec3(1.0F, 9.0F, 2.0F);
  scene.ground.radius = 3.0F;
  scene.ground.fade_start = 1.0F;
  const SceneGeometry geometry(scene);
  const Vec3 down = Vec3(0.6F, -0.8F, 0.0F);
  EXPECT_NEAR(geometry.meet_ground({Vec3(0, 2.5F, 2), down}), 2.5, 1e-6);
  EXPECT_NEAR(geometry.meet_ground({Vec3(0, -1.5F, 2), Vec3(0.6F, 0.8F, 0.0F)}), 2.5, 1e-6);
  EXPECT_EQ(geometry.meet_ground({Vec3(0, 2.5F, 2), -down}), SceneGeometry::never);
  EXPECT_EQ(geometry.meet_ground({Vec3(0, 2.5F, 2), Vec3(1, 0, 0)}), SceneGeometry::never);
  EXPECT_LT(geometry.meet_ground({Vec3(3.99F, 1, 2), Vec3(0, -1, 0)}), 1.0);
  EXPECT_EQ(geometry.meet_ground({Vec3(4.01F, 1, 2), Vec3(0, -1, 0)}), SceneGeometry::never);
  EXPECT_EQ(geometry.ground_point({Vec3(0, 2.5F, 2), down}, 2.5), Vec3(1.5F, 0.5F, 2.0F));
  const SurfacePoint p = geometry.arrive_at_ground({Vec3(0, 2.5F, 2), down}, 2.5);
  EXPECT_EQ(p.normal, Vec3(0, 1, 0));
  EXPECT_GT(p.origin.y(), 0.5F);
}

TEST(SceneGeometry, ABodyOnTheGroundSeesNothingThroughIt) {
  // A point of its underside, looking down: the ground is met at once.
  SceneGeometry geometry(with(make_box(Vec3(-1, 0, -1), Vec3(1, 1, 1)), true));
  geometry.commit();
  const Ray from_below{Vec3(0.3F, -1.0F, 0.2F), Vec3(0, 1, 0)};
  MeshHit hit;
  geometry.caster().intersect({&from_below, 1}, Coherence::incoherent, {&hit, 1});
  const SurfacePoint p = geometry.arrive(from_below, hit, geometry.meet(from_below, hit));
  EXPECT_EQ(geometry.meet_ground({p.origin, Vec3(0, -1, 0)}), 0.0);
}

}  // namespace scene_geometry_test
}  // namespace lagomorph::render::path
