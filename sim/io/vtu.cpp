// VTK's XML file of an unstructured grid. (docs.vtk.org, "VTK XML Formats")
#include "sim/io/base64.h"
#include "sim/io/binary_writer.h"
#include "sim/io/field_writers.h"
#include "sim/io/formats.h"
#include "sim/io/scanner.h"
#include "sim/io/text_writer.h"
#include "sim/io/vtk_cells.h"
#include "sim/io/vtu_arrays.h"

namespace lagomorph::sim::io {
namespace {

pugi::xml_node child_of(VtuArrays& arrays, pugi::xml_node node, const char* name) {
  const pugi::xml_node child = node.child(name);
  if (!child) arrays.fail(node, "no element " + std::string(name) + " in " + node.name());
  return child;
}

pugi::xml_node array_of(VtuArrays& arrays, pugi::xml_node node, const char* name) {
  const pugi::xml_node array = node.find_child_by_attribute("DataArray", "Name", name);
  if (!array) arrays.fail(node, "no DataArray '" + std::string(name) + "' in " + node.name());
  return array;
}

TetMesh read_piece(VtuArrays& arrays, pugi::xml_node piece) {
  const std::uint64_t point_count = arrays.count(piece, "NumberOfPoints");
  const std::uint64_t cell_count = arrays.count(piece, "NumberOfCells");
  VtkCells cells;
  if (point_count > 0) {
    const pugi::xml_node points = child_of(arrays, child_of(arrays, piece, "Points"), "DataArray");
    if (std::string_view(points.attribute("NumberOfComponents").value()) != "3") {
      arrays.fail(points, "the points must have NumberOfComponents=\"3\"");
    }
    cells.points = arrays.numbers(points, 3 * point_count);
  }
  if (cell_count > 0) {
    const pugi::xml_node node = child_of(arrays, piece, "Cells");
    cells.types = arrays.integers(array_of(arrays, node, "types"), cell_count);
    const pugi::xml_node ends = array_of(arrays, node, "offsets");
    cells.ends = arrays.integers(ends, cell_count);
    const std::int64_t size = cells.ends.back();
    if (size < 0 || size > 1'000'000'000'000)
      arrays.fail(ends, "the last offset is " + std::to_string(size) + ", out of range");
    cells.connectivity =
        arrays.integers(array_of(arrays, node, "connectivity"), static_cast<std::uint64_t>(size));
  }
  for (const pugi::xml_node array : piece.child("CellData").children("DataArray")) {
    const std::string_view components = array.attribute("NumberOfComponents").value();
    const bool scalar = components.empty() || components == "1";
    if (!scalar || !is_tag_array(array.attribute("Name").value())) continue;
    cells.tags = arrays.integers(array, cell_count);
    break;
  }
  return tets_of(cells, [&](const std::string& message) { arrays.fail(piece, message); });
}

/// A DataArray of base64: the size in bytes, then the values.
template <typename Value>
void write_array(TextWriter& out, std::string_view attributes, const std::vector<Value>& values) {
  std::string bytes;
  bytes.reserve(8 + values.size() * sizeof(Value));
  append_bytes(bytes, static_cast<std::uint64_t>(values.size() * sizeof(Value)));
  for (const Value& value : values) append_bytes(bytes, value);
  out << "<DataArray " << attributes << " format=\"binary\">" << base64_encode(bytes) << "</DataArray>\n";
}

std::string array_name(const Field& field) {
  return "type=\"Float64\" Name=\"" + std::string(field.info.name) + "\"";
}

}  // namespace

TetMesh read_vtu(const File& file, Remarks&) {
  VtuArrays arrays(file);
  const std::string_view type = arrays.root().attribute("type").value();
  if (type != "UnstructuredGrid")
    arrays.fail(arrays.root(), "the type is " + in_quotes(type) + "; it must be UnstructuredGrid");
  TetMesh mesh;
  for (const pugi::xml_node piece : child_of(arrays, arrays.root(), "UnstructuredGrid").children("Piece")) {
    TetMesh part = read_piece(arrays, piece);
    const auto first = mesh.X.rows();
    mesh.X.conservativeResize(first + part.X.rows(), 3);
    mesh.X.bottomRows(part.X.rows()) = part.X;
    for (std::size_t j = 0; j < part.tets.size(); ++j) {
      std::vector<int> nodes = nodes_of(part, j);
      for (int& node : nodes) node += static_cast<int>(first);
      add_tet(mesh, nodes, part.tags[j]);
    }
  }
  return mesh;
}

std::string write_vtu(const TetMesh& mesh) { return write_vtu(mesh, {}); }

std::string write_vtu(const TetMesh& mesh, const std::vector<Field>& fields,
                      const std::vector<PointVectors>& vectors, const std::vector<PointFlags>& flags) {
  TextWriter out;
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
         "byte_order=\"LittleEndian\" "
         "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\""
      << mesh.X.rows() << "\" NumberOfCells=\"" << mesh.tets.size() << "\">\n<Points>\n";
  write_array(out, "type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"",
              std::vector<double>(mesh.X.data(), mesh.X.data() + mesh.X.size()));
  out << "</Points>\n<Cells>\n";
  std::vector<std::int32_t> connectivity;
  std::vector<std::int64_t> ends;
  std::vector<std::uint8_t> types;
  for (std::size_t j = 0; j < mesh.tets.size(); ++j) {
    const std::vector<int> points = vtk_points(mesh, j);
    connectivity.insert(connectivity.end(), points.begin(), points.end());
    ends.push_back(static_cast<std::int64_t>(connectivity.size()));
    types.push_back(static_cast<std::uint8_t>(vtk_type(mesh, j)));
  }
  write_array(out, "type=\"Int32\" Name=\"connectivity\"", connectivity);
  write_array(out, "type=\"Int64\" Name=\"offsets\"", ends);
  write_array(out, "type=\"UInt8\" Name=\"types\"", types);
  out << "</Cells>\n<CellData Scalars=\"tag\">\n";
  write_array(out, "type=\"Int32\" Name=\"tag\"",
              std::vector<std::int32_t>(mesh.tags.begin(), mesh.tags.end()));
  for (const Field& field : fields) write_array(out, array_name(field), field.elements);
  out << "</CellData>\n";
  if (!fields.empty() || !vectors.empty() || !flags.empty()) {
    out << "<PointData";
    if (!fields.empty()) out << " Scalars=\"" << fields.front().info.name << "\"";
    if (!vectors.empty()) out << " Vectors=\"" << vectors.front().name << "\"";
    out << ">\n";
    for (const Field& field : fields) write_array(out, array_name(field), field.vertices);
    for (const PointVectors& v : vectors)
      write_array(out, "type=\"Float64\" Name=\"" + std::string(v.name) + "\" NumberOfComponents=\"3\"",
                  std::vector<double>(v.values.begin(), v.values.end()));
    for (const PointFlags& f : flags)
      write_array(out, "type=\"UInt8\" Name=\"" + std::string(f.name) + "\"", f.values);
    out << "</PointData>\n";
  }
  out << "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  return out.take();
}

}  // namespace lagomorph::sim::io
