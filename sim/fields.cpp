#include "sim/fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "sim/element.h"
#include "sim/error.h"
#include "sim/stress_source.h"

namespace lagomorph::sim {
namespace {

/// What fields are made of, at the quadrature points of all tets.
struct Shape {
  const Model& model;
  const VecX& q;
  std::vector<Mat3> F;
  std::vector<double> volumes;  // at rest [m^3]
  PointStates states;

  std::size_t begin(std::size_t tet) const { return states.first[tet]; }
  std::size_t end(std::size_t tet) const { return states.first[tet + 1]; }
};

template <int N, int P>
void add_points(const ElementRule<N, P>& rule, const VecX& q, Shape& shape) {
  for (const Mat3& F : deformation_gradients(rule, q)) shape.F.push_back(F);
  for (const double volume : rule.volumes) shape.volumes.push_back(volume);
  shape.states.first.push_back(shape.F.size());
}

void for_stress_sources(const Model& model, const auto& visit) {
  for (const auto& term : model.energies()) {
    if (const auto* source = dynamic_cast<const StressSource*>(term.get())) visit(*source);
  }
}

Shape shape_of(const Model& model, const VecX& q) {
  const TetMesh& mesh = model.mesh();
  Shape shape{model, q, {}, {}, {{0}, {}, {}}};
  for (std::size_t j = 0; j < mesh.tets.size(); ++j)
    mesh.is_quadratic(j) ? add_points(Tet10::rule(mesh, j), q, shape)
                         : add_points(Tet4::rule(mesh, j), q, shape);
  shape.states.P.assign(shape.F.size(), Mat3::Zero());
  shape.states.psi.assign(shape.F.size(), 0.0);
  for_stress_sources(model, [&](const StressSource& source) { source.add_states(q, shape.states); });
  return shape;
}

double volume_of(const Shape& s, std::size_t tet) {
  double volume = 0.0;
  for (std::size_t p = s.begin(tet); p < s.end(tet); ++p) volume += s.volumes[p];
  return volume;
}

/// The mean over a tet of what its points have.
template <typename T>
T mean_in(const Shape& s, std::size_t tet, const std::vector<T>& points) {
  const double volume = volume_of(s, tet);
  T mean = s.volumes[s.begin(tet)] / volume * points[s.begin(tet)];
  for (std::size_t p = s.begin(tet) + 1; p < s.end(tet); ++p) mean += s.volumes[p] / volume * points[p];
  return mean;
}

/// Weights of a tet's points at one of its nodes; of a linear one the first is 1.
using Weights = Eigen::Vector4d;

/// The linear function through what a tet's points have, at a node.
template <typename T>
T extrapolated(const Shape& s, std::size_t tet, const Weights& w, const std::vector<T>& points) {
  T value = w[0] * points[s.begin(tet)];
  for (std::size_t p = 1; p < s.end(tet) - s.begin(tet); ++p)
    value += w[static_cast<Eigen::Index>(p)] * points[s.begin(tet) + p];
  return value;
}

/// Calls with each node of a tet and its weights.
void for_nodes(const TetMesh& mesh, std::size_t tet, const auto& visit) {
  if (!mesh.is_quadratic(tet)) {
    for (const int v : mesh.tets[tet]) visit(v, Weights::Unit(0));
    return;
  }
  const std::array<int, 10> nodes = Tet10::nodes_of(mesh, tet);
  for (int a = 0; a < 10; ++a)
    visit(nodes[static_cast<std::size_t>(a)], Tet10::weights_of_points(Tet10::node(a)));
}

/// At each vertex the mean, by volume, of what the tets around have there: at_node(tet, weights).
template <typename AtNode>
auto vertex_means(const Shape& s, const AtNode& at_node) {
  using T = std::decay_t<decltype(at_node(std::size_t{}, Weights{}))>;
  const TetMesh& mesh = s.model.mesh();
  const auto count = static_cast<std::size_t>(mesh.vertex_count());
  T zero{};
  if constexpr (std::is_same_v<T, Mat3>) zero.setZero();
  std::vector<T> sums(count, zero);
  std::vector<double> volumes(count);
  for (std::size_t j = 0; j < mesh.tets.size(); ++j) {
    const double volume = volume_of(s, j);
    for_nodes(mesh, j, [&](int v, const Weights& w) {
      sums[static_cast<std::size_t>(v)] += volume * at_node(j, w);
      volumes[static_cast<std::size_t>(v)] += volume;
    });
  }
  for (std::size_t v = 0; v < count; ++v) {
    if (volumes[v] > 0) sums[v] /= volumes[v];
  }
  return sums;
}

using Values = std::vector<double>;

/// A value for each tet.
template <typename Value>
Values by_tet(const Shape& shape, const Value& value) {
  Values values(shape.model.mesh().tets.size());
  for (std::size_t j = 0; j < values.size(); ++j) values[j] = value(j);
  return values;
}

std::vector<Mat3> point_stresses(const Shape& s) {
  std::vector<Mat3> stresses;
  stresses.reserve(s.F.size());
  for (std::size_t p = 0; p < s.F.size(); ++p) stresses.push_back(cauchy_stress(s.states.P[p], s.F[p]));
  return stresses;
}

Values stresses(const Shape& s) {
  const std::vector<Mat3> points = point_stresses(s);
  return by_tet(s, [&](std::size_t j) { return von_mises(mean_in(s, j, points)); });
}
/// Stresses, not their von Mises stresses, are linear in a quadratic tet, and their errors cancel in a mean.
Values vertex_stresses(const Shape& s) {
  const std::vector<Mat3> points = point_stresses(s);
  Values values;
  for (const Mat3& stress :
       vertex_means(s, [&](std::size_t j, const Weights&w) { return extrapolated(s, j, w, points); }))
    values.push_back(von_mises(stress));
  return values;
}

Values determinants(const Shape& s) {
  return by_tet(s, [&](std::size_t j) { return mean_in(s, j, s.F).determinant(); });
}
Values vertex_determinants(const Shape& s) {
  return vertex_means(
      s, [&](std::size_t j, const Weights& w) { return extrapolated(s, j, w, s.F).determinant(); });
}

Values energies(const Shape& s) {
  return by_tet(s, [&](std::size_t j) { return mean_in(s, j, s.states.psi); });
}
/// From each point on to the node, ψ grows by the mean P of both times the change of F: exact where ψ is
/// quadratic, and finite where ψ at the node's own F need not be.
Values vertex_energies(const Shape& s) {
  return vertex_means(s, [&](std::size_t j, const Weights& w) {
    const Mat3 P = extrapolated(s, j, w, s.states.P), F = extrapolated(s, j, w, s.F);
    double sum = 0.0, least = 0.0;
    for (std::size_t p = s.begin(j); p < s.end(j); ++p) {
      sum += s.states.psi[p] + 0.5 * (s.states.P[p] + P).cwiseProduct(F - s.F[p]).sum();
      least = std::min(least, s.states.psi[p]);
    }
    return std::max(least, sum / static_cast<double>(s.end(j) - s.begin(j)));
  });
}

/// Of the isotropic mean of each tet's material at rest, a value of its moduli of bulk and shear.
template <typename Value>
Values by_moduli(const Shape& s, const Value& value) {
  const std::size_t tets = s.model.mesh().tets.size();
  ElementModuli moduli{Values(tets), Values(tets)};
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
  Values values(s.model.mesh().tets.size());
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
    {{"von_mises", "Pa", "von Mises stress of the Cauchy stress", "von Mises stress"},
     stresses,
     vertex_stresses},
    {{"J", "", "volume ratio det F", "volume ratio J"}, determinants, vertex_determinants},
    {{"energy_density", "J/m^3", "elastic energy per volume at rest", "elastic energy density"},
     energies,
     vertex_energies},
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
    Values vertices = row.vertices != nullptr
                          ? row.vertices(shape)
                          : vertex_means(shape, [&](std::size_t j, const Weights&) { return elements[j]; });
    fields.push_back({row.info, std::move(elements), std::move(vertices)});
  }
  return fields;
}

}  // namespace lagomorph::sim
