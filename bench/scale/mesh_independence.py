#!/usr/bin/env python3
"""Iterations of multigrid per linear system, solved to 1e-8, on finer and finer bodies.

    bench/scale/mesh_independence.py build/release/burnish [SPANS ...] [--only PATTERN]

A block, held at its back, is pulled in its middle or touched by a ball; an octant of a ball is pressed on a plane. Each
line is one case (of those whose names match PATTERN), each column one mesh of SPANS x SPANS x SPANS knot spans (8 12 16
when left out); behind a + stand the V-cycles that were set up per system, which are kept from system to system where
they still do; an F is a system that went to a direct solver in the end. Beside them the processor seconds per unknown
and system of set-up and solution on the finest mesh, in microseconds.
"""
import argparse
import dataclasses
import pathlib
import re
import subprocess
import sys
import tempfile

import yaml

EQUAL = '["s", "s", "s"]'
GRADED = '["s + 0.9*sin(2*pi*s)/(2*pi)", "s + 0.9*sin(2*pi*s)/(2*pi)", "1 - 0.1*(1 - s) - 0.9*(1 - s)^2"]'
BLOCK = """
geometry: {shape: box, origin: [-0.5, -0.5, -1], size: [1, 1, 1], spans: [ALL, ALL, ALL], grading: GRADING}
supports: [{face: back, fix: [x, y, z]}]
"""
TWO_BLOCKS = """
geometry:
  shape: patches
  patches:
    - {name: a, shape: box, origin: [-0.5, -0.5, -1], size: [0.5, 1, 1], spans: [HALF, ALL, ALL]}
    - {name: b, shape: box, origin: [0, -0.5, -1], size: [0.5, 1, 1], spans: [HALF, ALL, ALL]}
supports: [{patch: a, face: back, fix: [x, y, z]}, {patch: b, face: back, fix: [x, y, z]}]
"""
OCTANT = """
geometry: {shape: ball-octant, radius: 1, pole: [0, -1, 0], spans: [ALL, ALL, ALL]}
supports:
  - {face: bottom, symmetry: true}
  - {face: back, symmetry: true}
  - {face: top, move: {times: [0, 1], x: [0, 0], y: [0, -0.02], z: [0, 0]}}
tools: [{name: floor, shape: plane, origin: [0, -1, 0], normal: [0, 1, 0]}]
contact: [{tool: floor, face: right, method: integral-augmented-lagrangian}]
steps: [{until: 1, count: 2}]
"""
TRACTION = """traction: [0.01, 0.02, "-0.1*exp(-20*(X^2 + Y^2))"], schedule: {times: [0, 1], values: [0, 1]}"""
PULLED = f"""
loads: [{{face: front, {TRACTION}}}]
steps: [{{until: 1, count: STEPS}}]
"""
PULLED_BOTH = f"""
loads: [{{patch: a, face: front, {TRACTION}}}, {{patch: b, face: front, {TRACTION}}}]
steps: [{{until: 1, count: STEPS}}]
"""
PRESSED = """
tools:
  - {name: ball, shape: sphere, center: [0, 0, 0.5], radius: 0.5, motion: {times: [0, 1, 2], z: [0, -0.04, -0.04], x: [0, 0, 0.04]}}
contact: [{tool: ball, face: front, %s}]
steps: [{until: 1, count: STEPS}, {until: 2, count: STEPS}]
"""
ELASTIC = "{law: neo-hookean, E: 1, nu: 0.3}"
STIFF = "{law: neo-hookean, E: 1, nu: 0.49}"
PLASTIC = "{law: j2, E: 100, nu: 0.3, hardening: {law: linear, sigma0: 1, modulus: 2}}"
AT_POINTS = PRESSED % "method: integral-augmented-lagrangian"
RUBBING = PRESSED % "method: integral-augmented-lagrangian, friction: 0.3"
BY_AVERAGES = PRESSED % "method: augmented-lagrangian"


@dataclasses.dataclass
class Case:
    name: str
    what: str
    body: str = BLOCK
    degree: int = 2
    basis: str = "nurbs"
    grading: str = EQUAL
    material: str = ELASTIC
    formulation: str = "displacement"
    steps: int = 2

    def scene(self, spans):
        given = {"GRADING": self.grading, "STEPS": self.steps, "HALF": spans // 2, "ALL": spans}
        text = f"""title: {self.name}, {spans} spans
basis: {self.basis}
degree: {self.degree}
formulation: {self.formulation}
material: {self.material}
solver: {{linear: multigrid, linear_tolerance: 1e-8}}
output: {{every: 2, vtu: false}}
{self.body}{self.what}"""
        for key, value in given.items():
            text = text.replace(key, str(value))
        return text


CASES = [
    Case("elastic, p = 1", PULLED, degree=1),
    Case("elastic, p = 2", PULLED),
    Case("elastic, p = 3", PULLED, degree=3),
    Case("elastic, p = 4", PULLED, degree=4),
    Case("elastic, Lagrange p = 2", PULLED, basis="lagrange"),
    Case("elastic, p = 2, graded 1:20", PULLED, grading=GRADED),
    Case("elastic, p = 3, graded 1:20", PULLED, degree=3, grading=GRADED),
    Case("elastic, p = 2, two patches", PULLED_BOTH, TWO_BLOCKS),
    Case("octant of a ball on a plane, p = 2", "", OCTANT),
    Case("nu = 0.49, p = 2", PULLED, material=STIFF, steps=8),
    Case("nu = 0.49, p = 2, graded 1:20", PULLED, material=STIFF, grading=GRADED, steps=8),
    Case("nu = 0.49, p = 3", PULLED, degree=3, material=STIFF, steps=8),
    Case("F-bar, p = 2", PULLED, formulation="fbar"),
    Case("F-bar, p = 3", PULLED, degree=3, formulation="fbar"),
    Case("nu = 0.49, F-bar, p = 2", PULLED, material=STIFF, formulation="fbar", steps=8),
    Case("nu = 0.49, F-bar, p = 2, graded 1:20", PULLED, material=STIFF, formulation="fbar", grading=GRADED, steps=8),
    Case("nu = 0.49, F-bar, p = 3", PULLED, degree=3, material=STIFF, formulation="fbar", steps=8),
    Case("contact at points, p = 2", AT_POINTS),
    Case("contact at points, p = 2, graded 1:20", AT_POINTS, grading=GRADED),
    Case("contact at points, plastic, p = 2", AT_POINTS, material=PLASTIC, steps=8),
    Case("contact at points, plastic, F-bar, p = 2", AT_POINTS, material=PLASTIC, formulation="fbar", steps=8),
    Case("contact at points, friction 0.3, p = 2", RUBBING),
    Case("contact by averages, p = 2", BY_AVERAGES),
    Case("contact at points, p = 3", AT_POINTS, degree=3),
]


def run(program, text, directory):
    path = pathlib.Path(directory, "scene.yaml")
    path.write_text(text)
    results = pathlib.Path(directory, "results")
    subprocess.run([program, "run", path, "-o", results, "--quiet", "--threads", "1"], check=True, stdout=subprocess.DEVNULL)
    return yaml.safe_load((results / "summary.yaml").read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("spans", nargs="*", type=int, default=[8, 12, 16])
    parser.add_argument("--only", default="", help="cases whose names match this regular expression")
    given = parser.parse_args()
    program, meshes = given.program, given.spans
    print("| case |" + "".join(f" {n}³ |" for n in meshes) + " set-up µs | solution µs |")
    print("| --- |" + " ---: |" * (len(meshes) + 2))
    for case in CASES:
        if not re.search(given.only, case.name):
            continue
        line = f"| {case.name} |"
        for spans in meshes:
            with tempfile.TemporaryDirectory() as directory:
                summary = run(program, case.scene(spans), directory)
            systems = summary["linear_systems"]
            line += f" {summary['linear_iterations'] / systems:.1f} + {summary['linear_set_ups'] / systems:.2f}"
            line += "F" * summary["linear_fallbacks"] + " |"
        per = 1e6 / systems / summary["unknowns"]
        print(f"{line} {per * summary['factorisation_seconds']:.0f} | {per * summary['solve_seconds']:.0f} |", flush=True)


if __name__ == "__main__":
    main()
