#include "render/path/surface_rows.h"

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "render/path/brdf.h"
#include "render/path/light.h"
#include "render/path/scene_geometry.h"
#include "tests/unit/render/path/shapes.h"

/// Vector code against the same formulas one lane at a time: to the bit, whatever the instruction set.
namespace lagomorph::render::path {
namespace surface_rows_test {

constexpr std::size_t count = 301;  // no multiple of any vector's width

const Material rubber{Color(0.7F, 0.4F, 0.2F), 0.3F, 0.2F, 1.5F};
const GroundDisc ground{0.0F, 0.1F, -0.2F, 5.0F, 2.0F, 25.0};

Vec3 above(const Vec3& n, std::mt19937& random) {
  std::normal_distribution<float> normal;
  const Vec3 d = Vec3(normal(random), normal(random), normal(random)).normalized();
  return d.dot(n) < 0.0F ? Vec3(-d) : d;
}

/// Surfaces all over, seen from above them.
std::unique_ptr<SurfaceRows> surfaces(const Brdf& brdf) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-2.0F, 2.0F);
  auto s = std::make_unique<SurfaceRows>();
  s->count = count;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 n = above(Vec3::UnitY(), random);
    s->alive[i] = 1;
    s->number[i] = reverse_bits(static_cast<std::uint32_t>(i));
    s->throughput.set(i, {0.9F, 0.5F, 0.2F});
    s->least_pdf[i] = i % 3 == 0 ? 0.4F : std::numeric_limits<float>::infinity();
    s->base_color.set(i, brdf.constants().base_color);
    s->origin.set(i, {place(random), 0.5F + std::abs(place(random)), place(random)});
    s->n.set(i, f3(n));
    s->arrival.set(i, f3(Vec3(-above(n, random))));
  }
  view_surfaces(brdf.constants(), coat_albedo_by_roughness(), {0, count}, *s);
  return s;
}

void expect_same(F3 a, const Vec3& b) {
  EXPECT_EQ(a.x, b.x());
  EXPECT_EQ(a.y, b.y());
  EXPECT_EQ(a.z, b.z());
}

TEST(SurfaceRows, NumbersAreThoseOfThePaths) {
  const PathSamples first(77, 0U);
  Row<std::uint32_t> numbers;
  Row<float> u, v;
  for (std::size_t i = 0; i < count; ++i)
    numbers[i] = PathSamples(77, static_cast<std::uint32_t>(i)).number();
  draw_pairs(pair_keys(first.key(), 9), count, numbers.data(), u.data(), v.data());
  for (std::size_t i = 0; i < count; ++i) {
    const Pair pair = PathSamples(77, static_cast<std::uint32_t>(i)).pair(9);
    EXPECT_EQ(u[i], pair.u);
    EXPECT_EQ(v[i], pair.v);
  }
}

TEST(SurfaceRows, RaysMeetAndArriveAsOneByOne) {
  RenderScene scene;
  scene.meshes = two_spheres();
  scene.meshes[1].smooth = true;
  SceneGeometry geometry(scene);
  geometry.commit();
  const std::vector<Ray> rays = random_rays(batch_size, 4);
  std::vector<MeshHit> hits(rays.size());
  geometry.caster().intersect(rays, Coherence::incoherent, hits);
  for (std::uint32_t mesh = 0; mesh < 2; ++mesh) {
    const auto m = std::make_unique<Meetings>();
    std::vector<std::size_t> of;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (hits[i].mesh != mesh) continue;
      m->origin.set(of.size(), f3(rays[i].origin));
      m->direction.set(of.size(), f3(rays[i].direction));
      geometry.put_corners(hits[i], 1.0F, *m, of.size());
      of.push_back(i);
    }
    m->count = of.size();
    ASSERT_GT(m->count, 20U);
    meet_triangles(*m);
    const auto s = std::make_unique<SurfaceRows>();
    arrive_on_mesh(*m, {0, m->count}, geometry.is_smooth(mesh), geometry.ground(), *s);
    for (std::size_t k = 0; k < of.size(); ++k) {
      const Ray& ray = rays[of[k]];
      const TriangleHit at = geometry.meet(ray, hits[of[k]]);
      EXPECT_EQ(m->t[k], at.t);
      EXPECT_EQ(m->u[k], at.u);
      EXPECT_EQ(m->v[k], at.v);
      const SurfacePoint point = geometry.arrive(ray, hits[of[k]], at);
      expect_same(s->origin[k], point.origin);
      expect_same(s->n[k], point.normal);
      expect_same(s->unbent[k], point.unbent);
    }
  }
}

TEST(SurfaceRows, LightIsWeighedAsOneByOne) {
  const Brdf brdf(rubber);
  const auto s = surfaces(brdf);
  AreaLight of;
  of.position = Vec3(1.0F, 3.0F, 0.5F);
  of.look_at = Vec3(0.0F, 0.0F, 0.0F);
  const RectangleLight light(of);
  const auto pairs = std::make_unique<PairRows>();
  draw_pairs(pair_keys(5, 2), count, s->number.data(), pairs->u.data(), pairs->v.data());
  const auto arriving = std::make_unique<ArrivingRows>();
  const auto which = std::make_unique<SurfaceRow<std::uint32_t>>();
  which->fill(0);
  sample_light(light.shape(), f3(light.radiance()), 0.5F, 0, *which, *s, *pairs, *arriving);
  weigh_light(brdf.constants(), {0, count}, *s, ground, *arriving);
  int kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const RectangleLight::Sample to = light.sample(vec3(s->origin[i]), {pairs->u[i], pairs->v[i]});
    const Vec3 wi(dot(f3(to.direction), s->t[i]), dot(f3(to.direction), s->b[i]),
                  dot(f3(to.direction), s->n[i]));
    const Brdf::View view{s->view(i), 0.0F};
    const Brdf::Value f = brdf.evaluate(view, wi);
    if (to.pdf <= 0.0F || f.pdf <= 0.0F) {
      EXPECT_EQ(arriving->kept[i], 0U);
      continue;
    }
    ++kept;
    EXPECT_EQ(arriving->kept[i], 1U);
    const float pdf = 0.5F * to.pdf;
    const float weight = pdf * pdf / (pdf * pdf + f.pdf * f.pdf) / pdf;
    const Color expected = weight * light.radiance() * f.f_cos * color(s->throughput[i]);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(color(arriving->radiance[i])[c], expected[c], 1e-5F * expected.maxCoeff());
  }
  EXPECT_GT(kept, 100);
}

TEST(SurfaceRows, ScatteringIsThatOfTheBrdf) {
  const Brdf brdf(rubber);
  const auto s = surfaces(brdf);
  const auto pairs = std::make_unique<PairRows>();
  draw_pairs(pair_keys(5, 3), count, s->number.data(), pairs->u.data(), pairs->v.data());
  const auto to = std::make_unique<ScatterRows>();
  scatter_surfaces(brdf.constants(), {0, count}, *s, *pairs, *to);
  for (std::size_t i = 0; i < count; ++i) {
    const Brdf::View view{s->view(i), 0.0F};
    const Brdf::Sample sample = brdf.sample(view, {pairs->u[i], pairs->v[i]});
    EXPECT_EQ(to->pdf[i], sample.value.pdf);
    if (sample.value.pdf <= 0.0F) continue;
    const F3 d = f3(sample.direction);
    expect_same(to->direction[i], vec3(d.x * s->t[i] + d.y * s->b[i] + d.z * s->n[i]));
  }
}

/// Lanes that hold no surface have any numbers, and none of them may do harm.
TEST(SurfaceRows, NotANumberIsNoLight) {
  const Brdf brdf(rubber);
  const auto s = surfaces(brdf);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto arriving = std::make_unique<ArrivingRows>();
  const auto pairs = std::make_unique<PairRows>();
  const auto to = std::make_unique<ScatterRows>();
  pairs->u.fill(0.3F);
  pairs->v.fill(0.7F);
  for (std::size_t i = 0; i < count; ++i) {
    arriving->set(i, {nan, nan, nan}, 1.0F, 1.0F, {1.0F, 1.0F, 1.0F});
    if (i % 2 == 0) s->wo.set(i, {nan, nan, nan});
  }
  weigh_light(brdf.constants(), {0, count}, *s, ground, *arriving);
  scatter_surfaces(brdf.constants(), {0, count}, *s, *pairs, *to);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(arriving->kept[i], 0U);
    EXPECT_TRUE(i % 2 != 0 || to->pdf[i] == 0.0F) << i;
  }
}

}  // namespace surface_rows_test
}  // namespace lagomorph::render::path
