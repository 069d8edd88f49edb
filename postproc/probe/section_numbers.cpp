#include "postproc/probe/section_numbers.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/core/csv.h"
#include "engine/core/error.h"
#include "engine/core/interruption.h"
#include "postproc/draw/contour/shown_model.h"
#include "postproc/mesh/mesh_pieces.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/plane_section.h"
#include "postproc/mesh/tessellation.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

/// Parts of a knot span, per direction: doubled until two sections in a row agree, as parts of the forces and moments that
/// the largest stress would have.
constexpr int kFirstParts = 2, kMostPartsInPlane = 64, kMostPartsInSpace = 16;
constexpr double kAgreement = 1e-5;

constexpr const char* kStress = "stress";

/// Positions in the frame at the points of a piece of its mesh, in space.
Eigen::MatrixXd positionsOf(const Tessellation& cells, const FrameRecord& frame) {
  return inSpace(cells.referencePoints() + cells.evaluate(frame.displacement));
}

/// Slabs of one span of a patch that the plane may cut, of the direction in which they have the fewest spans.
std::vector<MeshPiece> slabsAt(const MeshRecord& mesh, std::size_t patch, const FrameRecord& frame,
                               const CutPlane& plane) {
  constexpr double kSlack = 0.25;  // of the extent of its points: how far a slab may go beyond them
  std::vector<MeshPiece> best;
  double fewest = std::numeric_limits<double>::infinity();
  const std::vector<DirectionRecord>& directions = mesh.patches[patch].directions;
  double all = 1.0;
  for (const DirectionRecord& direction : directions) all *= basisOf(direction).numSpans();
  for (std::size_t direction = 0; direction < directions.size(); ++direction) {
    const int numSlabs = basisOf(directions[direction]).numSpans();
    std::vector<MeshPiece> cut;
    for (int span = 0; span < numSlabs; ++span) {
      const MeshPiece slab{patch, direction, span, 1};
      const Eigen::MatrixXd points = positionsOf(Tessellation(mesh, 1, &slab), frame);
      const Eigen::VectorXd heights =
          (points.colwise() - plane.point).transpose() * plane.normal.normalized();
      const double low = heights.minCoeff(), high = heights.maxCoeff(), beyond = kSlack * (high - low);
      if (low - beyond <= 0.0 && high + beyond >= 0.0) cut.push_back(slab);
    }
    const double spans = all / numSlabs * static_cast<double>(cut.size());
    if (spans >= fewest) continue;
    fewest = spans;
    best = std::move(cut);
  }
  return best;
}

/// Integrals over a section.
class Sums {
 public:
  Sums(const Eigen::Vector3d& normal, bool isOfRevolution)
      : normal_(normal), isOfRevolution_(isOfRevolution) {}

  /// All of a section of a slab; stress: at its points, components xx, yy, zz, xy, yz, zx.
  void add(vtkPolyData& section) {
    vtkDataArray& stress = *section.GetPointData()->GetArray(kStress);
    std::vector<Sample> samples;
    for (vtkIdType id = 0; id < section.GetNumberOfPoints(); ++id) {
      Eigen::Matrix<double, 6, 1> s;
      for (int k = 0; k < 6; ++k) s(k) = stress.GetComponent(id, k);
      const Eigen::Matrix3d tensor =
          (Eigen::Matrix3d() << s(0), s(3), s(5), s(3), s(1), s(4), s(5), s(4), s(2)).finished();
      samples.push_back({Eigen::Vector3d(section.GetPoint(id)), tensor * normal_});
    }
    vtkNew<vtkIdList> ids;
    for (vtkIdType cell = 0; cell < section.GetNumberOfCells(); ++cell) {
      section.GetCellPoints(cell, ids);
      const auto corner = [&](vtkIdType k) { return samples[static_cast<std::size_t>(ids->GetId(k))]; };
      if (ids->GetNumberOfIds() == 2)
        addSegment(corner(0), corner(1));
      else
        for (vtkIdType k = 2; k < ids->GetNumberOfIds(); ++k)
          addTriangle(corner(0), corner(k - 1), corner(k));
    }
  }

  SectionNumbers numbers() const {
    SectionNumbers numbers = sums_;
    if (numbers.area > 0.0) numbers.moment -= (first_ / numbers.area).cross(numbers.traction);
    if (isOfRevolution_) {  // what points in all directions round the axis is in balance
      numbers.traction = numbers.force * normal_;
      numbers.moment.setZero();
    }
    return numbers;
  }

 private:
  struct Sample {
    Eigen::Vector3d position, traction;
  };

  static Sample middle(const Sample& a, const Sample& b) {
    return {0.5 * (a.position + b.position), 0.5 * (a.traction + b.traction)};
  }

  /// Simpson's rule.
  void addSegment(const Sample& a, const Sample& b) {
    const double length = (b.position - a.position).norm();
    add(a, length / 6.0);
    add(middle(a, b), length * 4.0 / 6.0);
    add(b, length / 6.0);
  }

  /// By the middles of edges, exact for polynomials of second degree.
  void addTriangle(const Sample& a, const Sample& b, const Sample& c) {
    const double third = (b.position - a.position).cross(c.position - a.position).norm() / 6.0;
    add(middle(a, b), third);
    add(middle(b, c), third);
    add(middle(c, a), third);
    for (const Sample& corner : {a, b, c}) notePeak(corner);
  }

  void notePeak(const Sample& sample) {
    sums_.largest = std::max(sums_.largest, std::abs(normal_.dot(sample.traction)));
  }

  void add(const Sample& sample, double weight) {
    if (isOfRevolution_) weight *= 2.0 * std::numbers::pi * sample.position.x();
    const double stress = normal_.dot(sample.traction);
    sums_.area += weight;
    sums_.force += weight * stress;
    (stress > 0.0 ? sums_.tension : sums_.compression) += weight * stress;
    sums_.traction += weight * sample.traction;
    sums_.moment += weight * sample.position.cross(sample.traction);
    first_ += weight * sample.position;
    notePeak(sample);
  }

  Eigen::Vector3d normal_;
  bool isOfRevolution_;
  SectionNumbers sums_;  ///< the moment about the origin
  Eigen::Vector3d first_ = Eigen::Vector3d::Zero();
};

/// xx, yy, zz, xy, yz, zx at the points, whatever components the field has.
Eigen::MatrixXd stressAt(const Tessellation& cells, const FieldRecord& field) {
  constexpr std::array<const char*, 6> kOrder{"xx", "yy", "zz", "xy", "yz", "zx"};
  const Eigen::MatrixXd values = cells.evaluate(field.values);
  Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(6, values.cols());
  for (std::size_t k = 0; k < field.components.size(); ++k) {
    const auto place = std::ranges::find(kOrder, field.components[k]);
    if (place != kOrder.end()) stress.row(place - kOrder.begin()) = values.row(static_cast<Eigen::Index>(k));
  }
  return stress;
}

SectionNumbers numbersOf(const MeshRecord& mesh, const FrameRecord& frame,
                         const std::vector<MeshPiece>& slabs, const CutPlane& plane, int parts,
                         bool isOfRevolution) {
  Sums sums(plane.normal.normalized(), isOfRevolution);
  for (const MeshPiece& slab : slabs) {
    throwIfInterrupted();
    const Tessellation cells(mesh, parts, &slab);
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(makePoints(positionsOf(cells, frame)));
    grid->SetCells(cells.dim() == 2 ? VTK_QUAD : VTK_HEXAHEDRON, makeCells(cells.cells()));
    grid->GetPointData()->AddArray(makeArray(kStress, stressAt(cells, frame.fields.at("stress")), {}));
    sums.add(*sectionOf(*grid, plane));
  }
  return sums.numbers();
}

/// Whether forces and moments are the same but for `kAgreement` of what the largest stress would make of the section.
bool agree(const SectionNumbers& one, const SectionNumbers& other, int dim) {
  const double force = other.area * other.largest;
  const double size = dim == 2 ? other.area : std::sqrt(other.area);
  return std::abs(one.area - other.area) <= kAgreement * other.area &&
         (one.traction - other.traction).norm() <= kAgreement * force &&
         (one.moment - other.moment).norm() <= kAgreement * force * size;
}

std::string unitText(SectionUnit unit, const DerivedUnits& units, const std::string& stressUnit) {
  switch (unit) {
    case SectionUnit::Area:
      return units.area;
    case SectionUnit::Force:
      return units.force;
    case SectionUnit::Stress:
      return stressUnit;
    case SectionUnit::Moment:
      return units.energy;
    default:
      return "";
  }
}

}  // namespace

double SectionNumbers::balance() const {
  return largest > 0.0 ? std::abs(force) / (area * largest) : std::numeric_limits<double>::quiet_NaN();
}

std::vector<std::string> sectionNumberNames() {
  std::vector<std::string> names;
  for (const SectionNumberRow& row : kSectionNumbers) names.emplace_back(row.name);
  return names;
}

SectionNumbers sectionNumbers(const ModelRecord& model, const FrameRecord& frame, const CutPlane& plane,
                              const std::vector<std::string>& bodies) {
  if (!frame.fields.contains("stress"))
    throw Error(fmt::format("section: frame {} has no stress; expected a frame with it", frame.index));
  const bool isOfRevolution = isAxisymmetric(model);
  if (model.dim == 2 && plane.normal.z() != 0.0)
    throw Error(
        "section: found a plane that is not across a plane body; expected x=V or y=V, or a normal with NZ 0");
  if (isOfRevolution && (plane.normal.x() != 0.0 || plane.normal.y() == 0.0))
    throw Error("section: found a plane that is not across the axis of a body of revolution; expected y=V");
  PictureOptions shown;
  shown.bodies = bodies;
  return withShownModel(model, frame, shown, [&](const ModelRecord& chosen, const FrameRecord& of) {
    const MeshRecord& mesh = meshOf(chosen, of);
    std::vector<MeshPiece> slabs;
    for (std::size_t patch = 0; patch < mesh.patches.size(); ++patch)
      std::ranges::copy(slabsAt(mesh, patch, of, plane), std::back_inserter(slabs));
    const int most = model.dim == 2 ? kMostPartsInPlane : kMostPartsInSpace;
    SectionNumbers numbers = numbersOf(mesh, of, slabs, plane, kFirstParts, isOfRevolution);
    for (int parts = 2 * kFirstParts; parts <= most; parts *= 2) {
      const SectionNumbers finer = numbersOf(mesh, of, slabs, plane, parts, isOfRevolution);
      const bool stays = agree(numbers, finer, model.dim);
      numbers = finer;
      if (stays) break;
    }
    if (!(numbers.area > 0.0))
      throw Error("section: the plane does not cut the deformed body; expected one that does");
    return numbers;
  });
}

std::string tableOf(const std::vector<SectionNumbersAt>& rows, const DerivedUnits& units,
                    const std::string& stressUnit) {
  const bool named = std::ranges::any_of(rows, [](const SectionNumbersAt& row) { return !row.run.empty(); });
  std::vector<std::string> titles{"time"};
  if (named) titles.insert(titles.begin(), "run");
  for (const SectionNumberRow& row : kSectionNumbers)
    titles.push_back(labelled(row.name, unitText(row.unit, units, stressUnit)));
  std::string text = csvRow(titles) + "\n";
  for (const SectionNumbersAt& row : rows) {
    std::vector<std::string> cells{fmt::format("{}", row.time)};
    if (named) cells.insert(cells.begin(), row.run);
    for (const SectionNumberRow& number : kSectionNumbers)
      cells.push_back(fmt::format("{}", number.value(row.numbers)));
    text += csvRow(cells) + "\n";
  }
  return text;
}

}  // namespace burnish
