#include "sim/model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <Eigen/Geometry>

#include "sim/compensated_sum.h"
#include "sim/element.h"
#include "sim/error.h"
#include "sim/gravity.h"
#include "sim/kinematics.h"
#include "sim/mass.h"
#include "sim/materials/table.h"
#include "sim/placement.h"
#include "sim/springs.h"
#include "sim/start.h"
#include "sim/text.h"
#include "sim/tissue.h"

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
  require(body.spin.allFinite(), where + ": spin must be finite");
  require(body.mass == "consistent" || body.mass == "lumped",
          where + ": unknown mass '" + body.mass + "'; valid ones are consistent, lumped");
}

void check_volumes(const TetMesh& mesh, const std::string& where) {
  const VecX X = as_q(mesh.X);
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
  if (!body.midsides.empty() || !all.midsides.empty()) {
    all.midsides.resize(static_cast<std::size_t>(tets.begin), kNoMidsides);
    for (std::size_t j = 0; j < body.tets.size(); ++j) {
      all.midsides.push_back(body.is_quadratic(j) ? body.midsides[j] : kNoMidsides);
      if (!body.is_quadratic(j)) continue;
      for (int& v : all.midsides.back()) v += vertices.begin;
    }
  }
  all.tags.insert(all.tags.end(), body.tags.begin(), body.tags.end());
  all.bodies.push_back({name, vertices, tets});
}

std::size_t axis_of(const std::string& name, const std::string& where) {
  require(name == "x" || name == "y" || name == "z",
          where + ": unknown axis '" + name + "'; valid ones are x, y, z");
  return static_cast<std::size_t>(name[0] - 'x');
}

Axes axes_of(const PinSettings& pin, const std::string& where) {
  Axes axes = {false, false, false};
  for (const std::string& name : pin.axes) axes[axis_of(name, where)] = true;
  require(!pin.axes.empty(), where + ": axes is empty; give some of x, y, z");
  return axes;
}

/// What the pins of a placed body hold, and their names.
void append_holds(const BodyInput& body, const std::string& where, int first_vertex, std::vector<Hold>& holds,
                  std::vector<std::string>& names) {
  for (std::size_t i = 0; i < body.settings.pin.size(); ++i) {
    const PinSettings& pin = body.settings.pin[i];
    const std::string name = where + ": pin " + std::to_string(i);
    Hold hold;
    hold.vertices = select_vertices(body.mesh.X, pin, name);
    hold.axes = axes_of(pin, name);
    const Recording path = i < body.recordings.size() ? body.recordings[i] : Recording{};
    if (!pin.key.empty() || path.samples > 0) {
      Points X(static_cast<Eigen::Index>(hold.vertices.size()), 3);
      for (std::size_t v = 0; v < hold.vertices.size(); ++v)
        X.row(static_cast<Eigen::Index>(v)) = body.mesh.X.row(hold.vertices[v]);
      hold.motion = std::make_shared<const PinMotion>(pin, path, X, name);
    }
    if (pin.release) {
      require(*pin.release > 0.0, name + ": release = " + short_number(*pin.release) + " must be > 0 s");
      hold.release = *pin.release;
    }
    for (int& v : hold.vertices) v += first_vertex;
    holds.push_back(std::move(hold));
    names.push_back(name);
  }
}

/// velocity + spin × (X - centre of mass) + those of the file, of the body's vertices.
Points start_velocities(const BodySettings& settings, const Points& X, const Points& of_file,
                        const Eigen::VectorXd& mass, const std::string& where) {
  require(of_file.size() == 0 || (of_file.rows() == X.rows() && of_file.allFinite()),
          where + ": velocities must be finite and one for each of the " + std::to_string(X.rows()) +
              " vertices");
  const Vec3 center = X.transpose() * mass / mass.sum();
  Points v = settings.velocity.transpose().replicate(X.rows(), 1);
  if (!settings.spin.isZero(0.0))
    for (Eigen::Index i = 0; i < X.rows(); ++i)
      v.row(i) += settings.spin.cross(Vec3(X.row(i).transpose() - center)).transpose();
  if (of_file.size() != 0) v += of_file;
  return v;
}

}  // namespace

Model::Model(std::vector<BodyInput> bodies, const Vec3& gravity) {
  require(!bodies.empty(), "there is no body; give at least one");
  require(gravity.allFinite(), "gravity must be finite");
  std::vector<ElasticBody> elastic;
  std::vector<Hold> holds;
  std::vector<std::string> names_of_holds;
  std::vector<Springs::Spring> springs;
  std::vector<DampingSettings> damping;
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
    append_holds(bodies[b], where, mesh_.vertex_count(), holds, names_of_holds);
    append_springs(settings, body.X, mesh_.vertex_count(), where, springs);
    append(body, name, mesh_);
    Tissue tissue = make_tissue(body, settings, where);
    masses_.push_back({settings.density, settings.mass == "lumped", std::move(tissue.densities)});
    for (ElasticBody& part : tissue.parts) {
      part.tets.begin += mesh_.bodies.back().tets.begin;
      part.tets.end += mesh_.bodies.back().tets.begin;
      elastic.push_back(std::move(part));
    }
    damping.push_back(settings.damping);
  }
  hold(holds, names_of_holds);
  pattern_ = std::make_shared<const BlockPattern>(mesh_.vertex_count(), mesh_.tets, mesh_.midsides);
  mass_blocks_ = assemble_mass(mesh_, masses_, *pattern_);
  vertex_mass_ = vertex_mass_matrix(mass_blocks_, *pattern_);
  f_g_ = mass_times(gravity.replicate(mesh_.vertex_count(), 1));
  energies_ = make_elasticity(mesh_, elastic, pattern_);
  if (!springs.empty()) energies_.push_back(std::make_unique<Springs>(std::move(springs)));
  energies_.push_back(std::make_unique<Gravity>(f_g_));
  gravity_ = energies_.back().get();
  damping_ = Damping(mesh_, damping, mass_blocks_, pattern_);
  q0_ = as_q(mesh_.X);
  qdot0_.resize(3 * mesh_.vertex_count());
  const Eigen::VectorXd mass = vertex_mass_ * Eigen::VectorXd::Ones(mesh_.vertex_count());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Body& body = mesh_.bodies[b];
    const int first = body.vertices.begin, count = body.vertices.size();
    const std::string where = "body '" + body.name + "'";
    const Points X = mesh_.X.middleRows(first, count);
    const Points v =
        start_velocities(bodies[b].settings, X, bodies[b].velocities, mass.segment(first, count), where);
    qdot0_.segment(3 * first, 3 * count) = as_q(v);
    set_start(bodies[b].settings, body.vertices, mesh_.X, pins(), where, q0_);
    loads_.append(mesh_, body, bodies[b].settings, masses_[b], where);
  }
  pins().clear_pinned(qdot0_);
  held_.front().set_velocities(0.0, qdot0_);
  for (const auto& term : energies_)
    require(std::isfinite(term->value(q0_)), "a body starts with tets inside out, where the material " +
                                                 std::string(term->name()) + " is not defined");
}

/// One Held for each span of time between releases.
void Model::hold(const std::vector<Hold>& holds, const std::vector<std::string>& names) {
  check_holds(mesh_.vertex_count(), holds, names);
  std::set<double> releases;
  for (const Hold& hold : holds)
    if (std::isfinite(hold.release)) releases.insert(hold.release);
  held_.emplace_back(mesh_.vertex_count(), holds, 0.0);
  for (const double t : releases) held_.emplace_back(mesh_.vertex_count(), holds, t);
  releases_.assign(releases.begin(), releases.end());
}

const Held& Model::held(double t) const {
  const auto passed = std::upper_bound(releases_.begin(), releases_.end(), t) - releases_.begin();
  return held_[static_cast<std::size_t>(passed)];
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
  state.q = q0_;
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

Vec3 Model::angular_momentum(const State& state) const {
  const VecX Mv = mass_times(state.qdot);
  Vec3 L = Vec3::Zero();
  for (Eigen::Index i = 0; i < Mv.size(); i += 3)
    L += Vec3(state.q.segment<3>(i)).cross(Vec3(Mv.segment<3>(i)));
  return L;
}

double Model::min_J(const VecX& q) const {
  double least = std::numeric_limits<double>::infinity();
  const VecX X = as_q(mesh_.X);
  for (std::size_t j = 0; j < mesh_.tets.size(); ++j) {
    const Tet& tet = mesh_.tets[j];
    if (!mesh_.is_quadratic(j)) {
      least = std::min(least, tet_volume(gather_corners(q, tet)) / tet_volume(gather_corners(X, tet)));
      continue;
    }
    for (const Mat3& F : deformation_gradients(Tet10::rule(mesh_, j), q))
      least = std::min(least, F.determinant());
  }
  return least;
}

double Model::total_mass() const {
  CompensatedSum mass;
  for (int column = 0; column < vertex_mass_.outerSize(); ++column)
    for (SparseMatrix::InnerIterator m(vertex_mass_, column); m; ++m) mass.add(m.value());
  return mass.value();
}

}  // namespace lagomorph::sim
