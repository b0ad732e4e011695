#include "sim/gravity.h"

#include "sim/compensated_sum.h"

namespace lagomorph::sim {

Gravity::Gravity(VecX force) : f_g_(std::move(force)) {}

double Gravity::value(const VecX& q) const {
  CompensatedSum work;
  for (Eigen::Index i = 0; i < q.size(); ++i) work.add(f_g_[i] * q[i]);
  return -work.value();
}

double Gravity::value_scale(const VecX& q) const { return f_g_.cwiseAbs().dot(q.cwiseAbs()); }

void Gravity::add_gradient(const VecX&, double scale, VecX& g) const { g -= scale * f_g_; }

void Gravity::add_hessian(const VecX&, double, HessianKind, BlockHessian&) const {}

double Gravity::max_step(const VecX&, const VecX&) const { return 1.0; }

}  // namespace lagomorph::sim
