#include "render/path/bsdf.h"

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/render/path/directions.h"

namespace lagomorph::render::path {
namespace bsdf_test {

Material white(float roughness = 0.5F) {
  Material m;
  m.base_color = Color::Ones();
  m.roughness = roughness;
  return m;
}

double flux(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi, const Brdf::Value& value) {
  return static_cast<double>(value.f_cos.y()) * bsdf.index_squared(wo, wi);
}

/// Mean over the samples.
double sampled_albedo(const Bsdf& bsdf, const Vec3& wo) {
  const int n = 65536;
  const FrameSamples numbers(5, 0, n);
  const Bsdf::View view = bsdf.view(wo, 0.0F);
  double sum = 0.0;
  for (int k = 0; k < n; ++k) {
    const PathSamples p = numbers.path(0, 0, k);
    const Bsdf::Sample s = bsdf.sample(view, p.pair(0), p.pair(1), p.pair(2));
    if (s.value.pdf > 0.0F) sum += flux(bsdf, wo, s.direction, s.value) / s.value.pdf / n;
  }
  return sum;
}

double integrated_albedo(const Bsdf& bsdf, const Vec3& wo) {
  const Bsdf::View view = bsdf.view(wo, 0.0F);
  return sphere([&](const Vec3& wi, double) { return flux(bsdf, wo, wi, bsdf.evaluate(view, wi)); });
}

std::vector<Material> layered() {
  std::vector<Material> all;
  const auto add = [&](const std::function<void(Material&)>& change) {
    Material m = white();
    change(m);
    all.push_back(m);
  };
  add([](Material& m) { m.coat = 1.0F, m.coat_roughness = 0.4F; });
  add([](Material& m) { m.coat = 0.5F, m.coat_roughness = 0.7F, m.metallic = 1.0F; });
  add([](Material& m) { m.coat = 1.0F, m.coat_roughness = 0.4F, m.metallic = 1.0F, m.roughness = 1.0F; });
  add([](Material& m) { m.sheen = 1.0F; });
  add([](Material& m) { m.sheen = 1.0F, m.metallic = 1.0F; });
  add([](Material& m) { m.sheen = 1.0F, m.sheen_roughness = 0.2F; });
  add([](Material& m) { m.sheen = 0.7F, m.sheen_roughness = 1.0F, m.coat = 1.0F, m.coat_roughness = 0.5F; });
  add([](Material& m) { m.transmission = 0.5F; });
  add([](Material& m) { m.transmission = 1.0F, m.coat = 1.0F, m.coat_roughness = 0.5F, m.roughness = 0.6F; });
  add([](Material& m) { m.transmission = 0.6F, m.metallic = 0.3F, m.sheen = 0.4F; });
  return all;
}

TEST(Bsdf, WithoutLayersItIsTheBrdf) {
  const Material m = white(0.3F);
  const Bsdf bsdf(m);
  const Brdf brdf(m);
  EXPECT_FALSE(bsdf.has_layers());
  const Vec3 wo = direction(0.4, 0.2), wi = direction(0.7, 2.0);
  const Brdf::Value a = bsdf.evaluate(bsdf.view(wo, 0.0F), wi), b = brdf.evaluate(brdf.view(wo), wi);
  EXPECT_EQ(a.f_cos.y(), b.f_cos.y());
  EXPECT_EQ(a.pdf, b.pdf);
  EXPECT_EQ(bsdf.sample(bsdf.view(wo, 0.0F), {0.3F, 0.6F}, {}, {}).direction,
            brdf.sample(brdf.view(wo), {0.3F, 0.6F}).direction);
}

TEST(Bsdf, LayersOverAWhiteBaseLoseNothing) {
  for (const Material& m : layered()) {
    const Bsdf bsdf(m);
    for (const double cosine : {0.03, 0.1, 0.3, 0.6, 1.0, -0.1, -0.6, -1.0}) {
      if (cosine < 0.0 && m.transmission == 0.0F) continue;
      EXPECT_NEAR(sampled_albedo(bsdf, direction(cosine, 0.3)), 1.0, 0.01)
          << m.coat << " " << m.sheen << " " << m.transmission << " " << m.metallic << " " << cosine;
    }
  }
}

/// Of a base of albedo r what the layers reflect back is reflected again, so that it is less than r times as
/// bright.
TEST(Bsdf, LayersMakeADarkBaseDarker) {
  Material m = white(1.0F);
  m.ior = 1.0F;
  m.base_color = Color::Constant(0.5F);
  m.sheen_tint = Color::Zero();
  m.coat = 1.0F;
  const Bsdf half(m);
  m.base_color = Color::Zero();
  const Bsdf coat(m);
  for (const double cosine : {0.3, 0.9}) {
    const Vec3 wo = direction(cosine, 0.3);
    const double of_coat = sampled_albedo(coat, wo);
    const double of_base = sampled_albedo(half, wo) - of_coat;
    EXPECT_LT(of_base, 0.5 * (1.0 - of_coat));
    EXPECT_GT(of_base, 0.45 * (1.0 - of_coat));
  }
}

TEST(Bsdf, AClearInsideUnderNoLayerLosesNothing) {
  Material m = white(0.5F);
  m.transmission = 0.5F;
  const Bsdf bsdf(m);
  for (const double cosine : {0.1, 0.6, 1.0, -0.4, -0.9})
    EXPECT_NEAR(sampled_albedo(bsdf, direction(cosine, 0.3)), 1.0, 0.01) << cosine;
}

TEST(Bsdf, SamplesGiveTheIntegral) {
  for (const Material& m : layered()) {
    const Bsdf bsdf(m);
    for (const double cosine : {0.15, 0.8}) {
      const Vec3 wo = direction(cosine, 0.3);
      const double expected = integrated_albedo(bsdf, wo);
      EXPECT_NEAR(sampled_albedo(bsdf, wo), expected, 6e-3)
          << m.coat << " " << m.sheen << " " << m.transmission;
    }
  }
}

TEST(Bsdf, DensitiesIntegrateToOneLessWhatFails) {
  for (const Material& m : layered()) {
    const Bsdf bsdf(m);
    for (const double cosine : {0.25, 0.8}) {
      const Vec3 wo = direction(cosine, 0.3);
      const Bsdf::View view = bsdf.view(wo, 0.0F);
      const double total = sphere([&](const Vec3& wi, double) { return bsdf.evaluate(view, wi).pdf; });
      const int n = 65536;
      const FrameSamples numbers(6, 0, n);
      double there = 0.0;
      Eigen::Vector3d mean = Eigen::Vector3d::Zero(), expected = Eigen::Vector3d::Zero();
      for (int k = 0; k < n; ++k) {
        const PathSamples p = numbers.path(0, 0, k);
        const Bsdf::Sample s = bsdf.sample(view, p.pair(0), p.pair(1), p.pair(2));
        if (s.value.pdf <= 0.0F) continue;
        there += 1.0 / n;
        mean += s.direction.cast<double>() / n;
      }
      sphere([&](const Vec3& wi, double solid_angle) {
        expected += wi.cast<double>() * bsdf.evaluate(view, wi).pdf * solid_angle;
        return 0.0;
      });
      EXPECT_NEAR(total, there, 4e-3) << m.coat << " " << m.sheen << " " << m.transmission << " " << cosine;
      EXPECT_LT((mean - expected).norm(), 5e-3) << m.coat << " " << m.sheen << " " << m.transmission;
    }
  }
}

TEST(Bsdf, LayersAreReciprocal) {
  for (const Material& m : layered()) {
    const Bsdf bsdf(m);
    for (const double a : {0.2, 0.7, -0.5}) {
      for (const double b : {0.4, 0.9, -0.8}) {
        if (m.transmission == 0.0F && (a < 0.0 || b < 0.0)) continue;
        const Vec3 o = direction(a, 0.5), i = direction(b, 3.2);
        const auto f = [&](const Vec3& x, const Vec3& y) {
          return static_cast<double>(bsdf.evaluate(bsdf.view(x, 0.0F), y).f_cos.y()) / std::abs(y.z());
        };
        const double there = f(o, i) * bsdf.index_squared(o, i), back = f(i, o);
        EXPECT_NEAR(there, back, 2e-4 * there + 1e-6) << m.coat << " " << m.sheen << " " << m.transmission;
      }
    }
  }
}

TEST(Bsdf, ACoatShinesOverARoughBase) {
  Material m = white(1.0F);
  m.base_color = Color::Zero();
  const Bsdf rough(m);
  m.coat = 1.0F;
  m.coat_roughness = 0.1F;
  const Bsdf coated(m);
  const Vec3 wo = direction(0.8, 0.0), mirror(-wo.x(), -wo.y(), wo.z());
  EXPECT_GT(coated.evaluate(coated.view(wo, 0.0F), mirror).f_cos.y(),
            100.0F * rough.evaluate(rough.view(wo, 0.0F), mirror).f_cos.y());
}

TEST(Bsdf, SheenIsBrightestAlongTheSilhouette) {
  Material m = white(1.0F);
  m.base_color = Color::Zero();
  m.ior = 1.0F;
  m.sheen = 1.0F;
  m.sheen_tint = Color(1.0F, 0.5F, 0.0F);
  const Bsdf bsdf(m);
  EXPECT_GT(integrated_albedo(bsdf, direction(0.05, 0.0)),
            3.0 * integrated_albedo(bsdf, direction(0.9, 0.0)));
  const Color f = bsdf.evaluate(bsdf.view(direction(0.3, 0.0), 0.0F), direction(0.4, 2.0)).f_cos;
  EXPECT_NEAR(f.y(), 0.5F * f.x(), 1e-6F);
  EXPECT_EQ(f.z(), 0.0F);
}

}  // namespace bsdf_test
}  // namespace lagomorph::render::path
