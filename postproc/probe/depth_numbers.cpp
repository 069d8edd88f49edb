#include "postproc/probe/depth_numbers.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/core/error.h"
#include "postproc/probe/numbers_table.h"
#include "postproc/probe/probed_run.h"

namespace burnish {
namespace {

/// Values over the depth, as many as depths.
struct DepthCurve {
  std::vector<double> depths, values;
};

/// Linear between the points.
double integral(const DepthCurve& curve) {
  double sum = 0.0;
  for (std::size_t k = 1; k < curve.depths.size(); ++k)
    sum += 0.5 * (curve.depths[k] - curve.depths[k - 1]) * (curve.values[k] + curve.values[k - 1]);
  return sum;
}

double largestMagnitude(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Where the values cross a level between two points.
double crossing(const DepthCurve& curve, std::size_t k, double level) {
  const double share = (level - curve.values[k]) / (curve.values[k + 1] - curve.values[k]);
  return std::lerp(curve.depths[k], curve.depths[k + 1], share);
}

bool hasField(const FrameRecord& frame, const std::string& name) {
  return frame.fields.contains(name);
}

/// The points of the profile in the body, with these fields themselves, whatever a chart of it shows means of.
ProbedRun profileOf(const ModelRecord& model, const FrameRecord& frame, ProbeSpec spec,
                    std::vector<std::string> fields) {
  spec.fields = std::move(fields);
  spec.window.reset();
  spec.penetration.reset();
  spec.mean = false;
  spec.formula.clear();
  ProbedRun run = probedFrame(model, frame, spec);
  std::erase_if(run.points, [](const ProbePoint& point) { return point.body == ProbePoint::kOutside; });
  return run;
}

DepthNumbers::Profile profileNumbers(const DepthCurve& stress, double depth) {
  const auto lowest = std::ranges::min_element(stress.values);
  auto k = static_cast<std::size_t>(lowest - stress.values.begin());
  DepthNumbers::Profile numbers{stress.values.front(), *lowest, stress.depths[k],
                                *lowest < 0.0 ? depth : 0.0};
  for (; *lowest < 0.0 && k + 1 < stress.values.size(); ++k)
    if (stress.values[k + 1] >= 0.0) {
      numbers.compressedDepth = crossing(stress, k, 0.0);
      break;
    }
  return numbers;
}

/// profile: with the fields `surfaceFieldNames`.
void addStresses(const ProbedRun& profile, bool isPlaneStrain, DepthNumbers& numbers) {
  DepthCurve along, across;
  double others = 0.0;
  for (const ProbePoint& point : profile.points) {
    along.depths.push_back(point.at);
    along.values.push_back(point.values(0));
    across.values.push_back(point.values(1));
    others = std::max(others, point.values.tail<3>().cwiseAbs().maxCoeff());
  }
  across.depths = along.depths;
  const double largest = largestMagnitude(along.values);
  if (largest > 0.0) numbers.unsteadiness = others / largest;
  numbers.along = profileNumbers(along, numbers.depth);
  numbers.across = profileNumbers(across, numbers.depth);
  if (!isPlaneStrain) return;
  DepthCurve levers = along;
  for (std::size_t k = 0; k < levers.values.size(); ++k)
    levers.values[k] *= 0.5 * numbers.depth - levers.depths[k];
  numbers.force = integral(along);
  numbers.moment = integral(levers);
  if (largest > 0.0) numbers.balance = std::abs(numbers.force) / (numbers.depth * largest);
}

double hardenedDepth(const DepthCurve& strain, double limit) {
  std::size_t k = strain.values.size();
  while (k > 0 && !(strain.values[k - 1] >= limit)) --k;
  if (k == 0) return 0.0;
  return k == strain.values.size() ? strain.depths.back() : crossing(strain, k - 1, limit);
}

std::string unitText(DepthUnit unit, const DerivedUnits& units, const std::string& stressUnit) {
  if (unit == DepthUnit::Length) return units.length;
  if (unit == DepthUnit::Stress) return stressUnit;
  if (unit == DepthUnit::Force) return units.force;
  return unit == DepthUnit::Moment ? units.energy : "";
}

}  // namespace

std::vector<std::string> depthNumberNames() {
  return namesOfColumns(kDepthNumbers);
}

bool hasDepthNumbers(const ProbeSpec& spec) {
  return !spec.depth.empty() && !spec.reference && !spec.isOverTime();
}

DepthNumbers depthNumbers(const ModelRecord& model, const FrameRecord& frame, const ProbeSpec& spec) {
  if (spec.depth.empty()) throw Error("--numbers: found no depth; expected --depth FACE@PLACE beside it");
  if (spec.reference)
    throw Error("reference: the numbers of a depth profile are those of the deformed body; expected none");
  const bool hasStress = hasField(frame, "stress"), isPlastic = hasField(frame, "plastic_strain");
  DepthNumbers numbers;
  numbers.depth = profileOf(model, frame, spec, {"displacement"}).points.back().at;
  if (hasStress) {
    addStresses(profileOf(model, frame, spec, surfaceFieldNames()), model.dim == 2 && !isAxisymmetric(model),
                numbers);
  }
  if (isPlastic) {
    DepthCurve strain;
    for (const ProbePoint& point : profileOf(model, frame, spec, {"plastic_strain"}).points) {
      strain.depths.push_back(point.at);
      strain.values.push_back(point.values(0));
    }
    numbers.hardenedDepth = hardenedDepth(strain, spec.hardenedBelow);
  }
  return numbers;
}

std::vector<DepthNumbersAt> depthNumbersOf(const ResultReader& result, const ProbeSpec& spec,
                                           const std::vector<double>& times) {
  std::vector<DepthNumbersAt> rows;
  for (const int index : framesAt(result, times)) {
    const FrameRecord frame = result.frame(index);
    rows.push_back({"", frame.time, depthNumbers(result.model(), frame, spec)});
  }
  return rows;
}

std::string tableOf(const std::vector<DepthNumbersAt>& rows, const DerivedUnits& units,
                    const std::string& stressUnit) {
  return numbersCsv(kDepthNumbers, rows, [&](DepthUnit unit) { return unitText(unit, units, stressUnit); });
}

}  // namespace burnish
