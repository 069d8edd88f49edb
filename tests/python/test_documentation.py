"""The examples of the package and of docs/python.md are executed."""

import ast
import contextlib
import doctest
import importlib
import io
import json
import os
import pkgutil
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

import burnish

SOURCE = Path(__file__).resolve().parents[2]
PAGE = (SOURCE / "docs/python.md").read_text()
MODULES = [module.name for module in pkgutil.iter_modules(burnish.__path__) if module.name != "_engine"]


@pytest.fixture(scope="module")
def pressed(tmp_path_factory):
    """A directory with the scene of the page, press.yaml, and its run, out/press."""
    place = tmp_path_factory.mktemp("pressed")
    (place / "press.yaml").write_text(blocks("yaml")[0])
    burnish.Scene(place / "press.yaml").run(place / "out/press")
    return place


@pytest.mark.parametrize("name", MODULES)
def test_examples_of_the_package(name, pressed, monkeypatch):
    monkeypatch.chdir(pressed)
    found = doctest.testmod(importlib.import_module(f"burnish.{name}"))
    assert found.failed == 0


@pytest.mark.parametrize("name", ["Scene", "Run", "Frame", "History", "Field", "render", "compare"])
def test_public_parts_have_examples(name):
    assert ">>> import burnish\n" in getattr(burnish, name).__doc__


def test_there_are_examples():
    modules = [importlib.import_module(f"burnish.{name}") for name in MODULES]
    assert sum(len(test.examples) for module in modules for test in doctest.DocTestFinder().find(module)) >= 5


@pytest.mark.parametrize("name", burnish.__all__)
def test_public_parts_say_what_they_are_and_what_they_take(name):
    part = getattr(burnish, name)
    assert part.__doc__
    functions = [part] if not isinstance(part, type) else [
        value for key, value in vars(part).items() if callable(value) and not key.startswith("_") and hasattr(value, "__code__")]
    for function in functions:
        hints = function.__annotations__
        taken = function.__code__.co_varnames[:function.__code__.co_argcount + function.__code__.co_kwonlyargcount]
        assert "return" in hints and set(taken) - {"self", "cls"} <= set(hints), f"{name}: {function.__qualname__}"


@pytest.mark.parametrize("name", [*burnish.__all__, "Scene.resolved", "Run.has_ended"])
def test_the_page_lists_public_parts(name):
    assert re.search(rf"`(burnish\.)?{re.escape(name)}(\(.*?\))?`", PAGE)


def blocks(language):
    return re.findall(rf"^```{language}\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)


def executed(block, names):
    """Runs a block and returns what it prints and what its last expression is."""
    tree = ast.parse(block)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, "docs/python.md", "exec"), names)
        value = None if last is None else eval(compile(ast.Expression(last.value), "docs/python.md", "eval"), names)
    return printed.getvalue(), value


def test_examples_of_the_page(tmp_path, monkeypatch):
    """All blocks of Python one after the other, in a directory with the scene; `#>` begins what a line prints."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "press.yaml").write_text(blocks("yaml")[0])
    names = {}
    for block in blocks("python"):
        if "def test_" in block:
            continue
        expected = [line[3:] for line in block.splitlines() if line.startswith("#> ")]
        printed, _ = executed(block, names)
        assert printed.splitlines() == expected, block


def test_command_on_the_page(pressed):
    command, = re.findall(r"^    python3 (-c .*)$", PAGE, re.MULTILINE)
    done = subprocess.run([sys.executable, *shlex.split(command)], cwd=pressed, check=True, capture_output=True, text=True)
    assert "von_mises" in done.stdout


def test_example_of_a_test_on_the_page(tmp_path):
    (tmp_path / "press.yaml").write_text(blocks("yaml")[0])
    test, = [block for block in blocks("python") if "def test_" in block]
    (tmp_path / "test_press.py").write_text(test)
    for options in (["--burnish-update"], []):
        subprocess.run([sys.executable, "-m", "pytest", "-q", "-p", "burnish.pytest_plugin", "-p", "no:cacheprovider", *options],
                       cwd=tmp_path, check=True, capture_output=True)
    assert (tmp_path / "baseline/press.png").exists()


def test_notebook(tmp_path):
    """It runs from its first cell to its last, and shows two pictures."""
    text = (SOURCE / "docs/press.ipynb").read_text()
    assert not any(cell.get("outputs") for cell in json.loads(text)["cells"])
    (tmp_path / "press.ipynb").write_text(text)
    done = subprocess.run(
        [sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--inplace", "press.ipynb"], cwd=tmp_path,
        env={**os.environ, "JUPYTER_RUNTIME_DIR": str(tmp_path / "runtime"), "IPYTHONDIR": str(tmp_path / "ipython")},
        capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    outputs = [output for cell in json.loads((tmp_path / "press.ipynb").read_text())["cells"] for output in cell.get("outputs", [])]
    assert sum("image/png" in output.get("data", {}) for output in outputs) == 2
    assert any("largest force" in "".join(output.get("text", "")) for output in outputs)
