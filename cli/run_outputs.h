#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/progress.h"
#include "engine/analysis/run.h"
#include "engine/scene/scene.h"
#include "postproc/draw/contour.h"
#include "postproc/export/vtu_series_writer.h"

namespace burnish {

/// What a run leaves beside its results while it goes on: progress, VTU files, and the pictures of the scene.
class RunOutputs : public RunObserver {
 public:
  /// The scene must outlive the object.
  RunOutputs(const Scene& scene, std::filesystem::path directory, bool showProgress, bool marksDoubts = true);

  void onWarnings(const std::vector<std::string>& warnings) override;
  void onStart(const ModelRecord& model) override;
  void onStep(const RunProgress& progress) override;
  void onFrame(const ModelRecord& model, const FrameRecord& frame) override;

  /// Draws the pictures of the end of the run from its last frame; where the run doubts its results, with a
  /// mark, and those of times before once more.
  void finish(bool isDoubtful);

  /// Whether the run has begun to write.
  bool hasStarted() const { return hasStarted_; }

  /// Pictures drawn so far.
  const std::vector<std::filesystem::path>& pictures() const { return pictures_; }

 private:
  std::filesystem::path pictureFile(const PictureSpec& picture, std::optional<double> time) const;

  /// Throws `Error` before the run goes on if the planes of a picture are none of symmetry or miss the body.
  void requirePlanes(const FrameRecord& frame) const;

  void draw(const PictureSpec& picture, const std::filesystem::path& file, const FrameRecord& frame);

  /// How a picture is drawn, with a mark once the run doubts its results.
  ContourOptions marked(const PictureSpec& picture) const;

  /// Draws the pictures of times before the end that are to be marked.
  void drawMarked();

  const Scene& scene_;
  std::filesystem::path directory_;
  std::optional<Progress> progress_;
  std::optional<VtuSeriesWriter> vtu_;
  bool marksDoubts_;
  bool isDoubtful_ = false;
  bool hasStarted_ = false;
  ModelRecord model_;
  std::optional<FrameRecord> lastFrame_;
  std::vector<std::filesystem::path> pictures_;
};

}  // namespace burnish
