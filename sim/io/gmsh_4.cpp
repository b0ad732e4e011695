// Gmsh .msh 4.1, ASCII and binary. ("Gmsh 4 reference manual", "MSH file format")
#include <algorithm>
#include <cstdlib>
#include <map>

#include "sim/io/formats.h"
#include "sim/io/gmsh.h"

namespace lagomorph::sim::io {
namespace {

class Gmsh4Reader {
public:
  explicit Gmsh4Reader(GmshNumbers& numbers) : numbers_(numbers), scanner_(numbers.scanner()) {}

  /// The entities' physical tags; those of volumes are kept. Partitioned ones say more of their parents.
  void read_entities(bool partitioned) {
    if (partitioned) {
      numbers_.size("the number of partitions");
      const std::size_t ghosts = numbers_.count("ghost entities", 4, 8);
      for (std::size_t i = 0; i < 2 * ghosts; ++i) numbers_.integer("a ghost entity");
    }
    std::size_t counts[4];
    for (std::size_t& count : counts) count = numbers_.count("entities", 2, 8);
    for (int dimension = 0; dimension < 4; ++dimension) {
      for (std::size_t i = 0; i < counts[dimension]; ++i) read_entity(dimension, partitioned);
    }
  }

  void read_nodes() {
    const std::size_t blocks = numbers_.count("node blocks", 8, 20);
    const std::size_t count = numbers_.count("nodes", 7, 32);
    numbers_.size("the smallest node tag");
    numbers_.size("the largest node tag");
    mesh_.X.resize(static_cast<Eigen::Index>(count), 3);
    std::vector<std::int64_t> tags;
    tags.reserve(count);
    for (std::size_t block = 0; block < blocks; ++block) {
      const std::int64_t dimension = entity_dimension();
      numbers_.integer("an entity's tag");
      const bool parametric = numbers_.integer("whether nodes are parametric") != 0;
      const std::size_t size = numbers_.count("nodes in a block", 7, 32);
      const std::size_t done = tags.size();
      if (size > count - done) {
        scanner_.fail("a block of " + std::to_string(size) + " nodes where " + std::to_string(count - done) +
                      " are left");
      }
      for (std::size_t i = 0; i < size; ++i) tags.push_back(numbers_.size("a node's tag"));
      for (std::size_t i = done; i < tags.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis)
          mesh_.X(static_cast<Eigen::Index>(i), axis) = numbers_.number("a node's coordinate");
        for (std::int64_t k = 0; parametric && k < dimension; ++k) numbers_.number("a node's parameter");
      }
    }
    if (tags.size() != count) {
      scanner_.fail("$Nodes says " + std::to_string(count) + " nodes, its blocks have " +
                    std::to_string(tags.size()));
    }
    nodes_.assign(tags, scanner_);
  }

  void read_elements() {
    const std::size_t blocks = numbers_.count("element blocks", 8, 20);
    const std::size_t count = numbers_.count("elements", 4, 16);
    numbers_.size("the smallest element tag");
    numbers_.size("the largest element tag");
    std::size_t done = 0;
    for (std::size_t block = 0; block < blocks; ++block) {
      const std::int64_t dimension = entity_dimension();
      const std::int64_t entity = numbers_.integer("an entity's tag");
      const std::int64_t type = numbers_.integer("an element type");
      const auto nodes = static_cast<std::size_t>(gmsh_node_count(type, scanner_));
      const std::size_t size = numbers_.count("elements in a block", 2 * (1 + nodes), 8 * (1 + nodes));
      if (size > count - done) {
        scanner_.fail("a block of " + std::to_string(size) + " elements where " +
                      std::to_string(count - done) + " are left");
      }
      done += size;
      if (!is_gmsh_tetrahedron(type)) {
        for (std::size_t i = 0; i < size * (1 + nodes); ++i) numbers_.size("an element's tag or node");
        continue;
      }
      const auto physical = dimension == 3 ? physical_of_volume_.find(entity) : physical_of_volume_.end();
      const int tag = physical == physical_of_volume_.end() ? 0 : physical->second;
      std::vector<int> tet(nodes);
      for (std::size_t i = 0; i < size; ++i) {
        numbers_.size("an element's tag");
        for (int& node : tet) node = nodes_.vertex(numbers_.size("a tetrahedron's node"), scanner_);
        add_tet(mesh_, tet, tag);
      }
    }
    if (done != count) {
      scanner_.fail("$Elements says " + std::to_string(count) + " elements, its blocks have " +
                    std::to_string(done));
    }
  }

  bool has_nodes = false;
  bool has_elements = false;
  TetMesh take() { return std::move(mesh_); }

private:
  std::int64_t entity_dimension() {
    const std::int64_t dimension = numbers_.integer("an entity's dimension");
    if (dimension < 0 || dimension > 3)
      scanner_.fail("an entity's dimension is " + std::to_string(dimension) + "; it must be in 0..3");
    return dimension;
  }

  void read_entity(int dimension, bool partitioned) {
    const std::int64_t tag = numbers_.integer("an entity's tag");
    if (partitioned) {
      numbers_.integer("the parent's dimension");
      numbers_.integer("the parent's tag");
      const std::size_t partitions = numbers_.count("partitions of an entity", 2, 4);
      for (std::size_t i = 0; i < partitions; ++i) numbers_.integer("a partition");
    }
    // A point's position, or the bounding box.
    for (int i = 0; i < (dimension == 0 ? 3 : 6); ++i) numbers_.number("an entity's extent");
    const std::size_t physicals = numbers_.count("physical tags", 2, 4);
    for (std::size_t i = 0; i < physicals; ++i) {
      const int physical = scanner_.check_tag(numbers_.integer("a physical tag"));
      // The sign tells an orientation, which a volume does not have. An entity of several groups goes by the
      // first.
      if (dimension == 3) physical_of_volume_.emplace(tag, physical < 0 ? -physical : physical);
    }
    if (dimension == 0) return;
    const std::size_t bounding = numbers_.count("bounding entities", 2, 4);
    for (std::size_t i = 0; i < bounding; ++i) numbers_.integer("a bounding entity");
  }

  GmshNumbers& numbers_;
  Scanner& scanner_;
  TetMesh mesh_;
  GmshNodes nodes_;
  std::map<std::int64_t, int> physical_of_volume_;
};

}  // namespace

TetMesh read_gmsh_4(GmshNumbers& numbers) {
  Gmsh4Reader reader(numbers);
  Scanner& scanner = numbers.scanner();
  for_each_gmsh_section(numbers, [&](const std::string& name) {
    if (name == "$Entities" || name == "$PartitionedEntities") {
      reader.read_entities(name == "$PartitionedEntities");
    } else if (name == "$Nodes") {
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

}  // namespace lagomorph::sim::io
