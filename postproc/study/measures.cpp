#include "postproc/study/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/probe/probed_run.h"
#include "postproc/probe/section_numbers.h"
#include "postproc/study/evidence/reductions.h"
#include "postproc/surface/face_roughness.h"

namespace burnish {
namespace {

/// Numbers of a summary that do not depend on how far the run came.
constexpr std::array kSettings{
    "end_time",          "functions",       "unknowns", "tolerance", "constraint_tolerance",
    "contact_parameter", "factor_non_zeros"};

/// The part of a history that a measure looks at, or why it is not all there.
struct Covered {
  Series series;
  std::string gap;  ///< empty if nothing is missing
};

/// Without a range the whole history counts, which a run that stopped does not have.
Covered cover(const Series& series, const std::optional<std::array<double, 2>>& range,
              std::optional<double> stoppedAt) {
  const bool whole = range ? reachesEnd(series, *range) : !stoppedAt;
  Covered covered{range ? restricted(series, *range) : series, {}};
  if (!whole && stoppedAt)
    covered.gap = stoppedText(*stoppedAt);
  else if (!whole && !series.x.empty())
    covered.gap =
        fmt::format("the history ends at {:.4g}", *std::max_element(series.x.begin(), series.x.end()));
  else if (covered.series.x.empty())
    covered.gap = "no rows in the range";
  return covered;
}

Measured valueOr(std::optional<double> value, const std::string& note) {
  return value ? Measured{value, {}} : Measured{{}, note};
}

/// A field over the depth, where the body has it.
Series profileIn(const ResultReader& result, const FrameRecord& frame, const ProbeSpec& place) {
  Series series;
  for (const ProbePoint& point : probedFrame(result.model(), frame, place).points) {
    if (std::isnan(point.values(0))) continue;
    series.x.push_back(point.at);
    series.y.push_back(point.values(0));
  }
  return series;
}

Measured compareProfiles(const RunData& own, const RunData& other, const ProfileMeasure& measure) {
  const ResultReader results[] = {own.result(), other.result()};
  const RunData* runs[] = {&own, &other};
  Series profiles[2];
  for (int k = 0; k < 2; ++k) {
    const FrameAt at = frameAt(*runs[k], results[k], measure.time.value_or(kEndOfRun));
    if (at.stoppedBefore) return {{}, (k == 0 ? "" : "the other run: ") + stoppedText(at.frame.time)};
    profiles[k] = profileIn(results[k], at.frame, measure.place);
  }
  double scale = 0.0;
  for (const double y : profiles[1].y) scale = std::max(scale, std::abs(y));
  if (scale == 0.0) return {{}, "the other run is zero everywhere"};
  const auto largest =
      largestDifference(measure.range ? restricted(profiles[0], *measure.range) : profiles[0], profiles[1]);
  return largest ? Measured{*largest / scale, {}} : Measured{{}, "no common depth"};
}

/// Evaluates what a measure says on the results of one run.
class Evaluation {
 public:
  Evaluation(const Study& study, const RunData& data, const std::filesystem::path& studyDirectory,
             SeenProfiles& seen)
      : study_(study), data_(data), studyDirectory_(studyDirectory), seen_(seen) {}

  Measured operator()(const HistoryMeasure& measure) const {
    return reduceHistory(data_.history(), measure, data_.stoppedAt());
  }

  Measured operator()(const SummaryMeasure& measure) const {
    const bool setting = std::find(kSettings.begin(), kSettings.end(), measure.entry) != kSettings.end();
    const auto stopped = data_.stoppedAt();
    return {data_.number(measure.entry), stopped && !setting ? stoppedText(*stopped) : std::string()};
  }

  Measured operator()(const LineMeasure& measure) const {
    const ResultReader result = data_.result();
    const FrameAt at = frameAt(data_, result, measure.time);
    if (at.stoppedBefore) return {{}, stoppedText(at.frame.time)};
    return {reduceLine(result.model(), at.frame, measure), {}};
  }

  Measured operator()(const DifferenceMeasure& measure) const {
    const StudyRun& other = runNamed(study_, fillIn(measure.other, data_.run().parameters));
    if (!hasEnded(other, studyDirectory_)) return {{}, fmt::format("no results of {}", other.label)};
    const RunData otherData(other, studyDirectory_);
    return compareHistories(data_.history(), data_.stoppedAt(), otherData.history(), otherData.stoppedAt(),
                            measure);
  }

  Measured operator()(const DepthMeasure& measure) const {
    const ResultReader result = data_.result();
    const FrameAt at = frameAt(data_, result, measure.time.value_or(kEndOfRun));
    if (at.stoppedBefore) return {{}, stoppedText(at.frame.time)};
    const DepthNumbers& numbers = seen_.of(data_, result, at.frame, measure.place);
    const auto row = std::ranges::find(kDepthNumbers, measure.number, &DepthNumberRow::name);
    const double value = row->value(numbers);
    return std::isnan(value) ? Measured{{}, "the body has none"} : Measured{value, {}};
  }

  Measured operator()(const SectionMeasure& measure) const {
    const ResultReader result = data_.result();
    const FrameAt at = frameAt(data_, result, measure.time.value_or(kEndOfRun));
    if (at.stoppedBefore) return {{}, stoppedText(at.frame.time)};
    const SectionNumbers numbers = sectionNumbers(result.model(), at.frame, measure.plane, measure.bodies);
    const double value =
        std::ranges::find(kSectionNumbers, measure.number, &SectionNumberRow::name)->value(numbers);
    return std::isnan(value) ? Measured{{}, "there is no stress"} : Measured{value, {}};
  }

  Measured operator()(const ProfileMeasure& measure) const {
    const StudyRun& other = runNamed(study_, fillIn(measure.other, data_.run().parameters));
    if (!hasEnded(other, studyDirectory_)) return {{}, fmt::format("no results of {}", other.label)};
    return compareProfiles(data_, RunData(other, studyDirectory_), measure);
  }

  Measured operator()(const RoughnessMeasure& measure) const {
    const ResultReader result = data_.result();
    const FrameAt at = frameAt(data_, result, measure.time.value_or(kEndOfRun));
    if (at.stoppedBefore) return {{}, stoppedText(at.frame.time)};
    const ModelRecord& model = result.model();
    std::array<double, 3> numbers{};
    if (hasProfile(model, measure.face)) {
      const ProfileRoughness found = faceProfile(model, at.frame, measure.face).roughness;
      numbers = {found.a, found.q, found.z};
    } else {
      const AreaRoughness found = faceArea(model, at.frame, measure.face).roughness;
      numbers = {found.a, found.q, found.z};
    }
    return {numbers[static_cast<std::size_t>(measure.number)], {}};
  }

  Measured operator()(const ConvergenceMeasure&) const {
    Measured order = convergenceOverSteps(data_.convergence());
    if (const auto stopped = data_.stoppedAt()) order.note = stoppedText(*stopped);
    return order;
  }

 private:
  const Study& study_;
  const RunData& data_;
  const std::filesystem::path& studyDirectory_;
  SeenProfiles& seen_;
};

}  // namespace

Measured reduceHistory(const HistoryTable& history, const HistoryMeasure& measure,
                       std::optional<double> stoppedAt) {
  const Series series = seriesOf(history, measure.x, measure.y, measure.where);
  if (measure.reduce == Reduction::At) {
    if (!measure.at)
      throw Error(
          fmt::format("{}: the measure of {} at a point needs `at`", history.path.string(), measure.y));
    return valueOr(interpolate(series, *measure.at),
                   stoppedAt ? stoppedText(*stoppedAt) : fmt::format("{} is not reached", *measure.at));
  }
  const bool startOnly = measure.reduce == Reduction::First && !measure.range;
  const Covered covered = cover(series, measure.range, startOnly ? std::nullopt : stoppedAt);
  if (!covered.gap.empty()) return {{}, covered.gap};
  return valueOr(reduced(covered.series, measure.reduce), "too few points");
}

Measured compareHistories(const HistoryTable& history, std::optional<double> stoppedAt,
                          const HistoryTable& other, std::optional<double> otherStoppedAt,
                          const DifferenceMeasure& measure) {
  const Covered own = cover(seriesOf(history, measure.x, measure.y, measure.where), measure.range, stoppedAt);
  const Covered base =
      cover(seriesOf(other, measure.x, measure.y, measure.where), measure.range, otherStoppedAt);
  if (!base.gap.empty()) return {{}, "the other run: " + base.gap};
  double scale = 0.0;
  for (const double y : base.series.y) scale = std::max(scale, std::abs(y));
  if (scale == 0.0) return {{}, "the other run is zero everywhere"};
  if (measure.tolerance) {
    const auto x = firstDeparture(own.series, base.series, *measure.tolerance * scale);
    if (x) return {x, {}};
    return {
        {},
        own.gap.empty() ? fmt::format("within {:.3g} % everywhere", 100.0 * *measure.tolerance) : own.gap};
  }
  if (!own.gap.empty()) return {{}, own.gap};
  const auto largest = largestDifference(own.series, base.series);
  return largest ? Measured{*largest / scale, {}} : Measured{{}, "no common range"};
}

double reduceLine(const ModelRecord& model, const FrameRecord& frame, const LineMeasure& measure) {
  if (model.dim != 2)
    throw Error(fmt::format("{}: a line of constant second parameter needs two dimensions", model.title));
  constexpr int kCellsPerSpan = 10;  // 11 points, those of neighbouring spans shared
  const PatchRecord& record = meshOf(model, frame).patches.front();
  const Patch<2> patch = patchGeometry<2>(record);
  const FieldChoice field = chooseField(model, frame, measure.field);
  const std::vector<double>& heights = patch.basis().direction(1).breakpoints();
  const double height = std::lerp(heights.front(), heights.back(), measure.height);
  const std::vector<double> line = subdividedSpans(patch.basis().direction(0), kCellsPerSpan);
  Eigen::VectorXd values(static_cast<Eigen::Index>(line.size()));
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Eigen::Vector2d xi(line[k], height);
    const int span = patch.findSpan(xi);
    Eigen::VectorXd value = Eigen::VectorXd::Zero(field.coefficients.rows());
    const Eigen::VectorXd R = patch.shape(span, xi).R;
    const std::vector<int> functions = patch.basis().spanFunctions(span);
    for (std::size_t a = 0; a < functions.size(); ++a)
      value += R(static_cast<Eigen::Index>(a)) *
               field.coefficients.col(record.nodes[static_cast<std::size_t>(functions[a])]);
    values(static_cast<Eigen::Index>(k)) = value.size() == 1 ? value(0) : value.norm();
  }
  if (measure.reduce == LineReduction::Max) return values.maxCoeff();
  if (measure.reduce == LineReduction::Min) return values.minCoeff();
  return variation(values);
}

Measured convergenceOverSteps(const HistoryTable& convergence) {
  const auto& steps = convergence.column("step");
  const auto& residuals = convergence.column("residual");
  std::vector<double> orders;
  for (std::size_t begin = 0; begin < steps.size();) {
    std::size_t end = begin;
    while (end < steps.size() && steps[end] == steps[begin]) ++end;
    const auto order = convergenceOrder({residuals.begin() + static_cast<std::ptrdiff_t>(begin),
                                         residuals.begin() + static_cast<std::ptrdiff_t>(end)});
    if (order) orders.push_back(*order);
    begin = end;
  }
  return valueOr(median(orders), "no step has three residuals above rounding");
}

const DepthNumbers& SeenProfiles::of(const RunData& run, const ResultReader& result, const FrameRecord& frame,
                                     const ProbeSpec& place) {
  const auto found = std::ranges::find_if(profiles_, [&](const Profile& profile) {
    return profile.run == run.run().name && profile.time == frame.time && profile.place == place;
  });
  if (found != profiles_.end()) return found->numbers;
  return profiles_.emplace_back(run.run().name, frame.time, place, depthNumbers(result.model(), frame, place))
      .numbers;
}

Measured evaluateMeasure(const Study& study, const StudyRun& run, const MeasureSpec& measure,
                         const std::filesystem::path& studyDirectory, SeenProfiles& seen) {
  if (!hasEnded(run, studyDirectory)) return {{}, "no results"};
  const RunData data(run, studyDirectory);
  return std::visit(Evaluation(study, data, studyDirectory, seen), measure.what);
}

Measured measuredOrFault(const Study& study, const StatementSpec& statement, const StudyRun& run,
                         const MeasureSpec& measure, const std::filesystem::path& studyDirectory,
                         SeenProfiles& seen, std::vector<std::string>& faults) {
  try {
    return evaluateMeasure(study, run, measure, studyDirectory, seen);
  } catch (const Error& error) {
    const std::string fault = fmt::format("{}: measure {} of statement {}: {}", study.file.string(),
                                          measure.name, statement.name, error.what());
    if (std::ranges::count(faults, fault) == 0) faults.push_back(fault);
    return {{}, "the results have no such thing"};
  }
}

const StudyRun& runNamed(const Study& study, const std::string& name) {
  const auto found = std::find_if(study.runs.begin(), study.runs.end(),
                                  [&](const StudyRun& run) { return run.name == name; });
  if (found != study.runs.end()) return *found;
  std::vector<std::string> names;
  for (const StudyRun& run : study.runs) names.push_back(run.name);
  throw Error(
      fmt::format("{}: there is no run \"{}\".{}", study.file.string(), name, didYouMean(name, names)));
}

}  // namespace burnish
