#pragma once

#include <memory>

#include "sim/integrator.h"

/// What the table of integrators names.
namespace lagomorph::sim {

std::unique_ptr<Integrator> make_backward_euler(const TimeSettings&, const SolverSettings&, const Model&);
std::unique_ptr<Integrator> make_linearly_implicit_euler(const TimeSettings&, const SolverSettings&,
                                                         const Model&);
std::unique_ptr<Integrator> make_bdf2(const TimeSettings&, const SolverSettings&, const Model&);
std::unique_ptr<Integrator> make_implicit_midpoint(const TimeSettings&, const SolverSettings&, const Model&);
std::unique_ptr<Integrator> make_trapezoidal(const TimeSettings&, const SolverSettings&, const Model&);
std::unique_ptr<Integrator> make_symplectic_euler(const TimeSettings&, const SolverSettings&, const Model&);
std::unique_ptr<Integrator> make_static(const TimeSettings&, const SolverSettings&, const Model&);

/// On from the state along q̇, as far as V is defined: q + h q̇, or a part of it.
VecX moved_on(const Model&, const State&, double h);

/// The largest |d_v| of the vertices that are not pinned. [as d]
double largest_free(const Pins&, const VecX& d);

/// Whether V is: no lecture Neo-Hookean element has turned inside out.
bool is_defined(const Model&, const VecX& q);

}  // namespace lagomorph::sim
