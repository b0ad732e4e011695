#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "sim/io/scanner.h"
#include "sim/mesh_io.h"

/// What the readers of Gmsh's versions share. ("Gmsh 4 reference manual", "MSH file format" and "MSH file
/// format version 2")
namespace lagomorph::sim::io {

/// Numbers of a section, as text or binary by the file's header.
class GmshNumbers {
public:
  GmshNumbers(Scanner& scanner, bool binary) : scanner_(scanner), binary_(binary) {}
  bool is_binary() const { return binary_; }
  Scanner& scanner() { return scanner_; }

  std::int64_t integer(const char* what) {
    return binary_ ? scanner_.binary<std::int32_t>(what) : scanner_.integer(what);
  }
  std::int64_t size(const char* what);  // 8 bytes in binary
  double number(const char* what) {
    return binary_ ? scanner_.finite(scanner_.binary<double>(what), what) : scanner_.number(what);
  }
  /// A count of items of at least `text_bytes` or `binary_bytes` each.
  std::size_t count(const char* what, std::size_t text_bytes, std::size_t binary_bytes) {
    return scanner_.check_count(size(what), what, binary_ ? binary_bytes : text_bytes);
  }

private:
  Scanner& scanner_;
  bool binary_;
};

/// Node tags, which need be neither contiguous nor ordered, to 0-based vertices in file order.
class GmshNodes {
public:
  /// Fails at what the scanner read last when a tag is there twice.
  void assign(const std::vector<std::int64_t>& tags, Scanner&);
  /// Fails when there is no such node.
  int vertex(std::int64_t tag, Scanner&) const;

private:
  std::int64_t first_ = 0;
  std::vector<int> dense_;  // by tag - first_, -1 where there is none; used when tags are not too sparse
  std::unordered_map<std::int64_t, int> sparse_;
};

/// How many nodes an element of this type has. Fails when it is a volume other than a tetrahedron of 4 or 10
/// nodes, or unknown.
int gmsh_node_count(std::int64_t type, Scanner&);
/// Their midside nodes are in the order of kTetEdges.
constexpr int kGmshTetrahedron = 4, kGmshQuadraticTetrahedron = 11;
inline bool is_gmsh_tetrahedron(std::int64_t type) {
  return type == kGmshTetrahedron || type == kGmshQuadraticTetrahedron;
}

/// See for_each_gmsh_section.
template <typename Read>
void read_gmsh_section(GmshNumbers& numbers, Read& read) {
  Scanner& scanner = numbers.scanner();
  const std::string name(scanner.token("a section"));
  if (name.size() < 2 || name[0] != '$')
    scanner.fail("expected a section such as $Nodes, found " + in_quotes(name));
  if (numbers.is_binary()) scanner.skip_line();
  const std::string end = "$End" + name.substr(1);
  if (read(name)) {
    if (!scanner.at_end() && scanner.peek() != end) {
      scanner.fail("expected '" + end + "', found " + in_quotes(scanner.peek()) + "; is the count in " +
                   name + " right?");
    }
  } else {
    const std::size_t found = scanner.bytes().find(end, scanner.position());
    if (found == std::string_view::npos) scanner.fail(name + " has no " + end);
    scanner.seek(found);
  }
  scanner.token(end.c_str());
}

/// Calls `read(name)` for each section ("$Nodes") after its first line; when it returns false the section is
/// skipped.
template <typename Read>
void for_each_gmsh_section(GmshNumbers& numbers, Read read) {
  while (!numbers.scanner().at_end()) read_gmsh_section(numbers, read);
}

TetMesh read_gmsh_2(GmshNumbers&);
TetMesh read_gmsh_4(GmshNumbers&);

}  // namespace lagomorph::sim::io
