#include "sim/materials/parameters.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "sim/materials/fibre.h"
#include "sim/materials/linear_elasticity.h"
#include "sim/materials/mooney_rivlin.h"
#include "sim/materials/neo_hookean.h"
#include "sim/materials/presets.h"
#include "sim/materials/table.h"
#include "tests/unit/sim/mesh_fixtures.h"

/// From what a scene says to a material's constants.
namespace lagomorph::sim {
namespace parameters_test {

constexpr double kYoung = 1e6, kPoisson = 0.3;

template <class Material>
Material material_with(double young, double poisson) {
  MaterialSettings settings;
  settings.young = young;
  settings.poisson = poisson;
  return Material::from_settings(settings, "test");
}

TEST(NeoHookean, TakesCAndD) {
  MaterialSettings settings;
  settings.C = 3.0;
  settings.D = 5.0;
  const NeoHookean material = NeoHookean::from_settings(settings, "test");
  EXPECT_EQ(material.C, 3.0);
  EXPECT_EQ(material.D, 5.0);
  const NeoHookean by_lame = material_with<NeoHookean>(kYoung, kPoisson);
  EXPECT_EQ(by_lame.C, lame_from_young(kYoung, kPoisson).mu / 2);
  EXPECT_EQ(by_lame.D, lame_from_young(kYoung, kPoisson).lambda / 2);
}

TEST(MaterialTable, NamesItsRows) {
  EXPECT_EQ(material_names(),
            (std::vector<std::string>{"neo_hookean", "neo_hookean_log", "stable_neo_hookean",
                                      "stable_neo_hookean_log", "mooney_rivlin", "st_venant_kirchhoff",
                                      "corotated", "fixed_corotated", "arap", "linear", "stress_strain"}));
}

/// What check_material says of a material.
std::string error_with(const std::function<void(MaterialSettings&)>& change) {
  MaterialSettings settings;
  change(settings);
  return error_of([&] { check_material(settings, "here"); });
}

TEST(MaterialTable, TellsWhatIsWrong) {
  using S = MaterialSettings;
  EXPECT_EQ(error_with([](S&) {}), "no error");
  EXPECT_EQ(error_with([](S& s) { s.model = "stvk"; }),
            "here: unknown material model 'stvk'; valid ones are neo_hookean, neo_hookean_log, "
            "stable_neo_hookean, stable_neo_hookean_log, mooney_rivlin, st_venant_kirchhoff, corotated, "
            "fixed_corotated, arap, linear, stress_strain");
  EXPECT_EQ(error_with([](S& s) { s.young = 0.0; }), "here: young = 0 must be > 0 Pa");
  EXPECT_EQ(error_with([](S& s) { s.young = INFINITY; }), "here: young = inf must be > 0 Pa");
  EXPECT_EQ(error_with([](S& s) { s.poisson = 0.5; }), "here: poisson = 0.5 must be in (-1, 0.5)");
  EXPECT_EQ(error_with([](S& s) { s.poisson = -1.0; }), "here: poisson = -1 must be in (-1, 0.5)");
  EXPECT_EQ(error_with([](S& s) { s.poisson = NAN; }), "here: poisson = nan must be in (-1, 0.5)");
  EXPECT_EQ(error_with([](S& s) { s.mu = 1.0; }), "here: mu is given without lambda; give both");
  EXPECT_EQ(error_with([](S& s) { s.mu = 1.0, s.lambda = 1.0, s.young = 1.0; }),
            "here: mu and lambda are given beside young or poisson; give one pair");
  EXPECT_EQ(error_with([](S& s) { s.mu = 0.0, s.lambda = 1.0; }), "here: mu = 0 must be > 0 Pa");
  EXPECT_EQ(error_with([](S& s) { s.mu = 3.0, s.lambda = -2.0; }), "here: lambda = -2 must be > -2/3 mu");
  EXPECT_EQ(error_with([](S& s) { s.C = 1.0, s.D = 1.0; }),
            "here: C and D belong to neo_hookean; give young and poisson, or mu and lambda");
  EXPECT_EQ(error_with([](S& s) { s.model = "neo_hookean", s.C = -1.0, s.D = 1.0; }),
            "here: C = -1 must be > 0 Pa");
  EXPECT_EQ(error_with([](S& s) { s.model = "neo_hookean", s.C = 1.0; }),
            "here: C is given without D; give both");
  EXPECT_EQ(error_with([](S& s) { s.model = "neo_hookean", s.poisson = -0.1; }),
            "here: poisson = -0.1 must be in [0, 0.5) for neo_hookean");
}

TEST(MaterialTable, TellsWhatIsWrongWithPresetsFibresAndOwnConstants) {
  using S = MaterialSettings;
  EXPECT_EQ(error_with([](S& s) { s.preset = "cheese"; }),
            "here: unknown preset 'cheese'; valid ones are none, rubber, jelly, muscle, fat, silicone");
  EXPECT_EQ(error_with([](S& s) { s.model = "neo_hookean", s.moduli = "mine"; }),
            "here: unknown moduli 'mine'; valid ones are lecture, matched");
  EXPECT_EQ(error_with([](S& s) { s.model = "neo_hookean", s.moduli = "matched", s.poisson = -0.1; }),
            "no error");
  EXPECT_EQ(error_with([](S& s) { s.model = "neo_hookean_log", s.poisson = -0.1; }),
            "here: poisson = -0.1 must be in [0, 0.5) for neo_hookean_log");
  EXPECT_EQ(error_with([](S& s) { s.model = "fixed_corotated", s.mu = 3.0, s.lambda = -1.0; }),
            "here: lambda = -1 must be >= 0 Pa for fixed_corotated");
  EXPECT_EQ(error_with([](S& s) { s.bulk = 1.0; }),
            "here: C10, C01 and bulk belong to mooney_rivlin; give young and poisson, or mu and lambda");
  EXPECT_EQ(error_with([](S& s) { s.model = "mooney_rivlin", s.C10 = 1.0; }),
            "here: of C10, C01 and bulk some are missing; give all three");
  EXPECT_EQ(
      error_with([](S& s) { s.model = "mooney_rivlin", s.C10 = 1.0, s.C01 = 1.0, s.bulk = 9.0, s.mu = 1.0; }),
      "here: C10, C01 and bulk are given beside other constants; give one set");
  EXPECT_EQ(error_with([](S& s) { s.model = "mooney_rivlin", s.C10 = 0.0, s.C01 = 0.0, s.bulk = 9.0; }),
            "here: C10 + C01 = 0 must be > 0 Pa");
  EXPECT_EQ(error_with([](S& s) { s.fibre = FibreSettings{.stiffness = 1.0}; }),
            "here: fibre.direction's length = 0 must be > 0");
  EXPECT_EQ(error_with([](S& s) { s.fibre = FibreSettings{.direction = Vec3(1, 0, 0)}; }),
            "here: fibre.stiffness = 0 must be > 0 Pa");
  EXPECT_EQ(error_with([](S& s) {
              s.fibre = FibreSettings{.direction = Vec3(1, 0, 0), .stiffness = 1.0, .exponent = -1.0};
            }),
            "here: fibre.exponent = -1 must be >= 0");
}

TEST(Presets, FillInYoungAndPoissonWhereNothingElseIsGiven) {
  MaterialSettings settings;
  for (const Preset& preset : presets()) {
    settings = {};
    settings.preset = preset.name;
    const Lame lame = lame_parameters(settings, "test"),
               expected = lame_from_young(preset.young, preset.poisson);
    EXPECT_EQ(lame.mu, expected.mu) << preset.name;
    EXPECT_EQ(lame.lambda, expected.lambda) << preset.name;
    EXPECT_GT(preset.density, 800.0);
  }
  settings.poisson = 0.2;
  EXPECT_EQ(lame_parameters(settings, "test").mu, lame_from_young(presets().back().young, 0.2).mu);
  settings.poisson.reset();
  settings.mu = 3.0, settings.lambda = 4.0;
  EXPECT_EQ(lame_parameters(settings, "test").mu, 3.0);
}

/// The lecture's energy has another Poisson's ratio than it is asked for, the matched one the same.
TEST(NeoHookean, MatchesYoungAndPoissonWhenAsked) {
  MaterialSettings settings;
  settings.young = kYoung;
  settings.poisson = kPoisson;
  settings.moduli = "matched";
  const Mat9 H = NeoHookean::from_settings(settings, "test").d2psi_dF2(Mat3::Identity());
  const Mat9 expected = material_with<LinearElasticity>(kYoung, kPoisson).d2psi_dF2(Mat3::Identity());
  EXPECT_LT((H - expected).cwiseAbs().maxCoeff(), 1e-14 * kYoung);
  settings.moduli = "lecture";
  const Mat9 lecture = NeoHookean::from_settings(settings, "test").d2psi_dF2(Mat3::Identity());
  EXPECT_GT((lecture - expected).cwiseAbs().maxCoeff(), 0.1 * kYoung);
}

TEST(MooneyRivlin, SplitsTheShearModulusAndTakesItsOwnConstants) {
  const auto material = material_with<MooneyRivlin>(kYoung, kPoisson);
  const Lame lame = lame_from_young(kYoung, kPoisson);
  EXPECT_DOUBLE_EQ(2.0 * (material.C10 + material.C01), lame.mu);
  EXPECT_DOUBLE_EQ(material.C01, 0.25 * material.C10);
  EXPECT_DOUBLE_EQ(material.bulk, lame.lambda + 2.0 / 3.0 * lame.mu);
  MaterialSettings settings;
  settings.C10 = 3.0, settings.C01 = 4.0, settings.bulk = 5.0;
  const MooneyRivlin own = MooneyRivlin::from_settings(settings, "test");
  EXPECT_EQ(own.C10, 3.0);
  EXPECT_EQ(own.C01, 4.0);
  EXPECT_EQ(own.bulk, 5.0);
}

TEST(Fibre, AddsItsStiffnessAlongItselfInTensionAndIsSlackInCompression) {
  MaterialSettings settings;
  settings.fibre = FibreSettings{.direction = Vec3(0, 2, 0), .stiffness = 4e3, .exponent = 2.0};
  const Fibre fibre = Fibre::from_settings(settings, "test");
  const double stretch = 1.3, e = stretch * stretch - 1.0;
  const Mat3 P = fibre.dpsi_dF(Vec3(0.5, stretch, 2.0).asDiagonal());
  EXPECT_NEAR(P(1, 1), 2e3 * e * std::exp(2.0 * e * e) * stretch, 1e-9);
  EXPECT_EQ(P(0, 0), 0.0);
  const double tiny = 1e-6;
  EXPECT_NEAR(fibre.dpsi_dF(Vec3(1, 1 + tiny, 1).asDiagonal())(1, 1) / tiny, 4e3, 0.1);
  EXPECT_EQ(fibre.psi(Vec3(2, 0.9, 2).asDiagonal()), 0.0);
  EXPECT_EQ(fibre.dpsi_dF(Vec3(2, 0.9, 2).asDiagonal()).norm(), 0.0);
  EXPECT_EQ(fibre.d2psi_dF2(Vec3(2, 0.9, 2).asDiagonal()).norm(), 0.0);
}

}  // namespace parameters_test
}  // namespace lagomorph::sim
