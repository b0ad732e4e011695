#include "tests/unit/sim/material_rows.h"

#include <type_traits>
#include <utility>

#include "sim/elasticity.h"
#include "sim/materials/arap.h"
#include "sim/materials/corotated.h"
#include "sim/materials/fibre.h"
#include "sim/materials/fixed_corotated.h"
#include "sim/materials/linear_elasticity.h"
#include "sim/materials/mooney_rivlin.h"
#include "sim/materials/neo_hookean.h"
#include "sim/materials/neo_hookean_log.h"
#include "sim/materials/st_venant_kirchhoff.h"
#include "sim/materials/stable_neo_hookean.h"
#include "sim/materials/stable_neo_hookean_log.h"
#include "sim/materials/stress_strain.h"

namespace lagomorph::sim {

namespace {

template <class Material>
Material material_with(double young, double poisson) {
  MaterialSettings settings;
  settings.model = Material::kName;
  settings.young = young;
  settings.poisson = poisson;
  settings.fibre =
      FibreSettings{.direction = Vec3(1, 2, -0.5), .stiffness = young, .exponent = 1.5, .compression = true};
  if constexpr (std::is_same_v<Material, StressStrain>)
    settings.data = {{-0.7, -6.0}, {-0.3, -0.7}, {0.0, 0.0}, {0.4, 0.6}, {1.5, 4.0}};
  return Material::from_settings(settings, "test");
}

template <class Material>
class DensityOf : public AnyDensity {
public:
  static_assert(EnergyDensity<Material>);
  explicit DensityOf(const Material& material) : material_(material) {}
  double psi(const Mat3& F) const override { return material_.psi(F); }
  Mat3 dpsi_dF(const Mat3& F) const override { return material_.dpsi_dF(F); }
  Mat9 d2psi_dF2(const Mat3& F) const override { return material_.d2psi_dF2(F); }
  Mat9 projected_d2psi_dF2(const Mat3& F) const override { return material_.projected_d2psi_dF2(F); }

private:
  Material material_;
};

template <class Material>
std::unique_ptr<AnyDensity> make(double young, double poisson) {
  return std::make_unique<DensityOf<Material>>(material_with<Material>(young, poisson));
}

template <class Material>
std::unique_ptr<Energy> elasticity(const TetMesh& mesh, const std::vector<int>& elements,
                                   const std::vector<double>& young,
                                   const std::shared_ptr<const BlockPattern>& pattern) {
  std::vector<Material> materials;
  for (const double y : young) materials.push_back(material_with<Material>(y, 0.3));
  return std::make_unique<Elasticity<Material>>(mesh, elements, std::move(materials), pattern);
}

template <class Material>
MaterialRow row() {
  return {.name = Material::kName,
          .needs_positive_J = Material::kNeedsPositiveJ,
          .is_isotropic = true,
          .is_objective = true,
          .is_ever_indefinite = true,
          .has_rotation = false,
          .is_in_truth = false,
          .make = make<Material>,
          .elasticity = elasticity<Material>};
}

template <class Material>
MaterialRow in_truth() {
  MaterialRow made = row<Material>();
  made.is_in_truth = true;
  return made;
}

template <class Material>
MaterialRow with_rotation() {
  MaterialRow made = row<Material>();
  made.has_rotation = true;
  return made;
}

MaterialRow corotated() {
  MaterialRow made = with_rotation<Corotated>();
  made.is_in_truth = true;
  return made;
}

MaterialRow linear() {
  MaterialRow made = row<LinearElasticity>();
  made.is_isotropic = made.is_objective = made.is_ever_indefinite = false;
  return made;
}

MaterialRow fibre() {
  MaterialRow made = row<Fibre>();
  made.is_isotropic = false;
  return made;
}

}  // namespace

const std::vector<MaterialRow>& all_materials() {
  static const std::vector<MaterialRow> rows = {in_truth<NeoHookean>(),
                                                row<NeoHookeanLog>(),
                                                in_truth<StableNeoHookean>(),
                                                in_truth<StableNeoHookeanLog>(),
                                                row<MooneyRivlin>(),
                                                in_truth<StVenantKirchhoff>(),
                                                corotated(),
                                                with_rotation<FixedCorotated>(),
                                                with_rotation<Arap>(),
                                                linear(),
                                                row<StressStrain>(),
                                                fibre()};
  return rows;
}

}  // namespace lagomorph::sim
