"""A study as a workflow of Snakemake, worked off by Snakemake itself: its results are those of `burnish figures`, and nothing is
done twice.

Usage: workflow_test.py BURNISH local      on this machine
       workflow_test.py BURNISH slurm      by a Slurm of one node that the test starts for itself, with the profile of docs/study.md

Exit code 77 where Snakemake (or Slurm with munge) is not installed.
"""

import contextlib
import csv
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

SCENE = """
geometry: {shape: rectangle, size: [2.0, 1.0], functions: [6, 3]}
material: {law: neo-hookean, E: 1.0, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}, {face: top, move: {times: [0, 1], y: [0, -0.1]}}]
steps: [{until: 1, count: 2}]
output: {vtu: false}
"""
# The run "squeezed" ends before its time.
STUDY = """title: Blocks
runs:
  - {name: "block-{degree}", scene: block.yaml, vary: [{name: degree, values: [1, 2]}], set: ["degree={degree}"]}
  - {name: squeezed.1, scene: other block.yaml, set: ["supports[1].move.y=[0,-5]", "steps=[{until: 1, count: 2}]", "title=it's 100 %"]}
figures:
  - {name: energy, kind: history, runs: ["block-*"], y: strain_energy}
  - {name: stop, kind: history, runs: [squeezed.1], y: strain_energy}
  - {name: both, kind: composite, figures: [energy, stop]}
"""
ABSENT = 77


def require(condition, what):
    if not condition:
        sys.exit(what)


class Place:
    """A directory with the study, in which burnish and Snakemake are started."""

    def __init__(self, burnish, directory):
        self.burnish, self.directory = burnish, directory
        self.directory.mkdir()
        self.write("block.yaml", SCENE)
        self.write("other block.yaml", SCENE)
        self.write("study.yaml", STUDY)

    def write(self, name, text):
        (self.directory / name).write_text(text)

    def run(self, *command, code=0):
        """What a command prints. It must end with this code."""
        done = subprocess.run(command, cwd=self.directory, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        require(done.returncode == code, f"{command} ends with {done.returncode}:\n{done.stdout}")
        return done.stdout

    def write_workflow(self):
        self.run(self.burnish, "figures", "study.yaml", "--workflow", "snakemake")

    def snakemake(self, *arguments, code=0):
        return self.run("snakemake", "--nocolor", *arguments, code=code)

    def due(self, *config):
        """The rules that Snakemake would carry out."""
        printed = self.snakemake("-c2", "--dry-run", *(["--config", *config] if config else []))
        return set(re.findall(r"^(?:local)?rule (\S+):$", printed, re.MULTILINE))


def without_times(file):
    """The bytes of a file, without the seconds that were measured."""
    if file.name == "summary.yaml":
        return re.sub(r"(?m)^\w*seconds: .*$", "", file.read_text())
    if file.name == "runs.csv":
        return [row[:-1] for row in csv.reader(file.read_text().splitlines())]
    if file.name == "study.md":
        rows = [line.split("|") for line in file.read_text().splitlines()]
        column = next(k for row in rows for k, cell in enumerate(row) if cell.strip() == "seconds")
        return [row[:column] + row[column + 1:] for row in rows]
    return file.read_bytes()


def require_equal(wanted, found):
    """The files of two directories of a study are the same, but for what is measured."""
    def files(top):
        return {file.relative_to(top) for file in top.rglob("*") if file.is_file() and not file.name.startswith("restart_")}

    require(files(wanted) == files(found), f"other files: {files(wanted) ^ files(found)}")
    for name in files(wanted):
        require(without_times(wanted / name) == without_times(found / name), f"{found / name} is not {wanted / name}")


NOTHING_LEFT = "runs: 3, of which to compute: 0; figures: 3, of which to draw: 0\n"


def test_local(place):
    place.run(place.burnish, "figures", "study.yaml", "-o", "direct")
    place.write_workflow()
    out = place.directory / "out/study"
    printed = place.snakemake("-c2")
    require(NOTHING_LEFT in printed, f"the document is made with runs or figures:\n{printed}")
    require_equal(place.directory / "direct", out)
    require(place.due() == set(), "something is due after everything is done")
    require(place.due("results=direct") == set(), "results of burnish figures are not taken")

    require("there is no program nowhere" in place.snakemake("-c2", "--config", "burnish=nowhere", code=1), "a program that is not there")

    # What is missing or has changed, and what shows it, alone.
    (out / "figures/energy.png").unlink()
    require(place.due() == {"figure_energy", "figure_both", "document", "all"}, f"due without a figure: {place.due()}")
    place.write("other block.yaml", SCENE + "# changed\n")
    require(place.due("results=direct") == {"run_squeezed.1", "figure_stop", "figure_both", "document", "all"}, "due with a scene changed")
    before = times(out)
    place.snakemake("-c2")
    changed = {run for run, when in times(out).items() if when != before[run]}
    require(changed == {"squeezed.1"}, f"computed again: {changed}")
    require_equal(place.directory / "direct", out)
    require(NOTHING_LEFT in place.run(place.burnish, "figures", "study.yaml", "-o", str(out)), "burnish figures has something to do")

    # A study that has changed asks for a new workflow; of its runs those with other changes are due.
    place.write("study.yaml", STUDY.replace('"degree={degree}"', '"degree={degree}", "material.E={degree}"'))
    require("is not as it was when" in place.snakemake("-c2", code=1), "the workflow of another study is worked off")
    place.write_workflow()
    require({rule for rule in place.due() if rule.startswith("run_")} == {"run_block-1", "run_block-2"}, f"due: {place.due()}")

    # A run that fails does not stop the others with -k; its log says why.
    place.write("study.yaml", STUDY.replace('"supports[1].move.y=[0,-5]"', '"supports=[]"'))
    place.write_workflow()
    shutil.rmtree(out / "runs/block-1")
    place.snakemake("-c1", "-k", "run_squeezed.1", "run_block-1", code=1)
    require("free to move" in (out / "runs/squeezed.1/log.txt").read_text(), "the log does not tell why")
    require((out / "runs/block-1/summary.yaml").exists(), "a failure stops the others")

    # A run that is interrupted is gone on with.
    place.write("study.yaml", STUDY.replace("count: 2}]", "count: 4000}]").replace("[0,-5]", "[0,-0.1]"))
    place.write_workflow()
    run = out / "runs/squeezed.1"
    shutil.rmtree(run)
    process = subprocess.Popen(["snakemake", "-c2", "run_squeezed.1"], cwd=place.directory, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL, start_new_session=True)
    wait_for((run / "result/frame_000000.h5").exists, "first frame")
    os.killpg(process.pid, signal.SIGINT)  # as Ctrl-C does
    process.wait(120)
    require(not (run / "summary.yaml").exists(), "the run has ended before it was interrupted")
    begun = (run / "result.h5").stat().st_mtime_ns
    place.snakemake("-c2", "run_squeezed.1")
    require((run / "result.h5").stat().st_mtime_ns == begun, "the run has begun anew")
    place.run(place.burnish, "figures", "study.yaml", "-o", "anew", "--only", "stop")
    require_equal(place.directory / "anew/runs/squeezed.1", run)


def times(out):
    return {file.parent.name: file.stat().st_mtime_ns for file in out.glob("runs/*/summary.yaml")}


def wait_for(condition, what, seconds=120):
    end = time.monotonic() + seconds
    while not condition():
        require(time.monotonic() < end, f"no {what} within {seconds} s")
        time.sleep(0.05)


def free_ports():
    with socket.socket() as first, socket.socket() as second:
        first.bind(("127.0.0.1", 0))
        second.bind(("127.0.0.1", 0))
        return first.getsockname()[1], second.getsockname()[1]


SLURM = """
ClusterName=one
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={top}/munge.socket
CredType=cred/munge
StateSaveLocation={top}/state
SlurmdSpoolDir={top}/spool
SlurmctldPidFile={top}/slurmctld.pid
SlurmdPidFile={top}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MailProg=/bin/true
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SlurmdParameters=config_overrides
NodeName={host} NodeAddr=127.0.0.1 CPUs=4 RealMemory=16000
PartitionName=all Nodes=ALL Default=YES State=UP
"""


@contextlib.contextmanager
def slurm(top):
    """A Slurm of one node, of this user and with an own munge, while the block goes on. No privileges are needed."""
    for name in ("state", "spool"):
        (top / name).mkdir(parents=True)
    (top / "munge.key").write_bytes(os.urandom(1024))
    (top / "munge.key").chmod(0o600)
    top.chmod(0o755)  # munge asks for it
    user = subprocess.check_output(["id", "-un"], text=True).strip()
    (top / "slurm.conf").write_text(SLURM.format(top=top, user=user, host=socket.gethostname().split(".")[0], ports=free_ports()))
    os.environ["SLURM_CONF"] = str(top / "slurm.conf")
    own = [f"--{name}={top}/{file}" for name, file in {"key-file": "munge.key", "socket": "munge.socket", "pid-file": "munged.pid",
                                                       "log-file": "munged.log", "seed-file": "munged.seed"}.items()]
    daemons = []
    try:
        for command in (["munged", "--foreground", "--force", *own], ["slurmctld", "-D"], ["slurmd", "-D"]):
            log = open(top / f"{command[0]}.out", "wb")
            daemons.append(subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log))
            if command[0] == "munged":
                wait_for((top / "munge.socket").exists, "munge")
        idle = ["sinfo", "-h", "-t", "idle", "-o", "%D"]
        wait_for(lambda: subprocess.run(idle, capture_output=True, text=True).stdout.strip() == "1", "node of Slurm")
        yield
    finally:
        for daemon in reversed(daemons):
            daemon.terminate()
        for daemon in reversed(daemons):
            daemon.wait(30)


def write_profile(directory, documentation):
    """The files of the profile that the documentation shows: blocks whose first comment is the name of a file."""
    blocks = re.findall(r"```\w+\n(?:#!.*\n)?# (slurm/\S+)\n(.*?)```", documentation.read_text(), re.DOTALL)
    require([name for name, _ in blocks] == ["slurm/config.yaml", "slurm/status.sh"], f"the documentation shows {blocks}")
    for name, text in blocks:
        file = directory / name
        file.parent.mkdir(exist_ok=True)
        file.write_text(("#!/bin/sh\n" if file.suffix == ".sh" else "") + text)
        file.chmod(0o755)


def test_slurm(place):
    place.run(place.burnish, "figures", "study.yaml", "-o", "direct")
    place.write_workflow()
    write_profile(place.directory, pathlib.Path(__file__).parents[2] / "docs/study.md")
    with slurm(place.directory.parent / "slurm"):
        printed = place.snakemake("--profile", "slurm", "--config", "threads=2", "--set-resources", "run_block-2:mem_mb=3000",
                                  "--latency-wait", "5", "--max-status-checks-per-second", "10")
        jobs = place.run("scontrol", "-o", "show", "jobs").splitlines()
    require(NOTHING_LEFT in (place.directory / f".snakemake/slurm-{len(jobs)}.txt").read_text(), "the document is made with runs or figures")
    require_equal(place.directory / "direct", place.directory / "out/study")
    submitted = dict(re.findall(r"Submitted job (\d+) with external jobid '(\d+)'", printed))
    require(len(submitted) == len(jobs) == 7, f"{len(jobs)} jobs instead of 3 runs, 3 figures and the document:\n{printed}")
    for job in jobs:
        name, state, cores, memory = (re.search(rf"\b{key}=([^\s,]*)", job)[1] for key in ("JobName", "JobState", "NumCPUs", "mem"))
        require(state == "COMPLETED", job)
        require(cores == ("2" if name.startswith("run_") else "1"), job)
        require(memory == ("3000M" if name == "run_block-2" else "2000M"), job)
    require(place.due() == set(), "something is due after everything is done")


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[2] not in ("local", "slurm"):
        sys.exit(__doc__)
    os.environ["PATH"] += ":/usr/sbin"  # of the daemons
    os.environ["CI"] = "true"  # Snakemake then looks after its jobs every second, instead of every tenth
    tests = {"local": (test_local, ["snakemake"]), "slurm": (test_slurm, ["snakemake", "munged", "slurmctld", "slurmd", "sbatch"])}
    test, tools = tests[sys.argv[2]]
    missing = [tool for tool in tools if shutil.which(tool) is None]
    if missing:
        print(f"not installed: {', '.join(missing)}; scripts/setup --workflow installs them")
        sys.exit(ABSENT)
    with tempfile.TemporaryDirectory(prefix="burnish_workflow_") as top:
        test(Place(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(top, "a study")))
