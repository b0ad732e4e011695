#include "render/path/brdf.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace lagomorph::render::path {
namespace {

constexpr double pi = std::numbers::pi;

Material material(float roughness, float metallic, Color color = Color(0.8F, 0.5F, 0.3F), float ior = 1.5F) {
  return {color, roughness, metallic, ior};
}

Vec3 direction(double cosine, double phi) {
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  return Eigen::Vector3d(sine * std::cos(phi), sine * std::sin(phi), cosine).cast<float>();
}

/// Integral over the upper hemisphere by the midpoint rule, in cosine and azimuth.
template <class F>
double hemisphere(const F& f, int rings = 400, int spokes = 800) {
  double sum = 0.0;
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < spokes; ++j) sum += f(direction((i + 0.5) / rings, 2.0 * pi * (j + 0.5) / spokes));
  }
  return sum * 2.0 * pi / (static_cast<double>(rings) * spokes);
}

/// The model written out again in double precision, by half vector and textbook terms.
Eigen::Array3d model(const Material& m, const Vec3& wo, const Vec3& wi) {
  const Eigen::Vector3d o = wo.cast<double>(), i = wi.cast<double>();
  const Eigen::Vector3d h = (o + i).normalized();
  const double a2 = std::pow(m.roughness, 4.0);
  const double nh2 = h.z() * h.z();
  const double d = a2 / (pi * std::pow(nh2 * (a2 - 1.0) + 1.0, 2.0));
  const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1.0 + a2 * (1.0 - c * c) / (c * c)) - 1.0); };
  const double g = 1.0 / (1.0 + lambda(o.z()) + lambda(i.z()));
  const double r0 = std::pow((m.ior - 1.0) / (m.ior + 1.0), 2.0);
  const auto schlick = [](double c) { return std::pow(1.0 - c, 5.0); };
  const auto let_in = [&](double c) { return 1.0 - (r0 + (1.0 - r0) * schlick(c)); };
  const double mean_let_in =
      1.0 - (r0 + (1.0 - r0) / 21.0);  // 2 times the integral of (1 - F(c)) c over [0, 1]
  const Eigen::Array3d color = m.base_color.cast<double>();
  const double oh = o.dot(h);
  const Eigen::Array3d metal = color + (1.0 - color) * schlick(oh);
  const Eigen::Array3d fresnel = (1.0 - m.metallic) * (1.0 - let_in(oh)) + m.metallic * metal;
  return (1.0 - m.metallic) * let_in(o.z()) * let_in(i.z()) / mean_let_in * color / pi +
         fresnel * d * g / (4.0 * o.z() * i.z());
}

TEST(Brdf, MeetsItsFormula) {
  for (const float roughness : {0.2F, 0.5F, 1.0F}) {
    for (const float metallic : {0.0F, 0.4F, 1.0F}) {
      const Material m = material(roughness, metallic);
      const Brdf brdf(m);
      for (const double co : {0.1, 0.5, 0.95}) {
        for (const double ci : {0.05, 0.6, 0.99}) {
          for (const double phi : {0.0, 1.0, 2.5, pi}) {
            const Vec3 wo = direction(co, 0.3), wi = direction(ci, 0.3 + phi);
            const Eigen::Array3d expected = model(m, wo, wi) * ci;
            const Brdf::Value value = brdf.evaluate(wo, wi);
            for (int k = 0; k < 3; ++k) {
              EXPECT_NEAR(value.f_cos[k], expected[k], 2e-4 * expected[k]) << roughness << metallic;
            }
          }
        }
      }
    }
  }
}

TEST(Brdf, IsReciprocal) {
  const Brdf brdf(material(0.4F, 0.3F));
  const Vec3 a = direction(0.3, 0.5), b = direction(0.8, 2.0);
  const Color ab = brdf.evaluate(a, b).f_cos / b.z(), ba = brdf.evaluate(b, a).f_cos / a.z();
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(ab[k], ba[k], 1e-5F * ab[k]);
}

TEST(Brdf, NothingGoesThrough) {
  const Brdf brdf(material(0.4F, 0.3F));
  EXPECT_EQ(brdf.evaluate(direction(0.5, 0.0), direction(-0.5, 0.0)).f_cos.maxCoeff(), 0.0F);
  EXPECT_EQ(brdf.evaluate(direction(0.5, 0.0), direction(-0.5, 0.0)).pdf, 0.0F);
}

TEST(Brdf, ReflectsNoMoreThanArrives) {
  for (const float roughness : {0.2F, 0.4F, 0.7F, 1.0F}) {
    for (const float metallic : {0.0F, 0.5F, 1.0F}) {
      const Material m = material(roughness, metallic, Color::Ones());
      for (const double cosine : {0.02, 0.1, 0.3, 0.6, 0.9, 1.0}) {
        const Vec3 wo = direction(cosine, 0.0);
        const double albedo =
            hemisphere([&](const Vec3& wi) { return model(m, wo, wi).x() * wi.z(); }, 100, 200);
        EXPECT_LT(albedo, 1.01) << roughness << " " << metallic << " " << cosine;
      }
    }
  }
}

TEST(Brdf, SamplesGiveTheDirectionalAlbedo) {
  for (const float roughness : {0.45F, 0.7F, 1.0F}) {
    for (const float metallic : {0.0F, 1.0F}) {
      const Material m = material(roughness, metallic);
      const Brdf brdf(m);
      for (const double cosine : {0.1, 0.6, 1.0}) {
        const Vec3 wo = direction(cosine, 0.0);
        const double expected = hemisphere([&](const Vec3& wi) { return model(m, wo, wi).y() * wi.z(); });
        const int n = 65536;
        const FrameSamples numbers(5, 0, n);
        double albedo = 0.0;
        for (int s = 0; s < n; ++s) {
          const Brdf::Sample sample = brdf.sample(wo, numbers.path(0, 0, s).pair(0));
          if (sample.value.pdf > 0.0F) albedo += sample.value.f_cos.y() / sample.value.pdf / n;
        }
        EXPECT_NEAR(albedo, expected, 2e-3 * expected) << roughness << " " << metallic << " " << cosine;
      }
    }
  }
}

TEST(Brdf, NoCoatAtAnIndexOfOne) {
  const Brdf brdf(material(0.3F, 0.0F, Color(1.0F, 0.5F, 0.25F), 1.0F));
  for (const double cosine : {0.05, 0.5, 0.99}) {
    const Vec3 wi = direction(cosine, 2.0);
    const Color f_cos = brdf.evaluate(direction(0.4, 0.0), wi).f_cos;
    EXPECT_NEAR(f_cos.x(), cosine / pi, 1e-6);
    EXPECT_NEAR(f_cos.z(), 0.25 * cosine / pi, 1e-6);
  }
}

TEST(Brdf, DensityAndSamplesAgree) {
  // Over the hemisphere the density sums to 1 less the part that reflects into the surface; cell by cell it
  // is the rate of the samples.
  const int rings = 8, spokes = 16;
  for (const float roughness : {0.3F, 0.6F, 1.0F}) {
    for (const float metallic : {0.0F, 1.0F}) {
      const Brdf brdf(material(roughness, metallic));
      for (const double cosine : {0.15, 0.7}) {
        const Vec3 wo = direction(cosine, 1.0);
        const int n = 1 << 18;
        const FrameSamples numbers(1, 0, 65536);
        std::vector<double> count(rings * spokes, 0.0), expected(rings * spokes, 0.0);
        double below = 0.0;
        const auto cell = [&](const Vec3& w) {
          const double phi = std::atan2(w.y(), w.x()) / (2.0 * pi);
          const int ring = std::min(static_cast<int>(w.z() * rings), rings - 1);
          const int spoke = std::min(static_cast<int>((phi - std::floor(phi)) * spokes), spokes - 1);
          return static_cast<std::size_t>(ring * spokes + spoke);
        };
        for (int s = 0; s < n; ++s) {
          const Brdf::Sample sample = brdf.sample(wo, numbers.path(s >> 16, 0, s & 65535).pair(0));
          EXPECT_NEAR(sample.direction.norm(), 1.0F, 1e-4F);
          if (sample.value.pdf > 0.0F) {
            count[cell(sample.direction)] += 1.0 / n;
          } else {
            below += 1.0 / n;
          }
        }
        const double total = hemisphere(
            [&](const Vec3& wi) {
              const float pdf = brdf.evaluate(wo, wi).pdf;
              expected[cell(wi)] += pdf * 2.0 * pi / (800.0 * 1600.0);
              return pdf;
            },
            800, 1600);
        EXPECT_NEAR(total, 1.0 - below, 3e-3) << roughness << " " << metallic << " " << cosine;
        for (std::size_t c = 0; c < count.size(); ++c) {
          EXPECT_NEAR(count[c], expected[c], 1e-3 + 0.02 * expected[c])
              << roughness << " " << metallic << " " << c;
        }
      }
    }
  }
}

TEST(Brdf, VisibleNormalsMeetTheirDensity) {
  // G1 max(0, o.h) D / cos_o [Heitz 2018, Eq. 3] integrates to 1 and gives the mean of the sampled normals.
  for (const double alpha : {0.1, 0.5, 1.0}) {
    for (const double cosine : {0.1, 0.6, 1.0}) {
      const Vec3 wo = direction(cosine, 0.7);
      const double a2 = alpha * alpha;
      const double lambda = 0.5 * (std::sqrt(1.0 + a2 * (1.0 - cosine * cosine) / (cosine * cosine)) - 1.0);
      Eigen::Vector3d expected = Eigen::Vector3d::Zero();
      const auto density = [&](const Vec3& h) {
        const double nh2 = static_cast<double>(h.z()) * h.z();
        const double d = a2 / (pi * std::pow(nh2 * (a2 - 1.0) + 1.0, 2.0));
        return d * std::max(0.0F, wo.dot(h)) / ((1.0 + lambda) * cosine);
      };
      const int rings = 2000, spokes = 400;
      const double total = hemisphere(
          [&](const Vec3& h) {
            expected += h.cast<double>() * density(h) * 2.0 * pi / (rings * spokes);
            return density(h);
          },
          rings, spokes);
      EXPECT_NEAR(total, 1.0, 2e-3) << alpha << " " << cosine;
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      const int n = 65536;
      const FrameSamples numbers(3, 0, n);
      for (int s = 0; s < n; ++s) {
        const Vec3 h = sample_visible_normal(wo, static_cast<float>(alpha), numbers.path(0, 0, s).pair(2));
        EXPECT_GE(wo.dot(h), -1e-5F);
        mean += h.cast<double>() / n;
      }
      EXPECT_LT((mean - expected).norm(), 3e-3) << alpha << " " << cosine;
    }
  }
}

TEST(Brdf, CosineSamplesHaveTheirMoments) {
  const int n = 65536;
  const FrameSamples numbers(4, 0, n);
  double z = 0.0, z2 = 0.0;
  for (int s = 0; s < n; ++s) {
    const Vec3 w = sample_cosine(numbers.path(0, 0, s).pair(0));
    EXPECT_NEAR(w.norm(), 1.0F, 1e-6F);
    z += w.z() / n;
    z2 += static_cast<double>(w.z()) * w.z() / n;
  }
  EXPECT_NEAR(z, 2.0 / 3.0, 1e-4);
  EXPECT_NEAR(z2, 0.5, 1e-4);
}

TEST(Brdf, FramesAreRightHanded) {
  for (const Vec3& n :
       {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0.6F, 0.0F, -0.8F), Vec3(0, 1, 0), Vec3(-0.36F, 0.48F, 0.8F)}) {
    Vec3 t, b;
    make_frame(n, t, b);
    EXPECT_LT((t.cross(b) - n).norm(), 1e-6F);
    EXPECT_NEAR(t.norm(), 1.0F, 1e-6F);
    EXPECT_NEAR(b.norm(), 1.0F, 1e-6F);
  }
}

}  // namespace
}  // namespace lagomorph::render::path
