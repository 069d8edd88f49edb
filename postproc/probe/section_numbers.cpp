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
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/interruption.h"
#include "engine/nurbs/univariate_basis.h"
#include "postproc/draw/contour/shown_model.h"
#include "postproc/mesh/mesh_pieces.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/plane_section.h"
#include "postproc/mesh/tessellation.h"
#include "postproc/mesh/vtk_arrays.h"
#include "postproc/probe/body_locator.h"
#include "postproc/probe/numbers_table.h"
#include "postproc/probe/stress_tensor.h"

namespace burnish {
namespace {

/// Parts of a knot span, per direction: doubled until two sections in a row agree, as parts of the forces and moments that
/// the largest stress would have, and at most until the spans of a slab have so many cells together.
constexpr int kFirstParts = 2, kMostPartsInPlane = 64, kMostPartsInSpace = 16;
constexpr double kAgreement = 1e-5, kMostCells = 2e6;

/// Of the extent of the body: by so much the plane is moved out of faces between patches and of the body.
constexpr double kAside = 1e-9;

constexpr const char* kStress = "stress";

/// Positions in the frame at the points of a piece of its mesh, in space.
Eigen::MatrixXd positionsOf(const Tessellation& cells, const FrameRecord& frame) {
  return inSpace(cells.referencePoints() + cells.evaluate(frame.displacement));
}

/// Some slabs of a patch, and how many spans one of them has.
struct Slabs {
  std::vector<MeshPiece> pieces;
  double spansOfOne = 0.0;
};

/// How high control points lie over a plane.
Eigen::VectorXd heightsOver(const CutPlane& plane, const PatchRecord& patch, const FrameRecord& frame) {
  const Eigen::MatrixXd now = inSpace(patch.points + frame.displacement(Eigen::all, patch.nodes));
  return (now.colwise() - plane.point).transpose() * plane.normal;
}

/// Slabs of one span of a patch whose control points lie on both sides of a plane, of the direction in which they have the
/// fewest spans. heights: of the control points.
Slabs slabsAt(const MeshRecord& mesh, std::size_t number, const Eigen::VectorXd& heights) {
  const std::vector<DirectionRecord>& directions = mesh.patches[number].directions;
  double all = 1.0;
  for (const DirectionRecord& direction : directions) all *= basisOf(direction).numSpans();
  Slabs best;
  double fewest = std::numeric_limits<double>::infinity();
  Eigen::Index stride = 1;  // of the functions of the direction among those of the patch
  for (std::size_t d = 0; d < directions.size(); ++d) {
    const UnivariateBasis basis = basisOf(directions[d]);
    const Eigen::Index count = basis.numFunctions();
    Eigen::VectorXd low = Eigen::VectorXd::Constant(count, std::numeric_limits<double>::infinity()),
                    high = -low;
    for (Eigen::Index a = 0; a < heights.size(); ++a) {
      const Eigen::Index function = a / stride % count;
      low(function) = std::min(low(function), heights(a));
      high(function) = std::max(high(function), heights(a));
    }
    stride *= count;
    Slabs cut{{}, all / basis.numSpans()};
    for (int span = 0; span < basis.numSpans(); ++span) {
      const double from = low.segment(basis.firstFunction(span), basis.degree() + 1).minCoeff(),
                   to = high.segment(basis.firstFunction(span), basis.degree() + 1).maxCoeff(),
                   beyond = basis.family() == BasisFamily::Lagrange ? kLagrangeBulge * (to - from) : 0.0;
      if (from - beyond <= 0.0 && to + beyond >= 0.0) cut.pieces.push_back({number, d, span, 1});
    }
    const double spans = cut.spansOfOne * static_cast<double>(cut.pieces.size());
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

  /// All of a section of a slab. components: of the stress at its points.
  void add(vtkPolyData& section, const std::vector<std::string>& components) {
    vtkDataArray& stress = *section.GetPointData()->GetArray(kStress);
    Eigen::VectorXd values(std::ssize(components));
    std::vector<Sample> samples;
    for (vtkIdType id = 0; id < section.GetNumberOfPoints(); ++id) {
      stress.GetTuple(id, values.data());
      samples.push_back(
          {Eigen::Vector3d(section.GetPoint(id)), symmetricTensor(components, values) * normal_});
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

  static Sample between(const Sample& a, const Sample& b, double share) {
    return {a.position + share * (b.position - a.position), a.traction + share * (b.traction - a.traction)};
  }

  static Sample middle(const Sample& a, const Sample& b) { return between(a, b, 0.5); }

  double stressOf(const Sample& sample) const { return normal_.dot(sample.traction); }

  /// Where tension becomes compression between two samples; nothing where it does not.
  std::optional<Sample> changeBetween(const Sample& a, const Sample& b) const {
    const double from = stressOf(a), to = stressOf(b);
    if (!(from * to < 0.0)) return std::nullopt;
    return between(a, b, from / (from - to));
  }

  void addSegment(const Sample& a, const Sample& b) {
    if (const auto change = changeBetween(a, b)) {
      addOfOneSign(a, *change);
      addOfOneSign(*change, b);
    } else {
      addOfOneSign(a, b);
    }
  }

  /// Cut where the stress changes its sign, so that tension and compression are exact for a linear one.
  void addTriangle(const Sample& a, const Sample& b, const Sample& c) {
    const auto ab = changeBetween(a, b), bc = changeBetween(b, c), ca = changeBetween(c, a);
    if (ab && ca) return addCut(a, b, c, *ab, *ca);
    if (bc && ab) return addCut(b, c, a, *bc, *ab);
    if (ca && bc) return addCut(c, a, b, *ca, *bc);
    addOfOneSign(a, b, c);
  }

  /// A triangle whose first corner has another sign than the others. next, last: the changes beside it.
  void addCut(const Sample& a, const Sample& b, const Sample& c, const Sample& next, const Sample& last) {
    addOfOneSign(a, next, last);
    addOfOneSign(next, b, c);
    addOfOneSign(next, c, last);
  }

  /// Simpson's rule.
  void addOfOneSign(const Sample& a, const Sample& b) {
    const double length = (b.position - a.position).norm();
    add(a, length / 6.0);
    add(middle(a, b), length * 4.0 / 6.0);
    add(b, length / 6.0);
  }

  /// By the middles of edges, exact for polynomials of second degree.
  void addOfOneSign(const Sample& a, const Sample& b, const Sample& c) {
    const double third = (b.position - a.position).cross(c.position - a.position).norm() / 6.0;
    add(middle(a, b), third);
    add(middle(b, c), third);
    add(middle(c, a), third);
    for (const Sample& corner : {a, b, c}) notePeak(corner);
  }

  void notePeak(const Sample& sample) { sums_.largest = std::max(sums_.largest, std::abs(stressOf(sample))); }

  void add(const Sample& sample, double weight) {
    if (isOfRevolution_) weight *= 2.0 * std::numbers::pi * sample.position.x();
    const double stress = stressOf(sample);
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

SectionNumbers numbersOf(const MeshRecord& mesh, const FrameRecord& frame,
                         const std::vector<MeshPiece>& slabs, const CutPlane& plane, int parts,
                         bool isOfRevolution) {
  Sums sums(plane.normal, isOfRevolution);
  const FieldRecord& stress = frame.fields.at(kStress);
  for (const MeshPiece& slab : slabs) {
    throwIfInterrupted();
    const Tessellation cells(mesh, parts, &slab);
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(makePoints(positionsOf(cells, frame)));
    grid->SetCells(cells.dim() == 2 ? VTK_QUAD : VTK_HEXAHEDRON, makeCells(cells.cells()));
    grid->GetPointData()->AddArray(makeArray(kStress, cells.evaluate(stress.values), {}));
    sums.add(*sectionOf(*grid, plane), stress.components);
  }
  return sums.numbers();
}

/// The largest difference of areas, forces and moments, see `SectionNumbers::unsettled`.
double difference(const SectionNumbers& one, const SectionNumbers& other, int dim) {
  const double size = dim == 2 ? other.area : std::sqrt(other.area);
  const double force =
      std::max({std::abs(one.tension - other.tension), (one.traction - other.traction).norm(),
                (one.moment - other.moment).norm() / size});
  const double most = other.area * other.largest;
  const double ofForces = force > 0.0 ? force / most : 0.0;
  return other.area > 0.0 ? std::max(std::abs(one.area - other.area) / other.area, ofForces) : 0.0;
}

/// The numbers of ever finer cells, until they stay or there would be too many; without area where the plane cuts nothing.
SectionNumbers settledNumbers(const ModelRecord& model, const FrameRecord& frame, const CutPlane& plane,
                              bool isOfRevolution) {
  const MeshRecord& mesh = meshOf(model, frame);
  std::vector<MeshPiece> slabs;
  double spans = 1.0;
  for (std::size_t patch = 0; patch < mesh.patches.size(); ++patch) {
    const Slabs cut = slabsAt(mesh, patch, heightsOver(plane, mesh.patches[patch], frame));
    if (!cut.pieces.empty()) spans = std::max(spans, cut.spansOfOne);
    std::ranges::copy(cut.pieces, std::back_inserter(slabs));
  }
  const int most = model.dim == 2 ? kMostPartsInPlane : kMostPartsInSpace;
  SectionNumbers numbers = numbersOf(mesh, frame, slabs, plane, kFirstParts, isOfRevolution);
  for (int parts = 2 * kFirstParts; parts <= most && spans * std::pow(parts, model.dim) <= kMostCells;
       parts *= 2) {
    SectionNumbers finer = numbersOf(mesh, frame, slabs, plane, parts, isOfRevolution);
    finer.unsettled = difference(numbers, finer, model.dim);
    numbers = finer;
    if (numbers.unsettled <= kAgreement) break;
  }
  return numbers;
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
  return namesOfColumns(kSectionNumbers);
}

SectionNumbers sectionNumbers(const ModelRecord& model, const FrameRecord& frame, const CutPlane& plane,
                              const std::vector<std::string>& bodies) {
  if (!frame.fields.contains(kStress))
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
    const CutPlane through{plane.point, plane.normal.normalized()};
    double extent = 0.0;
    for (const PatchRecord& patch : meshOf(chosen, of).patches)
      extent = std::max(extent, heightsOver(through, patch, of).cwiseAbs().maxCoeff());
    // Beside the plane on one of its sides, as it may be a face of the body, of which it cuts nothing on the other one.
    for (const double aside : {kAside, -kAside})
      if (const auto numbers = settledNumbers(
              chosen, of, {through.point + aside * extent * through.normal, through.normal}, isOfRevolution);
          numbers.area > 0.0)
        return numbers;
    throw Error("section: the plane does not cut the deformed body; expected one that does");
  });
}

std::string tableOf(const std::vector<SectionNumbersAt>& rows, const DerivedUnits& units,
                    const std::string& stressUnit) {
  return numbersCsv(kSectionNumbers, rows,
                    [&](SectionUnit unit) { return unitText(unit, units, stressUnit); });
}

}  // namespace burnish
