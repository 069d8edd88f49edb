"""Frames as VTK data sets, with the cells and names of the VTU files of `burnish export`."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Literal

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_BEZIER_HEXAHEDRON,
    VTK_BEZIER_QUADRILATERAL,
    VTK_HEXAHEDRON,
    VTK_LAGRANGE_HEXAHEDRON,
    VTK_LAGRANGE_QUADRILATERAL,
    VTK_QUAD,
    vtkCellArray,
    vtkHigherOrderHexahedron,
    vtkHigherOrderQuadrilateral,
    vtkUnstructuredGrid,
)

from .errors import Error, unknown_name
from .splines import Basis, Floats, Integers, Patch

if TYPE_CHECKING:
    from .results import Frame

Cells = Literal["bezier", "lagrange", "linear"]

_TYPES = {
    "bezier": (VTK_BEZIER_QUADRILATERAL, VTK_BEZIER_HEXAHEDRON),
    "lagrange": (VTK_LAGRANGE_QUADRILATERAL, VTK_LAGRANGE_HEXAHEDRON),
    "linear": (VTK_QUAD, VTK_HEXAHEDRON),
}
_HIGHEST_DEGREE = 10  # of VTK's curved cells


def make_mesh(frame: Frame, cells: Cells, subdivision: int | None, body: str | None, deformed: bool) -> vtkUnstructuredGrid:
    if cells not in _TYPES:
        raise unknown_name("cells", cells, _TYPES)
    if subdivision is not None and subdivision < 1:
        raise Error(f"subdivision: found {subdivision}; expected at least 1 cell per knot span")
    numbers = _chosen(frame, body)
    patches = [frame.patches[k] for k in numbers]
    if cells != "linear" and (highest := max(basis.degree for p in patches for basis in p.bases)) > _HIGHEST_DEGREE:
        raise Error(f"found a patch of degree {highest}; Lagrange and Bezier cells have degrees up to {_HIGHEST_DEGREE}; linear "
                    "cells take every degree")
    pieces = [_Piece(patch, cells, subdivision or frame.run.subdivision) for patch in patches]
    grid = vtkUnstructuredGrid()
    _set_points(grid, frame, numbers, pieces, deformed)
    _set_cells(grid, cells, numbers, pieces)
    _set_fields(grid, frame, numbers, pieces, body)
    if cells == "bezier":
        weights = np.concatenate([patch.lattice_weights(piece.rows) for patch, piece in zip(patches, pieces)])
        grid.GetPointData().SetRationalWeights(_array("RationalWeights", weights[:, None]))
    return grid


class _Piece:
    """The points and cells of a patch."""

    def __init__(self, patch: Patch, cells: Cells, subdivision: int) -> None:
        self.steps = [subdivision if cells == "linear" else basis.degree for basis in patch.bases]
        points: Callable[[Basis, int], Floats] = (
            (lambda basis, _: basis.bernstein_rows()) if cells == "bezier"
            else (lambda basis, steps: basis.values_at(basis.subdivided(steps))))
        self.rows = [points(basis, steps) for basis, steps in zip(patch.bases, self.steps)]
        self.extents = [row.shape[0] for row in self.rows]
        self.num_points = int(np.prod(self.extents))
        spans = [basis.num_spans for basis in patch.bases]
        if cells == "linear":  # every step is a cell
            spans, self.steps = [s * k for s, k in zip(spans, self.steps)], [1] * patch.dim
        self.cells = self._cells(spans)

    def _cells(self, spans: list[int]) -> Integers:
        """Numbers of the points of each cell in VTK's order, cells and points with the first direction fastest."""
        strides = np.cumprod([1, *self.extents[:-1]])
        local = _tensor([steps + 1 for steps in self.steps])
        order = np.empty(len(local), dtype=np.int64)
        for number, index in enumerate(local):
            order[_vtk_place(index, self.steps)] = number
        corners = (_tensor(spans) * self.steps) @ strides
        return corners[:, None] + (local[order] @ strides)[None, :]


def _tensor(extents: list[int]) -> Integers:
    """All indices below the extents, first direction fastest: shape (count, directions)."""
    grids = np.meshgrid(*(np.arange(n) for n in reversed(extents)), indexing="ij")
    return np.stack([grid.ravel() for grid in reversed(grids)], axis=1)


def _vtk_place(index: Integers, steps: list[int]) -> int:
    """Place of a point of a cell in VTK's order, which is that of straight cells for one step."""
    if len(steps) == 2:
        return int(vtkHigherOrderQuadrilateral.PointIndexFromIJK(int(index[0]), int(index[1]), [*steps, 1]))
    return int(vtkHigherOrderHexahedron.PointIndexFromIJK(*(int(i) for i in index), steps))


def _chosen(frame: Frame, body: str | None) -> list[int]:
    """Numbers of the patches of a body, or of all."""
    if body is None:
        return list(range(len(frame.patches)))
    if body not in frame.run.bodies:
        raise unknown_name("body", body, frame.run.bodies)
    number = frame.run.bodies.index(body)
    return [k for k, patch in enumerate(frame.patches) if patch.body == number]


def _array(name: str, values: Floats, components: tuple[str, ...] = ()) -> object:
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    for number, component in enumerate(components):
        array.SetComponentName(number, component)
    return array


def _in_space(vectors: Floats) -> Floats:
    return np.pad(vectors, ((0, 0), (0, 3 - vectors.shape[1])))


def _set_points(grid: vtkUnstructuredGrid, frame: Frame, numbers: list[int], pieces: list[_Piece], deformed: bool) -> None:
    patches = frame.locator.patches if deformed else frame.patches
    positions = [patches[k].lattice(patches[k].points, piece.rows) for k, piece in zip(numbers, pieces)]
    points = vtkPoints()
    points.SetData(_array("Points", _in_space(np.concatenate(positions))))
    grid.SetPoints(points)


def _set_cells(grid: vtkUnstructuredGrid, cells: Cells, numbers: list[int], pieces: list[_Piece]) -> None:
    first = np.cumsum([0, *(piece.num_points for piece in pieces)])
    points = [piece.cells + begin for piece, begin in zip(pieces, first)]
    sizes = np.concatenate([np.full(len(p), p.shape[1]) for p in points])
    offsets = np.concatenate([[0], np.cumsum(sizes)])
    array = vtkCellArray()
    array.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True),
                  numpy_to_vtkIdTypeArray(np.concatenate([p.ravel() for p in points]), deep=True))
    grid.SetCells(_TYPES[cells][len(pieces[0].steps) - 2], array)
    patch = np.concatenate([np.full(len(p), k, dtype=np.int32) for p, k in zip(points, numbers)])
    grid.GetCellData().AddArray(_array("patch", patch))
    if cells != "linear":
        degrees = [np.tile([*map(float, piece.steps), 1.0][:3], (len(p), 1)) for p, piece in zip(points, pieces)]
        grid.GetCellData().SetHigherOrderDegrees(_array("HigherOrderDegrees", np.concatenate(degrees)))


def _set_fields(grid: vtkUnstructuredGrid, frame: Frame, numbers: list[int], pieces: list[_Piece], body: str | None) -> None:
    """All fields; a body that is chosen alone has no array for a field that it does not have."""
    for name, components in frame.arrays:
        field = frame.field(name)
        if body is not None and field.bodies and body not in field.bodies:
            continue
        values = np.concatenate([field.lattice(k, piece.rows) for k, piece in zip(numbers, pieces)])
        if name == "displacement":
            values, components = _in_space(values), ("X", "Y", "Z")
        grid.GetPointData().AddArray(_array(f"{name} [{field.unit}]" if field.unit else name, values, components))
