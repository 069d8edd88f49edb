#!/usr/bin/env python3
"""Processor time and memory of one problem with multigrid, with sparse factors and with CalculiX.

    bench/scale/beside_factors.py build/release/burnish [--ccx ccx] [--threads 1] [--most UNKNOWNS] SPANS ...

A cube of degree 2 with SPANS knot spans in every direction, neo-Hookean (E = 1, nu = 0.3), is held at its back and pulled
at its front by a thousandth of E in one step, to the same tolerances with either solver. CalculiX has bricks of 20 nodes
(C3D20R, NLGEOM, linear elastic) of about as many unknowns, with its default solver, in one increment. Sparse factors are
left out above --most unknowns. Each line: processor seconds in all and per iteration of Newton's method, the largest
resident memory, and how far the pulled face has moved.
"""
import argparse
import os
import pathlib
import re
import subprocess
import tempfile

import yaml

SCENE = """title: cube
degree: 2
geometry: {shape: box, origin: [0, 0, 0], size: [1, 1, 1], spans: [SPANS, SPANS, SPANS]}
supports: [{face: back, fix: [x, y, z]}]
loads: [{face: front, traction: [0, 0, 0.001], schedule: {times: [0, 1], values: [0, 1]}}]
material: {law: neo-hookean, E: 1, nu: 0.3}
measures: [{name: pulled, kind: face, face: front}]
solver: {linear: LINEAR}
steps: [{until: 1, count: 1}]
output: {vtu: false}
"""


def measured(command, directory, threads):
    """Processor seconds and megabytes of a command."""
    environment = dict(os.environ, OMP_NUM_THREADS=str(threads), CCX_NPROC_EQUATION_SOLVER=str(threads))
    with open(pathlib.Path(directory, "log"), "w") as log:
        process = subprocess.Popen(command, cwd=directory, env=environment, stdout=log, stderr=log)
        _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        raise SystemExit(f"{command} failed, see below\n" + pathlib.Path(directory, "log").read_text()[-2000:])
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def burnish(program, spans, linear, threads):
    with tempfile.TemporaryDirectory() as directory:
        pathlib.Path(directory, "scene.yaml").write_text(SCENE.replace("SPANS", str(spans)).replace("LINEAR", linear))
        seconds, megabytes = measured(
            [program, "run", "scene.yaml", "-o", "out", "--quiet", "--threads", str(threads)], directory, threads)
        summary = yaml.safe_load(pathlib.Path(directory, "out/summary.yaml").read_text())
        lines = pathlib.Path(directory, "out/history.csv").read_text().split("\n")
        moved = float(dict(zip(lines[0].split(","), lines[-2].split(",")))["pulled.uz"])
        return summary["unknowns"], summary["iterations"], seconds, megabytes, moved


def calculix(program, unknowns, threads):
    """Bricks n x n x n with nodes at their corners and in the middle of their edges."""
    n = min(range(2, 200), key=lambda k: abs(3 * ((k + 1) ** 3 + 3 * k * (k + 1) ** 2) - unknowns))
    number = {}

    def node(*place):  # in half steps
        return number.setdefault(place, len(number) + 1)

    corners = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
    edges = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
    offsets = corners + [tuple((a + b) // 2 for a, b in zip(corners[i], corners[j])) for i, j in edges]
    elements = [[node(2 * i + a, 2 * j + b, 2 * k + c) for a, b, c in offsets]
                for k in range(n) for j in range(n) for i in range(n)]
    text = ["*NODE, NSET=ALL"]
    text += [f"{name}, {x / 2 / n}, {y / 2 / n}, {z / 2 / n}" for (x, y, z), name in number.items()]
    text.append("*ELEMENT, TYPE=C3D20R, ELSET=BODY")
    for name, nodes in enumerate(elements, 1):
        words = [str(word) for word in [name] + nodes]
        text += [", ".join(words[:11]) + ",", ", ".join(words[11:])]
    text.append("*NSET, NSET=HELD")
    text += [str(name) for (_, _, z), name in number.items() if z == 0]
    text.append("*NSET, NSET=PULLED")
    text += [str(name) for (_, _, z), name in number.items() if z == 2 * n]
    text.append("*ELSET, ELSET=FRONT")
    text += [str(name) for name in range(len(elements) - n * n + 1, len(elements) + 1)]
    text += ["*MATERIAL, NAME=M", "*ELASTIC", "1, 0.3", "*SOLID SECTION, ELSET=BODY, MATERIAL=M", "*BOUNDARY", "HELD, 1, 3",
             "*STEP, NLGEOM", "*STATIC, DIRECT", "1, 1", "*DLOAD", "FRONT, P2, -0.001",
             "*NODE PRINT, NSET=PULLED", "U", "*END STEP", ""]
    with tempfile.TemporaryDirectory() as directory:
        pathlib.Path(directory, "cube.inp").write_text("\n".join(text))
        seconds, megabytes = measured([program, "cube"], directory, threads)
        log = pathlib.Path(directory, "log").read_text()
        moved = re.findall(r"^\s*\d+\s+\S+\s+\S+\s+(\S+)\s*$", pathlib.Path(directory, "cube.dat").read_text(), re.M)
        iterations = len(re.findall(r"^\s*iteration\s+\d+", log, re.M))
        return 3 * len(number), iterations, seconds, megabytes, sum(map(float, moved)) / len(moved)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--ccx")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--most", type=int, default=120_000)
    parser.add_argument("spans", type=int, nargs="+")
    given = parser.parse_args()
    program = str(pathlib.Path(given.program).resolve())
    print("| solver | unknowns | iterations | processor s | s per iteration | MB | moved |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: |")

    def line(name, result):
        unknowns, iterations, seconds, megabytes, moved = result
        print(f"| {name} | {unknowns} | {iterations} | {seconds:.1f} | {seconds / iterations:.2f} | {megabytes:.0f} | "
              f"{moved:.4e} |", flush=True)

    for spans in given.spans:
        result = burnish(program, spans, "multigrid", given.threads)
        line("multigrid", result)
        if result[0] > given.most:
            continue
        line("factors", burnish(program, spans, "direct", given.threads))
        if given.ccx:
            line("CalculiX", calculix(given.ccx, result[0], given.threads))


if __name__ == "__main__":
    main()
