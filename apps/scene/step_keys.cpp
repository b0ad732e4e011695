#include "apps/scene/step_keys.h"

#include "sim/integrator.h"

namespace lagomorph::apps {
namespace {

constexpr Part simulation = Part::simulation;

std::vector<std::string> hessian_choices() { return {"auto", "projected"}; }
std::vector<std::string> linear_choices() { return {"auto", "cholmod", "cg"}; }

}  // namespace

void visit_time(sim::TimeSettings& t, KeyVisitor& v) {
  v.key({.name = "fps",
         .unit = "1/s",
         .bounds = above(0),
         .part = simulation,
         .meaning = "frames a second; frame k is at t = k / fps"},
        &t.fps);
  v.key({.name = "frames",
         .bounds = between(1, 1e7),
         .part = Part::none,
         .meaning = "pictures 0 .. frames - 1; frame 0 is the initial state",
         .default_note = "150; 2 with the integrator static"},
        &t.frames);
  v.key({.name = "substeps", .bounds = at_least(1), .part = simulation, .meaning = "steps a frame"},
        &t.substeps);
  v.key(
      {.name = "integrator",
       .part = simulation,
       .meaning = "time-stepping scheme; static: frame 0 is at rest, each other the equilibrium of its time",
       .choices = sim::integrator_names},
      &t.integrator);
  v.key({.name = "gravity", .unit = "m/s^2", .part = simulation, .meaning = "acceleration of free fall"},
        &t.gravity);
  v.key({.name = "error_tolerance",
         .unit = "m",
         .bounds = above(0),
         .part = simulation,
         .meaning = "a step whose estimated error of positions is larger is halved"},
        &t.error_tolerance);
}

void visit_solver(sim::SolverSettings& s, KeyVisitor& v) {
  v.key({.name = "tolerance",
         .bounds = inside(0, 1),
         .part = simulation,
         .meaning =
             "Newton stops at |g_free| <= tolerance * |(M g)_free|, 2-norms; without gravity the largest "
             "of the inertial and elastic parts instead"},
        &s.tolerance);
  v.key({.name = "max_iterations",
         .bounds = at_least(1),
         .part = simulation,
         .meaning = "Newton iterations a step"},
        &s.max_iterations);
  v.key({.name = "max_halvings",
         .bounds = between(0, 30),
         .part = simulation,
         .meaning = "how often a step that does not converge is halved before the run ends"},
        &s.max_halvings);
  v.key(
      {.name = "hessian",
       .part = simulation,
       .meaning = "auto: exact while its Cholesky factorization succeeds, else projected element by element; "
                  "projected: always",
       .choices = hessian_choices},
      &s.hessian);
  v.key(
      {.name = "linear",
       .part = simulation,
       .meaning =
           "how linear systems are solved. cg: conjugate gradients preconditioned by the diagonal's blocks; "
           "cholmod: a factor a step, which preconditions its further systems; auto: cg while that is less "
           "work, else the like with a factor at rest, turned with the body, while strains are small",
       .choices = linear_choices},
      &s.linear);
  v.key({.name = "blas_threads",
         .bounds = between(1, 64),
         .part = simulation,
         .meaning = "threads of OpenBLAS inside CHOLMOD; part of the result's bits, so of the scene"},
        &s.blas_threads);
}

}  // namespace lagomorph::apps
