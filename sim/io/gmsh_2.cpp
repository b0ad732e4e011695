// Gmsh .msh 2.0 to 2.2, ASCII and binary. ("Gmsh 4 reference manual", "MSH file format version 2")
#include <algorithm>

#include "sim/io/formats.h"
#include "sim/io/gmsh.h"
#include "sim/io/text_writer.h"

namespace lagomorph::sim::io {
namespace {

class Gmsh2Reader {
public:
  explicit Gmsh2Reader(GmshNumbers& numbers) : numbers_(numbers), scanner_(numbers.scanner()) {}

  void read_nodes() {
    const std::size_t count = text_count("nodes", 8, 28);
    mesh_.X.resize(static_cast<Eigen::Index>(count), 3);
    std::vector<std::int64_t> tags(count);
    for (std::size_t i = 0; i < count; ++i) {
      tags[i] = numbers_.integer("a node's number");
      for (int axis = 0; axis < 3; ++axis)
        mesh_.X(static_cast<Eigen::Index>(i), axis) = numbers_.number("a node's coordinate");
    }
    nodes_.assign(tags, scanner_);
  }

  void read_elements() {
    const std::size_t count = text_count("elements", 8, 16);
    mesh_.tets.reserve(count);
    mesh_.tags.reserve(count);
    for (std::size_t done = 0; done < count;) {
      if (numbers_.is_binary()) {
        const std::int64_t type = numbers_.integer("an element type");
        const int nodes = gmsh_node_count(type, scanner_);
        const std::int64_t follow = numbers_.integer("the number of elements that follow");
        if (follow < 1 || static_cast<std::uint64_t>(follow) > count - done) {
          scanner_.fail("the number of elements that follow is " + std::to_string(follow) + "; " +
                        std::to_string(count - done) + " are left");
        }
        const std::int64_t tags = numbers_.integer("the number of an element's tags");
        for (std::int64_t i = 0; i < follow; ++i) {
          numbers_.integer("an element's number");
          read_element(type, nodes, tags);
        }
        done += static_cast<std::size_t>(follow);
      } else {
        numbers_.integer("an element's number");
        const std::int64_t type = numbers_.integer("an element type");
        const int nodes = gmsh_node_count(type, scanner_);
        read_element(type, nodes, numbers_.integer("the number of an element's tags"));
        ++done;
      }
    }
  }

  bool has_nodes = false;
  bool has_elements = false;
  TetMesh take() { return std::move(mesh_); }

private:
  /// Counts are text in binary files too.
  std::size_t text_count(const char* what, std::size_t text_bytes, std::size_t binary_bytes) {
    const std::size_t count = scanner_.count(what, numbers_.is_binary() ? binary_bytes : text_bytes);
    if (numbers_.is_binary()) scanner_.skip_line();
    return count;
  }

  void read_element(std::int64_t type, int nodes, std::int64_t tags) {
    if (tags < 0)
      scanner_.fail("the number of an element's tags is " + std::to_string(tags) + "; it cannot be negative");
    int physical = 0;  // the first tag; 0 is none
    for (std::int64_t i = 0; i < tags; ++i) {
      const std::int64_t tag = numbers_.integer("an element's tag");
      if (i == 0) physical = scanner_.check_tag(tag);
    }
    if (!is_gmsh_tetrahedron(type)) {
      for (int i = 0; i < nodes; ++i) numbers_.integer("an element's node");
      return;
    }
    tet_.resize(static_cast<std::size_t>(nodes));
    for (int& node : tet_) node = nodes_.vertex(numbers_.integer("a tetrahedron's node"), scanner_);
    add_tet(mesh_, tet_, physical);
  }

  GmshNumbers& numbers_;
  Scanner& scanner_;
  TetMesh mesh_;
  GmshNodes nodes_;
  std::vector<int> tet_;  // nodes of the one that is read
};

}  // namespace

TetMesh read_gmsh_2(GmshNumbers& numbers) {
  Gmsh2Reader reader(numbers);
  Scanner& scanner = numbers.scanner();
  for_each_gmsh_section(numbers, [&](const std::string& name) {
    if (name == "$Nodes") {
      if (reader.has_nodes) scanner.fail("a second section $Nodes");
      reader.has_nodes = true;
      reader.read_nodes();
    } else if (name == "$Elements") {
      if (!reader.has_nodes) scanner.fail("$Elements before $Nodes");
      if (reader.has_elements) scanner.fail("a second section $Elements");
      reader.has_elements = true;
      reader.read_elements();
    } else {
      return false;
    }
    return true;
  });
  if (!reader.has_nodes) scanner.fail("no section $Nodes");
  if (!reader.has_elements) scanner.fail("no section $Elements");
  return reader.take();
}

std::string write_gmsh(const TetMesh& mesh) {
  TextWriter out;
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << mesh.X.rows() << '\n';
  for (Eigen::Index i = 0; i < mesh.X.rows(); ++i) out.line(i + 1, mesh.X(i, 0), mesh.X(i, 1), mesh.X(i, 2));
  out << "$EndNodes\n$Elements\n" << mesh.tets.size() << '\n';
  std::size_t body = 0;
  for (std::size_t j = 0; j < mesh.tets.size(); ++j) {
    while (body + 1 < mesh.bodies.size() && static_cast<int>(j) >= mesh.bodies[body].tets.end) ++body;
    // Number, type, two tags: the physical one, and the elementary entity, which is the body.
    out << j + 1 << ' ' << (mesh.is_quadratic(j) ? kGmshQuadraticTetrahedron : kGmshTetrahedron) << " 2 "
        << mesh.tags[j] << ' ' << body + 1;
    for (const int node : nodes_of(mesh, j)) out << ' ' << node + 1;
    out << '\n';
  }
  out << "$EndElements\n";
  return out.take();
}

}  // namespace lagomorph::sim::io
