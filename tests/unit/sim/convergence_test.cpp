#include <array>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "sim/element.h"
#include "sim/materials/stable_neo_hookean.h"
#include "sim/model.h"
#include "sim/newton.h"
#include "sim/point_location.h"
#include "sim/refine.h"
#include "sim/statics.h"
#include "tests/support/ledger.h"
#include "tests/unit/sim/mesh_fixtures.h"

/// What the elements are worth: orders of convergence, and locking.
namespace lagomorph::sim {
namespace convergence_test {

constexpr double kYoung = 1e4, kPoisson = 0.3;

MaterialSettings material(double young, double poisson) {
  MaterialSettings settings;
  settings.young = young;
  settings.poisson = poisson;
  return settings;
}

/// Points and weights on [0, 1] of Gauss's rule of four points, of degree 7.
constexpr std::array<std::array<double, 2>, 4> kGauss = {{{0.06943184420297371, 0.17392742256872693},
                                                          {0.33000947820757187, 0.32607257743127307},
                                                          {0.66999052179242813, 0.32607257743127307},
                                                          {0.93056815579702629, 0.17392742256872693}}};

/// Calls visit(λ, w) for a rule of degree 5 on a tet, Gauss's on a collapsed cube; the weights sum to 1.
void for_each_point(const std::function<void(const Eigen::Vector4d&, double)>& visit) {
  for (const auto& [a, wa] : kGauss)
    for (const auto& [b, wb] : kGauss)
      for (const auto& [c, wc] : kGauss) {
        const double x = a, y = b * (1 - a), z = c * (1 - a) * (1 - b);
        visit({1 - x - y - z, x, y, z}, 6.0 * wa * wb * wc * (1 - a) * (1 - a) * (1 - b));
      }
}

/// u_k = s sin(w_k·X + k), and the body force that holds it in equilibrium: f = -Div P(I + ∂u/∂X).
struct Manufactured {
  static constexpr double s = 0.03;
  Mat3 w =
      (Mat3() << 2.0, 1.5, -1.0, -1.0, 2.5, 1.0, 1.5, -0.5, 2.0).finished();  // a wave vector a row [1/m]
  StableNeoHookean density = StableNeoHookean::from_settings(material(kYoung, kPoisson), "test");

  double phase(int k, const Vec3& X) const { return w.row(k).dot(X) + k; }
  Vec3 x(const Vec3& X) const {
    return X + s * Vec3(std::sin(phase(0, X)), std::sin(phase(1, X)), std::sin(phase(2, X)));
  }
  Vec3 force(const Vec3& X) const {
    Mat3 F = Mat3::Identity();
    for (int k = 0; k < 3; ++k) F.row(k) += s * std::cos(phase(k, X)) * w.row(k);
    const Mat9 H = density.d2psi_dF2(F);
    Vec3 f = Vec3::Zero();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l)
            f[i] += H(3 * i + j, 3 * k + l) * s * std::sin(phase(k, X)) * w(k, l) * w(k, j);
    return f;
  }
};

/// |x_h - x| in L2 over the unit cube, of the equilibrium under the manufactured force. [m]
double error_of(TetMesh mesh) {
  const Manufactured exact;
  BodySettings settings;
  settings.material = material(kYoung, kPoisson);
  PinSettings border;
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.X.row(v).minCoeff() == 0.0 || mesh.X.row(v).maxCoeff() == 1.0) border.vertices.push_back(v);
  settings.pin.push_back(border);
  const Model model({{mesh, settings}}, Vec3::Zero());
  const VecX X = model.initial_state().q;
  const auto visit = [&](const std::function<void(int, const Eigen::Vector4d&, const Vec3&, double)>& add) {
    for (int j = 0; j < mesh.tet_count(); ++j) {
      const TetCorners corners = gather_corners(X, mesh.tets[static_cast<std::size_t>(j)]);
      for_each_point([&](const Eigen::Vector4d& lambda, double weight) {
        add(j, lambda, corners * lambda, weight * tet_volume(corners));
      });
    }
  };
  VecX load = VecX::Zero(X.size()), q = X;
  visit([&](int j, const Eigen::Vector4d& lambda, const Vec3& at, double weight) {
    const Vec3 f = weight * exact.force(at);
    for_each_phi(mesh, j, lambda, [&](int node, double phi) { load.segment<3>(3 * node) += phi * f; });
  });
  for (int v = 0; v < mesh.vertex_count(); ++v) q.segment<3>(3 * v) = exact.x(mesh.X.row(v));
  SolverSettings solver;
  solver.tolerance = 1e-10;
  IncrementalPotential potential;
  potential.f = load;
  EXPECT_TRUE(is_good(Newton(model, solver).minimize(model, potential, q).status));
  double squared = 0.0;
  visit([&](int j, const Eigen::Vector4d& lambda, const Vec3& at, double weight) {
    squared += weight * (interpolate(mesh, {j, lambda, 0.0}, as_points(q)) - exact.x(at)).squaredNorm();
  });
  return std::sqrt(squared);
}

TEST(ManufacturedSolution, LinearTetsConvergeWithOrderTwo) {
  const double coarse = error_of(irregular_cube_mesh(4)), fine = error_of(refined(irregular_cube_mesh(4)));
  const double order = std::log2(coarse / fine);
  tell("manufactured", {"element", "error on a cube of 4³ cells, L2 [m]", "refined", "order"},
       {"tet4", told(coarse), told(fine), told(order)});
  EXPECT_NEAR(order, 2.0, 0.15) << coarse << " m, " << fine << " m";
}

TEST(ManufacturedSolution, QuadraticTetsConvergeWithOrderThree) {
  const TetMesh mesh = with_quadratic_tets(irregular_cube_mesh(3));
  const double coarse = error_of(mesh), fine = error_of(refined(mesh));
  const double order = std::log2(coarse / fine);
  tell("manufactured", {}, {"tet10, 3³ cells", told(coarse), told(fine), told(order)});
  EXPECT_NEAR(order, 3.0, 0.2) << coarse << " m, " << fine << " m";
}

/// How far the end of a bar of 1 × 0.2 × 0.2 m sags that is clamped at x = 0, over the deflection by
/// Timoshenko's theory: ρ g A L⁴ / 8EI + ρ g L² / 2κG with Cowper's κ = 10 (1 + ν) / (12 + 11 ν). The load is
/// small.
double sag_ratio(TetMesh mesh, double poisson) {
  const double young = 1e6, density = 1000.0, gravity = 1e-3, L = 1.0, h = 0.2;
  BodySettings settings;
  settings.density = density;
  settings.material = material(young, poisson);
  PinSettings clamp;
  clamp.plane = PlaneSelector{Vec3::Zero(), Vec3(-1, 0, 0)};
  settings.pin.push_back(clamp);
  int tip = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if ((mesh.X.row(v).transpose() - Vec3(L, h / 2, h / 2)).norm() < 1e-9) tip = v;
  const Model model({{std::move(mesh), settings}}, Vec3(0, -gravity, 0));
  State state = model.initial_state();
  SolverSettings solver;
  solver.tolerance = 1e-8;
  EXPECT_TRUE(is_good(static_equilibrium(model, solver, state.q).status));
  const double A = h * h, I = h * h * h * h / 12.0, G = young / (2.0 * (1.0 + poisson));
  const double kappa = 10.0 * (1.0 + poisson) / (12.0 + 11.0 * poisson);
  const double expected = density * gravity * A * std::pow(L, 4) / (8.0 * young * I) +
                          density * gravity * L * L / (2.0 * kappa * G);
  return (h / 2 - state.q[3 * tip + 1]) / expected;
}

TEST(VolumetricLocking, LinearTetsLockAndQuadraticOnesDoNot) {
  const TetMesh coarse = box_mesh(10, 2, 2, 10), quadratic = with_quadratic_tets(coarse);
  const double reference = sag_ratio(refined(quadratic), 0.49);
  // A clamp that holds its cross-section stiffens the first part of the bar by up to 1/(1 - ν²).
  EXPECT_LT(reference, 1.0);
  EXPECT_GT(reference, 0.9);
  const double tet10 = sag_ratio(quadratic, 0.49), tet4 = sag_ratio(coarse, 0.49);
  const double tet4_refined = sag_ratio(refined(coarse), 0.49);  // as many nodes as tet10 has
  const auto row = [](const char* what, double ratio) {
    tell("locking", {"bar of 10×2×2 cells, ν = 0.49", "sag / Timoshenko's"}, {what, told(ratio)});
  };
  row("tet4", tet4);
  row("tet4, refined: as many nodes as tet10 has", tet4_refined);
  row("tet10", tet10);
  row("tet10, refined", reference);
  EXPECT_GT(tet10, 0.95 * reference);
  EXPECT_LT(tet4, 0.5 * reference);
  EXPECT_LT(tet4_refined, 0.8 * reference);
}

}  // namespace convergence_test
}  // namespace lagomorph::sim
