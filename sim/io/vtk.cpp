// Legacy VTK, ASCII and binary, versions 1 to 5.1. (docs.vtk.org, "VTK File Formats", "Simple Legacy
// Formats"; "VTK Legacy VtkReader/Writer Information Format"; the cells of 5.1 are those of vtkCellArray:
// offsets and connectivity)
#include <algorithm>
#include <array>
#include <optional>

#include "sim/io/formats.h"
#include "sim/io/number_type.h"
#include "sim/io/scanner.h"
#include "sim/io/text_writer.h"
#include "sim/io/vtk_cells.h"

namespace lagomorph::sim::io {
namespace {

struct VtkType {
  std::string_view name;
  NumberType type;
};

constexpr std::array kVtkTypes = {
    VtkType{"char", NumberType::kInt8},
    VtkType{"signed_char", NumberType::kInt8},
    VtkType{"unsigned_char", NumberType::kUInt8},
    VtkType{"short", NumberType::kInt16},
    VtkType{"unsigned_short", NumberType::kUInt16},
    VtkType{"int", NumberType::kInt32},
    VtkType{"unsigned_int", NumberType::kUInt32},
    VtkType{"long", NumberType::kInt64},
    VtkType{"unsigned_long", NumberType::kUInt64},
    VtkType{"float", NumberType::kFloat32},
    VtkType{"double", NumberType::kFloat64},
    VtkType{"vtktypeint64", NumberType::kInt64},
    VtkType{"vtktypeuint64", NumberType::kUInt64},
    VtkType{"vtktypeint32", NumberType::kInt32},
    // Written with 32 bits whatever the ids of the program have.
    VtkType{"vtkidtype", NumberType::kInt32},
};

/// Attributes of a name and a type that follow POINT_DATA or CELL_DATA: how many numbers an item.
struct Attribute {
  std::string_view keyword;
  std::size_t components;
};
constexpr std::array kAttributes = {Attribute{"vectors", 3},    Attribute{"normals", 3},
                                    Attribute{"tensors", 9},    Attribute{"tensors6", 6},
                                    Attribute{"global_ids", 1}, Attribute{"pedigree_ids", 1},
                                    Attribute{"edge_flags", 1}};

std::string lower(std::string_view word) {
  std::string result(word);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return result;
}

class VtkReader {
public:
  explicit VtkReader(const File& file) : scanner_(file) {}

  TetMesh read() {
    read_header();
    while (!scanner_.at_end()) read_section(lower(scanner_.token("a keyword")));
    if (!has_points_) scanner_.fail("no POINTS");
    if (!has_cells_) scanner_.fail("no CELLS");
    if (!has_types_) scanner_.fail("no CELL_TYPES");
    return tets_of(cells_, [&](const std::string& message) { scanner_.fail(message); });
  }

private:
  void read_header() {
    if (!scanner_.rest_of_line().starts_with("# vtk DataFile Version")) {
      scanner_.fail("the first line must begin with '# vtk DataFile Version'");
    }
    scanner_.skip_line();  // the title
    const std::string format = lower(scanner_.token("ASCII or BINARY"));
    if (format != "ascii" && format != "binary")
      scanner_.fail("expected ASCII or BINARY, found " + in_quotes(format));
    binary_ = format == "binary";
    if (lower(scanner_.token("DATASET")) != "dataset") scanner_.fail("expected DATASET");
    const std::string_view dataset = scanner_.token("the type of the data set");
    if (lower(dataset) != "unstructured_grid") {
      scanner_.fail("the data set is " + in_quotes(dataset) +
                    "; an UNSTRUCTURED_GRID of tetrahedra is needed");
    }
    if (binary_) scanner_.set_binary(true);  // big-endian
  }

  void read_section(const std::string& keyword) {
    const auto* attribute = std::find_if(kAttributes.begin(), kAttributes.end(),
                                         [&](const Attribute& a) { return a.keyword == keyword; });
    if (keyword == "points") {
      once(has_points_, "POINTS");
      const std::int64_t count = scanner_.integer("the number of points");
      const NumberType type = number_type(scanner_.token("the type of the points"));
      begin_data();
      cells_.points.resize(check_values(count, 3, width(type), "points"));
      for (double& x : cells_.points)
        x = binary_ ? binary_number(scanner_, type, "a coordinate") : scanner_.number("a coordinate");
    } else if (keyword == "cells") {
      once(has_cells_, "CELLS");
      read_cells();
    } else if (keyword == "cell_types") {
      once(has_types_, "CELL_TYPES");
      const std::int64_t count = scanner_.integer("the number of cell types");
      begin_data();
      cells_.types = integers(count, NumberType::kInt32, "cell types");
    } else if (keyword == "cell_data" || keyword == "point_data") {
      item_count_ = scanner_.integer("the number of items");
      of_cells_ = keyword == "cell_data";
    } else if (keyword == "scalars") {
      read_scalars();
    } else if (attribute != kAttributes.end()) {
      const std::string name(scanner_.token("an array's name"));
      read_array(name, item_count_, attribute->components, scanner_.token("an array's type"));
    } else if (keyword == "texture_coordinates") {
      scanner_.token("an array's name");
      const std::int64_t dimension = scanner_.integer("the dimension of texture coordinates");
      read_array("", item_count_, checked_components(dimension), scanner_.token("an array's type"));
    } else if (keyword == "color_scalars") {
      scanner_.token("an array's name");
      read_array("", item_count_, checked_components(scanner_.integer("the number of colours")),
                 "unsigned_char");
    } else if (keyword == "lookup_table") {
      scanner_.token("a table's name");
      read_array("", scanner_.integer("the size of the table"), 4, "unsigned_char");
    } else if (keyword == "field") {
      read_field();
    } else if (keyword == "metadata") {
      scanner_.skip_line();
      while (scanner_.left() > 0 && !scanner_.rest_of_line().empty()) {
      }
    } else {
      scanner_.fail("unknown keyword " + in_quotes(keyword));
    }
  }

  void once(bool& has, const char* keyword) {
    if (has) scanner_.fail(std::string("a second section ") + keyword);
    has = true;
  }

  /// CELLS n size: the number of its points before each cell; or, from version 5 on, OFFSETS and
  /// CONNECTIVITY.
  void read_cells() {
    const std::int64_t count = scanner_.integer("the number of cells");
    const std::int64_t size = scanner_.integer("the size of the cells");
    begin_data();
    if (scanner_.bytes().substr(scanner_.position()).starts_with("OFFSETS") ||
        (!binary_ && scanner_.peek() == "OFFSETS")) {
      cells_.ends = read_indices("OFFSETS", count);
      cells_.connectivity = read_indices("CONNECTIVITY", size);
      if (!cells_.ends.empty() && cells_.ends.front() != 0) {
        scanner_.fail("the first offset is " + std::to_string(cells_.ends.front()) + "; it must be 0");
      }
      if (!cells_.ends.empty()) cells_.ends.erase(cells_.ends.begin());
      return;
    }
    const std::vector<std::int64_t> numbers = integers(size, NumberType::kInt32, "numbers in CELLS");
    cells_.connectivity.reserve(numbers.size());
    for (std::size_t at = 0; at < numbers.size();) {
      const std::int64_t points = numbers[at++];
      if (points < 0 || static_cast<std::uint64_t>(points) > numbers.size() - at) {
        scanner_.fail("cell " + std::to_string(cells_.ends.size()) + " (numbered from 0) has " +
                      std::to_string(points) + " points where " + std::to_string(numbers.size() - at) +
                      " numbers are left in CELLS");
      }
      const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(at);
      cells_.connectivity.insert(cells_.connectivity.end(), begin, begin + points);
      cells_.ends.push_back(static_cast<std::int64_t>(cells_.connectivity.size()));
      at += static_cast<std::size_t>(points);
    }
    if (static_cast<std::int64_t>(cells_.ends.size()) != count) {
      scanner_.fail("CELLS says " + std::to_string(count) + " cells, its numbers make " +
                    std::to_string(cells_.ends.size()));
    }
  }

  std::vector<std::int64_t> read_indices(const char* keyword, std::int64_t count) {
    scanner_.expect(keyword);
    const NumberType type = number_type(scanner_.token("the type of the array"));
    begin_data();
    return integers(count, type, keyword);
  }

  void read_scalars() {
    const std::string name(scanner_.token("an array's name"));
    const std::string type(scanner_.token("an array's type"));
    const std::int64_t components = scanner_.at_line_end() ? 1 : scanner_.integer("the number of components");
    // The table's name stands on a line of its own.
    const std::size_t before = scanner_.position();
    scanner_.skip_line();
    const std::string_view line = scanner_.rest_of_line();
    scanner_.seek(before);
    if (lower(line.substr(0, 12)) == "lookup_table") {
      scanner_.skip_line();
      if (!binary_) scanner_.skip_line();
    }
    read_array(name, item_count_, checked_components(components), type);
  }

  void read_field() {
    scanner_.token("the field's name");
    const std::int64_t arrays = scanner_.integer("the number of arrays");
    for (std::int64_t i = 0; i < arrays; ++i) {
      std::string name(scanner_.token("an array's name"));
      if (lower(name) == "metadata") {  // of the array before
        read_section("metadata");
        name = scanner_.token("an array's name");
      }
      const std::int64_t components = scanner_.integer("the number of components");
      const std::int64_t tuples = scanner_.integer("the number of tuples");
      read_array(name, tuples, checked_components(components), scanner_.token("an array's type"));
    }
  }

  /// The tags are kept; any other array is skipped.
  void read_array(const std::string& name, std::int64_t tuples, std::size_t components,
                  std::string_view type_name) {
    const std::string type = lower(type_name);
    begin_data();
    if (type == "string") {
      const std::size_t count = check_values(tuples, components, 1, "strings");
      if (!binary_) scanner_.skip_line();
      for (std::size_t i = 0; i < count; ++i) skip_string();
    } else if (type == "bit") {
      if (tuples < 0)
        scanner_.fail("the number of tuples is " + std::to_string(tuples) + "; it cannot be negative");
      const std::uint64_t bits = static_cast<std::uint64_t>(tuples) * components;
      if (binary_) {
        scanner_.skip(bits / 8 + (bits % 8 != 0), "an array of bits");
      } else {
        for (std::uint64_t i = 0; i < bits; ++i) scanner_.token("a bit");
      }
    } else if (of_cells_ && components == 1 && cells_.tags.empty() && is_tag_array(name)) {
      cells_.tags = integers(tuples, number_type(type), "tags");
    } else {
      const std::size_t size = width(number_type(type));
      const std::size_t count = check_values(tuples, components, size, "an array's values");
      if (binary_) {
        scanner_.skip(count * size, "an array");
      } else {
        for (std::size_t i = 0; i < count; ++i) scanner_.token("an array's value");
      }
    }
  }

  /// In ASCII a line; in binary its length first, in 1, 2, 4 or 8 bytes as the upper two bits of the first
  /// say.
  void skip_string() {
    if (!binary_) {
      if (scanner_.left() == 0) scanner_.fail("the file ends where a string should be");
      scanner_.skip_line();
      return;
    }
    const auto first = scanner_.binary<std::uint8_t>("a string's length");
    std::uint64_t length = first & 0x3f;
    const int more = first >= 0xc0 ? 0 : first >= 0x80 ? 1 : first >= 0x40 ? 3 : 7;
    for (int i = 0; i < more; ++i) length = length << 8 | scanner_.binary<std::uint8_t>("a string's length");
    scanner_.skip(length, "a string");
  }

  /// What a number takes of the file, at least.
  std::size_t width(NumberType type) const { return binary_ ? size_of(type) : 2; }

  NumberType number_type(std::string_view name) {
    const std::string wanted = lower(name);
    const auto* found =
        std::find_if(kVtkTypes.begin(), kVtkTypes.end(), [&](const VtkType& t) { return t.name == wanted; });
    if (found == kVtkTypes.end()) scanner_.fail("unknown data type " + in_quotes(name));
    return found->type;
  }

  std::size_t checked_components(std::int64_t components) {
    if (components < 0 || components > 1000000) {
      scanner_.fail("the number of components is " + std::to_string(components) +
                    "; it must be in 0..1000000");
    }
    return static_cast<std::size_t>(components);
  }

  std::size_t check_values(std::int64_t tuples, std::size_t components, std::size_t size, const char* what) {
    if (components == 0) return 0;
    return scanner_.check_count(tuples, what, components * size) * components;
  }

  std::vector<std::int64_t> integers(std::int64_t count, NumberType type, const char* what) {
    std::vector<std::int64_t> values(check_values(count, 1, width(type), what));
    for (std::int64_t& value : values)
      value = binary_ ? binary_integer(scanner_, type, what) : scanner_.integer(what);
    return values;
  }

  /// Binary data begins on the line after.
  void begin_data() {
    if (binary_) scanner_.skip_line();
  }

  Scanner scanner_;
  bool binary_ = false;
  bool has_points_ = false, has_cells_ = false, has_types_ = false;
  bool of_cells_ = false;        // whether attributes that follow are those of cells
  std::int64_t item_count_ = 0;  // of POINT_DATA or CELL_DATA
  VtkCells cells_;
};

}  // namespace

TetMesh read_vtk(const File& file, Remarks&) { return VtkReader(file).read(); }

std::string write_vtk(const TetMesh& mesh) {
  TextWriter out;
  out << "# vtk DataFile Version 3.0\ntetrahedral mesh, metres\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS ";
  out.line(mesh.X.rows(), std::string_view("double"));
  for (Eigen::Index i = 0; i < mesh.X.rows(); ++i) out.line(mesh.X(i, 0), mesh.X(i, 1), mesh.X(i, 2));
  out << "CELLS ";
  std::size_t size = 0;
  for (std::size_t j = 0; j < mesh.tets.size(); ++j) size += 1 + vtk_points(mesh, j).size();
  out.line(mesh.tets.size(), size);
  for (std::size_t j = 0; j < mesh.tets.size(); ++j) {
    const std::vector<int> points = vtk_points(mesh, j);
    out << points.size();
    for (const int point : points) out << ' ' << point;
    out << '\n';
  }
  out << "CELL_TYPES " << mesh.tets.size() << '\n';
  for (std::size_t j = 0; j < mesh.tets.size(); ++j) out.line(vtk_type(mesh, j));
  out << "CELL_DATA " << mesh.tets.size() << "\nSCALARS tag int 1\nLOOKUP_TABLE default\n";
  for (const int tag : mesh.tags) out.line(tag);
  return out.take();
}

}  // namespace lagomorph::sim::io
