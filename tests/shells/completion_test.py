"""Completion of burnish, driven in real shells: a line is typed, completed with the tabulator and handed to printf.

Usage: completion_test.py BURNISH SOURCE_DIR
"""

import os
import pathlib
import pty
import re
import select
import subprocess
import sys
import tempfile
import time

SCENE = """
geometry: {shape: rectangle, size: [2.0, 1.0], functions: [8, 5]}
material: {law: neo-hookean, E: 1.0, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}]
tools:
  - {name: disc, shape: cylinder, center: [1.0, 1.5], radius: 0.5, motion: {times: [0, 1], y: [0, -0.05]}}
  - {name: plate, shape: plane, origin: [0, 2], normal: [0, -1]}
contact: [{tool: disc, face: top}]
steps: [{until: 1, count: 4}]
output: {every: 0.25, vtu: false}
"""
STUDY = """
runs: [{name: a, scene: press.yaml}]
figures: [{name: force, kind: history, runs: [a], y: disc.fy}, {name: slip, kind: history, runs: [a], y: disc.fx}]
"""

# What is typed, and what stands there after the tabulator. A blank at the end: the word is finished.
LINES = [
    ("burnish rend", "burnish render "),
    ("burnish run pre", "burnish run press.yaml "),
    ("burnish run press.yaml --cont", "burnish run press.yaml --continue "),
    ("burnish run press.yaml --set kine", "burnish run press.yaml --set kinematics="),
    ("burnish run press.yaml --set kinematics=ax", "burnish run press.yaml --set kinematics=axisymmetric "),
    ("burnish run press.yaml --set tools[1].nor", "burnish run press.yaml --set tools[1].normal="),
    ("burnish render out/plate/ru", "burnish render out/plate/run/"),
    ("burnish render out/plate/run --field von", "burnish render out/plate/run --field von_mises "),
    ("burnish render out/plate/run --frame time=0.2", "burnish render out/plate/run --frame time=0.25 "),
    ("burnish render out/plate/run --theme sl", "burnish render out/plate/run --theme slide "),
    ("burnish figures study.yaml --only fo", "burnish figures study.yaml --only force "),
    ("burnish probe out/plate/run --field stress.xx,von", "burnish probe out/plate/run --field stress.xx,von_mises "),
    ("burnish probe out/plate/run --field von_mises,von", "burnish probe out/plate/run --field von_mises,von"),
    ("burnish export out/plate/run --parts kn", "burnish export out/plate/run --parts knots "),
    ("burnish export out/plate/run --parts net,po", "burnish export out/plate/run --parts net,points "),
    ("burnish export out/plate/run --parts body,tools,contact,points,net,", "burnish export out/plate/run --parts body,tools,contact,points,net,knots "),
    ("burnish info two", "burnish info 'two words'/"),
    ("burnish help valid", "burnish help validate "),
    ("burnish explain solver.tol", "burnish explain solver.tolerance "),
]


SEQUENCES = re.compile(r"\x1b(\[[0-?]*[ -/]*[@-~]|\][^\x07]*\x07|\([A-Z])")  # of terminals: colours, titles, places


def words_of(line):
    """The words of a line of a shell, and whether the last one is finished."""
    return [re.sub(r"'([^']*)'", r"\1", word) for word in re.findall(r"(?:'[^']*'|[^ '])+", line)], line.endswith(" ")


class Shell:
    """A shell at a terminal of its own."""

    def __init__(self, arguments, setup, place, environment):
        self.process, self.terminal = pty.fork()
        if self.process == 0:
            os.chdir(place)
            os.execvpe(arguments[0], arguments, environment)
        self.text = ""
        for line in setup:
            self.type(line + "\r")
        self.type("printf 'rea%s\\n' dy\r")
        self.wait_for("ready")

    def type(self, text):
        os.write(self.terminal, text.encode())

    def read(self, seconds):
        """What the shell prints until it is silent for so long."""
        while select.select([self.terminal], [], [], seconds)[0]:
            try:
                self.text += os.read(self.terminal, 65536).decode(errors="replace")
            except OSError:
                return

    def wait_for(self, pattern, seconds=20.0):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            found = re.search(pattern, SEQUENCES.sub("", self.text).replace("\r", ""))
            if found:
                return found
            self.read(0.05)
        sys.exit(f"the shell did not print {pattern}: {self.text!r}")

    def completed(self, line):
        """The words that stand there after the tabulator, and whether the last one is finished."""
        self.text = ""
        self.type(line + "\t")
        self.read(0.6)  # until it has completed; nothing else tells
        self.text = ""
        # An X shows whether a blank stands before it.
        self.type("X\x01printf '{%s}' begin \x05; printf '%s\\n' end\r")
        found = self.wait_for(r"\{begin\}((?:\{[^}]*\})+)end\n").group(1)
        words = re.findall(r"\{([^}]*)\}", found)
        if words[-1] == "X":
            return words[:-1], True
        return words[:-1] + [words[-1][:-1]], False

    def end(self):
        os.close(self.terminal)
        os.waitpid(self.process, 0)


def shells(source, environment):
    scripts = source / "cli/completion/shells"
    plain = {**environment, "TERM": "dumb", "PS1": "> ", "HISTFILE": "/dev/null"}
    yield ("bash", ["bash", "--norc", "--noprofile", "-i"],
           ["bind 'set enable-bracketed-paste off'", f"source {scripts}/burnish.bash"], plain)
    yield ("zsh", ["zsh", "-f", "-i"],
           ["bindkey -e", "unsetopt prompt_sp prompt_cr", "autoload -Uz compinit; compinit -u -D", f"source {scripts}/_burnish"],
           plain)
    yield ("fish", ["fish", "--no-config", "--private", "-i"], [f"source {scripts}/burnish.fish"], {**plain, "TERM": "xterm"})


def candidates(program, place, *words):
    printed = subprocess.run([program, "complete", "--", *words], cwd=place, capture_output=True, text=True, check=True).stdout
    return [line.split("\t")[0] for line in printed.splitlines()]


def check_candidates(program, place, samples, failures):
    """What no shell changes: lists."""
    def expect(words, wanted, absent=()):
        found = candidates(program, place, *words)
        missing, extra = [w for w in wanted if w not in found], [w for w in absent if w in found]
        if missing or extra or len(set(found)) < len(found):
            failures.append(f"{words}: missing {missing}, not to be there {extra}: {found}")

    run = "out/plate/run"
    expect([""], ["run", "render", "help"], ["complete", "manual", "--help"])
    expect(["-"], ["--version", "--help"])
    expect(["run", ""], ["press.yaml", "study.yaml", "out/"], ["notes.txt"])
    expect(["run", "press.yaml", ""], ["--set", "--quiet"], ["press.yaml"])
    expect(["run", "press.yaml", "--"], ["--set", "--output"], ["--resume"])
    expect(["run", "press.yaml", "--quiet", "--"], ["--set"], ["--quiet"])
    expect(["run", "press.yaml", "--set", "degree=1", "--"], ["--set"])
    expect(["run", "press.yaml", "--set", "tools["], ["tools[0].", "tools[1]."], ["tools[2]."])
    expect(["run", "press.yaml", "--set", "tools[0]."], ["tools[0].radius=", "tools[0].motion."], ["tools[0].normal="])
    expect(["run", "--set", "tools[0]."], ["tools[0].radius=", "tools[0].normal="])
    expect(["run", "press.yaml", "--set=contact[0].fri"], ["--set=contact[0].friction="])
    expect(["render", run, "--field", ""], ["displacement", "displacement.x", "von_mises", "stress.xx"], ["plastic_strain"])
    expect(["render", run, "--field=st"], ["--field=stress.xx"], ["--field=von_mises"])
    other = str(samples / "fenicsx.pvd")
    expect(["render", other, "--field", ""], ["displacement", "displacement.x"], ["von_mises"])
    expect(["render", other, "--field", "displacement", "--component", ""], ["x", "magnitude"])
    expect(["render", other, "--frame", ""], ["0", "2", "last"], ["3"])
    expect(["probe", str(samples / "meshio.vtu"), "--field", "st"], ["stress.xx"], ["region"])
    expect(["render", str(samples / "openfoam.vtm"), "--body", ""], ["internal"])
    expect(["probe", run, "--depth", "top@0.5", "--field", ""], ["stress.along", "stress.xx"], [])
    expect(["probe", run, "--field", ""], ["stress.xx"], ["stress.along"])
    expect(["render", run, "--field", "displacement", "--component", ""], ["x", "y", "magnitude"], ["xx"])
    expect(["render", run, "--frame", ""], ["0", "4", "all", "last", "time=0.75"], ["5"])
    expect(["render", run, "--range", ""], ["auto", "frame", "run"], ["LO,HI"])
    expect(["render", run, "-o", ""], ["kept.png", "out/"], ["notes.txt", "press.yaml"])
    expect(["render", "--colormap", ""], ["viridis", "auto"])
    expect(["render", "--undeformed", ""], ["on", "off"])
    expect(["render", "nothing", "--field", ""], [], ["von_mises"])
    expect(["roughness", run, "--face", ""], ["left", "top"], ["front"])
    expect(["probe", run, "--face", "t"], ["top"], ["bottom"])
    expect(["indentation", run, "--tool", ""], ["disc", "plate"])
    expect(["figures", "study.yaml", "--only", ""], ["force", "slip"])
    expect(["figures", "--workflow", ""], ["snakemake"])
    expect(["export", run, "--parts", "body,"], ["body,tools", "body,net"])
    expect(["plot", run, "--y", "disc."], ["disc.fy"], ["time"])
    expect(["plot", "--log", ""], ["x", "y2"])
    expect(["watch", run, "--y", "disc."], ["disc.fy"])
    expect(["init", "--kind", "pl"], ["plastic"])
    expect(["explain", "solver."], ["solver.tolerance"])
    expect(["explain", "--study", "figures."], ["figures.kind", "figures.name"])
    expect(["nonsense", ""], [])
    line = f"burnish render {run} --frame time="
    printed = subprocess.run([program, "complete", "--line", line], cwd=place, capture_output=True, text=True, check=True).stdout
    if printed.split("\n") != ["0", "0.25", "0.5", "0.75", "1", ""]:
        failures.append(f"{line}: found {printed!r}")
    expect(["help", ""], ["run", "validate"], ["complete"])
    if (last := candidates(program, place, "run", "--", "--")) != []:
        failures.append(f"behind -- there are no options: {last}")


def main():
    program, source = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    failures = []
    with tempfile.TemporaryDirectory(prefix="burnish_completion_") as name:
        place = pathlib.Path(name)
        (place / "home").mkdir()
        (place / "bin").mkdir()
        (place / "bin/burnish").symlink_to(program)
        work = place / "work"
        (work / "two words").mkdir(parents=True)
        for file, text in (("press.yaml", SCENE), ("study.yaml", STUDY), ("notes.txt", ""), ("kept.png", "")):
            (work / file).write_text(text)
        environment = {"PATH": f"{place / 'bin'}:{os.environ['PATH']}", "HOME": str(place / "home"), "LC_ALL": "C.UTF-8"}
        subprocess.run([program, "run", "press.yaml", "-o", "out/plate/run", "--quiet"], cwd=work, check=True, stderr=subprocess.DEVNULL)
        check_candidates(program, work, source / "tests/postproc/foreign/samples", failures)
        begin = time.monotonic()
        for _ in range(10):
            candidates(program, work, "render", "out/plate/run", "--field", "")
        print(f"candidates of a field: {100 * (time.monotonic() - begin):.0f} ms")
        for name, arguments, setup, variables in shells(source, environment):
            shell = Shell(arguments, setup, work, variables)
            for typed, wanted in LINES:
                found = shell.completed(typed)
                if found != words_of(wanted):
                    failures.append(f"{name}: {typed!r}: found {found}, expected {words_of(wanted)}")
            shell.end()
            print(f"{name}: {len(LINES)} lines")
    if failures:
        sys.exit("\n".join(failures))


main()
