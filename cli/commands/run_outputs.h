#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/progress.h"
#include "engine/analysis/run.h"
#include "engine/results/result_reader.h"
#include "postproc/draw/contour/contour.h"
#include "postproc/paraview/paraview_series.h"
#include "postproc/scene/scene_document.h"

namespace burnish {

/// What a run prints while it goes on.
enum class RunReport { Nothing, Progress, Events };

/// What a run leaves beside its results: progress, VTU files, and the pictures and probes of the scene.
class RunOutputs : public RunObserver {
 public:
  /// The document must outlive the object.
  RunOutputs(const SceneDocument& document, std::filesystem::path directory, RunReport report,
             bool marksDoubts = true);

  /// For a run that begins anew: throws `Error` if the directory is not that of an earlier run and has files that
  /// the run would overwrite. Notes what an earlier run has drawn there, which goes when the run starts.
  void takeDirectory();

  /// Whether there will be pictures, charts or VTU files.
  bool needVtk() const;

  void onModel(const ModelRecord& model) override;
  void onWarnings(const std::vector<std::string>& warnings) override;
  void onStart(const ModelRecord& model) override;
  void onStep(const RunProgress& progress) override;
  void onFrame(const ModelRecord& model, const FrameRecord& frame) override;

  /// Draws the pictures of the end of the run from its last frame; where the run doubts its results, with a
  /// mark; those of times before once more, with a mark or with what several have in common; then the charts of the probes.
  void finish(bool isDoubtful);

  /// Whether the run has begun to write.
  bool hasStarted() const { return hasStarted_; }

  /// Pictures drawn so far.
  const std::vector<std::filesystem::path>& pictures() const { return pictures_; }

  /// A picture or chart that was not drawn.
  struct Missing {
    std::string what;  ///< "picture", "chart"
    std::filesystem::path file;
    std::string reason;   ///< empty: interrupted
    std::string command;  ///< that draws it from the results
  };
  const std::vector<Missing>& missing() const { return missing_; }

 private:
  /// The files of all pictures, charts and tables that a document asks for.
  std::vector<std::filesystem::path> drawnFiles(const SceneDocument& document) const;

  /// A chart; its table has the ending .csv.
  std::filesystem::path probeFile(const SceneProbe& probe) const;
  std::filesystem::path pictureFile(const ScenePicture& picture, std::optional<double> time) const;

  /// A picture of the frame, or of the last one without a time. options: how it is drawn.
  void draw(const ScenePicture& picture, std::optional<double> time, const FrameRecord& frame,
            const std::function<ContourOptions()>& options);

  void draw(const SceneProbe& probe);

  /// Makes a picture or a chart; what goes wrong costs this one only. command: that makes it from the results.
  void make(const char* what, const std::filesystem::path& file, const std::string& command,
            const std::function<void()>& act);

  /// How a picture is drawn, with a mark once the run doubts its results.
  ContourOptions marked(const ScenePicture& picture) const;

  /// Draws the pictures that are wanted of the time of a frame.
  void drawDue(const FrameRecord& frame);

  /// Draws those of times before the end once more where the end has told more of them: the window and the range of
  /// colours of several, or that they are to be marked.
  void drawAgain(const ResultReader& result);

  const SceneDocument& document_;
  std::filesystem::path directory_;
  RunReport report_;
  std::optional<Progress> progress_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<ParaViewSeries> vtu_;
  bool marksDoubts_;
  std::vector<std::filesystem::path> outdated_;  ///< pictures and charts that an earlier run may have left
  bool isDoubtful_ = false;
  bool hasStarted_ = false;
  ModelRecord model_;
  std::optional<FrameRecord> lastFrame_;
  std::vector<std::filesystem::path> pictures_;
  std::vector<Missing> missing_;
};

}  // namespace burnish
