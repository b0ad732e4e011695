#pragma once

#include <string>
#include <vector>

#include "sim/energy.h"
#include "sim/settings.h"

namespace lagomorph::sim {

/// V = Σ k/2 (|x_v - p| - L)²: a spring from each of some vertices v to a point p of its own.
class Springs : public Energy {
public:
  struct Spring {
    int vertex = 0;
    double stiffness = 0.0;    // k [N/m]
    Vec3 to = Vec3::Zero();    // p [m]
    double rest_length = 0.0;  // L [m]
  };
  explicit Springs(std::vector<Spring> springs) : springs_(std::move(springs)) {}

  std::string_view name() const override { return "springs"; }
  double value(const VecX& q) const override;
  double value_scale(const VecX& q) const override;
  void add_gradient(const VecX& q, double scale, VecX& g) const override;
  void add_hessian(const VecX& q, double scale, HessianKind kind, BlockHessian& H) const override;
  double max_step(const VecX&, const VecX&) const override { return 1.0; }

private:
  std::vector<Spring> springs_;
};

/// Appends those of a body, whose vertices in the mesh of all begin at `first_vertex`. `X` are its placed
/// rest positions. Throws InputError, prefixed by `where`.
void append_springs(const BodySettings&, const Points& X, int first_vertex, const std::string& where,
                    std::vector<Springs::Spring>&);

}  // namespace lagomorph::sim
