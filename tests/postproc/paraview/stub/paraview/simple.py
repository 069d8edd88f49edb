"""What frames.py calls of ParaView's module of this name, as far as blocks and arrays go: those that it asks for must be in
the files of the series. Tells on standard output what is shown, as lines "BLOCK visible|hidden ARRAY COMPONENT"."""
import atexit
import os
import xml.etree.ElementTree


class Proxy:
    def __init__(self, **properties):
        self.__dict__.update(properties)


class Display(Proxy):
    array = ""

    def SetScalarBarVisibility(self, view, visible):
        assert self.array and visible


the_view = Proxy(ViewSize=[800, 600])
the_scale = Proxy()
displays = []


def components_of(file):
    """Names of the components of every array at points in a VTK file, or in the pieces of one."""
    names = {}
    for element in xml.etree.ElementTree.parse(file).getroot().iter():
        if element.tag in ("PointData", "PPointData"):
            for array in element:
                names[array.get("Name")] = [array.get(f"ComponentName{c}") for c in range(int(array.get("NumberOfComponents", 1)))]
    return names


def _DisableFirstRenderCameraReset():
    pass


def PVDReader(registrationName, FileName):
    blocks = {}
    for entry in xml.etree.ElementTree.parse(FileName).getroot().iter("DataSet"):
        blocks.setdefault(entry.get("name"), []).append(os.path.join(os.path.dirname(FileName), entry.get("file")))
    assert blocks, f"{FileName} has no blocks"
    return Proxy(blocks=blocks)


def GetAnimationScene():
    return Proxy(EndTime=1.0, UpdateAnimationUsingDataTimeSteps=lambda: None)


def GetActiveViewOrCreate(kind):
    assert kind == "RenderView"
    return the_view


def ExtractBlock(registrationName, Input, Selectors):
    (selector,) = Selectors
    name = selector.removeprefix('//*[@label="').removesuffix('"]')
    assert name == registrationName
    return Proxy(name=name, files=Input.blocks[name])


def Show(block, view):
    display = Display(name=block.name, files=block.files, component="")
    displays.append(display)
    return display


def ColorBy(display, array):
    kind, name, *component = array
    of_files = [found[name] for found in map(components_of, display.files) if name in found]
    assert kind == "POINTS" and of_files, f"{display.name} has no array {name}"
    for names in of_files:
        assert len(names) == 1 if not component else component[0] == "Magnitude" or component[0] in names, (component, names)
    display.array, display.component = name, "".join(component)


def GetColorTransferFunction(array):
    return the_scale


def GetScalarBar(scale, view):
    return Proxy()


def SaveScreenshot(file, view, ImageResolution):
    assert view.ViewSize == ImageResolution
    print("picture", file, *ImageResolution)


@atexit.register
def tell():
    for display in displays:
        print(display.name, "visible" if display.Visibility else "hidden", display.array, display.component)
    points = getattr(the_scale, "RGBPoints", None)
    if points:
        print("scale", len(points) // 4, *points[0::4][:: max(1, len(points) // 4 - 1)])
    print("time", the_view.ViewTime)
    if hasattr(the_view, "CameraViewUp"):
        print("camera", *the_view.CameraFocalPoint, *the_view.CameraViewUp, the_view.CameraParallelScale)
