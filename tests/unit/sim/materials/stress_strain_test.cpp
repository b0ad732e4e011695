#include "sim/materials/stress_strain.h"

#include <cmath>

#include <gtest/gtest.h>

#include "sim/materials/parameters.h"
#include "sim/materials/table.h"
#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace stress_strain_test {

MaterialSettings measured(double poisson) {
  MaterialSettings s;
  s.model = StressStrain::kName;
  s.poisson = poisson;
  // Muscle-like: soft at first, ten times as stiff at the end.
  s.data = {{-0.4, -9e3}, {-0.2, -2.5e3}, {0.0, 0.0}, {0.1, 1e3}, {0.3, 4e3}, {0.6, 2.4e4}, {1.0, 9e4}};
  return s;
}

/// F of uniaxial loading with free sides.
Mat3 uniaxial(const StressStrain& material, double stretch) {
  const double side = std::exp(material.curve->lateral(std::log(stretch)));
  return Vec3(stretch, side, side).asDiagonal();
}

TEST(StressStrain, MeetsTheDataOfUniaxialLoadingAndLeavesTheSidesFree) {
  for (const double poisson : {0.0, 0.2, 0.45, 0.49}) {
    const MaterialSettings settings = measured(poisson);
    const StressStrain material = StressStrain::from_settings(settings, "test");
    for (const auto& [strain, stress] : settings.data) {
      const Mat3 P = material.dpsi_dF(uniaxial(material, 1.0 + strain));
      EXPECT_NEAR(P(0, 0), stress, 1e-12 * 9e4) << poisson;
      EXPECT_NEAR(P(1, 1), 0.0, 1e-11 * 9e4) << poisson;
      EXPECT_NEAR(P(2, 2), 0.0, 1e-11 * 9e4) << poisson;
    }
  }
}

TEST(StressStrain, KeepsItsCurveBetweenAndBeyondTheData) {
  const StressStrain material = StressStrain::from_settings(measured(0.45), "test");
  double last = -INFINITY;
  for (double x = -2.0; x <= 2.0; x += 0.01) {
    const double stretch = std::exp(x);
    const double T = stretch * material.dpsi_dF(uniaxial(material, stretch))(0, 0);
    EXPECT_GT(T, last) << x;
    EXPECT_NEAR(T, material.curve->stress(x).y, 1e-4 * 1.8e5) << x;  // T(1) of the data
    last = T;
  }
}

TEST(StressStrain, ItsSidesFollowPoissonsRatioNearRest) {
  for (const double poisson : {0.0, 0.2, 0.45, 0.49}) {
    const StressStrain material = StressStrain::from_settings(measured(poisson), "test");
    for (const double x : {-1e-5, 1e-5}) EXPECT_NEAR(material.curve->lateral(x) / x, -poisson, 1e-3);
  }
}

/// What hangs by its data has a place to come to: the density grows from rest along every ray of log
/// stretches, and along those of the volume and of equal biaxial stretches its stress does.
TEST(StressStrain, IsBoundedFromBelow) {
  for (const double poisson : {0.0, 0.3, 0.45, 0.49}) {
    MaterialSettings settings = measured(poisson);
    for (const bool one_sided : {false, true}) {
      if (one_sided) settings.data = {{-0.3, -4e3}, {0.3, 4e3}, {0.6, 2.4e4}};
      const StressStrain material = StressStrain::from_settings(settings, "test");
      const auto psi = [&](const Vec3& x) { return material.psi(Vec3(x.array().exp()).asDiagonal()); };
      for (int i = 0; i <= 24; ++i) {
        for (int k = 0; k < 48; ++k) {
          const double theta = M_PI * i / 24, phi = M_PI * k / 24;
          const Vec3 ray(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
          double last = 0.0;
          for (double r = 0.02; r < 2.5; r += 0.02) {
            const double here = psi(r * ray);
            ASSERT_GT(here, last) << poisson << " " << (r * ray).transpose();
            last = here;
          }
        }
      }
    }
  }
}

/// T = E log λ gives Hencky's density mu Σ log² λ_i + lambda/2 log² J, also outside of the data.
TEST(StressStrain, IsHenckysMaterialWhereTheDataAre) {
  constexpr double kYoung = 1e5, kPoisson = 0.4;
  MaterialSettings s;
  s.model = StressStrain::kName;
  s.poisson = kPoisson;
  for (const double strain : {-0.3, -0.1, 0.2, 0.5})
    s.data.push_back({strain, kYoung * std::log1p(strain) / (1.0 + strain)});
  const StressStrain material = StressStrain::from_settings(s, "test");
  const Lame lame = lame_from_young(kYoung, kPoisson);
  const Vec3 stretches(2.5, 0.7, 0.4), x = stretches.array().log();
  const double expected = lame.mu * x.squaredNorm() + 0.5 * lame.lambda * x.sum() * x.sum();
  EXPECT_NEAR(material.psi(stretches.asDiagonal()), expected, 1e-12 * expected);
}

TEST(StressStrain, IsScaledToAYoungsModulus) {
  MaterialSettings s = measured(0.3);
  s.young = 5e4;
  const StressStrain material = StressStrain::from_settings(s, "test");
  EXPECT_NEAR(material.curve->young(), 5e4, 1e-8);
  const double h = 1e-6;
  EXPECT_NEAR(material.dpsi_dF(uniaxial(material, 1.0 + h))(0, 0) / h, 5e4, 1.0);
}

TEST(StressStrain, TellsWhatIsWrong) {
  const auto error = [](const std::function<void(MaterialSettings&)>& change) {
    MaterialSettings s = measured(0.3);
    change(s);
    return error_of([&] { check_material(s, "here"); });
  };
  EXPECT_EQ(error([](MaterialSettings&) {}), "no error");
  EXPECT_EQ(error([](MaterialSettings& s) { s.data.clear(); }),
            "here: data has no points; give [[strain, stress], ...]");
  EXPECT_EQ(
      error([](MaterialSettings& s) {
        s.data = {{0.1, -5.0}};
      }),
      "here: data: (1 + strain) stress falls from 0 Pa to -5.5 Pa between the strains 0 and 0.1; it must "
      "grow");
  EXPECT_EQ(error([](MaterialSettings& s) {
              s.data = {{0.1, 5.0}, {0.1, 6.0}};
            }),
            "here: data has strain 0.1 twice; give each its own");
  EXPECT_EQ(error([](MaterialSettings& s) { s.data[2][1] = 1.0; }),
            "here: data point 2: stress = 1 Pa at strain 0 must be 0");
  EXPECT_EQ(error([](MaterialSettings& s) { s.data[0][0] = -1.0; }),
            "here: data point 0: strain = -1 must be > -1, a stretch > 0");
  EXPECT_EQ(error([](MaterialSettings& s) { s.poisson = -0.1; }),
            "here: poisson = -0.1 must be in [0, 0.5) for stress_strain");
  EXPECT_EQ(error([](MaterialSettings& s) { s.model = "neo_hookean"; }),
            "here: data belong to stress_strain, not to neo_hookean");
  EXPECT_EQ(error([](MaterialSettings& s) { s.mu = 1.0; }),
            "here: stress_strain takes data, poisson and young, and no other constants");
}

}  // namespace stress_strain_test
}  // namespace lagomorph::sim
