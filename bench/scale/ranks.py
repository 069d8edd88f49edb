#!/usr/bin/env python3
"""What several processes do and send, counted: numbers that do not depend on the machine.

    bench/scale/ranks.py build/release/burnish [SPANS [RANKS ...]]

A block of SPANS x SPANS x SPANS knot spans of degree 2 (12 when left out), elastic, pulled in its middle, on 1, 2, 4, ...
64 ranks, more of them than cores if need be. Columns: spans that all ranks assemble, over those of the body; the most
entries of the tangent that a rank has, over the mean; linear iterations per system; megabytes that a rank sends at most
per linear iteration; seconds, which mean something only where there are as many cores as ranks.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

import yaml

SCENE = """
degree: 2
geometry: {shape: box, origin: [-0.5, -0.5, -1], size: [1, 1, 1], spans: [ALL, ALL, ALL]}
supports: [{face: back, fix: [x, y, z]}]
material: {law: neo-hookean, E: 1, nu: 0.3}
loads: [{face: front, traction: [0.01, 0.02, "-0.1*exp(-20*(X^2 + Y^2))"], schedule: {times: [0, 1], values: [0, 1]}}]
steps: [{until: 1, count: 2}]
solver: {linear: multigrid}
output: {every: 1, vtu: false}
"""
RANK = re.compile(r"rank \d+ +(\d+) spans, ([\d.e+-]+) million entries of the tangent, ([\d.e+-]+) MB sent")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    program = str(pathlib.Path(sys.argv[1]).resolve())
    spans = int(sys.argv[2]) if len(sys.argv) > 2 else 12
    counts = [int(text) for text in sys.argv[3:]] or [1, 2, 4, 8, 16, 32, 64]
    print(f"{'ranks':>5} {'spans assembled':>16} {'imbalance':>10} {'iterations':>11} {'MB/iteration':>13} {'s':>8}")
    with tempfile.TemporaryDirectory() as work:
        scene = pathlib.Path(work) / "scene.yaml"
        scene.write_text(SCENE.replace("ALL", str(spans)))
        for ranks in counts:
            start = ["mpirun", "--oversubscribe", "--bind-to", "none", "--allow-run-as-root", "-n", str(ranks)]
            run = subprocess.run([*(start if ranks > 1 else []), program, "run", scene, "-o", pathlib.Path(work) / str(ranks), "--timings",
                                  "--threads", "1"], check=True, capture_output=True, text=True)
            summary = yaml.safe_load((pathlib.Path(work) / str(ranks) / "summary.yaml").read_text())
            of = [tuple(map(float, found)) for found in RANK.findall(run.stdout)] or [(spans**3, 1.0, 0.0)]
            entries = [entry for _, entry, _ in of]
            iterations = summary["linear_iterations"]
            print(f"{ranks:5} {sum(number for number, _, _ in of) / spans**3:16.2f}"
                  f" {max(entries) * len(entries) / sum(entries):10.2f}"
                  f" {iterations / summary['linear_systems']:11.1f}"
                  f" {max(sent for _, _, sent in of) / iterations:13.3f} {summary['seconds']:8.1f}", flush=True)


if __name__ == "__main__":
    main()
