"""The command `burnish`, in a process of its own: what draws, compares and checks."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from collections.abc import Iterable, Mapping
from typing import Any

from .errors import Error

_BAD_INPUT = 2


def program() -> str:
    """The command: that of the environment variable BURNISH_PROGRAM, else the one in PATH."""
    found = shutil.which(os.environ.get("BURNISH_PROGRAM", "burnish"))
    if found is None:
        raise Error("the command burnish was not found; put it in PATH, or its name into the environment variable BURNISH_PROGRAM")
    return found


def call(arguments: Iterable[str], text: str | None = None, fine: Iterable[int] = (0,)) -> bytes:
    """What the command prints, which reads the text if one is given. Throws `Error` with its message for exit codes that are not
    fine."""
    given = subprocess.DEVNULL if text is None else None
    done = subprocess.run([program(), *arguments], stdin=given, input=None if text is None else text.encode("utf-8"),
                          capture_output=True, check=False)
    if done.returncode not in fine:
        message = done.stderr.decode("utf-8", "replace").strip().removeprefix("burnish: ")
        message = re.sub(r"^--([\w-]+):", lambda option: option[1].replace("-", "_") + ":", message)
        message = re.sub(r"^-o:", "file:", message)
        message = re.sub(r'(there is no option |Did you mean ")--([\w-]+)',
                         lambda option: option[1] + option[2].replace("-", "_"), message)
        raise Error(message or f"burnish ended with code {done.returncode}")
    return done.stdout


def options_of(options: Mapping[str, Any]) -> list[str]:
    """Options of the command from arguments of Python.

    >>> options_of({"size": (800, 600), "mark_extremes": True, "tools": False, "title": "Press", "isolines": None})
    ['--size=800,600', '--mark-extremes=on', '--tools=off', '--title=Press']
    """
    return [f"--{name.replace('_', '-')}={_text(value)}" for name, value in options.items() if value is not None]


def _text(value: Any) -> str:
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, (list, tuple)):
        return ",".join(_text(entry) for entry in value)
    return str(value)
