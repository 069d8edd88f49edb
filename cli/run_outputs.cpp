#include "cli/run_outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "cli/picture_planes_check.h"
#include "engine/core/error.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

bool sameTime(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max(1.0, std::abs(b));
}

}  // namespace

RunOutputs::RunOutputs(const Scene& scene, fs::path directory, bool showProgress)
    : scene_(scene), directory_(std::move(directory)) {
  if (showProgress) progress_.emplace(stdout);
}

void RunOutputs::onModel(const ModelRecord& model) {
  requirePlanes(scene_, model);
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
  for (const PictureSpec& picture : scene_.pictures)
    for (const double time : picture.times)
      if (sameTime(frame.time, time)) draw(picture, pictureFile(picture, time), frame);
  lastFrame_ = frame;
}

void RunOutputs::finish() {
  if (progress_) progress_->finish();
  if (!lastFrame_) return;
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
  drawContour(model_, frame, contourOptions(picture), file);
  pictures_.push_back(file);
}

}  // namespace burnish
