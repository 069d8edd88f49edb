#include "postproc/draw/contour/tool_drawing.h"

#include <vtkCellArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <cmath>

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

}  // namespace

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
