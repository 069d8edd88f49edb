"""Runs the table of hostile commands: each must end with its exit code and a sentence, in its time and memory, without the
words of a library or a signal. See the top of commands.yaml for the columns.

Usage: hostile_test.py BURNISH [PATTERN]     PATTERN: only rows whose command matches
"""

import concurrent.futures
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

import yaml

TABLE = pathlib.Path(__file__).with_name("commands.yaml")
KEYS = {"run", "code", "says", "prints", "seconds", "memory", "scene", "files", "before", "after", "lines"}
NOISE = re.compile(r"internal error|ERROR: In|Warning: In|vtk[A-Z]\w+ \(0x|terminate called|std::|Aborted|Segmentation|core dumped|"
                   r"OpenBLAS|HDF5-DIAG|Sanitizer|Traceback|\x1b\[")
AT_ONCE = 2


def check_table(table):
    for number, row in enumerate(table["rows"]):
        unknown = set(row) - KEYS
        if unknown or "run" not in row:
            sys.exit(f"{TABLE}: row {number + 1} ({row.get('run')}): unknown keys {unknown} or no run")


def scene_text(base, changes):
    """The base scene with other values for some of its keys; null leaves a key out."""
    lines = {**base, **(changes or {})}
    return "".join(f"{key}: {value}\n" for key, value in lines.items() if value is not None)


class Bench:
    """Places for the rows, with what every row may use: the program, a scene, a result and a picture of it."""

    def __init__(self, program, table, root):
        self.root, self.base = root, table["base"]
        self.sanitized = b"__asan_init" in program.read_bytes()
        (root / "bin").mkdir()
        (root / "bin/burnish").symlink_to(program)
        self.environment = {**os.environ, "PATH": f"{root / 'bin'}:{os.environ['PATH']}", "LC_ALL": "C.UTF-8"}
        self.sample = root / "sample"
        self.sample.mkdir()
        (self.sample / "base.yaml").write_text(scene_text(self.base, {}))
        made = subprocess.run(["bash", "-ec", table["sample"]], cwd=self.sample, env=self.environment,
                              capture_output=True, text=True)
        if made.returncode != 0:
            sys.exit(f"the sample cannot be made: {made.stderr}")

    def place(self, number, row):
        place = self.root / f"row_{number}"
        shutil.copytree(self.sample, place, symlinks=True)
        (place / "scene.yaml").write_text(scene_text(self.base, row.get("scene")))
        for name, text in row.get("files", {}).items():
            (place / name).parent.mkdir(parents=True, exist_ok=True)
            (place / name).write_bytes(text if isinstance(text, bytes) else str(text).encode())
        return place

    def shell(self, place, line):
        return subprocess.run(["bash", "-c", line], cwd=place, env=self.environment, capture_output=True)


def run(bench, place, row):
    """Exit code (negative: by a signal), seconds, MB, and what was printed on both channels."""
    seconds = row.get("seconds", 10) * (20 if bench.sanitized else 1)
    with open(place / ".out", "wb") as out, open(place / ".err", "wb") as err:
        start = time.monotonic()
        process = subprocess.Popen(["bash", "-c", row["run"]], cwd=place, env=bench.environment, stdin=subprocess.DEVNULL,
                                   stdout=out, stderr=err, start_new_session=True)
        alarm = threading.Timer(seconds, os.killpg, (process.pid, signal.SIGKILL))
        alarm.start()
        _, status, usage = os.wait4(process.pid, 0)
        alarm.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
    return (process.returncode, time.monotonic() - start, usage.ru_maxrss / 1024,
            (place / ".out").read_bytes().decode(errors="replace"), (place / ".err").read_bytes().decode(errors="replace"))


def judge(bench, number, row):
    """What is wrong with a row, with its seconds and MB."""
    place = bench.place(number, row)
    try:
        if "before" in row and (before := bench.shell(place, f"set -e; {row['before']}")).returncode != 0:
            return [f"before fails: {before.stderr.decode()}"], 0, 0
        code, seconds, memory, out, err = run(bench, place, row)
        faults = []
        expected = row.get("code", 2)
        if code != expected:
            faults.append(f"exit code {code} instead of {expected}")
        if expected != 0 and "says" not in row:
            faults.append("the row does not say what the message says")
        for name, text, pattern in (("says", err, row.get("says")), ("prints", out, row.get("prints"))):
            if pattern is not None and not (re.search(pattern, text) if pattern else text == ""):
                faults.append(f"{name} /{pattern}/ is not in it")
        if NOISE.search(err):
            faults.append("noise on standard error")
        if err.count("\n") > row.get("lines", 4):
            faults.append(f"{err.count(chr(10))} lines on standard error")
        if seconds > row.get("seconds", 10) and not bench.sanitized:
            faults.append(f"{seconds:.1f} s")
        if memory > row.get("memory", 300) and not bench.sanitized:
            faults.append(f"{memory:.0f} MB")
        if "after" in row and (after := bench.shell(place, f"set -e; {row['after']}")).returncode != 0:
            faults.append(f"after fails: {row['after']} {after.stderr.decode()}")
        if faults:
            faults.append(f"err: {err[:1500].rstrip()}")
            if out:
                faults.append(f"out: {out[:500].rstrip()}")
        return faults, seconds, memory
    finally:
        shutil.rmtree(place, ignore_errors=True)


def main():
    program, pattern = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2] if len(sys.argv) > 2 else "."
    table = yaml.safe_load(TABLE.read_text())
    check_table(table)
    begin, broken, slowest, largest = time.monotonic(), 0, (0, ""), (0, "")
    rows = [(number, row) for number, row in enumerate(table["rows"], 1) if re.search(pattern, row["run"])]
    with tempfile.TemporaryDirectory(prefix="burnish_hostile_") as root:
        bench = Bench(program, table, pathlib.Path(root))
        if bench.sanitized:  # address sanitizers reserve terabytes
            rows = [(number, row) for number, row in rows if not re.search("ulimit -[vds]", row["run"])]
        with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:
            for (number, row), (faults, seconds, memory) in zip(
                    rows, pool.map(lambda entry: judge(bench, *entry), rows)):
                slowest, largest = max(slowest, (seconds, row["run"])), max(largest, (memory, row["run"]))
                if faults:
                    broken += 1
                    print(f"row {number}: {row['run']}\n  " + "\n  ".join(faults))
    print(f"{len(rows)} commands in {time.monotonic() - begin:.0f} s, {broken} not as they must be; "
          f"at most {slowest[0]:.1f} s ({slowest[1][:60]}) and {largest[0]:.0f} MB ({largest[1][:60]})")
    sys.exit(1 if broken or not rows else 0)


if __name__ == "__main__":
    main()
