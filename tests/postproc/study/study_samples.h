#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/results/history.h"
#include "engine/results/result_writer.h"
#include "engine/results/summary_file.h"
#include "postproc/study/study.h"
#include "tests/postproc/sample_records.h"

/// A study whose results are made up, as if its runs had been computed.
namespace burnish::samples {

/// An empty directory that is removed with its contents.
class ScratchDirectory {
 public:
  ScratchDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "burnish_study_XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~ScratchDirectory() { std::filesystem::remove_all(path_); }
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Columns time and value(time) in steps of 0.1 until `end`.
inline HistoryTable historyOf(const std::function<double(double)>& value, double end) {
  HistoryTable table{"history.csv", {"time", "value"}, {{}, {}}};
  for (int k = 0; 0.1 * k < end + 1e-9; ++k) {
    table.values[0].push_back(0.1 * k);
    table.values[1].push_back(value(0.1 * k));
  }
  return table;
}

/// What a run leaves behind that came to the time `end` of 2: history, convergence, summary, and frames of
/// the slab at 0, 1 and 2, with a plastic strain that grows with time, or at the end of a run that stopped.
inline void writeRun(const std::filesystem::path& directory, const std::function<double(double)>& value,
                     double end, double functions) {
  const Sample sample = slab();
  ResultWriter result(directory, sample.model);
  FrameRecord frame = sample.frame;
  ContactRecord contact;
  contact.tool = sample.model.tools.front().name;
  contact.face = "top";
  contact.quadraturePoints = Eigen::MatrixXd::Ones(2, 40);
  contact.quadraturePoints.row(0) = Eigen::RowVectorXd::LinSpaced(40, 3.0, 0.0);  // from right to left
  contact.quadraturePressure =
      (0.25 - (contact.quadraturePoints.row(0).array() - 1.5).square()).max(0.0).matrix().transpose();
  contact.quadratureGap = contact.quadraturePoints.row(0).transpose();
  contact.quadratureNormal = Eigen::Vector2d::UnitY().replicate(1, contact.quadraturePoints.cols());
  frame.contact = {contact};
  const std::vector<double> times{0.0, std::min(1.0, end), std::min(2.0, end)};
  for (frame.index = 0; frame.index < 3; ++frame.index) {
    frame.time = times[static_cast<std::size_t>(frame.index)];
    frame.fields["plastic_strain"].values = frame.time * sample.frame.fields.at("plastic_strain").values;
    result.append(frame);
  }
  const HistoryTable table = historyOf(value, end);
  HistoryWriter history(directory / "history.csv", table.columns);
  for (std::size_t k = 0; k < table.numRows(); ++k) history.append({table.values[0][k], table.values[1][k]});
  HistoryWriter convergence(directory / "convergence.csv", {"step", "time", "iteration", "residual"});
  for (int k = 1; k <= 4; ++k) convergence.append({1.0, 0.1, k - 1.0, std::pow(10.0, -std::exp2(k))});
  const bool completed = end >= 2.0;
  RunAccount account;
  account.program = "burnish";
  account.completed = completed;
  if (!completed) account.stoppedBecause = "the smallest step failed";
  if (!completed) account.doubts = {{"deep penetration", 1.2, 5}};
  account.endTime = end;
  account.steps = static_cast<int>(std::lround(10.0 * end));
  account.cuts = completed ? 0 : 7;
  account.smallestStep = 0.1;
  account.iterations = std::lround(30.0 * end);
  account.meanIterations = 3.0;
  account.maxIterations = 5;
  account.timings.total = 1.5;
  account.worstResidual = 3e-10;
  account.smallestJ = 0.9;
  account.largestPenetration = 2e-3;
  account.tolerance = 1e-9;
  account.contactParameter = 4e4;
  account.functions = static_cast<int>(functions);
  writeSummary(directory, account);
}

/// Runs coarse, middle, fine of "NURBS", whose last value is 1 + 4/functions, and `lagrange-fine`, which
/// stopped at t = 1.4.
inline Study madeUpStudy(const std::filesystem::path& directory) {
  Study study;
  study.file = directory / "made_up.yaml";
  study.spec.title = "A made-up study";
  const ParameterSpec basis{"basis", {"nurbs", "lagrange"}, {"NURBS", "Lagrange"}};
  const ParameterSpec mesh{"mesh", {"coarse", "middle", "fine"}, {}};
  study.spec.runs = {
      {.name = "{basis}-{mesh}", .scene = "s.yaml", .vary = {basis, mesh}, .set = {}, .label = {}}};
  const auto add = [&](const std::string& name, const std::string& label, const std::string& valueOfMesh,
                       double functions, double end) {
    StudyRun run{
        .name = fmt::format("{}-{}", name, valueOfMesh),
        .label = fmt::format("{}, {}", label, valueOfMesh),
        .scene = {},
        .overrides = {},
        .parameters = {
            {"basis", name}, {"basis.label", label}, {"mesh", valueOfMesh}, {"mesh.label", valueOfMesh}}};
    writeRun(
        runDirectory(directory, run), [=](double t) { return 0.5 * t * (1.0 + 4.0 / functions); }, end,
        functions);
    study.runs.push_back(std::move(run));
  };
  add("nurbs", "NURBS", "coarse", 16.0, 2.0);
  add("nurbs", "NURBS", "middle", 64.0, 2.0);
  add("nurbs", "NURBS", "fine", 256.0, 2.0);
  add("lagrange", "Lagrange", "fine", 256.0, 1.4);
  return study;
}

}  // namespace burnish::samples
