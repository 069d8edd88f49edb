#include "cli/run_outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "engine/core/error.h"
#include "engine/results/result_reader.h"
#include "postproc/draw/doubt_mark.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

bool sameTime(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max(1.0, std::abs(b));
}

ContourOptions contourOptions(const PictureSpec& picture) {
  ContourOptions options;
  options.field = picture.field;
  options.range = picture.range;
  options.size = picture.size;
  options.bands = picture.bands;
  options.knots = picture.knots;
  options.undeformed = picture.undeformed;
  if (picture.cut) options.cut = cutPlaneNamed(*picture.cut);
  if (picture.slice) options.slice = cutPlaneNamed(*picture.slice);
  if (picture.mirror) options.mirror = mirrorPlanesNamed(*picture.mirror).value();
  options.toolOpacity = picture.toolOpacity;
  return options;
}

}  // namespace

RunOutputs::RunOutputs(const Scene& scene, fs::path directory, bool showProgress, bool marksDoubts)
    : scene_(scene), directory_(std::move(directory)), marksDoubts_(marksDoubts) {
  if (showProgress) progress_.emplace(stdout);
}

void RunOutputs::onWarnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) fmt::print(stderr, "warning: {}\n", warning);
}

void RunOutputs::onStart(const ModelRecord& model) {
  hasStarted_ = true;
  model_ = model;
  if (scene_.output.vtu) vtu_.emplace(directory_, model);
  std::error_code absent;
  for (const PictureSpec& picture : scene_.pictures) {
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
  if (!lastFrame_) requirePlanes(frame);
  for (const PictureSpec& picture : scene_.pictures)
    for (const double time : picture.times)
      if (sameTime(frame.time, time)) draw(picture, pictureFile(picture, time), frame);
  lastFrame_ = frame;
}

void RunOutputs::requirePlanes(const FrameRecord& frame) const {
  for (std::size_t k = 0; k < scene_.pictures.size(); ++k) {
    const ContourOptions options = contourOptions(scene_.pictures[k]);
    if (options.mirror.empty() && !options.cut && !options.slice) continue;
    try {
      contentOf(model_, frame, options);
    } catch (const Error& error) {
      throw Error(fmt::format("{}: pictures[{}]: {}", scene_.source, k, error.what()));
    }
  }
}

ContourOptions RunOutputs::marked(const PictureSpec& picture) const {
  ContourOptions options = contourOptions(picture);
  if (isDoubtful_ && picture.doubtMarks) options.doubt = kDoubtMark;
  return options;
}

void RunOutputs::drawMarked() {
  const auto isDrawnBefore = [](const PictureSpec& picture) { return !picture.times.empty(); };
  if (std::none_of(scene_.pictures.begin(), scene_.pictures.end(), isDrawnBefore)) return;
  const ResultReader result(directory_);
  const std::vector<double> times = result.times();
  const std::vector<fs::path> drawn = std::exchange(pictures_, {});
  for (const PictureSpec& picture : scene_.pictures)
    for (const double time : picture.times)
      for (std::size_t k = 0; k < times.size() && picture.doubtMarks; ++k)
        if (sameTime(times[k], time))
          draw(picture, pictureFile(picture, time), result.frame(static_cast<int>(k)));
  pictures_ = drawn;
}

void RunOutputs::finish(bool isDoubtful) {
  if (progress_) progress_->finish();
  if (!lastFrame_) return;
  isDoubtful_ = isDoubtful && marksDoubts_;
  if (isDoubtful_) drawMarked();
  for (const PictureSpec& picture : scene_.pictures)
    if (picture.times.empty()) draw(picture, pictureFile(picture, std::nullopt), *lastFrame_);
}

fs::path RunOutputs::pictureFile(const PictureSpec& picture, std::optional<double> time) const {
  const std::string stem = picture.name.value_or(picture.field);
  return directory_ / "pictures" / (time ? fmt::format("{}_t{}.png", stem, *time) : stem + ".png");
}

void RunOutputs::draw(const PictureSpec& picture, const fs::path& file, const FrameRecord& frame) {
  std::error_code status;
  fs::create_directories(file.parent_path(), status);
  if (status)
    throw Error(
        fmt::format("cannot create the directory {}: {}", file.parent_path().string(), status.message()));
  drawContour(model_, frame, marked(picture), file);
  pictures_.push_back(file);
}

}  // namespace burnish
