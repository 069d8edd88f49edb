#include "postproc/draw/foreign/foreign_surface.h"

#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkDoubleArray.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataNormals.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "postproc/draw/foreign/copied_cell.h"
#include "postproc/draw/foreign/linear_parts.h"
#include "postproc/mesh/poly_builder.h"

namespace burnish {
namespace {

constexpr double kSamePlace = 1e-8;  // of the diagonal

/// Numbers places; points nearer than `kSamePlace` have one number, but for rare neighbours.
class Places {
 public:
  explicit Places(double length)
      : unit_(length > 0.0 ? kSamePlace * length : 1.0), slots_(kFewestSlots, kNone) {}

  /// The number, and whether it is a new one.
  std::pair<vtkIdType, bool> number(const double* point) {
    const Key key = keyOf(point);
    vtkIdType& slot = slotOf(key);
    if (slot != kNone) return {slot, false};
    const auto added = static_cast<vtkIdType>(keys_.size());
    slot = added;
    keys_.push_back(key);
    if (2 * keys_.size() > slots_.size()) grow();
    return {added, true};
  }

 private:
  using Key = std::array<long long, 3>;
  static constexpr vtkIdType kNone = -1;
  static constexpr std::size_t kFewestSlots = 1024;

  Key keyOf(const double* point) const {
    Key key{};
    for (std::size_t d = 0; d < 3; ++d) key[d] = std::llround(point[d] / unit_);
    return key;
  }

  static std::size_t hashOf(const Key& key) {
    std::size_t hash = 0;
    for (const long long part : key) {
      hash = (hash ^ static_cast<std::size_t>(part)) * 0x9E3779B97F4A7C15U;
      hash ^= hash >> 32U;
    }
    return hash;
  }

  /// Where the number of a place is, or where it belongs: the first free slot from the one that its hash names.
  vtkIdType& slotOf(const Key& key) {
    const std::size_t mask = slots_.size() - 1;  // their number is a power of two
    std::size_t at = hashOf(key) & mask;
    while (slots_[at] != kNone && keys_[static_cast<std::size_t>(slots_[at])] != key) at = (at + 1) & mask;
    return slots_[at];
  }

  void grow() {
    slots_.assign(4 * slots_.size(), kNone);
    for (std::size_t k = 0; k < keys_.size(); ++k) slotOf(keys_[k]) = static_cast<vtkIdType>(k);
  }

  double unit_;
  std::vector<Key> keys_;         ///< by number
  std::vector<vtkIdType> slots_;  ///< numbers, so that meshes of millions of points need no memory for each
};

/// Of each kind of cell; -1 for numbers that no kind has.
std::array<int, VTK_NUMBER_OF_CELL_TYPES> allDimensions() {
  std::array<int, VTK_NUMBER_OF_CELL_TYPES> dimensions{};
  for (int type = 0; type < VTK_NUMBER_OF_CELL_TYPES; ++type) {
    const auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type));
    dimensions[static_cast<std::size_t>(type)] = cell ? cell->GetCellDimension() : -1;
  }
  return dimensions;
}

int dimensionOf(vtkUnstructuredGrid& grid, vtkIdType cell) {
  static const auto dimensions = allDimensions();
  return dimensions[static_cast<std::size_t>(grid.GetCellType(cell))];
}

bool isLinear(vtkUnstructuredGrid& grid, vtkIdType cell) {
  return vtkCellTypes::IsLinear(static_cast<unsigned char>(grid.GetCellType(cell))) != 0;
}

bool isGhost(vtkUnstructuredGrid& grid, vtkIdType cell) {
  vtkDataArray* ghosts = grid.GetCellData()->GetArray("vtkGhostType");
  constexpr int kDuplicateOrHidden = 1 | 32;
  return ghosts && (static_cast<int>(ghosts->GetComponent(cell, 0)) & kDuplicateOrHidden) != 0;
}

/// Puts cells of several grids together.
class CellCollector {
 public:
  CellCollector(vtkUnstructuredGrid& layout, double length) : places_(length) {
    points_->SetDataTypeToDouble();
    cells_->SetPoints(points_);
    for (auto [to, from] : {std::pair<vtkDataSetAttributes*, vtkDataSetAttributes*>{cells_->GetPointData(),
                                                                                    layout.GetPointData()},
                            {cells_->GetCellData(), layout.GetCellData()}}) {
      to->CopyAllOn();
      to->CopyAllocate(from);
    }
  }

  void add(vtkUnstructuredGrid& grid, vtkIdType cell) {
    std::vector<vtkIdType>& known = copied_[&grid];
    known.resize(static_cast<std::size_t>(grid.GetNumberOfPoints()), kNone);
    const vtkIdType added = copyCell(grid, cell, *cells_, *ids_, [&](vtkIdType id) {
      vtkIdType& number = known[static_cast<std::size_t>(id)];
      if (number == kNone) number = pointOf(grid, id);
      return number;
    });
    cells_->GetCellData()->CopyData(grid.GetCellData(), cell, added);
  }

  vtkSmartPointer<vtkUnstructuredGrid> finish() const { return cells_.Get(); }

 private:
  static constexpr vtkIdType kNone = -1;

  /// A point that was copied from a grid.
  struct Copy {
    const vtkUnstructuredGrid* grid;
    double drawn;            ///< 0 where nothing is drawn of points
    vtkIdType next = kNone;  ///< another one at its place
  };

  vtkIdType pointOf(vtkUnstructuredGrid& grid, vtkIdType id) {
    const double* point = grid.GetPoint(id);
    const auto [place, isNew] = places_.number(point);
    if (isNew) firstAt_.push_back(kNone);
    vtkDataArray* values = grid.GetPointData()->GetArray("drawn");
    const double drawn = values ? values->GetComponent(id, 0) : 0.0;
    const auto isSame = [&](vtkIdType number) {
      constexpr double kRounding = 1e-9;
      const Copy& copy = copies_[static_cast<std::size_t>(number)];
      if (copy.grid == &grid) return true;
      const bool isDrawnAlike = std::abs(copy.drawn - drawn) <= kRounding * std::abs(drawn) ||
                                (std::isnan(copy.drawn) && std::isnan(drawn));
      return isDrawnAlike && hasArrowsOf(number, grid, id);
    };
    vtkIdType* last = &firstAt_[static_cast<std::size_t>(place)];
    for (; *last != kNone; last = &copies_[static_cast<std::size_t>(*last)].next)
      if (isSame(*last)) return *last;
    const vtkIdType number = points_->InsertNextPoint(point);
    cells_->GetPointData()->CopyData(grid.GetPointData(), id, number);
    *last = number;
    copies_.push_back({&grid, drawn});
    return number;
  }

  /// Whether arrows show the same at a point that has been taken and at one of a grid.
  bool hasArrowsOf(vtkIdType taken, vtkUnstructuredGrid& grid, vtkIdType id) const {
    constexpr double kRounding = 1e-9;
    for (const char* name : {"vectors", "stress"}) {
      vtkDataArray* theirs = grid.GetPointData()->GetArray(name);
      vtkDataArray* ours = cells_->GetPointData()->GetArray(name);
      for (int k = 0; theirs && ours && k < theirs->GetNumberOfComponents(); ++k) {
        const double value = theirs->GetComponent(id, k);
        if (std::abs(ours->GetComponent(taken, k) - value) > kRounding * std::abs(value)) return false;
      }
    }
    return true;
  }

  Places places_;
  std::vector<vtkIdType> firstAt_;  ///< numbers of the first copies at places
  std::vector<Copy> copies_;        ///< by number
  std::unordered_map<const vtkUnstructuredGrid*, std::vector<vtkIdType>>
      copied_;  ///< numbers of points, by theirs
  vtkNew<vtkIdList> ids_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkUnstructuredGrid> cells_;
};

/// The faces in several grids that are faces of their volumes, or of straight ones parts of these between some of their
/// corners.
class HiddenFaces {
 public:
  HiddenFaces(const std::vector<vtkSmartPointer<vtkUnstructuredGrid>>& grids, double length)
      : places_(length) {
    for (const auto& grid : grids)
      for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
        if (dimensionOf(*grid, cell) == 2 && !isGhost(*grid, cell)) addFace(*grid, cell);
    if (facesAt_.empty()) return;
    for (const auto& grid : grids)
      for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
        if (dimensionOf(*grid, cell) == 3 && !isGhost(*grid, cell)) hideFacesOf(*grid, cell);
  }

  bool contains(vtkUnstructuredGrid& grid, vtkIdType cell) const { return hidden_.contains({&grid, cell}); }

 private:
  struct Face {
    std::vector<vtkIdType> places;  ///< sorted
    std::pair<const vtkUnstructuredGrid*, vtkIdType> cell;
  };

  std::vector<vtkIdType> sortedPlaces(vtkUnstructuredGrid& grid, vtkIdList& points) {
    std::vector<vtkIdType> found;
    for (const vtkIdType id : points) found.push_back(places_.number(grid.GetPoint(id)).first);
    std::ranges::sort(found);
    return found;
  }

  void addFace(vtkUnstructuredGrid& grid, vtkIdType cell) {
    vtkNew<vtkIdList> ids;
    grid.GetCellPoints(cell, ids);
    const std::vector<vtkIdType> places = sortedPlaces(grid, *ids);
    if (!places.empty()) facesAt_[places.front()].push_back({places, {&grid, cell}});
  }

  void hideFacesOf(vtkUnstructuredGrid& grid, vtkIdType cell) {
    vtkCell& volume = *grid.GetCell(cell);
    const bool isStraight = isLinear(grid, cell);
    for (int k = 0; k < volume.GetNumberOfFaces(); ++k) {
      const std::vector<vtkIdType> places = sortedPlaces(grid, *volume.GetFace(k)->GetPointIds());
      for (const vtkIdType place : places) {
        const auto found = facesAt_.find(place);
        if (found == facesAt_.end()) continue;
        for (const Face& face : found->second)
          if ((isStraight || face.places.size() == places.size()) &&
              std::ranges::includes(places, face.places))
            hidden_.insert(face.cell);
      }
    }
  }

  Places places_;
  std::unordered_map<vtkIdType, std::vector<Face>> facesAt_;  ///< by the first of their places
  std::set<std::pair<const vtkUnstructuredGrid*, vtkIdType>> hidden_;
};

double lengthOfAll(const std::vector<vtkSmartPointer<vtkUnstructuredGrid>>& grids) {
  double length = 0.0;
  for (const auto& grid : grids) length = std::max(length, grid->GetLength());
  return length;
}

/// Gives a copy of cells the first two parameters of curved ones in turn, so that they are right-handed in a mirror: of
/// curved cells VTK sees that faces are one if they are run through in opposite directions.
void turnCurved(vtkUnstructuredGrid& cells, vtkUnstructuredGrid& copy) {
  vtkNew<vtkUnstructuredGrid> turned;
  vtkNew<vtkIdList> copied;
  turned->Allocate(cells.GetNumberOfCells());
  vtkDataArray* degrees = copy.GetCellData()->GetHigherOrderDegrees();
  for (vtkIdType k = 0; k < cells.GetNumberOfCells(); ++k) {
    vtkCell& cell = *cells.GetCell(k);
    const double* parameters = cell.GetParametricCoords();
    if (cell.IsLinear() || parameters == nullptr) {
      copyCell(cells, k, *turned, *copied, [](vtkIdType id) { return id; });
      continue;
    }
    const Eigen::Map<const Eigen::Matrix3Xd> at(parameters, 3, cell.GetNumberOfPoints());
    std::vector<vtkIdType> ids;
    for (Eigen::Index point = 0; point < at.cols(); ++point) {
      Eigen::Index partner = 0;
      const Eigen::Vector3d wanted(at(1, point), at(0, point), at(2, point));
      (at.colwise() - wanted).colwise().squaredNorm().minCoeff(&partner);
      ids.push_back(cell.GetPointId(static_cast<int>(partner)));
    }
    turned->InsertNextCell(cell.GetCellType(), std::ssize(ids), ids.data());
    if (degrees == nullptr) continue;
    const double first = degrees->GetComponent(k, 0);
    degrees->SetComponent(k, 0, degrees->GetComponent(k, 1));
    degrees->SetComponent(k, 1, first);
  }
  turned->SetPoints(copy.GetPoints());
  turned->GetPointData()->ShallowCopy(copy.GetPointData());
  turned->GetCellData()->ShallowCopy(copy.GetCellData());
  copy.ShallowCopy(turned);
}

constexpr const char *kPlaces = "places", *kVolumes = "volumes", *kCells = "vtkOriginalCellIds";

/// The cells about the origin, with the places of their points and their numbers beside the values: of curved cells VTK takes points in
/// single precision, which is too coarse far from the origin, and makes such points, but values in double precision.
vtkSmartPointer<vtkUnstructuredGrid> withPlaces(vtkUnstructuredGrid& cells) {
  const auto result = vtkSmartPointer<vtkUnstructuredGrid>::New();
  result->ShallowCopy(&cells);
  vtkNew<vtkDoubleArray> places;
  places->DeepCopy(cells.GetPoints()->GetData());
  places->SetName(kPlaces);
  result->GetPointData()->AddArray(places);
  vtkNew<vtkIdTypeArray> numbers;  // VTK gives faces of curved volumes numbers of their own
  numbers->SetName(kVolumes);
  for (vtkIdType cell = 0; cell < cells.GetNumberOfCells(); ++cell) numbers->InsertNextValue(cell);
  result->GetCellData()->AddArray(numbers);
  vtkNew<vtkPoints> moved;
  moved->SetDataTypeToDouble();
  moved->SetNumberOfPoints(cells.GetNumberOfPoints());
  const Eigen::Vector3d middle(cells.GetCenter());
  for (vtkIdType k = 0; k < cells.GetNumberOfPoints(); ++k)
    moved->SetPoint(k, (Eigen::Vector3d(cells.GetPoint(k)) - middle).eval().data());
  result->SetPoints(moved);
  return result;
}

/// Moves the points of faces to the places that were kept.
void takePlaces(vtkPolyData& faces) {
  vtkNew<vtkPoints> points;
  points->SetData(faces.GetPointData()->GetArray(kPlaces));
  faces.SetPoints(points);
  faces.GetPointData()->RemoveArray(kPlaces);
}

Eigen::Matrix3Xd placesOf(vtkPointSet& set, vtkIdList& ids) {
  Eigen::Matrix3Xd places(3, ids.GetNumberOfIds());
  for (vtkIdType k = 0; k < places.cols(); ++k) set.GetPoint(ids.GetId(k), places.col(k).data());
  return places;
}

/// Whether all corners of a face lie on a line.
bool isOnALine(vtkPolyData& faces, vtkIdList& corners) {
  constexpr double kFlat = 1e-9;  // of the length
  const Eigen::Matrix3Xd x = placesOf(faces, corners);
  const Eigen::Matrix3Xd from = x.colwise() - x.col(0);
  Eigen::Index farthest = 0;
  const double length = std::sqrt(from.colwise().squaredNorm().maxCoeff(&farthest));
  const Eigen::Vector3d along = from.col(farthest).stableNormalized();
  return (from - along * (along.transpose() * from)).colwise().norm().maxCoeff() <= kFlat * length;
}

/// Of corners of which one follows another each once, as of triangles that are written as quadrilaterals.
std::vector<vtkIdType> withoutRepeated(vtkIdList& corners) {
  std::vector<vtkIdType> different(corners.begin(), corners.end());
  const auto repeated = std::ranges::unique(different);
  different.erase(repeated.begin(), repeated.end());
  while (different.size() > 1 && different.front() == different.back()) different.pop_back();
  return different;
}

/// Without faces that have shrunk to a line or a point, and without sides of others that have: an edge that one of them has
/// with its neighbour would be no border.
vtkSmartPointer<vtkPolyData> withoutShrunk(vtkPolyData& faces) {
  vtkNew<vtkIdList> corners;
  std::vector<vtkIdType> kept;
  bool isAsBefore = true;
  for (vtkIdType face = 0; face < faces.GetNumberOfPolys(); ++face) {
    faces.GetPolys()->GetCellAtId(face, corners);
    const bool isKept = !isOnALine(faces, *corners);
    if (isKept) kept.push_back(face);
    isAsBefore = isAsBefore && isKept && std::ssize(withoutRepeated(*corners)) == corners->GetNumberOfIds();
  }
  if (isAsBefore) return &faces;
  const auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(faces.GetPoints());
  result->GetPointData()->ShallowCopy(faces.GetPointData());
  result->GetCellData()->CopyAllOn();
  result->GetCellData()->CopyAllocate(faces.GetCellData());
  const vtkIdType others = faces.GetNumberOfVerts() + faces.GetNumberOfLines();
  vtkNew<vtkCellArray> polygons;
  for (const vtkIdType face : kept) {
    faces.GetPolys()->GetCellAtId(face, corners);
    const std::vector<vtkIdType> different = withoutRepeated(*corners);
    result->GetCellData()->CopyData(faces.GetCellData(), others + face,
                                    polygons->InsertNextCell(std::ssize(different), different.data()));
  }
  result->SetPolys(polygons);
  return result;
}

/// Half of the products of neighbouring corners: a normal as long as the area.
Eigen::Vector3d areaOf(const Eigen::Matrix3Xd& corners) {
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (Eigen::Index k = 2; k < corners.cols(); ++k) {
    const Eigen::Vector3d one = corners.col(k - 1) - corners.col(0), other = corners.col(k) - corners.col(0);
    area += 0.5 * one.cross(other);
  }
  return area;
}

/// Of a linear cell the mean of its corners, of a curved one what is in the middle of its parameters.
Eigen::Vector3d middleOf(vtkUnstructuredGrid& cells, vtkIdType number) {
  vtkNew<vtkIdList> ids;
  cells.GetCellPoints(number, ids);
  const Eigen::Matrix3Xd places = placesOf(cells, *ids);
  if (isLinear(cells, number)) return places.rowwise().mean();
  vtkCell& cell = *cells.GetCell(number);
  Eigen::Vector3d parameters = Eigen::Vector3d::Zero();
  cell.GetParametricCenter(parameters.data());
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(places.cols());
  cell.InterpolateFunctions(parameters.data(), shares.data());
  return places * shares;
}

/// Turns faces of volumes so that they look away from the middle of their cell, whatever the order of its corners is; not those
/// of polyhedra, whose middle may lie beyond a face. All parts of a curved cell follow the one that is nearest to the middle, as those of a bent cell may look towards it.
void turnOutward(vtkPolyData& faces, vtkUnstructuredGrid& cells) {
  struct Nearest {
    Eigen::Vector3d middle;
    double distance = std::numeric_limits<double>::infinity();
    bool isInward = false;
  };
  vtkDataArray* curvedOf = faces.GetCellData()->GetArray(kVolumes);
  vtkDataArray& cellOf = curvedOf ? *curvedOf : *faces.GetCellData()->GetArray(kCells);
  vtkCellArray& polygons = *faces.GetPolys();
  const vtkIdType others = faces.GetNumberOfVerts() + faces.GetNumberOfLines();
  const auto cellAt = [&](vtkIdType face) {
    return static_cast<vtkIdType>(cellOf.GetComponent(others + face, 0));
  };
  vtkNew<vtkIdList> ids;
  std::unordered_map<vtkIdType, Nearest> curved;  // cells
  std::vector<vtkIdType> inward;
  for (vtkIdType face = 0; face < polygons.GetNumberOfCells(); ++face) {
    const vtkIdType cell = cellAt(face);
    if (dimensionOf(cells, cell) < 3) continue;
    polygons.GetCellAtId(face, ids);
    const Eigen::Matrix3Xd corners = placesOf(faces, *ids);
    const Eigen::Vector3d place = corners.rowwise().mean(), area = areaOf(corners);
    if (cells.GetCellType(cell) == VTK_POLYHEDRON) continue;
    if (isLinear(cells, cell)) {
      if (area.dot(place - middleOf(cells, cell)) < 0.0) inward.push_back(face);
      continue;
    }
    auto found = curved.find(cell);
    if (found == curved.end()) found = curved.emplace(cell, Nearest{middleOf(cells, cell)}).first;
    Nearest& nearest = found->second;
    const double distance = (place - nearest.middle).norm();
    if (distance >= nearest.distance) continue;
    nearest.distance = distance;
    nearest.isInward = area.dot(place - nearest.middle) < 0.0;
  }
  for (vtkIdType face = 0; !curved.empty() && face < polygons.GetNumberOfCells(); ++face)
    if (const auto found = curved.find(cellAt(face)); found != curved.end() && found->second.isInward)
      inward.push_back(face);
  for (const vtkIdType face : inward) polygons.ReverseCellAtId(face);
  faces.GetPointData()->SetNormals(nullptr);  // of the sides before
  faces.GetCellData()->RemoveArray(kVolumes);
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> shownCells(
    const std::vector<vtkSmartPointer<vtkUnstructuredGrid>>& grids) {
  if (grids.empty()) return vtkSmartPointer<vtkUnstructuredGrid>::New();
  const double length = lengthOfAll(grids);
  CellCollector collector(*grids.front(), length);
  const HiddenFaces hidden(grids, length);
  for (const int dimension : {3, 2})
    for (const auto& grid : grids)
      for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
        if (dimensionOf(*grid, cell) == dimension && !isGhost(*grid, cell) && !hidden.contains(*grid, cell))
          collector.add(*grid, cell);
  const auto cells = collector.finish();
  cells->GetCellData()->RemoveArray("vtkGhostType");
  return cells;
}

vtkSmartPointer<vtkUnstructuredGrid> mirroredCells(vtkUnstructuredGrid& cells, const MirrorPlane& plane,
                                                   double sign) {
  constexpr double kOnPlane = 1e-6;  // of the length
  const auto isOnPlane = [&, length = cells.GetLength()](vtkIdType point) {
    return std::abs(cells.GetPoint(point)[plane.axis] - plane.at) <= kOnPlane * length;
  };
  const auto image = vtkSmartPointer<vtkUnstructuredGrid>::New();
  image->DeepCopy(&cells);
  // The components across the plane, and the shear stresses on it.
  for (const auto& [name, components] :
       {std::pair{"vectors", std::vector{plane.axis}},
        std::pair{"stress", std::vector{3 + plane.axis, 3 + (plane.axis + 2) % 3}}}) {
    vtkDataArray* ours = cells.GetPointData()->GetArray(name);
    vtkDataArray* theirs = image->GetPointData()->GetArray(name);
    for (vtkIdType k = 0; ours && k < ours->GetNumberOfTuples(); ++k)
      for (const int component : components) {
        if (isOnPlane(k)) ours->SetComponent(k, component, 0.0);
        theirs->SetComponent(k, component, -ours->GetComponent(k, component));
      }
  }
  if (hasCurved(cells)) turnCurved(cells, *image);
  for (vtkIdType k = 0; k < image->GetNumberOfPoints(); ++k) {
    std::array<double, 3> point{};
    image->GetPoint(k, point.data());
    double& across = point[static_cast<std::size_t>(plane.axis)];
    across = 2.0 * plane.at - across;
    image->GetPoints()->SetPoint(k, point.data());
  }
  for (vtkDataSetAttributes* data : {static_cast<vtkDataSetAttributes*>(image->GetPointData()),
                                     static_cast<vtkDataSetAttributes*>(image->GetCellData())})
    if (vtkDataArray* drawn = data->GetArray("drawn"))
      for (vtkIdType k = 0; k < drawn->GetNumberOfTuples(); ++k)
        drawn->SetComponent(k, 0, sign * drawn->GetComponent(k, 0));
  return image;
}

bool isPlane(vtkUnstructuredGrid& cells) {
  for (vtkIdType cell = 0; cell < cells.GetNumberOfCells(); ++cell)
    if (dimensionOf(cells, cell) == 3) return false;
  const double* bounds = cells.GetBounds();
  return bounds[5] - bounds[4] <= 1e-9 * cells.GetLength();
}

vtkSmartPointer<vtkPolyData> outerFaces(vtkUnstructuredGrid& cells) {
  const bool isCurved = hasCurved(cells);
  vtkNew<vtkDataSetSurfaceFilter> surface;
  vtkSmartPointer<vtkUnstructuredGrid> placed = &cells;
  if (isCurved) placed = withPlaces(cells);
  surface->SetInputData(placed);
  surface->PassThroughCellIdsOn();
  surface->SetNonlinearSubdivisionLevel(kCurvedParts);
  surface->Update();
  if (isCurved) takePlaces(*surface->GetOutput());
  vtkNew<vtkPolyDataNormals> sides;  // of sheets in many files the faces turn either way
  sides->SetInputData(withoutShrunk(*surface->GetOutput()));
  sides->SplittingOff();
  sides->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  sides->Update();
  vtkSmartPointer<vtkPolyData> faces = sides->GetOutput();
  turnOutward(*faces, cells);
  takeLengths(*faces);
  return faces;
}

vtkSmartPointer<vtkPolyData> withDrawnScalars(vtkPolyData& faces) {
  vtkDataArray* ofCells = faces.GetCellData()->GetArray("drawn");
  if (!ofCells) {
    faces.GetPointData()->SetActiveScalars("drawn");
    return &faces;
  }
  const auto parted = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  parted->SetPoints(points);
  vtkPointData& data = *parted->GetPointData();
  data.CopyAllOn();
  data.CopyAllocate(faces.GetPointData());
  vtkNew<vtkDoubleArray> drawn;
  drawn->SetName("drawn");
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkIdList> ids;
  const vtkIdType first = faces.GetNumberOfVerts() + faces.GetNumberOfLines();
  for (vtkIdType face = 0; face < faces.GetNumberOfPolys(); ++face) {
    faces.GetCellPoints(first + face, ids);
    polygons->InsertNextCell(static_cast<int>(ids->GetNumberOfIds()));
    for (const vtkIdType id : *ids) {
      const vtkIdType own = points->InsertNextPoint(faces.GetPoint(id));
      data.CopyData(faces.GetPointData(), id, own);
      drawn->InsertNextValue(ofCells->GetComponent(first + face, 0));
      polygons->InsertCellPoint(own);
    }
  }
  parted->SetPolys(polygons);
  data.SetScalars(drawn);
  return parted;
}

vtkSmartPointer<vtkPolyData> cellEdges(vtkPolyData& faces) {
  constexpr vtkIdType kBetween = -1, kInside = -2;  // two cells; a face of one cell, or two of its faces
  vtkDataArray* curved = faces.GetCellData()->GetArray("cell");  // of which the cells are parts
  vtkDataArray& cellOf = curved ? *curved : *faces.GetCellData()->GetArray(kCells);
  std::map<std::pair<vtkIdType, vtkIdType>, vtkIdType> edges;  // the cell of the faces at both sides
  vtkNew<vtkIdList> ids;
  for (vtkIdType face = 0; face < faces.GetNumberOfCells(); ++face) {
    faces.GetCellPoints(face, ids);
    const auto cell = static_cast<vtkIdType>(cellOf.GetComponent(face, 0));
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k) {
      const vtkIdType one = ids->GetId(k), other = ids->GetId((k + 1) % ids->GetNumberOfIds());
      const auto [found, isNew] = edges.try_emplace({std::min(one, other), std::max(one, other)}, cell);
      if (!isNew) found->second = found->second == cell ? kInside : kBetween;
    }
  }
  PolyBuilder lines;
  for (const auto& [edge, cell] : edges) {
    if (cell == kInside) continue;
    Eigen::Matrix3Xd ends(3, 2);
    faces.GetPoint(edge.first, ends.col(0).data());
    faces.GetPoint(edge.second, ends.col(1).data());
    lines.addLine(lines.addPoints(ends));
  }
  return lines.finish();
}

}  // namespace burnish
