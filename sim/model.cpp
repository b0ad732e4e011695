#include "sim/model.h"

#include <cmath>
#include <set>

#include "sim/compensated_sum.h"
#include "sim/error.h"
#include "sim/gravity.h"
#include "sim/kinematics.h"
#include "sim/mass.h"
#include "sim/materials/table.h"
#include "sim/placement.h"
#include "sim/text.h"

namespace lagomorph::sim {

namespace {

void require(bool ok, const std::string& message) {
  if (!ok) throw InputError(message);
}

bool is_positive(double value) { return value > 0.0 && std::isfinite(value); }

void check_settings(const BodySettings& body, const std::string& where) {
  require(is_positive(body.density),
          where + ": density = " + short_number(body.density) + " must be > 0 kg/m^3");
  require(is_positive(body.scale), where + ": scale = " + short_number(body.scale) + " must be > 0");
  require(body.rotate.allFinite(), where + ": rotate must be finite");
  require(body.translate.allFinite(), where + ": translate must be finite");
  require(body.velocity.allFinite(), where + ": velocity must be finite");
  require(body.mass == "consistent" || body.mass == "lumped",
          where + ": unknown mass '" + body.mass + "'; valid ones are consistent, lumped");
}

void check_volumes(const TetMesh& mesh, const std::string& where) {
  const VecX X = Eigen::Map<const VecX>(mesh.X.data(), mesh.X.size());
  for (std::size_t j = 0; j < mesh.tets.size(); ++j) {
    const double volume = tet_volume(gather_corners(X, mesh.tets[j]));
    require(std::isnormal(volume) && volume > 0.0, where + ": tet " + std::to_string(j) + " has volume " +
                                                       short_number(volume) + " m^3; it must be > 0");
  }
}

/// Adds a placed body to the mesh of all.
void append(const TetMesh& body, const std::string& name, TetMesh& all) {
  const Range vertices{all.vertex_count(), all.vertex_count() + body.vertex_count()};
  const Range tets{all.tet_count(), all.tet_count() + body.tet_count()};
  all.X.conservativeResize(vertices.end, 3);
  all.X.bottomRows(vertices.size()) = body.X;
  for (Tet tet : body.tets) {
    for (int& v : tet) v += vertices.begin;
    all.tets.push_back(tet);
  }
  all.tags.insert(all.tags.end(), body.tags.begin(), body.tags.end());
  all.bodies.push_back({name, vertices, tets});
}

/// Indices of the body's pinned vertices in the mesh of all.
void append_pins(const TetMesh& body, const BodySettings& settings, const std::string& where,
                 int first_vertex, std::vector<int>& pinned) {
  for (std::size_t i = 0; i < settings.pin.size(); ++i)
    for (const int v : select_vertices(body.X, settings.pin[i], where + ": pin " + std::to_string(i)))
      pinned.push_back(first_vertex + v);
}

}  // namespace

Model::Model(std::vector<BodyInput> bodies, const Vec3& gravity) {
  require(!bodies.empty(), "there is no body; give at least one");
  require(gravity.allFinite(), "gravity must be finite");
  std::vector<BodyMass> masses;
  std::vector<ElasticBody> elastic;
  std::vector<int> pinned;
  std::set<std::string> names;
  mesh_.X.resize(0, 3);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    TetMesh& body = bodies[b].mesh;
    const BodySettings& settings = bodies[b].settings;
    const std::string name = settings.name.empty() ? "body" + std::to_string(b) : settings.name;
    const std::string where = "body '" + name + "'";
    require(names.insert(name).second, where + ": another body has that name; give each its own");
    require(body.vertex_count() > 0 && body.tet_count() > 0, where + ": its mesh has no tets");
    check_settings(settings, where);
    place(body.X, settings);
    check_volumes(body, where);
    append_pins(body, settings, where, mesh_.vertex_count(), pinned);
    append(body, name, mesh_);
    masses.push_back({settings.density, settings.mass == "lumped"});
    elastic.push_back({mesh_.bodies.back().tets, settings.material, where + ": material"});
  }
  pins_ = Pins(mesh_.vertex_count(), pinned);
  pattern_ = std::make_shared<const BlockPattern>(mesh_.vertex_count(), mesh_.tets);
  mass_blocks_ = assemble_mass(mesh_, masses, *pattern_);
  vertex_mass_ = vertex_mass_matrix(mass_blocks_, *pattern_);
  f_g_ = mass_times(gravity.replicate(mesh_.vertex_count(), 1));
  energies_ = make_elasticity(mesh_, elastic, pattern_);
  energies_.push_back(std::make_unique<Gravity>(f_g_));
  gravity_ = energies_.back().get();
  qdot0_.resize(3 * mesh_.vertex_count());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Range& v = mesh_.bodies[b].vertices;
    qdot0_.segment(3 * v.begin, 3 * v.size()) = bodies[b].settings.velocity.replicate(v.size(), 1);
  }
  pins_.clear_pinned(qdot0_);
}

SparseMatrix Model::mass() const {
  SparseMatrix M(3 * mesh_.vertex_count(), 3 * mesh_.vertex_count());
  M.reserve(3 * vertex_mass_.nonZeros());
  for (int column = 0; column < M.cols(); ++column) {
    M.startVec(column);
    for (SparseMatrix::InnerIterator m(vertex_mass_, column / 3); m; ++m)
      M.insertBack(3 * m.row() + column % 3, column) = m.value();
  }
  M.finalize();
  return M;
}

VecX Model::mass_times(const VecX& v) const {
  VecX Mv(v.size());
  Eigen::Map<Points>(Mv.data(), v.size() / 3, 3) = vertex_mass_ * as_points(v);
  return Mv;
}

void Model::add_mass(double scale, BlockHessian& H) const {
  for (int k = 0; k < pattern_->block_count(); ++k) H.block(k).diagonal().array() += scale * mass_blocks_[k];
}

State Model::initial_state() const {
  State state;
  state.q = Eigen::Map<const VecX>(mesh_.X.data(), mesh_.X.size());
  state.qdot = qdot0_;
  return state;
}

Energies Model::energies_of(const State& state) const {
  Energies energies;
  CompensatedSum twice_kinetic;
  const VecX Mv = mass_times(state.qdot);
  for (Eigen::Index i = 0; i < Mv.size(); ++i) twice_kinetic.add(Mv[i] * state.qdot[i]);
  energies.kinetic = 0.5 * twice_kinetic.value();
  for (const auto& term : energies_)
    (term.get() == gravity_ ? energies.gravitational : energies.elastic) += term->value(state.q);
  return energies;
}

Vec3 Model::momentum(const State& state) const {
  const VecX Mv = mass_times(state.qdot);
  return as_points(Mv).colwise().sum().transpose();
}

double Model::total_mass() const {
  CompensatedSum mass;
  for (int column = 0; column < vertex_mass_.outerSize(); ++column)
    for (SparseMatrix::InnerIterator m(vertex_mass_, column); m; ++m) mass.add(m.value());
  return mass.value();
}

}  // namespace lagomorph::sim
