"""Pictures and animations, drawn by the command."""

from __future__ import annotations

import base64
import os
import re
import struct
import tempfile
import zlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import command
from .errors import Error
from .results import Frame

_PLACE = re.compile(r"\{(?:frame|time)(?::[^{}]*)?\}")  # of the number or the time in names of files
_SIGNATURE = b"\x89PNG\r\n\x1a\n"


class Picture:
    """A picture: shows itself in a notebook, and is an array of RGBA for numpy."""

    def __init__(self, png: bytes) -> None:
        self.png = png  #: as it is in a file

    def __repr__(self) -> str:
        height, width, _ = self.array.shape
        return f"<picture of {width} x {height} pixels>"

    def _repr_png_(self) -> bytes:
        return self.png

    @property
    def array(self) -> NDArray[np.uint8]:
        """Shape (height, width, 4): red, green, blue and opacity, from 0 to 255."""
        return _pixels(self.png)

    def __array__(self, dtype: Any = None) -> NDArray[Any]:
        return self.array if dtype is None else self.array.astype(dtype)

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes it as PNG."""
        if Path(file).suffix != ".png":
            raise Error(f'"{os.fspath(file)}": expected a name that ends in .png; burnish.render(..., file=...) writes PDF and SVG')
        Path(file).write_bytes(self.png)


class Animation:
    """A video, an animated GIF or PNG: shows itself in a notebook."""

    _TYPES = {".mp4": "video/mp4", ".gif": "image/gif", ".png": "image/png"}

    def __init__(self, file: str | os.PathLike[str]) -> None:
        self.file = Path(file)

    def __repr__(self) -> str:
        return f"<animation {self.file}>"

    def _repr_html_(self) -> str:
        kind = self._TYPES[self.file.suffix]
        data = f"data:{kind};base64,{base64.b64encode(self.file.read_bytes()).decode('ascii')}"
        return f'<video controls loop src="{data}"></video>' if kind.startswith("video") else f'<img src="{data}">'


def render(result: str | os.PathLike[str] | Frame, *, field: str | None = None, frame: int | str | None = None,
           file: str | os.PathLike[str] | None = None, output: str | os.PathLike[str] | None = None,
           **options: Any) -> Picture | Any:
    """Draws a contour picture of a frame: the last one, that of `frame` (a number, "last", "time=0.5"), or a `Frame` itself.

    options: those of `burnish render` with underscores, such as size=(800, 600), colormap="batlow", isolines=10, mirror="x",
    tools=False. result may be a file of another program. With file the picture is written as well, also as .pdf or .svg; a name with
    {frame} or {time} is that of several frames, as of frame="all", whose pictures are returned as a list; output, as the command
    calls it, is the same. Throws `Error` with what the command says.

    >>> import burnish
    >>> picture = burnish.render("out/press", field="von_mises", size=(400, 300), tools=False)
    >>> picture, picture.array.shape
    (<picture of 400 x 300 pixels>, (300, 400, 4))
    """
    of, options = _of_frame(result, {"frame": frame, "field": field, **options})
    words = ["render", of, *command.options_of(options), "-o"]
    file = _one_of(file, output)
    if file is not None and _PLACE.search(os.fspath(file)):
        return _series(words, os.fspath(file))
    if file is not None:
        command.call([*words, os.fspath(file)])
        if Path(file).suffix == ".png":
            return Picture(Path(file).read_bytes())
    return Picture(command.call([*words, "-"]))


def animate(result: str | os.PathLike[str], file: str | os.PathLike[str] | None = None, *, field: str | None = None,
            output: str | os.PathLike[str] | None = None, **options: Any) -> Animation:
    """Draws all frames as an animation: .mp4 or .gif, which need ffmpeg, or .png; a temporary .png when file is left out.

    options: those of `burnish animate` with underscores; output, as the command calls it, is the same as file. Throws `Error` with
    what the command says."""
    file = _one_of(file, output)
    if file is None:
        handle, file = tempfile.mkstemp(prefix="burnish-", suffix=".png")
        os.close(handle)
    command.call(["animate", os.fspath(result), *command.options_of({"field": field, **options}), "-o", os.fspath(file)])
    return Animation(file)


def _one_of(file: str | os.PathLike[str] | None, output: str | os.PathLike[str] | None) -> str | os.PathLike[str] | None:
    """The file to be written, by either of its names."""
    if file is not None and output is not None:
        raise Error("output: found beside file, which is the same; give one of them")
    return output if file is None else file


def _series(words: list[str], file: str) -> list[Picture]:
    """Pictures of several frames, in their order, each drawn into a folder of its own from where it is written to its place; pages
    for print are drawn there by themselves."""
    is_picture = Path(file).suffix == ".png"
    if not is_picture:
        command.call([*words, file])
    with tempfile.TemporaryDirectory(prefix="burnish-") as scratch:
        each = os.path.join(scratch, "{frame:09}")
        try:
            command.call([*words, each + (os.path.abspath(file) if is_picture else "/picture.png")])
        except Error as error:
            raise Error(str(error).replace(each, "")) from None
        drawn = {path: Picture(path.read_bytes()) for path in sorted(Path(scratch).rglob("*.png"))}
        places = [Path("/", *path.relative_to(scratch).parts[1:]) for path in drawn]
    if is_picture:
        if len(set(places)) < len(places):
            raise Error(f'file: found "{file}", a name of several frames; expected one with the number of the frame, as in '
                        "frame_{frame:04}.png")
        for place, picture in zip(places, drawn.values()):
            try:
                place.parent.mkdir(parents=True, exist_ok=True)
                picture.save(place)
            except OSError as error:
                raise Error(f"cannot write {place}: {error.strerror}") from None
    return list(drawn.values())


def _of_frame(result: str | os.PathLike[str] | Frame, options: dict[str, Any]) -> tuple[str, dict[str, Any]]:
    if not isinstance(result, Frame):
        return os.fspath(result), options
    return os.fspath(result.run), {**options, "frame": result.index}


def _pixels(png: bytes) -> NDArray[np.uint8]:
    """The pixels of a PNG of 8-bit RGB or RGBA that is not interlaced."""
    chunks = _chunks(png)
    width, height, depth, kind, _, _, interlaced = struct.unpack(">IIBBBBB", chunks[b"IHDR"])
    channels = {2: 3, 6: 4}.get(kind)
    if depth != 8 or channels is None or interlaced:
        raise Error("the picture is no PNG of 8-bit RGB or RGBA")
    rows = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), dtype=np.uint8).reshape(height, 1 + width * channels)
    pixels = _unfiltered(rows[:, 0], rows[:, 1:].reshape(height, width, channels))
    if channels == 4:
        return pixels
    return np.concatenate([pixels, np.full((height, width, 1), 255, dtype=np.uint8)], axis=2)


def _chunks(png: bytes) -> dict[bytes, bytes]:
    """The chunks by their kinds, those of one kind put together."""
    if not png.startswith(_SIGNATURE):
        raise Error("the picture is no PNG")
    chunks: dict[bytes, bytes] = {}
    place = len(_SIGNATURE)
    while place < len(png):
        length, kind = struct.unpack_from(">I4s", png, place)
        chunks[kind] = chunks.get(kind, b"") + png[place + 8:place + 8 + length]
        place += length + 12
    return chunks


def _unfiltered(filters: NDArray[np.uint8], rows: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Adds what PNG has subtracted: nothing (0), the pixel to the left (1), that above (2), their mean (3), or the one that Paeth's
    predictor chooses (4)."""
    pixels = rows.copy()
    above = np.zeros_like(rows[0])
    for row, kind in zip(pixels, filters):
        if kind == 1:
            row[:] = np.cumsum(row, axis=0, dtype=np.uint8)
        elif kind == 2:
            row += above
        elif kind in (3, 4):
            left, corner = np.zeros(row.shape[1], dtype=int), np.zeros(row.shape[1], dtype=int)
            for x in range(len(row)):
                up = above[x].astype(int)
                guess = (left + up) // 2 if kind == 3 else _paeth(left, up, corner)
                left, corner = (row[x] + guess) % 256, up
                row[x] = left
        above = row
    return pixels


def _paeth(left: NDArray[Any], up: NDArray[Any], corner: NDArray[Any]) -> NDArray[Any]:
    guess = left + up - corner
    from_left, from_up, from_corner = abs(guess - left), abs(guess - up), abs(guess - corner)
    return np.where((from_left <= from_up) & (from_left <= from_corner), left, np.where(from_up <= from_corner, up, corner))
