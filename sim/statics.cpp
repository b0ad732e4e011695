#include "sim/statics.h"

namespace lagomorph::sim {

NewtonReport static_equilibrium(const Model& model, const SolverSettings& settings, VecX& q) {
  return Newton(model, settings).minimize(model, IncrementalPotential{}, q);
}

}  // namespace lagomorph::sim
