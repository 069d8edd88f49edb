"""Pictures in tests of pytest: the fixture `burnish_image` and the option `--burnish-update`.

    def test_press(burnish_image):
        run = burnish.Scene("press.yaml").run()
        burnish_image(run, "press", field="von_mises", size=(800, 600))

holds the picture against baseline/press.png beside the test's file. The setting `burnish_baseline` names another directory.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

_COMPARED = ("threshold", "metric")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.getgroup("burnish").addoption(
        "--burnish-update", action="store_true", help="make the pictures of burnish_image the new baselines; look at them")
    parser.addini("burnish_baseline", "directory of the baselines of burnish_image, beside the test's file", default="baseline")


@pytest.fixture
def burnish_image(request: pytest.FixtureRequest, tmp_path: Path) -> Callable[..., Any]:
    """A function that draws a picture of a result and fails unless it shows what its baseline shows; returns the picture.

    Arguments: a run, frame or file; the baseline's name without .png; threshold and metric of `burnish.compare`; options of
    `burnish.render`."""
    import burnish

    directory = Path(request.path).parent / request.config.getini("burnish_baseline")

    def check(result: Any, name: str, **options: Any) -> Any:
        rules = {key: options.pop(key) for key in _COMPARED if key in options}
        picture = result if isinstance(result, burnish.Picture) else burnish.render(result, **options)
        baseline = directory / f"{name}.png"
        if request.config.getoption("--burnish-update"):
            baseline.parent.mkdir(parents=True, exist_ok=True)
            picture.save(baseline)
            return picture
        actual, difference = tmp_path / f"{name}.png", tmp_path / f"{name}-diff.png"
        actual.parent.mkdir(parents=True, exist_ok=True)
        picture.save(actual)
        if not baseline.exists():
            pytest.fail(f"{name}: there is no baseline {_shown(baseline)}; look at {actual}, and if it is right, run "
                        "pytest --burnish-update", pytrace=False)
        found = burnish.compare(actual, baseline, diff=difference, **rules)
        if not found:
            hint = f"; difference {difference}" if difference.exists() else ""
            pytest.fail(f"{found.message}; baseline {_shown(baseline)}, picture {actual}{hint}", pytrace=False)
        return picture

    return check


def _shown(path: Path) -> str:
    return os.path.relpath(path)
