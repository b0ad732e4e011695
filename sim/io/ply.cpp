// PLY, ASCII and binary of either byte order. (Turk, "The PLY polygon file format", 1994)
#include <algorithm>
#include <array>
#include <optional>

#include "sim/io/binary_writer.h"
#include "sim/io/field_writers.h"
#include "sim/io/formats.h"
#include "sim/io/number_type.h"
#include "sim/io/polygon.h"
#include "sim/io/scanner.h"

namespace lagomorph::sim::io {
namespace {

struct PlyType {
  std::string_view name;
  NumberType type;
};

constexpr std::array<PlyType, 16> kPlyTypes = {{{"char", NumberType::kInt8},
                                                {"int8", NumberType::kInt8},
                                                {"uchar", NumberType::kUInt8},
                                                {"uint8", NumberType::kUInt8},
                                                {"short", NumberType::kInt16},
                                                {"int16", NumberType::kInt16},
                                                {"ushort", NumberType::kUInt16},
                                                {"uint16", NumberType::kUInt16},
                                                {"int", NumberType::kInt32},
                                                {"int32", NumberType::kInt32},
                                                {"uint", NumberType::kUInt32},
                                                {"uint32", NumberType::kUInt32},
                                                {"float", NumberType::kFloat32},
                                                {"float32", NumberType::kFloat32},
                                                {"double", NumberType::kFloat64},
                                                {"float64", NumberType::kFloat64}}};

struct Property {
  std::string name;
  NumberType type;
  std::optional<NumberType> count;  // of a list
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;

  /// Index of a property, of lists when `list`.
  std::optional<std::size_t> find(std::string_view property, bool list) const {
    for (std::size_t i = 0; i < properties.size(); ++i) {
      if (properties[i].name == property && properties[i].count.has_value() == list) return i;
    }
    return std::nullopt;
  }
};

NumberType read_type(Scanner& scanner) {
  const std::string_view name = scanner.token("a property's type");
  const auto* found =
      std::find_if(kPlyTypes.begin(), kPlyTypes.end(), [&](const PlyType& t) { return t.name == name; });
  if (found == kPlyTypes.end()) {
    scanner.fail("property type " + in_quotes(name) +
                 "; char, uchar, short, ushort, int, uint, float and double are known");
  }
  return found->type;
}

class PlyReader {
public:
  explicit PlyReader(const File& file) : scanner_(file) {}

  TriMesh read() {
    read_header();
    for (const Element& element : elements_) {
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else {
        const std::size_t count = checked_count(element);
        for (std::size_t i = 0; i < count; ++i) {
          for (const Property& property : element.properties) skip(property);
        }
      }
    }
    if (!binary_ ? !scanner_.at_end() : scanner_.left() > 0) {
      const std::size_t left = scanner_.left();
      scanner_.seek(scanner_.position());
      scanner_.fail(std::to_string(left) +
                    " bytes follow the last element; are the counts of the header right?");
    }
    return std::move(mesh_);
  }

private:
  void read_header() {
    scanner_.expect("ply");
    while (scanner_.peek() == "comment" || scanner_.peek() == "obj_info") scanner_.skip_line();
    scanner_.expect("format");
    const std::string_view format = scanner_.token("the format");
    binary_ = format != "ascii";
    if (binary_ && format != "binary_little_endian" && format != "binary_big_endian") {
      scanner_.fail("the format is " + in_quotes(format) +
                    "; ascii, binary_little_endian and binary_big_endian are known");
    }
    const bool swap = format == "binary_big_endian";
    scanner_.expect("1.0");
    for (;;) {
      const std::string_view word = scanner_.token("a line of the header");
      if (word == "end_header") break;
      if (word == "comment" || word == "obj_info") {
        scanner_.skip_line();
      } else if (word == "element") {
        Element element;
        element.name = scanner_.token("an element's name");
        element.count = scanner_.integer("the number of elements");
        elements_.push_back(std::move(element));
      } else if (word == "property") {
        if (elements_.empty()) scanner_.fail("a property before the first element");
        Property property;
        if (scanner_.peek() == "list") {
          scanner_.token("list");
          property.count = read_type(scanner_);
          if (!is_integer(*property.count)) {
            scanner_.fail("the length of a list is no integer; it must be one");
          }
        }
        property.type = read_type(scanner_);
        property.name = scanner_.token("a property's name");
        elements_.back().properties.push_back(std::move(property));
      } else {
        scanner_.fail("expected element, property, comment or end_header, found " + in_quotes(word));
      }
    }
    scanner_.skip_line();
    require_elements();
    if (binary_) scanner_.set_binary(swap);
  }

  /// Vertices with positions must come first, then faces with their corners.
  void require_elements() {
    const auto find = [&](std::string_view name) {
      return std::find_if(elements_.begin(), elements_.end(),
                          [&](const Element& e) { return e.name == name; });
    };
    const auto vertex = find("vertex"), face = find("face");
    if (vertex == elements_.end()) scanner_.fail("no element 'vertex'");
    if (face == elements_.end()) scanner_.fail("no element 'face'; a surface is needed, not points");
    if (face < vertex) scanner_.fail("element 'face' before element 'vertex'");
    for (const char* axis : {"x", "y", "z"}) {
      if (!vertex->find(axis, false))
        scanner_.fail("element 'vertex' has no property '" + std::string(axis) + "'");
    }
    const std::optional<std::size_t> corners = corners_of(*face);
    if (!corners || !is_integer(face->properties[*corners].type)) {
      scanner_.fail("element 'face' has no list 'vertex_indices' of integers");
    }
  }

  static std::optional<std::size_t> corners_of(const Element& face) {
    const auto indices = face.find("vertex_indices", true);
    return indices ? indices : face.find("vertex_index", true);
  }

  std::size_t checked_count(const Element& element) {
    std::size_t size = 0;  // of one, at least
    for (const Property& p : element.properties) size += !binary_ ? 2 : size_of(p.count.value_or(p.type));
    return size == 0 ? 0
                     : scanner_.check_count(element.count, ("elements '" + element.name + "'").c_str(), size);
  }

  double number(NumberType type, const char* what) {
    return binary_ ? binary_number(scanner_, type, what) : scanner_.number(what);
  }

  std::int64_t integer(NumberType type, const char* what) {
    return binary_ ? binary_integer(scanner_, type, what) : scanner_.integer(what);
  }

  std::size_t length(const Property& list) {
    return scanner_.check_count(integer(*list.count, "the length of a list"), "entries of a list",
                                binary_ ? size_of(list.type) : 2);
  }

  void skip(const Property& property) {
    const std::size_t n = property.count ? length(property) : 1;
    if (binary_) {
      scanner_.skip(n * size_of(property.type), "a property");
    } else {
      for (std::size_t i = 0; i < n; ++i) scanner_.token("a property");
    }
  }

  void read_vertices(const Element& element) {
    if (mesh_.X.rows() > 0) scanner_.fail("a second element 'vertex'");
    mesh_.X.resize(static_cast<Eigen::Index>(checked_count(element)), 3);
    std::array<std::size_t, 3> axes{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      axes[axis] = *element.find(std::string_view("xyz").substr(axis, 1), false);
    for (Eigen::Index i = 0; i < mesh_.X.rows(); ++i) {
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const auto axis = std::find(axes.begin(), axes.end(), p);
        if (axis == axes.end()) {
          skip(element.properties[p]);
        } else {
          mesh_.X(i, axis - axes.begin()) = number(element.properties[p].type, "a vertex coordinate");
        }
      }
    }
  }

  void read_faces(const Element& element) {
    const std::size_t count = checked_count(element), list = *corners_of(element);
    const Eigen::Map<const Points> X(mesh_.X.data(), mesh_.X.rows(), 3);
    std::vector<int> corners;
    for (std::size_t f = 0; f < count; ++f) {
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const Property& property = element.properties[p];
        if (p != list) {
          skip(property);
          continue;
        }
        corners.resize(length(property));
        for (int& corner : corners) {
          corner = scanner_.check_index(integer(property.type, "a face's vertex"), "a face's vertex", 0,
                                        static_cast<std::size_t>(X.rows()));
        }
        triangulate_polygon(corners, X, mesh_.triangles, scanner_);
      }
    }
  }

  Scanner scanner_;
  bool binary_ = false;
  std::vector<Element> elements_;
  TriMesh mesh_;
};

}  // namespace

TriMesh read_ply(const File& file, Remarks&) { return PlyReader(file).read(); }

std::string write_ply(const TriMesh& mesh) { return write_ply(mesh, {}); }

std::string write_ply(const TriMesh& mesh, const std::vector<Field>& fields) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(mesh.X.rows()) +
                      "\nproperty double x\nproperty double y\nproperty double z\n";
  for (const Field& field : fields) bytes += "property double " + std::string(field.info.name) + "\n";
  bytes += "element face " + std::to_string(mesh.triangles.size()) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
  for (Eigen::Index i = 0; i < mesh.X.rows(); ++i) {
    for (int axis = 0; axis < 3; ++axis) append_bytes(bytes, mesh.X(i, axis));
    for (const Field& field : fields) append_bytes(bytes, field.vertices[static_cast<std::size_t>(i)]);
  }
  for (const Triangle& triangle : mesh.triangles) {
    append_bytes(bytes, std::uint8_t{3});
    for (const int corner : triangle) append_bytes(bytes, std::int32_t{corner});
  }
  return bytes;
}

}  // namespace lagomorph::sim::io
