#include <functional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "sim/linear_solver.h"
#include "tests/bench/scene.h"

/// The parts of one Newton iteration, and whole steps.
namespace lagomorph::bench {
namespace {

const sim::Energy& elasticity(const Swing& s) { return *s.model.energies().front(); }

void value(benchmark::State& timing, const char* tets) {
  const Swing& s = swing(tets);
  for (auto _ : timing) benchmark::DoNotOptimize(elasticity(s).value(s.state.q));
}

void gradient(benchmark::State& timing, const char* tets) {
  const Swing& s = swing(tets);
  sim::VecX g = sim::VecX::Zero(s.state.q.size());
  for (auto _ : timing) elasticity(s).add_gradient(s.state.q, 1.0, g);
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
  for (const char* const tets : {"5k", "25k"}) {
    add("value", tets, value);
    add("gradient", tets, gradient);
    add("exact_hessian", tets, hessian<sim::HessianKind::exact>);
    add("projected_hessian", tets, hessian<sim::HessianKind::projected>);
    add("analysis", tets, analysis);
    add("factorization", tets, factorization);
    add("solve", tets, solve);
    add("step", tets, step);
    add("surface", tets, surface);
  }
  return true;
}();

}  // namespace
}  // namespace lagomorph::bench
