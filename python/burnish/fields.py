"""Values of a field of a frame, evaluated from its coefficients."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from .errors import Error
from .places import Locator, Places
from .splines import Floats, Patch

if TYPE_CHECKING:
    from .results import Frame

# Of the size of a body: how far outside of it a given point may lie, as its numbers are rounded, and material outside of a
# mesh that was made on the way.
_GIVEN_OUTSIDE, _MOVED_OUTSIDE = 1e-6, 1e-3


@dataclass(frozen=True, eq=False)
class Line:
    """Values along a straight line in the deformed body; nan outside of it."""

    distance: Floats  #: from the begin, shape (points,)
    points: Floats  #: where the material is, shape (points, dim)
    material: Floats  #: where it was in the undeformed body, shape (points, dim)
    values: Floats  #: shape (points,) or (points, components)

    def __repr__(self) -> str:
        return f"<line of {len(self.distance)} points, {self.distance[-1]:g} long>"


@dataclass(frozen=True, eq=False)
class Field:
    """A field of a frame. It has values where it is asked: a scalar in arrays of shape (points,), a vector or tensor in arrays of
    shape (points, components); nan where there is no body, or one that does not have the field.

    >>> import burnish
    >>> stress = burnish.open("out/press").frames[-1].field("stress.yy")
    >>> stress.at_points([[1.0, 0.5], [5.0, 5.0]]).round(3)
    array([-0.045,    nan])
    >>> round(float(stress.at_material([1.0, 0.5])), 3), stress.on_grid().shape
    (-0.044, (24, 12))
    >>> stress.on_line([1, 0], [1, 0.5], points=3).values.round(3)
    array([-0.026, -0.033, -0.045])
    """

    frame: Frame
    name: str  #: such as "stress" or "stress.xx"
    unit: str
    components: tuple[str, ...]  #: () of a scalar, ("xx", "yy", "xy", "zz") of plane stress
    bodies: tuple[str, ...]  #: names of those that have it; () all
    _coefficients: Floats  # of the nodes, shape (nodes, components)

    def __repr__(self) -> str:
        parts = f" ({' '.join(self.components)})" if self.components else ""
        return f"<field {self.name}{parts}{f' [{self.unit}]' if self.unit else ''} of frame {self.frame.index}>"

    def at_parameters(self, xi: ArrayLike, patch: int = 0) -> Floats:
        """Values at parameters of a patch: xi of shape (points, dim), or one point."""
        points, is_one = _points(xi, self.frame.dim, "xi")
        patches = self.frame.patches
        if not 0 <= patch < len(patches):
            raise Error(f"patch: found {patch}; the patches are 0 to {len(patches) - 1}")
        domain = patches[patch].domain
        inside = np.all((points >= domain[:, 0]) & (points <= domain[:, 1]), axis=1)
        if not np.all(inside):
            ranges = ", ".join(f"{low:g} to {high:g}" for low, high in domain)
            raise Error(f"xi: found {points[~inside][0].tolist()}; the parameters of patch {patch} go from {ranges}")
        return self._shown(self._at(Places(np.full(len(points), patch), points, np.zeros(len(points)))), is_one)

    def at_points(self, positions: ArrayLike) -> Floats:
        """Values at positions in the deformed body, as a picture shows it: shape (points, dim), or one point."""
        points, is_one = _points(positions, self.frame.dim, "positions")
        return self._shown(self._at(self.frame.locator.find(points)), is_one)

    def at_material(self, positions: ArrayLike) -> Floats:
        """Values at points of the material, named by their places in the undeformed body: shape (points, dim), or one point. In a
        body that is meshed anew the material is found as nearly as the new mesh can say."""
        points, is_one = _points(positions, self.frame.dim, "positions")
        return self._shown(self._at(self._of_material(points)), is_one)

    def on_line(self, begin: ArrayLike, end: ArrayLike, points: int = 401) -> Line:
        """Values at equal distances along the straight line between two positions in the deformed body."""
        (first,), _ = _points(begin, self.frame.dim, "begin")
        (last,), _ = _points(end, self.frame.dim, "end")
        if np.array_equal(first, last):
            raise Error(f"line: found {first.tolist()} twice; expected two points")
        if points < 2:
            raise Error(f"points: found {points}; expected 2 or more")
        shares = np.linspace(0.0, 1.0, points)
        positions = first + shares[:, None] * (last - first)
        positions[-1] = last
        places = self.frame.locator.find(positions)
        material = _evaluate(places, [(p, p.points) for p in self.frame.patches])
        distance = shares * float(np.linalg.norm(last - first))
        return Line(distance, positions, material, self._shown(self._at(places), False))

    def on_grid(self, subdivision: int = 1, patch: int = 0) -> Floats:
        """Values at the crossings of the knot lines of a patch, with each span cut into equal parts: shape (points of the first
        direction, of the second, ...), followed by the components of a vector or tensor. `Frame.grid` has the positions."""
        rows = self.frame.grid_rows(subdivision, patch)
        return self._shown(grid_shaped(self.lattice(patch, rows), rows), False)

    def lattice(self, patch: int, rows: Sequence[Floats]) -> Floats:
        """`Patch.lattice` of its coefficients: shape (points, components), also of a scalar."""
        return self.frame.patches[patch].lattice(self._coefficients_of(patch), rows)

    @cached_property
    def _has(self) -> list[bool]:
        """Whether each patch has the field."""
        names = self.frame.run.bodies
        return [not self.bodies or names[patch.body] in self.bodies for patch in self.frame.patches]

    def _coefficients_of(self, patch: int) -> Floats:
        """Of the functions of a patch."""
        of = self._coefficients[self.frame.patches[patch].nodes]
        return of if self._has[patch] else np.full_like(of, np.nan)

    def _at(self, places: Places) -> Floats:
        return _evaluate(places, [(p, self._coefficients_of(k)) for k, p in enumerate(self.frame.patches)])

    def _shown(self, values: Floats, is_one: bool) -> Floats:
        of_points: Floats = values if self.components else values[..., 0]
        if not is_one:
            return of_points
        of_one: Floats = of_points[0]
        return of_one

    def _of_material(self, positions: Floats) -> Places:
        undeformed = self.frame.run.locator
        places = undeformed.nearest(positions)
        places.patch[places.distance > _GIVEN_OUTSIDE * undeformed.size] = -1
        if not self.frame.is_remeshed:
            return places
        moved = Locator(self.frame.patches)
        inside = np.flatnonzero(places.patch >= 0)
        bodies = np.array([patch.body for patch in undeformed.patches])[places.patch[inside]]
        found = moved.nearest(positions[inside], bodies)
        found.patch[found.distance > _MOVED_OUTSIDE * undeformed.size] = -1
        places.patch[inside], places.xi[inside] = found.patch, found.xi
        return places


def _points(values: ArrayLike, dim: int, what: str) -> tuple[Floats, bool]:
    """As an array (points, dim), and whether a single point was given."""
    points = np.asarray(values, dtype=float)
    if points.size == 0:
        return np.empty((0, dim)), False
    if points.ndim not in (1, 2) or points.shape[-1] != dim:
        raise Error(f"{what}: found an array of shape {points.shape}; expected (points, {dim}) or ({dim},)")
    return np.atleast_2d(points), points.ndim == 1


def _evaluate(places: Places, patches: Sequence[tuple[Patch, Floats]]) -> Floats:
    """Values at places of (patch, coefficients of its functions): shape (points, components)."""
    values = np.full((len(places), patches[0][1].shape[1]), np.nan)
    for number, (patch, coefficients) in enumerate(patches):
        here = np.flatnonzero(places.patch == number)
        if here.size > 0:
            values[here] = patch.values(coefficients, places.xi[here])
    return values


def grid_shaped(values: Floats, rows: Sequence[Floats]) -> Floats:
    """Values of a lattice, first direction fastest, as an array with one axis per direction, the components last."""
    extents = [row.shape[0] for row in rows]
    shaped = values.reshape(*reversed(extents), values.shape[1])
    directions = list(range(len(rows)))
    return np.moveaxis(shaped, directions, directions[::-1])
