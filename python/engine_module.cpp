#include <cblas.h>
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <filesystem>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "engine/analysis/run.h"
#include "engine/core/blas.h"
#include "engine/core/error.h"
#include "engine/core/version.h"
#include "engine/scene/reader.h"

/// `burnish._engine`: runs of scenes in the process of Python. burnish/scene.py is what people call.
namespace burnish {
namespace {

namespace py = pybind11;

/// A scene as Python hands it over.
struct SceneInput {
  std::string yaml;  ///< as it was written
  std::string name;  ///< that stands for the file in messages; files that the scene names lie beside it
  std::vector<std::string> overrides;
  std::string resolvedYaml;        ///< the document with every default filled in, for the result
  std::vector<double> frameTimes;  ///< times of which its pictures and probes want frames
};

/// Calls Python from a run that goes on without the interpreter's lock. What it raises, a signal among it, ends the run after the
/// step under way, and is raised again by `rethrow`.
class PythonObserver final : public RunObserver {
 public:
  PythonObserver(py::object onStep, py::object onWarning)
      : onStep_(std::move(onStep)), onWarning_(std::move(onWarning)) {}

  void onWarnings(const std::vector<std::string>& warnings) override {
    call([&] {
      for (const std::string& warning : warnings) onWarning_(warning);
    });
  }

  void onStep(const RunProgress& progress) override {
    call([&] {
      if (!onStep_.is_none())
        onStep_(progress.step, progress.time, progress.endTime, progress.iterations, progress.totalCuts);
    });
  }

  bool hasFailed() const { return failure_ != nullptr; }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  template <class Act>
  void call(const Act& act) {
    const py::gil_scoped_acquire lock;
    if (hasFailed()) return;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      act();
    } catch (...) {
      failure_ = std::current_exception();
    }
  }

  py::object onStep_, onWarning_;
  std::exception_ptr failure_;
};

/// The engine holds BLAS to one thread; numpy, which may use the same library, gets its threads back.
class BlasThreads {
 public:
  BlasThreads() = default;
  ~BlasThreads() { openblas_set_num_threads(number_); }
  BlasThreads(const BlasThreads&) = delete;
  BlasThreads& operator=(const BlasThreads&) = delete;

 private:
  int number_ = openblas_get_num_threads();
};

/// Why a run has not reached its end, and what usually helps; empty if it has.
std::string whyStopped(const RunSummary& summary) {
  if (summary.completed) return "";
  return summary.advice.empty()
             ? summary.stoppedBecause
             : fmt::format("{}\nwhat usually helps: {}", summary.stoppedBecause, summary.advice);
}

std::string run(const SceneInput& input, const std::filesystem::path& directory, int threads, bool resumes,
                const py::object& onStep, const py::object& onWarning) {
  PythonObserver observer(onStep, onWarning);
  std::string stopped;
  {
    const py::gil_scoped_release unlocked;
    static std::mutex oneAtATime;  // for HDF5, and for the threads of BLAS
    const std::scoped_lock locked(oneAtATime);
    const BlasThreads threadsOfBlas;
    Scene scene = parseScene(input.yaml, input.name, input.overrides);
    scene.resolvedYaml = input.resolvedYaml;
    scene.wanted.frames = input.frameTimes;
    const RunOptions options{.threads = threads, .halt = [&] { return observer.hasFailed(); }};
    const RunSummary summary = resumes ? resumeRun(scene, directory, options, observer)
                                       : runScene(scene, directory, options, observer);
    stopped = whyStopped(summary);
  }
  observer.rethrow();
  return stopped;
}

}  // namespace
}  // namespace burnish

PYBIND11_MODULE(_engine, module) {
  using namespace burnish;
  useFastestBlasKernels();
  module.doc() = "The engine of burnish in this process.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      PyErr_SetString(py::module_::import("burnish.errors").attr("Error").ptr(), error.what());
    }
  });
  module.def("program", &programName, "What computes: version and digest of the engine.");
  module.def(
      "run",
      [](std::string yaml, std::string name, std::vector<std::string> overrides, std::string resolved,
         std::vector<double> frames, const std::string& directory, int threads, bool resumes,
         const py::object& onStep, const py::object& onWarning) {
        return run(
            {std::move(yaml), std::move(name), std::move(overrides), std::move(resolved), std::move(frames)},
            directory, threads, resumes, onStep, onWarning);
      },
      py::kw_only(), py::arg("yaml"), py::arg("name"), py::arg("overrides"), py::arg("resolved"),
      py::arg("frames"), py::arg("directory"), py::arg("threads"), py::arg("resumes"), py::arg("on_step"),
      py::arg("on_warning"),
      "Computes a scene, or goes on with it; why it has not reached its end, or an empty text.");
}
