"""A picture of ParaView's, for the sheets of docs/render.md that show it beside `burnish render`.

    pvpython bench/peers/paraview_picture.py KIND FILE.pvd PICTURE.png WIDTH HEIGHT

FILE.pvd is what `burnish export RUN --cells linear --parts body` writes of scenes/examples/ball_friction.yaml; its last time is drawn
with ParaView's defaults but for field, direction and what KIND says: one of KINDS.
"""

import sys

from paraview import simple as pv

KINDS = ["body", "cut", "isosurfaces", "threshold", "arrows", "edges", "tensors", "streamlines"]
NEAR_THE_BALL, OBLIQUE, ALONG_Z = [0.6, 0.0, 0.0], [-0.3, 0.45, 1.0], [0.0, 0.0, 1.0]


def shown(source, view, field="von_mises"):
    display = pv.Show(source, view)
    if field:
        pv.ColorBy(display, ("POINTS", field))
        display.RescaleTransferFunctionToDataRange(True)
        display.SetScalarBarVisibility(view, True)
    return display


def draw(kind, body, view):
    """Shows what the kind says; returns the direction to look from."""
    if kind == "body":
        shown(body, view)
    elif kind == "cut":
        clip = pv.Clip(Input=body)
        clip.ClipType.Origin = NEAR_THE_BALL
        clip.ClipType.Normal = [-1.0, 0.0, 0.0]
        shown(clip, view)
    elif kind == "isosurfaces":
        contours = pv.Contour(Input=body)
        contours.ContourBy = ["POINTS", "von_mises"]
        contours.Isosurfaces = [0.1, 0.2, 0.3, 0.4, 0.5]
        shown(contours, view)
        shown(pv.Outline(Input=body), view, None)
    elif kind == "threshold":
        part = pv.Threshold(Input=body)
        part.Scalars = ["POINTS", "von_mises"]
        part.LowerThreshold, part.UpperThreshold = 0.2, 10.0
        shown(part, view)
        shown(pv.Outline(Input=body), view, None)
    elif kind == "arrows":
        shown(body, view)
        arrows = pv.Glyph(Input=body, GlyphType="Arrow")
        arrows.OrientationArray = arrows.ScaleArray = ["POINTS", "displacement"]
        arrows.ScaleFactor = 1.0
        shown(arrows, view, None)
    elif kind == "edges":
        shown(body, view).Opacity = 0.6
        shown(pv.FeatureEdges(Input=pv.ExtractSurface(Input=body)), view, None)
    elif kind == "tensors":
        shown(body, view)
        glyphs = pv.TensorGlyph(Input=body)
        glyphs.Tensors = ["POINTS", "stress"]
        glyphs.ScaleFactor = 0.3
        shown(glyphs, view, None)
    elif kind == "streamlines":
        section = pv.Slice(Input=body)
        section.SliceType.Origin = [0.0, 0.0, 0.0]
        section.SliceType.Normal = ALONG_Z
        shown(section, view)
        lines = pv.EvenlySpacedStreamlines2D(Input=section)
        lines.Vectors = ["POINTS", "displacement"]
        shown(lines, view, None)
        return ALONG_Z
    else:
        sys.exit(f"found the kind {kind}; expected one of {', '.join(KINDS)}")
    return OBLIQUE


def main(kind, file, picture, width, height):
    body = pv.OpenDataFile(file)
    view = pv.CreateView("RenderView")
    view.ViewSize = [int(width), int(height)]
    view.ViewTime = body.TimestepValues[-1]
    pv.UpdatePipeline(view.ViewTime, body)
    view.CameraPosition = draw(kind, body, view)
    view.CameraFocalPoint = [0.0, 0.0, 0.0]
    view.CameraViewUp = [0.0, 1.0, 0.0]
    pv.ResetCamera(view)
    pv.SaveScreenshot(picture, view, ImageResolution=view.ViewSize)


if __name__ == "__main__":
    main(*sys.argv[1:])
