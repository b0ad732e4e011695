#include "sim/mesh_io.h"

#include <algorithm>
#include <array>

#include "sim/error.h"
#include "sim/io/formats.h"
#include "sim/mesh_check.h"

namespace lagomorph::sim {
namespace {

struct TetFormat {
  std::string_view extension;
  TetMesh (*read)(const io::File&, Remarks&);
  std::string (*write)(const TetMesh&);
  std::string_view partner;  // the other file of a pair
  bool quadratic = true;     // whether 10-node tetrahedra are written
};

struct TriFormat {
  std::string_view extension;
  TriMesh (*read)(const io::File&, Remarks&);
  std::string (*write)(const TriMesh&);
};

constexpr std::array kTetFormats = {
    TetFormat{".mesh", io::read_medit, io::write_medit, "", false},
    TetFormat{".msh", io::read_gmsh, io::write_gmsh, ""},
    TetFormat{".node", io::read_tetgen_node, io::write_tetgen_node, ".ele"},
    TetFormat{".ele", io::read_tetgen_ele, io::write_tetgen_ele, ".node"},
    TetFormat{".vtk", io::read_vtk, io::write_vtk, ""},
    TetFormat{".vtu", io::read_vtu, io::write_vtu, ""},
};

constexpr std::array kTriFormats = {
    TriFormat{".obj", io::read_obj, io::write_obj},
    TriFormat{".off", io::read_off, io::write_off},
    TriFormat{".ply", io::read_ply, io::write_ply},
    TriFormat{".stl", io::read_stl, io::write_stl},
};

template <typename Table>
std::vector<std::string> extensions_of(const Table& table) {
  std::vector<std::string> extensions;
  extensions.reserve(table.size());
  for (const auto& format : table) extensions.emplace_back(format.extension);
  return extensions;
}

/// The row of an extension, in either case. `origin` and `kind` are for the error.
template <typename Table>
const auto& find_format(const Table& table, std::string_view extension, const std::string& origin,
                        const std::string& kind) {
  std::string lower(extension);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  for (const auto& format : table) {
    if (format.extension == lower) return format;
  }
  std::string valid;
  for (const auto& format : table) valid += (valid.empty() ? "" : ", ") + std::string(format.extension);
  throw InputError(origin + ": unknown extension '" + std::string(extension) + "' for " + kind +
                   "; valid are " + valid);
}

}  // namespace

void io::add_tet(TetMesh& mesh, std::span<const int> nodes, int tag) {
  if (nodes.size() == 10 || !mesh.midsides.empty()) mesh.midsides.resize(mesh.tets.size() + 1, kNoMidsides);
  if (nodes.size() == 10) std::copy(nodes.begin() + 4, nodes.end(), mesh.midsides.back().begin());
  mesh.tets.push_back({nodes[0], nodes[1], nodes[2], nodes[3]});
  mesh.tags.push_back(tag);
}

std::vector<int> io::nodes_of(const TetMesh& mesh, std::size_t tet) {
  std::vector<int> nodes(mesh.tets[tet].begin(), mesh.tets[tet].end());
  if (mesh.is_quadratic(tet)) nodes.insert(nodes.end(), mesh.midsides[tet].begin(), mesh.midsides[tet].end());
  return nodes;
}

TetMesh io::parse_tet_mesh(const File& file, Remarks& remarks, const MeshChecks& checks) {
  const std::filesystem::path path = file.path;
  TetMesh mesh = find_format(kTetFormats, path.extension().string(), file.path, "a tetrahedral mesh")
                     .read(file, remarks);
  mesh.bodies = {Body{path.stem().string(), {0, mesh.vertex_count()}, {0, mesh.tet_count()}}};
  check_tet_mesh(mesh, file.path, remarks, checks);
  return mesh;
}

TriMesh io::parse_tri_mesh(const File& file, Remarks& remarks) {
  const std::string extension = std::filesystem::path(file.path).extension().string();
  TriMesh mesh = find_format(kTriFormats, extension, file.path, "a surface").read(file, remarks);
  const int welded = weld(mesh);
  if (welded > 0) {
    remarks.push_back(file.path + ": welded " + std::to_string(welded) +
                      (welded == 1 ? " vertex" : " vertices") + " with others at the same place");
  }
  check_tri_mesh(mesh, file.path, remarks);
  return mesh;
}

TetMesh read_tet_mesh(const std::filesystem::path& path, Remarks& remarks, const MeshChecks& checks) {
  find_format(kTetFormats, path.extension().string(), path.string(),
              "a tetrahedral mesh");  // before it is looked for
  return io::parse_tet_mesh(io::read_file(path), remarks, checks);
}

TriMesh read_tri_mesh(const std::filesystem::path& path, Remarks& remarks) {
  find_format(kTriFormats, path.extension().string(), path.string(), "a surface");
  return io::parse_tri_mesh(io::read_file(path), remarks);
}

std::string write_tet_mesh(const TetMesh& mesh, std::string_view extension, const MeshChecks& checks) {
  const std::string origin = "tetrahedral mesh to write as " + std::string(extension);
  const TetFormat& format = find_format(kTetFormats, extension, origin, "a tetrahedral mesh");
  TetMesh checked = mesh;
  Remarks remarks;
  check_tet_mesh(checked, origin, remarks, checks);
  if (!mesh.midsides.empty() && !format.quadratic) {
    throw InputError(origin +
                     ": it has 10-node tetrahedra, which are written as .msh, .node, .ele, .vtk or .vtu");
  }
  return format.write(checked);
}

std::string write_tri_mesh(const TriMesh& mesh, std::string_view extension) {
  const std::string origin = "surface to write as " + std::string(extension);
  const TriFormat& format = find_format(kTriFormats, extension, origin, "a surface");
  validate_tri_mesh(mesh, origin);
  return format.write(mesh);
}

std::vector<std::string> tet_mesh_parts(std::string_view extension) {
  const TetFormat& format = find_format(kTetFormats, extension, "mesh to write", "a tetrahedral mesh");
  std::vector<std::string> parts{std::string(format.extension)};
  if (!format.partner.empty()) parts.emplace_back(format.partner);
  return parts;
}

std::vector<std::string> tet_mesh_extensions() { return extensions_of(kTetFormats); }
std::vector<std::string> tri_mesh_extensions() { return extensions_of(kTriFormats); }

}  // namespace lagomorph::sim
