// Wavefront OBJ: vertices and polygons. (Wavefront, "Advanced Visualizer" manual, appendix B1, "Object
// files")
#include <algorithm>
#include <array>
#include <charconv>

#include "sim/io/formats.h"
#include "sim/io/polygon.h"
#include "sim/io/scanner.h"
#include "sim/io/text_writer.h"

namespace lagomorph::sim::io {
namespace {

/// Statements without geometry of ours: texture coordinates, normals, groups, materials, points and lines.
constexpr std::array<std::string_view, 20> kIgnored = {
    "vt",     "vn", "vp", "g",   "o",     "s",        "mg",       "usemtl",     "mtllib",    "usemap",
    "maplib", "l",  "p",  "lod", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj", "call"};

/// One word of a face: v, v/vt, v//vn or v/vt/vn; negative indices count back from the last vertex. Returns
/// the vertex, 0-based.
int parse_corner(std::string_view word, std::size_t vertex_count, Scanner& scanner) {
  std::int64_t fields[3] = {0, 0, 0};
  const char* at = word.data();
  const char* end = word.data() + word.size();
  for (int field = 0; field < 3; ++field) {
    const auto [stop, error] = std::from_chars(at, end, fields[field]);
    const bool left_out = field == 1 && stop == at && at != end && *at == '/';
    if (error != std::errc() && !left_out) break;
    if (stop == end) {
      const auto n = static_cast<std::int64_t>(vertex_count);
      const std::int64_t v = fields[0];
      if (v == 0 || v > n || v < -n) {
        scanner.fail("a face's vertex is " + std::to_string(v) + "; it must be in 1.." + std::to_string(n) +
                     " or -" + std::to_string(n) + "..-1, the vertices so far");
      }
      return static_cast<int>(v > 0 ? v - 1 : n + v);
    }
    if (*stop != '/') break;
    at = stop + 1;
  }
  scanner.fail("expected a face's corner such as 1, 1/2, 1//3 or 1/2/3, found " + in_quotes(word));
}

/// Whether the statement goes on; a backslash at a line's end continues it on the next.
bool statement_goes_on(Scanner& scanner) {
  while (!scanner.at_line_end()) {
    if (scanner.peek() != "\\") return true;
    scanner.skip_line();
  }
  return false;
}

}  // namespace

TriMesh read_obj(const File& file, Remarks&) {
  Scanner scanner(file, '#');
  std::vector<double> coordinates;
  std::vector<int> corners;
  TriMesh mesh;
  while (!scanner.at_end()) {
    const std::string_view keyword = scanner.token("a statement");
    if (keyword == "v") {
      for (int axis = 0; axis < 3; ++axis) coordinates.push_back(scanner.number("a vertex coordinate"));
      while (statement_goes_on(scanner)) scanner.number("a vertex weight or colour");
    } else if (keyword == "f" || keyword == "fo") {
      corners.clear();
      while (statement_goes_on(scanner)) {
        corners.push_back(parse_corner(scanner.token("a corner"), coordinates.size() / 3, scanner));
      }
      triangulate_polygon(corners, as_points(coordinates), mesh.triangles, scanner);
    } else if (std::find(kIgnored.begin(), kIgnored.end(), keyword) != kIgnored.end()) {
      while (statement_goes_on(scanner)) scanner.token("an argument");
    } else {
      scanner.fail("unknown statement " + in_quotes(keyword) + "; vertices (v) and polygons (f) can be read");
    }
  }
  mesh.X = as_points(coordinates);
  return mesh;
}

std::string write_obj(const TriMesh& mesh) {
  TextWriter out;
  for (Eigen::Index i = 0; i < mesh.X.rows(); ++i) {
    out << "v ";
    out.line(mesh.X(i, 0), mesh.X(i, 1), mesh.X(i, 2));
  }
  for (const Triangle& triangle : mesh.triangles) {
    out << "f ";
    out.line(triangle[0] + 1, triangle[1] + 1, triangle[2] + 1);
  }
  return out.take();
}

}  // namespace lagomorph::sim::io
