#pragma once

#include "sim/energy.h"

namespace lagomorph::sim {

/// V = -f_gᵀ q with the constant force f_g = M (g, g, ...); zero at the origin. (lecture, "Gravity")
class Gravity : public Energy {
public:
  explicit Gravity(VecX force);  // f_g, 3n [N]
  std::string_view name() const override { return "gravity"; }
  double value(const VecX& q) const override;
  double value_scale(const VecX& q) const override;
  void add_gradient(const VecX& q, double scale, VecX& g) const override;
  void add_hessian(const VecX& q, double scale, HessianKind kind, BlockHessian& H) const override;
  double max_step(const VecX& q, const VecX& dq) const override;

private:
  VecX f_g_;
};

}  // namespace lagomorph::sim
