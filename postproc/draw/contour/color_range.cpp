#include "postproc/draw/contour/color_range.h"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "engine/core/drawable_range.h"
#include "engine/core/error.h"
#include "postproc/draw/contour/exact_range.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/mesh/chosen_bodies.h"
#include "postproc/mesh/tessellation.h"

namespace burnish {
namespace {

/// Area or volume of a cell: exact for a plane quadrilateral; of a hexahedron its Jacobian in the middle.
template <int Dim>
double cellSize(const Eigen::MatrixXd& points, const Eigen::VectorXi& corners) {
  Eigen::Matrix<double, Dim, Dim> jacobian = Eigen::Matrix<double, Dim, Dim>::Zero();
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    // VTK goes round the quadrilateral, then round the one above it.
    const std::array<int, 3> upper{(corner ^ (corner >> 1)) & 1, (corner >> 1) & 1, corner >> 2};
    for (int d = 0; d < Dim; ++d)
      jacobian.col(d) += (upper[static_cast<std::size_t>(d)] ? 1.0 : -1.0) * points.col(corners(corner));
  }
  return std::abs((jacobian / (1 << (Dim - 1))).determinant());
}

/// The part of the undeformed body that belongs to each point: equal shares of its cells.
Eigen::VectorXd pointSizes(const Tessellation& tessellation) {
  Eigen::VectorXd sizes = Eigen::VectorXd::Zero(tessellation.numPoints());
  const auto sizeOf = tessellation.dim() == 2 ? cellSize<2> : cellSize<3>;
  for (const auto& corners : tessellation.cells().colwise()) {
    const double share =
        sizeOf(tessellation.referencePoints(), corners) / static_cast<double>(corners.size());
    for (const int point : corners) sizes(point) += share;
  }
  return sizes;
}

/// The smallest value that is not exceeded in at least this part of the whole.
double quantile(const Eigen::VectorXd& values, const Eigen::VectorXd& sizes, const std::vector<int>& byValue,
                double part) {
  const double wanted = part * sizes.sum() * (1.0 - 1e-12);
  double size = 0.0;
  for (const int point : byValue) {
    size += sizes(point);
    if (size >= wanted) return values(point);
  }
  return values(byValue.back());
}

/// Smallest and largest value of a contact field; nothing if one is not finite. States have the same colours
/// everywhere.
std::optional<std::array<double, 2>> contactExtremes(const FieldChoice& field) {
  if (!field.states.empty()) return std::array{-0.5, static_cast<double>(field.states.size()) - 0.5};
  std::array<double, 2> range{};
  field.faces->GetPointData()->GetScalars()->GetRange(range.data());
  if (!std::isfinite(range[0]) || !std::isfinite(range[1])) return std::nullopt;
  return range;
}

/// 1st, 2nd, 99th, 2.5th.
std::string ordinal(double number) {
  const std::string digits = fmt::format("{:.6g}", number);
  const double rest = std::fmod(number, 10.0);
  const bool teen = number > 10.0 && number < 20.0;
  if (rest == 1.0 && !teen) return digits + "st";
  if (rest == 2.0 && !teen) return digits + "nd";
  if (rest == 3.0 && !teen) return digits + "rd";
  return digits + "th";
}

}  // namespace

void checkPercentile(double clip) {
  if (!(clip > kLowestPercentile && clip <= 100.0))
    throw Error(
        fmt::format("clip: found {}; expected a percentile above {}, at which the colours end, up to 100",
                    clip, kLowestPercentile));
}

std::array<double, 2> percentiles(const Eigen::VectorXd& values, const Eigen::VectorXd& sizes, double p) {
  std::vector<int> byValue(static_cast<std::size_t>(values.size()));
  std::iota(byValue.begin(), byValue.end(), 0);
  std::stable_sort(byValue.begin(), byValue.end(), [&](int a, int b) { return values(a) < values(b); });
  return {quantile(values, sizes, byValue, 1.0 - p / 100.0), quantile(values, sizes, byValue, p / 100.0)};
}

std::array<double, 2> fieldRange(const ModelRecord& model, const FrameRecord& frame, const std::string& field,
                                 int subdivision, std::optional<double> clip) {
  return fieldRanges(model, frame, chooseField(model, frame, field), subdivision, clip).shown;
}

FieldRange fieldRanges(const ModelRecord& model, const FrameRecord& frame, const FieldChoice& field,
                       int subdivision, std::optional<double> clip) {
  if (clip) checkPercentile(*clip);
  const FieldMesh meshes(model, frame, field.name);
  const MeshRecord& mesh = meshes.with();
  const auto ofBodies = [&]() -> std::optional<std::array<double, 2>> {
    const auto range = exactRange(mesh, field);
    return range ? std::optional(range->values) : std::nullopt;
  };
  const std::optional<std::array<double, 2>> whole = field.faces ? contactExtremes(field) : ofBodies();
  if (!whole)
    throw Error(fmt::format("field {} of frame {} holds values that are not finite; it cannot be drawn",
                            field.name, frame.index));
  if (!clip || *clip == 100.0) return {*whole, *whole, field.unit};
  const Tessellation cells(mesh, subdivision);
  const auto clipped =
      percentiles(field.drawnScalars(cells.evaluate(field.coefficients)), pointSizes(cells), *clip);
  return {*whole, clipped[0] < clipped[1] ? clipped : *whole, field.unit};
}

std::array<double, 2> widened(const std::array<double, 2>& range) {
  const double magnitude = std::max(std::abs(range[0]), std::abs(range[1]));
  if (magnitude < kSmallestDrawnSpan) return {0.0, 1.0};
  if (range[1] - range[0] > std::max(1e-9 * magnitude, kSmallestDrawnSpan)) return range;
  return {range[0] - 0.1 * magnitude, range[1] + 0.1 * magnitude};
}

bool isOneValue(const std::array<double, 2>& range) {
  return widened(range) != range;
}

std::array<bool, 2> endsPassed(const std::array<double, 2>& range, const std::array<double, 2>& values) {
  constexpr double kSlack = 1e-9;  // of the range
  const double slack = kSlack * (range[1] - range[0]);
  return {values[0]<range[0] - slack, values[1]> range[1] + slack};
}

std::string clipNote(double clip, std::optional<int> dim) {
  return fmt::format("colours end at the {} and {} percentiles{}", ordinal(100.0 - clip), ordinal(clip),
                     !dim        ? ""
                     : *dim == 2 ? " of the area"
                                 : " of the volume");
}

}  // namespace burnish
