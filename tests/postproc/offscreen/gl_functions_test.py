"""The program has a definition of every function of OpenGL that VTK's libraries take when they are loaded: one that is missing would
be libOpenGL's, which draws nothing in a context of OSMesa. Neither library that draws is loaded with the program or with VTK.

Usage: gl_functions_test.py BURNISH
"""

import pathlib
import re
import subprocess
import sys


def call(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def functions(listing):
    return set(re.findall(r"\bgl(?:X[A-Z]|[A-WYZ])\w*", listing))


def main():
    burnish = sys.argv[1]
    module = pathlib.Path(burnish).with_name("burnish_vtk.so")  # where the program was not linked with VTK
    loaded = call("ldd", burnish) + (call("ldd", module) if module.exists() else "")
    defined = functions(call("nm", "-D", "--defined-only", burnish))
    drawing = {}
    for library in re.findall(r"=> (\S*/libvtk\S+)", loaded):
        for name in functions(call("nm", "-D", "--undefined-only", library)):
            drawing.setdefault(name, library)
    wrong = [f"{library} takes {name}, which postproc/offscreen/gl_functions.cpp does not define"
             for name, library in sorted(drawing.items()) if name not in defined and not name.startswith("glX")]
    if len(drawing) < 30:
        wrong.append(f"found only {sorted(drawing)}")
    wrong += [f"{name} is loaded with the program or VTK" for name in ("libOSMesa", "libEGL", "libLLVM") if name in loaded]
    print(*wrong, sep="\n")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
