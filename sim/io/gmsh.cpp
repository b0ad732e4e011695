#include "sim/io/gmsh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <string>

#include "sim/io/formats.h"

namespace lagomorph::sim::io {
namespace {

struct ElementType {
  int type;
  int nodes;
  const char* volume;  // what it is called, when it fills space
};

constexpr std::array kElementTypes = {
    ElementType{1, 2, nullptr},
    ElementType{2, 3, nullptr},
    ElementType{3, 4, nullptr},
    ElementType{4, 4, nullptr},
    ElementType{8, 3, nullptr},
    ElementType{9, 6, nullptr},
    ElementType{10, 9, nullptr},
    ElementType{15, 1, nullptr},
    ElementType{16, 8, nullptr},
    ElementType{20, 9, nullptr},
    ElementType{21, 10, nullptr},
    ElementType{22, 12, nullptr},
    ElementType{23, 15, nullptr},
    ElementType{24, 15, nullptr},
    ElementType{25, 21, nullptr},
    ElementType{26, 4, nullptr},
    ElementType{27, 5, nullptr},
    ElementType{28, 6, nullptr},
    ElementType{36, 16, nullptr},
    ElementType{37, 25, nullptr},
    ElementType{38, 36, nullptr},
    ElementType{39, 12, nullptr},
    ElementType{40, 16, nullptr},
    ElementType{41, 20, nullptr},
    ElementType{5, 8, "8-node hexahedron"},
    ElementType{6, 6, "6-node prism"},
    ElementType{7, 5, "5-node pyramid"},
    ElementType{11, 10, nullptr},
    ElementType{12, 27, "27-node hexahedron"},
    ElementType{13, 18, "18-node prism"},
    ElementType{14, 14, "14-node pyramid"},
    ElementType{17, 20, "20-node hexahedron"},
    ElementType{18, 15, "15-node prism"},
    ElementType{19, 13, "13-node pyramid"},
    ElementType{29, 20, "20-node tetrahedron"},
    ElementType{30, 35, "35-node tetrahedron"},
    ElementType{31, 56, "56-node tetrahedron"},
    ElementType{92, 64, "64-node hexahedron"},
    ElementType{93, 125, "125-node hexahedron"},
};

/// In a binary file an integer 1 follows the header's line. Tells whether bytes must be swapped.
bool read_byte_order(Scanner& scanner) {
  scanner.set_binary(false);
  const auto one = scanner.binary<std::uint32_t>("the integer 1 that tells the byte order");
  if (one != 1 && one != 0x01000000u)
    scanner.fail("the integer that tells the byte order is " + std::to_string(one) + "; it must be 1");
  return one != 1;
}

}  // namespace

std::int64_t GmshNumbers::size(const char* what) {
  if (!binary_) return scanner_.integer(what);
  return static_cast<std::int64_t>(scanner_.binary<std::uint64_t>(what));
}

void GmshNodes::assign(const std::vector<std::int64_t>& tags, Scanner& scanner) {
  if (tags.empty()) return;
  const auto twice = [&](std::int64_t tag) {
    scanner.fail("node tag " + std::to_string(tag) + " is there twice");
  };
  const auto [low, high] = std::minmax_element(tags.begin(), tags.end());
  first_ = *low;
  const std::uint64_t span = static_cast<std::uint64_t>(*high) - static_cast<std::uint64_t>(first_);
  if (span < 8 * tags.size() + 1024) {
    dense_.assign(span + 1, -1);
    for (std::size_t i = 0; i < tags.size(); ++i) {
      int& vertex = dense_[static_cast<std::size_t>(tags[i] - first_)];
      if (vertex >= 0) twice(tags[i]);
      vertex = static_cast<int>(i);
    }
    return;
  }
  sparse_.reserve(tags.size());
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (!sparse_.emplace(tags[i], static_cast<int>(i)).second) twice(tags[i]);
  }
}

int GmshNodes::vertex(std::int64_t tag, Scanner& scanner) const {
  if (!sparse_.empty()) {
    const auto found = sparse_.find(tag);
    if (found != sparse_.end()) return found->second;
  } else if (tag >= first_ &&
             static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(first_) < dense_.size()) {
    const int vertex = dense_[static_cast<std::size_t>(tag - first_)];
    if (vertex >= 0) return vertex;
  }
  scanner.fail("a tetrahedron's node is " + std::to_string(tag) + "; there is no such node in $Nodes");
}

int gmsh_node_count(std::int64_t type, Scanner& scanner) {
  const auto* found = std::find_if(kElementTypes.begin(), kElementTypes.end(),
                                   [&](const ElementType& e) { return e.type == type; });
  if (found == kElementTypes.end()) {
    scanner.fail("element type " + std::to_string(type) +
                 " is unknown; tetrahedra of 4 nodes (type 4) or 10 (type 11) are needed");
  }
  if (found->volume != nullptr) {
    scanner.fail("element type " + std::to_string(type) + ", a " + found->volume +
                 "; only 4-node and 10-node tetrahedra can be used for volumes");
  }
  return found->nodes;
}

TetMesh read_gmsh(const File& file, Remarks&) {
  Scanner scanner(file);
  scanner.expect("$MeshFormat");
  const std::string version(scanner.token("the format's version"));
  const bool is_2 = version == "2" || version.starts_with("2.");
  if (!is_2 && version != "4.1") {
    scanner.fail("format version " + in_quotes(version) +
                 "; 2.2 and 4.1 can be read (gmsh OLD.msh -save -format msh41 -o NEW.msh)");
  }
  const std::int64_t type = scanner.integer("the file type (0 for ASCII, 1 for binary)");
  if (type != 0 && type != 1)
    scanner.fail("the file type is " + std::to_string(type) + "; it must be 0 (ASCII) or 1 (binary)");
  const std::int64_t data_size = scanner.integer("the data size");
  if (data_size != 8) scanner.fail("the data size is " + std::to_string(data_size) + "; it must be 8");
  const bool binary = type == 1;
  if (binary) {
    scanner.skip_line();
    const bool swap = read_byte_order(scanner);
    scanner.set_binary(swap);
  }
  scanner.expect("$EndMeshFormat");
  GmshNumbers numbers(scanner, binary);
  return is_2 ? read_gmsh_2(numbers) : read_gmsh_4(numbers);
}

}  // namespace lagomorph::sim::io
