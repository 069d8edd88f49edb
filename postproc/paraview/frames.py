"""Shows the series frames.pvd beside this file in ParaView, 5.11 or later.

In ParaView: File > Load State. In a shell: `pvpython frames.py picture.png` draws what is shown; without the
name of a picture nothing is drawn. The file is written anew with the series: make changes in a copy beside it.
"""
import os
import sys

import paraview.simple
from paraview.simple import *

# Blocks of the series: those that have the field, others that are seen, and those that are there to be shown.
colored = @colored@
plain = @plain@
tools = @tools@
knots = @knots@
hidden = @hidden@

# The array, its component (None where it has but one), and its colours from the lowest to the highest value
# of all times. "Rescale to Data Range" asks ParaView for another range.
array, component = @array@, @component@
title = @title@
lowest, highest = @range@
colors, steps = @colors@, @steps@
states = @states@

# What is shown first: the last time of the scene's first picture. None: the last time of all.
time = @time@

# A parallel projection: the directions to the eye and up, the middle of what is seen, its width and height.
eye, up = @eye@, @up@
center, width, height = @center@, @window@
size = @size@

paper, ink = @paper@, @ink@
plain_color, tool_color, knot_color = @plain_color@, @tool_color@, @knot_color@
tool_opacity = @opacity@
light = @light@  # 0: colours as they are in the scale
subdivision = @subdivision@  # of curved cells, when they are drawn


def rgb(color):
    return [int(color[k : k + 2], 16) / 255 for k in (1, 3, 5)]


def show(name, color, visible=True):
    block = ExtractBlock(registrationName=name, Input=series, Selectors=[f'//*[@label="{name}"]'])
    display = Show(block, view)
    display.Visibility = visible
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = rgb(color)
    display.Ambient, display.Diffuse = 1 - light, light
    display.NonlinearSubdivisionLevel = subdivision
    display.LineWidth = 2
    return display


def move_forward(display):
    """Before the faces that it lies in."""
    display.Position = [1e-3 * (width + height) * e for e in eye]


folder = os.path.dirname(os.path.abspath(globals().get("__file__", "frames.py")))
paraview.simple._DisableFirstRenderCameraReset()
series = PVDReader(registrationName="frames.pvd", FileName=os.path.join(folder, "frames.pvd"))
animation = GetAnimationScene()
animation.UpdateAnimationUsingDataTimeSteps()
animation.AnimationTime = animation.EndTime if time is None else time
view = GetActiveViewOrCreate("RenderView")
view.ViewTime = animation.AnimationTime

for name in plain:
    show(name, plain_color)
for name in tools:
    show(name, tool_color).Opacity = tool_opacity
for name in knots:
    display = show(name, knot_color)
    display.LineWidth = 1
    move_forward(display)
for name in hidden:
    show(name, tool_color, False)
for name in colored:
    display = show(name, plain_color)
    ColorBy(display, ("POINTS", array, component) if component else ("POINTS", array))
    display.SetScalarBarVisibility(view, True)
    if not name.startswith("body"):
        display.LineWidth = 5
        move_forward(display)

if colored:
    scale = GetColorTransferFunction(array)
    scale.AutomaticRescaleRangeMode = "Never"
    scale.ColorSpace = "RGB"
    scale.NumberOfTableValues = steps
    points = []
    for k, color in enumerate(colors.split()):
        points += [lowest + (highest - lowest) * k / colors.count(" "), *rgb(color)]
    scale.RGBPoints = points
    scale.Annotations = [text for k, state in enumerate(states) for text in (str(k), state)]
    bar = GetScalarBar(scale, view)
    bar.Title, bar.ComponentTitle, bar.AddRangeLabels = title, "", False
    bar.ScalarBarLength = 0.5
    bar.TitleColor = bar.LabelColor = rgb(ink)

view.UseColorPaletteForBackground = False
view.Background = rgb(paper)
view.OrientationAxesLabelColor = rgb(ink)
view.InteractionMode = @mode@
view.CameraParallelProjection = True
view.CameraFocalPoint = view.CenterOfRotation = center
view.CameraPosition = [c + 2 * (width + height) * e for c, e in zip(center, eye)]
view.CameraViewUp = up
picture = sys.argv[1] if len(sys.argv) > 1 else None
if picture:
    view.ViewSize = size
view.CameraParallelScale = 0.6 * max(height, width * view.ViewSize[1] / view.ViewSize[0])
if picture:
    SaveScreenshot(picture, view, ImageResolution=size)
