#include "postproc/draw/contour/contour_arrows.h"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

#include "postproc/draw/contour/streamlines.h"
#include "postproc/mesh/frame_parts.h"
#include "postproc/mesh/poly_builder.h"
#include "postproc/mesh/vtk_arrays.h"
#include "postproc/text/ticks.h"

namespace burnish {
namespace {

// Parts of the longest arrow.
constexpr double kArrowGap = 0.75, kTractionGap = 0.3;
constexpr double kShortest = 0.18;  // nothing is drawn below
constexpr double kCrossGap = 0.95, kCrossHead = 0.75;
constexpr double kHead = 0.3, kHeadHalfWidth = 0.12, kShaftHalfWidth = 0.035;

/// Where vectors stand and what they are.
struct VectorPoints {
  std::vector<Eigen::Vector3d> points, vectors;

  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& vector) {
    points.push_back(point);
    vectors.push_back(vector);
  }
};

Eigen::Vector3d tuple(vtkDataArray& array, vtkIdType k) {
  return Eigen::Map<const Eigen::Vector3d>(array.GetTuple3(k));
}

/// Numbers of the points of a surface that face the eye; all of a plane body.
std::vector<vtkIdType> facingPoints(const ArrowGround& ground, const View& view) {
  constexpr double kFacing = 0.1;
  vtkPolyData& surface = *ground.surface;
  vtkDataArray* normals = surface.GetPointData()->GetNormals();
  std::vector<vtkIdType> result;
  for (vtkIdType k = 0; k < surface.GetNumberOfPoints(); ++k) {
    double cosine = 1.0;
    if (normals)
      cosine =
          tuple(*normals, k).dot(view.towardsEye(Eigen::Map<const Eigen::Vector3d>(surface.GetPoint(k))));
    if ((ground.isOneSided ? cosine : std::abs(cosine)) > kFacing) result.push_back(k);
  }
  return result;
}

VectorPoints vectorsOn(const ArrowGround& ground, const View& view) {
  vtkPolyData& surface = *ground.surface;
  vtkDataArray& vectors = *surface.GetPointData()->GetArray("vectors");
  VectorPoints result;
  for (const vtkIdType k : facingPoints(ground, view))
    result.add(Eigen::Map<const Eigen::Vector3d>(surface.GetPoint(k)), tuple(vectors, k));
  return result;
}

/// Principal stresses and their directions at a point of a body, in a plane body those in its plane; on a plane of
/// symmetry across it and in it, as no shear stress acts there.
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> principal(vtkPolyData& body, vtkIdType point, int dim,
                                                         const std::vector<MirrorPlane>& symmetries) {
  constexpr double kOnPlane = 1e-6;  // in lengths of the body
  vtkDataArray& stress = *body.GetPointData()->GetArray("stress");
  const auto s = [&](int component) { return stress.GetComponent(point, component); };
  Eigen::Matrix3d tensor;
  tensor << s(0), s(3), s(5),  //
      s(3), s(1), s(4),        //
      s(5), s(4), s(2);
  for (const MirrorPlane& plane : symmetries) {
    if (std::abs(body.GetPoint(point)[plane.axis] - plane.at) > kOnPlane * body.GetLength()) continue;
    const double across = tensor(plane.axis, plane.axis);
    tensor.row(plane.axis).setZero();
    tensor.col(plane.axis).setZero();
    tensor(plane.axis, plane.axis) = across;
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(tensor.topLeftCorner(dim, dim));
}

/// Whether points of a body in space can be seen, or something stands before them.
class Sight {
 public:
  /// before: surfaces that hide; null where nothing is hidden.
  Sight(vtkPolyData* before, const View& view) : view_(view) {
    if (!before || before->GetNumberOfCells() == 0) return;
    length_ = before->GetLength();
    locator_->SetDataSet(before);
    locator_->BuildLocator();
    isOpen_ = false;
  }

  bool sees(const Eigen::Vector3d& point) const {
    constexpr double kStart = 2e-3;  // in lengths of what hides, so that facets do not hide their own points
    if (isOpen_) return true;
    const Eigen::Vector3d towards = view_.towardsEye(point), start = point + kStart * length_ * towards,
                          end = point + 2.0 * length_ * towards;
    double at = 0.0;
    Eigen::Vector3d place, parameters;
    int part = 0;
    return locator_->IntersectWithLine(start.data(), end.data(), 0.0, at, place.data(), parameters.data(),
                                       part) == 0;
  }

 private:
  const View& view_;
  vtkNew<vtkStaticCellLocator> locator_;
  double length_ = 0.0;
  bool isOpen_ = true;
};

/// Whether a point is seen where one of some others is, as points of patches that meet.
bool isOnTop(const std::vector<Eigen::Vector2d>& places, std::size_t point,
             const std::vector<std::size_t>& others, double distance) {
  return std::any_of(others.begin(), others.end(), [&](std::size_t other) {
    return (places[point] - places[other]).norm() <= 2.0 * distance;
  });
}

/// In which order points are taken, those that are equal at once.
using Order = std::vector<std::array<double, 2>>;

/// As they are numbered, along the lines of a mesh: on faces, a regular pattern.
Order byNumber(std::size_t count) {
  Order order;
  for (std::size_t k = 0; k < count; ++k) order.push_back({static_cast<double>(k), 0.0});
  return order;
}

/// From the middle outwards, mirror images at once: in the plane, a pattern as symmetric as the points. same: length
/// below which places are the same, as mirror images differ by rounding.
Order fromMiddle(const std::vector<Eigen::Vector2d>& places, double same) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& place : places) box.extend(place);
  Order order;
  for (const Eigen::Vector2d& place : places) {
    const Eigen::Vector2d away = (place - box.center()) / same;
    order.push_back({std::round(away.norm()), -std::round(std::abs(away.x()))});
  }
  return order;
}

/// Numbers of points of which no two are seen closer than `gap`; of mirror images that are too close to one another
/// none. isSeen: asked of a point that would be taken.
std::vector<std::size_t> thinned(const std::vector<Eigen::Vector3d>& points, const View& view, double gap,
                                 bool asNumbered, const std::function<bool(const Eigen::Vector3d&)>& isSeen) {
  const double same = 1e-6 * gap;
  std::vector<Eigen::Vector2d> places;
  for (const Eigen::Vector3d& point : points)
    places.emplace_back(view.eye ? Eigen::Vector2d(view.eye->project(view.axes, point)) : view.axes * point);
  const Order order = asNumbered ? byNumber(points.size()) : fromMiddle(places, same);
  std::vector<std::size_t> sorted(points.size());
  std::iota(sorted.begin(), sorted.end(), std::size_t{0});
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](std::size_t a, std::size_t b) { return order[a] < order[b]; });

  std::vector<std::size_t> kept;
  const auto isFree = [&](std::size_t k, const std::vector<std::size_t>& others) {
    return std::none_of(others.begin(), others.end(), [&](std::size_t other) {
      return other != k && (places[k] - places[other]).norm() < gap;
    });
  };
  for (auto first = sorted.begin(); first != sorted.end();) {
    const auto last =
        std::find_if(first, sorted.end(), [&](std::size_t k) { return order[k] != order[*first]; });
    std::vector<std::size_t> images, taken;
    for (auto k = first; k != last; ++k)
      if (isFree(*k, kept) && !isOnTop(places, *k, images, same) && isSeen(points[*k])) images.push_back(*k);
    for (const std::size_t k : images)
      if (isFree(k, images)) taken.push_back(k);
    kept.insert(kept.end(), taken.begin(), taken.end());
    first = last;
  }
  return kept;
}

/// along: from its begin to its tip. side: unit vector across.
void addArrow(PolyBuilder& areas, PolyBuilder& edges, const Eigen::Vector3d& tip,
              const Eigen::Vector3d& along, const Eigen::Vector3d& side, double longest) {
  const Eigen::Vector3d neck = tip - std::min(0.7, kHead * longest / along.norm()) * along;
  const double slim = std::min(1.0, 0.7 * along.norm() / (kHead * longest));
  const Eigen::Vector3d shaft = kShaftHalfWidth * longest * slim * side,
                        head = kHeadHalfWidth * longest * slim * side;
  Eigen::Matrix<double, 3, 8> corners;
  corners << tip, neck + head, neck + shaft, tip - along + shaft, tip - along - shaft, neck - shaft,
      neck - head, tip;
  const std::vector<vtkIdType> ids = areas.addPoints(corners);
  areas.addPolygon({ids[0], ids[1], ids[6]});
  areas.addPolygon({ids[2], ids[3], ids[4], ids[5]});
  edges.addLine(edges.addPoints(corners));
}

std::string upTo(double largest, const std::string& unit) {
  return fmt::format("up to {}{}", numberText(largest, 3), unit.empty() ? "" : " " + unit);
}

/// An arrow along a line in a plane, with its tip at the end.
void addCurvedArrow(PolyBuilder& areas, PolyBuilder& edges, const Eigen::Matrix3Xd& line,
                    const Eigen::Vector3d& normal, double longest) {
  const Eigen::Index last = line.cols() - 1;
  Eigen::Index neck = last - 1;  // where the head begins
  while (neck > 0 && (line.col(last) - line.col(neck)).norm() < kHead * longest) --neck;
  const auto sideAt = [&](Eigen::Index k) {
    return Eigen::Vector3d(
        normal.cross(line.col(std::min(k + 1, last)) - line.col(std::max<Eigen::Index>(k - 1, 0)))
            .normalized());
  };
  const Eigen::Vector3d acrossHead = normal.cross(line.col(last) - line.col(neck)).normalized();
  Eigen::Matrix3Xd round(3, 2 * (neck + 1) + 4);  // the tip, down the left side, up the right one
  round.col(0) = round.rightCols<1>() = line.col(last);
  round.col(1) = line.col(neck) + kHeadHalfWidth * longest * acrossHead;
  round.col(round.cols() - 2) = line.col(neck) - kHeadHalfWidth * longest * acrossHead;
  for (Eigen::Index k = 0; k <= neck; ++k) {
    const Eigen::Vector3d aside = kShaftHalfWidth * longest * sideAt(k);
    round.col(2 + neck - k) = line.col(k) + aside;
    round.col(3 + neck + k) = line.col(k) - aside;
  }
  const std::vector<vtkIdType> ids = areas.addPoints(round);
  const auto count = ids.size();
  areas.addPolygon({ids[0], ids[1], ids[count - 2]});
  for (std::size_t k = 2; k + 2 < count / 2; ++k)
    areas.addPolygon({ids[k], ids[k + 1], ids[count - 2 - k], ids[count - 1 - k]});
  edges.addLine(edges.addPoints(round));
}

ContourArrows curvedArrows(const ArrowGround& ground, const View& view, double longest) {
  constexpr double kApart = 0.4;  // in longest arrows
  vtkPolyData& body = *ground.surface;
  vtkDataArray* normals = body.GetPointData()->GetNormals();
  const Eigen::Vector3d normal =
      normals && body.GetNumberOfPoints() > 0 ? tuple(*normals, 0) : view.towardsEye();
  std::vector<Eigen::Vector3d> points, seeds;
  double largest = 0.0;
  vtkDataArray& vectors = *body.GetPointData()->GetArray("vectors");
  for (vtkIdType k = 0; k < body.GetNumberOfPoints(); ++k) {
    points.emplace_back(body.GetPoint(k));
    largest = std::max(largest, tuple(vectors, k).norm());
  }
  for (const std::size_t k : thinned(points, view, kApart * longest, false, [](const auto&) { return true; }))
    seeds.push_back(points[k]);
  const std::vector<Eigen::Matrix3Xd> lines = evenStreamlines(body, normal, seeds, kApart * longest);
  if (lines.empty()) return {nullptr, nullptr, fmt::format("no {}", ground.name), nullptr, nullptr};
  PolyBuilder areas, edges;
  for (const Eigen::Matrix3Xd& line : lines) addCurvedArrow(areas, edges, line, normal, longest);
  return {areas.finish(), edges.finish(),
          fmt::format("streamlines of {}{}, {}", ground.name == "displacement" ? "the " : "", ground.name,
                      upTo(largest, ground.unit)),
          nullptr, nullptr};
}

/// The largest of some sizes: in space of those that are drawn, as others may lie on sides that are not seen.
double largestOf(const std::vector<double>& sizes, const std::vector<std::size_t>& drawn, int dim) {
  double largest = 0.0;
  if (dim == 2) {
    for (const double size : sizes) largest = std::max(largest, size);
  } else {
    for (const std::size_t k : drawn) largest = std::max(largest, sizes[k]);
  }
  return largest;
}

ContourArrows crosses(const ArrowGround& ground, const View& view, const Sight& sight, double longest,
                      const std::vector<MirrorPlane>& symmetries) {
  vtkPolyData& body = *ground.surface;
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>> solutions;
  std::vector<double> sizes;
  for (const vtkIdType k : facingPoints(ground, view)) {
    points.emplace_back(body.GetPoint(k));
    solutions.push_back(principal(body, k, ground.dim, symmetries));
    sizes.push_back(solutions.back().eigenvalues().cwiseAbs().maxCoeff());
  }
  const std::vector<std::size_t> drawn = thinned(points, view, kCrossGap * longest, false,
                                                 [&](const Eigen::Vector3d& x) { return sight.sees(x); });
  const double largest = largestOf(sizes, drawn, ground.dim);
  if (largest == 0.0) return {nullptr, nullptr, fmt::format("no {}", ground.name), nullptr, nullptr};
  PolyBuilder areas, edges, darkAreas, darkEdges;
  for (const std::size_t k : drawn)
    for (Eigen::Index d = 0; d < ground.dim; ++d) {
      const double value = solutions[k].eigenvalues()(d);
      Eigen::Vector3d along = Eigen::Vector3d::Zero();
      along.head(ground.dim) =
          solutions[k].eigenvectors().col(d) * (0.5 * longest * std::abs(value) / largest);
      const Eigen::Vector3d side = view.towardsEye(points[k]).cross(along);
      if (side.norm() < 0.5 * kShortest * longest) continue;
      for (const double way : {-1.0, 1.0}) {
        const Eigen::Vector3d outwards = way * along, across = way * side.normalized();
        if (value > 0.0)
          addArrow(areas, edges, points[k] + outwards, outwards, across, kCrossHead * longest);
        else
          addArrow(darkAreas, darkEdges, points[k], -outwards, -across, kCrossHead * longest);
      }
    }
  return {areas.finish(), edges.finish(),
          ground.name == "stress"
              ? fmt::format("crosses: principal stresses, {}; white: tension, black: compression",
                            upTo(largest, ground.unit))
              : fmt::format("crosses: principal values of {}, {}; white: positive, black: negative",
                            ground.name, upTo(largest, ground.unit)),
          darkAreas.finish(), darkEdges.finish()};
}

}  // namespace

std::optional<std::string> directionProblem(const std::string& field) {
  if (field == "displacement" || field.starts_with("displacement.")) return std::nullopt;
  return fmt::format("found field, and {} has no direction; allowed beside displacement and its components.",
                     field);
}

ArrowGround tractionGround(const ModelRecord& model, const FrameRecord& frame) {
  PolyBuilder places;
  std::vector<Eigen::Vector3d> tractions;
  for (const ContactName& contact : contactsOf(frame)) {
    const auto surface = contactSurface(model, frame, contact);
    vtkDataArray& traction =
        *surface->GetPointData()->GetArray(labelled("traction", model.stressUnit).c_str());
    Eigen::Matrix3Xd points(3, surface->GetNumberOfPoints());
    for (vtkIdType k = 0; k < points.cols(); ++k) {
      surface->GetPoint(k, points.col(k).data());
      tractions.push_back(tuple(traction, k));
    }
    places.addPoints(points);
  }
  Eigen::Matrix3Xd vectors(3, std::ssize(tractions));
  for (Eigen::Index k = 0; k < vectors.cols(); ++k) vectors.col(k) = tractions[static_cast<std::size_t>(k)];
  ArrowGround ground{
      .dim = model.dim, .surface = places.finish(), .name = "contact traction", .unit = model.stressUnit};
  ground.surface->GetPointData()->AddArray(makeArray("vectors", vectors, kAxes));
  return ground;
}

ContourArrows contourArrows(ArrowField field, const ArrowGround& ground, vtkPolyData* before,
                            const View& view, double longest, const std::vector<MirrorPlane>& symmetries) {
  if (field == ArrowField::None) return {};
  const Sight sight(field == ArrowField::Traction ? nullptr : before, view);
  if (field == ArrowField::Streamlines) return curvedArrows(ground, view, longest);
  if (field == ArrowField::Principal) return crosses(ground, view, sight, longest, symmetries);
  const bool traction = field == ArrowField::Traction;
  const VectorPoints all = vectorsOn(ground, view);
  std::vector<double> sizes;
  for (const Eigen::Vector3d& vector : all.vectors) sizes.push_back(vector.norm());
  const std::vector<std::size_t> drawn =
      thinned(all.points, view, longest * (traction ? kTractionGap : kArrowGap), traction,
              [&](const Eigen::Vector3d& x) { return sight.sees(x); });
  const double largest = largestOf(sizes, drawn, ground.dim);
  if (largest == 0.0) return {nullptr, nullptr, fmt::format("no {}", ground.name), nullptr, nullptr};

  PolyBuilder areas, edges;
  for (const std::size_t k : drawn) {
    const Eigen::Vector3d along = all.vectors[k] * (longest / largest);
    const Eigen::Vector3d side = view.towardsEye(all.points[k]).cross(along);
    if (side.norm() < kShortest * longest) continue;
    addArrow(areas, edges, all.points[k] + (traction ? Eigen::Vector3d::Zero().eval() : along), along,
             side.normalized(), longest);
  }
  return {areas.finish(), edges.finish(),
          fmt::format("arrows: {}, {}", ground.name, upTo(largest, ground.unit)), nullptr, nullptr};
}

}  // namespace burnish
