#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "apps/error.h"
#include "apps/material/closed_forms.h"
#include "apps/material/load_curves.h"
#include "sim/materials/presets.h"
#include "sim/materials/table.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"

namespace lagomorph::apps {
namespace material_command_test {

using tests::Ended;
using tests::TemporaryDirectory;

nlohmann::json truth(const char* name) {
  return nlohmann::json::parse(tests::read_all(lagomorph::tests::source_dir() / "tests/data/truth" / name));
}

Ended material(std::vector<std::string> arguments, const std::filesystem::path& directory = {}) {
  arguments.insert(arguments.begin(), "material");
  return tests::run_program(arguments, {.directory = directory});
}

/// The program's own digits, read as any other program would, meet the reference.
TEST(MaterialCommand, PrintsTheReferenceAtOneF) {
  const std::vector<std::pair<std::string, std::string>> names = {{"nh_lecture", "neo_hookean"},
                                                                  {"snh", "stable_neo_hookean"},
                                                                  {"snh_log", "stable_neo_hookean_log"},
                                                                  {"stvk", "st_venant_kirchhoff"},
                                                                  {"corotated", "corotated"}};
  const nlohmann::json one = truth("1_constitutive/constitutive.json").at("cases").at(5);
  std::string F;
  for (const nlohmann::json& f : one.at("F")) F += (F.empty() ? "" : ",") + f.dump();
  for (const auto& [theirs, ours] : names) {
    const Ended ended = material({ours, "--young", "1e6", "--poisson", "0.3", "--F=" + F, "--json"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const nlohmann::json got = nlohmann::json::parse(ended.out), expected = one.at("models").at(theirs);
    ASSERT_EQ(got.size(), 3u);
    ASSERT_EQ(got.at("P").size(), 9u);
    ASSERT_EQ(got.at("H").size(), 81u);
    EXPECT_NEAR(got.at("psi").get<double>(), expected.at("psi").get<double>(), 1e-12 * 1e6);
    for (const char* what : {"P", "H"})
      for (std::size_t k = 0; k < got.at(what).size(); ++k)
        EXPECT_NEAR(got.at(what)[k].get<double>(), expected.at(what)[k].get<double>(), 1e-12 * 3e6)
            << ours << ' ' << what << ' ' << k;
  }
}

TEST(MaterialCommand, AddsFibresAndTakesPresetsAndOwnConstants) {
  const std::string stretched = "--F=1.5,0,0,0,1,0,0,0,1";
  const auto P_11 = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> all = {"arap", stretched, "--json"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return nlohmann::json::parse(material(all).out).at("P").at(0).get<double>();
  };
  EXPECT_NEAR(P_11({"--mu", "1e3", "--lambda", "0"}), 1e3, 1e-9);
  EXPECT_NEAR(P_11({"--mu", "1e3", "--lambda", "0", "--fibre=2,0,0,4e3"}), 1e3 + 2e3 * 1.25 * 1.5, 1e-9);
  EXPECT_NEAR(P_11({"--preset", "muscle"}), 12e3 / (2.0 * 1.49), 1e-9);
}

TEST(MaterialCommand, TellsWrongInputInOneLine) {
  const auto error = [](const std::vector<std::string>& arguments) {
    const Ended ended = material(arguments);
    EXPECT_EQ(ended.status, 2);
    EXPECT_EQ(ended.out, "");
    return ended.err;
  };
  EXPECT_EQ(error({}), "lagomorph: error: material needs a MODEL: lagomorph material MODEL [options]\n");
  EXPECT_EQ(error({"stvk"}).find("lagomorph: error: material stvk: unknown material model 'stvk'; valid ones "
                                 "are neo_hookean, "),
            0u);
  EXPECT_EQ(error({"arap", "--F", "1,0,0"}),
            "lagomorph: error: --F 1,0,0: must be nine finite numbers, row by row, between commas; wrong at "
            "number 3\n");
  EXPECT_EQ(
      error({"arap", "--F", "1,0,0,0,1,0,0,0,nan"}),
      "lagomorph: error: --F 1,0,0,0,1,0,0,0,nan: must be nine finite numbers, row by row, between commas; "
      "wrong at number 9\n");
  EXPECT_EQ(
      error({"neo_hookean", "--F=-1,0,0,0,1,0,0,0,1"}),
      "lagomorph: error: --F -1,0,0,0,1,0,0,0,1: neo_hookean has no finite energy and derivatives there, "
      "with det F = -1\n");
  EXPECT_EQ(error({"arap", "--young", "stiff"}), "lagomorph: error: --young stiff: must be a number\n");
  EXPECT_EQ(error({"arap", "--young", "-1"}), "lagomorph: error: material arap: young = -1 must be > 0 Pa\n");
  EXPECT_EQ(error({"stress_strain", "--data", "0.1:5,0.2"}),
            "lagomorph: error: --data 0.1:5,0.2: must be STRAIN:STRESS,STRAIN:STRESS,...\n");
  EXPECT_EQ(error({"arap", "--fibre", "1,0"}),
            "lagomorph: error: --fibre 1,0: must be X,Y,Z,STIFFNESS or X,Y,Z,STIFFNESS,EXPONENT\n");
}

TEST(MaterialCommand, LeavesCurvesInItsFolder) {
  const TemporaryDirectory temporary;
  const Ended ended = material({"corotated", "-o", "curves", "--young", "1e6"}, temporary.path());
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.out.find("uniaxial: closed form met to "), std::string::npos) << ended.out;
  const std::string csv = tests::read_all(temporary.path() / "curves/corotated.csv");
  EXPECT_EQ(csv.find("loading,stretch,free_stretch,stress,closed_form\nuniaxial,"), 0u) << csv;
  const std::string svg = tests::read_all(temporary.path() / "curves/corotated.svg");
  EXPECT_EQ(svg.find("<svg xmlns="), 0u);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  const Ended json = material({"corotated", "-o", "curves", "--young", "1e6", "--json"}, temporary.path());
  const nlohmann::json curves = nlohmann::json::parse(json.out).at("curves");
  for (const char* loading : {"uniaxial", "biaxial", "shear", "volumetric"})
    EXPECT_EQ(curves.at(loading).at("stretch").size(), curves.at(loading).at("stress").size());
}

/// At the strains of the data the uniaxial curve is the data.
TEST(MaterialCommand, ReproducesMeasuredDataUnderUniaxialLoad) {
  sim::MaterialSettings settings;
  settings.model = "stress_strain";
  settings.poisson = 0.45;
  settings.data = {{-0.25, -6e3}, {0.2, 2e3}, {0.5, 9e3}, {0.9, 4e4}};
  const auto point = sim::make_material_point(settings, "test");
  const std::vector<LoadCurve> curves = load_curves(*point, closed_form(settings));
  int met = 0;
  for (const LoadPoint& p : curves.at(0).points) {
    for (const auto& [strain, stress] : settings.data) {
      if (std::abs(p.stretch - 1.0 - strain) > 1e-9) continue;
      EXPECT_NEAR(p.stress, stress, 1e-9 * 4e4) << strain;
      EXPECT_GT(p.free_stretch * p.free_stretch * p.stretch, 0.95) << strain;  // nearly incompressible
      ++met;
    }
  }
  EXPECT_EQ(met, 4);
}

TEST(Presets, StandInTheReadme) {
  std::string table =
      "| preset | young, Pa | poisson | density, kg/m³ | measured | source |\n|---|---|---|---|---|---|\n";
  for (const sim::Preset& p : sim::presets())
    table += fmt::format("| `{}` | {:g} | {:g} | {:g} | {} | {} |\n", p.name, p.young, p.poisson, p.density,
                         p.what, p.source);
  const std::string readme = tests::read_all(lagomorph::tests::source_dir() / "README.md");
  EXPECT_NE(readme.find("<!-- presets -->\n" + table + "<!-- /presets -->"), std::string::npos) << table;
}

/// Each material's curves against its closed form, which is another piece of code, and against the
/// small-strain moduli at rest.
TEST(LoadCurves, MeetTheClosedFormsOfEveryMaterial) {
  for (const std::string& model : sim::material_names()) {
    SCOPED_TRACE(model);
    sim::MaterialSettings settings;
    settings.model = model;
    settings.young = 1e6;
    settings.poisson = 0.3;
    if (model == "stress_strain") settings.data = {{-0.3, -2.0}, {0.2, 1.0}, {0.5, 4.0}, {0.9, 12.0}};
    const auto point = sim::make_material_point(settings, "test");
    for (const LoadCurve& curve : load_curves(*point, closed_form(settings))) {
      SCOPED_TRACE(curve.loading);
      double largest = 0.0;
      int compared = 0;
      for (const LoadPoint& p : curve.points) largest = std::max(largest, std::abs(p.closed_form));
      for (const LoadPoint& p : curve.points) {
        if (!std::isfinite(p.stress)) continue;
        // stress_strain has its table between knots.
        EXPECT_NEAR(p.stress, p.closed_form, (model == "stress_strain" ? 1e-4 : 1e-13) * largest)
            << p.stretch;
        ++compared;
      }
      EXPECT_GE(compared, 14);
      EXPECT_GT(largest, 1e5);
    }
  }
}

/// The free stretches and stresses of the reference, which solved for them on its own. St. Venant-Kirchhoff's
/// is flat at a biaxial stretch of 1.5: no stable equilibrium.
TEST(LoadCurves, MeetTheReferenceUnderUniaxialAndBiaxialLoad) {
  const nlohmann::json set = truth("6_analytic/homogeneous.json").at("sets").at(0);
  const std::vector<std::pair<std::string, std::string>> names = {
      {"nh_lecture", "neo_hookean"}, {"stvk", "st_venant_kirchhoff"}, {"corotated", "corotated"}};
  for (const auto& [theirs, ours] : names) {
    sim::MaterialSettings settings;
    settings.model = ours;
    settings.young = set.at("E");
    settings.poisson = set.at("nu");
    const auto point = sim::make_material_point(settings, "test");
    const std::vector<LoadCurve> curves = load_curves(*point, closed_form(settings));
    int compared = 0;
    const auto compare = [&](const LoadCurve& curve, const nlohmann::json& rows) {
      for (const auto& row : rows)
        for (const LoadPoint& p : curve.points)
          if (std::isfinite(p.stress) && std::abs(p.stretch - row[0].get<double>()) < 1e-9) {
            EXPECT_NEAR(p.free_stretch, row[1].get<double>(), 1e-12);
            EXPECT_NEAR(p.stress, row[2].get<double>(), 1e-11 * 1e6);
            ++compared;
          }
    };
    compare(curves[0], set.at("models").at(theirs).at("uniaxial_free_sides"));
    compare(curves[1], set.at("models").at(theirs).at("equibiaxial_free_thickness"));
    EXPECT_GT(compared, 6) << ours;
  }
}

}  // namespace material_command_test
}  // namespace lagomorph::apps
