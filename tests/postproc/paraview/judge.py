"""Judges what ParaView shows of a series when its frames.py is run. Called with pvpython by scripts/paraview.

Usage: judge.py DIRECTORY PICTURE.png linear|lagrange|bezier
"""
import os
import runpy
import sys

from paraview import servermanager
from paraview.simple import *
from vtkmodules.vtkIOImage import vtkPNGReader

directory, picture, cells = sys.argv[1:]
script = os.path.join(directory, "frames.py")
sys.argv = [script, picture]
shown = runpy.run_path(script, run_name="__main__")
view, size = shown["view"], shown["size"]
lowest, highest = shown["lowest"], shown["highest"]


def require(fact, words):
    if not fact:
        sys.exit(f"{directory}: {words}")


# Blocks: every one of the collection is a source of its own, and what is to be seen is.
collection = open(os.path.join(directory, "frames.pvd")).read()
names = {line.split('name="')[1].split('"')[0] for line in collection.splitlines() if "<DataSet" in line}
visible = set(shown["colored"] + shown["plain"] + shown["tools"] + shown["knots"])
require(names == visible | set(shown["hidden"]), f"blocks {names} are not those of the script")
require(shown["colored"] and shown["tools"] == [name for name in shown["tools"] if name.startswith("tool_")], "what is coloured?")
for name in names:
    source = FindSource(name)
    require(source is not None, f"{name} is no source")
    require(GetDisplayProperties(source, view).Visibility == (name in visible), f"{name} is shown, or not")

# The range of colours holds all values of all times, and no more. Coefficients of Bezier cells may lie outside.
array, component = shown["array"], shown["component"]


def leaves(data):
    """The meshes in a data set of blocks."""
    if not hasattr(data, "GetNumberOfBlocks"):
        return [data] if data else []
    return [leaf for k in range(data.GetNumberOfBlocks()) for leaf in leaves(data.GetBlock(k))]


def values_of(mesh):
    """The value of every point that is drawn."""
    data = mesh.GetPointData().GetArray(array)
    if data is None:
        return []
    columns = range(data.GetNumberOfComponents())
    if component == "Magnitude":
        return [sum(x * x for x in data.GetTuple(k)) ** 0.5 for k in range(data.GetNumberOfTuples())]
    column = next((c for c in columns if data.GetComponentName(c) == component), 0)
    return [data.GetTuple(k)[column] for k in range(data.GetNumberOfTuples())]


found = []
for time in shown["series"].TimestepValues:
    for name in shown["colored"]:
        block = FindSource(name)
        block.UpdatePipeline(time)
        for mesh in leaves(servermanager.Fetch(block)):
            found += values_of(mesh)
span = highest - lowest
if cells != "bezier":
    # Projected values of a quantity that cannot be negative may be; colours end at 0.
    require(min(found) > lowest - 0.05 * span and max(found) < highest + 1e-5 * span, f"values {min(found)} to {max(found)}")
    require(max(found) > highest - 0.05 * span, f"values end at {max(found)}, colours at {highest}")
scale = GetColorTransferFunction(array)
require(abs(scale.RGBPoints[0] - lowest) <= 1e-6 * span and abs(scale.RGBPoints[-4] - highest) <= 1e-6 * span, "another scale")

# The picture: in the plane, points have the colours of their values. Knot lines go through points, and are left out.
for name in shown["knots"]:
    Hide(FindSource(name), view)
SaveScreenshot(picture, view, ImageResolution=size)
reader = vtkPNGReader()
reader.SetFileName(picture)
reader.Update()
image = reader.GetOutput()
require(list(image.GetDimensions()[:2]) == size, "a picture of another size")
if shown["light"] == 0 and cells != "bezier":
    colors = [shown["rgb"](color) for color in shown["colors"].split()]
    per_length = size[1] / (2 * view.CameraParallelScale)

    def at_scale(value):
        return min(max((value - lowest) / span, 0), 1)

    def color_of(value):
        if shown["steps"] == len(colors):
            return [255 * c for c in colors[min(int(at_scale(value) * len(colors)), len(colors) - 1)]]
        at = at_scale(value) * (len(colors) - 1)
        joint = min(int(at), len(colors) - 2)
        return [255 * (a + (at - joint) * (b - a)) for a, b in zip(colors[joint], colors[joint + 1])]

    def has_color(x, y, color):
        """Whether a pixel has it, or a neighbour, since a point may lie on the border."""
        return any(
            all(abs(color[c] - image.GetScalarComponentAsDouble(x + dx, y + dy, 0, c)) < 12 for c in range(3))
            for dx in (0, -2, 2) for dy in (0, -2, 2))

    right = wrong = outside = 0
    for name in shown["colored"]:
        for mesh in leaves(servermanager.Fetch(FindSource(name))):
            for k, value in enumerate(values_of(mesh)):
                place = [int(size[c] / 2 + per_length * (mesh.GetPoint(k)[c] - view.CameraFocalPoint[c])) for c in (0, 1)]
                if not all(2 < place[c] < size[c] - 2 for c in (0, 1)):
                    outside += 1
                elif has_color(*place, color_of(value)):
                    right += 1
                else:
                    wrong += 1
    print(f"{right} points have their colours, {wrong} have others, {outside} are outside")
    require(outside < right, "most of the body is not seen")
    require(wrong < 0.02 * right, "colours are not those of the values")
