#include "render/path/ray_caster.h"

#include <limits>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "render/path/scene_geometry.h"
#include "tests/unit/render/path/shapes.h"

namespace lagomorph::render::path {
namespace ray_caster_test {

/// Distance to the nearest triangle by trying all, in double precision; infinite where there is none.
double nearest(const std::vector<Mesh>& meshes, const Ray& ray) {
  double best = std::numeric_limits<double>::infinity();
  for (const Mesh& m : meshes) {
    for (const Triangle& t : m.triangles) {
      Eigen::Matrix3d system;
      system.col(0) = (m.positions[t[1]] - m.positions[t[0]]).cast<double>();
      system.col(1) = (m.positions[t[2]] - m.positions[t[0]]).cast<double>();
      system.col(2) = -ray.direction.cast<double>();
      const Eigen::Vector3d s = system.inverse() * (ray.origin - m.positions[t[0]]).cast<double>();
      if (s[0] >= 0.0 && s[1] >= 0.0 && s[0] + s[1] <= 1.0 && s[2] > 0.0) best = std::min(best, s[2]);
    }
  }
  return best;
}

std::vector<Vec3> squashed(const Mesh& mesh, float amount) {
  std::vector<Vec3> positions = mesh.positions;
  for (Vec3& p : positions)
    p = Vec3(p.x() * (1.0F + amount), p.y() * (1.0F - amount) + amount * p.x(), p.z());
  return positions;
}

TEST(RayCaster, MeetsWhatTryingAllTrianglesMeets) {
  RenderScene scene;
  scene.meshes = two_spheres();
  SceneGeometry geometry(scene);
  for (const float amount : {0.0F, 0.3F}) {  // built, then refitted
    for (int k = 0; k < 2; ++k) {
      const auto i = static_cast<std::size_t>(k);
      scene.meshes[i].positions = squashed(scene.meshes[i], amount);
      geometry.move(k, scene.meshes[i].positions);
    }
    geometry.commit();
    const std::vector<Ray> rays = random_rays(3003, 5);
    for (const Coherence coherence : {Coherence::coherent, Coherence::incoherent}) {
      std::vector<MeshHit> hits(rays.size());
      geometry.caster().intersect(rays, coherence, hits);
      int met = 0;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const double expected = nearest(scene.meshes, rays[i]);
        const bool hit = hits[i].mesh != MeshHit::none;
        ASSERT_EQ(hit, std::isfinite(expected)) << i;
        if (!hit) continue;
        ++met;
        EXPECT_NEAR(geometry.meet(rays[i], hits[i]).t, expected, 1e-6 * expected);
      }
      EXPECT_GT(met, 1000);
      EXPECT_LT(met, 2900);
    }
  }
}

TEST(RayCaster, SomethingIsInTheWayBeforeTheDistanceOnly) {
  RenderScene scene;
  scene.meshes = two_spheres();
  const SceneGeometry geometry(scene);
  const auto rows = std::make_unique<RayRows>();
  rows->time.fill(1.0F);
  for (const double part : {0.999, 1.001}) {
    rows->count = 0;
    std::vector<std::uint8_t> expected;
    for (const Ray& ray : random_rays(batch_size - 11, 6)) {  // the last packet is not full
      const double t = nearest(scene.meshes, ray);
      const std::size_t i = rows->count++;
      rows->origin.set(i, f3(ray.origin));
      rows->direction.set(i, f3(ray.direction));
      rows->far[i] = std::isfinite(t) ? static_cast<float>(part * t) : 100.0F;
      expected.push_back(std::isfinite(t) && part > 1.0 ? 1 : 0);
    }
    std::vector<std::uint8_t> blocked(rows->count, 7);
    geometry.caster().occluded(*rows, Coherence::incoherent, blocked);
    EXPECT_EQ(blocked, expected);
  }
}

TEST(RayCaster, ClosedMeshesLetNothingThrough) {
  RenderScene scene;
  scene.meshes = {make_sphere(5, 1.0F, Vec3(0.1F, 0.2F, 0.3F))};
  const SceneGeometry geometry(scene);
  // From inside towards edges, where a careless test leaks.
  std::vector<Ray> rays;
  const Mesh& m = scene.meshes[0];
  const Vec3 origin(0.15F, 0.1F, 0.35F);
  for (const Triangle& t : m.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (const float w : {0.1F, 0.5F, 0.7F}) {
        const Vec3 on_edge = (1.0F - w) * m.positions[t[k]] + w * m.positions[t[(k + 1) % 3]];
        rays.push_back({origin, (on_edge - origin).normalized()});
      }
    }
  }
  std::vector<MeshHit> hits(rays.size());
  geometry.caster().intersect(rays, Coherence::incoherent, hits);
  for (std::size_t i = 0; i < rays.size(); ++i) ASSERT_EQ(hits[i].mesh, 0U) << i;
}

TEST(RayCaster, NothingToMeet) {
  Mesh empty;
  empty.name = "empty";
  RenderScene scene;
  scene.meshes = {empty};
  SceneGeometry geometry(scene);
  geometry.move(0, {});
  geometry.commit();
  const std::vector<Ray> rays = random_rays(3, 7);
  std::vector<MeshHit> hits(3, {0, 0});
  geometry.caster().intersect(rays, Coherence::coherent, hits);
  for (const MeshHit& hit : hits) EXPECT_EQ(hit.mesh, MeshHit::none);
  EXPECT_NE(geometry.caster().description().find("Embree 3."), std::string::npos);
  EXPECT_NE(geometry.caster().description().find("isa="), std::string::npos);
}

}  // namespace ray_caster_test
}  // namespace lagomorph::render::path
