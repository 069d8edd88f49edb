"""Scenes that are changed, checked and computed in this process."""

import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import h5py
import numpy as np
import pytest

import burnish
from conftest import PROGRAM, call
from scenes import SCENES, scene

NEVER_EQUAL = {"summary.yaml"}  # times that work took


def files_of(directory):
    return {str(path.relative_to(directory)): path.read_bytes()
            for path in sorted(Path(directory).rglob("*")) if path.is_file() and path.name not in NEVER_EQUAL}


def written(tmp_path, of, name="scene.yaml"):
    import json

    file = tmp_path / name
    file.write_text(json.dumps(of, indent=1))
    return file


@pytest.mark.parametrize("name", SCENES)
def test_runs_have_the_bits_of_the_command(results, tmp_path, name):
    theirs = results(name)
    ours = burnish.Scene(theirs.directory.parent / f"{name}.yaml").run(tmp_path / "run")
    expected, found = files_of(theirs.directory), files_of(ours.directory)
    expected.pop("probe.png", None)
    assert found == expected
    assert ours.program == theirs.program
    for mine, their in zip(ours.frames, theirs.frames):
        for field, _ in their.arrays:
            assert (mine.field(field)._coefficients == their.field(field)._coefficients).all()


def test_pictures_want_frames_and_stay_in_the_result(tmp_path):
    file = written(tmp_path, scene(pictures=[{"field": "von_mises", "times": [0.3]}],
                                   probes=[{"name": "depth", "depth": "top@1", "field": ["stress.xx"], "times": [0.7]}]))
    call("run", file, "-o", tmp_path / "theirs", "--quiet")
    ours = burnish.Scene(file).run(tmp_path / "ours")
    assert ours.times.tolist() == [0, 0.3, 0.5, 0.7, 1]
    assert (ours.file.read_bytes()) == (tmp_path / "theirs/result.h5").read_bytes()
    assert not (ours.directory / "pictures").exists()


def test_scene_of_a_mapping(press, tmp_path):
    run = burnish.Scene(SCENES["press"]).run(tmp_path)
    assert (run.directory / "history.csv").read_bytes() == (press.directory / "history.csv").read_bytes()


def test_changes(press, tmp_path):
    changed = burnish.Scene(press.directory.parent / "press.yaml").set("basis=lagrange", "degree=1")
    changed["material.E"] = np.float64(2000)
    changed["tools[0].motion"] = {"times": np.array([0, 1]), "y": [0, -0.02]}
    assert changed["material.E"] == 2000 and changed["tools[0].motion.y"] == [0, -0.02] and changed["basis"] == "lagrange"
    assert changed["solver.tolerance"] == 1e-9 and "rezoning.travel" not in changed
    run = changed.run(tmp_path / "ours")
    call("run", press.directory.parent / "press.yaml", "--set", "basis=lagrange", "--set", "degree=1", "--set", "material.E=2000",
         "--set", "tools[0].motion={times: [0, 1], y: [0, -0.02]}", "-o", tmp_path / "theirs", "--quiet")
    assert files_of(run.directory) == files_of(tmp_path / "theirs")
    with pytest.raises(KeyError, match='found "F"'):
        changed["material.F"]


def test_changes_are_taken_back(tmp_path):
    changed = burnish.Scene(scene()).set("material.E=3", "degree=3", "material.E=4")
    changed["materials.E"] = 5
    with pytest.raises(burnish.Error, match="materials: found an unknown key"):
        changed.validate()
    del changed["materials.E"]
    assert changed["material.E"] == 4 and changed["degree"] == 3
    del changed["material.E"]
    assert changed["material.E"] == 1000 and changed["degree"] == 3
    with pytest.raises(KeyError, match='change: found "degre"; available: degree. Did you mean "degree"'):
        del changed["degre"]


def test_mistakes_are_told_as_by_the_command(tmp_path):
    file = written(tmp_path, scene(degree=0, tols=[]))
    done = subprocess.run([PROGRAM, "run", file, "-o", tmp_path / "run"], capture_output=True, text=True)
    for act in (burnish.Scene(file).validate, lambda: burnish.Scene(file).run(tmp_path / "run")):
        with pytest.raises(burnish.Error) as told:
            act()
        assert f"burnish: {told.value}\n" == done.stderr and "degree: found 0" in str(told.value)
    assert not (tmp_path / "run").exists()
    with pytest.raises(burnish.Error, match="found an unknown key") as told:  # a mapping has no lines
        burnish.Scene(scene(degree=0, tols=[])).validate()
    assert sorted(line.partition(":")[0] for line in str(told.value).splitlines()) == ["degree", "tols"]
    with pytest.raises(burnish.Error, match="--set degree=zero: degree: found zero"):
        burnish.Scene(scene()).set("degree=zero").validate()
    with pytest.raises(burnish.Error, match="expected path=value"):
        burnish.Scene(scene()).set("degree")
    for threads in (-1, 1025):
        with pytest.raises(burnish.Error, match=f"threads: found {threads}; expected a number from 1 to 1024, or 0"):
            burnish.Scene(scene()).run(tmp_path / "run", threads=threads)
    with pytest.raises(TypeError, match="interpreted as an integer"):
        burnish.Scene(scene()).run(tmp_path / "run", threads="two")
    assert not (tmp_path / "run").exists()
    with pytest.raises(burnish.Error, match="absent.yaml: cannot be read: No such file"):
        burnish.Scene(tmp_path / "absent.yaml")


def test_warnings_are_told(tmp_path):
    locking = burnish.Scene(scene(formulation="displacement"))
    assert "add formulation: fbar" in locking.validate()[0]
    with pytest.warns(UserWarning, match="add formulation: fbar"):
        locking.run(tmp_path)


def test_steps_are_told(press, tmp_path):
    steps = []
    run = burnish.Scene(SCENES["press"]).run(tmp_path, on_step=lambda step: steps.append((step, step.history)))
    assert [step.time for step, _ in steps] == [0.25, 0.5, 0.75, 1] and {step.end_time for step, _ in steps} == {1}
    assert [row["disc.fy"] for _, row in steps] == run.history["disc.fy"][1:].tolist()
    assert [step.iterations for step, _ in steps] == run.history["newton_iterations"][1:].tolist()
    assert [step.number for step, _ in steps] == [1, 2, 3, 4]


def test_an_exception_ends_a_run_that_can_go_on(press, tmp_path):
    class Enough(Exception):
        pass

    def stop(step):
        if step.number == 3:
            raise Enough(step.time)

    with pytest.raises(Enough, match="0.75"):
        burnish.Scene(press.directory.parent / "press.yaml").run(tmp_path, on_step=stop)
    run = burnish.open(tmp_path)
    assert not run.has_ended and run.history["time"].tolist() == [0, 0.25, 0.5, 0.75] and len(run.frames) == 2
    times = []
    run = burnish.resume(tmp_path, on_step=lambda step: times.append(step.time))
    assert times == [1] and run.summary["completed"]
    expected = files_of(press.directory)
    expected.pop("probe.png", None)
    assert files_of(tmp_path) == expected
    with pytest.raises(burnish.Error, match="cannot be resumed: .*it came to its end"):
        burnish.resume(tmp_path)


def test_ctrl_c_ends_a_run_that_can_go_on(tmp_path):
    def press_keys(step):
        if step.number == 2:
            signal.raise_signal(signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        burnish.Scene(SCENES["press"]).run(tmp_path, on_step=press_keys)
    assert burnish.open(tmp_path).history.num_rows in (3, 4)
    assert burnish.resume(tmp_path).summary["completed"]


def test_ctrl_c_without_a_function(tmp_path):
    def press_keys():
        while not (tmp_path / "history.csv").exists() or (tmp_path / "history.csv").read_text().count("\n") < 4:
            time.sleep(0.01)
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=press_keys)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        burnish.Scene(scene(steps=[{"until": 1, "count": 20000}])).run(tmp_path)
    thread.join()
    assert 3 <= burnish.open(tmp_path).history.num_rows < 20000


def test_other_threads_go_on(tmp_path):
    """The interpreter's lock is free while the engine computes."""
    ticks = []
    ended = threading.Event()

    def tick():
        while not ended.wait(0.001):
            ticks.append(1)

    thread = threading.Thread(target=tick)
    thread.start()
    burnish.Scene(scene(geometry={"shape": "rectangle", "size": [2, 1], "functions": [60, 40]})).run(tmp_path)
    ended.set()
    thread.join()
    assert len(ticks) > 5


def test_runs_that_do_not_reach_their_end(tmp_path):
    hard = scene(tools=[{"name": "disc", "shape": "cylinder", "center": [1, 1.5], "radius": 0.5,
                         "motion": {"times": [0, 1], "y": [0, -0.6]}}], steps=[{"until": 1, "count": 1}], solver={"max_cuts": 0})
    with pytest.raises(burnish.RunStopped, match="did not reach its end.*\n?.*") as stopped:
        burnish.Scene(hard).run(tmp_path)
    assert stopped.value.run.summary["completed"] is False and stopped.value.run.history.num_rows >= 1


def test_what_would_be_overwritten(press, tmp_path):
    (tmp_path / "history.csv").write_text("mine")
    with pytest.raises(burnish.Error, match="history.csv is not of a run of burnish and would be overwritten"):
        burnish.Scene(SCENES["press"]).run(tmp_path)
    shutil.copytree(press.directory, tmp_path / "run")
    (tmp_path / "run/pictures").mkdir()
    with pytest.raises(burnish.Error, match="pictures is of an earlier run and would not be renewed"):
        burnish.Scene(SCENES["press"]).run(tmp_path / "run")
    (tmp_path / "run/pictures").rmdir()
    burnish.Scene(SCENES["ring"]).run(tmp_path / "run")
    assert burnish.open(tmp_path / "run").tools == ()


def test_a_directory_is_made_when_none_is_given():
    run = burnish.Scene(SCENES["ring"]).run()
    assert run.summary["completed"]
    shutil.rmtree(run.directory)


def test_threads_of_other_libraries_are_given_back(tmp_path):
    """A product of numpy is as fast after a run as before: it has its threads."""
    code = f"""
import ctypes, burnish, sys
sys.path.insert(0, {str(Path(__file__).parent)!r})
from scenes import SCENES
blas = ctypes.CDLL("libopenblas.so.0")
before = blas.openblas_get_num_threads()
burnish.Scene(SCENES["ring"]).run({str(tmp_path)!r})
assert blas.openblas_get_num_threads() == before, (before, blas.openblas_get_num_threads())
"""
    subprocess.run([sys.executable, "-c", code], check=True)


def test_results_can_be_read_in_the_callback(tmp_path):
    """h5py and the engine take turns."""
    frames = []
    burnish.Scene(SCENES["press"]).run(tmp_path, on_step=lambda step: frames.append(len(burnish.open(tmp_path).frames)))
    assert frames == [1, 1, 2, 2]
    with h5py.File(tmp_path / "result.h5") as file:
        assert file.attrs["kind"] == b"model"


def test_runs_of_several_threads_take_turns(tmp_path):
    runs = {}

    def compute(name):
        runs[name] = burnish.Scene(SCENES["press"]).run(tmp_path / name)

    threads = [threading.Thread(target=compute, args=(name,)) for name in "abc"]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sorted(runs) == ["a", "b", "c"]
    assert files_of(tmp_path / "a") == files_of(tmp_path / "b") == files_of(tmp_path / "c")


def test_the_engine_is_that_for_newer_processors_where_the_command_is(tmp_path):
    """A package that has both, with one compiled part in the place of the other."""
    package = Path(burnish.__file__).parent
    shutil.copytree(package, tmp_path / "burnish", ignore=shutil.ignore_patterns("__pycache__", "_engine*"))
    (tmp_path / "burnish/newer").mkdir()
    for compiled in package.glob("_engine*.so"):
        (tmp_path / "burnish/newer" / compiled.name).symlink_to(compiled.resolve())
    code = """
from burnish import scene
scene._processor_features = lambda: {"fpu", "avx2", "fma", "bmi2"}
print(scene._engine().__name__)
scene._processor_features = lambda: {"fpu", "avx2"}
try:
    scene._engine()
except Exception as error:
    print(error)
"""
    told = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True,
                          env=dict(os.environ, PYTHONPATH=str(tmp_path))).stdout.splitlines()
    assert told[0] == "burnish.newer._engine"
    assert told[1].startswith("the engine is not there")
