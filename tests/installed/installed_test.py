"""What `cmake --install` puts below a prefix is all that others need: a program that links the engine is configured and built there and
computes, and Python takes the package.

Usage: installed_test.py CMAKE BUILD
"""

import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent


def run(*command, **options):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def installs(cmake, build, prefix):
    run(cmake, "--install", build, "--prefix", prefix)
    sources = str(HERE.parents[1])
    for file in [*prefix.rglob("*.cmake"), *prefix.rglob("*.h"), *prefix.rglob("*.py")]:
        if sources in file.read_text():
            sys.exit(f"{file.relative_to(prefix)} names {sources}, which others do not have")


def links_the_engine(cmake, prefix, scratch):
    run(cmake, "-S", HERE, "-B", scratch / "build", f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Release", "-G", "Ninja")
    run(cmake, "--build", scratch / "build")
    print(run(scratch / "build/press", scratch / "out"), end="")


def refuses_other_components(cmake, prefix, scratch):
    (scratch / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.25)\nproject(other LANGUAGES C CXX)\nfind_package(burnish REQUIRED COMPONENTS motor)\n")
    done = subprocess.run([cmake, "-S", scratch, "-B", scratch / "other", f"-DCMAKE_PREFIX_PATH={prefix}", "-G", "Ninja"],
                          capture_output=True, text=True)
    if done.returncode == 0 or "found the component motor" not in done.stderr:
        sys.exit(f"the component motor was found, or is refused without a reason:\n{done.stderr}")


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
        prefix = scratch / "prefix"
        installs(cmake, build, prefix)
        links_the_engine(cmake, prefix, scratch)
        refuses_other_components(cmake, prefix, scratch)
        is_a_package_of_python(prefix, scratch)


main()
