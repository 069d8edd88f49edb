#include "cli/commands/run_outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <system_error>
#include <utility>

#include "cli/arguments.h"
#include "cli/commands/picture_planes_check.h"
#include "cli/console.h"
#include "cli/declared_options.h"
#include "cli/foreign_files.h"
#include "engine/core/error.h"
#include "engine/core/interruption.h"
#include "engine/results/result_reader.h"
#include "engine/schema/leaf.h"
#include "postproc/draw/contour/contour.h"
#include "postproc/draw/page/doubt_mark.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

bool sameTime(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max(1.0, std::abs(b));
}

/// The call that draws a picture of a scene from the results.
std::string renderCommand(const ScenePicture& picture, std::optional<double> time, const fs::path& directory,
                          const fs::path& file) {
  const std::string frame = time ? fmt::format(" --frame time={}", *time) : "";
  const std::string range =
      picture.range ? fmt::format(" --range {},{}", (*picture.range)[0], (*picture.range)[1]) : "";
  const std::string dpi = picture.dpi ? fmt::format(" --dpi {}", *picture.dpi) : "";
  const std::string options =
      optionsText(static_cast<const PictureOptions&>(picture),
                  picturesOfSize(picture.isForPrint() ? kPrintSize : PictureOptions().size));
  return fmt::format("burnish render {} --field {}{}{}{}{} -o {}", shellWord(directory.string()),
                     shellWord(picture.field), frame, range, dpi, options, shellWord(file.string()));
}

}  // namespace

RunOutputs::RunOutputs(const SceneDocument& document, fs::path directory, bool showProgress, bool marksDoubts)
    : document_(document), directory_(std::move(directory)), marksDoubts_(marksDoubts) {
  if (showProgress) progress_.emplace();
}

void RunOutputs::requireNoForeignFiles() const {
  if (isOfARun(directory_)) return;
  std::vector<fs::path> files{directory_ / "history.csv", directory_ / "convergence.csv",
                              directory_ / "summary.yaml"};
  if (document_.scene.output.vtu)
    for (fs::path& file : seriesFiles(directory_)) files.push_back(std::move(file));
  for (const ScenePicture& picture : document_.pictures) {
    files.push_back(pictureFile(picture, std::nullopt));
    for (const double time : picture.times) files.push_back(pictureFile(picture, time));
  }
  requireAbsent(files);
}

void RunOutputs::onModel(const ModelRecord& model) {
  requirePlanes(document_, model);
}

void RunOutputs::onWarnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) printError("warning: {}\n", warning);
}

void RunOutputs::onStart(const ModelRecord& model) {
  hasStarted_ = true;
  model_ = model;
  if (document_.scene.output.vtu)
    vtu_.emplace(directory_, model, VtuOptions{.pieces = document_.scene.output.pieces});
  std::error_code absent;
  for (const ScenePicture& picture : document_.pictures) {
    // A picture of an earlier run would pass for one of this run if this one stops before.
    fs::remove(pictureFile(picture, std::nullopt), absent);
    for (const double time : picture.times) fs::remove(pictureFile(picture, time), absent);
  }
}

void RunOutputs::onStep(const RunProgress& progress) {
  if (progress_) progress_->show(progress);
}

void RunOutputs::onFrame(const ModelRecord&, const FrameRecord& frame) {
  if (vtu_) vtu_->write(frame);
  drawDue(frame);
  lastFrame_ = frame;
}

bool RunOutputs::isDue(double time) const {
  return std::ranges::any_of(document_.pictures, [time](const ScenePicture& picture) {
    return std::ranges::any_of(picture.times, [time](double wanted) { return sameTime(time, wanted); });
  });
}

void RunOutputs::drawDue(const FrameRecord& frame) {
  for (const ScenePicture& picture : document_.pictures)
    for (const double time : picture.times)
      if (sameTime(frame.time, time)) draw(picture, time, frame);
}

ContourOptions RunOutputs::marked(const ScenePicture& picture) const {
  ContourOptions options(picture);
  if (isDoubtful_ && picture.doubtMarks) options.doubt = kDoubtMark;
  return options;
}

void RunOutputs::drawMarked() {
  if (pictures_.empty() && missing_.empty()) return;  // nothing was due before the end
  pictures_.clear();
  missing_.clear();
  const ResultReader result(directory_);
  const std::vector<double> times = result.times();
  for (std::size_t k = 0; k < times.size(); ++k)
    if (isDue(times[k])) drawDue(result.frame(static_cast<int>(k)));
}

void RunOutputs::finish(bool isDoubtful) {
  if (progress_) progress_->finish();
  if (!lastFrame_) return;
  isDoubtful_ = isDoubtful && marksDoubts_;
  if (isDoubtful_) drawMarked();
  for (const ScenePicture& picture : document_.pictures)
    if (picture.times.empty()) draw(picture, std::nullopt, *lastFrame_);
}

fs::path RunOutputs::pictureFile(const ScenePicture& picture, std::optional<double> time) const {
  const std::string stem = picture.name.value_or(picture.field);
  const std::string ending = enumNames<PictureFormat>()[static_cast<std::size_t>(picture.format)];
  return directory_ / "pictures" /
         (time ? fmt::format("{}_t{}.{}", stem, *time, ending) : fmt::format("{}.{}", stem, ending));
}

void RunOutputs::draw(const ScenePicture& picture, std::optional<double> time, const FrameRecord& frame) {
  const fs::path file = pictureFile(picture, time);
  const auto note = [&](const char* reason) {
    missing_.push_back({file, reason, renderCommand(picture, time, directory_, file)});
  };
  if (interruption() != 0) return note("");
  try {
    makeDirectory(file.parent_path());
    drawContour(model_, frame, marked(picture), file);
    pictures_.push_back(file);
  } catch (const Interrupted&) {
    note("");
  } catch (const Error& error) {
    note(error.what());
  } catch (const std::bad_alloc&) {
    note("the memory of this machine does not suffice");
  }
}

}  // namespace burnish
