#include "cli/commands/run_outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <system_error>
#include <utility>

#include "cli/arguments.h"
#include "cli/commands/document_places_check.h"
#include "cli/commands/run_events.h"
#include "cli/console.h"
#include "cli/declared_options.h"
#include "cli/foreign_files.h"
#include "engine/core/error.h"
#include "engine/core/interruption.h"
#include "engine/core/same_time.h"
#include "engine/schema/leaf.h"
#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/contour.h"
#include "postproc/draw/contour/contour_series.h"
#include "postproc/draw/page/doubt_mark.h"
#include "postproc/probe/depth_numbers.h"
#include "postproc/probe/probed_run.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

/// The call that draws a picture of a scene from the results.
std::string renderCommand(const ScenePicture& picture, std::optional<double> time, const fs::path& directory,
                          const fs::path& file) {
  const std::string frame = time ? fmt::format(" --frame time={}", *time) : "";
  const std::string range =
      picture.range ? fmt::format(" --range {},{}", (*picture.range)[0], (*picture.range)[1]) : "";
  std::string print = picture.dpi ? fmt::format(" --dpi {}", *picture.dpi) : "";
  if (picture.printField == PrintField::Vector) print += " --print-field vector";
  const std::string options =
      optionsText(static_cast<const PictureOptions&>(picture),
                  picturesOfSize(picture.isForPrint() ? kPrintSize : PictureOptions().size));
  return fmt::format("burnish render {} --field {}{}{}{}{} -o {}", shellWord(directory.string()),
                     shellWord(picture.field), frame, range, print, options, shellWord(file.string()));
}

/// The call that draws the chart of a probe from the results.
std::string probeCommand(const SceneProbe& probe, const fs::path& directory, const fs::path& file) {
  std::string frames;
  if (probe.times.size() == 1) frames = fmt::format(" --frame time={}", probe.times.front());
  if (probe.times.size() > 1)
    frames = fmt::format(" --frame time={}-time={}", probe.times.front(), probe.times.back());
  return fmt::format("burnish probe {}{}{} -o {}", shellWord(directory.string()),
                     optionsText(static_cast<const ProbeSpec&>(probe)), frames, shellWord(file.string()));
}

/// The options with what pictures of several frames have in common.
ContourOptions withSharedView(const ContourOptions& own, const ResultReader& result,
                              const std::vector<int>& frames) {
  if (frames.size() == 1) return own;
  ContourOptions shared = withCommonView(own, result, frames, frames);
  if (own.clip && shared.range) shared.note = clipNote(*own.clip, result.model().dim);
  return shared;
}

}  // namespace

RunOutputs::RunOutputs(const SceneDocument& document, fs::path directory, RunReport report, bool marksDoubts)
    : document_(document),
      directory_(std::move(directory)),
      report_(report),
      marksDoubts_(marksDoubts),
      outdated_(drawnFiles(document)) {
  if (report == RunReport::Progress) progress_.emplace();
}

void RunOutputs::takeDirectory() {
  if (isOfARun(directory_)) {
    try {
      const std::vector<fs::path> earlier = drawnFiles(readResultDocument(directory_));
      outdated_.insert(outdated_.end(), earlier.begin(), earlier.end());
    } catch (const Error&) {
      // What an unreadable result had drawn is not known, and stays.
    }
    return;
  }
  std::vector<fs::path> files{directory_ / "history.csv", directory_ / "convergence.csv",
                              directory_ / "summary.yaml"};
  if (document_.scene.output.vtu)
    for (fs::path& file : seriesFiles(directory_)) files.push_back(std::move(file));
  files.insert(files.end(), outdated_.begin(), outdated_.end());
  requireAbsent(files);
}

std::vector<fs::path> RunOutputs::drawnFiles(const SceneDocument& document) const {
  std::vector<fs::path> files;
  for (const ScenePicture& picture : document.pictures) {
    files.push_back(pictureFile(picture, std::nullopt));
    for (const double time : picture.times) files.push_back(pictureFile(picture, time));
  }
  for (const SceneProbe& probe : document.probes) {
    files.push_back(probeFile(probe));
    files.push_back(probeFile(probe).replace_extension(".csv"));
    if (hasDepthNumbers(probe)) files.push_back(probeFile(probe).replace_extension(".numbers.csv"));
  }
  return files;
}

bool RunOutputs::needVtk() const {
  return document_.scene.output.vtu || !document_.pictures.empty() || !document_.probes.empty();
}

void RunOutputs::onModel(const ModelRecord& model) {
  requirePlaces(document_, model);
}

void RunOutputs::onWarnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) printError("warning: {}\n", warning);
}

void RunOutputs::onStart(const ModelRecord& model) {
  hasStarted_ = true;
  model_ = model;
  if (document_.scene.output.vtu) {
    const ScenePicture picture = firstPicture(document_);
    vtu_.emplace(directory_, model, VtuOptions{.pieces = document_.scene.output.pieces}, picture,
                 picture.times);
  }
  std::error_code absent;
  // A picture of an earlier run would pass for one of this run, now or if this one stops before.
  for (const fs::path& file : outdated_) fs::remove(file, absent);
}

void RunOutputs::onStep(const RunProgress& progress) {
  if (progress_) progress_->show(progress);
  if (report_ == RunReport::Events)
    printStepEvent(progress,
                   std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
}

void RunOutputs::onFrame(const ModelRecord&, const FrameRecord& frame) {
  if (vtu_) vtu_->write(frame);
  if (report_ == RunReport::Events) printFrameEvent(frame.index, frame.time);
  drawDue(frame);
  lastFrame_ = frame;
}

void RunOutputs::drawDue(const FrameRecord& frame) {
  for (const ScenePicture& picture : document_.pictures)
    for (const double time : picture.times)
      if (isSameTime(frame.time, time)) draw(picture, time, frame, [&] { return ContourOptions(picture); });
}

ContourOptions RunOutputs::marked(const ScenePicture& picture) const {
  ContourOptions options(picture);
  if (isDoubtful_ && picture.doubtMarks) options.doubt = kDoubtMark;
  return options;
}

void RunOutputs::drawAgain(const ResultReader& result) {
  const std::vector<double> times = result.times();
  for (const ScenePicture& picture : document_.pictures) {
    std::vector<double> drawn;
    std::vector<int> frames;
    for (const double time : picture.times) {
      const auto at = std::ranges::find_if(times, [&](double of) { return isSameTime(of, time); });
      if (at == times.end() || !fs::exists(pictureFile(picture, time))) continue;
      drawn.push_back(time);
      frames.push_back(static_cast<int>(at - times.begin()));
    }
    if (frames.empty() || (frames.size() == 1 && !isDoubtful_)) continue;
    std::optional<ContourOptions> together;
    const auto options = [&] {
      if (!together) together = withSharedView(marked(picture), result, frames);
      return *together;
    };
    for (std::size_t k = 0; k < frames.size(); ++k) draw(picture, drawn[k], result.frame(frames[k]), options);
  }
}

void RunOutputs::finish(bool isDoubtful) {
  if (progress_) progress_->finish();
  if (!lastFrame_) return;
  isDoubtful_ = isDoubtful && marksDoubts_;
  const ResultReader result(directory_);
  drawAgain(result);
  for (const ScenePicture& picture : document_.pictures)
    if (picture.times.empty())
      draw(picture, std::nullopt, *lastFrame_, [&] {
        ContourOptions options = marked(picture);
        options.largest = largestInRun(result, *lastFrame_, options.field);
        return options;
      });
  for (const SceneProbe& probe : document_.probes) draw(probe);
}

fs::path RunOutputs::probeFile(const SceneProbe& probe) const {
  return directory_ / "probes" / (probe.name + ".png");
}

fs::path RunOutputs::pictureFile(const ScenePicture& picture, std::optional<double> time) const {
  const std::string stem = picture.name.value_or(picture.field);
  const std::string ending = enumNames<PictureFormat>()[static_cast<std::size_t>(picture.format)];
  return directory_ / "pictures" /
         (time ? fmt::format("{}_t{}.{}", stem, *time, ending) : fmt::format("{}.{}", stem, ending));
}

void RunOutputs::draw(const ScenePicture& picture, std::optional<double> time, const FrameRecord& frame,
                      const std::function<ContourOptions()>& options) {
  const fs::path file = pictureFile(picture, time);
  make("picture", file, renderCommand(picture, time, directory_, file),
       [&] { drawContour(model_, frame, options(), file); });
}

void RunOutputs::draw(const SceneProbe& probe) {
  const fs::path file = probeFile(probe);
  make("chart", file, probeCommand(probe, directory_, file), [&] {
    const std::vector<ProbedRun> probed = probedRuns(ResultReader(directory_), probe, probe.times);
    writeText(tableOf(probe, probed), fs::path(file).replace_extension(".csv"));
    if (hasDepthNumbers(probe))
      writeText(tableOf(depthNumbersOf(ResultReader(directory_), probe, probe.times), derivedUnits(model_),
                        model_.stressUnit),
                fs::path(file).replace_extension(".numbers.csv"));
    drawChart(chartOf(probe, probed), file);
  });
}

void RunOutputs::make(const char* what, const fs::path& file, const std::string& command,
                      const std::function<void()>& act) {
  std::erase(pictures_, file);  // of one that is drawn again
  const auto note = [&](const char* reason) { missing_.push_back({what, file, reason, command}); };
  if (interruption() != 0) return note("");
  try {
    makeDirectory(file.parent_path());
    act();
    pictures_.push_back(file);
    if (report_ == RunReport::Events) printPictureEvent(file);
  } catch (const Interrupted&) {
    note("");
  } catch (const Error& error) {
    note(error.what());
  } catch (const std::bad_alloc&) {
    note("the memory of this machine does not suffice");
  }
}

}  // namespace burnish
