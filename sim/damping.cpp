#include "sim/damping.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/elasticity.h"
#include "sim/error.h"
#include "sim/text.h"

namespace lagomorph::sim {

namespace {

/// Not an energy, but goes through the loop of those: its "∂²ψ/∂F²" is what takes Ḟ to P = 2 η F sym(FᵀḞ) =
/// η (F Fᵀ Ḟ + F Ḟᵀ F), the same as St. Venant and Kirchhoff's with mu = η and without stress.
struct Viscosity {
  static constexpr const char* kName = "viscosity";
  static constexpr bool kNeedsPositiveJ = false;
  double eta;  // [Pa s]

  static Viscosity from_settings(const MaterialSettings&, const std::string& where) {
    throw InputError(where + ": viscosity is no material");
  }
  double psi(const Mat3&) const { return 0.0; }
  Mat3 dpsi_dF(const Mat3&) const { return Mat3::Zero(); }
  Mat9 d2psi_dF2(const Mat3& F) const {
    const Mat3 FFt = F * F.transpose();
    Mat9 h;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        for (int r = 0; r < 3; ++r)
          for (int s = 0; s < 3; ++s)
            h(3 * i + k, 3 * r + s) = eta * ((k == s ? FFt(i, r) : 0.0) + F(i, s) * F(r, k));
    return h;
  }
  Mat9 projected_d2psi_dF2(const Mat3& F) const { return d2psi_dF2(F); }
  double stiffness() const { return 0.0; }
};

void check(const DampingSettings& damping, const std::string& where) {
  const auto check_one = [&](const char* key, double value, const char* unit) {
    if (!(value >= 0.0 && std::isfinite(value)))
      throw InputError(where + ": damping." + key + " = " + short_number(value) + " must be >= 0 " + unit);
  };
  check_one("mass", damping.mass, "1/s");
  check_one("stiffness", damping.stiffness, "s");
  check_one("viscosity", damping.viscosity, "Pa s");
}

}  // namespace

Damping::Damping(const TetMesh& mesh, const std::vector<DampingSettings>& of_bodies, VecX mass_blocks,
                 const std::shared_ptr<const BlockPattern>& pattern) {
  std::vector<int> linear, quadratic;  // tets that are viscous
  std::vector<Viscosity> of_linear, of_quadratic;
  bool is_damped = false;
  for (std::size_t b = 0; b < of_bodies.size(); ++b) {
    const DampingSettings& d = of_bodies[b];
    check(d, "body '" + mesh.bodies[b].name + "'");
    const Range &v = mesh.bodies[b].vertices, &tets = mesh.bodies[b].tets;
    const auto start = [&](int vertex) { return pattern->starts()[static_cast<std::size_t>(vertex)]; };
    bodies_.push_back({{start(v.begin), start(v.end)}, d.mass, d.stiffness});
    has_beta_ |= d.stiffness > 0.0;
    is_damped |= d.mass > 0.0 || d.stiffness > 0.0 || d.viscosity > 0.0;
    if (d.viscosity == 0.0) continue;
    for (int j = tets.begin; j < tets.end; ++j) {
      const bool is_quadratic = mesh.is_quadratic(static_cast<std::size_t>(j));
      (is_quadratic ? quadratic : linear).push_back(j);
      (is_quadratic ? of_quadratic : of_linear).push_back({d.viscosity});
    }
  }
  if (!is_damped) bodies_.clear();
  mass_blocks_ = std::move(mass_blocks);
  if (!linear.empty())
    viscosity_.push_back(std::make_unique<Elasticity<Viscosity, Tet4>>(mesh, linear, of_linear, pattern));
  if (!quadratic.empty())
    viscosity_.push_back(
        std::make_unique<Elasticity<Viscosity, Tet10>>(mesh, quadratic, of_quadratic, pattern));
}

void Damping::assemble(const std::vector<std::unique_ptr<Energy>>& energies, const VecX& q,
                       BlockHessian& C) const {
  C.set_zero();
  if (has_beta_)
    for (const auto& term : energies) term->add_hessian(q, 1.0, HessianKind::projected, C);
  for (const Body& body : bodies_) {
    for (int k = body.blocks.begin; k < body.blocks.end; ++k) {
      C.block(k) *= body.beta;
      C.block(k).diagonal().array() += body.alpha * mass_blocks_[k];
    }
  }
  for (const auto& term : viscosity_) term->add_hessian(q, 1.0, HessianKind::exact, C);
}

}  // namespace lagomorph::sim
