"""The installed program: it finds what it needs beside itself and nothing in the tree that built it, computes and draws in an empty
environment, reads files of other programs, tells what a module wants that is not installed, not whole or of another program, and
leaves computing to a program for newer processors that lies beside it; manual pages and completions lie where man and the shells
look.

Usage: installed_test.py CMAKE BUILD_DIRECTORY
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile


def call(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: ended with {done.returncode}: {done.stdout}{done.stderr}")
    return done.stdout


def vtk_module(burnish):
    """What loads VTK, or nothing: on other processors than those of x86-64 the program is linked with VTK."""
    return next((path for path in burnish.parent.parent.glob("lib/**/burnish_vtk.so") if path.parent.name == "burnish"), None)


def problems_of_program(burnish, build):
    found = call("readelf", "-d", burnish)
    for path in re.findall(r"(?:RPATH|RUNPATH).*\[(.*)\]", found):
        if not all(part.startswith("$ORIGIN") for part in path.split(":")):
            yield f"the installed program looks for libraries in {path}"
    libraries = call("ldd", burnish)
    if str(build) in libraries:
        yield f"the installed program loads libraries of {build}"
    late = [] if vtk_module(burnish) is None else ["libvtkCommonCore"]
    for library in (*late, "libvtkIOExport", "libvtkIOExodus", "libTKernel", "libpetsc", "libOSMesa"):
        if library in libraries:
            yield f"the installed program starts with {library}, which few commands need"


def problems_of_use(burnish, directory):
    def use(*arguments):
        return call(burnish, *arguments, cwd=directory, env={"PATH": "/usr/bin:/bin", "HOME": str(directory)})

    findings = {finding["name"]: finding for finding in json.loads(use("doctor", "--json"))}
    for name in ("OpenGL", "fonts", "multigrid"):
        if not findings[name]["ok"]:
            yield f"the installed program misses {name}: {findings[name]}"
    use("init", "press")
    use("run", "press.yaml", "-o", "out", "--quiet", "--set", "steps=[{until: 0.1, count: 1}]", "--set", "pictures=[]",
        "--set", "output={}")
    use("render", "out", "-o", "press.png", "--size", "300,200")
    if not (directory / "press.png").read_bytes().startswith(b"\x89PNG"):
        yield "press.png is no picture"
    use("plot", "out", "--y", "disc.fy", "-o", "force.svg")
    if not (directory / "force.svg").read_text("utf-8").rstrip().endswith("</svg>"):
        yield "force.svg is no chart"
    (directory / "tetrahedron.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n")
    if "4 cells" not in use("info", "tetrahedron.obj"):
        yield "the installed program cannot read tetrahedron.obj"


def problems_of_modules(burnish, directory):
    """Multigrid is installed, CAD is not; then a library that multigrid needs is missing."""
    def finding(name):
        return next(found for found in json.loads(call(burnish, "doctor", "--json", cwd=directory)) if found["name"] == name)

    cad = finding("CAD")
    if cad["found"] != "burnish_occt.so, which is not there" or "apt-get install burnish-cad" not in cad["remedy"]:
        yield f"of CAD that is not installed doctor says: {cad}"
    module = next(burnish.parent.parent.glob("lib/**/burnish_petsc.so"))
    module.write_bytes(module.read_bytes().replace(b"libpetsc", b"libabsen"))
    multigrid = finding("multigrid")
    if not re.match(r"burnish_petsc.so, which is there but cannot be loaded: libabsen\S*: cannot open", multigrid["found"]):
        yield f"of multigrid that misses a library doctor says: {multigrid}"
    elif "apt-get" in multigrid["remedy"]:
        yield f"doctor would install what is there: {multigrid}"


def problems_of_late_vtk(burnish, directory):
    """The module that loads VTK is not there, or is that of another program: what draws nothing works, the rest says why not."""
    module = vtk_module(burnish)
    if module is None:
        return
    whole = module.read_bytes()
    other = re.sub(rb"(burnish_late_)[0-9a-f]{16}", rb"\g<1>0123456789abcdef", whole)
    for contents, reason in ((b"", "cannot be loaded"), (other, "undefined symbol: burnish_late_"),
                             (None, "needs burnish_vtk.so, which is not there")):
        module.unlink(missing_ok=True)
        if contents is not None:
            module.write_bytes(contents)
        call(burnish, "validate", "press.yaml", cwd=directory)
        refused = subprocess.run([burnish, "run", "press.yaml", "-o", "none"], capture_output=True, text=True, cwd=directory)
        if refused.returncode != 2 or reason not in refused.stderr or (directory / "none").exists():
            yield f"without its VTK the program computes, or says: {refused.returncode} {refused.stderr}"
        done = subprocess.run([burnish, "render", "out", "-o", "none.png"], capture_output=True, text=True, cwd=directory)
        doctor = subprocess.run([burnish, "doctor"], capture_output=True, text=True, cwd=directory)
        if "burnish_vtk.so" not in doctor.stdout or "fonts" not in doctor.stdout:
            yield f"without its VTK doctor says: {doctor.returncode} {doctor.stdout}{doctor.stderr}"
        if done.returncode != 2 or reason not in done.stderr or done.stderr.count("\n") != 1 or (directory / "none.png").exists():
            yield f"without its VTK the program says: {done.returncode} {done.stdout}{done.stderr}"
    module.unlink(missing_ok=True)
    module.write_bytes(whole)
    call(burnish, "render", "out", "-o", "again.png", "--size", "300,200", cwd=directory)


def problems_of_newer_program(burnish, directory):
    """A program in the place of the one for newer processors that says how it was started."""
    newer = next(burnish.parent.parent.glob("lib/**/burnish_readers.so")).parent / "x86-64-v3/burnish"
    newer.parent.mkdir()
    newer.write_text('#!/bin/sh\necho "newer $@"\n')
    newer.chmod(0o755)
    processor = set(re.search("flags.*", pathlib.Path("/proc/cpuinfo").read_text())[0].split())
    is_new = {"avx2", "fma", "bmi2"} <= processor
    for words, is_left in (("run press.yaml --threads 1", True), ("verify press.yaml", True), ("figures press.yaml", True),
                           ("run --help", True), ("--version", False), ("help run", False)):
        found = call(burnish, *words.split(), cwd=directory) if is_new or not is_left else ""
        if (found == f"newer {words}\n") != (is_left and is_new):
            yield f"burnish {words}: said {found}"
    newer.chmod(0o644)
    if not call(burnish, "run", "--help", cwd=directory).startswith("Compute"):
        yield "without a program for newer processors the installed one does not compute"


def problems_of_files(prefix):
    pages = call("man", "-M", prefix / "share/man", "-w", "burnish", "burnish-run", "burnish-scene", "burnish-study").split()
    if len(pages) != 4:
        yield f"man finds {pages} alone"
    for place in ("bash-completion/completions/burnish", "zsh/vendor-completions/_burnish", "fish/vendor_completions.d/burnish.fish",
                  "burnish/scene.schema.json", "burnish/themes/paper.yaml"):
        if not (prefix / "share" / place).is_file():
            yield f"share/{place} is not installed"
    completes = f'. "{prefix}/share/bash-completion/completions/burnish"; complete -p burnish'
    call("bash", "-c", completes)


def main():
    cmake, build = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name).resolve()
        call(cmake, "--install", build, "--prefix", "/usr", "--component", "program", env={**os.environ, "DESTDIR": str(directory)})
        call(cmake, "--install", build, "--prefix", "/usr", "--component", "multigrid", env={**os.environ, "DESTDIR": str(directory)})
        # Where a package puts it, and then somewhere else: nothing may hang on the place.
        prefix = directory / "elsewhere"
        shutil.move(directory / "usr", prefix)
        burnish = prefix / "bin/burnish"
        wrong = [*problems_of_program(burnish, build), *problems_of_use(burnish, directory), *problems_of_files(prefix),
                 *problems_of_late_vtk(burnish, directory), *problems_of_newer_program(burnish, directory),
                 *problems_of_modules(burnish, directory)]
    print(*wrong, sep="\n")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
