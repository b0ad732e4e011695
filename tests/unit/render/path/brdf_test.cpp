#include "render/path/brdf.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace lagomorph::render::path {
namespace brdf_test {

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

/// The coat written out again in double precision, by half vector and textbook terms.
Eigen::Array3d coat(const Material& m, const Vec3& wo, const Vec3& wi) {
  const Eigen::Vector3d o = wo.cast<double>(), i = wi.cast<double>();
  const Eigen::Vector3d h = (o + i).normalized();
  const double a2 = std::pow(m.roughness, 4.0);
  const double nh2 = h.z() * h.z();
  const double d = a2 / (pi * std::pow(nh2 * (a2 - 1.0) + 1.0, 2.0));
  const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1.0 + a2 * (1.0 - c * c) / (c * c)) - 1.0); };
  const double g = 1.0 / (1.0 + lambda(o.z()) + lambda(i.z()));
  const double r0 = std::pow((m.ior - 1.0) / (m.ior + 1.0), 2.0);
  const Eigen::Array3d f0 = (1.0 - m.metallic) * r0 + m.metallic * m.base_color.cast<double>();
  return (f0 + (1.0 - f0) * std::pow(1.0 - o.dot(h), 5.0)) * d * g / (4.0 * o.z() * i.z());
}

/// Directional albedo of a dielectric's coat.
double coat_albedo_of(const Material& m, double cosine) {
  Material dielectric = m;
  dielectric.metallic = 0.0F;
  const Vec3 wo = direction(cosine, 0.0);
  return hemisphere([&](const Vec3& wi) { return coat(dielectric, wo, wi).x() * wi.z(); }, 100, 200);
}

/// Directional albedo of a white mirror.
double mirror_albedo_of(float roughness, double cosine) {
  const Material mirror = material(roughness, 1.0F, Color::Ones());
  const Vec3 wo = direction(cosine, 0.0);
  return hemisphere([&](const Vec3& wi) { return coat(mirror, wo, wi).x() * wi.z(); }, 100, 200);
}

/// What a metal's facets reflect more than once [1/sr]; `mean_lost` of a white mirror.
Eigen::Array3d multiple(const Material& m, double mean_lost, double co, double ci) {
  const Eigen::Array3d f0 = m.base_color.cast<double>();
  const Eigen::Array3d mean = f0 + (1.0 - f0) / 21.0;
  const double lost = (1.0 - mirror_albedo_of(m.roughness, co)) * (1.0 - mirror_albedo_of(m.roughness, ci));
  return m.metallic * lost / (pi * mean_lost) * mean.square() * (1.0 - mean_lost) / (1.0 - mean * mean_lost);
}
double mean_lost_of(float roughness);
/// Its albedo, green.
double multiple_albedo(const Material& m, double cosine) {
  // int (1 - E1(c)) 2 c dc is the mean that it is divided by.
  return pi * mean_lost_of(m.roughness) * multiple(m, mean_lost_of(m.roughness), cosine, 0.5).y() /
         (1.0 - mirror_albedo_of(m.roughness, 0.5));
}
double mean_lost_of(float roughness) {
  double mean = 0.0;
  for (int k = 0; k < 20; ++k) {
    const double c = (k + 0.5) / 20;
    mean += 2.0 * (1.0 - mirror_albedo_of(roughness, c)) * c / 20;
  }
  return mean;
}

TEST(Brdf, MeetsItsFormula) {
  for (const float roughness : {0.5F, 0.75F, 1.0F}) {
    double mean = 0.0;  // of what the coat lets in
    for (int k = 0; k < 20; ++k) {
      const double c = (k + 0.5) / 20;
      mean += 2.0 * (1.0 - coat_albedo_of(material(roughness, 0.0F), c)) * c / 20;
    }
    const double mean_lost = mean_lost_of(roughness);
    for (const double co : {0.1, 0.5, 0.95}) {
      for (const double ci : {0.05, 0.6, 0.99}) {
        const double let_in = (1.0 - coat_albedo_of(material(roughness, 0.0F), co)) *
                              (1.0 - coat_albedo_of(material(roughness, 0.0F), ci)) / mean;
        for (const float metallic : {0.0F, 0.4F, 1.0F}) {
          const Material m = material(roughness, metallic);
          const Brdf brdf(m);
          const Eigen::Array3d again = multiple(m, mean_lost, co, ci);
          for (const double phi : {0.0, 1.0, 2.5, pi}) {
            const Vec3 wo = direction(co, 0.3), wi = direction(ci, 0.3 + phi);
            const Eigen::Array3d base = (1.0 - metallic) * m.base_color.cast<double>() / pi * let_in;
            const Eigen::Array3d expected = (base + again + coat(m, wo, wi)) * ci;
            const Color f_cos = brdf.evaluate(brdf.view(wo), wi).f_cos;
            for (int k = 0; k < 3; ++k) {
              EXPECT_NEAR(f_cos[k], expected[k], 3e-3 * expected[k]) << roughness << " " << metallic;
            }
          }
        }
      }
    }
  }
}

TEST(Brdf, SharpCoatsMeetTheirFormula) {
  for (const float roughness : {0.1F, 0.2F, 0.35F}) {
    const Material metal = material(roughness, 1.0F);
    const Brdf brdf(metal);
    for (const double co : {0.1, 0.5, 0.95}) {
      for (const double tilt : {0.0, 0.02, 0.05}) {
        const Vec3 wo = direction(co, 0.3), wi = direction(co - tilt, 0.3 + pi + tilt);
        // MeetsItsFormula tests what is reflected more than once, which is little here.
        const Brdf::View view = brdf.view(wo);
        const Eigen::Array3d again =
            color(look_up(brdf.constants().lost, wi.z()) * view.multiple).cast<double>();
        const Eigen::Array3d expected = (coat(metal, wo, wi) + again) * (co - tilt);
        const Color f_cos = brdf.evaluate(view, wi).f_cos;
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(f_cos[k], expected[k], 2e-3 * expected[k]) << roughness << " " << co;
      }
    }
  }
}

TEST(Brdf, IsReciprocal) {
  const Brdf brdf(material(0.4F, 0.3F));
  const Vec3 a = direction(0.3, 0.5), b = direction(0.8, 2.0);
  const Color ab = brdf.evaluate(brdf.view(a), b).f_cos / b.z(),
              ba = brdf.evaluate(brdf.view(b), a).f_cos / a.z();
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(ab[k], ba[k], 1e-5F * ab[k]);
}

TEST(Brdf, NothingGoesThrough) {
  const Brdf brdf(material(0.4F, 0.3F));
  EXPECT_EQ(brdf.evaluate(brdf.view(direction(0.5, 0.0)), direction(-0.5, 0.0)).f_cos.maxCoeff(), 0.0F);
  EXPECT_EQ(brdf.evaluate(brdf.view(direction(0.5, 0.0)), direction(-0.5, 0.0)).pdf, 0.0F);
}

double sampled_albedo(const Brdf& brdf, double cosine) {
  const Brdf::View view = brdf.view(direction(cosine, 0.0));
  const int n = 65536;
  const FrameSamples numbers(5, 0, n);
  double albedo = 0.0;
  for (int s = 0; s < n; ++s) {
    const Brdf::Sample sample = brdf.sample(view, numbers.path(0, 0, s).pair(0));
    if (sample.value.pdf > 0.0F) albedo += sample.value.f_cos.y() / sample.value.pdf / n;
  }
  return albedo;
}

TEST(Brdf, AWhiteBaseReflectsAllThatArrives) {
  for (const float roughness : {0.1F, 0.3F, 0.6F, 1.0F}) {
    const Brdf brdf(material(roughness, 0.0F, Color::Ones()));
    for (const double cosine : {0.02, 0.1, 0.3, 0.6, 1.0}) {
      EXPECT_NEAR(sampled_albedo(brdf, cosine), 1.0, 6e-3) << roughness << " " << cosine;
    }
  }
}

TEST(Brdf, AWhiteMetalReflectsAllThatArrives) {
  for (const float metallic : {0.5F, 1.0F}) {
    for (const float roughness : {0.1F, 0.3F, 0.6F, 1.0F}) {
      const Brdf brdf(material(roughness, metallic, Color::Ones()));
      for (const double cosine : {0.02, 0.1, 0.3, 0.6, 1.0}) {
        EXPECT_NEAR(sampled_albedo(brdf, cosine), 1.0, 6e-3) << metallic << " " << roughness << " " << cosine;
      }
    }
  }
}

TEST(Brdf, SamplesGiveTheDirectionalAlbedo) {
  for (const float roughness : {0.45F, 0.7F, 1.0F}) {
    const Material m = material(roughness, 1.0F);
    const Brdf brdf(m);
    for (const double cosine : {0.1, 0.6, 1.0}) {
      const Vec3 wo = direction(cosine, 0.0);
      const double once = hemisphere([&](const Vec3& wi) { return coat(m, wo, wi).y() * wi.z(); });
      const double expected = once + multiple_albedo(m, cosine);
      EXPECT_NEAR(sampled_albedo(brdf, cosine), expected, 2e-3 * expected) << roughness << " " << cosine;
    }
  }
}

TEST(Brdf, RoughenedItHasTheRougherLobeAndReflectsAsMuch) {
  for (const float metallic : {0.0F, 1.0F}) {
    const Brdf sharp(material(0.2F, metallic)), rough(material(0.6F, metallic));
    for (const double cosine : {0.2, 0.5, 0.8}) {
      const Vec3 wo = direction(cosine, 0.0);
      const auto albedo = [&](const Brdf& brdf, float least_alpha) {
        const Brdf::View view = brdf.view(wo, least_alpha);
        return hemisphere([&](const Vec3& wi) { return brdf.evaluate(view, wi).f_cos.y(); });
      };
      EXPECT_NEAR(albedo(sharp, 0.36F), albedo(sharp, 0.0F), 3e-3) << metallic << " " << cosine;
    }
    const Vec3 wo = direction(0.7, 0.0), wi = direction(0.5, 2.0);
    EXPECT_FLOAT_EQ(sharp.view(wo, 0.36F).alpha, rough.view(wo).alpha);
    EXPECT_FLOAT_EQ(rough.evaluate(rough.view(wo, 0.04F), wi).f_cos.x(),
                    rough.evaluate(rough.view(wo), wi).f_cos.x());
  }
}

TEST(Brdf, NoCoatAtAnIndexOfOne) {
  const Brdf brdf(material(0.3F, 0.0F, Color(1.0F, 0.5F, 0.25F), 1.0F));
  for (const double cosine : {0.05, 0.5, 0.99}) {
    const Vec3 wi = direction(cosine, 2.0);
    const Color f_cos = brdf.evaluate(brdf.view(direction(0.4, 0.0)), wi).f_cos;
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
        const Brdf::View view = brdf.view(wo);
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
          const Brdf::Sample sample = brdf.sample(view, numbers.path(s >> 16, 0, s & 65535).pair(0));
          EXPECT_NEAR(sample.direction.norm(), 1.0F, 1e-4F);
          if (sample.value.pdf > 0.0F) {
            count[cell(sample.direction)] += 1.0 / n;
          } else {
            below += 1.0 / n;
          }
        }
        const double total = hemisphere(
            [&](const Vec3& wi) {
              const float pdf = brdf.evaluate(view, wi).pdf;
              expected[cell(wi)] += pdf * 2.0 * pi / (400.0 * 800.0);
              return pdf;
            },
            400, 800);
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

}  // namespace brdf_test
}  // namespace lagomorph::render::path
