#!/usr/bin/env bash
# What the program writes, read by others: states by numpy, meshes by meshio and Gmsh, VTU and PVD by VTK, glTF by Assimp and Blender,
# OBJ and PLY sequences by Blender, USD by TinyUSDZ (Debian's Blender is built without USD) where npm can fetch it, pictures by pngcheck,
# OpenEXR by OpenImageIO and exrheader, video by ffprobe; and quadratic tets that Tetgen writes, read by the program.
# shellcheck source=tests/full/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"$program" run "$root/assets/scenes/cantilever.toml" --frames 0..2 --video --out run --quiet \
  --set render.width=160 --set render.height=90 --set 'render.channels=["depth"]'
for extension in msh mesh vtk vtu; do
  "$program" info run/mesh.msh --mend "mesh.$extension" --quiet >/dev/null
done
"$program" render run --frames 2 --quiet -o comp --set render.transparent=true --set render.channel_format=exr_multilayer \
  --set 'render.channels=["depth","normal","motion","body_id"]'
"$program" render run --frames 2 --quiet -o arrays --set render.transparent=true \
  --set 'render.channels=["color","alpha","depth","normal","motion","body_id"]'
"$program" render run --frames 2 --quiet -o single --set render.channel_format=exr --set 'render.channels=["depth"]'
"$program" export run --frames 0..2 --quiet
"$program" export run --frames 2 --format ply --fields von_mises -o surface --quiet
"$program" export run --frames 2 --format obj -o surface --quiet
"$program" export run --format gltf --frames 0..2 --quiet
"$program" simulate "$root/assets/scenes/cantilever.toml" --frames 0..4 --out moving --quiet \
  --set body.0.surface.smooth=true --set body.0.look.field=displacement
for format in gltf usda ply obj; do
  fields=()
  case $format in usda | ply) fields=(--fields von_mises) ;; esac
  "$program" export moving --format "$format" "${fields[@]}" --quiet
done
"$program" export moving --format usda --frames 4 -o last/export --quiet
"$program" render moving --frames 2 -o clear --quiet --set body.0.look='{ transmission = 1, coat = 0.5 }' \
  --set render.width=160 --set render.height=90
"$program" export clear --format gltf --frames 2 --quiet
"$program" refine run/mesh.msh --order 2 -o quadratic.msh --quiet >/dev/null
for extension in vtk vtu; do "$program" info quadratic.msh --mend "quadratic.$extension" --quiet >/dev/null; done
cat >cube.off <<'CUBE'
OFF
8 6 0
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
4 0 3 2 1
4 4 5 6 7
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
CUBE
tetgen -Qpqa0.05o2 cube.off >tetgen.log || { cat tetgen.log; fail "Tetgen"; }
"$program" info cube.1.ele --mend tetgen.msh --quiet >/dev/null
/usr/bin/python3 - <<'PY' || fail "numpy or meshio"
import json, meshio, numpy as np
meshes = [meshio.read(f"mesh.{e}") for e in ("msh", "mesh", "vtk", "vtu")] + [meshio.read("run/mesh.msh")]
for m in meshes[1:]:
    assert np.array_equal(m.points, meshes[0].points), "points differ between formats"
    assert np.array_equal(np.vstack([c.data for c in m.cells if c.type == "tetra"]),
                          np.vstack([c.data for c in meshes[0].cells if c.type == "tetra"])), "tets differ between formats"
n = len(meshes[0].points)
state = np.load("run/states/frame_0002.npy")
assert state.dtype == np.float64 and state.shape[1:] == (2, n, 3), state.shape
vtu = meshio.read("run/export/frame_0002.vtu")
assert np.array_equal(vtu.points, state[0, 0]), "exported points are not the state's"
assert np.array_equal(vtu.cells_dict["tetra"], np.vstack([c.data for c in meshes[0].cells if c.type == "tetra"]))
assert {"von_mises", "J", "energy_density"} <= set(vtu.point_data) & set(vtu.cell_data), vtu
assert np.array_equal(vtu.point_data["displacement"], state[0, 0] - meshes[0].points)
assert np.array_equal(vtu.point_data["velocity"], state[0, 1])
pinned = vtu.point_data["pinned"] != 0
assert 0 < pinned.sum() < n and np.array_equal(state[0, 0][pinned], meshes[0].points[pinned])
e = [meshes[0].points[vtu.cells_dict["tetra"]], vtu.points[vtu.cells_dict["tetra"]]]
volumes = [np.linalg.det(x[:, 1:] - x[:, :1]) for x in e]
assert np.allclose(vtu.cell_data["J"][0], volumes[1] / volumes[0])
assert np.isclose((vtu.cell_data["energy_density"][0] * volumes[0]).sum() / 6, np.genfromtxt("run/energy.csv", delimiter=",", names=True)["elastic"][2])
ply, obj = meshio.read("surface/frame_0002.ply"), meshio.read("surface/frame_0002.obj")
assert np.allclose(ply.points, obj.points, atol=1e-15) and len(ply.point_data["von_mises"]) == len(ply.points)
# meshio knows each format's own order of the midside nodes and gives VTK's.
for file in ("quadratic.msh", "quadratic.vtk", "quadratic.vtu", "tetgen.msh"):
    m = meshio.read(file)
    t = m.points[m.cells_dict["tetra10"]]
    middles = np.stack([(t[:, a] + t[:, b]) / 2 for a, b in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))], axis=1)
    assert np.allclose(t[:, 4:], middles, atol=1e-12), f"midside nodes of {file} are not in the middle of their edges"
depth = np.load("run/aov/depth/frame_0002.npy")
assert depth.dtype == np.float32 and depth.shape == (90, 160) and np.isfinite(depth).any(), depth.shape
run = json.load(open("run/run.json"))
energy = np.genfromtxt("run/energy.csv", delimiter=",", names=True)
assert len(energy) == 3 and energy["frame"].tolist() == [0, 1, 2]
assert np.allclose(energy["kinetic"] + energy["elastic"] + energy["gravitational"], energy["total"], rtol=1e-12, atol=1e-9)
PY
/usr/bin/python3 - <<'PY' || fail "VTK does not read the .vtu and .pvd"
import xml.etree.ElementTree as ET
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
files = [(float(d.get("timestep")), d.get("file")) for d in ET.parse("run/export/cantilever.pvd").getroot().iter("DataSet")]
assert [round(60 * t) for t, _ in files] == [0, 1, 2], files
for frame, (_, file) in enumerate(files):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName("run/export/" + file)
    reader.Update()
    grid = reader.GetOutput()
    assert grid.GetNumberOfCells() > 0, file
    q, qdot = np.load(f"run/states/frame_{frame:04}.npy")[0]
    assert np.array_equal(vtk_to_numpy(grid.GetPoints().GetData()), q), file
    points = grid.GetPointData()
    assert np.array_equal(vtk_to_numpy(points.GetArray("velocity")), qdot), file
    assert points.GetVectors() is not None or points.GetArray("displacement").GetNumberOfComponents() == 3, file
    assert vtk_to_numpy(grid.GetCellData().GetArray("von_mises")).min() >= 0.0, file
PY
/usr/bin/python3 - <<'PY' || fail "OpenImageIO does not read the .exr as numpy reads the .npy"
import numpy as np, OpenImageIO as oiio
def read(file):
    picture = oiio.ImageInput.open(file)
    spec = picture.spec()
    assert spec["compression"] == "zip" and spec.format == "float" and (spec.width, spec.height) == (160, 90), file
    return dict(zip(spec.channelnames, np.moveaxis(picture.read_image("float"), 2, 0)))
def array(name):
    return np.load(f"arrays/aov/{name}/frame_0002.npy")
layers = read("comp/aov/multilayer/frame_0002.exr")
assert set(layers) == {"R", "G", "B", "A", "Z", "normal.X", "normal.Y", "normal.Z", "motion.X", "motion.Y", "body_id.X"}, set(layers)
expected = {"A": array("alpha"), "Z": array("depth"), "body_id.X": array("body_id")}
for name, letters, layer in (("color", "RGB", ""), ("normal", "XYZ", "normal."), ("motion", "XY", "motion.")):
    expected |= {layer + letter: array(name)[..., i] for i, letter in enumerate(letters)}
for name, values in expected.items():
    assert np.array_equal(layers[name], values), name
assert 0 < layers["A"].mean() < 1 and (abs(layers["motion.Y"]) > 0).any()
single = read("single/aov/depth/frame_0002.exr")
assert list(single) == ["Z"] and np.array_equal(single["Z"], layers["Z"]), list(single)
png = oiio.ImageInput.open("comp/frames/frame_0002.png")
assert png.spec().nchannels == 4, png.spec().nchannels
PY
exrheader comp/aov/multilayer/frame_0002.exr >exrheader.log || { cat exrheader.log; fail "exrheader"; }
grep -q 'compression.*: zip, multi-scanline blocks' exrheader.log || { cat exrheader.log; fail "the .exr is not ZIP-compressed"; }
grep -q 'framesPerSecond (type rational): 60/1' exrheader.log || { cat exrheader.log; fail "the .exr does not tell its frames a second"; }
gmsh -check run/mesh.msh >gmsh.log 2>&1 || { cat gmsh.log; fail "Gmsh does not read mesh.msh"; }
assimp info run/export/*.glb >assimp.log 2>&1 || { cat assimp.log; fail "Assimp does not read the .glb"; }
grep -Eq '^Animations: +1$' assimp.log || { cat assimp.log; fail "Assimp sees no animation in the .glb"; }
blender --background --factory-startup --python-exit-code 1 --python "$root/tests/full/blender.py" >blender.log 2>&1 ||
  { tail -n 20 blender.log; fail "Blender does not see the states in .glb, .obj and .ply"; }
# Of one version, for its package is not Debian's.
if { command -v node && command -v npm && npm pack tinyusdz@0.9.0-rc10; } >npm.log 2>&1; then
  tar xf tinyusdz-*.tgz
  node "$root/tests/full/usd.mjs" >usd.log 2>&1 || { cut -c 1-200 usd.log; fail "TinyUSDZ does not read the .usda"; }
  /usr/bin/python3 - <<'PY' || fail "TinyUSDZ does not see the states in the .usda"
import json, math, meshio, numpy as np
usd = json.load(open("usd.json"))
frames = [meshio.read(f"moving/export/frame_{k:04}.ply") for k in range(5)]
assert abs(frames[4].points - frames[1].points).max() > 0.01, "nothing moves"
q = np.load("moving/states/frame_0004.npy")[0, 0]
assert all((abs(q - x).max(axis=1) == 0).any() for x in frames[4].points), "no vertices of the state"
for name, frame in (("moving", 0), ("last", 4)):
    stage = usd[name]
    assert stage["meshes"] == 1 and set(stage["faceVertexCounts"]) == {3}
    assert np.array_equal(np.reshape(stage["faceVertexIndices"], (-1, 3)), frames[0].cells_dict["triangle"])
    assert np.allclose(np.reshape(stage["points"], (-1, 3)), frames[frame].points, atol=1e-6), f"points of {name}"
    assert np.allclose(np.linalg.norm(np.reshape(stage["normals"], (-1, 3)), axis=1), 1, atol=1e-5)
    assert np.allclose(stage["material"]["diffuseColor"], (0.72, 0.12, 0.08)), stage["material"]
    assert math.isclose(stage["material"]["roughness"], 0.35, abs_tol=1e-6)
header, samples = usd["header"], usd["samples"]
assert [header[k] for k in ("startTimeCode", "endTimeCode", "timeCodesPerSecond", "framesPerSecond", "metersPerUnit")] == [0, 4, 60, 60, 1], header
assert math.isclose(header["focalLength"], 12 / math.tan(math.radians(16)), abs_tol=1e-4), header
assert all(list(samples[name]) == list("01234") for name in samples), samples.keys()
for k, frame in enumerate(frames):
    points, extent = (np.reshape(samples[name][str(k)], (-1, 3)) for name in ("points", "extent"))
    assert np.allclose(points, frame.points, atol=1e-6), f"points at {k}"
    assert np.allclose(extent, (points.min(axis=0), points.max(axis=0)), atol=1e-6), f"extent at {k}"
    assert np.allclose(samples["primvars:von_mises"][str(k)], frame.point_data["von_mises"], rtol=1e-6), f"stress at {k}"
PY
else
  echo "skipped: the .usda; npm has no tinyusdz here"
fi
pngcheck -q run/frames/*.png || fail "pngcheck"
ffprobe -v error -show_entries stream=codec_name,pix_fmt,nb_frames -of csv=p=0 run/*.mp4 | tee probe.txt
grep -qx 'h264,yuv420p,3' probe.txt || fail "the video is not three frames of H.264 in yuv420p"
