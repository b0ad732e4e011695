#include "tests/bench/course_method.h"

#include <vector>

#include <Eigen/SparseCholesky>

#include "sim/kinematics.h"
#include "sim/materials/stable_neo_hookean.h"

namespace lagomorph::bench {
namespace {

using sim::Mat12;
using sim::SparseMatrix;
using sim::Vec12;
using sim::VecX;

struct CourseModel {
  const sim::Model& model;
  sim::StableNeoHookean psi;
  SparseMatrix M, P;
  std::vector<Eigen::Matrix<double, 9, 12>> B;
  std::vector<sim::ShapeGradients> D;
  std::vector<double> volume;

  CourseModel(const sim::Model& m, double mu, double lambda)
      : model(m), psi{mu, lambda}, M(m.mass()), P(m.pins().matrix()) {
    const VecX X = sim::as_q(m.mesh().X);
    for (const sim::Tet& tet : m.mesh().tets) {
      const sim::TetCorners corners = sim::gather_corners(X, tet);
      D.push_back(sim::dphi_dX(corners));
      B.push_back(sim::B_matrix(D.back()));
      volume.push_back(sim::tet_volume(corners));
    }
  }

  double energy(const VecX& q) const {
    double V = 0.0;
    for (std::size_t j = 0; j < D.size(); ++j)
      V += volume[j] * psi.psi(sim::deformation_gradient(sim::gather_corners(q, model.mesh().tets[j]), D[j]));
    return V - model.gravity_force().dot(q);
  }
  VecX gradient(const VecX& q) const {
    VecX g = -model.gravity_force();
    for (std::size_t j = 0; j < D.size(); ++j) {
      const sim::Tet& tet = model.mesh().tets[j];
      const sim::Mat3 F = sim::deformation_gradient(sim::gather_corners(q, tet), D[j]);
      const Vec12 g_j = volume[j] * B[j].transpose() * sim::vec(psi.dpsi_dF(F));
      for (int a = 0; a < 4; ++a) g.segment<3>(3 * tet[static_cast<std::size_t>(a)]) += g_j.segment<3>(3 * a);
    }
    return g;
  }
  SparseMatrix hessian(const VecX& q) const {
    std::vector<Eigen::Triplet<double>> triplets;
    triplets.reserve(144 * D.size());
    for (std::size_t j = 0; j < D.size(); ++j) {
      const sim::Tet& tet = model.mesh().tets[j];
      const sim::Mat3 F = sim::deformation_gradient(sim::gather_corners(q, tet), D[j]);
      const Mat12 K = volume[j] * B[j].transpose() * psi.d2psi_dF2(F) * B[j];
      for (int r = 0; r < 12; ++r)
        for (int c = 0; c < 12; ++c)
          triplets.emplace_back(3 * tet[static_cast<std::size_t>(r / 3)] + r % 3,
                                3 * tet[static_cast<std::size_t>(c / 3)] + c % 3, K(r, c));
    }
    SparseMatrix H(q.size(), q.size());
    H.setFromTriplets(triplets.begin(), triplets.end());
    return H;
  }
};

}  // namespace

int course_step(const sim::Model& model, double mu, double lambda, double tolerance, double h,
                sim::State& state) {
  const CourseModel course(model, mu, lambda);
  const VecX predicted = state.q + h * state.qdot;
  const double reference = model.pins().free_norm(model.gravity_force());
  const auto cost = [&](const VecX& q) {
    const VecX dq = q - predicted;
    return 0.5 / (h * h) * dq.dot(course.M * dq) + course.energy(q);
  };
  VecX q = predicted;
  for (int iteration = 1; iteration <= 50; ++iteration) {
    const VecX g = course.P * VecX(1.0 / (h * h) * (course.M * (q - predicted)) + course.gradient(q));
    if (g.norm() <= tolerance * reference) {
      state.qdot = (q - state.q) / h;
      state.q = q;
      state.t += h;
      return iteration - 1;
    }
    const SparseMatrix H = 1.0 / (h * h) * course.M + course.hessian(q);
    const SparseMatrix free = course.P * H * SparseMatrix(course.P.transpose());
    const Eigen::SimplicialLDLT<SparseMatrix> solver(free);
    if (solver.info() != Eigen::Success) return 0;
    const VecX direction = course.P.transpose() * VecX(solver.solve(-g));
    double step = 1.0;
    const double here = cost(q);
    while (step > 1e-8 && !(cost(q + step * direction) <= here)) step *= 0.5;
    q += step * direction;
  }
  return 0;
}

}  // namespace lagomorph::bench
