#include "sim/solver_trial.h"

#include "sim/profile.h"

namespace lagomorph::sim {

void try_at_rest(SystemSolver& solver, double m, const Model& model, const Pins& pins,
                 const SystemWeights& weights, BlockHessian& H) {
  if (!solver.needs_trial(m)) return;
  const VecX q = as_q(model.mesh().X);
  {
    const Timed timed(Stage::hessian);
    H.set_zero();
    for (const auto& term : model.energies())
      term->add_hessian(q, weights.stiffness, HessianKind::projected, H);
    model.add_mass(weights.mass, H);
  }
  VecX b = model.mass_times(VecX::Ones(q.size()));
  pins.clear_pinned(b);
  solver.try_at_rest(m, H, b);
}

}  // namespace lagomorph::sim
