// Object File Format OFF, ASCII. (Geomview manual, "OFF Files")
#include <algorithm>

#include "sim/io/formats.h"
#include "sim/io/polygon.h"
#include "sim/io/scanner.h"
#include "sim/io/text_writer.h"

namespace lagomorph::sim::io {

TriMesh read_off(const File& file, Remarks&) {
  Scanner scanner(file, '#');
  const std::string_view header = scanner.token("the header OFF");
  // [ST][C][N]OFF: texture coordinates, colours and normals follow a vertex on its line; [4][n]OFF: not
  // three-dimensional.
  std::string_view prefix = header.ends_with("OFF") ? header.substr(0, header.size() - 3) : "?";
  if (prefix.starts_with("ST")) prefix.remove_prefix(2);
  if (prefix.starts_with("C")) prefix.remove_prefix(1);
  if (prefix.starts_with("N")) prefix.remove_prefix(1);
  if (!prefix.empty())
    scanner.fail("the header is " + in_quotes(header) + "; OFF, COFF, NOFF, CNOFF and STOFF can be read");
  const bool decorated = header != "OFF";
  if (scanner.peek() == "BINARY") scanner.fail("binary OFF; only ASCII can be read");
  const std::size_t vertex_count = scanner.count("vertices", 6);
  const std::size_t face_count = scanner.count("faces", 4);
  if (!scanner.at_line_end()) scanner.integer("the number of edges");
  TriMesh mesh;
  mesh.X.resize(static_cast<Eigen::Index>(vertex_count), 3);
  for (Eigen::Index i = 0; i < mesh.X.rows(); ++i) {
    for (int axis = 0; axis < 3; ++axis) mesh.X(i, axis) = scanner.number("a vertex coordinate");
    if (decorated) {
      while (!scanner.at_line_end()) scanner.number("a vertex normal, colour or texture coordinate");
    } else {
      scanner.expect_line_end("a vertex; a vertex with a colour needs the header COFF");
    }
  }
  const Eigen::Map<const Points> X(mesh.X.data(), mesh.X.rows(), 3);
  std::vector<int> corners;
  for (std::size_t f = 0; f < face_count; ++f) {
    corners.resize(scanner.count("corners of a face", 2));
    for (int& corner : corners) corner = scanner.index("a face's vertex", 0, vertex_count);
    triangulate_polygon(corners, X, mesh.triangles, scanner);
    while (!scanner.at_line_end()) scanner.number("a face's colour");
  }
  if (!scanner.at_end()) {
    scanner.fail("unexpected " + in_quotes(scanner.peek()) + " after the last of " +
                 std::to_string(face_count) + " faces");
  }
  return mesh;
}

std::string write_off(const TriMesh& mesh) {
  TextWriter out;
  out << "OFF\n";
  out.line(mesh.X.rows(), mesh.triangles.size(), 0);
  for (Eigen::Index i = 0; i < mesh.X.rows(); ++i) out.line(mesh.X(i, 0), mesh.X(i, 1), mesh.X(i, 2));
  for (const Triangle& triangle : mesh.triangles) out.line(3, triangle[0], triangle[1], triangle[2]);
  return out.take();
}

}  // namespace lagomorph::sim::io
