#!/usr/bin/env bash
# Makes the fixtures of this folder with other programs: gmsh 4.8, VTK 9.1 (python3-vtk9) and meshio 5.0 of Debian 12.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
gmsh two_boxes.geo -3 -v 1 -format msh22 -o two_boxes_22.msh
gmsh two_boxes.geo -3 -v 1 -format msh22 -bin -o two_boxes_22_binary.msh
gmsh two_boxes.geo -3 -v 1 -format msh41 -o two_boxes_41.msh
gmsh two_boxes.geo -3 -v 1 -format msh41 -bin -o two_boxes_41_binary.msh
gmsh two_boxes.geo -3 -v 1 -format msh41 -part 2 -o two_boxes_41_partitioned.msh
gmsh two_boxes.geo -3 -v 1 -format mesh -o two_boxes.mesh
/usr/bin/python3 make_vtk.py
