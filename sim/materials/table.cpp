#include "sim/materials/table.h"

#include <optional>

#include "sim/elasticity.h"
#include "sim/error.h"
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

struct ModelRow {
  std::string name;
  void (*check)(const MaterialSettings&, const std::string& where);
  std::unique_ptr<const MaterialPoint> (*make_point)(const MaterialSettings&, const std::string& where);
  void (*append)(const TetMesh&, const std::vector<ElasticBody>&, const std::shared_ptr<const BlockPattern>&,
                 std::vector<std::unique_ptr<Energy>>& terms);
};

template <EnergyDensity Material>
void check(const MaterialSettings& settings, const std::string& where) {
  Material::from_settings(settings, where);
}

template <EnergyDensity Material>
class PointOf : public MaterialPoint {
public:
  PointOf(const MaterialSettings& settings, const std::string& where)
      : material_(Material::from_settings(settings, where)) {
    if (settings.fibre) fibre_ = Fibre::from_settings(settings, where);
  }
  double psi(const Mat3& F) const override { return material_.psi(F) + (fibre_ ? fibre_->psi(F) : 0.0); }
  Mat3 dpsi_dF(const Mat3& F) const override {
    const Mat3 P = material_.dpsi_dF(F);
    return fibre_ ? Mat3(P + fibre_->dpsi_dF(F)) : P;
  }
  Mat9 d2psi_dF2(const Mat3& F) const override {
    const Mat9 H = material_.d2psi_dF2(F);
    return fibre_ ? Mat9(H + fibre_->d2psi_dF2(F)) : H;
  }

private:
  Material material_;
  std::optional<Fibre> fibre_;
};

template <EnergyDensity Material>
std::unique_ptr<const MaterialPoint> make_point(const MaterialSettings& settings, const std::string& where) {
  return std::make_unique<PointOf<Material>>(settings, where);
}

/// What is of one material model and one kind of element.
template <EnergyDensity Material>
struct Part {
  std::vector<int> elements;
  std::vector<Material> materials;
};

template <EnergyDensity Material>
void append(const TetMesh& mesh, const std::vector<ElasticBody>& bodies,
            const std::shared_ptr<const BlockPattern>& pattern, std::vector<std::unique_ptr<Energy>>& terms) {
  Part<Material> linear, quadratic;
  for (const ElasticBody& body : bodies) {
    const Material material = Material::from_settings(body.material, body.where);
    for (int j = body.tets.begin; j < body.tets.end; ++j) {
      Part<Material>& part = mesh.is_quadratic(static_cast<std::size_t>(j)) ? quadratic : linear;
      part.elements.push_back(j);
      part.materials.push_back(material);
    }
  }
  if (!linear.elements.empty()) {
    terms.push_back(
        std::make_unique<Elasticity<Material, Tet4>>(mesh, linear.elements, linear.materials, pattern));
  }
  if (!quadratic.elements.empty()) {
    terms.push_back(std::make_unique<Elasticity<Material, Tet10>>(mesh, quadratic.elements,
                                                                  quadratic.materials, pattern));
  }
}

template <EnergyDensity Material>
ModelRow row() {
  return {Material::kName, check<Material>, make_point<Material>, append<Material>};
}

/// The explicit table: a new material is one row.
const std::vector<ModelRow>& table() {
  static const std::vector<ModelRow> rows = {
      row<NeoHookean>(),   row<NeoHookeanLog>(),     row<StableNeoHookean>(), row<StableNeoHookeanLog>(),
      row<MooneyRivlin>(), row<StVenantKirchhoff>(), row<Corotated>(),        row<FixedCorotated>(),
      row<Arap>(),         row<LinearElasticity>(),  row<StressStrain>()};
  return rows;
}

const ModelRow& find(const std::string& model, const std::string& where) {
  std::string names;
  for (const ModelRow& r : table()) {
    if (r.name == model) return r;
    names += (names.empty() ? "" : ", ") + r.name;
  }
  throw InputError(where + ": unknown material model '" + model + "'; valid ones are " + names);
}

}  // namespace

std::vector<std::string> material_names() {
  std::vector<std::string> names;
  for (const ModelRow& r : table()) names.push_back(r.name);
  return names;
}

void check_material(const MaterialSettings& settings, const std::string& where) {
  const ModelRow& model = find(settings.model, where);
  if (!settings.data.empty() && settings.model != StressStrain::kName)
    throw InputError(where + ": data belong to " + StressStrain::kName + ", not to " + settings.model);
  if (settings.moduli != "lecture" && settings.model != "neo_hookean")
    throw InputError(where + ": moduli belong to neo_hookean, not to " + settings.model);
  model.check(settings, where);
  if (settings.fibre) Fibre::from_settings(settings, where);
}

std::unique_ptr<const MaterialPoint> make_material_point(const MaterialSettings& settings,
                                                         const std::string& where) {
  return find(settings.model, where).make_point(settings, where);
}

std::vector<std::unique_ptr<Energy>> make_elasticity(const TetMesh& mesh,
                                                     const std::vector<ElasticBody>& bodies,
                                                     const std::shared_ptr<const BlockPattern>& pattern) {
  for (const ElasticBody& body : bodies) check_material(body.material, body.where);
  std::vector<std::unique_ptr<Energy>> terms;
  for (const ModelRow& r : table()) {
    std::vector<ElasticBody> of_this_model;
    for (const ElasticBody& body : bodies)
      if (body.material.model == r.name) of_this_model.push_back(body);
    if (!of_this_model.empty()) r.append(mesh, of_this_model, pattern, terms);
  }
  std::vector<ElasticBody> fibrous;
  for (const ElasticBody& body : bodies)
    if (body.material.fibre) fibrous.push_back(body);
  if (!fibrous.empty()) append<Fibre>(mesh, fibrous, pattern, terms);
  return terms;
}

}  // namespace lagomorph::sim
