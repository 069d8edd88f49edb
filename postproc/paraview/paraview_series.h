#pragma once
#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "postproc/draw/contour/contour.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/export/vtu_series_writer.h"
#include "postproc/paraview/state_script.h"

namespace burnish {

/// A series of VTK files, and beside its collection `frames.py`, with which ParaView opens it as a picture
/// shows the run: blocks taken apart by name, the field in its colours over all frames so far, tools grey, the
/// view. What a picture shows of a part of the body alone (cuts, mirrors) or drawn otherwise (arrows, warp) is left out.
class ParaViewSeries {
 public:
  /// picture: without a field, what one most probably wants to see. times: of the picture; the last of them that has a
  /// frame is shown, the last frame without. Throws `Error` as `VtuSeriesWriter` does, and naming a script that cannot be
  /// removed.
  ParaViewSeries(std::filesystem::path directory, ModelRecord model, const VtuOptions& options,
                 const PictureOptions& picture, std::vector<double> times = {});

  /// Adds a frame as `VtuSeriesWriter` does, and writes the script anew. A frame that a picture could not
  /// show has no part in the range of colours and the view.
  void write(const FrameRecord& frame);

 private:
  /// What the frames together need of one.
  struct Shown {
    double time;
    std::array<double, 2> range;
    Eigen::AlignedBox2d content;
    Eigen::AlignedBox3d box;
  };

  void look(const FrameRecord& frame);
  StateScript script() const;
  std::optional<double> timeOfPicture() const;

  /// Where a block of the series belongs.
  std::vector<std::string>& listFor(const SeriesBlock& block, StateScript& script) const;

  std::filesystem::path directory_;
  VtuSeriesWriter series_;
  ContourOptions options_;
  std::vector<double> times_;
  bool isCurved_;
  std::map<int, Shown> frames_;       ///< by index
  std::optional<FieldChoice> field_;  ///< of the last frame that has it, without its values
  std::vector<std::string> without_;  ///< bodies that do not have it
  ViewAxes axes_ = ViewAxes::Identity();
};

}  // namespace burnish
