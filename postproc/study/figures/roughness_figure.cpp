#include "postproc/study/figures/roughness_figure.h"

#include "postproc/study/run_data.h"
#include "postproc/study/run_outlook.h"
#include "postproc/text/units.h"

namespace burnish {
namespace {

Chart roughnessChart(const FigureTask& task, const RoughnessFigure& spec) {
  Chart chart;
  std::string unit;
  for (const StudyRun* run : task.study.matching(spec.runs)) {
    const RunData data(*run, task.studyDirectory);
    const ResultReader result = data.result();
    unit = result.model().lengthUnit;
    for (std::size_t k = 0; k < spec.times.size(); ++k) {
      const FrameAt at = frameAt(data, result, spec.times[k]);
      const Profile profile = faceProfile(result.model(), at.frame, spec.face).profile;
      ChartCurve curve{run->label, {}, {}, {}};
      if (spec.times.size() > 1) curve.label += ", " + timeText(spec.times, spec.timeLabels, k);
      if (at.stoppedBefore) curve.label = withStop(curve.label, at.frame.time);
      if (spec.times.size() == 1) curve.style = styleOf(task.study, *run, spec.looks);
      for (Eigen::Index i = 0; i < profile.heights.size(); ++i) {
        curve.x.push_back(profile.begin + static_cast<double>(i) * profile.spacing);
        curve.y.push_back(profile.heights(i));
      }
      chart.curves.push_back(std::move(curve));
    }
  }
  chart.x.title = withUnit("Distance along face " + spec.face.face, unit);
  chart.y.title = withUnit(spec.face.cutoff ? "Height of roughness" : "Height about the mean line", unit);
  return chart;
}

}  // namespace

Alternative RoughnessFigure::about() {
  return {"roughness", "Profiles of a face of plane bodies, as a stylus sees them."};
}

void RoughnessFigure::check(const std::string& path, const StudyReporter& reporter) const {
  reporter.requireSameLength(path + ".time_labels", timeLabels.size(), "times", times.size());
  for (const InputProblem& problem : mistakesIn(face))
    reporter.report(path + "." + problem.path, problem.text);
}

void RoughnessFigure::checkReferences(const std::string& path, const RunReporter& reporter) const {
  reporter.checkLooks(path, looks, reporter.runsOf(path + ".runs", runs));
}

void RoughnessFigure::checkOutlooks(const std::string& path, const OutlookReporter& reporter) const {
  reporter.requireFrames(path + ".times", times, reporter.runsOf(path + ".runs", runs));
}

Files RoughnessFigure::draw(const FigureTask& task) const {
  return drawWithData(roughnessChart(task, *this), task.file(".png"));
}

PrintPage RoughnessFigure::page(const FigureTask& task) const {
  return asColumn(chartPage(roughnessChart(task, *this)));
}

}  // namespace burnish
