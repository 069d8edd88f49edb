#!/usr/bin/env python3
"""Iterations of multigrid per linear system, solved to 1e-8, on finer and finer blocks.

    bench/scale/mesh_independence.py build/release/burnish [SPANS ...]

A block, held at its back, is pulled in its middle or touched by a ball. Each line is one case, each column one mesh of
SPANS x SPANS x SPANS knot spans (8 12 16 when left out); F after a number: so many systems went to a direct solver in
the end. Beside them the processor seconds per unknown and system of set-up and solution on the finest mesh, in
microseconds.
"""
import pathlib
import subprocess
import sys
import tempfile

import yaml

PULLED = """
loads:
  - face: front
    traction: [0.01, 0.02, "-0.1*exp(-20*(X^2 + Y^2))"]
    schedule: {times: [0, 1], values: [0, 1]}
steps: [{until: 1, count: 1}]
"""
PRESSED = """
tools:
  - {name: ball, shape: sphere, center: [0, 0, 0.5], radius: 0.5, motion: {times: [0, 1, 2], z: [0, -0.04, -0.04], x: [0, 0, 0.04]}}
contact: [{tool: ball, face: front, %s}]
steps: [{until: 1, count: 2}, {until: 2, count: 1}]
"""
ELASTIC = "{law: neo-hookean, E: 1, nu: 0.3}"
STIFF = "{law: neo-hookean, E: 1, nu: 0.49}"
PLASTIC = "{law: j2, E: 100, nu: 0.3, hardening: {law: linear, sigma0: 1, modulus: 2}}"
EQUAL = '["s", "s", "s"]'
GRADED = '["s + 0.9*sin(2*pi*s)/(2*pi)", "s + 0.9*sin(2*pi*s)/(2*pi)", "1 - 0.1*(1 - s) - 0.9*(1 - s)^2"]'
AT_POINTS = PRESSED % "method: integral-augmented-lagrangian"
RUBBING = PRESSED % "method: integral-augmented-lagrangian, friction: 0.3"
BY_AVERAGES = PRESSED % "method: augmented-lagrangian"

CASES = [
    ("elastic, p = 1", 1, "nurbs", EQUAL, ELASTIC, PULLED),
    ("elastic, p = 2", 2, "nurbs", EQUAL, ELASTIC, PULLED),
    ("elastic, p = 3", 3, "nurbs", EQUAL, ELASTIC, PULLED),
    ("elastic, Lagrange p = 2", 2, "lagrange", EQUAL, ELASTIC, PULLED),
    ("elastic, p = 2, graded 1:20", 2, "nurbs", GRADED, ELASTIC, PULLED),
    ("nu = 0.49, p = 2", 2, "nurbs", EQUAL, STIFF, PULLED),
    ("contact at points, p = 2", 2, "nurbs", EQUAL, ELASTIC, AT_POINTS),
    ("contact at points, p = 2, graded 1:20", 2, "nurbs", GRADED, ELASTIC, AT_POINTS),
    ("contact at points, plastic, p = 2", 2, "nurbs", EQUAL, PLASTIC, AT_POINTS),
    ("contact at points, friction 0.3, p = 2", 2, "nurbs", EQUAL, ELASTIC, RUBBING),
    ("contact by averages, p = 2", 2, "nurbs", EQUAL, ELASTIC, BY_AVERAGES),
    ("contact at points, p = 3", 3, "nurbs", EQUAL, ELASTIC, AT_POINTS),
]


def scene(degree, basis, grading, material, rest, spans):
    return f"""title: Block of {spans} x {spans} x {spans} knot spans
basis: {basis}
degree: {degree}
geometry: {{shape: box, origin: [-0.5, -0.5, -1], size: [1, 1, 1], spans: [{spans}, {spans}, {spans}], grading: {grading}}}
material: {material}
supports: [{{face: back, fix: [x, y, z]}}]
solver: {{linear: multigrid, linear_tolerance: 1e-8}}
output: {{every: 2}}
{rest}"""


def run(program, text, directory):
    path = pathlib.Path(directory, "scene.yaml")
    path.write_text(text)
    results = pathlib.Path(directory, "results")
    subprocess.run([program, "run", path, "-o", results, "--quiet", "--threads", "1"], check=True, stdout=subprocess.DEVNULL)
    return yaml.safe_load((results / "summary.yaml").read_text())


def main():
    program, meshes = sys.argv[1], [int(n) for n in sys.argv[2:]] or [8, 12, 16]
    print("| case |" + "".join(f" {n}³ |" for n in meshes) + " set-up µs | solution µs |")
    print("| --- |" + " ---: |" * (len(meshes) + 2))
    for name, *what in CASES:
        line = f"| {name} |"
        for spans in meshes:
            with tempfile.TemporaryDirectory() as directory:
                summary = run(program, scene(*what, spans), directory)
            systems = summary["linear_systems"]
            line += f" {summary['linear_iterations'] / systems:.1f}" + "F" * summary["linear_fallbacks"] + " |"
        per = 1e6 / systems / summary["unknowns"]
        print(f"{line} {per * summary['factorisation_seconds']:.0f} | {per * summary['solve_seconds']:.0f} |", flush=True)


if __name__ == "__main__":
    main()
