#!/usr/bin/env python3
"""Ranks are killed and stopped at any moment; what was saved must be whole and go on with any number of ranks.

    bench/scale/kills.py build/release/burnish [TIMES [SEED]]

A plastic block under a ball that rubs along it is computed once by one process, and then by two to four ranks, of which one
gets SIGKILL, SIGTERM or SIGINT at a random moment, until TIMES runs (20 when left out) have been hit before their end. All frames that were saved are read,
the run goes on with another number of ranks, and its history has to agree with that of the whole run within 1e-10 of each
column's largest value. At last a run meets a full disc (a file system of its own in memory, for which one has to be root),
and goes on when there is space again. Ends with 1 where any of this does not hold.
"""
import csv
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

SCENE = """
degree: 2
geometry: {shape: box, origin: [-0.5, -0.5, -1], size: [1, 1, 1], spans: [5, 4, 5]}
supports: [{face: back, fix: [x, y, z]}]
material: {law: j2, E: 100, nu: 0.3, hardening: {law: linear, sigma0: 0.3, modulus: 2}}
tools:
  - {name: ball, shape: sphere, center: [0, 0, 0.5], radius: 0.5, motion: {times: [0, 1, 2], x: [0, 0, 0.06], z: [0, -0.05, -0.05]}}
contact: [{tool: ball, face: front, method: integral-augmented-lagrangian, friction: 0.2}]
steps: [{until: 1, count: 4}, {until: 2, count: 4}]
solver: {linear: multigrid, tolerance: 1.0e-11}
output: {every: 0.25, vtu: false}
"""


def line(program, ranks, *arguments):
    start = ["mpirun", "--oversubscribe", "--bind-to", "none", "--allow-run-as-root", "-n", str(ranks)] if ranks > 1 else []
    return [*map(str, start), str(program), *map(str, arguments)]


def history(directory):
    with open(directory / "history.csv", newline="") as file:
        rows = list(csv.reader(row for row in file if not row.startswith("#")))
    return rows[0], [list(map(float, row)) for row in rows[1:]]


def largest_difference(one, other):
    """Over the largest value of each column; columns x, y, z of a vector are one."""
    names, rows = history(one)
    others, same = history(other)
    if names != others or len(rows) != len(same):
        return float("inf")
    sizes, differences = {}, {}
    for c, name in enumerate(names):
        if name == "newton_iterations":
            continue
        name = name[:-1] if name[-1] in "xyz" else name
        for a, b in zip(rows, same):
            sizes[name] = max(sizes.get(name, 0.0), abs(a[c]))
            differences[name] = max(differences.get(name, 0.0), abs(a[c] - b[c]))
    return max(differences[name] / size for name, size in sizes.items() if size > 1e-15)


def ranks_of(mpirun):
    children = []
    for task in pathlib.Path(f"/proc/{mpirun.pid}/task").iterdir():
        children += (task / "children").read_text().split()
    return list(map(int, children))


def whole(program, directory):
    """All frames can be read."""
    with tempfile.TemporaryDirectory() as unused:
        return subprocess.run([program, "export", directory, "-o", unused], capture_output=True).returncode == 0


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    program = pathlib.Path(sys.argv[1]).resolve()
    times = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    chance = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 1)
    failures = 0
    with tempfile.TemporaryDirectory() as work:
        work = pathlib.Path(work)
        scene = work / "scene.yaml"
        scene.write_text(SCENE)
        expected = work / "expected"
        subprocess.run(line(program, 1, "run", scene, "-o", expected, "--quiet", "--threads", 1), check=True)

        def judge(what, directory, others):
            nonlocal failures
            left = "nothing"
            if (directory / "history.csv").exists():
                left = f"{len(list((directory / 'result').glob('frame_*')))} frames"
            saved = left == "nothing" or whole(program, directory)
            again = subprocess.run(line(program, others, "run", scene, "-o", directory, "--continue", "--quiet"), capture_output=True,
                                   text=True)
            difference = largest_difference(expected, directory) if again.returncode == 0 else float("inf")
            fine = saved and difference < 1e-10
            failures += not fine
            print(f"{what}: {left}, {'whole' if saved else 'BROKEN'}; on {others}: {difference:.1e}{'' if fine else ' WRONG ' + again.stderr}",
                  flush=True)

        start = time.monotonic()
        subprocess.run(line(program, 2, "run", scene, "-o", work / "timed", "--quiet"), check=True)
        seconds = time.monotonic() - start
        hits = 0
        while hits < times:
            ranks, others = chance.sample([1, 2, 3, 4], 2)
            ranks = max(ranks, 2)
            sent = chance.choice([signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
            moment = chance.uniform(0.0, 0.9) * seconds
            directory = work / "killed"
            run = subprocess.Popen(line(program, ranks, "run", scene, "-o", directory, "--quiet"), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
            time.sleep(moment)
            who = "no rank"  # where all have come to their end
            if run.poll() is None and (processes := ranks_of(run)):
                which = chance.randrange(len(processes))
                if subprocess.run(["kill", f"-{sent.value}", str(processes[which])], capture_output=True).returncode == 0:
                    who = f"rank {which}"
            code = run.wait(timeout=120)
            if who == "no rank" or code == 0:
                seconds = min(seconds, moment)  # others have left more of the machine to it than to the run that was timed
            else:
                hits += 1
                judge(f"{hits:2}: {who} of {ranks}, {sent.name} after {moment:.1f} s, code {code}", directory, others)
            shutil.rmtree(directory, ignore_errors=True)

        disc = work / "disc"
        disc.mkdir()
        half = sum(file.stat().st_size for file in expected.rglob("*") if file.is_file()) // 2
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={half}", "tmpfs", disc], check=True)
        try:
            run = subprocess.run(line(program, 2, "run", scene, "-o", disc / "out", "--quiet"), capture_output=True, text=True)
            told = [text for text in run.stderr.splitlines() if text.startswith("burnish: ")]
            subprocess.run(["mount", "-o", "remount,size=100m", disc], check=True)
            judge(f"full disc, code {run.returncode}, {told[:1]}", disc / "out", 3)
        finally:
            subprocess.run(["umount", disc], check=True)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
