#include "postproc/mesh/exact_section.h"

#include <tbb/parallel_for.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "postproc/mesh/middle_triangles.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

constexpr const char* kParameters = "parameters";
constexpr const char* kPatch = "patch";
constexpr const char* kCell = "cell";

/// Numbers of the corners of triangles that make up a convex polygon, in their order round it; none if they do not. of: the
/// points of the triangles.
std::vector<vtkIdType> cornersAround(vtkPolyData& section, const std::vector<vtkIdType>& of,
                                     const CutPlane& plane) {
  std::vector<vtkIdType> corners;
  std::vector<Eigen::Vector3d> places;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const vtkIdType id : of) {
    const Eigen::Vector3d place(section.GetPoint(id));
    if (std::ranges::find(places, place) != places.end()) continue;  // where an edge is cut, to the bit
    corners.push_back(id);
    places.push_back(place);
    middle += place;
  }
  if (corners.size() != of.size() / 3 + 2) return {};
  middle /= static_cast<double>(corners.size());
  const Eigen::Vector3d right = plane.normal.unitOrthogonal(), up = plane.normal.normalized().cross(right);
  std::vector<std::pair<double, vtkIdType>> sorted;
  for (std::size_t k = 0; k < corners.size(); ++k)
    sorted.emplace_back(std::atan2(up.dot(places[k] - middle), right.dot(places[k] - middle)), corners[k]);
  std::ranges::sort(sorted);
  for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = sorted[k].second;
  return corners;
}

/// A section in triangles with one polygon for each cell that is cut.
vtkSmartPointer<vtkPolyData> polygonsOfCells(vtkPolyData& section, const CutPlane& plane) {
  const auto result = vtkSmartPointer<vtkPolyData>::New();
  if (section.GetNumberOfPolys() == 0) return &section;
  result->SetPoints(section.GetPoints());
  result->GetPointData()->ShallowCopy(section.GetPointData());
  vtkCellData& data = *result->GetCellData();
  data.CopyAllocate(section.GetCellData());
  vtkDataArray& cellOf = *section.GetCellData()->GetArray(kCell);
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkIdList> ids;
  const vtkIdType count = section.GetNumberOfCells();
  for (vtkIdType first = 0, last = 0; first < count; first = last) {
    std::vector<vtkIdType> points;
    for (; last < count && cellOf.GetTuple1(last) == cellOf.GetTuple1(first); ++last) {
      section.GetCellPoints(last, ids);
      points.insert(points.end(), ids->begin(), ids->end());
    }
    const std::vector<vtkIdType> corners = cornersAround(section, points, plane);
    const auto add = [&](const vtkIdType* begin, std::size_t size) {
      data.CopyData(section.GetCellData(), first,
                    polygons->InsertNextCell(static_cast<vtkIdType>(size), begin));
    };
    if (!corners.empty())
      add(corners.data(), corners.size());
    else
      for (std::size_t k = 0; k < points.size(); k += 3) add(&points[k], 3);
  }
  result->SetPolys(polygons);
  return result;
}

/// A patch that a plane cuts, where it stands.
class CutPatch {
 public:
  /// coefficients: of a field, components x nodes; null without values.
  CutPatch(const PatchRecord& record, const Eigen::MatrixXd& displacement, const CutPlane& plane,
           const Eigen::MatrixXd* coefficients)
      : patch_(patchGeometry<3>(record, displacement)), normal_(plane.normal.normalized()) {
    for (int d = 0; d < 3; ++d) {
      const std::vector<double>& breakpoints = patch_.basis().direction(d).breakpoints();
      ends_[static_cast<std::size_t>(d)] = {breakpoints.front(), breakpoints.back()};
    }
    if (coefficients == nullptr) return;
    coefficients_.resize(coefficients->rows(), std::ssize(record.nodes));
    for (Eigen::Index k = 0; k < coefficients_.cols(); ++k)
      coefficients_.col(k) = coefficients->col(record.nodes[static_cast<std::size_t>(k)]);
  }

  struct Point {
    Eigen::Vector3d xi, x;
    Eigen::VectorXd value{};
  };

  /// Parameters that are at an end of the patch but for their rounding, at that end.
  Eigen::Vector3d snapped(Eigen::Vector3d xi) const {
    constexpr double kRounding = 1e-12;
    for (Eigen::Index d = 0; d < 3; ++d) {
      const auto& [begin, end] = ends_[static_cast<std::size_t>(d)];
      for (const double at : {begin, end})
        if (std::abs(xi(d) - at) <= kRounding * (end - begin)) xi(d) = at;
    }
    return xi;
  }

  /// Whether all these parameters lie on one face of the patch.
  template <std::size_t N>
  bool isOnFace(const std::array<Eigen::Vector3d, N>& parameters) const {
    for (Eigen::Index d = 0; d < 3; ++d)
      for (const double end : ends_[static_cast<std::size_t>(d)])
        if (std::all_of(parameters.begin(), parameters.end(),
                        [&](const Eigen::Vector3d& xi) { return xi(d) == end; }))
          return true;
    return false;
  }

  /// The point at a position in the plane, from the parameters of one nearby. On a face of the patch, where the
  /// position need not lie: the point of the face nearest to it in the plane. If Newton's method does not arrive: the
  /// point at the parameters.
  Point pointAt(const Eigen::Vector3d& position, const Eigen::Vector3d& guess) const {
    constexpr int kMostSteps = 8;
    constexpr double kNear = 1e-12, kNearEnough = 1e-6;
    std::vector<Eigen::Index> free;
    for (Eigen::Index d = 0; d < 3; ++d)
      if (const auto& [begin, end] = ends_[static_cast<std::size_t>(d)]; guess(d) != begin && guess(d) != end)
        free.push_back(d);
    Eigen::Vector3d xi = guess;
    double size = 0.0, miss = 0.0;
    for (int step = 0; step < kMostSteps; ++step) {
      const Eigen::Vector3d gap = position - patch_.position(xi);
      const Eigen::Matrix3d slopes = patch_.jacobian(xi);
      size = slopes.colwise().norm().maxCoeff();
      const Eigen::MatrixXd along = slopes(Eigen::all, free);
      const Eigen::MatrixXd directions = directionsFor(along);
      const Eigen::VectorXd residual = directions.transpose() * gap;
      miss = residual.norm();
      if (miss <= kNear * size) break;
      const Eigen::VectorXd change = (directions.transpose() * along).colPivHouseholderQr().solve(residual);
      if (!change.allFinite()) break;
      for (std::size_t k = 0; k < free.size(); ++k) {
        const auto& [begin, end] = ends_[static_cast<std::size_t>(free[k])];
        xi(free[k]) = std::clamp(xi(free[k]) + change(static_cast<Eigen::Index>(k)), begin, end);
      }
    }
    if (miss > kNearEnough * size) return {guess, position, valueAt(guess)};
    return {xi, patch_.position(xi), valueAt(xi)};
  }

 private:
  /// In which the point is to be at its position: all of them inside the patch, on a face that of the normal and the
  /// one in which face and plane meet, on an edge the normal.
  Eigen::MatrixXd directionsFor(const Eigen::MatrixXd& along) const {
    if (along.cols() == 3) return Eigen::Matrix3d::Identity();
    Eigen::MatrixXd directions(3, along.cols());
    if (along.cols() > 0) directions.col(0) = normal_;
    if (along.cols() == 2) {
      const Eigen::Vector3d ofFace = Eigen::Vector3d(along.col(0)).cross(Eigen::Vector3d(along.col(1)));
      directions.col(1) = normal_.cross(ofFace).normalized();
    }
    return directions;
  }

  Eigen::VectorXd valueAt(const Eigen::Vector3d& xi) const {
    if (coefficients_.size() == 0) return {};
    const int span = patch_.findSpan(xi);
    return coefficients_(Eigen::all, patch_.basis().spanFunctions(span)) * patch_.shape(span, xi).R;
  }

  Patch<3> patch_;
  Eigen::Vector3d normal_;
  std::array<std::array<double, 2>, 3> ends_;
  Eigen::MatrixXd coefficients_;  ///< components x functions of the patch
};

using Corners = std::array<CutPatch::Point, 3>;

/// Into how many parts an edge goes: the same for both triangles that have it.
int partsOf(const CutPatch::Point& one, const CutPatch::Point& other, const CutPatch& patch,
            const PositionTolerance& positions, const ValueTolerance* values) {
  Eigen::AlignedBox2d around(Eigen::Vector2d(positions.axes * one.x));
  around.extend(Eigen::Vector2d(positions.axes * other.x));
  if (!around.intersects(positions.window)) return 1;
  const auto isTold = [&](const Eigen::VectorXd& value) {
    return value.size() > 1 || (value(0) > values->range[0] && value(0) < values->range[1]);
  };
  const Eigen::Vector3d xi = 0.5 * (one.xi + other.xi), x = 0.5 * (one.x + other.x);
  const CutPatch::Point middle = patch.pointAt(x, patch.snapped(xi));
  double worst = 0.0;  // difference over tolerance
  if (patch.isOnFace(std::array{one.xi, other.xi})) worst = (middle.x - x).norm() / positions.length;
  if (values != nullptr && (isTold(one.value) || isTold(other.value) || isTold(middle.value)))
    worst = std::max(worst, (middle.value - 0.5 * (one.value + other.value)).norm() / values->value);
  return std::clamp(static_cast<int>(std::ceil(std::sqrt(worst))), 1, kMostPartsOfEdge);
}

/// The points of a triangle whose edges go into so many parts as the one of most, in rows of fewer and fewer. Those on an
/// edge of fewer parts stand where its parts meet, so that triangles have the same points along their common edge.
/// ofEdges: from each corner to the next one.
std::vector<CutPatch::Point> pointsIn(const Corners& corners, const CutPatch& patch,
                                      const std::array<int, 3>& ofEdges) {
  const int parts = std::max({ofEdges[0], ofEdges[1], ofEdges[2]});
  std::vector<CutPatch::Point> points;
  for (int j = 0; j <= parts; ++j)
    for (int i = 0; i + j <= parts; ++i) {
      std::array<double, 3> shares{static_cast<double>(parts - i - j), static_cast<double>(i),
                                   static_cast<double>(j)};
      for (double& share : shares) share /= parts;
      for (std::size_t k = 0; k < 3; ++k) {
        if (shares[(k + 2) % 3] > 0.0) continue;
        const double share = std::round(shares[(k + 1) % 3] * ofEdges[k]) / ofEdges[k];
        shares[k] = 1.0 - share;
        shares[(k + 1) % 3] = share;
        shares[(k + 2) % 3] = 0.0;
      }
      const auto corner = std::find(shares.begin(), shares.end(), 1.0);
      if (corner != shares.end()) {
        points.push_back(corners[static_cast<std::size_t>(corner - shares.begin())]);
        continue;
      }
      Eigen::Vector3d x = Eigen::Vector3d::Zero(), xi = Eigen::Vector3d::Zero();
      for (std::size_t k = 0; k < 3; ++k) {
        x += shares[k] * corners[k].x;
        xi += shares[k] * corners[k].xi;
      }
      points.push_back(patch.pointAt(x, patch.snapped(xi)));
    }
  return points;
}

/// The triangles between points in rows of fewer and fewer, the first of which has the number `first`.
void addTriangles(int first, int parts, std::vector<int>& corners) {
  int row = first;
  for (int j = 0; j < parts; ++j) {
    const int above = row + parts - j + 1;
    for (int i = 0; i + j < parts; ++i) {
      corners.insert(corners.end(), {row + i, row + i + 1, above + i});
      if (i + j + 1 < parts) corners.insert(corners.end(), {row + i + 1, above + i + 1, above + i});
    }
    row = above;
  }
}

}  // namespace

void addParameters(vtkUnstructuredGrid& cells, const MeshRecord& mesh, int subdivision) {
  Eigen::Matrix3Xd all(3, cells.GetNumberOfPoints());
  Eigen::Index k = 0;
  for (const PatchRecord& patch : mesh.patches) {
    std::array<std::vector<double>, 3> rows;
    for (std::size_t d = 0; d < 3; ++d) rows[d] = subdividedSpans(basisOf(patch.directions[d]), subdivision);
    for (const double w : rows[2])
      for (const double v : rows[1])
        for (const double u : rows[0]) all.col(k++) << u, v, w;
  }
  cells.GetPointData()->AddArray(makeArray(kParameters, all, {}));
  std::vector<int> numbers(static_cast<std::size_t>(cells.GetNumberOfCells()));
  std::iota(numbers.begin(), numbers.end(), 0);
  cells.GetCellData()->AddArray(makeIntegers(kCell, numbers));
}

vtkSmartPointer<vtkPolyData> sectionOfCells(vtkUnstructuredGrid& cells, const CutPlane& plane) {
  // VTK's triangles of a cell do not divide mirror images alike.
  return trianglesAboutMiddles(*polygonsOfCells(*sectionOf(cells, plane, SectionPoints::OfEachCell), plane));
}

SectionTriangles exactSection(const MeshRecord& mesh, const Eigen::MatrixXd& displacement,
                              const CutPlane& plane, vtkPolyData& ofCells, const PositionTolerance& positions,
                              const ValueTolerance* values) {
  std::vector<std::optional<CutPatch>> patches(mesh.patches.size());
  vtkDataArray& patchOfCell = *ofCells.GetCellData()->GetArray(kPatch);
  vtkDataArray& parameters = *ofCells.GetPointData()->GetArray(kParameters);
  const auto numCells = static_cast<std::size_t>(ofCells.GetNumberOfCells());
  std::vector<std::size_t> patchOf(numCells);
  std::vector<Corners> coarse(numCells);
  for (std::size_t cell = 0; cell < numCells; ++cell) {
    const auto id = static_cast<vtkIdType>(cell);
    patchOf[cell] = static_cast<std::size_t>(patchOfCell.GetTuple1(id));
    std::optional<CutPatch>& patch = patches[patchOf[cell]];
    if (!patch)
      patch.emplace(mesh.patches[patchOf[cell]], displacement, plane,
                    values == nullptr ? nullptr : &values->coefficients);
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    ofCells.GetCellPoints(id, count, ids);
    for (std::size_t k = 0; k < 3; ++k) {
      ofCells.GetPoint(ids[k], coarse[cell][k].x.data());
      parameters.GetTuple(ids[k], coarse[cell][k].xi.data());
    }
  }
  std::vector<std::vector<CutPatch::Point>> points(numCells);
  std::vector<int> parts(numCells);
  tbb::parallel_for(std::size_t{0}, numCells, [&](std::size_t cell) {
    const CutPatch& patch = *patches[patchOf[cell]];
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = patch.pointAt(coarse[cell][k].x, patch.snapped(coarse[cell][k].xi));
    std::array<int, 3> ofEdges{};
    for (std::size_t k = 0; k < 3; ++k)
      ofEdges[k] = partsOf(corners[k], corners[(k + 1) % 3], patch, positions, values);
    parts[cell] = *std::max_element(ofEdges.begin(), ofEdges.end());
    points[cell] = pointsIn(corners, patch, ofEdges);
  });
  std::vector<int> corners;
  int numPoints = 0;
  for (std::size_t cell = 0; cell < numCells; ++cell) {
    addTriangles(numPoints, parts[cell], corners);
    numPoints += static_cast<int>(points[cell].size());
  }
  Eigen::Matrix3Xd x(3, numPoints);
  SectionTriangles result{vtkSmartPointer<vtkPolyData>::New(), {}};
  if (values != nullptr) result.values.resize(values->coefficients.rows(), numPoints);
  Eigen::Index next = 0;
  for (const std::vector<CutPatch::Point>& some : points)
    for (const CutPatch::Point& point : some) {
      x.col(next) = point.x;
      if (values != nullptr) result.values.col(next) = point.value;
      ++next;
    }
  result.surface->SetPoints(makePoints(x));
  result.surface->SetPolys(
      makeCells(Eigen::Map<const Eigen::MatrixXi>(corners.data(), 3, std::ssize(corners) / 3)));
  result.surface->GetPointData()->SetNormals(
      makeArray("normals", plane.normal.normalized().replicate(1, numPoints), {}));
  return result;
}

}  // namespace burnish
