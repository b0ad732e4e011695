#pragma once

#include <memory>

#include "sim/integrator.h"

/// What the table of integrators names.
namespace lagomorph::sim {

std::unique_ptr<Integrator> make_backward_euler(const SolverSettings&, const Model&);
std::unique_ptr<Integrator> make_linearly_implicit_euler(const SolverSettings&, const Model&);

}  // namespace lagomorph::sim
