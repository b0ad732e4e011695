"""Fixtures by VTK and meshio: the two boxes of two_boxes_22.msh with tags and other arrays, and a cube of quadrilaterals."""
import meshio
from vtkmodules.vtkCommonCore import vtkBitArray, vtkDoubleArray, vtkIntArray, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import VTK_TETRA, VTK_TRIANGLE, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource
from vtkmodules.vtkIOGeometry import vtkOBJWriter, vtkSTLWriter
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridWriter
from vtkmodules.vtkIOPLY import vtkPLYWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

mesh = meshio.read("two_boxes_22.msh")
grid = vtkUnstructuredGrid()
points = vtkPoints()
points.SetDataTypeToDouble()
for x in mesh.points:
    points.InsertNextPoint(x)
grid.SetPoints(points)
pressure, words, flags, tags = vtkDoubleArray(), vtkStringArray(), vtkBitArray(), vtkIntArray()
pressure.SetName("pressure drop")
pressure.SetNumberOfComponents(3)
words.SetName("words")
flags.SetName("flags")
tags.SetName("gmsh:physical")
for block, physical in zip(mesh.cells, mesh.cell_data["gmsh:physical"]):
    for cell, tag in zip(block.data, physical):
        i = grid.InsertNextCell(VTK_TETRA if block.type == "tetra" else VTK_TRIANGLE, len(cell), cell)
        pressure.InsertNextTuple3(i, 0.5, -i)
        words.InsertNextValue(f"cell {i}" + "x" * (80 if i == 3 else 0))
        flags.InsertNextValue(i % 2)
        tags.InsertNextValue(int(tag))
for array in (pressure, words, flags, tags):
    grid.GetCellData().AddArray(array)
temperature = vtkDoubleArray()
temperature.SetName("temperature")
for i in range(len(mesh.points)):
    temperature.InsertNextValue(0.1 * i)
grid.GetPointData().SetScalars(temperature)

for version in (42, 51):
    for binary in (False, True):
        writer = vtkUnstructuredGridWriter()
        writer.SetInputData(grid)
        writer.SetFileVersion(version)
        writer.SetFileType(2 if binary else 1)
        writer.SetFileName(f"two_boxes_{version}{'_binary' if binary else ''}.vtk")
        writer.Write()


def write_vtu(name, mode, zlib=False, header=32, big=False):
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetDataMode({"ascii": writer.Ascii, "binary": writer.Binary}.get(mode, writer.Appended))
    writer.SetEncodeAppendedData(mode == "base64")
    writer.SetCompressorTypeToZLib() if zlib else writer.SetCompressorTypeToNone()
    writer.SetBlockSize(1024)
    writer.SetHeaderType(header)
    writer.SetByteOrderToBigEndian() if big else writer.SetByteOrderToLittleEndian()
    writer.SetFileName(f"two_boxes_{name}.vtu")
    writer.Write()


write_vtu("ascii", "ascii")
write_vtu("binary", "binary", header=64)
write_vtu("binary_zlib", "binary", zlib=True)
write_vtu("raw_big_endian", "raw", header=64, big=True)
write_vtu("raw_zlib", "raw", zlib=True, header=64)
write_vtu("base64", "base64")
write_vtu("base64_zlib", "base64", zlib=True, header=64, big=True)
writer = vtkXMLUnstructuredGridWriter()
writer.SetInputData(grid)
writer.SetCompressorTypeToLZ4()
writer.SetFileName("two_boxes_lz4.vtu")
writer.Write()
mesh.cell_sets = {}
meshio.write("two_boxes_meshio.vtu", mesh)

cube = vtkCubeSource()  # 24 points, 6 quadrilaterals
cube.SetXLength(2.0)
triangles = vtkTriangleFilter()
triangles.SetInputConnection(cube.GetOutputPort())
for name, type_, order in (("ascii", 1, 0), ("little_endian", 2, 0), ("big_endian", 2, 1)):
    writer = vtkPLYWriter()
    writer.SetInputConnection(cube.GetOutputPort())
    writer.SetFileType(type_)
    writer.SetDataByteOrderToBigEndian() if order else writer.SetDataByteOrderToLittleEndian()
    writer.SetFileName(f"cube_{name}.ply")
    writer.Write()
for name, type_ in (("ascii", 1), ("binary", 2)):
    writer = vtkSTLWriter()
    writer.SetInputConnection(triangles.GetOutputPort())
    writer.SetFileType(type_)
    writer.SetFileName(f"cube_{name}.stl")
    writer.Write()
writer = vtkOBJWriter()
writer.SetInputConnection(cube.GetOutputPort())
writer.SetFileName("cube.obj")
writer.Write()
triangles.Update()
surface = meshio.read("cube_ascii.stl")
meshio.write("cube.off", surface)
meshio.write("cube_meshio.ply", surface)
