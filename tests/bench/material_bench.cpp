#include <random>
#include <string>
#include <vector>

#include <Eigen/Eigenvalues>
#include <benchmark/benchmark.h>

#include "sim/materials/arap.h"
#include "sim/materials/corotated.h"
#include "sim/materials/fibre.h"
#include "sim/materials/fixed_corotated.h"
#include "sim/materials/mooney_rivlin.h"
#include "sim/materials/neo_hookean.h"
#include "sim/materials/neo_hookean_log.h"
#include "sim/materials/st_venant_kirchhoff.h"
#include "sim/materials/stable_neo_hookean.h"
#include "sim/materials/stable_neo_hookean_log.h"

/// Positive semi-definite Hessians of each material: by the analytic eigensystem against the eigen
/// decomposition of the 9×9, over the same 1000 deformation gradients, most of them indefinite.
namespace lagomorph::bench {
namespace {

template <class Material>
Material material() {
  sim::MaterialSettings settings;
  settings.model = Material::kName;
  settings.fibre = sim::FibreSettings{
      .direction = sim::Vec3(1, 2, 3), .stiffness = 1e5, .exponent = 1.0, .compression = true};
  return Material::from_settings(settings, "bench");
}

const std::vector<sim::Mat3>& gradients() {
  static const std::vector<sim::Mat3> all = [] {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-0.3, 0.3);
    std::vector<sim::Mat3> made;
    while (made.size() < 1000) {
      const sim::Mat3 F =
          0.8 * sim::Mat3::Identity() + sim::Mat3::NullaryExpr([&] { return uniform(random); });
      if (F.determinant() > 0.05) made.push_back(F);
    }
    return made;
  }();
  return all;
}

template <class Material>
sim::Mat9 exact(const Material& m, const sim::Mat3& F) {
  return m.d2psi_dF2(F);
}

template <class Material>
sim::Mat9 analytic(const Material& m, const sim::Mat3& F) {
  return m.projected_d2psi_dF2(F);
}

template <class Material>
sim::Mat9 numerical(const Material& m, const sim::Mat3& F) {
  const Eigen::SelfAdjointEigenSolver<sim::Mat9> eigen(m.d2psi_dF2(F));
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() *
         eigen.eigenvectors().transpose();
}

template <class Material>
void add(const char* how, sim::Mat9 (*hessian)(const Material&, const sim::Mat3&)) {
  benchmark::RegisterBenchmark((std::string("material/") + Material::kName + "/" + how).c_str(),
                               [hessian](benchmark::State& timing) {
                                 const Material m = material<Material>();
                                 std::size_t next = 0;
                                 for (auto _ : timing) {
                                   benchmark::DoNotOptimize(hessian(m, gradients()[next]));
                                   next = (next + 1) % gradients().size();
                                 }
                               });
}

template <class... Materials>
bool add_all() {
  (..., (add<Materials>("exact", exact<Materials>), add<Materials>("analytic", analytic<Materials>),
         add<Materials>("numerical", numerical<Materials>)));
  return true;
}

const bool registered = add_all<sim::NeoHookean, sim::NeoHookeanLog, sim::StableNeoHookean,
                                sim::StableNeoHookeanLog, sim::MooneyRivlin, sim::StVenantKirchhoff,
                                sim::Corotated, sim::FixedCorotated, sim::Arap, sim::Fibre>();

}  // namespace
}  // namespace lagomorph::bench
