#include "postproc/draw/contour/tool_drawing.h"

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "postproc/draw/contour/shape_lines.h"
#include "postproc/mesh/poly_builder.h"
#include "postproc/mesh/recorded_shape.h"

namespace burnish {
namespace {

/// Lines with slanted strokes on one side of them.
class Hatching {
 public:
  explicit Hatching(double stroke) : stroke_(stroke) {}

  /// side: unit vector across the segment. Strokes of segments that follow one another are equally far apart.
  void addSegment(const Eigen::Vector3d& begin, const Eigen::Vector3d& end, const Eigen::Vector3d& side) {
    addLine(begin, end);
    const double length = (end - begin).norm(), gap = kGap * stroke_;
    if (length == 0.0) return;
    if ((begin - end_).norm() > kJoined * stroke_) next_ = gap;
    const Eigen::Vector3d along = (end - begin) / length;
    const Eigen::Vector3d slant = stroke_ * (side - along).normalized();
    for (; next_ <= length; next_ += gap) {
      const Eigen::Vector3d foot = begin + next_ * along;
      addLine(foot, foot + slant);
    }
    next_ -= length;
    end_ = end;
  }

  vtkSmartPointer<vtkPolyData> finish() const { return builder_.finish(); }

 private:
  static constexpr double kGap = 0.6, kJoined = 1e-6;

  void addLine(const Eigen::Vector3d& begin, const Eigen::Vector3d& end) {
    Eigen::Matrix<double, 3, 2> ends;
    ends << begin, end;
    builder_.addLine(builder_.addPoints(ends));
  }

  double stroke_;
  double next_ = 0.0;  ///< from the end of the last segment to the next stroke
  Eigen::Vector3d end_ = Eigen::Vector3d::Constant(HUGE_VAL);
  PolyBuilder builder_;
};

vtkSmartPointer<vtkPolyData> hatchedLine(vtkPolyData& segment, const Eigen::Vector3d& normal, double stroke) {
  Hatching hatching(stroke);
  hatching.addSegment(Eigen::Vector3d(segment.GetPoint(0)), Eigen::Vector3d(segment.GetPoint(1)),
                      -normal.normalized());
  return hatching.finish();
}

/// The tool lies at the left of every segment.
vtkSmartPointer<vtkPolyData> hatchedMesh(const SurfaceMesh& mesh, double stroke) {
  Hatching hatching(stroke);
  for (const auto& cell : mesh.cells.colwise()) {
    const Eigen::Vector3d begin = mesh.points.col(cell(0)), end = mesh.points.col(cell(1));
    hatching.addSegment(begin, end, Eigen::Vector3d::UnitZ().cross(end - begin).normalized());
  }
  return hatching.finish();
}

vtkSmartPointer<vtkPolyData> filled(vtkPolyData& outline) {
  vtkNew<vtkCellArray> polygon;
  polygon->InsertNextCell(static_cast<int>(outline.GetNumberOfPoints()));
  for (vtkIdType k = 0; k < outline.GetNumberOfPoints(); ++k) polygon->InsertCellPoint(k);
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(outline.GetPoints());
  data->SetPolys(polygon);
  return data;
}

/// The lines and the radius of a disc that has turned from upright.
vtkSmartPointer<vtkPolyData> withRadius(vtkPolyData& circle, const RecordedShape& shape, double turn) {
  Eigen::Matrix<double, 3, 2> ends;
  const Eigen::Vector3d upright(-std::sin(turn), std::cos(turn), 0.0);
  const auto disc = discOf(shape);
  if (!disc) return &circle;
  ends << disc->center, disc->center + disc->radius * upright;
  PolyBuilder builder;
  builder.addLine(builder.addPoints(ends));
  return together(circle, *builder.finish());
}

using Interval = std::array<double, 2>;

/// A side of what is seen, from its begin along a direction.
struct BorderSide {
  Eigen::Vector2d begin, along;
  double length;
};

/// Where polygons lie over the line of a side: distances from its begin.
std::vector<Interval> coveredParts(vtkPolyData& area, const View& view, const BorderSide& side) {
  const Eigen::Vector2d across(-side.along.y(), side.along.x());
  std::vector<Interval> parts;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < area.GetNumberOfCells(); ++cell) {
    area.GetCellPoints(cell, ids);
    std::vector<double> crossings;
    Eigen::Vector2d last = view.pixel(Eigen::Vector3d(area.GetPoint(ids->GetId(ids->GetNumberOfIds() - 1))));
    for (const vtkIdType id : std::span(ids->begin(), ids->end())) {
      const Eigen::Vector2d next = view.pixel(Eigen::Vector3d(area.GetPoint(id)));
      const double before = across.dot(last - side.begin), after = across.dot(next - side.begin);
      if ((before < 0.0) != (after < 0.0))
        crossings.push_back(side.along.dot(last + before / (before - after) * (next - last) - side.begin));
      last = next;
    }
    std::ranges::sort(crossings);
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
      parts.push_back({std::max(0.0, crossings[k]), std::min(side.length, crossings[k + 1])});
  }
  std::erase_if(parts, [](const Interval& part) { return part[0] >= part[1]; });
  return parts;
}

/// Those that touch one another as one.
std::vector<Interval> inOnePiece(std::vector<Interval> parts) {
  constexpr double kTouching = 1e-3;  // pixels
  std::ranges::sort(parts);
  std::vector<Interval> wholes;
  for (const Interval& part : parts)
    if (wholes.empty() || part[0] > wholes.back()[1] + kTouching)
      wholes.push_back(part);
    else
      wholes.back()[1] = std::max(wholes.back()[1], part[1]);
  return wholes;
}

}  // namespace

std::vector<std::vector<Eigen::Vector2d>> breakLines(const std::vector<ToolDrawing>& tools, const View& view,
                                                     double zigzag) {
  constexpr double kHalfWidth = 0.6, kRoom = 4.0;  // of its height
  const PixelRect& seen = view.area;
  const Eigen::Vector2d right(1.0, 0.0), up(0.0, 1.0);
  std::vector<std::vector<Eigen::Vector2d>> lines;
  for (const BorderSide& side :
       {BorderSide{{seen.x, seen.y}, right, seen.width}, BorderSide{{seen.x, seen.top()}, right, seen.width},
        BorderSide{{seen.x, seen.y}, up, seen.height}, BorderSide{{seen.right(), seen.y}, up, seen.height}}) {
    const Eigen::Vector2d across(-side.along.y(), side.along.x());
    const auto at = [&](double way, double aside) {
      return Eigen::Vector2d(side.begin + way * side.along + aside * across);
    };
    for (const ToolDrawing& tool : tools) {
      if (!tool.area) continue;
      for (const auto& [begin, end] : inOnePiece(coveredParts(*tool.area, view, side))) {
        std::vector<Eigen::Vector2d> line{at(begin, 0.0)};
        if (end - begin > kRoom * zigzag) {
          const double middle = 0.5 * (begin + end), half = kHalfWidth * zigzag;
          for (const auto& [way, aside] : {std::pair(-half, 0.0), std::pair(-half / 2.0, zigzag / 2.0),
                                           std::pair(half / 2.0, -zigzag / 2.0), std::pair(half, 0.0)})
            line.push_back(at(middle + way, aside));
        }
        line.push_back(at(end, 0.0));
        lines.push_back(std::move(line));
      }
    }
  }
  return lines;
}

ToolDrawing drawPlaneTool(const ToolRecord& tool, const Eigen::AlignedBox3d& visible, double stroke,
                          std::optional<double> turn, double error) {
  const auto outline = toolOutline(tool, 2, visible, error);
  ToolDrawing drawing;
  if (const auto normal = planeNormal(tool.shape)) {
    drawing.lines = hatchedLine(*outline, *normal, stroke);
  } else if (const SurfaceMesh* mesh = recordedMesh(tool.shape)) {
    if (hasInside(tool.shape)) drawing.area = enclosedAreas(*outline);
    drawing.lines = drawing.area ? outline : hatchedMesh(*mesh, stroke);
  } else {
    drawing.area = filled(*outline);
    drawing.lines = turn ? withRadius(*outline, tool.shape, *turn) : outline;
  }
  return drawing;
}

ToolDrawing drawSpaceTool(const ToolRecord& tool, const Eigen::AlignedBox3d& visible, const View& view,
                          double error, const std::optional<CutPlane>& cut) {
  const auto shape = withoutSeams(*toolOutline(tool, 3, visible, error));
  ToolDrawing drawing;
  drawing.surface = shape->GetPointData()->GetNormals() ? shape : withNormals(*shape);
  drawing.lines = together(*edgesOf(*shape), *silhouetteOf(*drawing.surface, view));
  if (!cut) return drawing;
  const auto section = toolSection(tool, visible, *cut, error);
  if (hasInside(tool.shape)) drawing.area = enclosedAreas(*section);
  drawing.surface = behind(*drawing.surface, *cut);
  drawing.lines = together(*behind(*drawing.lines, *cut), *section);
  return drawing;
}

ToolDrawing drawToolSection(const ToolRecord& tool, const Eigen::AlignedBox3d& visible, const CutPlane& plane,
                            double stroke, double error) {
  const auto section = toolSection(tool, visible, plane, error);
  if (section->GetNumberOfCells() == 0) return {};
  if (const auto flat = planeNormal(tool.shape)) {
    const Eigen::Vector3d across = plane.normal.normalized();
    const Eigen::Vector3d normal = *flat - flat->dot(across) * across;
    return {nullptr, nullptr, hatchedLine(*section, normal, stroke)};
  }
  return {hasInside(tool.shape) ? enclosedAreas(*section) : nullptr, nullptr, section};
}

}  // namespace burnish
