#include "sim/loads.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "sim/error.h"
#include "sim/kinematics.h"
#include "sim/mesh_check.h"
#include "sim/mesh_topology.h"
#include "sim/pins.h"
#include "sim/text.h"

namespace lagomorph::sim {

double curve_at(const std::vector<std::array<double, 2>>& curve, double t) {
  if (curve.empty()) return 1.0;
  if (t <= curve.front()[0]) return curve.front()[1];
  if (t >= curve.back()[0]) return curve.back()[1];
  const auto next = std::upper_bound(curve.begin(), curve.end(), t,
                                     [](double time, const auto& point) { return time < point[0]; });
  const auto& [t0, a] = *(next - 1);
  const auto& [t1, b] = *next;
  return a + (b - a) * ((t - t0) / (t1 - t0));
}

namespace {

void check(const LoadSettings& load, const std::string& where) {
  const auto require = [&](bool ok, const std::string& message) {
    if (!ok) throw InputError(where + ": " + message);
  };
  require(load.force.allFinite() && load.traction.allFinite() && std::isfinite(load.pressure) &&
              load.body_force.allFinite() && load.acceleration.allFinite(),
          "force, traction, pressure, body_force and acceleration must be finite");
  for (std::size_t i = 0; i < load.curve.size(); ++i) {
    require(std::isfinite(load.curve[i][0]) && std::isfinite(load.curve[i][1]), "curve must be finite");
    require(i == 0 || load.curve[i - 1][0] < load.curve[i][0],
            "curve: time " + short_number(load.curve[i][0]) + " must be later than the one before it");
  }
}

/// Which vertices of a body a load is on.
std::vector<char> marked(const Points& X, const LoadSettings& load, const std::string& where) {
  std::vector<char> marks(static_cast<std::size_t>(X.rows()), load.is_empty() ? 1 : 0);
  if (load.is_empty()) return marks;
  for (const int v : select_vertices(X, load, where)) marks[static_cast<std::size_t>(v)] = 1;
  return marks;
}

/// The vertices of a load and the forces on them, in the body's numbers.
class Assembly {
public:
  Assembly(const TetMesh& mesh, const Body& body, std::vector<char> marks)
      : f(VecX::Zero(3 * body.vertices.size())), mesh_(mesh), body_(body), marks_(std::move(marks)) {}

  void add_point_forces(const Vec3& total) {
    const auto count = std::count(marks_.begin(), marks_.end(), 1);
    for (int v = 0; v < body_.vertices.size(); ++v)
      if (marks_[static_cast<std::size_t>(v)]) f.segment<3>(3 * v) += total / static_cast<double>(count);
  }
  /// ∫ φ over a boundary triangle: a third of it for each corner; of a quadratic tet's, for each midside
  /// node.
  bool add_traction(const Vec3& traction, double pressure) {
    bool any = false;
    for (const BoundaryFace& face : boundary_faces(mesh_, body_.tets)) {
      if (!all_marked(face.corners)) continue;
      any = true;
      const Triangle& t = face.corners;
      const Vec3 a = corner(t[0]), b = corner(t[1]), c = corner(t[2]);
      const Vec3 area = 0.5 * (b - a).cross(c - a);  // along the outward normal
      for (const int v : face.midsides[0] < 0 ? t : face.midsides)
        at(v) += (area.norm() * traction - pressure * area) / 3.0;
    }
    return any;
  }
  /// Likewise over a tet: a quarter for each corner; of a quadratic one -1/20, and 1/5 for each midside node.
  /// f [N/m^3].
  template <class ForceDensity>
  bool add_body_force(const ForceDensity& force_density) {  // [N/m^3], by the body's tet
    bool any = false;
    const VecX X = as_q(mesh_.X);
    for (int j = body_.tets.begin; j < body_.tets.end; ++j) {
      const Tet& tet = mesh_.tets[static_cast<std::size_t>(j)];
      if (!all_marked(tet)) continue;
      any = true;
      const Vec3 whole = tet_volume(gather_corners(X, tet)) * force_density(j - body_.tets.begin);
      const bool is_quadratic = mesh_.is_quadratic(static_cast<std::size_t>(j));
      for (const int v : tet) at(v) += (is_quadratic ? -0.05 : 0.25) * whole;
      if (!is_quadratic) continue;
      for (const int v : mesh_.midsides[static_cast<std::size_t>(j)]) at(v) += 0.2 * whole;
    }
    return any;
  }

  VecX f;

private:
  Vec3 corner(int v) const { return mesh_.X.row(v).transpose(); }
  VecX::FixedSegmentReturnType<3>::Type at(int v) { return f.segment<3>(3 * (v - body_.vertices.begin)); }
  template <class Corners>
  bool all_marked(const Corners& corners) const {
    return std::all_of(corners.begin(), corners.end(), [&](int v) {
      return marks_[static_cast<std::size_t>(v - body_.vertices.begin)] != 0;
    });
  }

  const TetMesh& mesh_;
  const Body& body_;
  std::vector<char> marks_;
};

}  // namespace

void Loads::append(const TetMesh& mesh, const Body& body, const BodySettings& settings, const BodyMass& mass,
                   const std::string& where) {
  vertex_count_ = mesh.vertex_count();
  const Points X = mesh.X.middleRows(body.vertices.begin, body.vertices.size());
  for (std::size_t i = 0; i < settings.load.size(); ++i) {
    const LoadSettings& load = settings.load[i];
    const std::string place = where + ": load " + std::to_string(i);
    check(load, place);
    Assembly assembly(mesh, body, marked(X, load, place));
    assembly.add_point_forces(load.force);
    const bool on_surface = !load.traction.isZero(0.0) || load.pressure != 0.0;
    if (on_surface && !assembly.add_traction(load.traction, load.pressure))
      throw InputError(place + ": traction and pressure need a boundary triangle with all corners selected");
    const bool in_bulk = !load.body_force.isZero(0.0) || !load.acceleration.isZero(0.0);
    const auto force_density = [&](int tet) -> Vec3 {
      return load.body_force + density_of(mass, tet) * load.acceleration;
    };
    if (in_bulk && !assembly.add_body_force(force_density))
      throw InputError(place + ": body_force and acceleration need a tet with all corners selected");
    loads_.push_back({std::move(assembly.f), body.vertices.begin, load.curve});
  }
}

VecX Loads::force(double t) const {
  if (loads_.empty()) return {};
  VecX f = VecX::Zero(3 * vertex_count_);
  for (const Load& load : loads_)
    f.segment(3 * load.first_vertex, load.f.size()) += curve_at(load.curve, t) * load.f;
  return f;
}

}  // namespace lagomorph::sim
