#include <functional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "sim/conjugate_gradient.h"
#include "sim/linear_solver.h"
#include "sim/materials/stable_neo_hookean.h"
#include "sim/parallel.h"
#include "sim/tet_lanes.h"
#include "tests/bench/course_method.h"
#include "tests/bench/scene.h"

/// The parts of one Newton iteration, and whole steps.
namespace lagomorph::bench {
namespace {

const sim::Energy& elasticity(const Swing& s) { return *s.model.energies().front(); }

/// Of what is read and written once each time, for comparison with triad(). [GB/s]
void set_bandwidth(benchmark::State& timing, double bytes) {
  timing.counters["GB/s"] = benchmark::Counter(1e-9 * bytes, benchmark::Counter::kIsIterationInvariantRate);
}

/// a = b + 3 c of arrays far larger than the caches, on all threads [McCalpin 1995, STREAM].
void triad(benchmark::State& timing) {
  constexpr int count = 1 << 24;
  std::vector<double> a(count), b(count, 1.0), c(count, 2.0);
  for (auto _ : timing) {
    sim::parallel_for(count, 1 << 16, [&](int begin, int end) {
      const double *const from_b = b.data(), *const from_c = c.data();
      double* const to = a.data();
      for (int i = begin; i < end; ++i) to[i] = from_b[i] + 3.0 * from_c[i];
    });
    benchmark::ClobberMemory();
  }
  set_bandwidth(timing, 3.0 * sizeof(double) * count);
}
BENCHMARK(triad)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Of each tet its rule, and of each vertex its position.
double bytes_read(const Swing& s) {
  const auto tets = static_cast<double>(s.model.mesh().tets.size());
  return tets * sizeof(sim::TetLanes::Group) / sim::TetLanes::kLanes +
         sizeof(double) * static_cast<double>(s.state.q.size());
}

void value(benchmark::State& timing, const char* tets) {
  const Swing& s = swing(tets);
  for (auto _ : timing) benchmark::DoNotOptimize(elasticity(s).value(s.state.q));
  set_bandwidth(timing, bytes_read(s));
}

void gradient(benchmark::State& timing, const char* tets) {
  const Swing& s = swing(tets);
  sim::VecX g = sim::VecX::Zero(s.state.q.size());
  for (auto _ : timing) elasticity(s).add_gradient(s.state.q, 1.0, g);
  // Where each tet's vectors go, and the sums, read and written.
  const double places = 4.0 * sizeof(int) * static_cast<double>(s.model.mesh().tets.size());
  set_bandwidth(timing, bytes_read(s) + places + 2.0 * sizeof(double) * static_cast<double>(g.size()));
}

template <sim::HessianKind kind>
void hessian(benchmark::State& timing, const char* tets) {
  const Swing& s = swing(tets);
  sim::BlockHessian H(s.model.pattern());
  for (auto _ : timing) {
    H.set_zero();
    elasticity(s).add_hessian(s.state.q, 1.0, kind, H);
  }
}

/// M/h² + K, projected.
sim::BlockHessian system(const Swing& s) {
  sim::BlockHessian H(s.model.pattern());
  H.set_zero();
  s.model.add_mass(1.0 / (s.h() * s.h()), H);
  elasticity(s).add_hessian(s.state.q, 1.0, sim::HessianKind::projected, H);
  return H;
}

void analysis(benchmark::State& timing, const char* tets) {
  const Swing& s = swing(tets);
  sim::LinearSolver solver(1);
  for (auto _ : timing) solver.analyze(s.model.pattern(), s.model.pins());
  timing.counters["vertices"] = static_cast<double>(s.model.pins().free_vertices().size());
  timing.counters["blocks"] = s.model.pattern()->block_count();
  timing.counters["nonzeros"] = solver.factor_nonzeros();
  timing.counters["flops"] = solver.factor_flops();
}

void factorization(benchmark::State& timing, const char* tets) {
  const Swing& s = swing(tets);
  const sim::BlockHessian H = system(s);
  sim::LinearSolver solver(1);
  solver.analyze(s.model.pattern(), s.model.pins());
  for (auto _ : timing) {
    if (solver.factorize(H) != sim::FactorStatus::ok) timing.SkipWithError("not positive definite");
  }
}

void solve(benchmark::State& timing, const char* tets) {
  const Swing& s = swing(tets);
  sim::LinearSolver solver(1);
  solver.analyze(s.model.pattern(), s.model.pins());
  if (solver.factorize(system(s)) != sim::FactorStatus::ok) timing.SkipWithError("not positive definite");
  sim::VecX x;
  for (auto _ : timing) solver.solve(s.model.gravity_force(), x);
}

void step(benchmark::State& timing, const char* tets) {
  Swing& s = swing(tets);
  int iterations = 0;
  for (auto _ : timing) {
    sim::State state = s.state;
    const sim::StepReport report = s.integrator->step(s.model, state, s.h());
    if (!sim::is_good(report.status)) timing.SkipWithError("not converged");
    iterations = report.newton_iterations;
  }
  timing.counters["newton"] = iterations;
}

/// The same step by the course's method. The ratio to `step` is the claim; its own set-up is in it, some
/// percent.
void course(benchmark::State& timing, const char* tets) {
  Swing& s = swing(tets);
  const sim::MaterialSettings& material = s.scene.body.front().physics.material;
  const auto psi = sim::StableNeoHookean::from_settings(material, "body");
  int iterations = 0;
  for (auto _ : timing) {
    sim::State state = s.state;
    iterations = course_step(s.model, psi.mu, psi.lambda, s.scene.solver.tolerance, s.h(), state);
    if (iterations == 0) timing.SkipWithError("not converged");
  }
  timing.counters["newton"] = iterations;
}

void step_by(benchmark::State& timing, const char* tets, const char* linear) {
  Swing& s = swing(tets);
  sim::SolverSettings settings = s.scene.solver;
  settings.linear = linear;
  const auto integrator = sim::make_integrator(s.scene.time, settings, s.model);
  int iterations = 0;
  for (auto _ : timing) {
    sim::State state = s.state;
    const sim::StepReport report = integrator->step(s.model, state, s.h());
    if (!sim::is_good(report.status)) timing.SkipWithError("not converged");
    iterations = report.newton_iterations;
  }
  timing.counters["newton"] = iterations;
}

/// Conjugate gradients preconditioned by the diagonal's blocks, to what a Newton step asks of them first.
void cg_solve(benchmark::State& timing, const char* tets) {
  const Swing& s = swing(tets);
  const sim::BlockHessian H = system(s);
  sim::BlockJacobiCg cg;
  cg.analyze(s.model.pattern(), s.model.pins());
  sim::VecX x;
  int iterations = 0;
  for (auto _ : timing) {
    cg.set_matrix(H);
    iterations = cg.solve(s.model.gravity_force(), {1e-3, 10000}, x).iterations;
  }
  timing.counters["iterations"] = iterations;
}

void surface(benchmark::State& timing, const char* tets) {
  Swing& s = swing(tets);
  const std::vector<sim::Surface> surfaces = apps::build_surfaces(s.scene, s.model, s.progress);
  for (auto _ : timing) benchmark::DoNotOptimize(surfaces.front().positions(s.state.q));
}

void add(const char* name, const char* tets,
         const std::function<void(benchmark::State&, const char*)>& timed) {
  benchmark::RegisterBenchmark((std::string(name) + "/" + tets).c_str(), timed, tets)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

const bool registered = [] {
  add("value", "205k", value);
  add("gradient", "205k", gradient);
  for (const char* const tets : {"5k", "25k", "5k_soft", "25k_soft"}) {
    add("value", tets, value);
    add("gradient", tets, gradient);
    add("exact_hessian", tets, hessian<sim::HessianKind::exact>);
    add("projected_hessian", tets, hessian<sim::HessianKind::projected>);
    add("analysis", tets, analysis);
    add("factorization", tets, factorization);
    add("solve", tets, solve);
    add("cg_solve", tets, cg_solve);
    add("step", tets, step);
    for (const char* const linear : {"cholmod", "cg"})
      add((std::string("step_") + linear).c_str(), tets,
          [linear](benchmark::State& timing, const char* of) { step_by(timing, of, linear); });
    add("course_step", tets, course);
    add("surface", tets, surface);
  }
  return true;
}();

}  // namespace
}  // namespace lagomorph::bench
