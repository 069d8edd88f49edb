#include "cli/doctor/examination.h"

#include <fmt/format.h>
#include <unistd.h>
#include <vtkVersion.h>

#include <array>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <system_error>
#include <thread>

#include "cli/fastest_program.h"
#include "cli/late_vtk.h"
#include "engine/cad/require_cad.h"
#include "engine/core/blas.h"
#include "engine/core/error.h"
#include "engine/core/memory_limit.h"
#include "engine/core/module_function.h"
#include "engine/core/version.h"
#include "engine/solver/multigrid.h"
#include "engine/solver/petsc_module.h"
#include "postproc/draw/contour/ray_stops.h"
#include "postproc/draw/page/font.h"
#include "postproc/export/scratch_directory.h"
#include "postproc/offscreen/opengl_name.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

std::string gigabytes(double bytes) {
  return fmt::format("{:.1f} GB", 1e-9 * bytes);
}

std::string processorText() {
  const std::string program = programForProcessor();
  return fmt::format("{} threads at a time", std::thread::hardware_concurrency()) +
         (program.empty() ? "" : ", which compute with AVX2: " + program);
}

/// Whether commands that compute or draw have them (prepared_start.cpp).
bool hasLargePages() {
  std::ifstream choice("/sys/kernel/mm/transparent_hugepage/enabled");  // always [madvise] never
  std::string words;
  std::getline(choice, words);
  if (words.find("[madvise]") == std::string::npos) return words.find("[always]") != std::string::npos;
  const char* tunables = std::getenv("GLIBC_TUNABLES");
  return tunables == nullptr ? !memoryIsLimited()
                             : std::string(tunables).find("glibc.malloc.hugetlb=1") != std::string::npos;
}

std::string memoryText() {
  const auto page = static_cast<double>(::sysconf(_SC_PAGESIZE));
  std::string text =
      fmt::format("{} of {} free", gigabytes(page * static_cast<double>(::sysconf(_SC_AVPHYS_PAGES))),
                  gigabytes(page * static_cast<double>(::sysconf(_SC_PHYS_PAGES))));
  text += hasLargePages() ? ", in large pages" : ", in small pages";
  if (memoryIsLimited())
    text += fmt::format(", of which the program may take {} (ulimit)",
                        gigabytes(static_cast<double>(freeMemory())));
  return text;
}

/// Where a program is that is started by its name.
std::string programInPath(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream places(path == nullptr ? "" : path);
  for (std::string place; std::getline(places, place, ':');) {
    const fs::path file = fs::path(place) / name;
    std::error_code status;
    if (fs::is_regular_file(file, status) && ::access(file.c_str(), X_OK) == 0) return file.string();
  }
  throw Error("not in PATH");
}

std::string scratchText() {
  const ScratchDirectory scratch;
  const fs::path place = scratch.path().parent_path();
  std::error_code status;
  const auto space = fs::space(place, status);
  return status ? place.string()
                : fmt::format("{}, {} free", place.string(), gigabytes(static_cast<double>(space.available)));
}

std::string vtkText() {
  loadVtk();
  const std::string text = vtkVersion::GetVTKSourceVersion();  // vtk version 9.1.0
  return text.substr(text.rfind(' ') + 1);
}

std::string openGlText() {
  loadVtk();
  return openGlName();
}

std::string multigridText() {
  if (!hasMultigrid()) throw Error("built without");
  petscFunction("burnishMultigridSolver", "multigrid");
  return "PETSc and MPI";
}

std::string cadText() {
  requireCad();
  return "OpenCASCADE";
}

std::string occlusionText() {
  requireRays();
  return "Embree 3";
}

/// What is looked at, in the order in which it is told.
struct Examined {
  const char* name;
  const char* needed;
  std::function<std::string()> look;  ///< which one is there; throws what is wrong
  const char* remedy;                 ///< where what is thrown has none
};

std::vector<Examined> allExamined() {
  return {
      {"program", "", programName, ""},
      {"processor", "", processorText, ""},
      {"memory", "", memoryText, ""},
      {"scratch", "", scratchText, "make TMPDIR the name of a directory that can be written to"},
      {"BLAS", "", blasName, ""},
      {"VTK", "", vtkText, "raise the limit of memory (ulimit -v, -d)"},
      {"OpenGL", "", openGlText,
       "install Mesa for drawing in memory (Debian: apt-get install libosmesa6, or libegl1 and libgl1-mesa-dri), and leave the choice to the program (unset BURNISH_GL)"},
      {"fonts", "", [] { return fmt::format("{}: {}", kDefaultFont, fontNamed(kDefaultFont).file); },
       "install the font (Debian: apt-get install fonts-dejavu-core)"},
      {"occlusion", "bodies in space: shadows, hidden edges and pages for print", occlusionText,
       "install Embree (Debian: apt-get install libembree3-3)"},
      {"multigrid", "large bodies in space: solver: {linear: multigrid}", multigridText,
       "build the program with PETSc, that is without BURNISH_PETSC=OFF"},
      {"CAD", "tools from STEP and IGES files, and export to them", cadText, ""},
      {"mpirun", "runs of several processes", [] { return programInPath("mpirun"); },
       "install MPI (Debian: apt-get install openmpi-bin)"},
      {"ffmpeg", "videos: .mp4 and .gif", [] { return programInPath("ffmpeg"); },
       "install it (Debian: apt-get install ffmpeg), or make animated PNGs"},
      {"snakemake", "studies on a cluster: figures --workflow", [] { return programInPath("snakemake"); },
       "install it (Debian: apt-get install snakemake)"},
  };
}

}  // namespace

std::vector<Finding> examine() {
  std::vector<Finding> findings;
  for (const auto& [name, needed, look, remedy] : allExamined()) {
    Finding& finding =
        findings.emplace_back(Finding{.name = name, .needed = needed, .what = "", .remedy = ""});
    try {
      finding.what = look();
      finding.isThere = true;
    } catch (const ModuleError& error) {
      finding.what = error.whatIsWrong();
      finding.remedy = error.remedy();
    } catch (const std::exception& error) {
      finding.what = error.what();
      finding.remedy = remedy;
    }
  }
  return findings;
}

}  // namespace burnish
