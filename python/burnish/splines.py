"""Bases and patches: values of rational basis functions at many points at once.

On each knot span a basis is a list of p + 1 functions N = C B, with the Bernstein polynomials B of that span and an
extraction matrix C; B-splines and Lagrange elements differ in C alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


def bernstein(degree: int, s: ArrayLike) -> Floats:
    """Bernstein polynomials at shares s of their interval: shape (points, degree + 1).

    >>> bernstein(2, [0.0, 0.5])
    array([[1.  , 0.  , 0.  ],
           [0.25, 0.5 , 0.25]])
    """
    share = np.asarray(s, dtype=float)
    rest = 1.0 - share
    values = np.zeros((share.size, degree + 1))
    values[:, 0] = 1.0
    for p in range(1, degree + 1):
        for i in range(p, 0, -1):
            values[:, i] = rest * values[:, i] + share * values[:, i - 1]
        values[:, 0] *= rest
    return values


def bernstein_slopes(degree: int, s: ArrayLike) -> Floats:
    """Their derivatives with respect to the share: shape (points, degree + 1)."""
    lower = bernstein(degree - 1, s) if degree > 0 else np.zeros((np.size(s), 0))
    slopes = np.zeros((np.size(s), degree + 1))
    slopes[:, 1:] += degree * lower
    slopes[:, :-1] -= degree * lower
    return slopes


def _spline_extraction(knots: Floats, p: int, i: int) -> Floats:
    """Bernstein coefficients of the p + 1 B-splines on knot interval i, one row per function: their blossoms."""
    a, b = knots[i], knots[i + 1]
    columns = []
    for j in range(p + 1):
        N = np.zeros(p + 1)
        N[0] = 1.0
        for k in range(1, p + 1):
            x = a if k <= p - j else b
            saved = 0.0
            for r in range(k):
                right, left = knots[i + r + 1], knots[i + r + 1 - k]
                term = N[r] / (right - left)
                N[r] = saved + (right - x) * term
                saved = (x - left) * term
            N[k] = saved
        columns.append(N)
    return np.stack(columns, axis=1)


@dataclass(frozen=True, eq=False)
class Basis:
    """A basis of one parametric direction."""

    family: str  #: "bspline" or "lagrange"
    degree: int
    knots: Floats  #: knot vector of B-splines, breakpoints of Lagrange elements

    @cached_property
    def breakpoints(self) -> Floats:
        """Ends of the knot spans, in ascending order."""
        return np.unique(self.knots)

    @property
    def num_spans(self) -> int:
        return self.breakpoints.size - 1

    @property
    def num_functions(self) -> int:
        if self.family == "lagrange":
            return self.degree * self.num_spans + 1
        return self.knots.size - self.degree - 1

    @cached_property
    def first_functions(self) -> Integers:
        """The first function that lives on each span."""
        if self.family == "lagrange":
            return self.degree * np.arange(self.num_spans)
        return np.flatnonzero(np.diff(self.knots) > 0) - self.degree

    @cached_property
    def extraction(self) -> Floats:
        """Shape (spans, degree + 1, degree + 1)."""
        p = self.degree
        if self.family == "lagrange":
            nodal = bernstein(p, np.arange(p + 1) / p).T
            return np.broadcast_to(np.linalg.inv(nodal), (self.num_spans, p + 1, p + 1))
        return np.stack([_spline_extraction(self.knots, p, i + p) for i in self.first_functions])

    def spans_of(self, xi: Floats) -> Integers:
        """The span of each parameter; the end spans outside of the domain."""
        return np.clip(np.searchsorted(self.breakpoints, xi, side="right") - 1, 0, self.num_spans - 1)

    def evaluate(self, xi: Floats) -> tuple[Integers, Floats, Floats]:
        """First function, values and slopes, the last two of shape (points, degree + 1)."""
        span = self.spans_of(xi)
        begin, end = self.breakpoints[span], self.breakpoints[span + 1]
        s = (xi - begin) / (end - begin)
        C = self.extraction[span]
        values = np.einsum("nij,nj->ni", C, bernstein(self.degree, s))
        slopes = np.einsum("nij,nj->ni", C, bernstein_slopes(self.degree, s)) / (end - begin)[:, None]
        return self.first_functions[span], values, slopes

    def subdivided(self, subdivision: int) -> Floats:
        """Parameters that cut every span into equal parts, both ends of the domain included.

        >>> Basis("lagrange", 1, np.array([0.0, 1.0, 3.0])).subdivided(2)
        array([0. , 0.5, 1. , 2. , 3. ])
        """
        shares = np.arange(subdivision) / subdivision
        begin, end = self.breakpoints[:-1, None], self.breakpoints[1:, None]
        return np.append((begin + (end - begin) * shares).ravel(), self.breakpoints[-1])

    def values_at(self, xi: Floats) -> Floats:
        """Matrix of all functions at parameters: shape (points, functions)."""
        first, values, _ = self.evaluate(xi)
        matrix = np.zeros((xi.size, self.num_functions))
        np.put_along_axis(matrix, first[:, None] + np.arange(self.degree + 1), values, axis=1)
        return matrix

    def bernstein_rows(self) -> Floats:
        """Matrix that turns coefficients into those of the Bernstein polynomials of all spans, which share their ends:
        shape (spans * degree + 1, functions)."""
        p = self.degree
        matrix = np.zeros((self.num_spans * p + 1, self.num_functions))
        for span, first in enumerate(self.first_functions):
            matrix[span * p:span * p + p + 1, first:first + p + 1] = self.extraction[span].T
        return matrix


@dataclass(frozen=True, eq=False)
class Patch:
    """A rational tensor product. Functions are numbered with the first direction fastest."""

    bases: tuple[Basis, ...]
    points: Floats  #: control points of the undeformed body, shape (functions, dim), not multiplied by the weights
    weights: Floats  #: shape (functions,)
    nodes: Integers  #: node of each function; patches that share a face share nodes
    body: int = 0  #: number of the body that it belongs to

    @property
    def dim(self) -> int:
        return len(self.bases)

    @property
    def size(self) -> float:
        """Largest extent of the control points."""
        return float(np.ptp(self.points, axis=0).max())

    @property
    def domain(self) -> Floats:
        """Begin and end of the parameters: shape (dim, 2)."""
        return np.array([[basis.breakpoints[0], basis.breakpoints[-1]] for basis in self.bases])

    def shape(self, xi: Floats) -> tuple[Integers, Floats, Floats]:
        """Functions that live at parameters (points, dim), their values R, both of shape (points, n), and their
        derivatives (points, n, dim)."""
        count, P = xi.shape
        functions = np.zeros((count, 1), dtype=np.int64)
        N = np.ones((count, 1, P + 1))  # values, then derivatives in each direction
        stride = 1
        for d, basis in enumerate(self.bases):
            first, values, slopes = basis.evaluate(xi[:, d])
            here = (first[:, None] + np.arange(basis.degree + 1)) * stride
            functions = (here[:, :, None] + functions[:, None, :]).reshape(count, -1)
            factors = np.repeat(values[:, :, None], P + 1, axis=2)
            factors[:, :, d + 1] = slopes
            N = (factors[:, :, None, :] * N[:, None, :, :]).reshape(count, -1, P + 1)
            stride *= basis.num_functions
        N *= self.weights[functions][:, :, None]
        W = N.sum(axis=1, keepdims=True)
        R = N[:, :, 0] / W[:, :, 0]
        dR = (N[:, :, 1:] - R[:, :, None] * W[:, :, 1:]) / W[:, :, :1]
        return functions, R, dR

    def values(self, coefficients: Floats, xi: Floats) -> Floats:
        """The sum of R_A c_A: coefficients (functions, components) to values (points, components)."""
        functions, R, _ = self.shape(xi)
        values: Floats = np.einsum("na,nac->nc", R, coefficients[functions])
        return values

    def lattice(self, coefficients: Floats, rows: Sequence[Floats]) -> Floats:
        """The same at a tensor product of points, given by a matrix (points, functions) per direction: shape
        (points, components), first direction fastest. Rows of Bernstein polynomials give rational coefficients."""
        W = _contract(self.weights[:, None], rows)
        return _contract(coefficients * self.weights[:, None], rows) / W

    def lattice_weights(self, rows: Sequence[Floats]) -> Floats:
        return _contract(self.weights[:, None], rows)[:, 0]


def _contract(coefficients: Floats, rows: Sequence[Floats]) -> Floats:
    """Applies a matrix in every direction to (functions, components)."""
    components = coefficients.shape[1]
    extents = [row.shape[1] for row in reversed(rows)]
    values: Floats = coefficients.reshape(*extents, components)
    for d, row in enumerate(rows):
        axis = len(rows) - 1 - d
        values = np.moveaxis(np.tensordot(row, values, axes=(1, axis)), 0, axis)
    return values.reshape(-1, components)
