#include "postproc/draw/contour/occlusion.h"

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "postproc/draw/contour/space_actors.h"
#include "postproc/mesh/plane_section.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

using Tuples = Eigen::Ref<const Eigen::Matrix3Xd>;

/// Of an array of doubles where they lie, of others in `copy`.
Eigen::Map<const Eigen::Matrix3Xd> tuplesOf(vtkDataArray& array, Eigen::Matrix3Xd& copy) {
  if (auto* doubles = vtkDoubleArray::SafeDownCast(&array))
    return {doubles->GetPointer(0), 3, doubles->GetNumberOfTuples()};
  copy.resize(3, array.GetNumberOfTuples());
  for (Eigen::Index k = 0; k < copy.cols(); ++k) array.GetTuple(k, copy.col(k).data());
  return {copy.data(), 3, copy.cols()};
}

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Some rows and columns of a lattice on a surface, as far apart as what changes slowly there allows. What is known
/// at their points goes linearly between them. Every other one of them may do where it hardly changes.
class CoarseLattice {
 public:
  /// x: points of the surface. first: number of the first one of the lattice. Lines are at most `distance` apart
  /// where those of the lattice are.
  CoarseLattice(const Tuples& x, Eigen::Index first, const BodySurface::Lattice& lattice, double distance)
      : first_(first), numCorners_(lattice.corners.size()), hasMiddles_(lattice.middles.size() > 0) {
    Eigen::Index step = 1;
    for (const int extent : lattice.corners.extent) {
      if (extent > 1 && numDirections_ < 2) {
        steps_[numDirections_] = step;
        extents_[numDirections_++] = extent;
      }
      step *= extent;
    }
    for (std::size_t d = 0; d < 2; ++d) chosen_[d] = linesOf(x, d, distance);
  }

  /// Numbers of its points.
  std::vector<Eigen::Index> points() const {
    std::vector<Eigen::Index> numbers;
    for (const Eigen::Index j : chosen_[1])
      for (const Eigen::Index i : chosen_[0]) numbers.push_back(numberOf(i, j));
    return numbers;
  }

  /// Whether a point is on the first, the last or every other line of both directions.
  bool isOnEveryOther(std::size_t point) const {
    const std::size_t row = chosen_[0].size(), a = point % row, b = point / row;
    return (a % 2 == 0 || a + 1 == row) && (b % 2 == 0 || b + 1 == chosen_[1].size());
  }

  /// Fills values between those of every other line where these differ by no more than `change`.
  void fillCalm(double* coarse, double change) const {
    const std::size_t row = chosen_[0].size(), columns = chosen_[1].size();
    for (std::size_t b = 0; b + 1 < columns; b += 2)
      for (std::size_t a = 0; a + 1 < row; a += 2) {
        const std::size_t nextA = std::min(a + 2, row - 1), nextB = std::min(b + 2, columns - 1);
        const std::array corners{coarse[b * row + a], coarse[b * row + nextA], coarse[nextB * row + a],
                                 coarse[nextB * row + nextA]};
        const auto [least, most] = std::minmax_element(corners.begin(), corners.end());
        if (*most - *least > change) continue;
        for (std::size_t j = b; j <= nextB; ++j)
          for (std::size_t i = a; i <= nextA; ++i) {
            double& value = coarse[j * row + i];
            if (!std::isnan(value)) continue;
            const double s = static_cast<double>(i - a) / static_cast<double>(nextA - a),
                         t = static_cast<double>(j - b) / static_cast<double>(nextB - b);
            value = std::lerp(std::lerp(corners[0], corners[1], s), std::lerp(corners[2], corners[3], s), t);
          }
      }
  }

  /// Fills values at all points of the lattice from those at `points`; those in the middle of a cell are between those at
  /// its corners.
  void spread(const double* coarse, Eigen::VectorXd& values) const {
    const std::size_t row = chosen_[0].size();
    for (std::size_t b = 0; b + 1 < chosen_[1].size(); ++b)
      for (std::size_t a = 0; a + 1 < row; ++a) {
        const double* corner = coarse + b * row + a;
        const Eigen::Index i0 = chosen_[0][a], i1 = chosen_[0][a + 1], j0 = chosen_[1][b],
                           j1 = chosen_[1][b + 1];
        for (Eigen::Index j = j0; j <= j1; ++j)
          for (Eigen::Index i = i0; i <= i1; ++i) {
            const double s = static_cast<double>(i - i0) / static_cast<double>(i1 - i0),
                         t = static_cast<double>(j - j0) / static_cast<double>(j1 - j0);
            values(numberOf(i, j)) =
                std::lerp(std::lerp(corner[0], corner[1], s), std::lerp(corner[row], corner[row + 1], s), t);
          }
      }
    if (!hasMiddles_) return;
    Eigen::Index middle = first_ + numCorners_;
    for (Eigen::Index j = 0; j + 1 < extents_[1]; ++j)
      for (Eigen::Index i = 0; i + 1 < extents_[0]; ++i)
        values(middle++) = 0.25 * (values(numberOf(i, j)) + values(numberOf(i + 1, j)) +
                                   values(numberOf(i, j + 1)) + values(numberOf(i + 1, j + 1)));
  }

 private:
  Eigen::Index numberOf(Eigen::Index i, Eigen::Index j) const {
    return first_ + i * steps_[0] + j * steps_[1];
  }

  /// The first and the last line, and as few between as the distance allows.
  std::vector<Eigen::Index> linesOf(const Tuples& x, std::size_t direction, double distance) const {
    std::vector<Eigen::Index> lines{0};
    double way = 0.0;
    for (Eigen::Index i = 0; i + 1 < extents_[direction]; ++i) {
      double widest = 0.0;
      for (Eigen::Index j = 0; j < extents_[1 - direction]; ++j) {
        const Eigen::Index here = direction == 0 ? numberOf(i, j) : numberOf(j, i);
        widest = std::max(widest, (x.col(here + steps_[direction]) - x.col(here)).norm());
      }
      if (i > lines.back() && way + widest > distance) {
        lines.push_back(i);
        way = 0.0;
      }
      way += widest;
    }
    lines.push_back(extents_[direction] - 1);
    return lines;
  }

  Eigen::Index first_, numCorners_;
  bool hasMiddles_;
  std::size_t numDirections_ = 0;
  std::array<Eigen::Index, 2> extents_{1, 1}, steps_{0, 0};
  std::array<std::vector<Eigen::Index>, 2> chosen_;
};

FreeSky skyOf(const ContourParts& parts, const std::vector<ToolDrawing>& tools, double toolOpacity) {
  Surfaces bodies, surfaces;
  for (const auto& part : {parts.body, parts.section, parts.plain, parts.plainSection})
    if (part) bodies.push_back(part);
  for (const ToolDrawing& tool : tools)
    if (tool.surface) surfaces.push_back(tool.surface);
  return {bodies, surfaces, toolOpacity};
}

/// The plane of a cut, before which nothing is drawn.
struct Cut {
  const CutPlane& plane;
  double margin;  ///< as far before it something may count for what is behind
};

/// Shares at points of a surface. lattices: how they lie; none where nothing is known of it. distance: at which shares
/// are computed at least, or at twice of it where they hardly change.
Eigen::VectorXd sharesOf(const Tuples& x, const Tuples& normals,
                         const std::vector<BodySurface::Lattice>& lattices, const FreeSky& sky,
                         const FreeSky::Rays& rays, double distance, const std::optional<Cut>& cut) {
  constexpr double kCalm = 0.02;  // five levels of grey
  std::vector<CoarseLattice> coarse;
  std::vector<Eigen::Index> points;  // where shares are known first
  std::vector<bool> isFirst;         // of them: not only where the others are not enough
  Eigen::Index first = 0;
  for (const BodySurface::Lattice& lattice : lattices) {
    coarse.emplace_back(x, first, lattice, distance);
    const std::vector<Eigen::Index> added = coarse.back().points();
    for (std::size_t k = 0; k < added.size(); ++k) isFirst.push_back(coarse.back().isOnEveryOther(k));
    points.insert(points.end(), added.begin(), added.end());
    first += lattice.corners.size() + lattice.middles.size();
  }
  if (lattices.empty()) {
    points.resize(static_cast<std::size_t>(x.cols()));
    std::iota(points.begin(), points.end(), 0);
    isFirst.resize(points.size(), true);
  }
  std::vector<double> known(points.size(), kUnknown);
  if (cut)
    for (std::size_t k = 0; k < points.size(); ++k)
      if ((x.col(points[k]) - cut->plane.point).dot(cut->plane.normal.normalized()) > cut->margin)
        known[k] = 1.0;
  const auto compute = [&](bool firstAlone) {
    std::vector<std::size_t> places;
    std::vector<Eigen::Index> those;
    for (std::size_t k = 0; k < points.size(); ++k)
      if (std::isnan(known[k]) && (isFirst[k] || !firstAlone)) {
        places.push_back(k);
        those.push_back(points[k]);
      }
    const Eigen::VectorXd shares = sky.sharesAt(x(Eigen::all, those), normals(Eigen::all, those), rays);
    for (std::size_t k = 0; k < places.size(); ++k) known[places[k]] = shares(static_cast<Eigen::Index>(k));
  };
  compute(true);
  double* next = known.data();
  for (const CoarseLattice& lattice : coarse) {
    lattice.fillCalm(next, kCalm);
    next += lattice.points().size();
  }
  compute(false);
  Eigen::VectorXd shares(x.cols());
  if (lattices.empty()) std::copy(known.begin(), known.end(), shares.begin());
  const double* values = known.data();
  for (const CoarseLattice& lattice : coarse) {
    lattice.spread(values, shares);
    values += lattice.points().size();
  }
  return shares;
}

void setSkyOf(vtkPolyData* surface, const std::vector<BodySurface::Lattice>& lattices, const FreeSky& sky,
              const FreeSky::Rays& rays, double distance, const std::optional<Cut>& cut) {
  if (!surface || !surface->GetPointData()->GetNormals()) return;
  Eigen::Matrix3Xd points, normals;
  const Eigen::VectorXd shares =
      sharesOf(tuplesOf(*surface->GetPoints()->GetData(), points),
               tuplesOf(*surface->GetPointData()->GetNormals(), normals), lattices, sky, rays, distance, cut);
  surface->GetPointData()->AddArray(makeArray(kSky, shares.transpose(), {}));
}

/// Points of a square lattice on the ground that bodies cover get what goes on from beside the bodies: shares jump at a
/// wall, and what is interpolated across it would follow the lattice and not the wall. Others stay.
void goOnBelow(Eigen::VectorXd& shares, int extent) {
  constexpr double kCovered = 1e-3;
  const Eigen::VectorXd known = shares;
  const auto at = [&](int i, int j) { return known(i + j * extent); };
  const auto isBeside = [&](int i, int j) {
    return i >= 0 && j >= 0 && i < extent && j < extent && at(i, j) > kCovered;
  };
  for (int j = 0; j < extent; ++j)
    for (int i = 0; i < extent; ++i) {
      if (isBeside(i, j)) continue;
      double sum = 0.0, weights = 0.0;
      for (const int di : {-1, 0, 1})
        for (const int dj : {-1, 0, 1}) {
          if (!isBeside(i + di, j + dj)) continue;
          const double next = at(i + di, j + dj),
                       rise = isBeside(i + 2 * di, j + 2 * dj) ? at(i + 2 * di, j + 2 * dj) - next : 0.0;
          const double weight = di != 0 && dj != 0 ? 0.5 : 1.0;
          sum += weight * std::clamp(next - rise, 0.0, 1.0);
          weights += weight;
        }
      if (weights > 0.0) shares(i + j * extent) = sum / weights;
    }
}

}  // namespace

Occlusion::Occlusion(ContourParts& parts, const std::vector<ToolDrawing>& tools, double toolOpacity)
    : parts_(parts), tools_(tools), length_(lengthOf(parts)), sky_(skyOf(parts, tools, toolOpacity)) {}

void Occlusion::setSky(bool ofBodies) {
  constexpr double kReach = 0.25, kStart = 1.0 / 2000.0, kPressedIn = 0.01, kDistance = 1.0 / 70.0;
  const double start = kStart * length_, pressedIn = -kPressedIn * length_, distance = kDistance * length_;
  const FreeSky::Rays fromBodies{kReach * length_, start, pressedIn},
      fromTools{kReach * length_, pressedIn, start};
  const auto setSkyOfBody = [&](auto& body, const auto& whole,
                                const std::vector<BodySurface::Lattice>& lattices) {
    if (!whole) return setSkyOf(body, lattices, sky_, fromBodies, distance, {});
    setSkyOf(whole, lattices, sky_, fromBodies, distance, Cut{*parts_.plane, 2.0 * distance});
    body = behind(*whole, *parts_.plane);
  };
  if (ofBodies) {
    setSkyOfBody(parts_.body, parts_.wholeBody, parts_.bodyLattices);
    setSkyOfBody(parts_.plain, parts_.wholePlain, parts_.plainLattices);
  }
  for (const ToolDrawing& tool : tools_) setSkyOf(tool.surface, {}, sky_, fromTools, distance, {});
}

vtkSmartPointer<vtkPolyData> Occlusion::groundShadow() const {
  constexpr double kLowestEye = 0.05, kReach = 0.5, kDarkest = 0.55, kNear = 0.01;
  constexpr int kCells = 100;
  constexpr Eigen::Index kRays = 768;  // the same ones from all points of a plane: fewer leave streaks
  const Eigen::Vector3d eye = parts_.axes.row(0).cross(parts_.axes.row(1)).transpose();
  if (eye.y() < kLowestEye) return nullptr;
  const double reach = kReach * length_, height = parts_.box.min().y();
  for (const ToolDrawing& tool : tools_)
    if (tool.surface && boxOf(*tool.surface).min().y() < height + kNear * length_) return nullptr;
  // Tools beside the bodies have shadows, too, as far as they stand near them.
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(reach);
  const Eigen::AlignedBox3d near{parts_.box.min() - margin, parts_.box.max() + margin};
  Eigen::AlignedBox3d shading = parts_.box;
  for (const ToolDrawing& tool : tools_)
    if (tool.surface && tool.surface->GetNumberOfPoints() > 0) {
      const Eigen::AlignedBox3d seen = near.intersection(boxOf(*tool.surface));
      if (!seen.isEmpty()) shading.extend(seen);
    }
  const Eigen::Vector3d low = shading.min() - margin, high = shading.max() + margin;
  vtkNew<vtkPlaneSource> plane;
  plane->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  plane->SetOrigin(low.x(), height, low.z());
  plane->SetPoint1(low.x(), height, high.z());
  plane->SetPoint2(high.x(), height, low.z());
  plane->SetResolution(kCells, kCells);
  plane->Update();
  vtkSmartPointer<vtkPolyData> ground = plane->GetOutput();
  Eigen::Matrix3Xd copy;
  const Eigen::Map<const Eigen::Matrix3Xd> points = tuplesOf(*ground->GetPoints()->GetData(), copy);
  const BodySurface::Lattice lattice{{{kCells + 1, kCells + 1, 1}}, {{0, 0, 0}}};
  Eigen::VectorXd shares = sharesOf(points, Eigen::Vector3d::UnitY().replicate(1, points.cols()), {lattice},
                                    sky_, {.reach = reach, .most = kRays}, 0.0, {});
  goOnBelow(shares, kCells + 1);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(4);
  for (const double share : shares)
    colors->InsertNextTuple4(0, 0, 0, std::round(255.0 * kDarkest * (1.0 - share)));
  ground->GetPointData()->SetScalars(colors);
  return ground;
}

void fadeAtBorder(vtkPolyData& shadow, const View& picture) {
  constexpr double kWidth = 0.08;  // of the shorter side of the picture
  const PixelRect& area = picture.area;
  const double width = kWidth * std::min(area.width, area.height);
  vtkDataArray& colors = *shadow.GetPointData()->GetScalars();
  // Between points alpha is linear: those next to the border have none.
  const double step = (picture.pixel(Eigen::Vector3d(shadow.GetPoint(1))) -
                       picture.pixel(Eigen::Vector3d(shadow.GetPoint(0))))
                          .norm();
  for (vtkIdType k = 0; k < shadow.GetNumberOfPoints(); ++k) {
    const Eigen::Vector2d at = picture.pixel(Eigen::Vector3d(shadow.GetPoint(k)));
    const double inside =
        std::min({at.x() - area.x, area.right() - at.x(), at.y() - area.y, area.top() - at.y()});
    const double part = std::clamp((inside - step) / width, 0.0, 1.0);
    colors.SetComponent(k, 3, std::round(part * colors.GetComponent(k, 3)));
  }
}

}  // namespace burnish
