#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "postproc/probe/depth_numbers.h"
#include "postproc/probe/probe_spec.h"
#include "postproc/probe/probed_run.h"
#include "postproc/probe/section_numbers.h"

namespace burnish {

/// What `probe` looks into: a run, or a file of another program.
struct ProbeSource {
  std::filesystem::path file;
  std::vector<double> times;  ///< of the frames
  std::function<ProbedRun(int frame, const ProbeSpec& spec)> inFrame;
  std::function<ProbedRun(const std::vector<int>& frames, const ProbeSpec& spec)> overTime;
  std::function<DepthNumbers(int frame, const ProbeSpec& spec)> depthNumbers;
  std::function<SectionNumbers(int frame, const CutPlane& plane, const std::vector<std::string>& bodies)>
      sectionNumbers;
  DerivedUnits units{};  ///< empty of files of other programs
  std::string stressUnit{};

  /// Whether there is not one field in a frame; none of runs, whose frames have fields.
  std::function<bool(int frame)> isBare{};
};

/// Throws `Error` for what cannot be read.
ProbeSource probeSource(const std::filesystem::path& result);

}  // namespace burnish
