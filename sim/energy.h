#pragma once

#include <string_view>

#include "sim/block_hessian.h"
#include "sim/types.h"

namespace lagomorph::sim {

/// A term of the potential V(q). One virtual call a term, never one an element.
class Energy {
public:
  virtual ~Energy() = default;
  virtual std::string_view name() const = 0;
  /// V(q) [J]; +inf where the energy is not defined (a lecture Neo-Hookean element with J <= 0).
  virtual double value(const VecX& q) const = 0;
  /// Size of the numbers that value(q) is summed from, where they cancel: rounding leaves it uncertain by
  /// some 1e-16 of this and of |value(q)|. [J]
  virtual double value_scale(const VecX& q) const = 0;
  /// g += scale · ∂V/∂q [N].
  virtual void add_gradient(const VecX& q, double scale, VecX& g) const = 0;
  /// H += scale · ∂²V/∂q² [N/m], exact or projected element by element to positive semi-definite.
  virtual void add_hessian(const VecX& q, double scale, HessianKind kind, BlockHessian& H) const = 0;
  /// Largest fraction in (0, 1] of the step dq that stays where the energy is defined, with a margin.
  virtual double max_step(const VecX& q, const VecX& dq) const = 0;
};

}  // namespace lagomorph::sim
