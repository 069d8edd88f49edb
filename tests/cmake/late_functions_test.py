"""Functions of a library that a program loads by calling one of them (cmake/late_functions.py): arguments of all kinds, results and
exceptions come through the first call as through later ones; what cannot be late, or is nowhere, ends the build with a sentence.

Usage: late_functions_test.py CXX NM
"""

import pathlib
import subprocess
import sys
import tempfile

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "cmake/late_functions.py"
HEADER = """
#pragma once
#include <array>
#include <cstdarg>
#include <string>
struct vtkThing {
  static std::array<double, 12> sum(int a, double b, const char* c, double d, long e, float f, short g, double h, int i, double j, int k,
                                    double l, double m, double n, double o);
  static double added(int count, ...);
  static std::string refused(int code);
  virtual ~vtkThing();
  virtual int kind() const;
};
struct Derived : vtkThing {
  static Derived* make();
  int kind() const override;
};
struct vtkCountManager {
  vtkCountManager();
  ~vtkCountManager();
};
static vtkCountManager countOfFiles;
"""
LIBRARY = """
#include "thing.h"
#include <cstdio>
#include <stdexcept>
std::array<double, 12> vtkThing::sum(int a, double b, const char* c, double d, long e, float f, short g, double h, int i, double j, int k,
                                     double l, double m, double n, double o) {
  return {double(a), b, double(c[0]), d, double(e), f, double(g), h, double(i), j, double(k), l + 2 * m + 4 * n + 8 * o};
}
double vtkThing::added(int count, ...) {
  va_list values;
  va_start(values, count);
  double sum = 0;
  for (int k = 0; k < count; ++k) sum += va_arg(values, double);
  va_end(values);
  return sum;
}
std::string vtkThing::refused(int code) { throw std::runtime_error("code " + std::to_string(code)); }
vtkThing::~vtkThing() = default;
int vtkThing::kind() const { return 1; }
vtkCountManager::vtkCountManager() {}
vtkCountManager::~vtkCountManager() {}
"""
DERIVED = '#include "thing.h"\nDerived* Derived::make() { return new Derived; }\nint Derived::kind() const { return 2; }\n'
LOADER = """
#include <dlfcn.h>
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
extern "C" {
extern void* burnish_late_functions[];
extern const char burnish_late_table[];
extern const std::size_t burnish_late_count;
void burnish_load_late_functions() {
  void* const* table = static_cast<void* const*>(dlsym(dlopen("./late.so", RTLD_NOW | RTLD_LOCAL), burnish_late_table));
  if (table == nullptr) std::exit(3);
  std::puts("loads");
  std::copy_n(table, burnish_late_count, burnish_late_functions);
}
}
"""
# Its first call of the library is that of its argument.
CALLER = """
#include "thing.h"
#include <cstdio>
#include <cstring>
#include <stdexcept>
void call(const char* what) {
  if (std::strcmp(what, "sum") == 0)
    for (const double value : vtkThing::sum(1, 2.5, "A", 3.5, 1L << 40, 4.5F, -5, 6.5, 7, 8.5, 9, 1, 10, 100, 1000)) std::printf("%.10g ", value);
  if (std::strcmp(what, "added") == 0) std::printf("%g ", vtkThing::added(9, 1., 2., 3., 4., 5., 6., 7., 8., 9.));
  if (std::strcmp(what, "derived") == 0) {
    vtkThing* thing = Derived::make();
    std::printf("%d ", thing->kind());
    delete thing;
  }
  try {
    if (std::strcmp(what, "refused") == 0) vtkThing::refused(7);
  } catch (const std::runtime_error& error) {
    std::printf("%s ", error.what());
  }
}
"""
MAIN = 'void call(const char* what);\nint main(int, char** words) {\n  while (*++words) call(*words);\n}\n'
SAID = {"sum": "1 2.5 65 3.5 1.099511628e+12 4.5 -5 6.5 7 8.5 9 8421", "added": "45", "derived": "2", "refused": "code 7", "": ""}


def call(*command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)


class Build:
    def __init__(self, compiler, nm, folder):
        self.compiler, self.nm, self.folder = compiler, nm, folder
        for name, text in {"thing.h": HEADER, "library.cpp": LIBRARY, "derived.cpp": DERIVED, "loader.cpp": LOADER, "caller.cpp": CALLER,
                           "main.cpp": MAIN}.items():
            (folder / name).write_text(text)
        self.compile("-shared", "library.cpp", "-o", "libvtk.so")
        self.archive("derived", "caller")

    def compile(self, *arguments):
        done = call(self.compiler, "-std=c++20", "-O2", "-fPIC", *arguments, cwd=self.folder)
        if done.returncode != 0:
            sys.exit(f"{arguments}: {done.stderr}")

    def archive(self, *names):
        for name in names:
            self.compile("-c", f"{name}.cpp", "-o", f"{name}.o")
            (self.folder / f"lib{name}.a").unlink(missing_ok=True)
            call("ar", "rcs", f"lib{name}.a", f"{name}.o", cwd=self.folder)

    def late(self):
        return call(sys.executable, SCRIPT, "--nm", self.nm, "--callers", "libcaller.a", "--archive", "libderived.a", "--libraries",
                    "libvtk.so", "--stubs", "stubs.S", "--table", "table.S", cwd=self.folder)

    def link(self):
        self.compile("-shared", "-o", "late.so", "table.S", "-Wl,--whole-archive", "libderived.a", "-Wl,--no-whole-archive", "-L.", "-lvtk",
                     "-Wl,-z,defs", "-Wl,-rpath,$ORIGIN")
        self.compile("-o", "program", "main.cpp", "loader.cpp", "stubs.S", "libcaller.a", "-Wl,-z,now")


def problems(build):
    done = build.late()
    if done.returncode != 0:
        sys.exit(f"late_functions.py: {done.stderr}")
    build.link()
    for word, said in SAID.items():
        for words in ((word,), (word, word)) if word else ((),):
            found = call("./program", *words, cwd=build.folder)
            expected = "loads\n" + " ".join([said] * len(words)) + " " if words else ""
            if found.returncode != 0 or found.stdout != expected:
                yield f"program {words}: code {found.returncode}, {found.stdout!r}{found.stderr}; expected {expected!r}"

    before = (build.folder / "program").read_bytes()
    (build.folder / "derived.cpp").write_text(DERIVED.replace("return 2", "return 3"))
    build.archive("derived")
    build.late()
    build.link()
    (build.folder / "program").write_bytes(before)
    if call("./program", "sum", cwd=build.folder).returncode != 3:
        yield "a program takes the table of another build"

    def says(text, sentence):
        (build.folder / "caller.cpp").write_text(text)
        build.archive("caller")
        done = build.late()
        if done.returncode == 0 or sentence not in done.stderr:
            yield f"expected {sentence!r}; said {done.stderr!r}"

    yield from says('#include "thing.h"\nstruct Own : vtkThing { int kind() const override { return 4; } };\nvtkThing* own() { return new Own; }\n',
                    "_ZTI8vtkThing is no function: what needs it belongs to libderived")
    yield from says('struct vtkOther { static void act(); };\nvoid call(const char*) { vtkOther::act(); }\n',
                    "_ZN8vtkOther3actEv is in no component of find_package(VTK)")


def main():
    with tempfile.TemporaryDirectory() as name:
        wrong = list(problems(Build(sys.argv[1], sys.argv[2], pathlib.Path(name))))
    print(*wrong, sep="\n")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
