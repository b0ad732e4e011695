#include "render/path/dielectric.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/render/path/directions.h"

namespace lagomorph::render::path {
namespace dielectric_test {

constexpr double pi = std::numbers::pi;

/// n^2 of the sides of wi over wo: what radiance gains on its way, and a furnace must not count.
double gained(double ior, const Vec3& wo, const Vec3& wi) {
  if ((wo.z() > 0.0F) == (wi.z() > 0.0F)) return 1.0;
  return wi.z() < 0.0F ? ior * ior : 1.0 / (ior * ior);
}

struct Sampled {
  double albedo = 0.0;  // of flux
  double failed = 0.0;  // part without a direction
};
Sampled sampled(const Dielectric& glass, const Vec3& wo, float least_alpha = 0.0F) {
  const int n = 65536;
  const FrameSamples numbers(7, 0, n);
  const Dielectric::View view = glass.view(wo, least_alpha);
  Sampled sum;
  for (int k = 0; k < n; ++k) {
    const PathSamples p = numbers.path(0, 0, k);
    const Brdf::Sample s = glass.sample(view, p.pair(0), p.pair(1));
    if (s.value.pdf > 0.0F) {
      sum.albedo +=
          static_cast<double>(s.value.f_cos.y()) / s.value.pdf * gained(glass.ior(), wo, s.direction) / n;
    } else {
      sum.failed += 1.0 / n;
    }
  }
  return sum;
}

TEST(Fresnel, MeetsItsClosedForms) {
  for (const double n : {1.1, 1.5, 2.4}) {
    const double normal = std::pow((n - 1.0) / (n + 1.0), 2.0);
    EXPECT_NEAR(fresnel(1.0F, static_cast<float>(n)), normal, 1e-6);
    EXPECT_NEAR(fresnel(1.0F, static_cast<float>(1.0 / n)), normal, 1e-6);
    EXPECT_NEAR(fresnel(1e-6F, static_cast<float>(n)), 1.0, 1e-4);
    // At Brewster's angle only s is reflected: half of ((n^2 - 1) / (n^2 + 1))^2.
    const double brewster = std::cos(std::atan(n));
    const double s = std::pow((n * n - 1.0) / (n * n + 1.0), 2.0);
    EXPECT_NEAR(fresnel(static_cast<float>(brewster), static_cast<float>(n)), 0.5 * s, 1e-5);
    const double critical = std::sqrt(1.0 - 1.0 / (n * n));
    EXPECT_EQ(fresnel(static_cast<float>(critical * 0.99), static_cast<float>(1.0 / n)), 1.0F);
    EXPECT_LT(fresnel(static_cast<float>(critical * 1.01), static_cast<float>(1.0 / n)), 1.0F);
  }
}

TEST(Dielectric, NoLightIsLostOrMade) {
  for (const float ior : {1.05F, 1.33F, 1.5F, 2.4F}) {
    for (const float roughness : {0.05F, 0.2F, 0.4F, 0.6F, 0.8F, 1.0F}) {
      const Dielectric glass(ior, roughness);
      for (const double cosine : {0.03, 0.15, 0.4, 0.7, 1.0, -0.03, -0.15, -0.4, -0.7, -1.0}) {
        EXPECT_NEAR(sampled(glass, direction(cosine, 0.4)).albedo, 1.0, 0.01)
            << ior << " " << roughness << " " << cosine;
      }
    }
  }
}

TEST(Dielectric, RoughenedItLosesNoLight) {
  for (const float roughness : {0.05F, 0.5F}) {
    const Dielectric glass(1.5F, roughness);
    for (const float least : {0.1F, 0.33F, 0.5F}) {
      for (const double cosine : {0.1, 0.6, -0.3, -0.9}) {
        EXPECT_NEAR(sampled(glass, direction(cosine, 0.4), least).albedo, 1.0, 0.01)
            << roughness << " " << least << " " << cosine;
      }
    }
  }
}

TEST(Dielectric, EvaluatedItScattersAllLightToo) {
  for (const float roughness : {0.4F, 0.7F, 1.0F}) {
    const Dielectric glass(1.5F, roughness);
    for (const double cosine : {0.1, 0.5, 1.0, -0.2, -0.6, -0.95}) {
      const Vec3 wo = direction(cosine, 0.4);
      const Dielectric::View view = glass.view(wo);
      const double albedo = sphere(
          [&](const Vec3& wi, double) { return glass.evaluate(view, wi).f_cos.y() * gained(1.5, wo, wi); });
      EXPECT_NEAR(albedo, 1.0, 0.01) << roughness << " " << cosine;
    }
  }
}

TEST(Dielectric, DensityAndSamplesAgree) {
  const int rings = 16, spokes = 16;
  for (const float roughness : {0.35F, 0.6F, 1.0F}) {
    const Dielectric glass(1.5F, roughness);
    for (const double cosine : {0.2, 0.8, -0.3, -0.85}) {
      const Vec3 wo = direction(cosine, 1.0);
      const Dielectric::View view = glass.view(wo);
      const auto cell = [&](const Vec3& w) {
        const double phi = std::atan2(w.y(), w.x()) / (2.0 * pi);
        const int ring = std::min(static_cast<int>((0.5 + 0.5 * w.z()) * rings), rings - 1);
        const int spoke = std::min(static_cast<int>((phi - std::floor(phi)) * spokes), spokes - 1);
        return static_cast<std::size_t>(ring * spokes + spoke);
      };
      std::vector<double> expected(rings * spokes, 0.0), count(rings * spokes, 0.0);
      const double total = sphere([&](const Vec3& wi, double solid_angle) {
        const double pdf = glass.evaluate(view, wi).pdf;
        expected[cell(wi)] += pdf * solid_angle;
        return pdf;
      });
      const int n = 1 << 18;
      const FrameSamples numbers(1, 0, 65536);
      double failed = 0.0;
      for (int k = 0; k < n; ++k) {
        const PathSamples p = numbers.path(k >> 16, 0, k & 65535);
        const Brdf::Sample s = glass.sample(view, p.pair(0), p.pair(1));
        if (s.value.pdf <= 0.0F) {
          failed += 1.0 / n;
          continue;
        }
        EXPECT_NEAR(s.direction.norm(), 1.0F, 1e-4F);
        const Brdf::Value again = glass.evaluate(view, s.direction);
        EXPECT_NEAR(again.pdf, s.value.pdf, 2e-3F * s.value.pdf + 1e-6F);
        EXPECT_NEAR(again.f_cos.y(), s.value.f_cos.y(), 2e-3F * s.value.f_cos.y() + 1e-6F);
        count[cell(s.direction)] += 1.0 / n;
      }
      EXPECT_NEAR(total, 1.0 - failed, 3e-3) << roughness << " " << cosine;
      for (std::size_t c = 0; c < count.size(); ++c)
        EXPECT_NEAR(count[c], expected[c], 1e-3 + 0.03 * expected[c])
            << roughness << " " << cosine << " " << c;
    }
  }
}

TEST(Dielectric, IsReciprocalButForTheIndexSquared) {
  for (const float roughness : {0.3F, 0.6F, 1.0F}) {
    const Dielectric glass(1.5F, roughness);
    const auto f = [&](const Vec3& o, const Vec3& i) {
      return static_cast<double>(glass.evaluate(glass.view(o), i).f_cos.y()) / std::abs(i.z());
    };
    const auto n2 = [](const Vec3& w) { return w.z() > 0.0F ? 1.0 : 2.25; };
    for (const double a : {0.2, 0.5, 0.9, -0.3, -0.8}) {
      for (const double b : {0.3, 0.95, -0.25, -0.65, -0.99}) {
        // Across, nearly opposite: where the interface lets anything through.
        const Vec3 o = direction(a, 0.3), i = direction(b, 0.3 + pi + 0.2);
        const double there = f(o, i) / n2(o), back = f(i, o) / n2(i);
        EXPECT_NEAR(there, back, 1e-4 * there + 1e-7) << roughness << " " << a << " " << b;
        EXPECT_TRUE(a * b > 0.0 || there > 0.0) << a << " " << b;
      }
    }
  }
}

TEST(Dielectric, ASmoothOneBendsBySnell) {
  for (const double ior : {1.2, 1.5, 2.0}) {
    const Dielectric glass(static_cast<float>(ior), 0.0F);
    for (const double sine : {0.0, 0.3, 0.45}) {
      for (const bool outside : {true, false}) {
        const double cosine = std::sqrt(1.0 - sine * sine);
        const Vec3 wo = direction(outside ? cosine : -cosine, 0.0);
        const double eta = outside ? ior : 1.0 / ior;
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        double through = 0.0;
        const int n = 16384;
        const FrameSamples numbers(2, 0, n);
        for (int k = 0; k < n; ++k) {
          const PathSamples p = numbers.path(0, 0, k);
          const Brdf::Sample s = glass.sample(glass.view(wo), p.pair(0), p.pair(1));
          if ((s.direction.z() > 0.0F) == outside || s.value.pdf <= 0.0F) continue;
          mean += s.direction.cast<double>();
          through += static_cast<double>(s.value.f_cos.y()) / s.value.pdf * eta * eta / n;
        }
        mean.normalize();
        EXPECT_NEAR(mean.x(), -sine / eta, 1e-4) << ior << " " << sine;
        EXPECT_NEAR(std::abs(mean.z()), std::sqrt(1.0 - sine * sine / (eta * eta)), 1e-4);
        EXPECT_NEAR(through, 1.0 - fresnel(static_cast<float>(cosine), static_cast<float>(eta)), 1e-3);
      }
    }
  }
}

}  // namespace dielectric_test
}  // namespace lagomorph::render::path
