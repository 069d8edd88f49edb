"""Results of older versions can be read: each folder beside this file holds a small result of one version, of scene.yaml, and values.yaml,
the numbers that this version read from it. The program at hand is asked for them again; it also draws, exports and compares the result.
Version 0.1.0 knew neither bodies nor probes: its folder has a scene of its own, and the numbers of its history and its VTU files.

Usage: versions_test.py BURNISH
       versions_test.py BURNISH --keep     computes scene.yaml and keeps the result as that of this version
"""

import csv
import io
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import yaml

HERE = pathlib.Path(__file__).resolve().parent
PROBES = {  # of the version at hand
    "depth": ["--depth", "left@0.5", "--body", "slab", "--field", "stress.xx", "--points", "4"],
    "face": ["--face", "left", "--body", "slab", "--field", "plastic_strain", "--points", "4"],
    "pad": ["--line", "0.7,1.1:1.3,1.1", "--body", "pad", "--field", "von_mises", "--points", "4"],
}
COLUMNS = ["disc.fx", "touch.fy", "touch.friction_work", "strain_energy", "plastic_work", "max_plastic_strain"]
OLDER = {  # by the beginning of a version: its probes and columns
    "0.1.0": (
        {
            "line": ["--line", "0.5,0:0.5,1", "--reference", "--field", "stress.yy", "--points", "5"],
            "middle": ["--line", "0,0.5:2,0.5", "--reference", "--field", "plastic_strain", "--points", "9"],
        },
        ["disc.fx", "disc.fy", "strain_energy", "max_plastic_strain"],
    )
}
MOST_BYTES = 100_000
CLOSE = 1e-9


def call(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}: ended with {done.returncode}: {done.stderr.strip()}")
    return done.stdout


def numbers_in(table):
    rows = list(csv.reader(io.StringIO(table)))
    return rows[0], [[float(value) for value in row] for row in rows[1:]]


def values_of(burnish, result, directory, version=""):
    """All that is compared of a result of a version, as the program at hand reads it."""
    values = {}
    probes, columns = next((asked for begin, asked in OLDER.items() if version.startswith(begin)), (PROBES, COLUMNS))
    for name, options in probes.items():
        _, values[name] = numbers_in(call(burnish, "probe", result, *options, "--csv", "-", "-o", directory / "chart.png"))
    for column in columns:
        _, rows = numbers_in(call(burnish, "plot", result, "--y", column, "--csv", "-", "-o", directory / "chart.png"))
        values[column] = rows
    return values


def problems_of_numbers(found, expected):
    for name, rows in expected.items():
        size = max((abs(value) for row in rows for value in row), default=0)
        flat = [value for row in rows for value in row]
        now = [value for row in found.get(name, []) for value in row]
        if len(now) != len(flat):
            yield f"{name}: {len(now)} numbers, formerly {len(flat)}"
        elif any(abs(one - two) > CLOSE * size for one, two in zip(now, flat)):
            yield f"{name}: {now}, formerly {flat}"


def problems_of_version(burnish, version, directory):
    bytes_kept = sum(path.stat().st_size for path in version.rglob("*") if path.is_file())
    if bytes_kept > MOST_BYTES:
        yield f"{bytes_kept} bytes; allowed: {MOST_BYTES}"
    result = directory / version.name
    shutil.copytree(version / "result", result)
    yield from problems_of_numbers(values_of(burnish, result, directory, version.name), yaml.safe_load((version / "values.yaml").read_text()))
    call(burnish, "render", result, "--field", "plastic_strain", "-o", directory / "picture.png", "--size", "400,225")
    call(burnish, "report", result, "-o", directory / "page.html")
    call(burnish, "export", result, "-o", directory / f"{version.name}-vtu")
    call(burnish, "compare", result, version / "result")


def keep(burnish, directory):
    version = re.sub(r"burnish (\S+) \(engine (\w+)\)", r"\1-\2", call(burnish, "--version").strip())
    folder = HERE / version
    call(burnish, "run", HERE / "scene.yaml", "-o", folder / "result", "--quiet")
    values = values_of(burnish, folder / "result", directory)
    (folder / "values.yaml").write_text(json.dumps(values).replace("]], ", "]],\n") + "\n")
    print(f"kept {folder}")


def main():
    burnish = pathlib.Path(sys.argv[1]).resolve()
    versions = sorted(path.parent for path in HERE.glob("*/values.yaml"))
    wrong = [] if versions else ["there is no result of any version"]
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        if sys.argv[2:] == ["--keep"]:
            keep(burnish, directory)
            return
        for version in versions:
            try:
                wrong += [f"{version.name}: {problem}" for problem in problems_of_version(burnish, version, directory)]
            except RuntimeError as problem:
                wrong.append(f"{version.name}: {problem}")
    print(*wrong, sep="\n")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
