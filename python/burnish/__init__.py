"""burnish from Python: read results as numpy arrays and VTK objects, change and compute scenes, draw and compare.

    import burnish

    run = burnish.open("out/press")                      # the directory of a run, also while it goes on
    run.history["disc.fy"]                               # a column of history.csv
    run.frames[-1].field("von_mises").at_points([[1.0, 0.9]])
    run.frames[-1].mesh()                                # a vtkUnstructuredGrid with curved cells

    scene = burnish.Scene("press.yaml")
    scene["material.E"] = 2000
    run = scene.run("out/stiff")
    burnish.render(run, field="von_mises")               # shows itself in a notebook

Reading needs h5py and numpy alone, and each part loads what it needs when it is first used.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .comparison import Comparison as Comparison, Verdict as Verdict, compare as compare
    from .errors import Error as Error, UnknownName as UnknownName
    from .fields import Field as Field, Line as Line
    from .picture import Animation as Animation, Picture as Picture, animate as animate, render as render
    from .results import Contact as Contact, Frame as Frame, History as History, QuadraturePoints as QuadraturePoints
    from .results import Run as Run, open as open
    from .scene import RunStopped as RunStopped, Scene as Scene, Step as Step, resume as resume

    __version__: str

_PLACES = {
    "Animation": "picture",
    "Comparison": "comparison",
    "Contact": "results",
    "Error": "errors",
    "Field": "fields",
    "Frame": "results",
    "History": "results",
    "Line": "fields",
    "Picture": "picture",
    "QuadraturePoints": "results",
    "Run": "results",
    "RunStopped": "scene",
    "Scene": "scene",
    "Step": "scene",
    "UnknownName": "errors",
    "Verdict": "comparison",
    "animate": "picture",
    "compare": "comparison",
    "open": "results",
    "render": "picture",
    "resume": "scene",
}

__all__ = sorted(_PLACES)


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import version

        return version("burnish")
    place = _PLACES.get(name)
    if place is None:
        raise AttributeError(f"module 'burnish' has no attribute {name!r}")
    value = getattr(importlib.import_module(f".{place}", __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*_PLACES, "__version__"})
