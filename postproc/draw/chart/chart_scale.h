#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "postproc/draw/chart/chart.h"

namespace burnish {

/// The range of an axis and the marks on it.
struct ChartScale {
  std::array<double, 2> range{0.0, 1.0};
  bool logarithmic = false;
  std::vector<double> ticks;        ///< increasing, within the range
  std::vector<std::string> labels;  ///< one per tick, all different
  std::vector<double> minorTicks;   ///< without labels
  std::string
      factor;  ///< what all labels are to be multiplied with, or what is added to them, as in "×10³" and
               ///< "×10⁻⁹ + 1"; mostly empty

  /// Where a value lies: 0 at the lower end of the range, 1 at the upper one.
  double share(double value) const;
};

/// The scale with the most ticks that `fit`. data: smallest and largest value, positive for a logarithmic
/// axis; unless the axis has a range, the scale reaches to round values around them. padded: leaves some room
/// between the data and the ends.
ChartScale makeChartScale(const ChartAxis& axis, const std::array<double, 2>& data, bool padded,
                          const std::function<bool(const ChartScale&)>& fit);

}  // namespace burnish
