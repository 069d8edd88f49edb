"""Pictures, animations, comparisons and the plugin of pytest."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import burnish
from burnish.picture import _pixels
from conftest import PROGRAM, call

SMALL = {"size": (300, 200)}


def test_pictures_are_those_of_the_command(press, tmp_path):
    picture = burnish.render(press, field="von_mises", frame=1, tools=False, mark_extremes=True, **SMALL)
    call("render", press.directory, "--field", "von_mises", "--frame", 1, "--tools", "off", "--mark-extremes", "--size", "300,200",
         "-o", tmp_path / "picture.png")
    assert picture.png == (tmp_path / "picture.png").read_bytes() == picture._repr_png_()
    assert burnish.render(press.frames[1], field="von_mises", tools=False, mark_extremes=True, **SMALL).png == picture.png
    array = np.asarray(picture)
    assert array.shape == (200, 300, 4) and array.dtype == np.uint8 and (array[..., 3] == 255).all()
    assert (array[0, 0, :3] == 255).all() and np.ptp(array[..., :3]) > 100
    picture.save(tmp_path / "saved.png")
    assert (tmp_path / "saved.png").read_bytes() == picture.png


def test_transparent_pictures_and_files(press, tmp_path):
    picture = burnish.render(press, transparent=True, file=tmp_path / "picture.png", **SMALL)
    assert (tmp_path / "picture.png").read_bytes() == picture.png and picture.array[0, 0, 3] == 0
    burnish.render(press, file=tmp_path / "picture.pdf")
    assert (tmp_path / "picture.pdf").read_bytes().startswith(b"%PDF")


def test_several_frames_are_a_list(press, tmp_path):
    last = len(press.frames) - 1
    (tmp_path / "a_99.png").write_bytes(b"older")
    pictures = burnish.render(press, frame="all", file=tmp_path / "a_{frame}.png", **SMALL)
    assert [picture.png for picture in pictures] == [(tmp_path / f"a_{k}.png").read_bytes() for k in range(last + 1)]
    assert pictures[0].png != pictures[last].png
    again = burnish.render(press, frame="0-1", file=tmp_path / "a_{frame}.png", **SMALL)
    assert [picture.png for picture in again] == [(tmp_path / f"a_{k}.png").read_bytes() for k in range(2)]
    one, = burnish.render(press, frame=0, file=tmp_path / "b_{frame:03}_at_{time:.2f}.png", **SMALL)
    assert one.png == (tmp_path / "b_000_at_0.00.png").read_bytes()
    pages = burnish.render(press, frame="all", file=tmp_path / "c_{frame}.pdf")
    assert len(pages) == last + 1 and (tmp_path / f"c_{last}.pdf").read_bytes().startswith(b"%PDF")


def test_several_frames_are_found_beside_newer_pictures(press, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    burnish.render(press, frame=2, output="older/../a_{frame}.png", **SMALL)
    os.utime("a_2.png", (2e9, 2e9))  # of another program's clock
    first, second = burnish.render(press, frame="0-1", output="a_{frame}.png", **SMALL)
    assert [first.png, second.png] == [Path(f"a_{k}.png").read_bytes() for k in range(2)]
    with pytest.raises(burnish.Error, match='^file: found "same_{time:.0f}.png", a name of several frames'):
        burnish.render(press, frame="0-1", file="same_{time:.0f}.png", **SMALL)


def test_output_is_another_name_of_file(press, tmp_path):
    picture = burnish.render(press, output=tmp_path / "picture.png", **SMALL)
    assert (tmp_path / "picture.png").read_bytes() == picture.png
    assert burnish.animate(press, output=tmp_path / "press.png", **SMALL).file == tmp_path / "press.png"
    for draw in (burnish.render, burnish.animate):
        with pytest.raises(burnish.Error, match="^output: found beside file"):
            draw(press, file=tmp_path / "a.png", output=tmp_path / "b.png")
    assert not (tmp_path / "a.png").exists()


@pytest.mark.parametrize("filtered", ["none", "sub", "up", "avg", "paeth"])
def test_pixels_of_every_filter(press, tmp_path, filtered):
    """ffmpeg writes the same picture with every filter of PNG."""
    picture = burnish.render(press, **SMALL)
    picture.save(tmp_path / "picture.png")
    subprocess.run(["ffmpeg", "-loglevel", "error", "-i", tmp_path / "picture.png", "-pred", filtered, tmp_path / "filtered.png"],
                   check=True)
    assert (_pixels((tmp_path / "filtered.png").read_bytes()) == picture.array).all()


def test_mistakes_are_told_as_by_the_command(press):
    with pytest.raises(burnish.Error, match='^field: found "von_mies".*Did you mean "von_mises"'):
        burnish.render(press, field="von_mies")
    with pytest.raises(burnish.Error, match='there is no option mark_extrems. Did you mean "mark_extremes"'):
        burnish.render(press, mark_extrems=True)
    with pytest.raises(burnish.Error, match='^file: found "press.tiff"; expected the name of a picture'):
        burnish.render(press, file="press.tiff")


def test_animations(press, tmp_path):
    animation = burnish.animate(press, tmp_path / "press.png", field="von_mises", **SMALL)
    assert b"acTL" in animation.file.read_bytes() and animation._repr_html_().startswith('<img src="data:image/png;base64,')
    temporary = burnish.animate(press, **SMALL)
    assert temporary.file.suffix == ".png" and temporary.file.stat().st_size > 1000
    temporary.file.unlink()


def test_comparisons(press, results, tmp_path):
    one, other = (burnish.render(press, field=field, **SMALL) for field in ("von_mises", "pressure"))
    assert burnish.compare(one, one) and burnish.compare(press, press)
    found = burnish.compare(one, other, diff=tmp_path / "diff.png")
    assert not found and found.verdicts[0].verdict == "different" and found.verdicts[0].data["metric"] == "ssim"
    assert (tmp_path / "diff.png").exists() and "different (ssim" in found.message
    data = burnish.compare(press, results("lagrange"))
    assert not data and len(data.differing) >= 1
    with pytest.raises(burnish.Error):
        burnish.compare(tmp_path / "absent.png", one)


def test_plugin(pytester, press, monkeypatch):
    pytester.makeini("[pytest]\nburnish_baseline = pictures\n")
    pytester.makepyfile(f"""
        import burnish

        def test_press(burnish_image):
            burnish_image(burnish.open({str(press.directory)!r}), "press", field="von_mises", size=(300, 200))
    """)
    plugin = ("-p", "burnish.pytest_plugin", "-p", "no:cacheprovider")
    first = pytester.runpytest_subprocess(*plugin)
    first.assert_outcomes(failed=1)
    first.stdout.fnmatch_lines(["*press: there is no baseline pictures/press.png; look at *press.png*--burnish-update*"])
    pytester.runpytest_subprocess(*plugin, "--burnish-update").assert_outcomes(passed=1)
    pytester.runpytest_subprocess(*plugin).assert_outcomes(passed=1)
    burnish.render(press, field="pressure", **SMALL).save(pytester.path / "pictures/press.png")
    last = pytester.runpytest_subprocess(*plugin)
    last.assert_outcomes(failed=1)
    last.stdout.fnmatch_lines(["*press.png: different (ssim *; baseline pictures/press.png, picture *press.png; difference *"])


def test_the_command_is_missing(press, monkeypatch):
    monkeypatch.setenv("BURNISH_PROGRAM", "no-such-command")
    with pytest.raises(burnish.Error, match="the command burnish was not found"):
        burnish.render(press)
    monkeypatch.setenv("BURNISH_PROGRAM", PROGRAM)
    assert burnish.render(press, **SMALL).png
