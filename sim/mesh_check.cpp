#include "sim/mesh_check.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "sim/error.h"
#include "sim/mesh_topology.h"
#include "sim/midsides.h"
#include "sim/shape_functions.h"
#include "sim/text.h"

namespace lagomorph::sim {
namespace {

/// A tet is flat when its volume is at most this part of its longest edge cubed (0.118 in the regular one):
/// far above the rounding of a volume, 1e-16, and far below any sliver that can be computed with.
constexpr double kFlat = 1e-10;
constexpr std::size_t kNamed = 5;  // how many offenders an error names

/// "17, 30, 31, 40, 41, ..."
template <typename Name>
std::string name_first(const std::vector<int>& offenders, Name name) {
  std::string names;
  for (std::size_t i = 0; i < std::min(kNamed, offenders.size()); ++i)
    names += (i == 0 ? "" : ", ") + name(offenders[i]);
  return names + (offenders.size() > kNamed ? ", ..." : "");
}

std::string name_vertices(const std::vector<int>& vertices) {
  return name_first(vertices, [](int v) { return std::to_string(v); });
}

void check_points(const Points& X, const std::string& origin) {
  if (X.rows() == 0) throw InputError(origin + ": no vertices");
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(X(i, axis))) {
        throw InputError(origin + ": vertex " + std::to_string(i) + " (numbered from 0) has the " +
                         "xyz"[axis] + " coordinate " + short_number(X(i, axis)) + "; it must be finite");
      }
    }
  }
}

void check_bodies(const TetMesh& mesh, const std::string& origin) {
  if (mesh.bodies.empty()) return;
  int vertex = 0, tet = 0;
  for (const Body& body : mesh.bodies) {
    const bool follows = body.vertices.begin == vertex && body.tets.begin == tet &&
                         body.vertices.size() >= 0 && body.tets.size() >= 0;
    vertex = body.vertices.end;
    tet = body.tets.end;
    if (!follows || vertex > mesh.vertex_count() || tet > mesh.tet_count()) {
      throw InputError(origin + ": the ranges of body '" + body.name +
                       "' do not follow those of the body before it");
    }
    for (int j = body.tets.begin; j < body.tets.end; ++j) {
      for (const int corner : mesh.tets[static_cast<std::size_t>(j)]) {
        if (corner < body.vertices.begin || corner >= body.vertices.end) {
          throw InputError(origin + ": tet " + std::to_string(j) + " of body '" + body.name +
                           "' has vertex " + std::to_string(corner) + " of another body");
        }
      }
    }
  }
  if (vertex != mesh.vertex_count() || tet != mesh.tet_count()) {
    throw InputError(origin + ": the bodies have " + std::to_string(vertex) + " vertices and " +
                     std::to_string(tet) + " tets, the mesh " + std::to_string(mesh.vertex_count()) +
                     " and " + std::to_string(mesh.tet_count()));
  }
}

void check_tet_indices(const TetMesh& mesh, const std::string& origin) {
  for (std::size_t j = 0; j < mesh.tets.size(); ++j) {
    const Tet& tet = mesh.tets[j];
    const std::string name = origin + ": tet " + std::to_string(j) + " (numbered from 0)";
    for (const int corner : tet) {
      if (corner < 0 || corner >= mesh.vertex_count()) {
        throw InputError(name + " has vertex " + std::to_string(corner) + "; it must be in 0.." +
                         std::to_string(mesh.vertex_count() - 1));
      }
    }
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        if (tet[a] == tet[b])
          throw InputError(name + " has vertex " + std::to_string(tet[a]) +
                           " twice; its four corners must differ");
      }
    }
  }
}

TetCorners corners_of(const TetMesh& mesh, std::size_t j) {
  TetCorners corners;
  for (std::size_t k = 0; k < 4; ++k) corners.col(static_cast<Eigen::Index>(k)) = mesh.X.row(mesh.tets[j][k]);
  return corners;
}

double longest_edge(const TetCorners& X) {
  double squared = 0.0;
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < a; ++b) squared = std::max(squared, (X.col(a) - X.col(b)).squaredNorm());
  }
  return std::sqrt(squared);
}

/// Inverted or flat tets; when all are inverted and none is flat, they are turned instead.
void check_orientation(TetMesh& mesh, const std::string& origin, Remarks& remarks) {
  std::vector<int> offenders;
  std::size_t inverted = 0;
  for (std::size_t j = 0; j < mesh.tets.size(); ++j) {
    const TetCorners corners = corners_of(mesh, j);
    const double volume = tet_volume(corners);
    const double least = kFlat * std::pow(longest_edge(corners), 3);
    if (!(volume > least)) offenders.push_back(static_cast<int>(j));
    if (volume < -least) ++inverted;
  }
  if (offenders.empty()) return;
  if (inverted == mesh.tets.size()) {
    for (std::size_t j = 0; j < mesh.tets.size(); ++j) turn_tet(mesh, j);
    remarks.push_back(origin + ": turned all " + counted(mesh.tet_count(), "tet") +
                      ", which were inverted throughout");
    return;
  }
  const std::string names = name_first(offenders, [&](int j) {
    return std::to_string(j) + " (" +
           short_number(tet_volume(corners_of(mesh, static_cast<std::size_t>(j)))) + " m^3)";
  });
  throw InputError(origin + ": " + std::to_string(offenders.size()) + " of " +
                   counted(mesh.tet_count(), "tet") + " inverted or flat (volume at most " +
                   short_number(kFlat) + " of the longest edge cubed), numbered from 0: " + names +
                   "; all must have det[X1-X0, X2-X0, X3-X0] > 0");
}

std::vector<int> stray_vertices(const TetMesh& mesh) {
  std::vector<char> used(static_cast<std::size_t>(mesh.vertex_count()), 0);
  for (const Tet& tet : mesh.tets) {
    for (const int corner : tet) used[static_cast<std::size_t>(corner)] = 1;
  }
  for (std::size_t j = 0; j < mesh.midsides.size(); ++j) {
    for (const int node : mesh.midsides[j])
      if (node >= 0) used[static_cast<std::size_t>(node)] = 1;
  }
  std::vector<int> strays;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) strays.push_back(static_cast<int>(v));
  }
  return strays;
}

void check_strays(const TetMesh& mesh, const std::string& origin, bool refuse, Remarks& remarks) {
  const std::vector<int> strays = stray_vertices(mesh);
  if (strays.empty()) return;
  const std::string message =
      origin + ": " +
      (strays.size() == 1 ? "1 stray vertex" : std::to_string(strays.size()) + " stray vertices") +
      " in no tet, numbered from 0: " + name_vertices(strays);
  if (refuse) throw InputError(message + "; drop them with: lagomorph info " + origin + " --mend OUT.msh");
  remarks.push_back(message);
}

void remark_coincident(const TetMesh& mesh, const std::string& origin, Remarks& remarks) {
  const std::vector<int> first = first_equal_points(mesh.X);
  int count = 0;
  std::string pair;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] == static_cast<int>(i)) continue;
    if (count++ == 0) pair = std::to_string(first[i]) + " and " + std::to_string(i);
  }
  if (count > 0) {
    remarks.push_back(
        origin + ": " + std::to_string(count) + (count == 1 ? " vertex coincides" : " vertices coincide") +
        " with another, the first pair " + pair + " (numbered from 0); bodies do not hold together there");
  }
}

std::string edge_name(const SurfaceTopology::Edges& edges) {
  return "the first from vertex " + std::to_string(edges.a) + " to " + std::to_string(edges.b) +
         " (numbered from 0)";
}

void remark_topology(const SurfaceTopology& topology, const std::string& surface, Remarks& remarks) {
  if (topology.open.count > 0) {
    remarks.push_back(surface + " is not closed: " + counted(topology.open.count, "edge") +
                      " with one triangle, " + edge_name(topology.open));
  }
  if (topology.crowded.count > 0) {
    remarks.push_back(surface + " is not manifold: " + counted(topology.crowded.count, "edge") +
                      " with more than two triangles, " + edge_name(topology.crowded));
  }
  if (topology.inconsistent.count > 0) {
    remarks.push_back(surface +
                      " is not consistently oriented: " + counted(topology.inconsistent.count, "edge") +
                      " whose two triangles go the same way, " + edge_name(topology.inconsistent));
  }
  if (topology.crowded_vertices > 0) {
    remarks.push_back(surface + " touches itself at " +
                      (topology.crowded_vertices == 1
                           ? "1 vertex"
                           : std::to_string(topology.crowded_vertices) + " vertices") +
                      ", the first " + std::to_string(topology.first_crowded_vertex) + " (numbered from 0)");
  }
}

void check_faces(const TetMesh& mesh, const std::string& origin, Remarks& remarks) {
  const FaceMatch match = match_faces(mesh, {0, mesh.tet_count()});
  const auto name = [&](int face) {
    const Triangle corners = tet_face(mesh.tets[static_cast<std::size_t>(face / 4)], face % 4);
    return "tet " + std::to_string(face / 4) + " overlaps another: the face of vertices " +
           std::to_string(corners[0]) + ", " + std::to_string(corners[1]) + ", " +
           std::to_string(corners[2]) + " (all numbered from 0) ";
  };
  if (match.first_crowded >= 0) {
    throw InputError(origin + ": " + name(match.first_crowded) +
                     "belongs to more than two tets; are some there twice?");
  }
  if (match.first_same_side >= 0) {
    throw InputError(origin + ": " + name(match.first_same_side) +
                     "has two tets on the same side; is one there twice?");
  }
  const std::vector<Triangle> boundary = boundary_triangles(mesh, match, {0, mesh.tet_count()});
  remark_topology(surface_topology(boundary, mesh.vertex_count()), origin + ": the surface", remarks);
}

int keep_vertices(Points& X, const std::vector<char>& keep, std::vector<int>& renumbered) {
  renumbered.assign(keep.size(), -1);
  Eigen::Index kept = 0;
  for (std::size_t v = 0; v < keep.size(); ++v) {
    if (!keep[v]) continue;
    X.row(kept) = X.row(static_cast<Eigen::Index>(v)).eval();
    renumbered[v] = static_cast<int>(kept++);
  }
  const auto dropped = static_cast<int>(X.rows() - kept);
  X.conservativeResize(kept, 3);
  return dropped;
}

/// Vertices of no triangle go; an embedded surface would otherwise refuse one that lies outside of the tets.
int drop_unused_vertices(TriMesh& mesh) {
  std::vector<char> used(static_cast<std::size_t>(mesh.X.rows()), 0);
  for (const Triangle& triangle : mesh.triangles) {
    for (const int corner : triangle) used[static_cast<std::size_t>(corner)] = 1;
  }
  std::vector<int> renumbered;
  const int dropped = keep_vertices(mesh.X, used, renumbered);
  for (Triangle& triangle : mesh.triangles) {
    for (int& corner : triangle) corner = renumbered[static_cast<std::size_t>(corner)];
  }
  return dropped;
}

}  // namespace

void validate_tet_mesh(const TetMesh& mesh, const std::string& origin) {
  check_points(mesh.X, origin);
  if (mesh.tets.empty()) throw InputError(origin + ": no tetrahedra");
  if (mesh.tags.size() != mesh.tets.size()) {
    throw InputError(origin + ": " + std::to_string(mesh.tags.size()) + " tags for " +
                     std::to_string(mesh.tets.size()) + " tets");
  }
  check_tet_indices(mesh, origin);
  check_bodies(mesh, origin);
}

void check_tet_mesh(TetMesh& mesh, const std::string& origin, Remarks& remarks, const MeshChecks& checks) {
  validate_tet_mesh(mesh, origin);
  check_midsides(mesh, origin, checks);
  if (checks.orientation) check_orientation(mesh, origin, remarks);
  check_strays(mesh, origin, checks.strays, remarks);
  remark_coincident(mesh, origin, remarks);
  if (checks.orientation) check_faces(mesh, origin, remarks);
}

void validate_tri_mesh(const TriMesh& mesh, const std::string& origin) {
  check_points(mesh.X, origin);
  if (mesh.triangles.empty()) throw InputError(origin + ": no triangles");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const int corner : mesh.triangles[t]) {
      if (corner < 0 || corner >= mesh.X.rows()) {
        throw InputError(origin + ": triangle " + std::to_string(t) + " (numbered from 0) has vertex " +
                         std::to_string(corner) + "; it must be in 0.." + std::to_string(mesh.X.rows() - 1));
      }
    }
  }
}

void check_tri_mesh(TriMesh& mesh, const std::string& origin, Remarks& remarks) {
  validate_tri_mesh(mesh, origin);
  const auto collapsed = std::erase_if(
      mesh.triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  if (collapsed > 0) {
    remarks.push_back(origin + ": dropped " + counted(static_cast<long long>(collapsed), "triangle") +
                      " with a corner twice");
  }
  if (mesh.triangles.empty()) throw InputError(origin + ": no triangles with three different corners");
  const int unused = drop_unused_vertices(mesh);
  if (unused > 0) {
    remarks.push_back(origin + ": dropped " +
                      (unused == 1 ? "1 vertex" : std::to_string(unused) + " vertices") + " of no triangle");
  }
  std::vector<int> flat;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& c = mesh.triangles[t];
    const Vec3 A = mesh.X.row(c[0]), B = mesh.X.row(c[1]), C = mesh.X.row(c[2]);
    const double longest = std::max({(B - A).squaredNorm(), (C - B).squaredNorm(), (A - C).squaredNorm()});
    if (!((B - A).cross(C - A).norm() > kFlat * longest)) flat.push_back(static_cast<int>(t));
  }
  if (!flat.empty()) {
    remarks.push_back(origin + ": " + counted(static_cast<long long>(flat.size()), "triangle") +
                      " without area, numbered from 0: " + name_vertices(flat));
  }
  remark_topology(surface_topology(mesh.triangles, static_cast<int>(mesh.X.rows())), origin + ": the surface",
                  remarks);
}

int drop_stray_vertices(TetMesh& mesh) {
  std::vector<char> keep(static_cast<std::size_t>(mesh.vertex_count()), 1);
  for (const int stray : stray_vertices(mesh)) keep[static_cast<std::size_t>(stray)] = 0;
  std::vector<int> renumbered;
  const int dropped = keep_vertices(mesh.X, keep, renumbered);
  for (Tet& tet : mesh.tets) {
    for (int& corner : tet) corner = renumbered[static_cast<std::size_t>(corner)];
  }
  for (Midsides& midsides : mesh.midsides) {
    for (int& node : midsides)
      if (node >= 0) node = renumbered[static_cast<std::size_t>(node)];
  }
  int begin = 0;
  for (Body& body : mesh.bodies) {
    const auto first = keep.begin() + body.vertices.begin;
    const int size = static_cast<int>(std::count(first, keep.begin() + body.vertices.end, 1));
    body.vertices = {begin, begin + size};
    begin += size;
  }
  return dropped;
}

int weld(TriMesh& mesh) {
  const std::vector<int> first = first_equal_points(mesh.X);
  std::vector<char> keep(first.size());
  for (std::size_t v = 0; v < first.size(); ++v) keep[v] = first[v] == static_cast<int>(v);
  std::vector<int> renumbered;
  const int dropped = keep_vertices(mesh.X, keep, renumbered);
  for (Triangle& triangle : mesh.triangles) {
    for (int& corner : triangle)
      corner = renumbered[static_cast<std::size_t>(first[static_cast<std::size_t>(corner)])];
  }
  return dropped;
}

}  // namespace lagomorph::sim
