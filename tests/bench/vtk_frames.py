"""The main job's pictures by VTK: vtk_frames.py SURFACES OUT SHADOWS. Of each .ply of the folder SURFACES one .png in the folder OUT,
1280 x 720, four samples, the scene's body, ground, camera and lights as points; with SHADOWS 1 shadow maps of 2048 texels, which VTK
applies to Phong's surfaces only, else physically based surfaces. Prints milliseconds a picture, after the first."""

import pathlib
import sys
import time

import vtk

surfaces, out, shadows = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3] == "1"


def actor(source, color, roughness):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    made = vtk.vtkActor()
    made.SetMapper(mapper)
    look = made.GetProperty()
    look.SetColor(color)
    if shadows:
        look.SetInterpolationToPhong()
    else:
        look.SetInterpolationToPBR()
        look.SetRoughness(roughness)
    return made


def read(file):
    reader = vtk.vtkPLYReader()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


states = [read(file) for file in sorted(surfaces.glob("*.ply"))]
body = vtk.vtkPolyData()
body.DeepCopy(states[0])
normals = vtk.vtkPolyDataNormals()
normals.SetInputData(body)
normals.SplittingOff()
normals.ConsistencyOff()
ground = vtk.vtkPlaneSource()
ground.SetOrigin(-6, 0, -6)
ground.SetPoint1(-6, 0, 6)
ground.SetPoint2(6, 0, -6)

renderer = vtk.vtkRenderer()
renderer.SetBackground(0.36, 0.33, 0.295)
renderer.AddActor(actor(normals, (0.10, 0.30, 0.34), 0.4))
renderer.AddActor(actor(ground, (0.62, 0.55, 0.47), 0.9))
renderer.AutomaticLightCreationOff()
for position, look_at, color in (((1.6, 3.4, 2.6), (0, 0.8, 0), (1, 0.90, 0.76)), ((-2.6, 2.4, -2.0), (0, 1, 0), (0.80, 0.90, 1))):
    light = vtk.vtkLight()
    light.SetPositional(True)
    light.SetConeAngle(45)  # only spots have shadows
    light.SetPosition(position)
    light.SetFocalPoint(look_at)
    light.SetColor(color)
    renderer.AddLight(light)
if shadows:
    shadow_pass = vtk.vtkShadowMapPass()
    shadow_pass.GetShadowMapBakerPass().SetResolution(2048)
    passes = vtk.vtkRenderPassCollection()
    passes.AddItem(shadow_pass.GetShadowMapBakerPass())
    passes.AddItem(shadow_pass)
    sequence = vtk.vtkSequencePass()
    sequence.SetPasses(passes)
    camera_pass = vtk.vtkCameraPass()
    camera_pass.SetDelegatePass(sequence)
    renderer.SetPass(camera_pass)
camera = renderer.GetActiveCamera()
camera.SetPosition(-1.9, 1.35, 3.55)
camera.SetFocalPoint(-0.1, 0.96, 0)
camera.SetViewAngle(26.5)
renderer.ResetCameraClippingRange()

window = vtk.vtkRenderWindow()
window.SetOffScreenRendering(True)
window.SetMultiSamples(4)
window.SetSize(1280, 720)
window.AddRenderer(renderer)
picture = vtk.vtkWindowToImageFilter()
picture.SetInput(window)
picture.ReadFrontBufferOff()
picture.ShouldRerenderOff()  # the loop renders
writer = vtk.vtkPNGWriter()
writer.SetInputConnection(picture.GetOutputPort())
writer.SetCompressionLevel(1)  # as ours
out.mkdir(parents=True, exist_ok=True)
start = 0.0
for number, state in enumerate(states):
    if number == 1:
        start = time.perf_counter()
    body.GetPoints().DeepCopy(state.GetPoints())
    body.GetPoints().Modified()
    window.Render()
    picture.Modified()
    writer.SetFileName(str(out / f"{number:04d}.png"))
    writer.Write()
print(f"{1e3 * (time.perf_counter() - start) / (len(states) - 1):.1f}")
