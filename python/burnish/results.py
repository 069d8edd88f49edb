"""Results of runs, also of runs that go on: `open(directory)`. Everything is read when it is first asked for."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from .errors import Error, unknown_name
from .fields import Field, grid_shaped
from .places import Locator
from .splines import Basis, Floats, Integers, Patch

if TYPE_CHECKING:
    from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid

    from .meshes import Cells

_FORMAT = 2  # of the files
_AXES = ("x", "y", "z")
_LONGEST_NUMBER = 25  # bytes of a number of a history, with its comma


def open(result: str | os.PathLike[str]) -> Run:
    """The run in a directory, or of the result file in it. Throws `Error` if there is none."""
    return Run(result)


class Run:
    """A run, as its files have it.

    >>> import burnish
    >>> run = burnish.open("out/press")
    >>> run
    <run 'Disc on a block' in out/press, 2 dimensions, 3 frames>
    >>> run.tools, run.times.tolist(), run.has_ended
    (('disc',), [0.0, 0.5, 1.0], True)
    >>> run.summary["completed"], run.scene["material"]["nu"]
    (True, 0.3)
    """

    def __init__(self, result: str | os.PathLike[str]) -> None:
        path = Path(result)
        if not path.exists():
            raise Error(f"{path}: there is no such file or directory")
        if path.is_dir():
            path = path / "result.h5"
            if not path.exists():
                raise Error(f"{path.parent} holds no result.h5; give the directory of a run or the result file in it")
        self.file: Path = path  #: of the model
        with _File(path, "model") as root:
            self._id = root.text("model")
            self.program: str = root.text("program")  #: that computed it, such as "burnish 0.2.0 (engine 1a2b3c4d)"
            self.title: str = root.text("title")
            self.dim: int = root.integer("dim")  #: 2 or 3
            self.length_unit: str = root.text("length_unit")
            self.stress_unit: str = root.text("stress_unit")
            self.subdivision: int = root.integer("subdivision")  #: cells per knot span and direction in exports
            self.scene_text: str = root.string("scene")  #: the scene that was computed, as YAML, every default filled in
            patches = _patches(root, self.dim)
            #: Names of the bodies; () of one without a name.
            self.bodies: tuple[str, ...] = tuple(body.text("name") for body in root.groups("bodies"))
            of_bodies = [body.array("patches", 1) for body in root.groups("bodies")]
            self._body_of_patch = _body_numbers(len(patches), of_bodies, path)
            self.tools: tuple[str, ...] = tuple(tool.text("name") for tool in root.groups("tools"))  #: their names
            #: When tools are taken away, by name; of those that stay there is none.
            self.tool_until: dict[str, float] = {tool.text("name"): tool.real("until") for tool in root.groups("tools")
                                                 if tool.has_attribute("until")}
        self.patches = [_of_body(patch, body) for patch, body in zip(patches, self._body_of_patch)]  #: undeformed

    def __repr__(self) -> str:
        title = f" {self.title!r}" if self.title else ""
        return f"<run{title} in {self.directory}, {self.dim} dimensions, {len(self.frames)} frames>"

    def __fspath__(self) -> str:
        return os.fspath(self.file)

    @property
    def directory(self) -> Path:
        return self.file.parent

    @property
    def frames(self) -> Frames:
        """The frames that are complete now: `frames[0]`, `frames[-1]`, slices, loops."""
        return Frames(self)

    @property
    def times(self) -> Floats:
        """Of the frames."""
        return np.array([_frame_time(self, index) for index in range(len(self.frames))])

    def frame(self, time: float) -> Frame:
        """The frame of a time. Throws `Error` if there is none."""
        times = self.times
        near = np.flatnonzero(np.isclose(times, time, rtol=1e-9, atol=1e-12))
        if near.size == 0:
            raise Error(f"{self.file} has no frame at t = {time:g}; its frames are at {', '.join(f'{t:g}' for t in times)}")
        return self.frames[int(near[0])]

    @property
    def history(self) -> History:
        """history.csv as it is now."""
        return History(self.directory / "history.csv")

    @property
    def has_ended(self) -> bool:
        """Whether there is a summary: completed, or stopped before its end."""
        return self._summary_file.exists()

    @property
    def summary(self) -> dict[str, Any]:
        """What summary.yaml says. Throws `Error` while the run goes on."""
        if not self.has_ended:
            raise Error(f"{self._summary_file}: there is no such file; the run has not ended")
        return _document(self._summary_file.read_text(encoding="utf-8"))

    @property
    def scene(self) -> dict[str, Any]:
        """The scene that was computed, every default filled in."""
        return _document(self.scene_text)

    @property
    def is_axisymmetric(self) -> bool:
        return self.scene.get("kinematics") == "axisymmetric"

    @cached_property
    def locator(self) -> Locator:
        """Finds places in the undeformed body."""
        return Locator(self.patches)

    @property
    def _summary_file(self) -> Path:
        return self.directory / "summary.yaml"

    def _frame_file(self, index: int) -> Path:
        return self.file.with_suffix("") / f"frame_{index:06}.h5"


class Frames(Sequence["Frame"]):
    """The frames of a run, read one by one."""

    def __init__(self, run: Run) -> None:
        self._run = run
        self._count = 0
        while run._frame_file(self._count).exists():
            self._count += 1

    def __repr__(self) -> str:
        return f"<{self._count} frames of {self._run.file}>"

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, index: int) -> Frame: ...

    @overload
    def __getitem__(self, index: slice) -> list[Frame]: ...

    def __getitem__(self, index: int | slice) -> Frame | list[Frame]:
        if isinstance(index, slice):
            return [Frame(self._run, k) for k in range(*index.indices(self._count))]
        if not -self._count <= index < self._count:
            raise IndexError(
                f"{self._run.file} has no frame {index}; its frames are 0 to {self._count - 1}"
                if self._count else f"{self._run.file} has no frames yet")
        return Frame(self._run, index % self._count)


class Frame:
    """An output instant: displacements and fields on the mesh of this frame.

    >>> import burnish
    >>> frame = burnish.open("out/press").frame(time=0.5)
    >>> frame.index, frame.tool_displacement["disc"].tolist()
    (1, [0.0, -0.025])
    >>> frame.field("displacement.y")
    <field displacement.y [mm] of frame 1>
    >>> frame.grid().shape
    (24, 12, 2)
    """

    def __init__(self, run: Run, index: int) -> None:
        self.run = run
        self.index = index
        with _File(run._frame_file(index), "frame", run._id) as root:
            self.step: int = root.integer("step")  #: converged steps so far
            self.time: float = root.real("time")
            self.is_remeshed: bool = "mesh" in root  #: whether it has a mesh of its own
            patches = run.patches
            if self.is_remeshed:
                own = _patches(root.group("mesh"), run.dim)
                patches = [_of_body(patch, body) for patch, body in zip(own, run._body_of_patch)]
            self.patches = patches  #: undeformed: where the material of this mesh was at the start
            self._displacement = root.array("displacement", 2)
            tools = root.array("tool_displacement", 2)
            angles = root.array("tool_angle", 1) if "tool_angle" in root else np.zeros(0)
            self._stored = _fields(root.group("fields"), self._displacement.shape[0])
            #: What touches where, one entry for each contact pair.
            self.contact: tuple[Contact, ...] = tuple(_contact(group) for group in root.groups("contact"))
            self._quadrature = _quadrature(root.group("quadrature"))
        self.tool_displacement: dict[str, Floats] = dict(zip(run.tools, tools))  #: of the pivots, by name
        #: Turns of the tools about their axes, in radians, by name.
        self.tool_angle: dict[str, float] = dict(zip(run.tools, angles.tolist() or [0.0] * len(run.tools)))
        axes = _AXES[:run.dim]
        self._stored = {"displacement": _Stored(axes, run.length_unit, (), self._displacement), **self._stored}

    def __repr__(self) -> str:
        return f"<frame {self.index} of {self.run.file}, t = {self.time:g}, {', '.join(self._stored)}>"

    @property
    def dim(self) -> int:
        return self.run.dim

    @property
    def fields(self) -> list[str]:
        """Names for `field`: every field, and every component of one that has components."""
        return _names_of(self._stored)

    @property
    def arrays(self) -> list[tuple[str, tuple[str, ...]]]:
        """Names and components of the fields as a whole."""
        return [(name, stored.components) for name, stored in self._stored.items()]

    def field(self, name: str) -> Field:
        """A field, such as "von_mises", "stress", "stress.xx", "displacement". Throws `UnknownName` with those that exist."""
        stored = _chosen(self._stored, name)
        return Field(self, name, stored.unit, stored.components, stored.bodies, stored.values)

    @property
    def quadrature(self) -> QuadraturePoints:
        """What the solver has at its points, not projected."""
        return self._quadrature

    @cached_property
    def locator(self) -> Locator:
        """Finds places in the deformed body."""
        return Locator(self.patches, self._displacement)

    def grid_rows(self, subdivision: int, patch: int) -> list[Floats]:
        """Values of the functions of each direction at the crossings of knot lines."""
        if not 0 <= patch < len(self.patches):
            raise Error(f"patch: found {patch}; the patches are 0 to {len(self.patches) - 1}")
        if subdivision < 1:
            raise Error(f"subdivision: found {subdivision}; expected at least 1 cell per knot span")
        return [basis.values_at(basis.subdivided(subdivision)) for basis in self.patches[patch].bases]

    def grid(self, subdivision: int = 1, patch: int = 0, deformed: bool = True) -> Floats:
        """Positions of the crossings of the knot lines of a patch, for `Field.on_grid`: shape (points of the first direction, of
        the second, ..., dim)."""
        rows = self.grid_rows(subdivision, patch)
        of = self.locator.patches[patch] if deformed else self.patches[patch]
        return grid_shaped(of.lattice(of.points, rows), rows)

    def mesh(self, cells: Cells = "bezier", subdivision: int | None = None, body: str | None = None,
             deformed: bool = True) -> vtkUnstructuredGrid:
        """The bodies with all fields as point data, named as in the VTU files of `burnish export`.

        cells: "bezier", rational cells that are exactly what was computed, one per knot span, whose point data are coefficients;
        "lagrange", curved through values; "linear", straight ones, `subdivision` of them per span and direction. body: its name,
        for one of several. PyVista takes it with `pyvista.wrap`."""
        from .meshes import make_mesh

        return make_mesh(self, cells, subdivision, body, deformed)


class History(Mapping[str, "Floats"]):
    """The columns of history.csv, one row per converged step; a row that is not finished is left out.

    >>> import burnish
    >>> history = burnish.open("out/press").history
    >>> history.num_rows, history["disc.fy"].round(4)
    (5, array([0.    , 0.0062, 0.014 , 0.0228, 0.0327]))
    """

    def __init__(self, file: str | os.PathLike[str]) -> None:
        self.file = Path(file)

    def __repr__(self) -> str:
        return f"<history of {self.num_rows} rows: {', '.join(self.columns)}>"

    @property
    def columns(self) -> list[str]:
        return list(self._table)

    @property
    def num_rows(self) -> int:
        return next((column.size for column in self._table.values()), 0)

    def __len__(self) -> int:
        return len(self._table)

    def __iter__(self) -> Iterator[str]:
        return iter(self._table)

    def __getitem__(self, column: str) -> Floats:
        if column not in self._table:
            raise unknown_name("column", column, self._table)
        return self._table[column]

    @cached_property
    def _table(self) -> dict[str, Floats]:
        try:
            text = self.file.read_text(encoding="utf-8")
        except FileNotFoundError:
            raise Error(f"{self.file}: there is no such file") from None
        lines = text[:text.rfind("\n") + 1].splitlines()
        if not lines:
            return {}
        columns = lines[0].split(",")
        rows = [line.split(",") for line in lines[1:]]
        for number, row in enumerate(rows, start=2):
            if len(row) != len(columns):
                raise Error(f"{self.file}:{number}: found {len(row)} entries; expected one for each of {len(columns)} columns")
        try:
            values = np.array(rows, dtype=float).reshape(len(rows), len(columns))
        except ValueError as error:
            raise Error(f"{self.file}: {error}") from None
        values.flags.writeable = False
        return dict(zip(columns, values.T))


def last_row(file: Path) -> dict[str, float]:
    """The last row of a history that is finished, by columns, without reading the others."""
    with file.open("rb") as table:
        header = table.readline()
        end = table.seek(0, os.SEEK_END)
        columns = header.decode("utf-8").rstrip("\n").split(",")
        table.seek(max(len(header), end - 2 * _LONGEST_NUMBER * len(columns)))
        row = table.read().decode("utf-8").rsplit("\n", 2)[-2]
    return dict(zip(columns, map(float, row.split(","))))


@dataclass(frozen=True, eq=False)
class Contact:
    """What the solver has at the quadrature points of a face in contact."""

    tool: str  #: name of the tool; "" in contact with a face
    pair: str  #: name of the pair of faces; "" in contact with a tool
    face: str
    patch: int
    points: Floats  #: current positions, shape (points, dim)
    pressure: Floats  #: nominal, positive in compression, shape (points,)
    gap: Floats  #: shape (points,)
    normal: Floats  #: of the tool or the other face, away from it, shape (points, dim)
    friction: Floats | None  #: with friction: nominal tangential traction on the body, shape (points, dim)
    slip: Floats | None  #: with friction: way on the tool in the last step, shape (points, dim)
    sliding: Integers | None  #: with friction: 0 open, 1 stick, 2 slip

    def __repr__(self) -> str:
        return f"<contact of {self.tool or self.pair} on {self.face}: {len(self.points)} points, {(self.pressure > 0).sum()} pressed>"


@dataclass(frozen=True, eq=False)
class QuadraturePoints:
    """Values at the quadrature points of the bodies."""

    points: Floats  #: current positions, shape (points, dim)
    _stored: dict[str, _Stored]

    def __repr__(self) -> str:
        return f"<{len(self.points)} quadrature points, {', '.join(self._stored)}>"

    @property
    def fields(self) -> list[str]:
        return _names_of(self._stored)

    def field(self, name: str) -> Floats:
        """Shape (points,), or (points, components) of a vector or tensor. Zeros stand for bodies that do not have the field."""
        stored = _chosen(self._stored, name)
        return stored.values if stored.components else stored.values[:, 0]


@dataclass(frozen=True, eq=False)
class _Stored:
    """A field as it is in a file."""

    components: tuple[str, ...]
    unit: str
    bodies: tuple[str, ...]
    values: Floats  # (nodes or points, components)


def _names_of(stored: Mapping[str, _Stored]) -> list[str]:
    return [text for name, field in stored.items() for text in (name, *(f"{name}.{c}" for c in field.components))]


def _chosen(stored: Mapping[str, _Stored], name: str) -> _Stored:
    """A field, or one component of it as a scalar."""
    if name in stored:
        return stored[name]
    of, _, component = name.rpartition(".")
    if of not in stored or component not in stored[of].components:
        raise unknown_name("field", name, _names_of(stored))
    field = stored[of]
    column = field.components.index(component)
    return _Stored((), field.unit, field.bodies, field.values[:, column:column + 1])


def _document(text: str) -> dict[str, Any]:
    from .documents import document

    return document(text)


def _of_body(patch: Patch, body: int) -> Patch:
    from dataclasses import replace

    return replace(patch, body=body)


class _Group:
    """A group of a file. What is missing or of another shape throws `Error` with file and place."""

    def __init__(self, group: Any, path: Path) -> None:
        self._group = group
        self._path = path

    def __contains__(self, name: str) -> bool:
        return name in self._group

    def has_attribute(self, name: str) -> bool:
        return name in self._group.attrs

    def group(self, name: str) -> _Group:
        return _Group(self._get(name), self._path)

    def groups(self, name: str) -> list[_Group]:
        """Those named 0, 1, ... of a group; none without it."""
        if name not in self._group:
            return []
        of = self.group(name)
        return [of.group(str(k)) for k in range(len(of._group))]

    def names(self) -> list[str]:
        return sorted(self._group)

    def text(self, name: str) -> str:
        value = self._attribute(name)
        return value.decode("utf-8") if isinstance(value, bytes) else str(value)

    def texts(self, name: str) -> tuple[str, ...]:
        return tuple(value.decode("utf-8") for value in self._attribute(name))

    def integer(self, name: str) -> int:
        return int(self._attribute(name))

    def real(self, name: str) -> float:
        return float(self._attribute(name))

    def string(self, name: str) -> str:
        return bytes(self._get(name)[()]).decode("utf-8")

    def array(self, name: str, axes: int) -> Any:
        data = self._get(name)
        if data.ndim != axes:
            raise self.error(f"{name} has {data.ndim} axes instead of {axes}")
        try:
            return data[()]
        except OSError as error:
            raise self.error(f"{name} cannot be read; the file is damaged ({error})") from None

    def error(self, text: str) -> Error:
        return Error(f"{self._path}, {self._group.name}: {text}")

    def _get(self, name: str) -> Any:
        if name not in self._group:
            raise self.error(f"{name} is missing")
        return self._group[name]

    def _attribute(self, name: str) -> Any:
        if name not in self._group.attrs:
            raise self.error(f"attribute {name} is missing")
        return self._group.attrs[name]


class _File:
    """A file of a result, open while it is read; its kind, format and run are checked."""

    def __init__(self, path: Path, kind: str, run: str | None = None) -> None:
        self._path, self._kind, self._run = path, kind, run

    def __enter__(self) -> _Group:
        import h5py

        try:
            self._file = h5py.File(self._path, "r")
        except OSError as error:
            raise Error(f"{self._path} cannot be read as HDF5: {error}") from None
        try:
            root = _Group(self._file, self._path)
            self._check(root)
        except BaseException:
            self._file.close()
            raise
        return root

    def __exit__(self, *_: object) -> None:
        self._file.close()

    def _check(self, root: _Group) -> None:
        if not root.has_attribute("burnish_format"):
            raise Error(f"{self._path} is an HDF5 file, but no result of burnish (it has no burnish_format)")
        if (found := root.integer("burnish_format")) != _FORMAT:
            raise Error(f"{self._path} has result format {found}, but this version reads format {_FORMAT}; use the version that "
                        "wrote it")
        if (kind := root.text("kind")) != self._kind:
            raise Error(f"{self._path} is the {kind} file of a result where its {self._kind} file is expected")
        if self._run is not None and root.text("model") != self._run:
            raise Error(f"{self._path} belongs to another run than the result file beside it; run the scene again")


def _frame_time(run: Run, index: int) -> float:
    with _File(run._frame_file(index), "frame", run._id) as root:
        return root.real("time")


def _patches(root: _Group, dim: int) -> list[Patch]:
    return [_patch(group, dim) for group in root.groups("patches")]


def _patch(group: _Group, dim: int) -> Patch:
    bases = []
    for d in range(dim):
        knots = group.group(f"knots_{d}")
        family = knots.text("family")
        if family not in ("bspline", "lagrange"):
            raise group.error(f'family "{family}" is neither bspline nor lagrange')
        bases.append(Basis(family, knots.integer("degree"), group.array(f"knots_{d}", 1)))
    points, weights = group.array("points", 2), group.array("weights", 1)
    nodes = group.array("nodes", 1).astype(np.int64)
    functions = int(np.prod([basis.num_functions for basis in bases]))
    if points.shape != (functions, dim) or weights.shape != (functions,) or nodes.shape != (functions,):
        raise group.error(f"{functions} basis functions, but {len(points)} control points, {weights.size} weights and "
                          f"{nodes.size} nodes")
    return Patch(tuple(bases), points, weights, nodes)


def _body_numbers(count: int, of_bodies: Sequence[Integers], path: Path) -> list[int]:
    """Number of the body of each patch."""
    numbers = [0] * count
    for body, patches in enumerate(of_bodies):
        for patch in patches.tolist():
            if not 0 <= patch < count:
                raise Error(f"{path}: patch {patch} of {count}")
            numbers[patch] = body
    return numbers


def _fields(group: _Group, count: int) -> dict[str, _Stored]:
    fields = {}
    for name in group.names():
        data = group.group(name)
        values = group.array(name, 2)
        components = data.texts("components")
        if values.shape != (count, max(1, len(components))):
            raise group.error(f"field {name} has values of shape {values.shape} instead of {(count, max(1, len(components)))}")
        bodies = data.texts("bodies") if data.has_attribute("bodies") else ()
        fields[name] = _Stored(components, data.text("unit"), bodies, values)
    return fields


def _contact(group: _Group) -> Contact:
    rubs = "quadrature_sliding" in group
    return Contact(
        tool=group.text("tool"),
        pair=group.text("pair") if group.has_attribute("pair") else "",
        face=group.text("face"),
        patch=group.integer("patch"),
        points=group.array("quadrature_points", 2),
        pressure=group.array("quadrature_pressure", 1),
        gap=group.array("quadrature_gap", 1),
        normal=group.array("quadrature_normal", 2),
        friction=group.array("quadrature_friction", 2) if rubs else None,
        slip=group.array("quadrature_slip", 2) if rubs else None,
        sliding=group.array("quadrature_sliding", 1).astype(np.int64) if rubs else None)


def _quadrature(group: _Group) -> QuadraturePoints:
    points = group.array("positions", 2)
    return QuadraturePoints(points, _fields(group.group("fields"), points.shape[0]))
