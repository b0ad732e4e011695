#include "sim/pins.h"

#include <algorithm>
#include <cmath>

#include "sim/error.h"
#include "sim/text.h"

namespace lagomorph::sim {

namespace {

std::vector<char> held_in_all_axes(int vertex_count, const std::vector<int>& vertices) {
  std::vector<char> held(3 * static_cast<std::size_t>(vertex_count), 0);
  for (const int v : vertices)
    for (std::size_t k = 0; k < 3; ++k) held[3 * static_cast<std::size_t>(v) + k] = 1;
  return held;
}

}  // namespace

Pins::Pins(int vertex_count, const std::vector<int>& vertices)
    : Pins(held_in_all_axes(vertex_count, vertices)) {}

Pins::Pins(const std::vector<char>& is_held) : held_(is_held), free_index_(is_held.size() / 3, -1) {
  for (int v = 0; v < vertex_count(); ++v) {
    int held = 0;
    for (int dof = 3 * v; dof < 3 * v + 3; ++dof) {
      if (this->is_held(dof))
        ++held;
      else
        free_.push_back(dof);
    }
    if (held > 0) vertices_.push_back(v);
    if (held == 3) continue;
    free_index_[static_cast<std::size_t>(v)] = static_cast<int>(free_vertices_.size());
    free_vertices_.push_back(v);
  }
}

VecX Pins::project(const VecX& full) const {
  VecX free(free_dofs());
  for (std::size_t i = 0; i < free_.size(); ++i) free[static_cast<int>(i)] = full[free_[i]];
  return free;
}

VecX Pins::expand(const VecX& free) const {
  VecX full = VecX::Zero(3 * vertex_count());
  for (std::size_t i = 0; i < free_.size(); ++i) full[free_[i]] = free[static_cast<int>(i)];
  return full;
}

void Pins::clear_pinned(VecX& full) const {
  for (const int v : vertices_)
    for (int dof = 3 * v; dof < 3 * v + 3; ++dof)
      if (is_held(dof)) full[dof] = 0.0;
}

VecX Pins::pinned_part(const VecX& full) const {
  VecX part = VecX::Zero(full.size());
  for (const int v : vertices_)
    for (int dof = 3 * v; dof < 3 * v + 3; ++dof)
      if (is_held(dof)) part[dof] = full[dof];
  return part;
}

double Pins::free_norm(const VecX& full) const { return project(full).norm(); }

SparseMatrix Pins::matrix() const {
  SparseMatrix P(free_dofs(), 3 * vertex_count());
  for (std::size_t i = 0; i < free_.size(); ++i) P.insert(static_cast<int>(i), free_[i]) = 1.0;
  P.makeCompressed();
  return P;
}

namespace {

/// Marks of the vertices that a selector has taken, and the box around all.
struct Selection {
  const Points& X;
  const std::string& where;
  Vec3 min, max;
  double slack;  // a vertex on the selector's border counts, though placing the body has rounded it [m]
  std::vector<char> taken;

  Selection(const Points& X_in, const std::string& where_in)
      : X(X_in),
        where(where_in),
        min(X.colwise().minCoeff()),
        max(X.colwise().maxCoeff()),
        slack(1e-12 * std::max(X.cwiseAbs().maxCoeff(), (max - min).norm())),
        taken(static_cast<std::size_t>(X.rows()), 0) {}

  template <class Inside>
  void take(const std::string& selector, Inside&& inside) {
    bool any = false;
    for (int v = 0; v < X.rows(); ++v) {
      if (!inside(Vec3(X.row(v)))) continue;
      taken[static_cast<std::size_t>(v)] = 1;
      any = true;
    }
    if (!any)
      throw InputError(where + ": " + selector + " selects none of the " + std::to_string(X.rows()) +
                       " vertices; the placed body spans " + short_vector(min) + " to " + short_vector(max));
  }
};

void take_vertices(Selection& s, const std::vector<int>& vertices) {
  for (const int v : vertices) {
    if (v < 0 || v >= s.X.rows())
      throw InputError(s.where + ": vertex " + std::to_string(v) +
                       " is out of range; the body's vertices are 0 to " + std::to_string(s.X.rows() - 1));
    s.taken[static_cast<std::size_t>(v)] = 1;
  }
}

void take_box(Selection& s, const BoxSelector& box) {
  if (!((box.min.array() <= box.max.array()).all()))  // also catches NaN
    throw InputError(s.where + ": box from " + short_vector(box.min) + " to " + short_vector(box.max) +
                     " is empty; give the smaller corner first");
  s.take("box " + short_vector(box.min) + " to " + short_vector(box.max), [&](const Vec3& x) {
    return ((x - box.min).array() >= -s.slack).all() && ((box.max - x).array() >= -s.slack).all();
  });
}

void take_sphere(Selection& s, const SphereSelector& sphere) {
  if (!(sphere.radius >= 0.0 && std::isfinite(sphere.radius) && sphere.center.allFinite()))
    throw InputError(s.where + ": sphere with centre " + short_vector(sphere.center) + " and radius " +
                     short_number(sphere.radius) + " is none; the radius must be >= 0 and all be finite");
  s.take("sphere around " + short_vector(sphere.center) + " of radius " + short_number(sphere.radius),
         [&](const Vec3& x) { return (x - sphere.center).norm() <= sphere.radius + s.slack; });
}

void take_plane(Selection& s, const PlaneSelector& plane) {
  const double length = plane.normal.norm();
  if (!(length > 0.0 && std::isfinite(length) && plane.point.allFinite()))
    throw InputError(s.where + ": plane through " + short_vector(plane.point) + " with normal " +
                     short_vector(plane.normal) + " is none; the normal must not be zero and all be finite");
  s.take("plane through " + short_vector(plane.point) + " with normal " + short_vector(plane.normal),
         [&](const Vec3& x) { return (x - plane.point).dot(plane.normal) >= -s.slack * length; });
}

void check_fraction(const Selection& s, const char* name, double fraction) {
  if (!(fraction > 0.0 && fraction <= 1.0))
    throw InputError(s.where + ": " + name + " = " + short_number(fraction) + " must be in (0, 1]");
}

}  // namespace

std::vector<int> select_vertices(const Points& X, const Selector& by, const std::string& where) {
  if (by.is_empty())
    throw InputError(where + ": selects nothing; give vertices, box, sphere, plane, top or bottom");
  Selection s(X, where);
  take_vertices(s, by.vertices);
  if (by.box) take_box(s, *by.box);
  if (by.sphere) take_sphere(s, *by.sphere);
  if (by.plane) take_plane(s, *by.plane);
  if (by.top) {
    check_fraction(s, "top", *by.top);
    const double y = s.max.y() - *by.top * (s.max.y() - s.min.y()) - s.slack;
    s.take("top", [&](const Vec3& x) { return x.y() >= y; });
  }
  if (by.bottom) {
    check_fraction(s, "bottom", *by.bottom);
    const double y = s.min.y() + *by.bottom * (s.max.y() - s.min.y()) + s.slack;
    s.take("bottom", [&](const Vec3& x) { return x.y() <= y; });
  }
  std::vector<int> selected;
  for (int v = 0; v < X.rows(); ++v)
    if (s.taken[static_cast<std::size_t>(v)]) selected.push_back(v);
  return selected;
}

}  // namespace lagomorph::sim
