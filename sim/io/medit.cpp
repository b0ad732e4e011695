// Medit .mesh, ASCII. (Frey, "MEDIT: an interactive mesh visualization software", INRIA RT-0253, 2001;
// libMeshb's keywords. Its TetrahedraP2 are refused: the format does not say the order of their midside
// nodes)
#include <algorithm>
#include <array>
#include <optional>

#include "sim/io/formats.h"
#include "sim/io/scanner.h"
#include "sim/io/text_writer.h"

namespace lagomorph::sim::io {
namespace {

struct Section {
  std::string_view keyword;
  int width;    // numbers an entry
  bool volume;  // elements that fill space but are no 4-node tetrahedra
};

/// Sections that are skipped entry by entry, so that their counts are checked too. Any other keyword is
/// skipped up to the next one.
constexpr std::array kSections = {
    Section{"Edges", 3, false},
    Section{"Triangles", 4, false},
    Section{"Quadrilaterals", 5, false},
    Section{"Corners", 1, false},
    Section{"RequiredVertices", 1, false},
    Section{"Ridges", 1, false},
    Section{"RequiredEdges", 1, false},
    Section{"RequiredTriangles", 1, false},
    Section{"RequiredQuadrilaterals", 1, false},
    Section{"Normals", 3, false},
    Section{"NormalAtVertices", 2, false},
    Section{"Tangents", 3, false},
    Section{"TangentAtVertices", 2, false},
    Section{"Hexahedra", 9, true},
    Section{"Prisms", 7, true},
    Section{"Pyramids", 6, true},
    Section{"TetrahedraP2", 11, true},
    Section{"HexahedraQ2", 28, true},
    Section{"PrismsP2", 19, true},
    Section{"PyramidsP2", 15, true},
};

bool is_keyword(std::string_view word) {
  return !word.empty() && ((word[0] >= 'A' && word[0] <= 'Z') || (word[0] >= 'a' && word[0] <= 'z'));
}

void skip_section(Scanner& scanner, const Section& section) {
  const std::string name(section.keyword);
  const std::size_t count = scanner.count(name.c_str(), 2 * static_cast<std::size_t>(section.width));
  if (section.volume && count > 0) {
    scanner.fail(std::to_string(count) + " " + name + "; only 4-node Tetrahedra can be used for volumes");
  }
  const std::string what = "an entry of " + name;
  for (std::size_t i = 0; i < count * static_cast<std::size_t>(section.width); ++i)
    scanner.number(what.c_str());
}

void read_vertices(Scanner& scanner, TetMesh& mesh) {
  const std::size_t count = scanner.count("Vertices", 8);
  mesh.X.resize(static_cast<Eigen::Index>(count), 3);
  for (Eigen::Index i = 0; i < mesh.X.rows(); ++i) {
    for (int axis = 0; axis < 3; ++axis) mesh.X(i, axis) = scanner.number("a vertex coordinate");
    scanner.integer("a vertex reference");
  }
}

void read_tetrahedra(Scanner& scanner, TetMesh& mesh) {
  const std::size_t count = scanner.count("Tetrahedra", 10);
  mesh.tets.resize(count);
  mesh.tags.resize(count);
  for (std::size_t j = 0; j < count; ++j) {
    for (int& corner : mesh.tets[j]) {
      corner = scanner.index("a vertex of a tetrahedron", 1, static_cast<std::size_t>(mesh.X.rows()));
    }
    mesh.tags[j] = scanner.check_tag(scanner.integer("a tetrahedron's reference"));
  }
}

}  // namespace

TetMesh read_medit(const File& file, Remarks&) {
  Scanner scanner(file, '#');
  scanner.expect("MeshVersionFormatted");
  const std::int64_t version = scanner.integer("the version");
  if (version < 0 || version > 4)
    scanner.fail("version " + std::to_string(version) + "; versions 0 to 4 can be read");
  TetMesh mesh;
  bool has_dimension = false;
  bool has_vertices = false;
  std::optional<std::size_t> tetrahedra;  // where they are; they may stand before the vertices
  while (!scanner.at_end()) {
    const std::string_view keyword = scanner.token("a keyword");
    if (keyword == "End") break;
    if (!is_keyword(keyword)) {
      scanner.fail("expected a section's keyword, found " + in_quotes(keyword) +
                   "; is the count of the section before it right?");
    }
    const auto* section = std::find_if(kSections.begin(), kSections.end(),
                                       [&](const Section& s) { return s.keyword == keyword; });
    if (keyword == "Dimension") {
      const std::int64_t dimension = scanner.integer("the dimension");
      if (dimension != 3) scanner.fail("the dimension is " + std::to_string(dimension) + "; it must be 3");
      has_dimension = true;
    } else if (keyword == "Vertices") {
      if (!has_dimension) scanner.fail("'Vertices' before 'Dimension 3'");
      if (has_vertices) scanner.fail("a second section 'Vertices'");
      has_vertices = true;
      read_vertices(scanner, mesh);
    } else if (keyword == "Tetrahedra") {
      if (tetrahedra) scanner.fail("a second section 'Tetrahedra'");
      tetrahedra = scanner.position();
      if (has_vertices) {
        read_tetrahedra(scanner, mesh);
      } else {
        skip_section(scanner, {"Tetrahedra", 5, false});
      }
    } else if (section != kSections.end()) {
      skip_section(scanner, *section);
    } else {
      while (!scanner.at_end() && !is_keyword(scanner.peek())) scanner.token("an entry");
    }
  }
  if (!has_vertices) scanner.fail("no section 'Vertices'");
  if (!tetrahedra)
    scanner.fail("no section 'Tetrahedra'; a surface cannot be simulated, a tetrahedral mesh is needed");
  if (mesh.tets.empty()) {
    scanner.seek(*tetrahedra);
    read_tetrahedra(scanner, mesh);
  }
  return mesh;
}

std::string write_medit(const TetMesh& mesh) {
  TextWriter out;
  out << "MeshVersionFormatted 2\nDimension 3\nVertices\n" << mesh.X.rows() << '\n';
  for (Eigen::Index i = 0; i < mesh.X.rows(); ++i) out.line(mesh.X(i, 0), mesh.X(i, 1), mesh.X(i, 2), 0);
  out << "Tetrahedra\n" << mesh.tets.size() << '\n';
  for (std::size_t j = 0; j < mesh.tets.size(); ++j) {
    const Tet& tet = mesh.tets[j];
    out.line(tet[0] + 1, tet[1] + 1, tet[2] + 1, tet[3] + 1, mesh.tags[j]);
  }
  out << "End\n";
  return out.take();
}

}  // namespace lagomorph::sim::io
