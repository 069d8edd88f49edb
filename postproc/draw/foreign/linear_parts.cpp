#include "postproc/draw/foreign/linear_parts.h"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkDataSetAttributes.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "postproc/draw/foreign/copied_cell.h"
#include "postproc/draw/foreign/foreign_surface.h"

namespace burnish {
namespace {

/// Also false for polygons with curved edges, which have no shape functions in common.
bool isParted(int type) {
  return vtkCellTypes::IsLinear(static_cast<unsigned char>(type)) == 0 && type != VTK_QUADRATIC_POLYGON;
}

/// How a shape is parted: points in its parameters, and parts between these.
class PartedShape {
 public:
  struct Part {
    int type;
    std::vector<int> points;
  };

  /// As many parts as `count` along an edge.
  PartedShape(vtkCell& cell, int count) : n_(count) {
    const int edges = cell.GetNumberOfEdges();
    if (edges == kTetrahedron) partTetrahedron();
    if (edges == kPyramid) partPyramid(cell);
    if (edges == kTriangle) partTriangle(VTK_TRIANGLE, 0);
    if (edges == kSquare) partSquares(VTK_QUAD, 0);
    for (int k = 0; k < n_ && edges == kWedge; ++k) partTriangle(VTK_WEDGE, k);
    for (int k = 0; k < n_ && edges == kCube; ++k) partSquares(VTK_HEXAHEDRON, k);
  }

  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  const std::vector<Part>& parts() const { return parts_; }

 private:
  using Step = std::array<int, 3>;

  /// Numbers of edges, by which shapes differ.
  static constexpr int kTriangle = 3, kSquare = 4, kTetrahedron = 6, kPyramid = 8, kWedge = 9, kCube = 12;

  int pointAt(const Step& step, const Eigen::Vector3d& parameters) {
    const auto [found, isNew] = numbers_.try_emplace(step, static_cast<int>(points_.size()));
    if (isNew) points_.push_back(parameters);
    return found->second;
  }

  int pointAt(const Step& step) {
    return pointAt(step, Eigen::Vector3d(step[0], step[1], step[2]) / double(n_));
  }

  /// Of a flat shape between steps k and k + 1 along the third parameter, if the part is of a volume.
  void addPrism(int type, int k, const std::vector<std::array<int, 2>>& corners) {
    Part part{type, {}};
    for (const auto& [i, j] : corners) part.points.push_back(pointAt({i, j, k}));
    if (type == VTK_WEDGE || type == VTK_HEXAHEDRON)
      for (const auto& [i, j] : corners) part.points.push_back(pointAt({i, j, k + 1}));
    parts_.push_back(std::move(part));
  }

  void partSquares(int type, int k) {
    for (int j = 0; j < n_; ++j)
      for (int i = 0; i < n_; ++i) addPrism(type, k, {{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}});
  }

  void partTriangle(int type, int k) {
    for (int j = 0; j < n_; ++j)
      for (int i = 0; i + j < n_; ++i) {
        addPrism(type, k, {{i, j}, {i + 1, j}, {i, j + 1}});
        if (i + j + 1 < n_) addPrism(type, k, {{i + 1, j}, {i + 1, j + 1}, {i, j + 1}});
      }
  }

  /// The tetrahedron 1 ≥ x ≥ y ≥ z ≥ 0 is made of those into which the diagonals part small cubes.
  void partTetrahedron() {
    const std::array<std::array<int, 3>, 6> orders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {2, 1, 0}, {0, 2, 1}}};
    const auto isWithin = [&](const Step& s) { return n_ >= s[0] && s[0] >= s[1] && s[1] >= s[2]; };
    for (int x = 0; x < n_; ++x)
      for (int y = 0; y <= x; ++y)
        for (int z = 0; z <= y; ++z)
          for (std::size_t k = 0; k < orders.size(); ++k) {
            std::array<Step, 4> corners{{{x, y, z}}};
            for (std::size_t c = 1; c < 4; ++c) {
              corners[c] = corners[c - 1];
              ++corners[c][static_cast<std::size_t>(orders[k][c - 1])];
            }
            if (!std::ranges::all_of(corners, isWithin)) continue;
            if (k >= 3) std::swap(corners[2], corners[3]);  // those that are images in a mirror
            Part part{VTK_TETRA, {}};
            for (const Step& s : corners)
              part.points.push_back(pointAt(s, Eigen::Vector3d(s[0] - s[1], s[1] - s[2], s[2]) / double(n_)));
            parts_.push_back(std::move(part));
          }
  }

  /// Layers of upright pyramids and of those between them that hang from the layer above, and tetrahedra.
  void partPyramid(vtkCell& cell) {
    constexpr int kOnFirstEdge = 9;  // the point on the edge from the first corner to the apex
    const bool isCube = cell.GetParametricCoords()[3 * kOnFirstEdge] == 0.0;  // whose one face is the apex
    const auto at = [&](int i, int j, int k) {
      const double height = double(k) / n_, shift = isCube ? 0.0 : 0.5 * height;
      const double width = isCube && k < n_ ? 1.0 / (n_ - k) : 1.0 / n_;
      return k == n_ ? pointAt({0, 0, k}, {0.5, 0.5, 1.0})
                     : pointAt({i, j, k}, {shift + i * width, shift + j * width, height});
    };
    for (int k = 0; k < n_; ++k) {
      const int m = n_ - k;
      for (int j = 0; j < m; ++j)
        for (int i = 0; i < m; ++i) {
          parts_.push_back(
              {VTK_PYRAMID,
               {at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k), at(i, j, k + 1)}});
          const bool hasRight = i + 1 < m, hasNext = j + 1 < m;
          if (hasRight)
            parts_.push_back(
                {VTK_TETRA, {at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j, k + 1), at(i + 1, j, k + 1)}});
          if (hasNext)
            parts_.push_back(
                {VTK_TETRA, {at(i + 1, j + 1, k), at(i, j + 1, k), at(i, j, k + 1), at(i, j + 1, k + 1)}});
          if (hasRight && hasNext)
            parts_.push_back({VTK_PYRAMID,
                              {at(i, j, k + 1), at(i, j + 1, k + 1), at(i + 1, j + 1, k + 1),
                               at(i + 1, j, k + 1), at(i + 1, j + 1, k)}});
        }
    }
  }

  int n_;
  std::map<Step, int> numbers_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Part> parts_;
};

class LinearParts {
 public:
  /// count: parts along an edge of a curved cell.
  LinearParts(vtkUnstructuredGrid& cells, int count) : cells_(cells), count_(count) {
    points_->SetDataTypeToDouble();
    parts_->SetPoints(points_);
    parts_->GetPointData()->InterpolateAllocate(cells.GetPointData());
    parts_->GetCellData()->CopyAllOn();
    parts_->GetCellData()->CopyAllocate(cells.GetCellData());
    number_->SetName("cell");
  }

  void add(vtkIdType cell) {
    if (!isParted(cells_.GetCellType(cell))) {
      const auto pointOf = [&](vtkIdType id) { return this->pointOf({{id, 1.0}}, false); };
      addData(cell, copyCell(cells_, cell, *parts_, *copied_, pointOf));
      return;
    }
    vtkCell& curved = *cells_.GetCell(cell);
    const auto found = shapes_.try_emplace(cells_.GetCellType(cell), curved, count_).first;
    std::vector<double> shares(static_cast<std::size_t>(curved.GetNumberOfPoints()));
    std::vector<vtkIdType> numbers;
    for (const Eigen::Vector3d& point : found->second.points()) {
      curved.InterpolateFunctions(point.data(), shares.data());
      std::vector<std::pair<vtkIdType, double>> mixed;
      for (std::size_t k = 0; k < shares.size(); ++k)
        if (std::llround(kShareSteps * shares[k]) != 0)
          mixed.emplace_back(curved.GetPointId(static_cast<int>(k)), shares[k]);
      const bool isInside = mixed.size() == shares.size();  // on a face only its points have a share
      numbers.push_back(pointOf(std::move(mixed), isInside));
    }
    std::vector<vtkIdType> ids;
    for (const PartedShape::Part& part : found->second.parts()) {
      ids.clear();
      for (const int point : part.points) ids.push_back(numbers[static_cast<std::size_t>(point)]);
      addData(cell, parts_->InsertNextCell(part.type, static_cast<vtkIdType>(ids.size()), ids.data()));
    }
  }

  vtkSmartPointer<vtkUnstructuredGrid> finish() {
    parts_->GetCellData()->AddArray(number_);
    return parts_.Get();
  }

 private:
  /// Points of the cells and how much each has of a point, in whole steps: points of which the same have the same
  /// shares are one.
  using Mix = std::vector<std::pair<vtkIdType, long long>>;
  static constexpr double kShareSteps = 1 << 30;

  struct Hash {
    std::size_t operator()(const Mix& mix) const {
      std::size_t hash = 0;
      for (const auto& [id, steps] : mix)
        for (const long long part : {static_cast<long long>(id), steps})
          hash = hash * 0x9E3779B97F4A7C15U + static_cast<std::size_t>(part) + (hash >> 29U);
      return hash;
    }
  };

  vtkIdType pointOf(std::vector<std::pair<vtkIdType, double>> mixed, bool isOfOneCell) {
    std::ranges::sort(mixed);
    if (isOfOneCell) return newPoint(mixed);
    Mix mix;
    for (const auto& [id, share] : mixed) mix.emplace_back(id, std::llround(kShareSteps * share));
    const auto [found, isNew] = known_.try_emplace(std::move(mix), points_->GetNumberOfPoints());
    return isNew ? newPoint(mixed) : found->second;
  }

  vtkIdType newPoint(const std::vector<std::pair<vtkIdType, double>>& mixed) {
    vtkNew<vtkIdList> ids;
    std::vector<double> shares;
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    for (const auto& [id, share] : mixed) {
      ids->InsertNextId(id);
      shares.push_back(share);
      place += share * Eigen::Map<const Eigen::Vector3d>(cells_.GetPoint(id));
    }
    const vtkIdType number = points_->InsertNextPoint(place.data());
    parts_->GetPointData()->InterpolatePoint(cells_.GetPointData(), number, ids, shares.data());
    return number;
  }

  void addData(vtkIdType cell, vtkIdType part) {
    parts_->GetCellData()->CopyData(cells_.GetCellData(), cell, part);
    number_->InsertNextValue(cell);
  }

  vtkUnstructuredGrid& cells_;
  int count_;
  std::map<int, PartedShape> shapes_;  ///< by type of cell
  std::unordered_map<Mix, vtkIdType, Hash> known_;
  vtkNew<vtkIdList> copied_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkUnstructuredGrid> parts_;
  vtkNew<vtkIdTypeArray> number_;
};

/// Those of the cells where the function may have values between the ends.
std::vector<vtkIdType> reachedCells(vtkUnstructuredGrid& cells, const Eigen::VectorXd& of,
                                    const std::array<double, 2>& ends) {
  constexpr double kBeyondPoints =
      0.5;  // of the range at the points of a curved cell: what it has between them
  std::vector<vtkIdType> reached;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < cells.GetNumberOfCells(); ++cell) {
    cells.GetCellPoints(cell, ids);
    if (ids->GetNumberOfIds() == 0) continue;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const vtkIdType id : *ids) {
      low = std::min(low, of(id));
      high = std::max(high, of(id));
    }
    const double beyond = isParted(cells.GetCellType(cell)) ? kBeyondPoints * (high - low) : 0.0;
    if (low - beyond <= ends[1] && high + beyond >= ends[0]) reached.push_back(cell);
  }
  return reached;
}

}  // namespace

bool hasCurved(vtkUnstructuredGrid& cells) {
  for (vtkIdType cell = 0; cell < cells.GetNumberOfCells(); ++cell)
    if (vtkCellTypes::IsLinear(static_cast<unsigned char>(cells.GetCellType(cell))) == 0) return true;
  return false;
}

bool hasBezier(vtkUnstructuredGrid& cells) {
  for (vtkIdType cell = 0; cell < cells.GetNumberOfCells(); ++cell)
    if (cells.GetCellType(cell) >= VTK_BEZIER_CURVE && cells.GetCellType(cell) <= VTK_BEZIER_PYRAMID)
      return true;
  return false;
}

vtkSmartPointer<vtkUnstructuredGrid> linearParts(vtkUnstructuredGrid& cells, const Eigen::VectorXd& of,
                                                 const std::array<double, 2>& ends, vtkIdType most) {
  const std::vector<vtkIdType> reached = reachedCells(cells, of, ends);
  const vtkIdType curved =
      std::ranges::count_if(reached, [&](vtkIdType cell) { return isParted(cells.GetCellType(cell)); });
  int count = 1 << kCurvedParts;
  while (count > 2 && curved * count * count * count > most) count /= 2;
  LinearParts parts(cells, count);
  for (const vtkIdType cell : reached) parts.add(cell);
  const auto result = parts.finish();
  takeLengths(*result);
  return result;
}

void takeLengths(vtkPointSet& places) {
  vtkPointData& data = *places.GetPointData();
  vtkDataArray* vectors = data.GetArray("drawn_vector");
  if (!vectors) return;
  vtkDataArray& drawn = *data.GetArray("drawn");
  for (vtkIdType k = 0; k < drawn.GetNumberOfTuples(); ++k)
    drawn.SetComponent(k, 0, Eigen::Map<const Eigen::Vector3d>(vectors->GetTuple3(k)).norm());
  data.RemoveArray("drawn_vector");
}

}  // namespace burnish
