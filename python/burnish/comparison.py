"""Pictures and results held against baselines, by `burnish compare`."""

from __future__ import annotations

import json
import os
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import command
from .picture import Picture


@dataclass(frozen=True)
class Verdict:
    """On one picture or field."""

    name: str
    verdict: str  #: "equal", "different", "sizes-differ", "blank", "no-baseline", "no-actual", ...
    message: str  #: how much differs, and where
    data: dict[str, Any]  #: all that `burnish compare --json` says

    @property
    def is_equal(self) -> bool:
        return self.verdict == "equal"


@dataclass(frozen=True)
class Comparison:
    """What has become of a comparison; true if everything is equal."""

    verdicts: tuple[Verdict, ...]

    def __bool__(self) -> bool:
        return self.is_equal

    def __repr__(self) -> str:
        return f"<comparison: {'equal' if self.is_equal else self.message}>"

    @property
    def is_equal(self) -> bool:
        return all(verdict.is_equal for verdict in self.verdicts)

    @property
    def differing(self) -> tuple[Verdict, ...]:
        return tuple(verdict for verdict in self.verdicts if not verdict.is_equal)

    @property
    def message(self) -> str:
        """A line for everything that differs."""
        return "\n".join(f"{verdict.name}: {verdict.message}" for verdict in self.differing)


def compare(actual: Picture | str | os.PathLike[str], baseline: Picture | str | os.PathLike[str], **options: Any) -> Comparison:
    """Compares pictures (also directories of them), results, or files of other programs.

    options: those of `burnish compare` with underscores, such as threshold=0.1, metric="delta-e", diff="diff.png", report="page",
    relative=1e-4. Throws `Error` for what cannot be compared.

    >>> import burnish
    >>> first, last = (burnish.render("out/press", frame=frame, size=(400, 300)) for frame in (0, "last"))
    >>> burnish.compare(last, last)
    <comparison: equal>
    >>> verdict, = burnish.compare(last, first).verdicts
    >>> verdict.verdict, verdict.is_equal
    ('different', False)
    """
    with tempfile.TemporaryDirectory(prefix="burnish-") as scratch:
        files = [_file(of, Path(scratch) / name) for of, name in ((actual, "actual.png"), (baseline, "baseline.png"))]
        printed = command.call(["compare", *files, "--json", *command.options_of(options)], fine=(0, 1))
    return Comparison(tuple(Verdict(entry["name"], entry["verdict"], entry["message"], entry) for entry in json.loads(printed)))


def _file(of: Picture | str | os.PathLike[str], scratch: Path) -> str:
    if not isinstance(of, Picture):
        return os.fspath(of)
    of.save(scratch)
    return os.fspath(scratch)
