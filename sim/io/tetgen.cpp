// TetGen's .node and .ele. (Si, "TetGen, a quality tetrahedral mesh generator", manual 1.5, section 5.2)
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

#include "sim/error.h"
#include "sim/io/formats.h"
#include "sim/io/scanner.h"
#include "sim/io/text_writer.h"

namespace lagomorph::sim::io {
namespace {

/// Where `tetgen -o2`'s six midside nodes, on the edges (2,3) (0,3) (0,1) (1,2) (1,3) (0,2), stand among our
/// ten nodes. (order of tetgenmesh::highorder; not in the manual)
constexpr std::array<std::size_t, 6> kMidsides = {8, 7, 4, 5, 9, 6};

/// The file beside this one with another extension.
File read_partner(const File& file, const char* extension) {
  const std::filesystem::path partner = std::filesystem::path(file.path).replace_extension(extension);
  if (!std::filesystem::exists(partner)) {
    throw InputError(file.path + ": needs " + partner.string() + " beside it, which does not exist");
  }
  return read_file(partner);
}

/// An optional number of a header, which ends with its line.
std::int64_t header_number(Scanner& scanner, const char* what, std::int64_t otherwise) {
  return scanner.at_line_end() ? otherwise : scanner.integer(what);
}

/// How many numbers a line has for something that the header may leave out.
std::size_t header_width(Scanner& scanner, const char* what) {
  const std::int64_t width = header_number(scanner, what, 0);
  if (width < 0 || width > 1000)
    scanner.fail(std::string(what) + " is " + std::to_string(width) + "; it must be in 0..1000");
  return static_cast<std::size_t>(width);
}

/// Reads the vertices; returns the number of the first one, 0 or 1.
std::int64_t read_nodes(Scanner& scanner, TetMesh& mesh) {
  if (scanner.at_end()) scanner.fail("no header line: <points> 3 <attributes> <boundary markers>");
  const std::size_t count = scanner.count("points", 8);
  const std::int64_t dimension = header_number(scanner, "the dimension", 3);
  if (dimension != 3) scanner.fail("the dimension is " + std::to_string(dimension) + "; it must be 3");
  const std::size_t extra =
      header_width(scanner, "the number of attributes") + header_width(scanner, "the boundary marker flag");
  scanner.expect_line_end("the header");
  mesh.X.resize(static_cast<Eigen::Index>(count), 3);
  std::int64_t first = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t number = scanner.integer("a point's number");
    if (i == 0 && (number == 0 || number == 1)) first = number;
    if (number != first + static_cast<std::int64_t>(i)) {
      scanner.fail("a point's number is " + std::to_string(number) +
                   (i == 0 ? "; the first must be 0 or 1"
                           : "; after the one before, " +
                                 std::to_string(first + static_cast<std::int64_t>(i)) + " must follow"));
    }
    for (int axis = 0; axis < 3; ++axis)
      mesh.X(static_cast<Eigen::Index>(i), axis) = scanner.number("a point's coordinate");
    for (std::size_t k = 0; k < extra; ++k) scanner.number("a point's attribute or marker");
    scanner.expect_line_end("a point");
  }
  if (!scanner.at_end())
    scanner.fail("unexpected " + in_quotes(scanner.peek()) + " after the last of " + std::to_string(count) +
                 " points");
  return first;
}

void read_tets(Scanner& scanner, std::int64_t first, TetMesh& mesh, Remarks& remarks) {
  if (scanner.at_end()) scanner.fail("no header line: <tetrahedra> 4 <attributes>");
  const std::size_t count = scanner.count("tetrahedra", 10);
  const std::int64_t nodes = header_number(scanner, "the number of nodes of a tetrahedron", 4);
  if (nodes != 4 && nodes != 10) {
    scanner.fail(std::to_string(nodes) +
                 "-node tetrahedra; only 4-node and 10-node (tetgen -o2) tetrahedra can be used");
  }
  const std::size_t attributes = header_width(scanner, "the number of attributes");
  scanner.expect_line_end("the header");
  std::vector<int> tet(static_cast<std::size_t>(nodes));
  std::size_t fractions = 0;
  for (std::size_t j = 0; j < count; ++j) {
    scanner.integer("a tetrahedron's number");
    for (std::size_t k = 0; k < tet.size(); ++k) {
      tet[k < 4 ? k : kMidsides[k - 4]] =
          scanner.index("a vertex of a tetrahedron", first, static_cast<std::size_t>(mesh.X.rows()));
    }
    int tag = 0;
    for (std::size_t k = 0; k < attributes; ++k) {
      const double attribute = scanner.number("a region attribute");
      if (k > 0) continue;
      if (attribute != std::floor(attribute) || std::abs(attribute) > std::numeric_limits<int>::max()) {
        ++fractions;
      } else {
        tag = static_cast<int>(attribute);
      }
    }
    add_tet(mesh, tet, tag);
    scanner.expect_line_end("a tetrahedron");
  }
  if (!scanner.at_end()) {
    scanner.fail("unexpected " + in_quotes(scanner.peek()) + " after the last of " + std::to_string(count) +
                 " tetrahedra");
  }
  if (fractions > 0) {
    remarks.push_back(scanner.path() + ": " + std::to_string(fractions) +
                      " region attributes are no whole numbers; their tags are 0");
  }
}

TetMesh read_pair(const File& node, const File& ele, Remarks& remarks) {
  TetMesh mesh;
  Scanner nodes(node, '#');
  const std::int64_t first = read_nodes(nodes, mesh);
  Scanner tets(ele, '#');
  read_tets(tets, first, mesh, remarks);
  return mesh;
}

}  // namespace

TetMesh read_tetgen_node(const File& file, Remarks& remarks) {
  return read_pair(file, read_partner(file, ".ele"), remarks);
}

TetMesh read_tetgen_ele(const File& file, Remarks& remarks) {
  return read_pair(read_partner(file, ".node"), file, remarks);
}

std::string write_tetgen_node(const TetMesh& mesh) {
  TextWriter out;
  out.line(mesh.X.rows(), 3, 0, 0);
  for (Eigen::Index i = 0; i < mesh.X.rows(); ++i) out.line(i, mesh.X(i, 0), mesh.X(i, 1), mesh.X(i, 2));
  return out.take();
}

std::string write_tetgen_ele(const TetMesh& mesh) {
  TextWriter out;
  const bool quadratic = !mesh.midsides.empty();
  for (std::size_t j = 0; quadratic && j < mesh.tets.size(); ++j) {
    if (!mesh.is_quadratic(j))
      throw InputError("tet " + std::to_string(j) +
                       " has 4 nodes, others 10; .ele files have one kind of tets");
  }
  out.line(mesh.tets.size(), quadratic ? 10 : 4, 1);
  for (std::size_t j = 0; j < mesh.tets.size(); ++j) {
    const std::vector<int> nodes = nodes_of(mesh, j);
    out << j;
    for (std::size_t k = 0; k < nodes.size(); ++k) out << ' ' << nodes[k < 4 ? k : kMidsides[k - 4]];
    out << ' ' << mesh.tags[j] << '\n';
  }
  return out.take();
}

}  // namespace lagomorph::sim::io
