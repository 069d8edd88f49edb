"""Which parameters of which patch lie at a position."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from .splines import Floats, Integers, Patch

_MOST_STEPS = 15
_STARTS = 4
_ARRIVED = 1e-13  # of the size of a patch: where Newton's steps end
_INSIDE = 1e-9  # of the size of a patch: what counts as in it
_AT_ONCE = 1000  # positions, so that the table of their distances from the samples stays small
_BULGE = 0.25  # how far Lagrange elements may bulge out of the box around their nodes, as a share of its size


@dataclass(frozen=True)
class Places:
    """Places of a mesh, one per position."""

    patch: Integers  #: shape (points,); -1 where there is none
    xi: Floats  #: shape (points, dim)
    distance: Floats  #: from the position

    def __len__(self) -> int:
        return self.patch.size


class Locator:
    """Finds places in patches whose control points stand where they are given."""

    def __init__(self, patches: Sequence[Patch], displacement: Floats | None = None) -> None:
        """displacement: of the nodes, shape (nodes, dim); None: the undeformed body."""
        self.patches = [
            patch if displacement is None else replace(patch, points=patch.points + displacement[patch.nodes])
            for patch in patches
        ]

    @property
    def size(self) -> float:
        """Largest extent of all control points."""
        points = np.concatenate([patch.points for patch in self.patches])
        return float(np.ptp(points, axis=0).max())

    def find(self, positions: Floats) -> Places:
        """The place at each position, of the first patch that has it; none outside of all."""
        count, dim = positions.shape
        found = Places(np.full(count, -1), np.full((count, dim), np.nan), np.full(count, np.inf))
        for number, patch in enumerate(self.patches):
            margin = _BULGE * patch.size
            low, high = patch.points.min(axis=0) - margin, patch.points.max(axis=0) + margin
            open_ = np.flatnonzero((found.patch < 0) & np.all((positions >= low) & (positions <= high), axis=1))
            xi, distance = _closest(patch, positions[open_])
            inside = distance < _INSIDE * patch.size
            _take(found, open_[inside], number, xi[inside], distance[inside])
        return found

    def nearest(self, positions: Floats, bodies: Integers | None = None) -> Places:
        """The place nearest to each position; bodies: in which to look, one per position."""
        count, dim = positions.shape
        found = Places(np.full(count, -1), np.full((count, dim), np.nan), np.full(count, np.inf))
        for number, patch in enumerate(self.patches):
            of = np.arange(count) if bodies is None else np.flatnonzero(bodies == patch.body)
            xi, distance = _closest(patch, positions[of])
            nearer = distance < found.distance[of]
            _take(found, of[nearer], number, xi[nearer], distance[nearer])
        return found


def _take(places: Places, which: Integers, patch: int, xi: Floats, distance: Floats) -> None:
    places.patch[which] = patch
    places.xi[which] = xi
    places.distance[which] = distance


def _closest(patch: Patch, positions: Floats) -> tuple[Floats, Floats]:
    """Parameters of the closest points, from the middle of the patch or else from those of the nearest spans."""
    count = positions.shape[0]
    if count == 0:
        return np.empty((0, patch.dim)), np.empty(0)
    if count > _AT_ONCE:
        parts = [_closest(patch, part) for part in np.array_split(positions, -(-count // _AT_ONCE))]
        return np.concatenate([xi for xi, _ in parts]), np.concatenate([distance for _, distance in parts])
    domain = patch.domain
    xi, distance = _newton(patch, positions, np.tile(domain.mean(axis=1), (count, 1)))
    middles = [0.5 * (basis.breakpoints[:-1] + basis.breakpoints[1:]) for basis in patch.bases]
    samples = np.stack([grid.ravel() for grid in np.meshgrid(*middles, indexing="ij")], axis=1)
    at = patch.values(patch.points, samples)
    for start in range(min(_STARTS, len(samples))):
        todo = np.flatnonzero(distance >= _INSIDE * patch.size)
        if todo.size == 0:
            break
        apart = np.linalg.norm(positions[todo, None, :] - at[None, :, :], axis=2)
        nearest = np.argpartition(apart, start, axis=1)[:, start]
        better_xi, better = _newton(patch, positions[todo], samples[nearest])
        nearer = better < distance[todo]
        xi[todo[nearer]], distance[todo[nearer]] = better_xi[nearer], better[nearer]
    return xi, distance


def _newton(patch: Patch, positions: Floats, start: Floats) -> tuple[Floats, Floats]:
    """Gauss-Newton steps that stay in the patch; the best of all points on the way."""
    domain = patch.domain
    best_xi = start.copy()
    best = np.full(len(positions), np.inf)
    xi = start.copy()
    todo = np.arange(len(positions))
    for _ in range(_MOST_STEPS + 1):
        functions, R, dR = patch.shape(xi[todo])
        points = patch.points[functions]
        apart = positions[todo] - np.einsum("na,nac->nc", R, points)
        distance = np.linalg.norm(apart, axis=1)
        nearer = distance < best[todo]
        best[todo[nearer]], best_xi[todo[nearer]] = distance[nearer], xi[todo[nearer]]
        # The least-norm solution, because tangents vanish where an edge is collapsed.
        jacobian = np.einsum("nac,nad->ncd", points, dR)
        step = np.einsum("ndc,nc->nd", np.linalg.pinv(jacobian), apart)
        new = np.clip(xi[todo] + step, domain[:, 0], domain[:, 1])
        goes_on = (best[todo] > _ARRIVED * patch.size) & np.any(new != xi[todo], axis=1)
        xi[todo] = new
        todo = todo[goes_on]
        if todo.size == 0:
            break
    return best_xi, best
