#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sim/tet_mesh.h"

namespace lagomorph::sim {

/// What a reader or a check noticed that is no error: "turned 1243 tets ...", "12 coincident vertices ...".
/// One line each.
using Remarks = std::vector<std::string>;

/// What check_tet_mesh insists on beyond counts, index ranges and finite numbers.
struct MeshChecks {
  bool orientation = true;  // false: inverted, flat and overlapping tets pass, as in a deformed mesh
  bool strays = true;       // false: stray vertices are remarked, no error; for drop_stray_vertices
};

/// Reads a tet mesh by its extension: .mesh, .msh (2.2 and 4.1, ASCII and binary), .node/.ele, .vtk, .vtu.
/// The result is checked (check_tet_mesh) and has one body named after the file. Throws InputError with file,
/// place, value and remedy.
TetMesh read_tet_mesh(const std::filesystem::path&, Remarks&, const MeshChecks& = {});
/// Reads a surface by its extension: .obj, .off, .ply, .stl. Coincident vertices are welded. Checked. Throws
/// InputError.
TriMesh read_tri_mesh(const std::filesystem::path&, Remarks&);

/// Text or bytes of a mesh in the format of an extension (".msh", ".mesh", ".node", ..., ".obj", ...):
/// doubles exactly, in text by 17 digits; a tag per tet. The mesh is checked as on reading; throws
/// InputError. ".node" and ".ele" give one file of their pair.
std::string write_tet_mesh(const TetMesh&, std::string_view extension, const MeshChecks& = {});
std::string write_tri_mesh(const TriMesh&, std::string_view extension);

/// The extensions of all files that a mesh in this format is made of: {".node", ".ele"} for either of these,
/// else just itself.
std::vector<std::string> tet_mesh_parts(std::string_view extension);

std::vector<std::string> tet_mesh_extensions();
std::vector<std::string> tri_mesh_extensions();

}  // namespace lagomorph::sim
