// Makes the surfaces of assets/meshes: the smooth bunny, and coarse cages that enclose it for a tet mesher.
// Built and run by make_meshes.sh; no part of the lagomorph program. Needs CGAL 5.5 (GPL).
//
//   make_cage surface INDEX_JS OUT.obj            the npm package's bunny, subdivided, 1 m tall, on y = 0
//   make_cage cage FINE.obj OFFSET DEVIATION SIZE OUT.off     all in metres

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/intersection.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/OBJ.h>
#include <CGAL/boost/graph/IO/OFF.h>
#include <CGAL/facets_in_complex_3_to_triangle_mesh.h>
#include <CGAL/make_mesh_3.h>
#include <CGAL/subdivision_method_3.h>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Mesh>>>;
namespace pmp = CGAL::Polygon_mesh_processing;
namespace param = CGAL::parameters;

/// Signed distance to a closed surface, negative inside [m].
class Distance {
public:
  explicit Distance(const Mesh& mesh) : tree_(faces(mesh).begin(), faces(mesh).end(), mesh), side_(tree_) {
    tree_.accelerate_distance_queries();
  }
  double operator()(const Point& p) const { return signed_by_side(p, std::sqrt(tree_.squared_distance(p))); }
  /// Also the nearest point and the triangle that holds it.
  double nearest(const Point& p, Point& foot, Mesh::Face_index& face) const {
    const auto hit = tree_.closest_point_and_primitive(p);
    foot = hit.first;
    face = hit.second;
    return signed_by_side(p, std::sqrt(CGAL::squared_distance(p, foot)));
  }

private:
  double signed_by_side(const Point& p, double distance) const {
    return side_(p) == CGAL::ON_BOUNDED_SIDE ? -distance : distance;
  }
  Tree tree_;
  CGAL::Side_of_triangle_mesh<Mesh, Kernel> side_;
};

std::array<Mesh::Vertex_index, 3> corners(const Mesh& mesh, Mesh::Face_index face) {
  const auto h = mesh.halfedge(face);
  return {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))};
}

/// Vertices, triangle centroids and seven points an edge.
std::vector<Point> samples(const Mesh& mesh) {
  std::vector<Point> points(mesh.points().begin(), mesh.points().end());
  for (const auto e : mesh.edges()) {
    const Point a = mesh.point(mesh.vertex(e, 0)), b = mesh.point(mesh.vertex(e, 1));
    for (int i = 1; i < 8; ++i) points.push_back(a + i / 8.0 * (b - a));
  }
  for (const auto f : mesh.faces()) {
    const auto v = corners(mesh, f);
    points.push_back(CGAL::centroid(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2])));
  }
  return points;
}

void require(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error(what);
}

void require_sound(const Mesh& mesh) {
  require(CGAL::is_closed(mesh), "the surface is not closed");
  require(mesh.number_of_vertices() + mesh.number_of_faces() == mesh.number_of_edges() + 2,
          "the surface is not one piece of genus 0");
  require(!pmp::does_self_intersect(mesh), "the surface intersects itself");
  require(pmp::is_outward_oriented(mesh), "the surface is turned inside out");
}

/// The numbers of a nested JavaScript array `name=[[...],[...]]`.
std::vector<double> numbers(const std::string& text, const std::string& name) {
  const size_t begin = text.find(name + "=[[");
  const size_t end = text.find("]]", begin);
  require(begin != std::string::npos && end != std::string::npos, "no array '" + name + "' in the package");
  std::string list = text.substr(begin + name.size(), end - begin - name.size());
  std::replace_if(
      list.begin(), list.end(), [](char c) { return c == '[' || c == ']' || c == ',' || c == '='; }, ' ');
  std::istringstream in(list);
  return {std::istream_iterator<double>(in), {}};
}

void make_surface(const char* package, const char* out) {
  std::ifstream in(package);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  const auto x = numbers(text, "positions");
  const auto t = numbers(text, "cells");
  Mesh mesh;
  for (size_t i = 0; i < x.size(); i += 3) mesh.add_vertex(Point(x[i], x[i + 1], x[i + 2]));
  const auto vertex = [&](size_t i) { return Mesh::Vertex_index(static_cast<Mesh::size_type>(t[i])); };
  for (size_t i = 0; i < t.size(); i += 3) mesh.add_face(vertex(i), vertex(i + 1), vertex(i + 2));
  CGAL::Subdivision_method_3::Loop_subdivision(mesh, param::number_of_iterations(1));

  const auto box = pmp::bbox(mesh);
  const double height = box.ymax() - box.ymin();
  for (auto& p : mesh.points()) {
    p = Point((p.x() - (box.xmin() + box.xmax()) / 2) / height, (p.y() - box.ymin()) / height,
              (p.z() - (box.zmin() + box.zmax()) / 2) / height);
  }
  require_sound(mesh);

  std::FILE* file = std::fopen(out, "w");
  require(file != nullptr, std::string("cannot write ") + out);
  std::fprintf(file,
               "# Stanford bunny, Stanford 3D Scanning Repository; see assets/README.md. Metres, y up.\n");
  const auto row = [&](const char* key, double a, double b, double c, int digits) {
    // + 0.0 after rounding would still print -0: shift it away first.
    const double least = 0.5 * std::pow(10.0, -digits);
    for (double* value : {&a, &b, &c}) *value = std::abs(*value) < least ? 0.0 : *value;
    std::fprintf(file, "%s %.*f %.*f %.*f\n", key, digits, a, digits, b, digits, c);
  };
  for (const auto& p : mesh.points()) row("v", p.x(), p.y(), p.z(), 6);
  for (const auto v : mesh.vertices()) {
    const Vector n = pmp::compute_vertex_normal(v, mesh);
    row("vn", n.x(), n.y(), n.z(), 4);
  }
  for (const auto f : mesh.faces()) {
    std::fputs("f", file);
    for (const auto v : corners(mesh, f)) std::fprintf(file, " %u//%u", v.idx() + 1, v.idx() + 1);
    std::fputs("\n", file);
  }
  require(std::fclose(file) == 0, std::string("cannot write ") + out);
  std::cout << "surface: " << mesh.number_of_vertices() << " vertices, " << mesh.number_of_faces()
            << " triangles, volume " << pmp::volume(mesh) << " m^3, area " << pmp::area(mesh) << " m^2\n";
}

/// Delaunay surface mesh [Boissonnat, Oudot 2005] of the offset surface { x : distance(x) = offset }: angles
/// of at least 30 degrees, no triangle further than `deviation` from it, none larger than `size`.
Mesh mesh_offset(const Distance& distance, double offset, double deviation, double size) {
  using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
  using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
  using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
  const Domain domain = Domain::create_implicit_mesh_domain(
      [&](const Point& p) { return distance(p) - offset; }, Kernel::Sphere_3(Point(0, 0.4, 0), 1.2),
      param::relative_error_bound = 1e-6);
  const CGAL::Mesh_criteria_3<Triangulation> criteria(param::facet_angle = 30, param::facet_size = size,
                                                      param::facet_distance = deviation);
  const auto complex =
      CGAL::make_mesh_3<Complex>(domain, criteria, param::no_perturb(), param::no_exude(), param::manifold());
  Mesh mesh;
  CGAL::facets_in_complex_3_to_triangle_mesh(complex, mesh);
  if (!pmp::is_outward_oriented(mesh)) pmp::reverse_face_orientations(mesh);
  return mesh;
}

/// Moves cage vertices outward until the surface's points are inside of the cage, and the cage's edges
/// outside of the surface, by `margin`. A place on the cage with barycentric weights w that lacks the
/// distance d asks its corners for d w / |w|^2 along their normals: the smallest displacement that lifts it
/// by d.
void push_out(Mesh& cage, const Distance& surface, const std::vector<Point>& points, double margin) {
  constexpr int edge_points = 16;
  for (int round = 0; round < 200; ++round) {
    std::vector<double> step(cage.number_of_vertices(), 0.0);
    bool encloses = true;
    const auto lift = [&](const auto& corner, const auto& w, double lack) {
      encloses = false;
      double norm2 = 0.0;
      for (const double weight : w) norm2 += weight * weight;
      for (size_t k = 0; k < w.size(); ++k) {
        step[corner[k]] = std::max(step[corner[k]], (lack + 0.2 * margin) * w[k] / norm2);
      }
    };

    const Distance distance(cage);
    for (const Point& p : points) {
      Point foot;
      Mesh::Face_index face;
      const double d = distance.nearest(p, foot, face);
      if (d <= -margin) continue;
      const auto corner = corners(cage, face);
      const std::array<Point, 3> x = {cage.point(corner[0]), cage.point(corner[1]), cage.point(corner[2])};
      const Vector n = CGAL::cross_product(x[1] - x[0], x[2] - x[0]);
      std::array<double, 3> w;
      for (int k = 0; k < 3; ++k) {
        w[k] = std::max(0.0, CGAL::cross_product(x[(k + 1) % 3] - foot, x[(k + 2) % 3] - foot) * n / (n * n));
      }
      lift(corner, w, d + margin);
    }
    for (const auto e : cage.edges()) {
      const std::array<Mesh::Vertex_index, 2> corner = {cage.vertex(e, 0), cage.vertex(e, 1)};
      for (int i = 0; i <= edge_points; ++i) {
        const double s = static_cast<double>(i) / edge_points;
        const Point a = cage.point(corner[0]), b = cage.point(corner[1]);
        const double d = surface(a + s * (b - a));
        if (d < margin) lift(corner, std::array<double, 2>{1.0 - s, s}, margin - d);
      }
    }
    if (encloses) return;

    std::vector<Vector> normal;
    for (const auto v : cage.vertices()) normal.push_back(pmp::compute_vertex_normal(v, cage));
    for (const auto v : cage.vertices()) cage.point(v) = cage.point(v) + step[v] * normal[v];
  }
  throw std::runtime_error("the cage does not come to enclose the surface; take a larger offset");
}

void make_cage(const char* surface, double offset, double deviation, double size, const char* out) {
  Mesh fine;
  require(CGAL::IO::read_OBJ(surface, fine), std::string("cannot read ") + surface);
  const Distance distance(fine);
  Mesh cage = mesh_offset(distance, offset, deviation, size);
  push_out(cage, distance, samples(fine), 3e-4);
  require_sound(cage);
  require(!pmp::do_intersect(cage, fine), "the cage cuts the surface");
  double furthest = 0.0;
  for (const Point& p : samples(cage)) furthest = std::max(furthest, distance(p));
  require(CGAL::IO::write_OFF(out, cage, param::stream_precision(17)), std::string("cannot write ") + out);
  std::cout << "cage: " << cage.number_of_faces() << " triangles, around the surface by at most " << furthest
            << " m, " << 100.0 * (pmp::volume(cage) / pmp::volume(fine) - 1.0) << " % more volume\n";
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> args(argv, argv + argc);
  try {
    if (argc == 4 && args[1] == "surface") {
      make_surface(argv[2], argv[3]);
    } else if (argc == 7 && args[1] == "cage") {
      make_cage(argv[2], std::stod(args[3]), std::stod(args[4]), std::stod(args[5]), argv[6]);
    } else {
      std::cerr
          << "usage: make_cage surface INDEX_JS OUT.obj | cage FINE.obj OFFSET DEVIATION SIZE OUT.off\n";
      return 2;
    }
  } catch (const std::exception& error) {
    std::cerr << "make_cage: error: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
