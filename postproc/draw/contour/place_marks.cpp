#include "postproc/draw/contour/place_marks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/exact_range.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/mesh/chosen_bodies.h"
#include "postproc/mesh/poly_builder.h"
#include "postproc/text/ticks.h"

namespace burnish {
namespace {

Eigen::Vector3d pointInSpace(const Eigen::VectorXd& point) {
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  result.head(point.size()) = point;
  return result;
}

/// Contact faces stand where they are.
std::optional<ExtremePlaces> placesOnFaces(vtkPolyData& faces) {
  const auto tuples = extremeTuples(*faces.GetPointData()->GetScalars());
  if (!tuples) return std::nullopt;
  ExtremePlaces places;
  for (std::size_t end = 0; end < 2; ++end)
    places.positions[end] = Eigen::Map<const Eigen::Vector3d>(faces.GetPoint((*tuples)[end]));
  places.drawn = places.positions;
  return places;
}

/// A number without digits that say nothing beside a step, which is a power of ten.
std::string rounded(double value, double step) {
  return numberText(std::round(value / step) * step, 8);
}

}  // namespace

std::optional<ExtremePlaces> extremePlaces(const ModelRecord& model, const FrameRecord& frame,
                                           const FieldChoice& field,
                                           const Eigen::MatrixXd& drawnDisplacement) {
  if (!field.states.empty()) return std::nullopt;
  if (field.faces) return placesOnFaces(*field.faces);
  const FieldMesh meshes(model, frame, field.name);
  const auto range = exactRange(meshes.with(), field);
  if (!range || isOneValue(range->values)) return std::nullopt;
  ExtremePlaces places;
  for (std::size_t end = 0; end < 2; ++end) {
    const FieldPlace& place = range->places[end];
    places.positions[end] = pointInSpace(positionOf(place, meshes.with(), frame.displacement));
    places.drawn[end] = pointInSpace(positionOf(place, meshes.with(), drawnDisplacement));
  }
  return places;
}

void moveToSeen(ExtremePlaces& places, const std::vector<MirrorPlane>& planes,
                const std::function<bool(const Eigen::Vector3d& drawn)>& isSeen) {
  for (std::size_t end = 0; end < 2; ++end)
    for (std::size_t image = 0; image < std::size_t{1} << planes.size(); ++image) {
      Eigen::Vector3d position = places.positions[end], drawn = places.drawn[end];
      for (std::size_t k = 0; k < planes.size(); ++k)
        if ((image >> k & 1U) != 0)
          for (Eigen::Vector3d* place : {&position, &drawn})
            (*place)(planes[k].axis) = 2.0 * planes[k].at - (*place)(planes[k].axis);
      if (!isSeen(drawn)) continue;
      places.positions[end] = position;
      places.drawn[end] = drawn;
      break;
    }
}

std::optional<std::array<int, 2>> extremeTuples(vtkDataArray& scalars) {
  std::array<int, 2> tuples{-1, -1};
  const auto value = [&](int tuple) { return scalars.GetComponent(tuple, 0); };
  for (int k = 0; k < scalars.GetNumberOfTuples(); ++k) {
    if (!std::isfinite(value(k))) continue;
    if (tuples[0] < 0 || value(k) < value(tuples[0])) tuples[0] = k;
    if (tuples[1] < 0 || value(k) > value(tuples[1])) tuples[1] = k;
  }
  if (tuples[0] == tuples[1]) return std::nullopt;
  return tuples;
}

ExtremeMarks extremeMarks(const ExtremePlaces& places,
                          const std::function<bool(const Eigen::Vector3d& drawn)>& isSeen, const View& view,
                          double side) {
  PolyBuilder areas, edges;
  for (const std::size_t end : {0U, 1U}) {
    const Eigen::Vector3d& place = places.drawn[end];
    if (!isSeen(place)) continue;
    const double length = side / view.pixelsPerLengthAt(place), height = std::sqrt(0.75) * length;
    const Eigen::Vector3d right = 0.5 * length * view.axes.row(0).transpose();
    const Eigen::Vector3d up = (end == 0 ? -height : height) / 3.0 * view.axes.row(1).transpose();
    Eigen::Matrix3Xd corners(3, 3);
    corners << place + 2.0 * up, place - right - up, place + right - up;
    areas.addPolygon(areas.addPoints(corners));
    Eigen::Matrix3Xd ring(3, 5);  // closed within a side, so that all corners are joined
    ring << corners.rightCols(2).rowwise().mean(), corners.col(2), corners.leftCols(2),
        corners.rightCols(2).rowwise().mean();
    edges.addLine(edges.addPoints(ring));
  }
  return {areas.finish(), edges.finish()};
}

vtkSmartPointer<vtkPolyData> ringMark(const Eigen::Vector3d& place, const View& view, double diameter) {
  constexpr int kCorners = 48;
  const double radius = 0.5 * diameter / view.pixelsPerLengthAt(place);
  Eigen::Matrix3Xd corners(3, kCorners + 1);
  for (int k = 0; k <= kCorners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kCorners;
    corners.col(k) =
        place + radius * (view.axes.transpose() * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  PolyBuilder ring;
  ring.addLine(ring.addPoints(corners));
  return ring.finish();
}

std::string extremeNote(const ExtremePlaces& places,
                        const std::function<bool(const Eigen::Vector3d& drawn)>& isSeen, int dim,
                        double length) {
  constexpr double kResolution = 1e-3;
  const double step = std::pow(10.0, std::floor(std::log10(kResolution * length)));
  const auto text = [&](std::size_t end, const char* sign, const char* name) {
    std::vector<std::string> numbers;
    for (int d = 0; d < dim; ++d) numbers.push_back(rounded(places.positions[end](d), step));
    return fmt::format("{}{} at ({})", isSeen(places.drawn[end]) ? sign : "", name, fmt::join(numbers, ", "));
  };
  return text(1, kLargestSign, "max") + ", " + text(0, kSmallestSign, "min");
}

}  // namespace burnish
