#!/usr/bin/env python3
"""What `burnish validate` tells of memory and time, beside what runs take on one core of this machine.

    bench/scale/cost_model.py build/release/burnish SCENE [SCENE ...]

Each line is one scene: memory, seconds per Newton iteration, and iterations per step, as told and as measured, with
their ratio. Times of runs are those of a clock: keep the machine quiet.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import yaml

BYTES = {"MB": 1e6, "GB": 1e9}
SECONDS = {" ms": 1e-3, " s": 1.0}


def duration(text):
    """Seconds of "12 ms", "3.4 s", "1:44" or "1:02:03"."""
    for unit, seconds in SECONDS.items():
        if text.endswith(unit):
            return float(text.removesuffix(unit)) * seconds
    return sum(60.0**k * float(part) for k, part in enumerate(reversed(text.split(":"))))


def told(program, scene):
    """Bytes, seconds per iteration and iterations per step."""
    text = subprocess.run([program, "validate", scene], check=True, capture_output=True, text=True).stdout
    size, unit = re.search(r"takes about ([\d.]+) (MB|GB)", text).groups()
    seconds = duration(re.search(r"on one core (.+) per Newton", text).group(1))
    steps = re.search(r"steps of some ([\d.]+) iterations", text).group(1)
    return float(size) * BYTES[unit], seconds, float(steps)


def measured(program, scene, directory):
    """The same of a run."""
    run = subprocess.Popen([program, "run", scene, "-o", directory, "--quiet", "--threads", "1", "--set", "pictures=[]"],
                           stderr=subprocess.DEVNULL)
    _, _, usage = os.wait4(run.pid, 0)
    summary = yaml.safe_load((directory / "summary.yaml").read_text())
    seconds = sum(summary[f"{part}_seconds"] for part in ("assembly", "contact", "factorisation", "solve"))
    return 1024 * usage.ru_maxrss, seconds / summary["iterations"], summary["iterations"] / summary["steps"]


def main():
    program, scenes = sys.argv[1], sys.argv[2:]
    if not scenes:
        sys.exit(__doc__)
    print(f"{'scene':28}{'MB':>7}{'run':>7}{'ratio':>7}{'ms':>9}{'run':>9}{'ratio':>7}{'iterations':>12}{'run':>6}")
    for scene in scenes:
        with tempfile.TemporaryDirectory() as work:
            a, b = told(program, scene), measured(program, scene, pathlib.Path(work) / "out")
        print(f"{pathlib.Path(scene).stem:28}{a[0] / 1e6:7.0f}{b[0] / 1e6:7.0f}{a[0] / b[0]:7.2f}"
              f"{1e3 * a[1]:9.2f}{1e3 * b[1]:9.2f}{a[1] / b[1]:7.2f}{a[2]:12.1f}{b[2]:6.1f}", flush=True)


if __name__ == "__main__":
    main()
