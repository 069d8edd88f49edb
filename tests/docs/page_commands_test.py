"""The commands of a page of the documentation, run from the first to the last in one directory that holds the scenes, and what the page
shows of them.

Run are all blocks of ```sh, indented blocks behind <!-- run -->, and what stands in a comment <!-- run: COMMAND -->, which prepares
something that a page takes for granted. Of indented blocks behind <!-- validate: WHY NOT RUN --> the scenes and their changes are checked,
and those behind <!-- not run: WHY --> are left out. A block of ```text behind one holds lines that it prints; a block behind <!-- file:
NAME --> is saved as NAME first. A picture of docs/images/tutorial is compared with the file of the same name that the commands have drawn.

Usage: page_commands_test.py BURNISH PAGE [--write]     --write: makes the pictures anew; look at them before they are committed
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import textwrap

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests"))
from png_picture import Picture  # noqa: E402

BLOCK = re.compile(
    r"^<!-- run: (?P<prepares>[^\n]*) -->$"
    r"|^<!-- run -->\n\n(?P<indented>(?:    [^\n]*\n)+)"
    r"|^<!-- validate: [^\n]* -->\n\n(?P<validated>(?:    [^\n]*\n)+)"
    r"|(?:^<!-- file: (?P<file>\S+) -->\n)?^```(?P<kind>sh|text|yaml)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
PICTURE = re.compile(r"\]\((?P<place>[\w./-]*images/tutorial/(?P<name>[\w-]+\.png))\)")


def words_of(text):
    return " ".join(text.split())


def problems_of_blocks(page, directory, environment):
    printed = ""
    for block in BLOCK.finditer(page):
        commands = block["prepares"] or block["indented"] or (block["text"] if block["kind"] == "sh" else None)
        if block["validated"]:
            commands = re.sub(r" -o \S+", "", block["validated"].replace("burnish run", "burnish validate"))
        if block["file"]:
            (directory / block["file"]).write_text(block["text"])
        elif commands:
            done = subprocess.run(["bash", "-euo", "pipefail", "-c", textwrap.dedent(commands)], cwd=directory, env=environment,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            printed = words_of(done.stdout)
            if done.returncode != 0:
                yield f"{commands.strip()}\nended with {done.returncode}: {done.stdout.strip()}"
        elif block["kind"] == "text":
            for line in block["text"].splitlines():
                if words_of(line) not in printed:
                    yield f"\"{line.strip()}\" was not printed, but: {printed}"


def problems_of_pictures(burnish, page, path, directory, writes):
    for shown in PICTURE.finditer(page):
        drawn = next(directory.rglob(shown["name"]), None)
        kept = (path.parent / shown["place"]).resolve()
        if drawn is None:
            yield f"no command draws {shown['name']}"
            continue
        if writes:
            kept.parent.mkdir(parents=True, exist_ok=True)
            kept.write_bytes(Picture(drawn.read_bytes()).packed())
        compared = subprocess.run([burnish, "compare", drawn, kept], capture_output=True, text=True)
        if compared.returncode != 0:
            yield (compared.stdout + compared.stderr).strip().splitlines()[-1]


def main():
    burnish, path, writes = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]), "--write" in sys.argv[3:]
    page = path.read_text()
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        (directory / "scenes").symlink_to(SOURCE / "scenes")
        environment = {**os.environ, "PATH": f"{burnish.parent}{os.pathsep}{os.environ['PATH']}"}
        wrong = list(problems_of_blocks(page, directory, environment))
        wrong += problems_of_pictures(burnish, page, path, directory, writes)
    print(*wrong, sep="\n")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
