"""Imports what tests/full/readers.sh exported into Blender and holds it to the states. Run inside of Blender, in that script's folder:
five frames of the cantilever in `moving`, its surface smooth and coloured by displacement, and a jelly of it in `clear`."""
import math
import bpy
import meshio
import numpy as np

np.bool = bool  # Debian's Blender is older than its numpy, which has dropped this name

def surface_vertices():
    """The tets' boundary: its vertices in their order, and how many triangles it has."""
    tets = np.vstack([c.data for c in meshio.read("moving/mesh.msh").cells if c.type == "tetra"])
    faces = np.sort(np.vstack([np.delete(tets, k, axis=1) for k in range(4)]), axis=1)
    faces, counts = np.unique(faces, axis=0, return_counts=True)
    return np.unique(faces[counts == 1]), (counts == 1).sum()

def state(frame):
    return np.load(f"moving/states/frame_{frame:04}.npy")[0, 0][outer]

def vertices(thing):
    """World positions as they are shown, with shape keys at their values, back in the y-up axes of the files."""
    shown = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    x = np.array([shown.matrix_world @ v.co for v in shown.to_mesh().vertices])
    return np.column_stack([x[:, 0], x[:, 2], -x[:, 1]])

def only(kind):
    things = [o for o in bpy.data.objects if o.type == kind]
    assert len(things) == 1, (kind, list(bpy.data.objects))
    return things[0]

def imported(importer, file, **options):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = 60
    assert importer(filepath=file, **options) == {"FINISHED"}, file
    body = only("MESH")
    assert len(body.data.vertices) == len(outer) and len(body.data.polygons) == triangles, (file, body.data)
    assert all(p.loop_total == 3 for p in body.data.polygons), file
    return body

def input_of(body, name):
    (material,) = body.data.materials
    return next(n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED").inputs[name]

outer, triangles = surface_vertices()
assert abs(state(4) - state(1)).max() > 0.01, "nothing moves"

body = imported(bpy.ops.import_scene.gltf, "moving/export/cantilever.glb")
(action,) = bpy.data.actions
assert np.allclose(action.frame_range, (0, 4)), action.frame_range  # at 60 frames a second
for frame in (0, 1, 4):
    bpy.context.scene.frame_set(frame)
    assert np.allclose(vertices(body), state(frame), atol=1e-6), f"frame {frame} of the .glb"
bpy.context.scene.frame_set(2, subframe=0.5)
assert np.allclose(vertices(body), (state(2) + state(3)) / 2, atol=1e-6), "between frames of the .glb"
assert body.data.has_custom_normals and any(p.use_smooth for p in body.data.polygons)  # flat ones stay flat
(colors,) = body.data.color_attributes
assert any(link.from_node.type == "VERTEX_COLOR" for link in input_of(body, "Base Color").links), "the colours are not used"
srgb = {}
for corner in body.data.loops:  # Blender keeps them in 8 bits
    srgb[corner.vertex_index] = np.array(colors.data[corner.index].color_srgb)[:3] * 255
moved = np.linalg.norm(state(4) - state(0), axis=1)
viridis = {int(moved.argmin()): (68, 1, 84), int(moved.argmax()): (253, 231, 37)}  # at its ends
for vertex, color in viridis.items():
    assert abs(srgb[vertex] - color).max() <= 1, (vertex, srgb[vertex])
assert math.isclose(input_of(body, "Roughness").default_value, 0.35, abs_tol=1e-6)
camera = only("CAMERA")
assert np.allclose(camera.matrix_world.translation, (0.95, -2.6, 0.95), atol=1e-6), camera.matrix_world
assert math.isclose(math.degrees(camera.data.angle_y), 32, abs_tol=1e-3) or \
    math.isclose(math.degrees(2 * math.atan(math.tan(camera.data.angle / 2) * 9 / 16)), 32, abs_tol=1e-3), camera.data.angle

body = imported(bpy.ops.import_scene.gltf, "clear/export/cantilever.glb")
assert np.allclose(vertices(body), state(2), atol=1e-6)
assert math.isclose(input_of(body, "Transmission").default_value, 1), "transmission"
assert math.isclose(input_of(body, "Clearcoat").default_value, 0.5), "coat"

for frame in (1, 4):
    obj = imported(bpy.ops.wm.obj_import, f"moving/export/frame_{frame:04}.obj")
    assert np.allclose(vertices(obj), state(frame), atol=1e-6), f"frame {frame} as .obj"
    assert obj.data.has_custom_normals and all(p.use_smooth for p in obj.data.polygons), "normals of the .obj"
    assert np.allclose(input_of(obj, "Base Color").default_value[:3], (0.72, 0.12, 0.08)), "colour of the .mtl"
    assert math.isclose(input_of(obj, "Roughness").default_value, 0.35, abs_tol=1e-6), "roughness of the .mtl"
    assert math.isclose(input_of(obj, "Specular").default_value, 0.5, abs_tol=1e-6), "specular of the .mtl"
    ply = imported(bpy.ops.import_mesh.ply, f"moving/export/frame_{frame:04}.ply")  # knows no axes
    x = np.array([v.co for v in ply.data.vertices])
    assert np.allclose(x, state(frame), atol=1e-6), f"frame {frame} as .ply"
