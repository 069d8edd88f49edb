#include "postproc/draw/contour/value_parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkCellArray.h>
#include <vtkClipPolyData.h>
#include <vtkContourFilter.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkNonMergingPointLocator.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/draw/contour/shape_lines.h"
#include "postproc/mesh/body_surface.h"
#include "postproc/mesh/chosen_bodies.h"
#include "postproc/mesh/outlines.h"
#include "postproc/mesh/plane_section.h"
#include "postproc/mesh/same_points.h"
#include "postproc/text/ticks.h"

namespace burnish {
namespace {

using Parts = vtkSmartPointer<vtkPolyData>;

constexpr const char* kDrawn = "drawn";
constexpr const char* kUphill = "uphill";  ///< point data: the gradient of the choosing field

/// The part of polygons and lines where `kChosen` is at least a value, or at most.
Parts beyond(const Parts& parts, double value, bool above) {
  if (std::isinf(value)) return parts;
  vtkNew<vtkPolyData> byValue;
  byValue->ShallowCopy(parts);
  byValue->GetPointData()->SetActiveScalars(kChosen);
  vtkNew<vtkClipPolyData> clip;
  clip->SetInputData(byValue);
  clip->SetValue(value);
  clip->SetInsideOut(!above);
  clip->SetLocator(vtkNew<vtkNonMergingPointLocator>());
  clip->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  clip->Update();
  const Parts result = clip->GetOutput();
  result->GetPointData()->SetActiveScalars(kDrawn);
  return result;
}

Parts between(const Parts& parts, const std::array<double, 2>& ends) {
  return beyond(beyond(parts, ends[0], true), ends[1], false);
}

/// Without points, but with what points have.
Parts emptySurface() {
  const Parts nothing = Parts::New();
  nothing->SetPoints(makePoints(Eigen::MatrixXd(3, 0)));
  nothing->GetPointData()->SetScalars(makeArray(kDrawn, Eigen::MatrixXd(1, 0), {}));
  nothing->GetPointData()->AddArray(makeArray(kChosen, Eigen::MatrixXd(1, 0), {}));
  nothing->GetPointData()->SetNormals(makeArray("normals", Eigen::MatrixXd(3, 0), {}));
  return nothing;
}

std::vector<double> finite(const std::array<double, 2>& ends) {
  std::vector<double> values;
  for (const double end : ends)
    if (std::isfinite(end)) values.push_back(end);
  return values;
}

/// Lines with `kValuesAlong` get `kChosen`.
void chooseAlong(vtkPolyData& lines, const FieldChoice& choosing) {
  auto* along = vtkDoubleArray::SafeDownCast(lines.GetPointData()->GetArray(kValuesAlong));
  const Eigen::Map<const Eigen::MatrixXd> values(along->GetPointer(0), along->GetNumberOfComponents(),
                                                 along->GetNumberOfTuples());
  lines.GetPointData()->AddArray(makeArray(kChosen, choosing.drawnScalars(values).transpose(), {}));
}

/// The rises of values between the points of a lattice in one direction, in one step, to second order: central differences, and of
/// three points at the ends.
Eigen::Vector4d riseAt(const Eigen::Matrix4Xd& values, const PatchLattice& lattice, const IndexBox::Index& at,
                       std::size_t direction) {
  const IndexBox box = lattice.points();
  const int last = box.extent[direction] - 1;
  const auto value = [&](int k) -> Eigen::Vector4d {
    IndexBox::Index index = at;
    index[direction] = k;
    return values.col(lattice.firstPoint + box.number(index));
  };
  const int k = at[direction], inwards = k == 0 ? 1 : -1;
  if (k > 0 && k < last) return (value(k + 1) - value(k - 1)) / 2.0;
  if (last == 1) return value(1) - value(0);
  return inwards * (4.0 * value(k + inwards) - value(k + 2 * inwards) - 3.0 * value(k)) / 2.0;
}

/// Points of lattices that are one point of the body, on the borders of patches, get the mean of their vectors.
void joinAtBorders(Eigen::Matrix3Xd& vectors, const Tessellation& cells, int numNodes) {
  constexpr double kSame = 1e-9;
  std::vector<int> border;
  for (const PatchLattice& lattice : cells.points().patches()) {
    const IndexBox box = lattice.points();
    for (int k = 0; k < box.size(); ++k) {
      const IndexBox::Index at = box.index(k);
      for (std::size_t d = 0; d < 3; ++d)
        if (at[d] == 0 || at[d] == box.extent[d] - 1) {
          border.push_back(lattice.firstPoint + k);
          break;
        }
    }
  }
  // Points of two bodies may lie in one place. Those of one body are the same mean of the same nodes, wherever these are: here
  // they are scattered, so that no others meet.
  const Eigen::Array3d steps(0.8191725134, 0.6710436067, 0.5497004779);
  Eigen::Matrix3Xd scattered(3, numNodes);
  for (Eigen::Index node = 0; node < numNodes; ++node)
    scattered.col(node) =
        (steps * static_cast<double>(node)).unaryExpr([](double x) { return x - std::floor(x); });
  const Eigen::MatrixXd places = cells.evaluate(scattered);
  const std::vector<vtkIdType> one = firstOfSame(*makePoints(places(Eigen::all, border)), kSame);

  Eigen::Matrix4Xd sums = Eigen::Matrix4Xd::Zero(4, std::ssize(border));
  for (std::size_t k = 0; k < border.size(); ++k) sums.col(one[k]) += vectors.col(border[k]).homogeneous();
  for (std::size_t k = 0; k < border.size(); ++k) vectors.col(border[k]) = sums.col(one[k]).hnormalized();
}

/// The gradient of values at the points of lattices, to second order, one at each point of the body; 0 where a lattice has
/// shrunk to a line or a point.
Eigen::Matrix3Xd gradientsOf(const Tessellation& cells, const Eigen::MatrixXd& x,
                             const Eigen::VectorXd& values, int numNodes) {
  constexpr double kFlat = 1e-9;
  Eigen::Matrix4Xd placesAndValues(4, x.cols());
  placesAndValues << x, values.transpose();
  Eigen::Matrix3Xd gradients(3, x.cols());
  for (const PatchLattice& lattice : cells.points().patches()) {
    const IndexBox box = lattice.points();
    for (int k = 0; k < box.size(); ++k) {
      Eigen::Matrix<double, 4, 3> rises;
      for (std::size_t d = 0; d < 3; ++d)
        rises.col(static_cast<Eigen::Index>(d)) = riseAt(placesAndValues, lattice, box.index(k), d);
      const Eigen::Matrix3d along = rises.topRows<3>();
      const Eigen::Vector3d rise = rises.row(3);
      const bool isFlat = std::abs(along.determinant()) <= kFlat * along.colwise().norm().prod();
      gradients.col(lattice.firstPoint + k) =
          isFlat ? Eigen::Vector3d::Zero().eval() : Eigen::Vector3d(along.transpose().inverse() * rise);
    }
  }
  joinAtBorders(gradients, cells, numNodes);
  return gradients;
}

/// Turns triangles to the side of their normals; points without a normal get that of their triangles.
void orient(vtkPolyData& surface, Eigen::Matrix3Xd normals) {
  const Eigen::Map<const Eigen::Matrix3Xd> x(static_cast<double*>(surface.GetPoints()->GetVoidPointer(0)), 3,
                                             surface.GetNumberOfPoints());
  Eigen::Matrix3Xd missing = Eigen::Matrix3Xd::Zero(3, normals.cols());
  vtkNew<vtkCellArray> turned;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < surface.GetNumberOfPolys(); ++cell) {
    surface.GetPolys()->GetCellAtId(cell, ids);
    const vtkIdType a = ids->GetId(0), b = ids->GetId(1), c = ids->GetId(2);
    Eigen::Vector3d across = (x.col(b) - x.col(a)).cross(x.col(c) - x.col(a));
    if (across.dot(normals.col(a) + normals.col(b) + normals.col(c)) < 0.0) {
      across = -across;
      turned->InsertNextCell({a, c, b});
    } else {
      turned->InsertNextCell({a, b, c});
    }
    for (const vtkIdType k : {a, b, c}) missing.col(k) += across;
  }
  for (Eigen::Index k = 0; k < normals.cols(); ++k)
    if (normals.col(k).isZero(0.0)) normals.col(k) = missing.col(k).normalized();
  surface.SetPolys(turned);
  surface.GetPointData()->SetNormals(makeArray("normals", normals, {}));
}

}  // namespace

Parts levelsOf(vtkDataSet& cells, const char* array, const std::vector<double>& values) {
  vtkNew<vtkContourFilter> contour;
  contour->SetInputData(&cells);
  contour->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, array);
  contour->ComputeNormalsOff();
  contour->ComputeGradientsOff();
  contour->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  contour->SetNumberOfContours(static_cast<int>(values.size()));
  for (std::size_t k = 0; k < values.size(); ++k) contour->SetValue(static_cast<int>(k), values[k]);
  contour->Update();
  const Parts result = contour->GetOutput();
  result->GetPointData()->SetActiveScalars(kDrawn);
  return result;
}

FieldChoice choosingField(const ModelRecord& model, const FrameRecord& frame, const FieldChoice& drawn,
                          const ContourOptions& options) {
  const std::string& name = options.threshold ? options.threshold->field : options.isosurfaces->field;
  if (name.empty() || name == drawn.name) return drawn;
  const char* key = options.threshold ? "threshold" : "isosurfaces";
  const std::vector<std::string> without = bodiesWithout(model, frame, name);
  if (!without.empty())
    throw Error(
        fmt::format("{}: {} has no {}; draw the others with body", key, fmt::join(without, ", "), name));
  return chooseField(model, frame, name, key);
}

std::string choiceNote(const ContourOptions& options, const FieldChoice& choosing,
                       const std::optional<std::array<double, 2>>& range) {
  if (options.threshold) return bandNote(*options.threshold, choosing.words, choosing.unit);
  const std::vector<double> values =
      options.isosurfaces ? options.isosurfaces->of(range) : std::vector<double>();
  return values.empty() ? "" : surfacesNote(values, choosing.words, choosing.unit);
}

std::string nothingChosen(const ContourOptions& options, const FieldChoice& drawn,
                          const std::optional<double>& time, const std::array<double, 2>& range) {
  const std::string& chosen = options.threshold ? options.threshold->field : options.isosurfaces->field;
  const std::string asked = options.threshold ? Spelling<ValueBand>::write(*options.threshold)
                                              : Spelling<ChosenValues>::write(*options.isosurfaces);
  return fmt::format("{}: found \"{}\"{}, which leaves nothing to be seen; {} goes from {} to {}",
                     options.threshold ? "threshold" : "isosurfaces", asked,
                     time ? fmt::format(", at t = {:.6g}", *time) : "", chosen.empty() ? drawn.name : chosen,
                     numberText(range[0], 4), numberText(range[1], 4));
}

void keepBetween(ContourParts& parts, const std::array<double, 2>& ends, const FieldChoice& choosing) {
  parts.ghost = parts.plain ? together(*parts.body, *parts.plain) : parts.body;
  parts.ghostOutline = parts.outline;
  parts.plain = nullptr;
  chooseAlong(*parts.outline, choosing);
  parts.outline = together(*between(parts.outline, ends), *levelsOf(*parts.body, kChosen, finite(ends)));
  parts.body = between(parts.body, ends);
  if (!parts.knots) return;
  chooseAlong(*parts.knots, choosing);
  parts.knots = between(parts.knots, ends);
}

ValueVolume::ValueVolume(const MeshRecord& mesh, const Eigen::MatrixXd& displacement, int perSpan,
                         const FieldChoice& drawn, const FieldChoice& choosing)
    : mesh_(mesh), displacement_(displacement), perSpan_(perSpan), drawn_(drawn), choosing_(choosing) {
  const Tessellation cells(mesh, perSpan);
  FrameRecord shape;
  shape.displacement = displacement;
  grid_ = makeGrid(cells, shape, true);
  grid_->GetPointData()->Initialize();
  setValues(*grid_->GetPointData(), cells);
  const Eigen::MatrixXd x = cells.referencePoints() + cells.evaluate(displacement);
  const Eigen::VectorXd values = choosing.drawnScalars(cells.evaluate(choosing.coefficients));
  grid_->GetPointData()->AddArray(makeArray(kUphill, gradientsOf(cells, x, values, mesh.numNodes), {}));
}

template <class Mesh>
void ValueVolume::setValues(vtkPointData& points, const Mesh& mesh) const {
  points.SetScalars(
      makeArray(kDrawn, drawn_.drawnScalars(mesh.evaluate(drawn_.coefficients)).transpose(), {}));
  setChosen(points, mesh, choosing_);
}

Parts ValueVolume::surfaceAt(const std::vector<double>& values, double sign) const {
  const Parts surface = levelsOf(*grid_, kChosen, values);
  if (surface->GetNumberOfPoints() == 0) return emptySurface();
  Eigen::Matrix3Xd normals(3, surface->GetNumberOfPoints());
  vtkDataArray* uphill = surface->GetPointData()->GetArray(kUphill);
  for (Eigen::Index k = 0; k < normals.cols(); ++k) {
    uphill->GetTuple(k, normals.col(k).data());
    normals.col(k) = sign * normals.col(k).normalized();
  }
  surface->GetPointData()->RemoveArray(kUphill);
  orient(*surface, std::move(normals));
  return surface;
}

Parts ValueVolume::surfacesAt(const std::vector<double>& values) const {
  return surfaceAt(values, -1.0);
}

Parts ValueVolume::capsAt(const Ends& ends) const {
  const Parts lower = std::isfinite(ends[0]) ? surfaceAt({ends[0]}, -1.0) : emptySurface(),
              upper = std::isfinite(ends[1]) ? surfaceAt({ends[1]}, 1.0) : emptySurface();
  return together(*lower, *upper);
}

Parts ValueVolume::faces() const {
  const BodySurface surface(mesh_, perSpan_);
  const Parts faces = surface.displaced(displacement_);
  setValues(*faces->GetPointData(), surface);
  return faces;
}

Parts ValueVolume::spanFaces() const {
  const BodySurface surface(mesh_, perSpan_, BodySurface::Faces::OfSpans);
  const Parts faces = surface.displaced(displacement_);
  setValues(*faces->GetPointData(), surface);
  return faces;
}

Parts ValueVolume::surfaceBetween(const Ends& ends) const {
  return together(*between(faces(), ends), *capsAt(ends));
}

Parts ValueVolume::sectionBetween(const CutPlane& plane, const Ends& ends) const {
  const Parts section = between(sectionOf(*grid_, plane), ends);
  section->GetPointData()->RemoveArray(kUphill);
  section->GetPointData()->SetNormals(
      makeArray("normals", plane.normal.normalized().replicate(1, section->GetNumberOfPoints()), {}));
  return section;
}

int volumeSubdivision(const MeshRecord& mesh, const Eigen::MatrixXd& displacement, const FieldChoice& field,
                      int least) {
  constexpr int kSamples = 4, kMost = 16;
  constexpr double kPartOfRange = 1e-3, kPartOfSize = 2.5e-4, kMostCells = 1.5e6;
  const Tessellation cells(mesh, kSamples);
  const Eigen::MatrixXd x = cells.referencePoints() + cells.evaluate(displacement);
  const Eigen::VectorXd values = field.drawnScalars(cells.evaluate(field.coefficients));
  const double range = values.maxCoeff() - values.minCoeff(),
               size = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
  Eigen::Vector3d bends = Eigen::Vector3d::Zero(), rises = Eigen::Vector3d::Zero();
  for (const PatchLattice& lattice : cells.points().patches()) {
    const IndexBox box = lattice.points();
    for (int k = 0; k < box.size(); ++k)
      for (std::size_t d = 0; d < 3; ++d) {
        const IndexBox::Index here = box.index(k);
        if (here[d] % kSamples == 0) continue;  // between spans there may be kinks, which no cells smooth
        IndexBox::Index before = here, behind = here;
        --before[d];
        ++behind[d];
        const auto at = [&](const IndexBox::Index& index) { return lattice.firstPoint + box.number(index); };
        const auto row = static_cast<Eigen::Index>(d);
        bends(row) =
            std::max(bends(row), (x.col(at(before)) - 2.0 * x.col(at(here)) + x.col(at(behind))).norm());
        rises(row) =
            std::max(rises(row), std::abs(values(at(before)) - 2.0 * values(at(here)) + values(at(behind))));
      }
  }
  // Linear interpolation is off by an eighth of the second difference over its interval.
  const double off = std::max(range > 0.0 ? rises.sum() / (8.0 * kPartOfRange * range) : 0.0,
                              bends.sum() / (8.0 * kPartOfSize * size));
  const int wanted = static_cast<int>(std::ceil(std::min(kSamples * std::sqrt(off), 1.0 * kMost)));
  const double spans = cells.numCells() / std::pow(kSamples, 3);
  const int allowed = std::max(1, static_cast<int>(std::floor(std::cbrt(kMostCells / spans))));
  return std::min(std::max(wanted, least), allowed);
}

void chooseInSpace(ContourParts& parts, const ModelRecord& model, const FrameRecord& frame,
                   const FieldChoice& field, const ContourOptions& options,
                   const std::optional<std::array<double, 2>>& range) {
  const FieldChoice choosing = choosingField(model, frame, field, options);
  const FieldMesh meshes(model, frame, field.name);
  const MeshRecord& mesh = meshes.with();
  const int perSpan =
      options.subdivision.value_or(volumeSubdivision(mesh, parts.displacement, choosing, model.subdivision));
  const ValueVolume volume(mesh, parts.displacement, perSpan, field, choosing);
  parts.ghost = parts.plain ? together(*parts.body, *parts.plain) : parts.body;
  parts.ghostOutline = parts.outline;
  parts.plain = parts.plainSection = parts.wholeBody = parts.wholePlain = nullptr;
  parts.bodyLattices.clear();
  parts.plainLattices.clear();
  const auto left = [&](const Parts& part) { return options.cut ? behind(*part, *parts.plane) : part; };

  const std::vector<double> values =
      options.threshold ? finite(options.threshold->ends) : options.isosurfaces->of(range);
  const auto inside = [&](const Parts& part) {
    return options.threshold ? between(part, options.threshold->ends) : part;
  };
  if (options.slice) {
    parts.body = volume.sectionBetween(*parts.plane, options.threshold->ends);
    parts.outline = rimOf(*parts.body);
  } else if (options.threshold) {
    const Parts caps = left(volume.capsAt(options.threshold->ends));
    const Parts edges = bodyOutline(mesh, parts.displacement, perSpan, &choosing.coefficients);
    chooseAlong(*edges, choosing);
    parts.outline = together(*left(inside(edges)), *rimOf(*caps));
    parts.body = left(volume.surfaceBetween(options.threshold->ends));
    if (options.cut) {
      parts.section = volume.sectionBetween(*parts.plane, options.threshold->ends);
      parts.outline = together(*parts.outline, *rimOf(*parts.section));
    }
  } else {
    parts.body = left(volume.surfacesAt(values));
    parts.section = nullptr;
    parts.outline = rimOf(*parts.body);
  }
  if (!options.knots) return;
  const Parts faces = volume.spanFaces();
  parts.knots = options.slice ? Parts::New() : left(levelsOf(*faces, kChosen, values));
  if ((options.cut && options.threshold) || options.slice)
    parts.knots = together(*parts.knots, *inside(sectionOf(*faces, *parts.plane)));
  if (!options.threshold || options.slice) return;
  const Parts onSurface = knotLines(mesh, parts.displacement, perSpan, &choosing.coefficients);
  chooseAlong(*onSurface, choosing);
  parts.knots = together(*parts.knots, *left(inside(onSurface)));
}

}  // namespace burnish
