#pragma once

#include <memory>

#include "sim/integrator.h"

/// What the table of integrators names.
namespace lagomorph::sim {

std::unique_ptr<Integrator> make_backward_euler(const SolverSettings&, const Model&);
std::unique_ptr<Integrator> make_linearly_implicit_euler(const SolverSettings&, const Model&);
std::unique_ptr<Integrator> make_bdf2(const SolverSettings&, const Model&);
std::unique_ptr<Integrator> make_implicit_midpoint(const SolverSettings&, const Model&);
std::unique_ptr<Integrator> make_trapezoidal(const SolverSettings&, const Model&);
std::unique_ptr<Integrator> make_symplectic_euler(const SolverSettings&, const Model&);

/// Whether V is: no lecture Neo-Hookean element has turned inside out.
bool is_defined(const Model&, const VecX& q);

}  // namespace lagomorph::sim
