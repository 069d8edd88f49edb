#pragma once
#include <Eigen/Dense>
#include <array>
#include <optional>
#include <string>

#include "engine/results/result.h"

namespace burnish {

struct FieldChoice;

inline constexpr double kLowestPercentile = 50.0;  ///< exclusive, of a `clip`

/// Smallest and largest value that the field has anywhere, which a picture shows; with `clip` (a percentile p in (50, 100])
/// the (100-p)th and the p-th percentile, each part of the body weighted by its undeformed area (2D) or
/// volume (3D). Where those two are the same, as in a field that is constant but for a spot, the smallest and
/// the largest value again. subdivision: cells per knot span and direction, of which percentiles are made. Throws `Error` for an unknown
/// field, a field that is not finite and a percentile out of range.
std::array<double, 2> fieldRange(const ModelRecord& model, const FrameRecord& frame, const std::string& field,
                                 int subdivision, std::optional<double> clip = {});

/// Both, and what they are without `clip`. field: of this model and frame.
struct FieldRange {
  std::array<double, 2> whole, shown;
  std::string unit{};  ///< may be empty
};
FieldRange fieldRanges(const ModelRecord& model, const FrameRecord& frame, const FieldChoice& field,
                       int subdivision, std::optional<double> clip);

/// Throws `Error` for a percentile out of range.
void checkPercentile(double clip);

/// The (100-p)th and the p-th percentile of values, each of which stands for a part of the whole.
std::array<double, 2> percentiles(const Eigen::VectorXd& values, const Eigen::VectorXd& sizes, double p);

/// A range that a colour scale can have: a field that is constant gets a scale around it.
std::array<double, 2> widened(const std::array<double, 2>& range);

/// Whether a field that goes through this range has one value, but for rounding.
bool isOneValue(const std::array<double, 2>& range);

/// Whether values that go from the first to the second number of `values` pass the lower and the upper end of a range, not by rounding alone.
std::array<bool, 2> endsPassed(const std::array<double, 2>& range, const std::array<double, 2>& values);

/// What a picture says of clipped colours: "colours end at the 1st and 99th percentiles of the area". dim: where it is known.
std::string clipNote(double clip, std::optional<int> dim);

}  // namespace burnish
