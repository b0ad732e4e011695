#pragma once

#include <span>
#include <string>
#include <vector>

#include "sim/io/file.h"
#include "sim/mesh_io.h"
#include "sim/tet_mesh.h"

/// The formats, one file each; sim/mesh_io.cpp has the tables of them. Readers check syntax, counts and index
/// ranges, so that errors can name the place; check_tet_mesh and check_tri_mesh see to the rest. Tet readers
/// leave `bodies` empty.
namespace lagomorph::sim::io {

/// What read_tet_mesh and read_tri_mesh do with a file once its bytes are there.
TetMesh parse_tet_mesh(const File&, Remarks&, const MeshChecks& = {});
TriMesh parse_tri_mesh(const File&, Remarks&);

/// Adds a tet of 4 or 10 nodes, midside nodes in the order of kTetEdges.
void add_tet(TetMesh&, std::span<const int> nodes, int tag);
/// The 4 or 10 nodes of a tet.
std::vector<int> nodes_of(const TetMesh&, std::size_t tet);

TetMesh read_medit(const File&, Remarks&);
TetMesh read_gmsh(const File&, Remarks&);
TetMesh read_tetgen_node(const File&, Remarks&);  // both read the other file of the pair too
TetMesh read_tetgen_ele(const File&, Remarks&);
TetMesh read_vtk(const File&, Remarks&);
TetMesh read_vtu(const File&, Remarks&);

TriMesh read_obj(const File&, Remarks&);
TriMesh read_off(const File&, Remarks&);
TriMesh read_ply(const File&, Remarks&);
TriMesh read_stl(const File&, Remarks&);

std::string write_medit(const TetMesh&);
std::string write_gmsh(const TetMesh&);  // 2.2 ASCII
std::string write_tetgen_node(const TetMesh&);
std::string write_tetgen_ele(const TetMesh&);
std::string write_vtk(const TetMesh&);  // ASCII
std::string write_vtu(const TetMesh&);

std::string write_obj(const TriMesh&);
std::string write_off(const TriMesh&);
std::string write_ply(const TriMesh&);  // binary
std::string write_stl(const TriMesh&);  // ASCII

}  // namespace lagomorph::sim::io
