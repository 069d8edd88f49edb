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
#include <limits>
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
#include "postproc/mesh/exact_section.h"
#include "postproc/mesh/frame_parts.h"
#include "postproc/mesh/middle_triangles.h"
#include "postproc/mesh/mirror.h"
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
  if (options.arrows == ArrowField::Displacement || options.arrows == ArrowField::Field ||
      options.arrows == ArrowField::Streamlines)
    points.AddArray(makeArray("vectors", inSpace(mesh.evaluate(frame.displacement)), kAxes));
  if (options.arrows == ArrowField::Principal)
    points.AddArray(makeArray("stress", stressAt(mesh, frame), {}));
}

Eigen::AlignedBox2d everywhere() {
  const Eigen::Vector2d far = Eigen::Vector2d::Constant(std::numeric_limits<double>::max());
  return {-far, far};
}

/// The cells of what is drawn as long as the view is not known: in space those that show its shape.
Subdivision firstCells(const MeshRecord& mesh, const ModelRecord& model, const ContourParts& parts,
                       const ContourOptions& options) {
  constexpr double kOfLength = 1.0 / 2000.0;
  if (model.dim == 2) return subdivisionOf(model, options);
  Eigen::AlignedBox3d box;
  for (const PatchRecord& patch : mesh.patches)
    for (Eigen::Index k = 0; k < patch.points.cols(); ++k)
      box.extend(Eigen::Vector3d(patch.points.col(k) +
                                 parts.displacement.col(patch.nodes[static_cast<std::size_t>(k)])));
  return pictureSubdivision(mesh, parts.displacement,
                            {kOfLength * box.diagonal().norm(), everywhere(), parts.axes}, nullptr);
}

/// Makes what has colours. mesh: of the bodies that have the field.
void makeBody(ContourParts& parts, const MeshRecord& mesh, const Subdivision& cells, const FrameRecord& frame,
              const FieldChoice& field, const ContourOptions& options) {
  if (field.faces) {
    parts.body = trianglesAboutMiddles(*field.faces);
    return;
  }
  const BodySurface surface(mesh, cells);
  parts.body = surface.displaced(parts.displacement);
  setValues(*parts.body->GetPointData(), surface, frame, field, options);
}

/// Cuts bodies for a view.
class ViewCells {
 public:
  ViewCells(const FieldChoice& field, const ContourOptions& options, const View& view,
            const std::array<double, 2>& range)
      : subdivision_(options.subdivision) {
    constexpr double kPixels = 0.25, kSteps = 0.5;
    const Eigen::Vector2d half =
        Eigen::Vector2d(view.area.width, view.area.height) / (2.0 * view.pixelsPerLength);
    positions_ = {kPixels / view.pixelsPerLength, {view.center - half, view.center + half}, view.axes};
    // An eye sees lengths at most as large, but not straight ahead of where they are.
    if (view.eye) positions_.window = everywhere();
    const double steps = options.isolines > 0 || options.bands > 0 ? kStepsAtBorders : kSteps;
    values_ = {field.coefficients, steps * (range[1] - range[0]) / kStepsOfRange, range};
  }

  Subdivision ofLines(const MeshRecord& mesh, const Eigen::MatrixXd& displacement) const {
    return subdivision_ ? Subdivision(*subdivision_)
                        : pictureSubdivision(mesh, displacement, positions_, nullptr);
  }
  const PositionTolerance& positions() const { return positions_; }
  const ValueTolerance& values() const { return values_; }

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

/// The volumes of the bodies of a picture, in straight cells, where a plane cuts them.
class VolumeSections {
 public:
  VolumeSections(const FieldMesh& meshes, const ModelRecord& model, const FrameRecord& frame,
                 const FieldChoice& field, const ContourOptions& options, const ContourParts& parts)
      : meshes_(meshes),
        frame_(frame),
        field_(field),
        options_(options),
        parts_(parts),
        subdivision_(subdivisionOf(model, options)) {}

  vtkSmartPointer<vtkPolyData> withValues() const {
    const Tessellation cells(meshes_.with(), subdivision_);
    const auto grid = gridOf(cells);
    setValues(*grid->GetPointData(), cells, frame_, field_, options_);
    addParameters(*grid, meshes_.with(), subdivision_);
    const CutPlane& plane = *parts_.plane;
    const auto section = sectionOfCells(*grid, plane);
    section->GetPointData()->SetNormals(
        makeArray("normals", plane.normal.replicate(1, section->GetNumberOfPoints()), {}));
    return section;
  }

  /// Null if all bodies have the field.
  vtkSmartPointer<vtkPolyData> withoutValues() const {
    if (meshes_.without() == nullptr) return nullptr;
    const auto grid = gridOf(Tessellation(*meshes_.without(), subdivision_));
    addParameters(*grid, *meshes_.without(), subdivision_);
    return sectionOfCells(*grid, *parts_.plane);
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

  const FieldMesh& meshes_;
  const FrameRecord& frame_;
  const FieldChoice& field_;
  const ContourOptions& options_;
  const ContourParts& parts_;
  int subdivision_;
};

/// The section of parts that have been cut.
struct PartSections {
  vtkSmartPointer<vtkPolyData> withValues, plain;  ///< plain: null if all bodies have the field
};

PartSections sectionsIn(const ContourParts& parts, const ContourOptions& options) {
  if (options.slice) return {parts.body, parts.plain};
  return {parts.section, parts.plainSection};
}

/// Cuts the surfaces and lines of a picture of a body in space at the plane of the parts, where the sections lie.
void cutParts(ContourParts& parts, const PartSections& sections, const ModelRecord& model,
              const MeshRecord& mesh, const ContourOptions& options, const Subdivision& ofLines,
              const Subdivision& ofUndeformed) {
  const CutPlane& plane = *parts.plane;
  auto border = sectionOf(*parts.body, plane);
  if (parts.plain) border = together(*border, *sectionOf(*parts.plain, plane));
  if (options.knots) {
    const BodySurface faces(mesh, ofLines, BodySurface::Faces::OfSpans);
    parts.knots = sectionOf(*faces.displaced(parts.displacement), plane);
  }
  if (options.slice) {
    parts.body = sections.withValues;
    parts.plain = sections.plain;
    parts.outline = border;
    if (parts.undeformed)
      parts.undeformed = sectionOf(*BodySurface(model.mesh, ofUndeformed).displaced({}), plane);
    return;
  }
  parts.section = sections.withValues;
  parts.plainSection = sections.plain;
  parts.wholeBody = parts.body;
  parts.wholePlain = parts.plain;
  parts.body = behind(*parts.body, plane);
  if (parts.plain) parts.plain = behind(*parts.plain, plane);
  parts.outline = together(*behind(*parts.outline, plane), *border);
  if (parts.undeformed) {
    const BodySurface surface(model.mesh, ofUndeformed);
    const auto faces = surface.displaced({});
    if (&mesh == &model.mesh) setMoved(*faces, *surface.displaced(parts.displacement));
    parts.undeformed = together(*behind(*parts.undeformed, plane), *sectionOf(*faces, plane));
  }
  if (parts.knots)
    parts.knots = together(*parts.knots, *behind(*knotLines(mesh, parts.displacement, ofLines), plane));
}

/// With what has become of its points, unless the frame has a mesh of its own.
vtkSmartPointer<vtkPolyData> undeformedOutline(const ModelRecord& model, const MeshRecord& mesh,
                                               const ContourParts& parts, const Subdivision& subdivision) {
  auto outline = bodyOutline(model.mesh, {}, subdivision);
  if (&mesh == &model.mesh) setMoved(*outline, *bodyOutline(mesh, parts.displacement, subdivision));
  return outline;
}

/// What arrows of the body's fields stand on: equally many points per knot span, whatever the picture takes.
vtkSmartPointer<vtkPolyData> arrowSurface(const ContourParts& parts, const MeshRecord& mesh,
                                          const ModelRecord& model, const FrameRecord& frame,
                                          const FieldChoice& field, const ContourOptions& options) {
  if (options.arrows == ArrowField::Traction || model.dim == 2 || options.slice || field.faces)
    return parts.section ? together(*parts.body, *parts.section) : parts.body;
  const BodySurface surface(mesh, subdivisionOf(model, options));
  auto ground = surface.displaced(parts.displacement);
  setValues(*ground->GetPointData(), surface, frame, field, options);
  return options.cut ? together(*behind(*ground, *parts.plane), *parts.section) : ground;
}

std::vector<ShownTool> shownTools(const ModelRecord& model, const FrameRecord& frame, double warp) {
  std::vector<ShownTool> tools;
  for (std::size_t k = 0; k < model.tools.size(); ++k) {
    if (!model.tools[k].isThereAt(frame.time)) continue;
    tools.push_back({placedTool(model, frame, k, warp), {}});
    const auto tool = static_cast<Eigen::Index>(k);
    if (frame.toolAngle.size() > tool && frame.toolAngle(tool) != 0.0)
      tools.back().turn = warp * frame.toolAngle(tool);
  }
  return tools;
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
Eigen::Matrix2Xd landmarksOf(const ToolRecord& tool, const ContourParts& parts, int dim,
                             const std::optional<Eye>& eye) {
  if (dim == 2) return parts.axes * toolLandmarks(tool, parts.box);
  return projected(pointsOf(*toolInSpace(tool, parts)), parts.axes, eye);
}

Eigen::AlignedBox2d boxOf(const Eigen::Matrix2Xd& points) {
  if (points.cols() == 0) return {};
  return {points.rowwise().minCoeff(), points.rowwise().maxCoeff()};
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

namespace {

/// Of places that are images of one another those in the part that was computed or, if it is not seen, in one that is.
std::optional<ExtremePlaces> extremesOf(const ContourParts& parts, const ModelRecord& model,
                                        const FrameRecord& frame, const FieldChoice& field,
                                        const ContourOptions& options) {
  std::optional<ExtremePlaces> places = extremePlaces(model, frame, field, parts.displacement);
  if (!places) return places;
  const std::size_t point = field.name.find('.');
  const std::string component = point == std::string::npos ? "" : field.name.substr(point + 1);
  std::vector<MirrorPlane> symmetries = options.mirror;
  std::erase_if(symmetries,
                [&](const MirrorPlane& plane) { return signInMirror(component, plane.axis) < 0.0; });
  const Eigen::MatrixXd& computed = meshOf(model, frame).patches.front().points;  // images come later
  for (const MirrorPlane& plane : symmetries)
    for (std::size_t end = 0; end < 2; ++end) {
      const double side = computed.row(plane.axis).mean() - plane.at;
      if ((places->positions[end](plane.axis) - plane.at) * side >= 0.0) continue;
      for (auto* all : {&places->positions, &places->drawn})
        (*all)[end](plane.axis) = 2.0 * plane.at - (*all)[end](plane.axis);
    }
  moveToSeen(*places, symmetries,
             [&](const Eigen::Vector3d& place) { return isSeen(parts, options, place); });
  return places;
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

void addArrows(ContourParts& parts, const ArrowGround& ground, vtkPolyData& shown,
               const ContourOptions& options) {
  const View sight{.axes = parts.axes, .area = {}, .eye = parts.eye};
  vtkSmartPointer<vtkPolyData> before;
  if (ground.dim == 3 && !options.slice) {
    before = parts.body;
    for (const auto& part : {parts.section, parts.plain, parts.plainSection})
      if (part) before = together(*before, *part);
  }
  Eigen::AlignedBox2d box = boxOf(shown, sight.axes, sight.eye);
  if (options.window && options.window->intersects(box)) box = options.window->intersection(box);
  parts.arrows = contourArrows(options.arrows, ground, before, sight, kArrowLength * box.diagonal().norm(),
                               options.mirror);
}

int subdivisionOf(const ModelRecord& model, const ContourOptions& options) {
  return options.subdivision.value_or(model.subdivision);
}

ContourParts contourParts(const ModelRecord& model, const FrameRecord& frame, const FieldChoice& field,
                          const ContourOptions& options) {
  if (options.arrows == ArrowField::Field)
    if (const auto problem = directionProblem(field.name)) throw Error("vectors: " + *problem);
  const MeshRecord& mesh = meshOf(model, frame);
  ContourParts parts;
  const bool alongNormal = options.slice && options.view.name == "auto";
  parts.axes = alongNormal ? viewFrom(options.slice->normal) : viewAxes(options.view, model.dim);
  parts.displacement = options.warp * frame.displacement;
  if (options.tools) parts.tools = shownTools(model, frame, options.warp);
  const FieldMesh meshes(model, frame, field.name);
  const Subdivision ofLines = firstCells(mesh, model, parts, options);
  const bool allHaveIt = &meshes.with() == &mesh || field.faces;  // no body has a field of contact faces
  makeBody(parts, meshes.with(), allHaveIt ? ofLines : firstCells(meshes.with(), model, parts, options),
           frame, field, options);
  parts.box = boxOf(*parts.body);
  if (meshes.without() != nullptr) {
    const MeshRecord& without = *meshes.without();
    parts.plain =
        BodySurface(without, firstCells(without, model, parts, options)).displaced(parts.displacement);
    parts.box.extend(boxOf(*parts.plain));
  }
  parts.outline = bodyOutline(mesh, parts.displacement, ofLines);
  const int ofUndeformed = subdivisionOf(model, options);
  if (options.undeformed) parts.undeformed = undeformedOutline(model, mesh, parts, ofUndeformed);
  if (options.cut || options.slice) {
    parts.plane = shownPlane(options, parts);
    const VolumeSections volumes(meshes, model, frame, field, options, parts);
    const PartSections sections{volumes.withValues(), volumes.withoutValues()};
    if (sections.withValues->GetNumberOfCells() == 0 &&
        (!sections.plain || sections.plain->GetNumberOfCells() == 0))
      throw planeMisses(options, parts, frame.index);
    cutParts(parts, sections, model, mesh, options, ofLines, ofUndeformed);
  } else if (options.knots) {
    parts.knots = knotLines(mesh, parts.displacement, ofLines);
  }
  if (options.controlNet) {
    FrameRecord shape;
    shape.mesh = frame.mesh;
    shape.displacement = parts.displacement;
    parts.net = controlNet(model, shape);
  }
  parts.eye = eyeOf(options, parts, model.dim);
  if (options.cut && parts.eye &&
      (parts.eye->position(parts.axes) - parts.plane->point).dot(parts.plane->normal) <= 0.0)
    throw Error(
        "cut: the eye is so near that it sees the plane from behind; choose another direction for the eye, or a "
        "smaller angle of perspective");
  if (options.arrows != ArrowField::None) {
    const auto surface = arrowSurface(parts, meshes.with(), model, frame, field, options);
    const bool isStress = options.arrows == ArrowField::Principal;
    addArrows(parts,
              options.arrows == ArrowField::Traction
                  ? tractionGround(model, frame)
                  : ArrowGround{.dim = model.dim,
                                .surface = surface,
                                .name = isStress ? "stress" : "displacement",
                                .unit = isStress ? model.stressUnit : model.lengthUnit},
              *surface, options);
  }
  parts.mark = options.mark;
  if (options.markExtremes) parts.extremes = extremesOf(parts, model, frame, field, options);
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
  // Colours end at 0 where a range does, and interpolation does not go round a corner at 0.
  const auto setDrawn = [&](vtkPolyData& surface, const Eigen::MatrixXd& values) {
    const Eigen::VectorXd drawn = range[0] < 0.0 ? field.drawnScalars(values) : field.scalars(values);
    surface.GetPointData()->SetScalars(makeArray("drawn", drawn.transpose(), {}));
  };
  std::optional<FieldChoice> chosen;  // in space `chooseInSpace` does it
  if (options.threshold && model.dim == 2) chosen = choosingField(model, frame, field, options);
  const auto withChosen = [&](Subdivision subdivision, const MeshRecord& ofMesh) {
    if (chosen) subdivision.refine(cells.ofThreshold(ofMesh, parts.displacement, *chosen));
    return subdivision;
  };
  PartSections sections = sectionsIn(parts, options);
  if (parts.plane && !options.subdivision) {
    const auto exact = [&](const MeshRecord& body, vtkPolyData& ofCells, const ValueTolerance* values) {
      return exactSection(body, parts.displacement, *parts.plane, ofCells, cells.positions(), values);
    };
    if (sections.withValues->GetNumberOfCells() > 0) {
      const SectionTriangles triangles = exact(meshes.with(), *sections.withValues, &cells.values());
      sections.withValues = triangles.surface;
      setDrawn(*sections.withValues, triangles.values);
    }
    if (sections.plain) sections.plain = exact(*meshes.without(), *sections.plain, nullptr).surface;
  }
  std::optional<Subdivision> ofBody;
  if (field.faces) {
    parts.body = trianglesAboutMiddles(*field.faces);
  } else {
    ofBody = withChosen(cells.ofValues(meshes.with(), parts.displacement), meshes.with());
    const BodySurface surface = trianglesOf(meshes.with(), *ofBody);
    parts.body = surface.displaced(parts.displacement);
    parts.bodyLattices = surface.lattices();
    setDrawn(*parts.body, surface.evaluate(field.coefficients));
    if (chosen) setChosen(*parts.body->GetPointData(), surface, *chosen);
  }
  if (meshes.without() != nullptr) {
    const MeshRecord& without = *meshes.without();
    const BodySurface plain = trianglesOf(without, cells.ofLines(without, parts.displacement));
    parts.plain = plain.displaced(parts.displacement);
    parts.plainLattices = plain.lattices();
  }
  // In space lines go along the cells, so that they do not go under them.
  const bool isInSpace = model.dim == 3 && !field.faces;
  const bool areAlike = isInSpace && &meshes.with() == &mesh;
  const Subdivision ofLines = areAlike ? *ofBody
                                       : withChosen(isInSpace ? cells.ofValues(mesh, parts.displacement)
                                                              : cells.ofLines(mesh, parts.displacement),
                                                    mesh);
  const Eigen::MatrixXd* along = chosen ? &chosen->coefficients : nullptr;
  const Subdivision ofUndeformed = cells.ofLines(model.mesh, {});
  parts.outline = bodyOutline(mesh, parts.displacement, ofLines, along);
  if (parts.undeformed) parts.undeformed = undeformedOutline(model, mesh, parts, ofUndeformed);
  if (parts.plane)
    cutParts(parts, sections, model, mesh, options, ofLines, ofUndeformed);
  else if (parts.knots)
    parts.knots = knotLines(mesh, parts.displacement, ofLines, along);
  if (chosen) keepBetween(parts, options.threshold->ends, *chosen);
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

namespace {

Eigen::AlignedBox2d bodiesBox(const ContourParts& parts, const std::optional<Eye>& eye) {
  if (parts.ghost) return boxOf(*parts.ghost, parts.axes, eye);
  Eigen::AlignedBox2d box = boxOf(*parts.body, parts.axes, eye);
  if (parts.plain) box.extend(boxOf(*parts.plain, parts.axes, eye));
  return box;
}

/// Of bodies as they are and were.
Eigen::AlignedBox2d shapesBox(const ContourParts& parts, const std::optional<Eye>& eye) {
  Eigen::AlignedBox2d box = bodiesBox(parts, eye);
  if (parts.undeformed) box.extend(boxOf(*parts.undeformed, parts.axes, eye));
  return box;
}

/// What is to be seen as an eye sees it; without one projected in parallel.
Eigen::AlignedBox2d contentWithoutTools(const ContourParts& parts, const std::optional<Eye>& eye) {
  Eigen::AlignedBox2d box = shapesBox(parts, eye);
  if (parts.net) box = grown(box.merged(boxOf(*parts.net, parts.axes, eye)), kDotRoom);
  if (parts.extremes || parts.mark) box = grown(box, kSignRoom);
  for (const auto& edges : {parts.arrows.edges, parts.arrows.darkEdges})
    if (edges) box.extend(boxOf(*edges, parts.axes, eye));
  return box;
}

}  // namespace

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

bool isSeen(const ContourParts& parts, const ContourOptions& options, const Eigen::Vector3d& place) {
  const Eigen::Vector2d seen =
      parts.eye ? Eigen::Vector2d(parts.eye->project(parts.axes, place)) : parts.axes * place;
  if (options.window && !options.window->contains(seen)) return false;
  if (!parts.plane) return true;
  const double before = (place - parts.plane->point).dot(parts.plane->normal.normalized());
  const double slack = 1e-5 * parts.box.diagonal().norm();
  return options.slice ? std::abs(before) <= slack : before <= slack;
}

double lengthOf(const ContourParts& parts) {
  if (parts.ghost) return parts.ghost->GetLength();
  if (!parts.plain || parts.plain->GetNumberOfPoints() == 0) return parts.body->GetLength();
  if (parts.body->GetNumberOfPoints() == 0) return parts.plain->GetLength();
  return boxOf(*parts.body).merged(boxOf(*parts.plain)).diagonal().norm();
}

Eigen::AlignedBox2d bodiesBox(const ContourParts& parts) {
  return bodiesBox(parts, parts.eye);
}

Eigen::AlignedBox2d contentOf(const ContourParts& parts, int dim) {
  Eigen::AlignedBox2d box = contentWithoutTools(parts, parts.eye);
  // Whether a tool is shown whole depends neither on how near the eye is nor on signs and arrows.
  const Eigen::AlignedBox2d near = grown(shapesBox(parts, std::nullopt), kToolReach);
  const Eigen::AlignedBox2d cut = grown(shapesBox(parts, parts.eye), kToolCut);
  for (const ShownTool& tool : parts.tools) {
    const bool asPoints = dim == 2 && recordedMesh(tool.record.shape) != nullptr;
    const Eigen::Matrix2Xd landmarks = landmarksOf(tool.record, parts, dim, parts.eye);
    const bool isNear = parts.eye && near.contains(boxOf(landmarksOf(tool.record, parts, dim, std::nullopt)));
    const Eigen::AlignedBox2d seen = isNear ? boxOf(landmarks) : seenOf(landmarks, asPoints, near, cut);
    if (!seen.isEmpty()) box.extend(seen);
  }
  return box;
}

}  // namespace burnish
