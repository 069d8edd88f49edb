"""Scenes: read, changed, checked and computed in this process."""

from __future__ import annotations

import json
import operator
import os
import re
import tempfile
import warnings
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from . import command
from .documents import document
from .errors import Error, UnknownName, unknown_name
from .results import Run, last_row

_MOST_THREADS = 1024  # as the command has it


@dataclass(frozen=True, eq=False)
class Step:
    """A converged step of a run that goes on."""

    number: int
    time: float
    end_time: float  #: of the run
    iterations: int  #: of Newton's method, in this step
    cut_backs: int  #: of all steps so far
    directory: Path  #: of the run

    @cached_property
    def history(self) -> dict[str, float]:
        """The row of history.csv, by columns."""
        return last_row(self.directory / "history.csv")


class RunStopped(Error):
    """A run that did not reach its end; what it has computed is in `run`."""

    def __init__(self, message: str, run: Run) -> None:
        super().__init__(message)
        self.run = run


class Scene:
    """A scene from a file, or from a mapping with the same keys. Files that a mapping names are those of the working directory.

    >>> import burnish
    >>> scene = burnish.Scene("press.yaml")
    >>> scene["material.E"] = 2
    >>> scene.set("degree=3")
    <scene press.yaml, material.E=2, degree=3>
    >>> scene["material.E"], scene["solver.tolerance"]
    (2, 1e-09)
    >>> del scene["degree"]
    >>> scene
    <scene press.yaml, material.E=2>
    """

    def __init__(self, source: str | os.PathLike[str] | Mapping[str, Any]) -> None:
        self.file: Path | None = None  #: None of a mapping
        if isinstance(source, Mapping):
            self._yaml = json.dumps(_plain(source), ensure_ascii=False, indent=1)
        else:
            self.file = Path(source)
            try:
                self._yaml = self.file.read_text(encoding="utf-8")
            except OSError as error:
                raise Error(f"{self.file}: cannot be read: {error.strerror}") from None
            except UnicodeDecodeError:
                raise Error(f"{self.file}: cannot be read: it is no text in UTF-8") from None
        self._changes: list[str] = []
        self._resolved: str | None = None  # the document with every default filled in, once it was checked

    def __repr__(self) -> str:
        return f"<scene {self.file or 'of a mapping'}{''.join(f', {change}' for change in self._changes)}>"

    def set(self, *changes: str) -> Scene:
        """Changes entries as `--set` of the command does: "material.E=2000", "basis=lagrange". Returns the scene."""
        for change in changes:
            if "=" not in change:
                raise Error(f'set: found "{change}"; expected path=value, such as "degree=3"')
        self._changes += changes
        self._resolved = None
        return self

    def __setitem__(self, path: str, value: Any) -> None:
        """Changes an entry: scene["tools[0].radius"] = 0.25. Values are numbers, texts, lists and mappings."""
        self.set(f"{path}={json.dumps(_plain(value), ensure_ascii=False)}")

    def __delitem__(self, path: str) -> None:
        """Takes back what was changed of an entry: after del scene["material.E"] it is as the file or the mapping has it."""
        changed = [change.partition("=")[0] for change in self._changes]
        if path not in changed:
            raise unknown_name("change", path, changed)
        self._changes = [change for change, its_path in zip(self._changes, changed) if its_path != path]
        self._resolved = None

    def __getitem__(self, path: str) -> Any:
        """An entry of the checked scene, defaults among them: scene["solver.tolerance"]."""
        value: Any = self.resolved
        for part in re.findall(r"[^.\[\]]+|\[\d+\]", path):
            if part.startswith("["):
                number = int(part[1:-1])
                if not isinstance(value, list) or number >= len(value):
                    raise UnknownName(f'"{path}": there is no entry {part}')
                value = value[number]
            elif isinstance(value, Mapping) and part in value:
                value = value[part]
            else:
                raise unknown_name(f'"{path}"', part, value if isinstance(value, Mapping) else ())
        return value

    def __contains__(self, path: str) -> bool:
        try:
            self[path]
        except UnknownName:
            return False
        return True

    @property
    def resolved(self) -> dict[str, Any]:
        """The whole scene with every default filled in. Throws `Error` with everything that is wrong.

        >>> Scene("press.yaml").resolved["geometry"]
        {'shape': 'rectangle', 'origin': [0, 0], 'size': [2, 1], 'functions': [25, 13]}
        """
        return document(self._checked())

    def validate(self) -> list[str]:
        """Checks the scene and builds its model without computing it; returns warnings. Throws `Error` with a line for everything
        that is wrong, as `burnish validate` prints it."""
        arguments = ["validate", "--json", *(f"--set={change}" for change in self._changes)]
        try:
            if self.file is None:
                printed = command.call([*arguments, "-"], text=self._yaml)
            else:
                printed = command.call([*arguments, str(self.file)])
        except Error as error:  # a mapping has no lines to be named
            raise Error(re.sub(r"^standard input:\d+:\d+: ", "", str(error), flags=re.MULTILINE)) from None
        verdict = json.loads(printed)
        self._resolved = verdict["yaml"]
        return list(verdict["warnings"])

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes the whole scene with every default filled in."""
        Path(file).write_text(self._checked(), encoding="utf-8")

    def run(self, directory: str | os.PathLike[str] | None = None, on_step: Callable[[Step], object] | None = None,
            threads: int = 0) -> Run:
        """Computes the scene in this process and returns its results, which lie in the directory: those that `burnish run` writes,
        bit for bit. Pictures, probes and VTU files of the scene are left to `burnish.render` and `Frame.mesh`.

        directory: a new temporary one when left out. on_step is called after every converged step; what it raises, and Ctrl+C, ends
        the run after this step, with everything computed so far saved, so that `resume` can go on with it. threads: all of the
        machine for 0; results do not depend on it. Warnings are issued as `UserWarning`. Throws `Error` for what is wrong with
        the scene, and `RunStopped` if the run does not reach its end.

        >>> def show(step):
        ...     print(f"step {step.number}, t = {step.time:g}: force {step.history['disc.fy']:.4f}")
        >>> run = Scene("press.yaml").run("out/told", on_step=show)
        step 1, t = 0.25: force 0.0062
        step 2, t = 0.5: force 0.0140
        step 3, t = 0.75: force 0.0228
        step 4, t = 1: force 0.0327
        """
        resolved = self._checked()
        target = Path(tempfile.mkdtemp(prefix="burnish-") if directory is None else directory)
        _require_ours(target)
        return _compute(self._yaml, str(self.file or "standard input"), self._changes, resolved, target, False, on_step, threads)

    def _checked(self) -> str:
        if self._resolved is None:
            self.validate()
        assert self._resolved is not None
        return self._resolved


def resume(directory: str | os.PathLike[str], on_step: Callable[[Step], object] | None = None, threads: int = 0) -> Run:
    """Goes on with the run that was stopped in a directory, as if it had never been. Arguments as for `Scene.run`. Throws `Error` if
    there is nothing to go on with."""
    run = Run(directory)
    scene = run.scene_text
    return _compute(scene, str(run.file), [], scene, run.directory, True, on_step, threads)


def _compute(text: str, name: str, changes: Iterable[str], resolved: str, directory: Path, resumes: bool,
             on_step: Callable[[Step], object] | None, threads: int) -> Run:
    engine = _engine()
    if not 0 <= operator.index(threads) <= _MOST_THREADS:
        raise Error(f"threads: found {threads}; expected a number from 1 to {_MOST_THREADS}, or 0 for all of the machine")

    def step(number: int, time: float, end_time: float, iterations: int, cut_backs: int) -> None:
        assert on_step is not None
        on_step(Step(number, time, end_time, iterations, cut_backs, directory))

    stopped = engine.run(
        yaml=text, name=name, overrides=list(changes), resolved=resolved, frames=_times_wanted(resolved),
        directory=str(directory), threads=threads, resumes=resumes, on_step=None if on_step is None else step,
        on_warning=lambda warning: warnings.warn(warning, stacklevel=4))
    run = Run(directory)
    if stopped:
        raise RunStopped(f"the run did not reach its end: {stopped}; the results up to there are kept", run)
    return run


def _times_wanted(resolved: str) -> list[float]:
    """Of frames for the pictures and probes of a scene."""
    scene = document(resolved)
    return [float(time) for kind in ("pictures", "probes") for entry in scene.get(kind) or [] for time in entry.get("times") or []]


def _engine() -> Any:
    try:
        if (Path(__file__).parent / "newer").exists() and {"avx2", "fma", "bmi2"} <= _processor_features():
            from .newer import _engine as engine  # as the command does, or bits would differ
        else:
            from . import _engine as engine
    except ImportError as error:
        raise Error(f"the engine is not there ({error}): this package was installed without its compiled part, which "
                    "-DBURNISH_PYTHON_MODULE=ON builds; `burnish run` computes, and burnish.open reads") from None
    return engine


def _processor_features() -> set[str]:
    with open("/proc/cpuinfo", encoding="ascii", errors="replace") as about:
        return next((set(line.split()) for line in about if line.startswith("flags")), set())


def _require_ours(directory: Path) -> None:
    """Refuses a directory in which a run would overwrite what is not of a run, or leave what it does not renew."""
    if (directory / "result.h5").exists():
        for stale in ("pictures", "probes", "frames.pvd"):
            if (directory / stale).exists():
                raise Error(f"{directory / stale} is of an earlier run and would not be renewed; remove it, or choose another "
                            "directory")
        return
    for name in ("history.csv", "convergence.csv", "summary.yaml"):
        if (directory / name).exists():
            raise Error(f"{directory / name} is not of a run of burnish and would be overwritten; choose another directory, or move "
                        "it away")


def _plain(value: Any) -> Any:
    """Numbers of numpy, arrays and paths as what YAML knows."""
    if isinstance(value, Mapping):
        return {str(key): _plain(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(entry) for entry in value]
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    return value
