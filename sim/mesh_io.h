#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "sim/tet_mesh.h"

namespace lagomorph::sim {

/// What a reader or a check noticed that is no error: "turned 1243 tets ...", "12 coincident vertices ...".
/// One line each.
using Remarks = std::vector<std::string>;

/// Reads a tet mesh by its extension: .mesh, .msh (2.2 and 4.1, ASCII and binary), .node/.ele, .vtk, .vtu.
/// The result is checked (check_tet_mesh) and has one body named after the file. Throws InputError with file,
/// place, value and remedy.
TetMesh read_tet_mesh(const std::filesystem::path&, Remarks&);
/// Reads a surface by its extension: .obj, .off, .ply, .stl. Coincident vertices are welded. Checked. Throws
/// InputError.
TriMesh read_tri_mesh(const std::filesystem::path&, Remarks&);

/// Text or bytes of a mesh in the format of an extension (".msh", ".mesh", ".node", ..., ".obj", ...), 17
/// digits, a tag per tet.
std::string write_tet_mesh(const TetMesh&, std::string_view extension);
std::string write_tri_mesh(const TriMesh&, std::string_view extension);

std::vector<std::string> tet_mesh_extensions();
std::vector<std::string> tri_mesh_extensions();

}  // namespace lagomorph::sim
