#include "engine/analysis/tool_start.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/input_error.h"

namespace burnish {
namespace {

template <int P>
struct Sample {
  Eigen::Vector<double, P> xi;
  double gap = std::numeric_limits<double>::infinity();
};

/// Best of a grid of samples in the parameter box [low, high].
template <int P, class Gap>
Sample<P> bestSample(const Eigen::Vector<double, P>& low, const Eigen::Vector<double, P>& high, int intervals,
                     const Gap& gap) {
  Sample<P> best;
  const int samples = P == 1 ? intervals + 1 : (intervals + 1) * (intervals + 1);
  for (int k = 0; k < samples; ++k) {
    Eigen::Vector<double, P> s;
    for (int d = 0, rest = k; d < P; ++d, rest /= intervals + 1)
      s(d) = static_cast<double>(rest % (intervals + 1)) / intervals;
    const Eigen::Vector<double, P> xi = low + s.cwiseProduct(high - low);
    const double g = gap(xi);
    if (g < best.gap) best = {xi, g};
  }
  return best;
}

/// Unit normal of a face of a patch, away from the body: ±J^{-T} e_d with the map's derivative J.
template <int Dim>
Eigen::Vector<double, Dim> outwardNormal(const Patch<Dim>& patch, FaceId face,
                                         const Eigen::Vector<double, Dim - 1>& onFace) {
  const int across = face / 2;
  const auto& breakpoints = patch.basis().direction(across).breakpoints();
  Eigen::Vector<double, Dim> xi;
  for (int d = 0, k = 0; d < Dim; ++d) {
    if (d == across)
      xi(d) = face % 2 == 0 ? breakpoints.front() : breakpoints.back();
    else
      xi(d) = onFace(k++);
  }
  const Eigen::Matrix<double, Dim, Dim> inverse = patch.jacobian(xi).inverse();
  const double sign = face % 2 == 0 ? -1.0 : 1.0;
  return sign * inverse.row(across).transpose().normalized();
}

/// Scattered points around a tool, at distances of about the body's size.
std::vector<Eigen::Vector3d> pointsAround(const Eigen::Vector3d& middle, int dim, double bodySize) {
  constexpr int kPerDirection = 4;
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k < (dim == 2 ? 1 : kPerDirection) * kPerDirection * kPerDirection; ++k) {
    // Shares that differ from one direction to the next, so that no symmetry of a shape hides a way.
    const Eigen::Vector3i place(k % kPerDirection, k / kPerDirection % kPerDirection,
                                k / (kPerDirection * kPerDirection));
    const Eigen::Vector3d grid = place.cast<double>();
    Eigen::Vector3d x = middle;
    for (int d = 0; d < dim; ++d) x(d) += bodySize * (0.71 * grid(d) - 1.03 - 0.11 * d);
    points.push_back(x);
  }
  return points;
}

/// An averaged gap of this share of the body's size is no touch.
constexpr double kNearlyTouching = 1e-6;

/// Smallest gap of undeformed faces, as the method of each pair takes it.
template <int Dim>
double smallestGap(const std::vector<const ContactTerm<Dim>*>& pairs, const ToolPose& pose) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto* pair : pairs) smallest = std::min(smallest, pair->smallestReferenceGap(pose));
  return smallest;
}

}  // namespace

template <int Dim>
NearestPoint nearestPoint(const Body<Dim>& body, int patch, FaceId face, const Tool& tool, double t) {
  constexpr int P = Dim - 1;
  constexpr int kIntervals = Dim == 2 ? 16 : 6;
  constexpr int kZooms = 8;
  using Parameter = Eigen::Vector<double, P>;
  const auto trace = tracePatch(body.patches[static_cast<std::size_t>(patch)], face);
  const ToolPose pose = tool.pose(t);
  const auto query = [&](const Parameter& xi) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    x.template head<Dim>() = trace.position(xi);
    return tool.query(pose, x);
  };
  const auto gap = [&](const Parameter& xi) { return query(xi).gap; };

  struct Box {
    Parameter low, high;
    Sample<P> best;
    double spacing;  // of the samples in space; between two of them the gap falls by no more
  };
  std::vector<Box> boxes;
  Sample<P> nearest;
  for (int e = 0; e < trace.basis().numSpans(); ++e) {
    const auto index = trace.basis().spanIndex(e);
    Box box;
    for (int d = 0; d < P; ++d) {
      box.low(d) = trace.basis().direction(d).spanBegin(index[static_cast<std::size_t>(d)]);
      box.high(d) = trace.basis().direction(d).spanEnd(index[static_cast<std::size_t>(d)]);
    }
    box.best = bestSample(box.low, box.high, kIntervals, gap);
    box.spacing = 2.0 * (trace.position(box.high) - trace.position(box.low)).norm() / kIntervals;
    if (box.best.gap < nearest.gap) nearest = box.best;
    boxes.push_back(box);
  }

  const double coarse = nearest.gap;
  for (Box& box : boxes) {
    if (box.best.gap - box.spacing > coarse) continue;
    for (int zoom = 0; zoom < kZooms; ++zoom) {
      const Parameter step = (box.high - box.low) / kIntervals;
      const Parameter low = (box.best.xi - step).cwiseMax(box.low),
                      high = (box.best.xi + step).cwiseMin(box.high);
      box.low = low;
      box.high = high;
      box.best = bestSample(low, high, kIntervals, gap);
    }
    if (box.best.gap < nearest.gap) nearest = box.best;
  }
  const auto outward = outwardNormal(body.patches[static_cast<std::size_t>(patch)], face, nearest.xi);
  return {nearest.gap, outward.dot(query(nearest.xi).normal.template head<Dim>())};
}

template <int Dim>
Eigen::Vector3d liftToSeparate(const std::vector<const ContactTerm<Dim>*>& pairs, const Tool& tool,
                               double bodySize, const std::string& place) {
  double worst = -kTouching * bodySize;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  ToolPose pose = tool.pose(0.0);
  for (const auto* pair : pairs) {
    const Eigen::VectorXd gaps = pair->referenceGaps(pose);
    Eigen::Index A = 0;
    if (gaps.minCoeff(&A) >= worst) continue;
    worst = gaps(A);
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    x.template head<Dim>() = pair->face().points().col(A);
    direction = -tool.query(pose, x).normal;
  }
  if (direction.isZero(0.0)) return direction;

  constexpr double kMargin = 1.05;
  const Eigen::Vector3d start = pose.displacement;
  double height = -kMargin * worst;
  while (height < bodySize) {
    pose.displacement = start + height * direction;
    if (smallestGap(pairs, pose) > 0.0) return height * direction;
    height *= kMargin;
  }
  throw InputError(place, fmt::format("tool '{}' cannot be lifted off the face that it touches, averaged "
                                      "gaps stay negative; start it farther away",
                                      tool.name));
}

void requireDetermined(const Tool& tool, const std::string& place, int dim, double bodySize) {
  constexpr double kNothing = 1e-8;
  std::vector<std::size_t> ways;
  for (std::size_t way = 0; way < kToolWays; ++way)
    if (tool.isFree(way)) ways.push_back(way);
  const ToolPose pose = tool.pose(0.0);
  const auto points = pointsAround(tool.shape.middle(), dim, bodySize);
  Eigen::MatrixXd slopes(points.size(), ways.size());  // of the gap, by the free ways
  for (std::size_t k = 0; k < points.size(); ++k)
    slopes.row(static_cast<Eigen::Index>(k)) = tool.queryWithWays(pose, points[k]).dWays(ways).transpose();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(slopes, Eigen::ComputeThinV);
  if (svd.singularValues().tail<1>()(0) > kNothing * static_cast<double>(points.size())) return;
  std::vector<std::string> keys;
  for (std::size_t k = 0; k < ways.size(); ++k)
    if (std::abs(svd.matrixV().rightCols<1>()(static_cast<Eigen::Index>(k))) > kNothing)
      keys.push_back(fmt::format("{}.{}", place, kCarryKeys[ways[k]]));
  const std::string others =
      keys.size() == 1 ? ""
                       : fmt::format(", together with {},", fmt::join(keys.begin() + 1, keys.end(), " and "));
  throw InputError(keys.front(),
                   fmt::format("tool '{}' moves in itself in this way{} so that no contact force resists it; "
                               "leave it out of carry, then it is held, or prescribe it",
                               tool.name, others));
}

Eigen::Vector3d firstDirection(const ToolLoad& load, double end) {
  constexpr int kSamples = 1000;
  for (int k = 0; k <= kSamples; ++k) {
    const Eigen::Vector3d force = load.force(end * k / kSamples);
    if (!force.isZero(0.0)) return force.normalized();
  }
  return Eigen::Vector3d::Zero();
}

template <int Dim>
Eigen::Vector3d shiftToTouch(const std::vector<const ContactTerm<Dim>*>& pairs, const Tool& tool,
                             const Eigen::Vector3d& direction, double bodySize, const std::string& place) {
  constexpr int kMostSteps = 1000;
  ToolPose pose = tool.pose(0.0);
  const Eigen::Vector3d start = pose.displacement;
  double way = 0.0;
  for (int k = 0; k < kMostSteps; ++k) {
    pose.displacement = start + way * direction;
    const double gap = smallestGap(pairs, pose);
    if (std::abs(gap) < kTouching * bodySize) return way * direction;
    if (gap > 1e3 * bodySize) break;
    way += gap;  // gaps fall by no more than the way, so that this does not go too far
  }
  throw InputError(place, fmt::format("tool '{}' does not meet its face when it moves along the force that "
                                      "it carries; place it so that the force presses it on the body",
                                      tool.name));
}

template <int Dim>
void requireTouch(const std::vector<const ContactTerm<Dim>*>& pairs, const Tool& tool, double bodySize,
                  const std::string& place) {
  if (smallestGap(pairs, tool.pose(0.0)) > kNearlyTouching * bodySize)
    throw InputError(place, fmt::format("tool '{}' is free to turn, but does not touch its face at the "
                                        "start; place it on the face, or let it carry a force too",
                                        tool.name));
}

template NearestPoint nearestPoint(const Body<2>&, int, FaceId, const Tool&, double);
template NearestPoint nearestPoint(const Body<3>&, int, FaceId, const Tool&, double);
template Eigen::Vector3d liftToSeparate(const std::vector<const ContactTerm<2>*>&, const Tool&, double,
                                        const std::string&);
template Eigen::Vector3d liftToSeparate(const std::vector<const ContactTerm<3>*>&, const Tool&, double,
                                        const std::string&);
template void requireTouch(const std::vector<const ContactTerm<2>*>&, const Tool&, double,
                           const std::string&);
template void requireTouch(const std::vector<const ContactTerm<3>*>&, const Tool&, double,
                           const std::string&);
template Eigen::Vector3d shiftToTouch(const std::vector<const ContactTerm<2>*>&, const Tool&,
                                      const Eigen::Vector3d&, double, const std::string&);
template Eigen::Vector3d shiftToTouch(const std::vector<const ContactTerm<3>*>&, const Tool&,
                                      const Eigen::Vector3d&, double, const std::string&);

}  // namespace burnish
