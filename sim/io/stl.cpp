// STL, ASCII and binary. (3D Systems, "StereoLithography Interface Specification", 1989)
#include <algorithm>
#include <cstring>

#include <Eigen/Geometry>

#include "sim/io/formats.h"
#include "sim/io/scanner.h"
#include "sim/io/text_writer.h"

namespace lagomorph::sim::io {
namespace {

constexpr std::size_t kHeaderSize = 84;  // 80 bytes of anything, then the number of triangles
constexpr std::size_t kFacetSize = 50;   // normal, three corners, two bytes of attributes

/// Binary by its size, since its header may begin with "solid" too; by bytes that are no text, when that is
/// wrong.
bool is_binary(const std::string& bytes) {
  if (bytes.size() < kHeaderSize)
    return !bytes.starts_with("solid") && !bytes.empty() && bytes.find('\0') != std::string::npos;
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  if (bytes.size() == kHeaderSize + kFacetSize * static_cast<std::size_t>(count)) return true;
  return std::any_of(bytes.begin(), bytes.end(),
                     [](char c) { return c == '\0' || (c >= 1 && c < '\t') || (c > '\r' && c < ' '); });
}

TriMesh read_binary(const File& file) {
  Scanner scanner(file);
  scanner.set_binary(false);
  scanner.skip(80, "the header of 80 bytes");
  const auto count = scanner.binary<std::uint32_t>("the number of triangles");
  if (scanner.left() != kFacetSize * static_cast<std::size_t>(count)) {
    scanner.fail("the number of triangles is " + std::to_string(count) + ", which takes " +
                 std::to_string(kFacetSize * std::size_t{count}) + " bytes; " +
                 std::to_string(scanner.left()) + " follow");
  }
  scanner.check_count(count, "triangles", kFacetSize);
  TriMesh mesh;
  mesh.X.resize(3 * static_cast<Eigen::Index>(count), 3);
  for (Eigen::Index i = 0; i < mesh.X.rows(); ++i) {
    if (i % 3 == 0) scanner.skip(12, "a normal");
    for (int axis = 0; axis < 3; ++axis) {
      mesh.X(i, axis) =
          scanner.finite(static_cast<double>(scanner.binary<float>("a vertex")), "a vertex coordinate");
    }
    if (i % 3 == 2) {
      scanner.skip(2, "the attributes");
      mesh.triangles.push_back({static_cast<int>(i) - 2, static_cast<int>(i) - 1, static_cast<int>(i)});
    }
  }
  return mesh;
}

/// Keywords are in either case.
void expect_word(Scanner& scanner, std::string_view word) {
  const std::string_view found = scanner.token(std::string(word).c_str());
  const bool same = std::equal(found.begin(), found.end(), word.begin(), word.end(), [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? char(a - 'A' + 'a') : a) == b;
  });
  if (!same) scanner.fail("expected '" + std::string(word) + "', found " + in_quotes(found));
}

TriMesh read_ascii(const File& file) {
  Scanner scanner(file);
  std::vector<double> coordinates;
  TriMesh mesh;
  do {  // a file may have several solids
    expect_word(scanner, "solid");
    scanner.skip_line();  // its name
    while (scanner.peek().substr(0, 1) == "f" || scanner.peek().substr(0, 1) == "F") {
      expect_word(scanner, "facet");
      expect_word(scanner, "normal");
      for (int axis = 0; axis < 3; ++axis) scanner.token("a normal");  // not used, and not always a number
      expect_word(scanner, "outer");
      expect_word(scanner, "loop");
      for (int corner = 0; corner < 3; ++corner) {
        expect_word(scanner, "vertex");
        for (int axis = 0; axis < 3; ++axis) coordinates.push_back(scanner.number("a vertex coordinate"));
      }
      expect_word(scanner, "endloop");
      expect_word(scanner, "endfacet");
      const auto last = static_cast<int>(coordinates.size() / 3) - 1;
      mesh.triangles.push_back({last - 2, last - 1, last});
    }
    expect_word(scanner, "endsolid");
    scanner.skip_line();
  } while (!scanner.at_end());
  mesh.X = Eigen::Map<const Points>(coordinates.data(), static_cast<Eigen::Index>(coordinates.size() / 3), 3);
  return mesh;
}

}  // namespace

TriMesh read_stl(const File& file, Remarks&) {
  return is_binary(file.bytes) ? read_binary(file) : read_ascii(file);
}

/// ASCII, since binary STL has single precision only.
std::string write_stl(const TriMesh& mesh) {
  TextWriter out;
  out << "solid surface\n";
  for (const Triangle& triangle : mesh.triangles) {
    const Vec3 A = mesh.X.row(triangle[0]), B = mesh.X.row(triangle[1]), C = mesh.X.row(triangle[2]);
    const Vec3 normal = (B - A).cross(C - A).stableNormalized();
    out << "facet normal ";
    out.line(normal.x(), normal.y(), normal.z());
    out << "outer loop\n";
    for (const Vec3& corner : {A, B, C}) {
      out << "vertex ";
      out.line(corner.x(), corner.y(), corner.z());
    }
    out << "endloop\nendfacet\n";
  }
  out << "endsolid surface\n";
  return out.take();
}

}  // namespace lagomorph::sim::io
