#pragma once

#include <string>

#include "sim/io/file.h"
#include "sim/mesh_io.h"
#include "sim/tet_mesh.h"

/// The formats, one file each; sim/mesh_io.cpp has the tables of them. Readers check syntax, counts and index
/// ranges, so that errors can name the place; check_tet_mesh and check_tri_mesh see to the rest. Tet readers
/// leave `bodies` empty.
namespace lagomorph::sim::io {

TetMesh read_medit(const File&, Remarks&);
TetMesh read_gmsh(const File&, Remarks&);

TriMesh read_obj(const File&, Remarks&);

std::string write_medit(const TetMesh&);
std::string write_gmsh(const TetMesh&);

std::string write_obj(const TriMesh&);

}  // namespace lagomorph::sim::io
