"""What is read of results is what the command says of them."""

import os
import resource
import shutil
import subprocess
import sys

import h5py
import numpy as np
import pytest

import burnish
from burnish.results import last_row
from conftest import call, probe
from scenes import SCENES, scene

FIELDS = [["displacement.y"], ["stress.xx", "von_mises"]]  # of one unit each
# Lines through the deformed bodies, which leave and enter them.
LINES = {
    "press": ([0.1, 0.2], [1.9, 0.7]),
    "lagrange": ([-0.1, 0.1], [1.9, 0.8]),
    "axisymmetric": ([0, 0.9], [2, 0.1]),
    "ring": ([0.2, 0.1], [2.2, 1.9]),
    "bodies": ([0, 0], [3.9, 2]),
    "patches": ([0.05, 0.2], [2, 0.9]),
    "space": ([0, 0.1, 0.2], [2, 0.8, 0.9]),
    "remeshed": ([0.1, 0.2], [1.9, 1.1]),
}
POINTS = {"space": ["1,0.9,0.5"], "bodies": ["1.5,0.5", "0,3.6"], "ring": ["0.9,1.2", "0.5,0.5"]}


def largest(frame, name):
    """Magnitude of the values that a field has in a frame."""
    field = frame.field(name)
    return max(np.nanmax(np.abs(field.on_grid(3, k))) for k in range(len(frame.patches)))


def test_scenes_are_of_all_kinds(results):
    runs = {name: results(name) for name in SCENES}
    assert runs["axisymmetric"].is_axisymmetric and not runs["press"].is_axisymmetric
    assert runs["space"].dim == 3 and runs["bodies"].bodies == ("shaft", "hub") and len(runs["patches"].patches) == 2
    assert np.ptp(runs["ring"].patches[0].weights) > 0.05
    assert runs["lagrange"].patches[0].bases[0].family == "lagrange"
    assert [frame.is_remeshed for frame in runs["remeshed"].frames] == [False, False, True]
    remeshed = runs["remeshed"]
    assert np.abs(remeshed.frames[-1].patches[0].points - remeshed.patches[0].points).max() > 0.01


def test_what_is_read_says_in_a_line_what_it_is(results):
    for name in SCENES:
        frame = results(name).frames[-1]
        lines = [repr(part) for part in (results(name), frame, frame.quadrature, *frame.contact, results(name).history,
                                         frame.field("von_mises"), frame.field("von_mises").on_line(*LINES[name]))]
        assert all(line.startswith("<") and "\n" not in line and "array" not in line for line in lines), lines
    contact, = results("press").frames[-1].contact
    assert repr(contact) == f"<contact of disc on top: {len(contact.points)} points, {np.count_nonzero(contact.pressure)} pressed>"


def test_no_points_have_no_values(press):
    frame = press.frames[-1]
    assert frame.field("von_mises").at_points([]).shape == (0,) and frame.field("stress").at_points(np.empty((0, 2))).shape == (0, 4)
    assert frame.field("von_mises").at_material([]).shape == (0,) and frame.field("von_mises").at_parameters([]).shape == (0,)


def test_the_version_is_that_of_the_command():
    assert call("--version").startswith(f"burnish {burnish.__version__} (")
    assert set(dir(burnish)) == {*burnish.__all__, "__version__"}


@pytest.mark.parametrize("name", SCENES)
def test_values_on_lines_are_those_of_probe(results, name):
    run = results(name)
    begin, end = LINES[name]
    path = ":".join(",".join(map(str, point)) for point in (begin, end))
    frame = run.frames[-1]
    for fields in FIELDS:
        columns, table = probe(run, f"--line={path}", "--field", ",".join(fields))
        for field in fields:
            line = frame.field(field).on_line(begin, end)
            # Probe adds points where the line leaves a body.
            same = [int(np.argmin(np.abs(table[:, 0] - distance))) for distance in line.distance]
            np.testing.assert_allclose(line.distance, table[same, 0], rtol=0, atol=1e-12)
            inside = ~np.isnan(line.values)
            assert 50 < inside.sum()
            expected = table[same, columns.index(field)]
            np.testing.assert_allclose(line.values, expected, rtol=0, atol=1e-12 * max(1, largest(frame, field)))
            np.testing.assert_allclose(line.material[inside], table[same, 1 + run.dim:1 + 2 * run.dim][inside], rtol=0, atol=1e-11)


@pytest.mark.parametrize("name", SCENES)
def test_values_of_material_are_those_of_probe(results, name):
    run = results(name)
    for place in POINTS.get(name, ["1,0.9", "2,1"]):
        point = [float(x) for x in place.split(",")]
        try:
            columns, table = probe(run, f"--point={place}", "--field", ",".join(FIELDS[1]), "--frame", "all")
        except subprocess.CalledProcessError as error:
            assert "outside" in error.stderr
            assert np.isnan(run.frames[-1].field("stress.xx").at_material(point))
            continue
        for field in FIELDS[1]:
            values = [frame.field(field).at_material(point) for frame in run.frames]
            expected = table[:, columns.index(field)]
            np.testing.assert_allclose(values, expected, rtol=0, atol=1e-12 * max(1, largest(run.frames[-1], field)))


def test_line_crosses_bodies_and_gaps(results):
    line = results("bodies").frames[-1].field("plastic_strain").on_line([0, 0], [3.9, 2])
    radius = np.linalg.norm(line.points, axis=1)
    assert np.isnan(line.values[radius < 0.99]).all()  # the hole
    assert np.isnan(line.values[radius > 2.01]).all()  # the hub has no such field
    assert (line.values[(radius > 1.01) & (radius < 1.99)] == 0).all()


@pytest.mark.parametrize("name", SCENES)
def test_places_are_found_again(results, name):
    """Positions of parameters lead back to the values there."""
    frame = results(name).frames[-1]
    random = np.random.default_rng(5)
    for number, patch in enumerate(frame.patches):
        domain = patch.domain
        xi = domain[:, 0] + (domain[:, 1] - domain[:, 0]) * random.random((30, frame.dim))
        moved = frame.locator.patches[number]
        field = frame.field("stress")
        there = field.at_points(moved.values(moved.points, xi))
        np.testing.assert_allclose(there, field.at_parameters(xi, number), rtol=0, atol=1e-10 * max(1, largest(frame, "stress")))


def test_grid_is_made_of_parameters(press):
    frame = press.frames[-1]
    patch = frame.patches[0]
    u, v = (basis.subdivided(3) for basis in patch.bases)
    grid = frame.field("stress").on_grid(3)
    assert grid.shape == (u.size, v.size, 4) and frame.grid(3).shape == (u.size, v.size, 2)
    for i, j in [(0, 0), (4, 2), (u.size - 1, v.size - 1)]:
        np.testing.assert_allclose(grid[i, j], frame.field("stress").at_parameters([u[i], v[j]]), rtol=1e-12, atol=1e-12)
    inner = frame.grid(3)[1:-1, 1:-1].reshape(-1, 2)
    np.testing.assert_allclose(frame.field("von_mises").at_points(inner), frame.field("von_mises").on_grid(3)[1:-1, 1:-1].ravel(),
                               rtol=0, atol=1e-10)


def test_components_belong_to_their_field(press):
    frame = press.frames[-1]
    stress, xi = frame.field("stress"), [0.3, 0.8]
    assert stress.components == ("xx", "yy", "xy", "zz") and stress.unit == "MPa"
    one_by_one = [frame.field(f"stress.{c}").at_parameters(xi) for c in stress.components]
    np.testing.assert_allclose(one_by_one, stress.at_parameters(xi), rtol=1e-14)


def test_history_and_summary(press):
    call_text = (press.directory / "history.csv").read_text().splitlines()
    assert press.history.columns == call_text[0].split(",")
    assert press.history["disc.fy"].tolist() == [float(row.split(",")[press.history.columns.index("disc.fy")]) for row in call_text[1:]]
    assert press.history["time"].tolist() == [0, 0.25, 0.5, 0.75, 1] and press.history.num_rows == 5
    assert press.summary["completed"] is True and press.summary["tolerance"] == 1e-9
    assert press.scene["solver"]["tolerance"] == 1e-9 and press.scene["material"]["E"] == 1000
    assert press.times.tolist() == [0, 0.5, 1] and press.frame(0.5).index == 1


def test_tools_and_contact(press):
    frame = press.frames[-1]
    assert frame.tool_displacement["disc"].tolist() == [0, -0.05] and frame.tool_angle == {"disc": 0}
    contact, = frame.contact
    assert contact.tool == "disc" and contact.face == "top" and contact.friction is None
    pressed = contact.pressure > 0
    assert pressed.any() and not pressed.all()
    radius = np.linalg.norm(contact.points[pressed] - [1, 1.45], axis=1)
    np.testing.assert_allclose(radius - 0.5, contact.gap[pressed], rtol=0, atol=1e-12)
    assert frame.quadrature.field("von_mises").shape == (len(frame.quadrature.points),)
    assert frame.quadrature.field("von_mises").max() > 5


def test_tools_that_are_taken_away_tell_when(press, tmp_path):
    tool = {**SCENES["press"]["tools"][0], "until": 0.5}
    assert burnish.Scene(scene(tools=[tool])).run(tmp_path).tool_until == {"disc": 0.5}
    assert press.tool_until == {}


def test_reading_while_a_run_goes_on(press, tmp_path):
    shutil.copytree(press.directory, tmp_path / "run")
    (tmp_path / "run/summary.yaml").unlink()
    (tmp_path / "run/result/frame_000002.h5").unlink()
    with open(tmp_path / "run/history.csv", "a") as table:
        table.write("5,1.25,0.")
    run = burnish.open(tmp_path / "run")
    assert len(run.frames) == 2 and run.history.num_rows == 5 and not run.has_ended
    with pytest.raises(burnish.Error, match="has not ended"):
        run.summary


def test_last_row_of_a_history_that_grows(press, tmp_path):
    file = tmp_path / "history.csv"
    text = (press.directory / "history.csv").read_text()
    for end in (len(text), len(text) - 1, len(text) - 40):
        file.write_text(text[:end])
        assert last_row(file) == {column: values[-1] for column, values in burnish.History(file).items()}


def test_names_that_do_not_exist(press):
    frame = press.frames[-1]
    with pytest.raises(KeyError, match='found "von_mies".*Did you mean "von_mises"'):
        frame.field("von_mies")
    with pytest.raises(burnish.UnknownName, match='"disc.fz"'):
        press.history["disc.fz"]
    assert frame.field("stress").at_points(np.empty((0, 2))).shape == (0, 4)
    assert "disc.fz" not in press.history and "disc.fy" in press.history
    with pytest.raises(burnish.Error, match="go from 0 to 1, 0 to 1"):
        frame.field("stress").at_parameters([1.5, 0])
    with pytest.raises(burnish.Error, match=r"expected \(points, 2\)"):
        frame.field("stress").at_points([[1, 2, 3]])
    with pytest.raises(IndexError, match="its frames are 0 to 2"):
        press.frames[3]
    with pytest.raises(burnish.Error, match="t = 0.3; its frames are at 0, 0.5, 1"):
        press.frame(0.3)


def test_files_that_are_no_results(press, results, tmp_path):
    with pytest.raises(burnish.Error, match="no such file"):
        burnish.open(tmp_path / "absent")
    with pytest.raises(burnish.Error, match="holds no result.h5"):
        burnish.open(tmp_path)
    (tmp_path / "text.h5").write_text("no HDF5")
    with pytest.raises(burnish.Error, match="text.h5 cannot be read as HDF5"):
        burnish.open(tmp_path / "text.h5")
    with pytest.raises(burnish.Error, match="is the frame file of a result where its model file"):
        burnish.open(press.directory / "result/frame_000000.h5")
    shutil.copytree(press.directory, tmp_path / "mixed")
    shutil.copy(results("ring").directory / "result/frame_000001.h5", tmp_path / "mixed/result/frame_000001.h5")
    with pytest.raises(burnish.Error, match="belongs to another run"):
        burnish.open(tmp_path / "mixed").frames[1]
    with h5py.File(tmp_path / "mixed/result.h5", "r+") as file:
        file.attrs["burnish_format"] = 3
    with pytest.raises(burnish.Error, match="result format 3, but this version reads format 2"):
        burnish.open(tmp_path / "mixed")


def test_damaged_bytes_are_found(press, tmp_path):
    shutil.copytree(press.directory, tmp_path / "run")
    file = tmp_path / "run/result/frame_000002.h5"
    os.truncate(file, file.stat().st_size - 100)
    with pytest.raises(burnish.Error, match="frame_000002.h5"):
        burnish.open(tmp_path / "run").frames[2]


def test_import_is_fast_and_loads_nothing():
    code = "import sys, burnish; print(not {'numpy', 'h5py', 'vtkmodules', 'yaml'} & set(sys.modules))"
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    assert subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout == "True\n"
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    assert after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime < 0.2  # with the start of the interpreter


def test_every_name_of_the_package_exists():
    assert all(getattr(burnish, name) is not None for name in burnish.__all__)
    assert set(burnish.__all__) <= set(dir(burnish))
