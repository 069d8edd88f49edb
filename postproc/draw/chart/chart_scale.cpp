#include "postproc/draw/chart/chart_scale.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <initializer_list>

#include "engine/core/drawable_range.h"
#include "postproc/text/ticks.h"

namespace burnish {
namespace {

using Range = std::array<double, 2>;
using Fit = std::function<bool(const ChartScale&)>;

constexpr int kMostIntervals = 6;
constexpr double kPadding = 0.03;  ///< part of the data's range
constexpr double kSlack = 1e-9;    ///< round-off, in parts of a step
constexpr double kHardly = 0.05;   ///< beyond zero, in parts of a step
constexpr double kExcess = 1e-4;   ///< beyond a tick, in parts of a step: less than can be seen
constexpr double kNarrow =
    1e-5;  ///< below this part of its magnitude, labels of a range count from a number near it

/// Below this part of its magnitude, a variation is not shown: sums of many numbers round to 1e-12, and solvers
/// leave a little more.
constexpr double kConstant = 1e-10, kConstantRatio = 1e-8;

/// The smallest of `factors` times a power of ten that is not below the value.
double roundUp(double value, std::initializer_list<double> factors) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : factors)
    if (factor * power >= value * (1.0 - kSlack)) return factor * power;
  return 10.0 * power;
}

double roundDown(double value, std::initializer_list<double> factors) {
  return 1.0 / roundUp(1.0 / value, factors);
}

/// log(a / b), also where the ratio is beyond what numbers can hold.
double logRatio(double a, double b) {
  const double ratio = a / b;
  return std::isnormal(ratio) ? std::log(ratio) : std::log(a) - std::log(b);
}

/// A range of some width around data that may be constant.
Range withWidth(const Range& data, bool padded) {
  const double magnitude = std::max(std::abs(data[0]), std::abs(data[1]));
  if (magnitude < kSmallestDrawnSpan) return {-1.0, 1.0};
  if (data[1] - data[0] <= kConstant * magnitude)
    return {data[0] - 0.1 * magnitude, data[1] + 0.1 * magnitude};
  if (!padded) return data;
  const double padding = kPadding * (data[1] - data[0]);
  // Data that do not change sign keep 0 as the end of the axis.
  const double low = data[0] >= 0.0 ? std::max(0.0, data[0] - padding) : data[0] - padding;
  const double high = data[1] <= 0.0 ? std::min(0.0, data[1] + padding) : data[1] + padding;
  return {low, high};
}

/// Removes ticks, from the middle on, until the others fit.
void thinOut(ChartScale& scale, const Fit& fit) {
  while (scale.ticks.size() > 1 && !fit(scale)) {
    const auto middle = static_cast<std::ptrdiff_t>(scale.ticks.size() / 2);
    scale.ticks.erase(scale.ticks.begin() + middle);
    scale.labels.erase(scale.labels.begin() + middle);
  }
}

/// Takes a power of ten out of labels that would be long with zeros; returns it.
double takeFactor(ChartScale& scale) {
  constexpr double smallest = 0.01, largest = 1e4, slack = 1e-6;
  const double magnitude = std::max(std::abs(scale.range[0]), std::abs(scale.range[1]));
  const bool plain = magnitude >= smallest && magnitude < largest;
  const int exponent = plain ? 0 : 3 * static_cast<int>(std::floor(std::log10(magnitude) / 3.0 + slack));
  scale.factor = plain ? "" : "×10" + superscript(exponent);
  return std::pow(10.0, exponent);
}

void setTicks(ChartScale& scale, int most) {
  const double unit = takeFactor(scale);
  const Ticks ticks = makeTicks({scale.range[0] / unit, scale.range[1] / unit}, most);
  scale.ticks.clear();
  for (const double value : ticks.values) scale.ticks.push_back(value * unit);
  scale.labels = ticks.labels;
}

/// A round number near all of a range.
struct Offset {
  double value = 0.0;
  std::string text{};  ///< what is to be added to labels, as in "+ 1.6×10⁹"
};

/// Of a range that is narrow beside its magnitude; else 0.
Offset offsetOf(const Range& range) {
  constexpr double kLargest = 1e200;  // of which powers are numbers
  const double magnitude = std::max(std::abs(range[0]), std::abs(range[1])), width = range[1] - range[0];
  if (!(width > 0.0 && width < kNarrow * magnitude) || magnitude > kLargest || magnitude < 1.0 / kLargest)
    return {};
  const int exponent = 1 + static_cast<int>(std::ceil(std::log10(width) - kSlack));
  const double power = std::pow(10.0, std::abs(exponent));
  const auto rounded = [&](double number) { return exponent < 0 ? number / power : number * power; };
  const double number = std::floor((exponent < 0 ? range[1] * power : range[1] / power) + kSlack);
  int digits = decimalExponent(number) + 1;
  for (double rest = number; std::fmod(rest, 10.0) == 0.0; rest /= 10.0) --digits;
  const double value = rounded(number);
  return {value, (value < 0.0 ? "− " : "+ ") + numberText(std::abs(value), std::max(1, digits))};
}

/// wanted: what the scale reaches around, unless the axis has a range.
ChartScale plainScale(const ChartAxis& axis, const Range& data, const Range& wanted, const Fit& fit) {
  ChartScale scale;
  for (int intervals = kMostIntervals; intervals > 0; --intervals) {
    int most = intervals + 1;
    if (axis.range) {
      scale.range = *axis.range;
    } else {
      const double width = (1.0 - 0.1 * kExcess) * (wanted[1] - wanted[0]);
      const double step = roundUp(width / intervals, {1.0, 2.0, 2.5, 5.0});
      const double first = std::floor(wanted[0] / step + kExcess),
                   last = std::ceil(wanted[1] / step - kExcess);
      scale.range = {std::min(first * step, wanted[0]), std::max(last * step, wanted[1])};
      // Data that hardly cross zero, as interpolated strains do, get no interval of their own there.
      if (first == -1.0 && data[0] >= -kHardly * step) scale.range[0] = -kHardly * step;
      if (last == 1.0 && data[1] <= kHardly * step) scale.range[1] = kHardly * step;
      most = static_cast<int>(last - first) + 1;
    }
    setTicks(scale, std::max(2, most));
    if (fit(scale)) return scale;
  }
  thinOut(scale, fit);
  return scale;
}

ChartScale linearScale(const ChartAxis& axis, const Range& data, bool padded, const Fit& fit) {
  const Range wanted = withWidth(data, padded);
  const Offset offset = offsetOf(axis.range.value_or(wanted));
  if (offset.value == 0.0) return plainScale(axis, data, wanted, fit);
  const auto shifted = [&](const Range& range) {
    return Range{range[0] - offset.value, range[1] - offset.value};
  };
  ChartAxis beside = axis;
  if (axis.range) beside.range = shifted(*axis.range);
  ChartScale scale = plainScale(beside, shifted(data), shifted(wanted), fit);
  for (double& end : scale.range) end += offset.value;
  for (double& tick : scale.ticks) tick += offset.value;
  scale.factor += (scale.factor.empty() ? "" : " ") + offset.text;
  return scale;
}

/// Labels at powers of ten, all or every second, third, …
void labelDecades(ChartScale& scale, int first, int last, const Fit& fit) {
  for (int every = 1; every == 1 || scale.ticks.size() > 1; ++every) {
    scale.ticks.clear();
    scale.labels.clear();
    scale.factor.clear();
    for (int e = first; e <= last; ++e) {
      if (e % every != 0) continue;
      scale.ticks.push_back(std::pow(10.0, e));
      scale.labels.push_back("10" + superscript(e));
    }
    if (fit(scale)) return;
  }
}

/// Labels at 1, 2 and 5 times powers of ten.
void labelRoundValues(ChartScale& scale, int firstDecade, int lastDecade) {
  constexpr int digits = 1;
  const double unit = takeFactor(scale);
  for (int e = firstDecade - 1; e <= lastDecade; ++e) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * std::pow(10.0, e);
      if (scale.share(value) < -kSlack || scale.share(value) > 1.0 + kSlack) continue;
      scale.ticks.push_back(value);
      scale.labels.push_back(numberText(value / unit, digits));
    }
  }
}

void setMinorTicks(ChartScale& scale, int firstDecade, int lastDecade) {
  constexpr int mostDecades = 10;
  for (int e = firstDecade - 1; e <= lastDecade; ++e) {
    const int last = lastDecade - firstDecade > mostDecades ? 1 : 9;
    for (int k = 1; k <= last; ++k) {
      const double value = k * std::pow(10.0, e);
      if (scale.share(value) > kSlack && scale.share(value) < 1.0 - kSlack) scale.minorTicks.push_back(value);
    }
  }
}

ChartScale logarithmicScale(const ChartAxis& axis, const Range& data, bool padded, const Fit& fit) {
  ChartScale scale;
  scale.logarithmic = true;
  if (axis.range) {
    scale.range = *axis.range;
  } else {
    const double margin = data[1] / data[0] < 1.0 + kConstantRatio ? 2.0
                          : padded ? std::exp(kPadding * logRatio(data[1], data[0]))
                                   : 1.0;
    scale.range = {roundDown(data[0] / margin, {1.0, 2.0, 5.0}), roundUp(data[1] * margin, {1.0, 2.0, 5.0})};
  }
  const int first = static_cast<int>(std::ceil(std::log10(scale.range[0]) - kSlack));
  const int last = static_cast<int>(std::floor(std::log10(scale.range[1]) + kSlack));
  const bool narrow = scale.range[1] < 100.0 * scale.range[0];
  if (narrow) labelRoundValues(scale, first, last);
  if (narrow && scale.ticks.size() < 3) setTicks(scale, kMostIntervals);
  if (!narrow || (!fit(scale) && last > first)) labelDecades(scale, first, last, fit);
  thinOut(scale, fit);
  setMinorTicks(scale, first, last);
  return scale;
}

}  // namespace

double ChartScale::share(double value) const {
  if (logarithmic) return logRatio(value, range[0]) / logRatio(range[1], range[0]);
  return (value - range[0]) / (range[1] - range[0]);
}

ChartScale makeChartScale(const ChartAxis& axis, const std::array<double, 2>& data, bool padded,
                          const std::function<bool(const ChartScale&)>& fit) {
  return axis.logarithmic ? logarithmicScale(axis, data, padded, fit) : linearScale(axis, data, padded, fit);
}

}  // namespace burnish
