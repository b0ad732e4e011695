#include "sim/held.h"

#include <string>

#include "sim/error.h"

namespace lagomorph::sim {

namespace {

template <class Visit>
void each_dof(const Hold& hold, Visit&& visit) {
  for (const int v : hold.vertices)
    for (int k = 0; k < 3; ++k)
      if (hold.axes[static_cast<std::size_t>(k)]) visit(3 * v + k);
}

}  // namespace

Held::Held(int vertex_count, const std::vector<Hold>& holds, double t) : dofs_(holds.size()) {
  std::vector<char> is_held(3 * static_cast<std::size_t>(vertex_count), 0);
  for (std::size_t i = 0; i < holds.size(); ++i) {
    if (!(t < holds[i].release)) continue;
    each_dof(holds[i], [&](int dof) {
      if (is_held[static_cast<std::size_t>(dof)]) return;
      is_held[static_cast<std::size_t>(dof)] = 1;
      dofs_[i].push_back(dof);
    });
    if (holds[i].motion) driven_.push_back(holds[i]);
  }
  pins_ = Pins(is_held);
}

template <class Value>
void Held::write(const Value& value, VecX& full) const {
  for (const Hold& hold : driven_) {
    const Points points = value(*hold.motion);
    for (std::size_t i = 0; i < hold.vertices.size(); ++i)
      for (int k = 0; k < 3; ++k)
        if (hold.axes[static_cast<std::size_t>(k)])
          full[3 * hold.vertices[i] + k] = points(static_cast<Eigen::Index>(i), k);
  }
}

void Held::place(double t, VecX& q) const {
  write([t](const PinMotion& motion) { return motion.positions(t); }, q);
}

void Held::set_velocities(double t, VecX& qdot) const {
  write([t](const PinMotion& motion) { return motion.velocities(t); }, qdot);
}

std::vector<Vec3> Held::forces(const VecX& balance) const {
  std::vector<Vec3> forces(dofs_.size(), Vec3::Zero());
  for (std::size_t i = 0; i < dofs_.size(); ++i)
    for (const int dof : dofs_[i]) forces[i][dof % 3] += balance[dof];
  return forces;
}

void check_holds(int vertex_count, const std::vector<Hold>& holds, const std::vector<std::string>& names) {
  std::vector<int> holder(3 * static_cast<std::size_t>(vertex_count), -1);
  for (std::size_t i = 0; i < holds.size(); ++i) {
    each_dof(holds[i], [&](int dof) {
      const int other = holder[static_cast<std::size_t>(dof)];
      if (other >= 0 && (holds[i].motion || holds[static_cast<std::size_t>(other)].motion))
        throw InputError(names[i] + " and " + names[static_cast<std::size_t>(other)] + " both hold axis " +
                         "xyz"[dof % 3] + " of vertex " + std::to_string(dof / 3) +
                         " and one of them moves; select each vertex once");
      holder[static_cast<std::size_t>(dof)] = static_cast<int>(i);
    });
  }
}

}  // namespace lagomorph::sim
