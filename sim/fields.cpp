#include "sim/fields.h"

#include <array>
#include <cmath>

#include "sim/element.h"
#include "sim/error.h"
#include "sim/stress_source.h"

namespace lagomorph::sim {
namespace {

/// What fields are made of.
struct Shape {
  const Model& model;
  const VecX& q;
  std::vector<Mat3> F;          // of each tet; of a quadratic one the mean
  std::vector<double> volumes;  // at rest [m^3]
  ElementStates states;
};

template <int N, int P>
void add_mean(const ElementRule<N, P>& rule, const VecX& q, Shape& shape) {
  double volume = 0.0;
  for (const double part : rule.volumes) volume += part;
  const std::array<Mat3, P> F = deformation_gradients(rule, q);
  Mat3 mean = Mat3::Zero();
  for (std::size_t p = 0; p < P; ++p) mean += rule.volumes[p] / volume * F[p];
  shape.F.push_back(mean);
  shape.volumes.push_back(volume);
}

void for_stress_sources(const Model& model, const auto& visit) {
  for (const auto& term : model.energies()) {
    if (const auto* source = dynamic_cast<const StressSource*>(term.get())) visit(*source);
  }
}

Shape shape_of(const Model& model, const VecX& q) {
  const TetMesh& mesh = model.mesh();
  Shape shape{model, q, {}, {}, {}};
  for (std::size_t j = 0; j < mesh.tets.size(); ++j)
    mesh.is_quadratic(j) ? add_mean(Tet10::rule(mesh, j), q, shape) : add_mean(Tet4::rule(mesh, j), q, shape);
  shape.states.P.assign(mesh.tets.size(), Mat3::Zero());
  shape.states.psi.assign(mesh.tets.size(), 0.0);
  for_stress_sources(model, [&](const StressSource& source) { source.add_states(q, shape.states); });
  return shape;
}

using Values = std::vector<double>;

/// A value for each tet.
template <typename Value>
Values by_tet(const Shape& shape, const Value& value) {
  Values values(shape.F.size());
  for (std::size_t j = 0; j < values.size(); ++j) values[j] = value(j);
  return values;
}

Values stresses(const Shape& s) {
  return by_tet(s, [&](std::size_t j) { return von_mises(cauchy_stress(s.states.P[j], s.F[j])); });
}
Values determinants(const Shape& s) {
  return by_tet(s, [&](std::size_t j) { return s.F[j].determinant(); });
}
Values energies(const Shape& s) { return s.states.psi; }

/// Of the isotropic mean of each tet's material at rest, a value of its moduli of bulk and shear.
template <typename Value>
Values by_moduli(const Shape& s, const Value& value) {
  ElementModuli moduli{Values(s.F.size()), Values(s.F.size())};
  for_stress_sources(s.model, [&](const StressSource& source) { source.add_moduli(moduli); });
  return by_tet(s, [&](std::size_t j) {
    const double K = moduli.C_iijj[j] / 9.0;
    return value(K, (moduli.C_ijij[j] - moduli.C_iijj[j] / 3.0) / 10.0);
  });
}
Values youngs(const Shape& s) {
  return by_moduli(s, [](double K, double mu) { return 9.0 * K * mu / (3.0 * K + mu); });
}
Values poissons(const Shape& s) {
  return by_moduli(s, [](double K, double mu) { return (3.0 * K - 2.0 * mu) / (2.0 * (3.0 * K + mu)); });
}
/// Of the centroid.
Values displacements(const Shape& s) {
  const TetMesh& mesh = s.model.mesh();
  return by_tet(s, [&](std::size_t j) {
    Vec3 sum = Vec3::Zero();
    for (const int v : mesh.tets[j]) sum += s.q.segment<3>(3 * v) - mesh.X.row(v).transpose();
    return 0.25 * sum.norm();
  });
}
/// A value for each tet, by its body and its number in it.
template <typename Value>
Values by_body(const Shape& s, const Value& value) {
  Values values(s.F.size());
  const std::vector<Body>& all = s.model.mesh().bodies;
  for (std::size_t b = 0; b < all.size(); ++b) {
    for (int j = all[b].tets.begin; j < all[b].tets.end; ++j)
      values[static_cast<std::size_t>(j)] = value(b, j - all[b].tets.begin);
  }
  return values;
}

Values densities(const Shape& s) {
  return by_body(s, [&](std::size_t b, int j) { return density_of(s.model.masses()[b], j); });
}
Values bodies(const Shape& s) {
  return by_body(s, [](std::size_t b, int) { return static_cast<double>(b); });
}

Values vertex_means(const Shape& s, const Values& elements) {
  const TetMesh& mesh = s.model.mesh();
  Values sums(static_cast<std::size_t>(mesh.vertex_count())), volumes(sums.size());
  for (std::size_t j = 0; j < mesh.tets.size(); ++j) {
    const auto add = [&](int v) {
      sums[static_cast<std::size_t>(v)] += s.volumes[j] * elements[j];
      volumes[static_cast<std::size_t>(v)] += s.volumes[j];
    };
    for (const int v : mesh.tets[j]) add(v);
    if (!mesh.is_quadratic(j)) continue;
    for (const int v : mesh.midsides[j]) add(v);
  }
  for (std::size_t v = 0; v < sums.size(); ++v) {
    if (volumes[v] > 0) sums[v] /= volumes[v];
  }
  return sums;
}

/// Displacements are known at the vertices themselves.
Values vertex_displacements(const Shape& s) {
  const Points& X = s.model.mesh().X;
  Values values;
  for (int v = 0; v < s.model.mesh().vertex_count(); ++v)
    values.push_back((s.q.segment<3>(3 * v) - X.row(v).transpose()).norm());
  return values;
}

struct FieldRow {
  FieldInfo info;
  Values (*elements)(const Shape&);
  Values (*vertices)(const Shape&);  // nullptr: means of the elements
};
/// The explicit table: a new field is one row.
constexpr std::array<FieldRow, 8> table = {{
    {{"von_mises", "Pa", "von Mises stress of the Cauchy stress", "von Mises stress"}, stresses, nullptr},
    {{"J", "", "volume ratio det F", "volume ratio J"}, determinants, nullptr},
    {{"energy_density", "J/m^3", "elastic energy per volume at rest", "elastic energy density"},
     energies,
     nullptr},
    {{"displacement", "m", "distance from the place at rest", "displacement"},
     displacements,
     vertex_displacements},
    {{"young", "Pa", "Young's modulus at rest, of fibres and all the mean over directions",
      "Young's modulus"},
     youngs,
     nullptr},
    {{"poisson", "", "Poisson's ratio at rest, likewise", "Poisson's ratio"}, poissons, nullptr},
    {{"density", "kg/m^3", "mass density at rest", "density"}, densities, nullptr},
    {{"body", "", "number of the body, from 0", "body"}, bodies, nullptr},
}};

const FieldRow& find_row(std::string_view name) {
  std::string names;
  for (const FieldRow& row : table) {
    if (name == row.info.name) return row;
    names += (names.empty() ? "" : ", ") + std::string(row.info.name);
  }
  throw InputError("unknown field '" + std::string(name) + "'; valid ones are " + names);
}

}  // namespace

Mat3 cauchy_stress(const Mat3& P, const Mat3& F) { return P * F.transpose() / F.determinant(); }

double von_mises(const Mat3& stress) {
  const Mat3 deviator = stress - stress.trace() / 3 * Mat3::Identity();
  return std::sqrt(1.5) * deviator.norm();
}

std::vector<FieldInfo> field_table() {
  std::vector<FieldInfo> all;
  all.reserve(table.size());
  for (const FieldRow& row : table) all.push_back(row.info);
  return all;
}

const FieldInfo& find_field(std::string_view name) { return find_row(name).info; }

std::vector<Field> fields_of(const Model& model, const VecX& q, const std::vector<std::string>& names) {
  for (const std::string& name : names) find_row(name);
  const Shape shape = shape_of(model, q);
  std::vector<Field> fields;
  for (const std::string& name : names) {
    const FieldRow& row = find_row(name);
    Values elements = row.elements(shape);
    Values vertices = row.vertices != nullptr ? row.vertices(shape) : vertex_means(shape, elements);
    fields.push_back({row.info, std::move(elements), std::move(vertices)});
  }
  return fields;
}

}  // namespace lagomorph::sim
