#include "postproc/draw/contour/shape_lines.h"

#include <vtkCellArray.h>
#include <vtkCleanPolyData.h>
#include <vtkContourFilter.h>
#include <vtkDoubleArray.h>
#include <vtkFeatureEdges.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>
#include <vtkStripper.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <vector>

#include "postproc/mesh/poly_builder.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

/// Of a polygon whose corners are in columns; by the crossings of its edges with a line from the place to the right.
bool covers(const Eigen::Matrix2Xd& polygon, const Eigen::Vector2d& place) {
  bool inside = false;
  for (Eigen::Index k = 0, before = polygon.cols() - 1; k < polygon.cols(); before = k++) {
    const Eigen::Vector2d a = polygon.col(before) - place, b = polygon.col(k) - place;
    if ((a.y() > 0.0) != (b.y() > 0.0) && a.x() + (b.x() - a.x()) * a.y() / (a.y() - b.y()) > 0.0)
      inside = !inside;
  }
  return inside;
}

/// Of surfaces, in pixels.
std::vector<Eigen::Matrix2Xd> polygonsOf(const std::vector<vtkSmartPointer<vtkPolyData>>& surfaces,
                                         const View& view) {
  std::vector<Eigen::Matrix2Xd> polygons;
  vtkNew<vtkIdList> ids;
  for (const auto& surface : surfaces)
    for (vtkIdType cell = 0; cell < surface->GetPolys()->GetNumberOfCells(); ++cell) {
      surface->GetPolys()->GetCellAtId(cell, ids);
      Eigen::Matrix2Xd& corners = polygons.emplace_back(2, ids->GetNumberOfIds());
      for (Eigen::Index k = 0; k < corners.cols(); ++k)
        corners.col(k) = view.pixel(Eigen::Vector3d(surface->GetPoint(ids->GetId(k))));
    }
  return polygons;
}

}  // namespace

LinePart partWithin(const PixelRect& area, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d low(area.x, area.y), high(area.right(), area.top()), way = to - from;
  LinePart part;
  for (const Eigen::Index d : {0, 1}) {
    if (way(d) == 0.0) {
      if (from(d) < low(d) || from(d) > high(d)) return {1.0, 0.0};
      continue;
    }
    const auto [enters, leaves] = std::minmax({(low(d) - from(d)) / way(d), (high(d) - from(d)) / way(d)});
    part = {std::max(part.begin, enters), std::min(part.end, leaves)};
  }
  return part;
}

vtkSmartPointer<vtkPolyData> withoutSeams(vtkPolyData& surface) {
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputData(&surface);
  clean->SetTolerance(1e-6);
  clean->ConvertPolysToLinesOff();
  clean->ConvertLinesToPointsOff();
  clean->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  clean->Update();
  return clean->GetOutput();
}

vtkSmartPointer<vtkPolyData> withNormals(vtkPolyData& surface) {
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(&surface);
  normals->ConsistencyOff();
  normals->Update();
  return normals->GetOutput();
}

vtkSmartPointer<vtkPolyData> silhouetteOf(vtkPolyData& surface, const View& view) {
  if (surface.GetNumberOfPoints() == 0) return vtkSmartPointer<vtkPolyData>::New();
  vtkDataArray& normals = *surface.GetPointData()->GetNormals();
  Eigen::RowVectorXd facing(normals.GetNumberOfTuples());
  for (Eigen::Index k = 0; k < facing.size(); ++k)
    facing(k) = Eigen::Map<const Eigen::Vector3d>(normals.GetTuple3(k))
                    .dot(view.towardsEye(Eigen::Map<const Eigen::Vector3d>(surface.GetPoint(k))));
  vtkNew<vtkPolyData> shape;
  shape->CopyStructure(&surface);
  shape->GetPointData()->SetScalars(makeArray("facing", facing, {}));
  vtkNew<vtkContourFilter> turn;
  turn->SetInputData(shape);
  turn->SetValue(0, 0.0);
  turn->Update();
  return turn->GetOutput();
}

vtkSmartPointer<vtkPolyData> withWayAlong(vtkPolyData& lines, const View& view) {
  vtkNew<vtkStripper> joined;
  joined->SetInputData(&lines);
  joined->JoinContiguousSegmentsOn();
  joined->Update();
  vtkPolyData& shapes = *joined->GetOutput();
  PolyBuilder builder;
  std::vector<double> ways;
  vtkNew<vtkIdList> ids;
  vtkCellArray& cells = *shapes.GetLines();
  for (vtkIdType cell = 0; cell < cells.GetNumberOfCells(); ++cell) {
    cells.GetCellAtId(cell, ids);
    Eigen::Matrix3Xd points(3, ids->GetNumberOfIds());
    for (Eigen::Index k = 0; k < points.cols(); ++k) {
      shapes.GetPoint(ids->GetId(k), points.col(k).data());
      const double way = k == 0 ? 0.0 : (view.pixel(points.col(k)) - view.pixel(points.col(k - 1))).norm();
      ways.push_back(k == 0 ? 0.0 : ways.back() + way);
    }
    builder.addLine(builder.addPoints(points));
  }
  const auto result = builder.finish();
  result->GetPointData()->AddArray(
      makeArray(kWayAlong, Eigen::Map<const Eigen::RowVectorXd>(ways.data(), std::ssize(ways)), {}));
  return result;
}

void setMoved(vtkPolyData& before, vtkPolyData& after) {
  const vtkIdType count = before.GetNumberOfPoints();
  if (after.GetNumberOfPoints() != count) throw std::logic_error("lines before and after a motion differ");
  Eigen::Matrix3Xd moved(3, count);
  for (vtkIdType k = 0; k < count; ++k)
    moved.col(k) = Eigen::Vector3d(after.GetPoint(k)) - Eigen::Vector3d(before.GetPoint(k));
  before.GetPointData()->AddArray(makeArray(kMoved, moved, {}));
}

bool hasMotion(vtkPolyData& lines) {
  return lines.GetPointData()->GetArray(kMoved) != nullptr;
}

vtkSmartPointer<vtkPolyData> movedLines(vtkPolyData& lines, const View& view, double pixels) {
  constexpr double kClear = 3.0;  // so far an edge has gone somewhere that is drawn
  if (!hasMotion(lines)) return &lines;
  vtkNew<vtkStripper> edges;  // cuts leave segments
  edges->SetInputData(&lines);
  edges->JoinContiguousSegmentsOn();
  edges->Update();
  vtkPolyData& whole = *edges->GetOutput();
  vtkDataArray& moved = *whole.GetPointData()->GetArray(kMoved);
  const auto wayOf = [&](vtkIdType point) {
    const Eigen::Vector3d by(moved.GetTuple3(point));
    return view.pixelsPerLengthAt(Eigen::Vector3d(whole.GetPoint(point))) * (view.axes * by).norm();
  };
  vtkNew<vtkCellArray> drawn;
  vtkNew<vtkIdList> ids;
  vtkCellArray& all = *whole.GetLines();
  for (vtkIdType cell = 0; cell < all.GetNumberOfCells(); ++cell) {
    all.GetCellAtId(cell, ids);
    const std::span points(ids->begin(), ids->end());
    if (std::ranges::none_of(points, [&](vtkIdType k) { return wayOf(k) >= kClear * pixels; })) continue;
    // In one piece, whatever lies between.
    const auto isApart = [&](vtkIdType k) { return wayOf(k) >= pixels; };
    auto first = std::ranges::find_if(points, isApart);
    auto last = std::ranges::find_if(points.rbegin(), points.rend(), isApart).base();
    if (first != points.begin()) --first;
    if (last != points.end()) ++last;
    drawn->InsertNextCell(last - first, &*first);
  }
  const auto kept = vtkSmartPointer<vtkPolyData>::New();
  kept->SetPoints(whole.GetPoints());
  kept->SetLines(drawn);
  return kept;
}

vtkSmartPointer<vtkPolyData> besideSurfaces(vtkPolyData& lines,
                                            const std::vector<vtkSmartPointer<vtkPolyData>>& surfaces,
                                            const View& view) {
  const std::vector<Eigen::Matrix2Xd> polygons = polygonsOf(surfaces, view);
  PolyBuilder builder;
  std::vector<vtkIdType> piece;
  const auto endPiece = [&] {
    if (piece.size() > 1) builder.addLine(piece);
    piece.clear();
  };
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < lines.GetLines()->GetNumberOfCells(); ++cell) {
    lines.GetLines()->GetCellAtId(cell, ids);
    for (vtkIdType k = 0; k + 1 < ids->GetNumberOfIds(); ++k) {
      const Eigen::Vector3d from(lines.GetPoint(ids->GetId(k))), to(lines.GetPoint(ids->GetId(k + 1)));
      const Eigen::Vector2d a = view.pixel(from), b = view.pixel(to);
      const LinePart seen = partWithin(view.area, a, b);
      if (seen.begin > 0.0 || seen.end <= 0.0) endPiece();
      if (seen.begin >= seen.end) continue;
      const double steps = std::max(1.0, std::ceil((seen.end - seen.begin) * (b - a).norm()));
      const double sizeFrom = view.pixelsPerLengthAt(from), sizeTo = view.pixelsPerLengthAt(to);
      const auto at = [&](double step) -> Eigen::Vector3d {
        const double part = seen.begin + step / steps * (seen.end - seen.begin);
        return from + part * sizeTo / ((1.0 - part) * sizeFrom + part * sizeTo) * (to - from);
      };
      for (double step = 0.0; step < steps; ++step) {
        const Eigen::Vector2d middle = view.pixel(at(step + 0.5));
        if (std::ranges::any_of(polygons, [&](const auto& polygon) { return covers(polygon, middle); })) {
          endPiece();
          continue;
        }
        if (piece.empty()) piece = builder.addPoints(at(step));
        piece.push_back(builder.addPoints(at(step + 1.0)).front());
      }
    }
    endPiece();
  }
  return builder.finish();
}

vtkSmartPointer<vtkPolyData> edgesOf(vtkPolyData& surface) {
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(&surface);
  edges->NonManifoldEdgesOff();
  edges->ColoringOff();
  edges->Update();
  return edges->GetOutput();
}

vtkSmartPointer<vtkPolyData> rimOf(vtkPolyData& surface) {
  constexpr double kMerged = 1e-7;
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputData(&surface);
  clean->SetTolerance(kMerged);
  clean->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputConnection(clean->GetOutputPort());
  edges->FeatureEdgesOff();
  edges->NonManifoldEdgesOff();
  edges->ColoringOff();
  edges->Update();
  return edges->GetOutput();
}

}  // namespace burnish
