"""Results of small scenes, computed once by the command, which BURNISH_PROGRAM names."""

import csv
import json
import os
import subprocess

import numpy as np
import pytest

import burnish
from scenes import SCENES

pytest_plugins = ["pytester", "burnish.pytest_plugin"]
PROGRAM = os.environ["BURNISH_PROGRAM"]


def call(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], check=True, capture_output=True, text=True).stdout


def probe(run, *options):
    """The table of `burnish probe`: names of columns without units, values."""
    lines = call("probe", run.directory, *options, "--csv", "-", "-o", run.directory / "probe.png").splitlines()
    columns, *rows = csv.reader(lines)
    return [column.split(" ")[0] for column in columns], np.array(rows, dtype=float)


@pytest.fixture(scope="session")
def results(tmp_path_factory):
    """A function that gives the run of a scene by its name."""
    runs = {}
    place = tmp_path_factory.mktemp("results")

    def result(name):
        if name not in runs:
            file = place / f"{name}.yaml"
            file.write_text(json.dumps(SCENES[name], indent=1))
            call("run", file, "-o", place / name, "--quiet")
            runs[name] = burnish.open(place / name)
        return runs[name]

    return result


@pytest.fixture
def press(results):
    return results("press")
