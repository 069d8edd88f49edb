"""The pictures of docs/render.md: each is what the command above it draws, and every option of `burnish render` that changes a picture
has one.

Usage: render_pictures_test.py BURNISH [--write]     --write: makes the pictures anew; look at them before they are committed
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests"))
from png_picture import Picture  # noqa: E402

PAGE = SOURCE / "docs/render.md"
PICTURES = SOURCE / "docs/images/render"
NO_PICTURE = {"--help": "the help", "--output": "the file", "--dpi": "pages for print", "--print-field": "pages for print"}
MOST_BYTES, MOST_BYTES_TOGETHER = 32_000, 1_500_000


def section():
    text = PAGE.read_text()
    return text[text.index("## Options in pictures"):text.index("## Print")]


def options_of_render(burnish):
    """Each option with all of its names."""
    text = subprocess.run([burnish, "render", "--help"], check=True, capture_output=True, text=True).stdout
    for names in re.findall(r"^  (-\S+)", text, re.MULTILINE):
        yield [name.split("{")[0] for name in names.split(",") if name.startswith("--")]


def problems_of_page(burnish, commands):
    words = {word for command in commands.values() for word in command.split()} | set(re.findall(r"`(--[\w-]+)`", section()))
    for names in options_of_render(burnish):
        if not set(names) & (words | NO_PICTURE.keys()):
            yield (f"docs/render.md shows nothing of {names[0]}: add to \"Options in pictures\" what it does, with the command in "
                   f"backticks, `burnish render press {names[0]} ... --size 400,225 -o NAME.png`, and below it "
                   f"![...](images/render/NAME.png); then run tests/docs/render_pictures_test.py BURNISH --write and look at the picture")
    shown = re.findall(r"\]\(images/render/([\w-]+)\.png\)", section())
    for name in sorted(set(shown) ^ set(commands)):
        yield f"docs/render.md has {'no command' if name in shown else 'only the command'} of the picture {name}.png"
    for name in sorted({path.stem for path in PICTURES.glob("*")} - set(shown)):
        yield f"{name}.png of docs/images/render is not shown in docs/render.md"


def problems_of_sizes():
    sizes = {path.name: path.stat().st_size for path in PICTURES.glob("*.png")}
    for name, size in sizes.items():
        if size > MOST_BYTES:
            yield f"docs/images/render/{name} has {size} bytes; allowed: {MOST_BYTES}; make it smaller by --size"
    if sum(sizes.values()) > MOST_BYTES_TOGETHER:
        yield f"docs/images/render has {sum(sizes.values())} bytes; allowed: {MOST_BYTES_TOGETHER}"


def main():
    burnish, writes = pathlib.Path(sys.argv[1]).resolve(), "--write" in sys.argv[2:]
    commands = {name: line for line, name in re.findall(r"(burnish render [^`\n]+ -o ([\w-]+)\.png)", section())}
    runs = re.findall(r"^    (burnish run .+)$", section(), re.MULTILINE)
    wrong = list(problems_of_page(burnish, commands))
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        (directory / "scenes").symlink_to(SOURCE / "scenes")
        environment = {**os.environ, "PATH": f"{burnish.parent}{os.pathsep}{os.environ['PATH']}"}
        for line in runs + list(commands.values()):
            done = subprocess.run(line + (" --quiet" if line in runs else ""), shell=True, cwd=directory, env=environment,
                                  capture_output=True, text=True)
            if done.returncode != 0:
                wrong.append(f"{line}: ended with {done.returncode}: {done.stderr.strip()}")
        if writes:
            PICTURES.mkdir(parents=True, exist_ok=True)
            for picture in commands:
                (PICTURES / f"{picture}.png").write_bytes(Picture((directory / f"{picture}.png").read_bytes()).packed())
        for picture in commands:
            compared = subprocess.run([burnish, "compare", directory / f"{picture}.png", PICTURES / f"{picture}.png"],
                                      capture_output=True, text=True)
            if compared.returncode != 0:
                wrong.append((compared.stdout + compared.stderr).strip().splitlines()[-1])
    wrong += problems_of_sizes()
    print(*wrong, sep="\n")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
