#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/results/result.h"
#include "postproc/mesh/tessellation.h"

namespace burnish {

/// Writes a run as VTU files with a PVD collection that can be opened while the run goes on:
/// `frames.pvd`, `frames/body_000000.vtu`, … (current positions) and `frames/TOOL_000000.vtu`, … per tool.
/// Every file appears under its name only when it is complete.
class VtuSeriesWriter {
 public:
  /// Makes the directory and removes a series that an earlier run of the same names left there. Throws
  /// `Error` naming the file or directory.
  VtuSeriesWriter(std::filesystem::path runDir, ModelRecord model);

  /// Adds a frame. Frames of the same or a higher index are dropped from the collection and removed. Throws
  /// `Error` naming the file, or saying what of the frame does not fit the model.
  void write(const FrameRecord& frame);

 private:
  std::filesystem::path file(std::size_t part, int frame) const;
  void removeEarlierSeries() const;
  void writeCollection() const;

  std::filesystem::path runDir_;
  ModelRecord model_;
  std::vector<std::string> stems_;  ///< file name stems: body, then one per tool
  Tessellation tessellation_;
  std::map<int, double> times_;  ///< by index of the frame
};

}  // namespace burnish
