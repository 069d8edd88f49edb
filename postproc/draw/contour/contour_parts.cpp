#include "postproc/draw/contour/contour_parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "engine/core/error.h"
#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/contour_view.h"
#include "postproc/draw/contour/exact_range.h"
#include "postproc/draw/contour/tool_drawing.h"
#include "postproc/draw/contour/value_parts.h"
#include "postproc/mesh/body_surface.h"
#include "postproc/mesh/chosen_bodies.h"
#include "postproc/mesh/frame_parts.h"
#include "postproc/mesh/outlines.h"
#include "postproc/mesh/picture_subdivision.h"
#include "postproc/mesh/plane_section.h"
#include "postproc/mesh/recorded_shape.h"
#include "postproc/mesh/tessellation.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

/// Longest arrow as a part of the diagonal of what is seen of the body.
constexpr double kArrowLength = 0.07;

/// A tool is shown whole if it reaches no further than this beyond the body (part of the body's diagonal),
/// else cut off at the smaller distance.
constexpr double kToolReach = 0.4, kToolCut = 0.2;

// Parts of the diagonal, for the dots of the control net and for the signs at extremes.
constexpr double kDotRoom = 0.005, kSignRoom = 0.015;

/// Components xx, yy, zz, xy, yz, zx of the stress at points; 0 where the frame has none. mesh: see `setValues`.
template <class Mesh>
Eigen::MatrixXd stressAt(const Mesh& mesh, const FrameRecord& frame) {
  constexpr std::array components{"xx", "yy", "zz", "xy", "yz", "zx"};
  const auto field = frame.fields.find("stress");
  if (field == frame.fields.end())
    throw Error("vectors: the frame holds no stress, whose crosses could be drawn");
  const Eigen::MatrixXd values = mesh.evaluate(field->second.values);
  Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(std::ssize(components), values.cols());
  for (std::size_t k = 0; k < components.size(); ++k) {
    const auto& names = field->second.components;
    const auto row = std::find(names.begin(), names.end(), components[k]);
    if (row != names.end()) stress.row(static_cast<Eigen::Index>(k)) = values.row(row - names.begin());
  }
  return stress;
}

/// Gives points what is drawn at them. mesh: knows their number and how to evaluate there.
template <class Mesh>
void setValues(vtkPointData& points, const Mesh& mesh, const FrameRecord& frame, const FieldChoice& field,
               const ContourOptions& options) {
  points.SetScalars(
      makeArray("drawn", field.drawnScalars(mesh.evaluate(field.coefficients)).transpose(), {}));
  if (options.arrows == ArrowField::Displacement)
    points.AddArray(makeArray("displacement", inSpace(mesh.evaluate(frame.displacement)), kAxes));
  if (options.arrows == ArrowField::Principal)
    points.AddArray(makeArray("stress", stressAt(mesh, frame), {}));
}

/// Makes what has colours. mesh: of the bodies that have the field.
void makeBody(ContourParts& parts, const MeshRecord& mesh, const ModelRecord& model, const FrameRecord& frame,
              const FieldChoice& field, const ContourOptions& options) {
  parts.body = field.faces;
  if (parts.body) return;
  const BodySurface surface(mesh, subdivisionOf(model, options));
  parts.body = surface.displaced(parts.displacement);
  parts.bodyLattices = surface.lattices();
  setValues(*parts.body->GetPointData(), surface, frame, field, options);
}

/// Cuts a plane body for a view.
class ViewCells {
 public:
  ViewCells(const FieldChoice& field, const ContourOptions& options, const View& view,
            const std::array<double, 2>& range)
      : subdivision_(options.subdivision) {
    constexpr double kPixels = 0.25, kSteps = 0.5;
    const Eigen::Vector2d half =
        Eigen::Vector2d(view.area.width, view.area.height) / (2.0 * view.pixelsPerLength);
    positions_ = {kPixels / view.pixelsPerLength, {view.center - half, view.center + half}};
    const double steps = options.isolines > 0 || options.bands > 0 ? kStepsAtBorders : kSteps;
    values_ = {field.coefficients, steps * (range[1] - range[0]) / kStepsOfRange, range};
  }

  Subdivision ofLines(const MeshRecord& mesh, const Eigen::MatrixXd& displacement) const {
    return subdivision_ ? Subdivision(*subdivision_)
                        : pictureSubdivision(mesh, displacement, positions_, nullptr);
  }
  Subdivision ofValues(const MeshRecord& mesh, const Eigen::MatrixXd& displacement) const {
    return subdivision_ ? Subdivision(*subdivision_)
                        : pictureSubdivision(mesh, displacement, positions_, &values_);
  }
  /// For the borders of where a field has some values.
  Subdivision ofThreshold(const MeshRecord& mesh, const Eigen::MatrixXd& displacement,
                          const FieldChoice& field) const {
    const auto range = exactRange(mesh, field);
    if (subdivision_ || !range) return ofLines(mesh, displacement);
    const ValueTolerance values{field.coefficients,
                                kStepsAtBorders * (range->values[1] - range->values[0]) / kStepsOfRange,
                                range->values};
    return range->values[0] == range->values[1] ? ofLines(mesh, displacement)
                                                : pictureSubdivision(mesh, displacement, positions_, &values);
  }

 private:
  static constexpr double kStepsAtBorders = 0.1, kStepsOfRange = 256.0;
  std::optional<int> subdivision_;
  PositionTolerance positions_;
  ValueTolerance values_;
};

/// Cuts the parts of a picture of a body in space.
class BodyCut {
 public:
  BodyCut(const FieldMesh& meshes, const ModelRecord& model, const FrameRecord& frame,
          const FieldChoice& field, const ContourOptions& options, ContourParts& parts)
      : meshes_(meshes),
        model_(model),
        frame_(frame),
        field_(field),
        mesh_(meshOf(model, frame)),
        options_(options),
        parts_(parts),
        subdivision_(subdivisionOf(model, options)),
        plane_(shownPlane(options, parts)) {}

  void apply() {
    parts_.plane = plane_;
    parts_.bodyLattices.clear();
    parts_.plainLattices.clear();
    const auto section = sectionWithValues();
    auto border = sectionOf(*parts_.body, plane_);
    if (parts_.plain) {
      parts_.plainSection = sectionOf(*gridOf(*meshes_.without()), plane_);
      border = together(*border, *sectionOf(*parts_.plain, plane_));
    }
    if (section->GetNumberOfCells() == 0 &&
        (!parts_.plainSection || parts_.plainSection->GetNumberOfCells() == 0))
      throw planeMisses(options_, parts_, frame_.index);
    if (options_.knots) parts_.knots = sectionKnots();
    if (options_.slice) {
      parts_.body = section;
      parts_.plain = std::exchange(parts_.plainSection, nullptr);
      parts_.outline = border;
      if (parts_.undeformed)
        parts_.undeformed = sectionOf(*BodySurface(model_.mesh, subdivision_).displaced({}), plane_);
      return;
    }
    parts_.body = behind(*parts_.body, plane_);
    if (parts_.plain) parts_.plain = behind(*parts_.plain, plane_);
    parts_.section = section;
    parts_.outline = together(*behind(*parts_.outline, plane_), *border);
    if (parts_.undeformed) parts_.undeformed = behind(*parts_.undeformed, plane_);
    if (parts_.knots)
      parts_.knots =
          together(*parts_.knots, *behind(*knotLines(mesh_, parts_.displacement, subdivision_), plane_));
  }

 private:
  /// The tessellated volume, without values.
  vtkSmartPointer<vtkUnstructuredGrid> gridOf(const Tessellation& cells) const {
    FrameRecord shape;
    shape.displacement = parts_.displacement;
    const auto grid = makeGrid(cells, shape, true);
    grid->GetPointData()->Initialize();
    return grid;
  }
  vtkSmartPointer<vtkUnstructuredGrid> gridOf(const MeshRecord& mesh) const {
    return gridOf(Tessellation(mesh, subdivision_));
  }

  vtkSmartPointer<vtkPolyData> sectionWithValues() const {
    const Tessellation cells(meshes_.with(), subdivision_);
    const auto grid = gridOf(cells);
    setValues(*grid->GetPointData(), cells, frame_, field_, options_);
    const auto section = sectionOf(*grid, plane_);
    section->GetPointData()->SetNormals(
        makeArray("normals", plane_.normal.replicate(1, section->GetNumberOfPoints()), {}));
    return section;
  }

  /// Where the plane cuts the faces between knot spans.
  vtkSmartPointer<vtkPolyData> sectionKnots() const {
    const BodySurface faces(mesh_, subdivision_, BodySurface::Faces::OfSpans);
    return sectionOf(*faces.displaced(parts_.displacement), plane_);
  }

  const FieldMesh& meshes_;
  const ModelRecord& model_;
  const FrameRecord& frame_;
  const FieldChoice& field_;
  const MeshRecord& mesh_;  ///< of the frame
  const ContourOptions& options_;
  ContourParts& parts_;
  int subdivision_;
  CutPlane plane_;
};

std::vector<ShownTool> shownTools(const ModelRecord& model, const FrameRecord& frame, double warp) {
  std::vector<ShownTool> tools;
  for (std::size_t k = 0; k < model.tools.size(); ++k) {
    tools.push_back({placedTool(model, frame, k, warp), {}});
    const auto tool = static_cast<Eigen::Index>(k);
    if (frame.toolAngle.size() > tool && frame.toolAngle(tool) != 0.0)
      tools.back().turn = warp * frame.toolAngle(tool);
  }
  return tools;
}

/// Parts of what is seen, so that it is the same for a body and for a part of it.
double arrowLength(vtkPolyData& body, const View& sight, const ContourOptions& options) {
  Eigen::AlignedBox2d box = boxOf(body, sight.axes, sight.eye);
  if (options.window && options.window->intersects(box)) box = options.window->intersection(box);
  return kArrowLength * box.diagonal().norm();
}

Eigen::AlignedBox2d grown(const Eigen::AlignedBox2d& box, double part) {
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(part * box.diagonal().norm());
  return {box.min() - margin, box.max() + margin};
}

Eigen::Map<const Eigen::Matrix3Xd> pointsOf(vtkPolyData& part) {
  return {static_cast<const double*>(part.GetPoints()->GetVoidPointer(0)), 3, part.GetNumberOfPoints()};
}

/// Points in the picture's plane.
Eigen::Matrix2Xd projected(const Eigen::Matrix3Xd& points, const ViewAxes& axes,
                           const std::optional<Eye>& eye) {
  return eye ? eye->project(axes, points) : Eigen::Matrix2Xd(axes * points);
}

/// What is shown of a tool in space.
vtkSmartPointer<vtkPolyData> toolInSpace(const ToolRecord& tool, const ContourParts& parts) {
  const auto shape = toolOutline(tool, 3, parts.box);
  if (!parts.plane) return shape;
  return parts.section ? behind(*shape, *parts.plane) : sectionOf(*shape, *parts.plane);
}

/// Points of what is shown of a tool, in the picture's plane.
Eigen::Matrix2Xd landmarksOf(const ToolRecord& tool, const ContourParts& parts, int dim) {
  if (dim == 2) return parts.axes * toolLandmarks(tool, parts.box);
  return projected(pointsOf(*toolInSpace(tool, parts)), parts.axes, parts.eye);
}

double nearestOf(const Eigen::Matrix3Xd& points, const ViewAxes& axes) {
  return points.cols() == 0 ? -HUGE_VAL : (towardsEye(axes).transpose() * points).maxCoeff();
}

/// All of a tool if it is near, else its part in the smaller box. asPoints: the landmarks are themselves what
/// should be seen, not corners of a box.
Eigen::AlignedBox2d seenOf(const Eigen::Matrix2Xd& landmarks, bool asPoints, const Eigen::AlignedBox2d& near,
                           const Eigen::AlignedBox2d& cut) {
  Eigen::AlignedBox2d whole, seen;
  for (const auto& point : landmarks.colwise()) {
    whole.extend(point);
    if (cut.contains(point)) seen.extend(point);
  }
  if (near.contains(whole)) return whole;
  return asPoints ? seen : cut.intersection(whole);
}

}  // namespace

CutPlane shownPlane(const ContourOptions& options, const ContourParts& parts) {
  constexpr double kNudge = 1e-6, kEdgeOn = 1e-3;
  CutPlane plane = options.cut ? *options.cut : *options.slice;
  const Eigen::Vector3d eye = towardsEye(parts.axes);
  plane.normal.normalize();
  if (plane.normal.dot(eye) < 0.0) plane.normal = -plane.normal;
  if (plane.normal.dot(eye) < kEdgeOn)
    throw Error(fmt::format("{}: its plane is seen edge-on; choose another direction for the eye",
                            options.cut ? "cut" : "slice"));
  const double side = (parts.box.center() - plane.point).dot(plane.normal) > 0.0 ? 1.0 : -1.0;
  plane.point += side * kNudge * parts.box.diagonal().norm() * plane.normal;
  return plane;
}

Error planeMisses(const ContourOptions& options, const ContourParts& parts, int frame) {
  const Eigen::AlignedBox3d& box = parts.box;
  return Error(
      fmt::format("{}: its plane misses the body, which in frame {} reaches from ({:.6g}) to ({:.6g})",
                  options.cut ? "cut" : "slice", frame, fmt::join(box.min().begin(), box.min().end(), ", "),
                  fmt::join(box.max().begin(), box.max().end(), ", ")));
}

int subdivisionOf(const ModelRecord& model, const ContourOptions& options) {
  return options.subdivision.value_or(model.subdivision);
}

ContourParts contourParts(const ModelRecord& model, const FrameRecord& frame, const FieldChoice& field,
                          const ContourOptions& options) {
  const int subdivision = subdivisionOf(model, options);
  const MeshRecord& mesh = meshOf(model, frame);
  ContourParts parts;
  const bool alongNormal = options.slice && options.view.name == "auto";
  parts.axes = alongNormal ? viewFrom(options.slice->normal) : viewAxes(options.view, model.dim);
  parts.displacement = options.warp * frame.displacement;
  if (options.tools) parts.tools = shownTools(model, frame, options.warp);
  const FieldMesh meshes(model, frame, field.name);
  makeBody(parts, meshes.with(), model, frame, field, options);
  parts.box = boxOf(*parts.body);
  if (meshes.without() != nullptr) {
    const BodySurface plain(*meshes.without(), subdivision);
    parts.plain = plain.displaced(parts.displacement);
    parts.plainLattices = plain.lattices();
    parts.box.extend(boxOf(*parts.plain));
  }
  parts.outline = bodyOutline(mesh, parts.displacement, subdivision);
  if (options.undeformed) parts.undeformed = bodyOutline(model.mesh, {}, subdivision);
  if (options.cut || options.slice)
    BodyCut(meshes, model, frame, field, options, parts).apply();
  else if (options.knots)
    parts.knots = knotLines(mesh, parts.displacement, subdivision);
  if (options.controlNet) {
    FrameRecord shape;
    shape.mesh = frame.mesh;
    shape.displacement = parts.displacement;
    parts.net = controlNet(model, shape);
  }
  parts.eye = eyeOf(options, parts, model.dim);
  if (options.arrows != ArrowField::None) {
    const auto body = parts.section ? together(*parts.body, *parts.section) : parts.body;
    const View sight{.axes = parts.axes, .area = {}, .eye = parts.eye};
    parts.arrows =
        contourArrows(options.arrows, model, frame, *body, sight, arrowLength(*body, sight, options));
  }
  parts.mark = options.mark;
  if (options.markExtremes) parts.extremes = extremePlaces(model, frame, field, parts.displacement);
  return parts;
}

void refineForView(ContourParts& parts, const ModelRecord& model, const FrameRecord& frame,
                   const FieldChoice& field, const ContourOptions& options, const View& view,
                   const std::array<double, 2>& range) {
  const auto trianglesOf = [](const MeshRecord& mesh, const Subdivision& subdivision) {
    return BodySurface(mesh, subdivision, BodySurface::Faces::Outside,
                       BodySurface::Cells::TrianglesAboutMiddles);
  };
  const MeshRecord& mesh = meshOf(model, frame);
  const ViewCells cells(field, options, view, range);
  const FieldMesh meshes(model, frame, field.name);
  std::optional<FieldChoice> chosen;
  if (options.threshold) chosen = choosingField(model, frame, field, options);
  const auto withChosen = [&](Subdivision subdivision, const MeshRecord& ofMesh) {
    if (chosen) subdivision.refine(cells.ofThreshold(ofMesh, parts.displacement, *chosen));
    return subdivision;
  };
  if (!field.faces) {
    const BodySurface surface = trianglesOf(
        meshes.with(), withChosen(cells.ofValues(meshes.with(), parts.displacement), meshes.with()));
    parts.body = surface.displaced(parts.displacement);
    // Colours end at 0 where a range does, and interpolation does not go round a corner at 0.
    const Eigen::MatrixXd values = surface.evaluate(field.coefficients);
    const Eigen::VectorXd drawn = range[0] < 0.0 ? field.drawnScalars(values) : field.scalars(values);
    parts.body->GetPointData()->SetScalars(makeArray("drawn", drawn.transpose(), {}));
    if (chosen) setChosen(*parts.body->GetPointData(), surface, *chosen);
  }
  if (parts.plain) {
    const MeshRecord& without = *meshes.without();
    parts.plain =
        trianglesOf(without, cells.ofLines(without, parts.displacement)).displaced(parts.displacement);
  }
  const Subdivision ofLines = withChosen(cells.ofLines(mesh, parts.displacement), mesh);
  const Eigen::MatrixXd* along = chosen ? &chosen->coefficients : nullptr;
  parts.outline = bodyOutline(mesh, parts.displacement, ofLines, along);
  if (parts.knots) parts.knots = knotLines(mesh, parts.displacement, ofLines, along);
  if (chosen) keepBetween(parts, options.threshold->ends, *chosen);
  if (parts.undeformed) parts.undeformed = bodyOutline(model.mesh, {}, cells.ofLines(model.mesh, {}));
}

Eigen::AlignedBox3d boxOf(vtkPolyData& part) {
  const double* b = part.GetBounds();
  return {Eigen::Vector3d(b[0], b[2], b[4]), Eigen::Vector3d(b[1], b[3], b[5])};
}

Eigen::AlignedBox2d boxOf(vtkPolyData& part, const ViewAxes& axes, const std::optional<Eye>& eye) {
  if (part.GetNumberOfPoints() == 0) return {};
  const Eigen::Matrix2Xd seen = projected(pointsOf(part), axes, eye);
  return {seen.rowwise().minCoeff(), seen.rowwise().maxCoeff()};
}

double nearestOf(const ContourParts& parts) {
  double nearest = -HUGE_VAL;
  for (const auto& part :
       {parts.body, parts.section, parts.plain, parts.plainSection, parts.undeformed, parts.net})
    if (part && part->GetNumberOfPoints() > 0)
      nearest = std::max(nearest, nearestOf(pointsOf(*part), parts.axes));
  for (const ShownTool& tool : parts.tools)
    nearest = std::max(nearest, nearestOf(pointsOf(*toolInSpace(tool.record, parts)), parts.axes));
  return nearest;
}

Eye eyeAt(double degrees, const Eigen::AlignedBox2d& content, double nearest) {
  const double half = 0.5 * content.sizes().maxCoeff();
  return {content.center(), nearest, half / std::tan(0.5 * degrees * std::numbers::pi / 180.0)};
}

std::optional<Eye> eyeOf(const ContourOptions& options, const ContourParts& parts, int dim) {
  if (!options.perspective) return std::nullopt;
  if (options.eye) return options.eye;
  return eyeAt(*options.perspective, contentOf(parts, dim), nearestOf(parts));
}

double lengthOf(const ContourParts& parts) {
  if (parts.ghost) return parts.ghost->GetLength();
  if (!parts.plain || parts.plain->GetNumberOfPoints() == 0) return parts.body->GetLength();
  if (parts.body->GetNumberOfPoints() == 0) return parts.plain->GetLength();
  return boxOf(*parts.body).merged(boxOf(*parts.plain)).diagonal().norm();
}

Eigen::AlignedBox2d bodiesBox(const ContourParts& parts) {
  Eigen::AlignedBox2d box = boxOf(*parts.body, parts.axes, parts.eye);
  if (parts.plain) box.extend(boxOf(*parts.plain, parts.axes, parts.eye));
  return box;
}

Eigen::AlignedBox2d contentOf(const ContourParts& parts, int dim) {
  Eigen::AlignedBox2d box = bodiesBox(parts);
  if (parts.undeformed) box.extend(boxOf(*parts.undeformed, parts.axes, parts.eye));
  if (parts.net) box = grown(box.merged(boxOf(*parts.net, parts.axes, parts.eye)), kDotRoom);
  if (parts.extremes || parts.mark) box = grown(box, kSignRoom);
  for (const auto& edges : {parts.arrows.edges, parts.arrows.darkEdges})
    if (edges) box.extend(boxOf(*edges, parts.axes, parts.eye));
  const Eigen::AlignedBox2d near = grown(box, kToolReach), cut = grown(box, kToolCut);
  for (const ShownTool& tool : parts.tools) {
    const bool asPoints = dim == 2 && recordedMesh(tool.record.shape) != nullptr;
    const Eigen::AlignedBox2d seen = seenOf(landmarksOf(tool.record, parts, dim), asPoints, near, cut);
    if (!seen.isEmpty()) box.extend(seen);
  }
  return box;
}

}  // namespace burnish
