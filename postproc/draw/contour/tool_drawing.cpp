#include "postproc/draw/contour/tool_drawing.h"

#include <vtkCellArray.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "engine/tools/outline_parts.h"
#include "postproc/draw/contour/shape_lines.h"
#include "postproc/mesh/outlines.h"
#include "postproc/mesh/poly_builder.h"

namespace burnish {
namespace {

struct Landmarks {
  const Eigen::AlignedBox3d& body;

  Eigen::Matrix3Xd operator()(const Plane& plane) const {
    const Eigen::Vector3d n = plane.normal.normalized();
    const double height = (body.center() - plane.origin).dot(n);
    Eigen::Matrix3Xd points(3, 2);
    points.col(0) = body.center() - height * n;
    points.col(1) = points.col(0) - hatchRoom() * n;
    return points;
  }
  Eigen::Matrix3Xd operator()(const Cylinder& cylinder) const {
    return corners(cylinder.center, cylinder.radius);
  }
  Eigen::Matrix3Xd operator()(const Sphere& sphere) const { return corners(sphere.center, sphere.radius); }

  /// Ends of the edges and points along what of them is near the body. A line needs room for hatches at its
  /// left.
  Eigen::Matrix3Xd operator()(const SurfaceMesh& mesh) const {
    const bool hatched = mesh.cells.rows() == 2 && !isSolid(mesh);
    std::vector<Eigen::Vector3d> points;
    for (const auto& cell : mesh.cells.colwise()) {
      const Eigen::Vector3d begin = mesh.points.col(cell(0)), along = mesh.points.col(cell(1)) - begin;
      if (along.norm() == 0.0) continue;
      const Eigen::Vector3d left = hatchRoom() * Eigen::Vector3d::UnitZ().cross(along).normalized();
      for (const double share : sharesNearBody(begin, along)) {
        points.emplace_back(begin + share * along);
        if (hatched) points.emplace_back(points.back() + left);
      }
    }
    return Eigen::Map<const Eigen::Matrix3Xd>(points.front().data(), 3, std::ssize(points));
  }

  std::vector<double> sharesNearBody(const Eigen::Vector3d& begin, const Eigen::Vector3d& along) const {
    constexpr int kPoints = 65;
    const double reach = 2.0 * body.diagonal().norm() / along.norm();
    const double middle = (body.center() - begin).dot(along) / along.squaredNorm();
    const double first = std::clamp(middle - reach, 0.0, 1.0), last = std::clamp(middle + reach, 0.0, 1.0);
    std::vector<double> shares{0.0, 1.0};
    for (int k = 0; k < kPoints; ++k) shares.push_back(std::lerp(first, last, k / (kPoints - 1.0)));
    return shares;
  }

  double hatchRoom() const { return 0.04 * body.diagonal().norm(); }

  Eigen::Matrix3Xd corners(const Eigen::Vector3d& center, double radius) const {
    const Eigen::Vector3d r = Eigen::Vector3d::Constant(radius);
    return corners(Eigen::AlignedBox3d(center - r, center + r));
  }
  Eigen::Matrix3Xd corners(const Eigen::AlignedBox3d& box) const {
    Eigen::Matrix3Xd points(3, 8);
    for (int k = 0; k < 8; ++k) points.col(k) = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k));
    return points;
  }
};

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
  const auto* disc = std::get_if<Cylinder>(&shape);
  if (disc == nullptr) return &circle;
  ends << disc->center, disc->center + disc->radius * upright;
  PolyBuilder builder;
  builder.addLine(builder.addPoints(ends));
  return together(circle, *builder.finish());
}

/// Whether a plane cuts areas out of a shape.
bool hasSections(const RecordedShape& shape) {
  const auto* mesh = std::get_if<SurfaceMesh>(&shape);
  return mesh ? isSolid(*mesh) : !std::holds_alternative<Plane>(shape);
}

}  // namespace

Eigen::Matrix3Xd toolLandmarks(const ToolRecord& tool, const Eigen::AlignedBox3d& body) {
  return std::visit(Landmarks{body}, tool.shape);
}

ToolDrawing drawPlaneTool(const ToolRecord& tool, const Eigen::AlignedBox3d& visible, double stroke,
                          std::optional<double> turn) {
  const auto outline = toolOutline(tool, 2, visible);
  ToolDrawing drawing;
  if (const auto* plane = std::get_if<Plane>(&tool.shape)) {
    drawing.lines = hatchedLine(*outline, plane->normal, stroke);
  } else if (const auto* mesh = std::get_if<SurfaceMesh>(&tool.shape)) {
    if (isSolid(*mesh)) drawing.area = enclosedAreas(*outline);
    drawing.lines = drawing.area ? outline : hatchedMesh(*mesh, stroke);
  } else {
    drawing.area = filled(*outline);
    drawing.lines = turn ? withRadius(*outline, tool.shape, *turn) : outline;
  }
  return drawing;
}

ToolDrawing drawSpaceTool(const ToolRecord& tool, const Eigen::AlignedBox3d& visible,
                          const Eigen::Vector3d& towardsEye, const std::optional<CutPlane>& cut) {
  const auto shape = withoutSeams(*toolOutline(tool, 3, visible));
  ToolDrawing drawing;
  drawing.surface = withNormals(*shape);
  drawing.lines = together(*edgesOf(*shape), *silhouetteOf(*drawing.surface, towardsEye));
  if (!cut) return drawing;
  const auto section = sectionOf(*shape, *cut);
  if (hasSections(tool.shape)) drawing.area = enclosedAreas(*section);
  drawing.surface = behind(*drawing.surface, *cut);
  drawing.lines = together(*behind(*drawing.lines, *cut), *section);
  return drawing;
}

ToolDrawing drawToolSection(const ToolRecord& tool, const Eigen::AlignedBox3d& visible, const CutPlane& plane,
                            double stroke) {
  const auto section = sectionOf(*toolOutline(tool, 3, visible), plane);
  if (section->GetNumberOfCells() == 0) return {};
  if (const auto* flat = std::get_if<Plane>(&tool.shape)) {
    const Eigen::Vector3d across = plane.normal.normalized();
    const Eigen::Vector3d normal = flat->normal - flat->normal.dot(across) * across;
    return {nullptr, nullptr, hatchedLine(*section, normal, stroke)};
  }
  return {hasSections(tool.shape) ? enclosedAreas(*section) : nullptr, nullptr, section};
}

}  // namespace burnish
