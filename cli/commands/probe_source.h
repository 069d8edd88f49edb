#pragma once
#include <filesystem>
#include <functional>
#include <vector>

#include "postproc/probe/probe_spec.h"
#include "postproc/probe/probed_run.h"

namespace burnish {

/// What `probe` looks into: a run, or a file of another program.
struct ProbeSource {
  std::filesystem::path file;
  std::vector<double> times;  ///< of the frames
  std::function<ProbedRun(int frame, const ProbeSpec& spec)> inFrame;
  std::function<ProbedRun(const std::vector<int>& frames, const ProbeSpec& spec)> overTime;
};

/// Throws `Error` for what cannot be read.
ProbeSource probeSource(const std::filesystem::path& result);

}  // namespace burnish
