"""What `cmake --install` puts below a prefix is all that others need: a program that links the engine is configured and built there and
computes, and Python takes the package. A Debian package has what it is for, and needs no other one of burnish than those it names.

Usage: installed_test.py CMAKE BUILD
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
CONFIG = "share/cmake/burnish"
# What the packages are for, and what they leave to others.
HELD = {
    "program": ["bin/burnish", "**/burnish_readers.so", "**/burnish_svg.so", "**/burnish_shaper.so",
                f"{CONFIG}/burnishConfig.cmake", f"{CONFIG}/burnishConfigVersion.cmake", f"{CONFIG}/BurnishImageTest.cmake"],
    "multigrid": ["**/burnish_petsc.so"],
    "cad": ["**/burnish_occt.so"],
    "doc": ["share/doc/burnish/docs/engine.md", "share/doc/burnish/docs/press.ipynb"],
    "python": ["**/dist-packages/burnish/__init__.py", "**/dist-packages/burnish/_engine.*.so"],
    "development": ["**/libburnish_engine.a", "include/burnish/engine/analysis/run.h", f"{CONFIG}/burnishEngine.cmake"],
}


def run(*command, **options):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def packages(build):
    """Components and those of burnish's own that their Debian packages depend on."""
    text = (build / "CPackConfig.cmake").read_text()
    names = dict(re.findall(r'^set\(CPACK_DEBIAN_(\w+)_PACKAGE_NAME "(.*)"\)', text, re.MULTILINE))
    depends = dict(re.findall(r'^set\(CPACK_DEBIAN_(\w+)_PACKAGE_DEPENDS "(.*)"\)', text, re.MULTILINE))
    components = re.search(r'^set\(CPACK_COMPONENTS_ALL "(.*)"\)', text, re.MULTILINE)[1].split(";")
    return {component: [other for other in components
                        if re.search(rf"(^|, ){names[other.upper()]} \(= [^)]+\)", depends.get(component.upper(), ""))]
            for component in components}


def installs(cmake, build, component, prefix):
    run(cmake, "--install", build, "--prefix", prefix, "--component", component)
    sources = str(HERE.parents[1])
    for file in [*prefix.rglob("*.cmake"), *prefix.rglob("*.h"), *prefix.rglob("*.py")]:
        if sources in file.read_text():
            sys.exit(f"{file.relative_to(prefix)} names {sources}, which others do not have")


def installed(cmake, build, component, scratch):
    """A prefix with a package and those it depends on."""
    prefix = scratch / component
    for part in [component, *packages(build)[component]]:
        installs(cmake, build, part, prefix)
    return prefix


def each_package_has_its_files(cmake, build, scratch):
    if "BURNISH_LATE_VTK:BOOL=ON" in (build / "CMakeCache.txt").read_text():
        HELD["program"].append("**/burnish_vtk.so")
    for component in packages(build):
        prefix = scratch / "alone" / component
        installs(cmake, build, component, prefix)
        for owner, files in HELD.items():
            for file in files:
                if any(prefix.glob(file)) != (owner == component):
                    sys.exit(f"the component {component} {'lacks' if owner == component else 'has'} {file}")


def links_of_the_readme_lead_to_pages(cmake, build, scratch):
    prefix = scratch / "pages"
    for component in ("program", "doc"):
        installs(cmake, build, component, prefix)
    readme = prefix / "share/doc/burnish/README.md"
    dead = [link for link in re.findall(r"\]\((\w[^):]*\.md)\)", readme.read_text()) if not (readme.parent / link).is_file()]
    if dead:
        sys.exit(f"links of the installed README.md lead nowhere: {', '.join(dead)}")


def links_the_engine(cmake, prefix, scratch):
    run(cmake, "-S", HERE, "-B", scratch / "build", f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Release", "-G", "Ninja")
    run(cmake, "--build", scratch / "build")
    print(run(scratch / "build/press", scratch / "out"), end="")


def is_refused(cmake, prefix, scratch, what, reason):
    """A project that asks for `what` is not configured, for a reason that is told."""
    (scratch / "CMakeLists.txt").write_text(
        f"cmake_minimum_required(VERSION 3.25)\nproject(other LANGUAGES C CXX)\nfind_package(burnish {what})\n")
    done = subprocess.run([cmake, "--fresh", "-S", scratch, "-B", scratch / "other", f"-DCMAKE_PREFIX_PATH={prefix}", "-G", "Ninja"],
                          capture_output=True, text=True)
    if done.returncode == 0 or reason not in " ".join(done.stderr.split()):
        sys.exit(f"find_package(burnish {what}) is not refused, or without the reason: {reason}\n{done.stderr}")


def is_a_package_of_python(prefix, scratch):
    environment = {"PATH": f"{prefix / 'bin'}:{os.environ['PATH']}", "PYTHONPATH": str(prefix / "lib/python3/dist-packages")}
    print(run(sys.executable, "-c", f"""
import burnish, importlib.metadata
scene = burnish.Scene({{"geometry": {{"shape": "rectangle", "size": [1, 1], "functions": [4, 4]}},
    "material": {{"law": "neo-hookean", "E": 1, "nu": 0.3}}, "supports": [{{"face": "bottom", "fix": ["x", "y"]}}],
    "loads": [{{"face": "top", "traction": [0, 0.1]}}], "steps": [{{"until": 1, "count": 1}}]}})
run = scene.run({str(scratch / 'run')!r})
plugins = [entry.value for entry in importlib.metadata.entry_points(group="pytest11")]
assert run.summary["completed"] and "burnish.pytest_plugin" in plugins and burnish.__file__.startswith({str(prefix)!r})
print(run)
""", env=environment), end="")


def main():
    cmake, build = sys.argv[1], pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        each_package_has_its_files(cmake, build, scratch)
        links_of_the_readme_lead_to_pages(cmake, build, scratch)
        development = installed(cmake, build, "development", scratch)
        links_the_engine(cmake, development, scratch)
        is_refused(cmake, development, scratch, "REQUIRED COMPONENTS motor", "found the component motor; expected engine")
        is_refused(cmake, development, scratch, "0.1 REQUIRED COMPONENTS engine", 'compatible with requested version "0.1"')
        is_refused(cmake, installed(cmake, build, "program", scratch), scratch, "REQUIRED COMPONENTS engine",
                   "install them (Debian: libburnish-dev)")
        is_a_package_of_python(installed(cmake, build, "python", scratch), scratch)


main()
