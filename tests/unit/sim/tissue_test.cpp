#include "sim/tissue.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "sim/elasticity.h"
#include "sim/materials/stable_neo_hookean.h"
#include "sim/model.h"
#include "sim/statics.h"
#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace tissue_test {

MaterialSettings material(double young, double poisson = 0.3, const char* model = "stable_neo_hookean") {
  MaterialSettings settings;
  settings.model = model;
  settings.young = young;
  settings.poisson = poisson;
  return settings;
}

Vec3 centroid(const TetMesh& mesh, int j) {
  Vec3 sum = Vec3::Zero();
  for (const int v : mesh.tets[static_cast<std::size_t>(j)]) sum += Vec3(mesh.X.row(v));
  return 0.25 * sum;
}

RegionSettings half_of_cube() {
  RegionSettings half;
  half.box = BoxSelector{Vec3(0.5, 0, 0), Vec3(1, 1, 1)};
  return half;
}

VecX shaken(const TetMesh& mesh) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-0.05, 0.05);
  VecX q = as_q(mesh.X);
  for (double& x : q) x += uniform(random);
  return q;
}

/// Young's modulus of each tet.
std::vector<double> young_of(const Tissue& tissue) {
  std::vector<double> young;
  for (const ElasticBody& part : tissue.parts)
    for (int j = part.tets.begin; j < part.tets.end; ++j) young.push_back(*part.material.young);
  return young;
}

std::string error_with(const std::function<void(BodySettings&)>& change) {
  BodySettings settings;
  settings.material = material(1e5);
  change(settings);
  const TetMesh cube = cube_mesh(2);
  return error_of([&] {
    for (const ElasticBody& part : make_tissue(cube, settings, "body 'a'").parts)
      check_material(part.material, part.where);
  });
}

TEST(Tissue, IsOnePartWhereTheBodyIsTheSameEverywhere) {
  BodySettings settings;
  settings.material = material(3e5);
  const Tissue tissue = make_tissue(cube_mesh(2), settings, "body 'a'");
  ASSERT_EQ(tissue.parts.size(), 1U);
  EXPECT_EQ(tissue.parts[0].tets.size(), 48);
  EXPECT_TRUE(tissue.densities.empty());
}

TEST(Tissue, OfTwoRegionsIsTheSumOfTwoListsOfElementsMadeByHand) {
  BodyInput body{cube_mesh(2), {}};
  body.settings.material = material(1e5);
  RegionSettings half = half_of_cube();
  half.material = material(7e5, 0.4);
  half.density = 300.0;
  body.settings.region = {half};
  const Model model({body}, Vec3(0, -9.81, 0));
  std::vector<int> elements;
  std::vector<StableNeoHookean> materials;
  std::vector<double> densities;
  for (int j = 0; j < body.mesh.tet_count(); ++j) {
    const bool inside = centroid(body.mesh, j).x() > 0.5;
    elements.push_back(j);
    materials.push_back(
        StableNeoHookean::from_settings(inside ? *half.material : body.settings.material, ""));
    densities.push_back(inside ? 300.0 : 1000.0);
  }
  const Elasticity<StableNeoHookean> by_hand(body.mesh, elements, materials, model.pattern());
  const VecX q = shaken(body.mesh);
  ASSERT_EQ(model.energies().size(), 2U);
  EXPECT_EQ(model.energies()[0]->value(q), by_hand.value(q));
  VecX g = VecX::Zero(q.size()), expected = VecX::Zero(q.size());
  model.energies()[0]->add_gradient(q, 1.0, g);
  by_hand.add_gradient(q, 1.0, expected);
  EXPECT_EQ((g - expected).norm(), 0.0);
  EXPECT_NEAR(model.total_mass(), 650.0, 1e-10);
}

TEST(Tissue, MixesModelsAndLetsLaterRegionsWin) {
  BodySettings settings;
  settings.material = material(1e5);
  RegionSettings half = half_of_cube(), corner, tag;
  half.material = material(2e5, 0.3, "neo_hookean");
  corner.sphere = SphereSelector{Vec3(1, 1, 1), 0.6};
  corner.material = material(3e5);
  tag.tag = {77};
  tag.density = 10.0;
  settings.region = {half, corner, tag};
  TetMesh cube = cube_mesh(2);
  cube.tags[11] = 77;
  const Tissue tissue = make_tissue(cube, settings, "body 'a'");
  const std::vector<double> young = young_of(tissue);
  int of_corner = 0;
  for (int j = 0; j < cube.tet_count(); ++j) {
    const bool in_corner = (centroid(cube, j) - Vec3(1, 1, 1)).norm() <= 0.6;
    of_corner += in_corner ? 1 : 0;
    const double expected = in_corner ? 3e5 : centroid(cube, j).x() > 0.5 ? 2e5 : 1e5;
    EXPECT_EQ(young[static_cast<std::size_t>(j)], expected) << j;
    EXPECT_EQ(tissue.densities[static_cast<std::size_t>(j)], j == 11 ? 10.0 : 1000.0);
  }
  EXPECT_GT(of_corner, 0);
}

/// Two halves in series: E_1 e_1 = E_2 e_2, so the middle moves by d E_2 / (E_1 + E_2). Exact for linear
/// elasticity with poisson = 0, whose solution the elements hold.
TEST(Tissue, OfTwoStiffnessesInSeriesStretchesAsTwoSprings) {
  constexpr double kFirst = 1e5, kSecond = 4e5, kPulled = 0.1;
  BodyInput body{cube_mesh(4), {}};
  body.settings.material = material(kFirst, 0.0, "linear");
  RegionSettings half = half_of_cube();
  half.material = material(kSecond, 0.0, "linear");
  body.settings.region = {half};
  PinSettings left, right;
  left.box = BoxSelector{Vec3(0, 0, 0), Vec3(0, 1, 1)};
  right.box = BoxSelector{Vec3(1, 0, 0), Vec3(1, 1, 1)};
  body.settings.pin = {left, right};
  const Model model({body}, Vec3::Zero());
  VecX q = as_q(body.mesh.X);
  for (int v = 0; v < body.mesh.vertex_count(); ++v)
    if (body.mesh.X(v, 0) == 1.0) q[3 * v] += kPulled;
  ASSERT_TRUE(is_good(static_equilibrium(model, SolverSettings{.tolerance = 1e-10}, q).status));
  const double middle = kPulled * kSecond / (kFirst + kSecond);
  for (int v = 0; v < body.mesh.vertex_count(); ++v) {
    const double x = body.mesh.X(v, 0);
    const double moved = x <= 0.5 ? 2 * x * middle : middle + (2 * x - 1) * (kPulled - middle);
    EXPECT_NEAR(q[3 * v] - x, moved, 1e-9);
    EXPECT_NEAR(q[3 * v + 1], body.mesh.X(v, 1), 1e-9);
  }
}

TEST(Tissue, TakesPaintedValuesOfTetsAndOfVertices) {
  const TetMesh cube = cube_mesh(2);
  BodySettings settings;
  settings.material = material(1e5);
  FieldSettings by_tet, by_vertex;
  by_tet.key = "young";
  for (int j = 0; j < cube.tet_count(); ++j) by_tet.painted.push_back(1e5 + j);
  by_vertex.key = "density";
  for (int v = 0; v < cube.vertex_count(); ++v) by_vertex.painted.push_back(1.0 + cube.X(v, 1));
  by_vertex.scale = true;
  settings.field = {by_tet, by_vertex};
  const Tissue tissue = make_tissue(cube, settings, "body 'a'");
  EXPECT_EQ(young_of(tissue), by_tet.painted);
  for (int j = 0; j < cube.tet_count(); ++j)
    EXPECT_NEAR(tissue.densities[static_cast<std::size_t>(j)], 1000.0 * (1.0 + centroid(cube, j).y()), 1e-9);
}

TEST(Tissue, InterpolatesControlPointsAtCentroidsOverItsRegions) {
  const TetMesh cube = cube_mesh(2);
  BodySettings settings;
  settings.material = material(1e5);
  RegionSettings half = half_of_cube();
  half.material = material(2e5);
  settings.region = {half};
  FieldSettings field;
  field.key = "young";
  field.points = {centroid(cube, 0), centroid(cube, 47), Vec3(0.5, 0.9, 0.1)};
  field.values = {2.0, 5.0, 1.0};
  field.logarithm = field.scale = true;
  settings.field = {field};
  const std::vector<double> young = young_of(make_tissue(cube, settings, "body 'a'"));
  EXPECT_NEAR(young[0], 2.0 * (centroid(cube, 0).x() > 0.5 ? 2e5 : 1e5), 1e-6);
  EXPECT_NEAR(young[47], 5.0 * (centroid(cube, 47).x() > 0.5 ? 2e5 : 1e5), 1e-6);
  for (const double y : young) EXPECT_GT(y, 0.0);
}

TEST(Tissue, TellsWhatIsWrong) {
  const auto region = [](const std::function<void(RegionSettings&)>& change) {
    return error_with([&](BodySettings& b) {
      b.region.emplace_back().density = 1.0;
      b.region.back().where = "a.toml:3:1: body.0.region.0";
      change(b.region.back());
    });
  };
  EXPECT_EQ(region([](RegionSettings&) {}),
            "a.toml:3:1: body.0.region.0: selects nothing; give tag, box, sphere or plane");
  EXPECT_EQ(region([](RegionSettings& r) { r.tag = {9}; }),
            "a.toml:3:1: body.0.region.0: tag 9 selects none of the centroids of 48 tets; the mesh has 0, "
            "1, 2, 3, 4, 5");
  EXPECT_EQ(
      region([](RegionSettings& r) {
        r.sphere = SphereSelector{Vec3(9, 9, 9), 1.0};
      }),
      "a.toml:3:1: body.0.region.0: sphere around [9, 9, 9] of radius 1 selects none of the centroids of "
      "48 tets; the placed body spans [0, 0, 0] to [1, 1, 1]");
  EXPECT_EQ(region([](RegionSettings& r) { r = half_of_cube(); }),
            "body 'a': region 0: changes nothing; give density or material");
  const auto field = [](const std::function<void(FieldSettings&)>& change) {
    return error_with([&](BodySettings& b) {
      FieldSettings& f = b.field.emplace_back();
      f.key = "young";
      f.file = "young.npy";
      f.painted.assign(48, 1e5);
      change(f);
    });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(field([](FieldSettings&) {}), "no error");
  EXPECT_EQ(field([](FieldSettings& f) { f.painted.resize(7); }),
            "body 'a': field 0: young.npy: has 7 values; 48, one a tet, or 27, one a vertex, would be right");
  EXPECT_EQ(field([&](FieldSettings& f) { f.painted[5] = nan; }),
            "body 'a': field 0: young.npy: tet 5: young = nan must be > 0 Pa");
  EXPECT_EQ(field([&](FieldSettings& f) { f.painted[47] = -2.0; }),
            "body 'a': field 0: young.npy: tet 47: young = -2 must be > 0 Pa");
  EXPECT_EQ(field([&](FieldSettings& f) { f.painted.assign(27, 0.6), f.key = "poisson"; }),
            "body 'a': field 0: young.npy: vertex 0: poisson = 0.6 must be in (-1, 0.5)");
  EXPECT_EQ(field([&](FieldSettings& f) { f.key = "mu", f.scale = true; }),
            "body 'a': field 0: young.npy: tet 0: its material has no mu to scale");
  EXPECT_EQ(
      field([&](FieldSettings& f) { f.key = "yuong"; }),
      "body 'a': field 0: unknown key 'yuong'; valid ones are young, poisson, mu, lambda, C, D, density");
  EXPECT_EQ(field([&](FieldSettings& f) { f.file = "", f.painted.clear(); }),
            "body 'a': field 0: give a file, or points and values");
  EXPECT_EQ(error_with([](BodySettings& b) {
              b.material.model = "neo_hookean";
              FieldSettings& f = b.field.emplace_back();
              f.key = "poisson";
              f.painted.assign(48, 0.2);
              f.painted[3] = -0.1;
            }),
            "body 'a': field 0: tet 3: poisson = -0.1 must be in [0, 0.5) for neo_hookean");
}

}  // namespace tissue_test
}  // namespace lagomorph::sim
