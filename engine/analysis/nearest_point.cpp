#include "engine/analysis/nearest_point.h"

#include <Eigen/Dense>
#include <limits>
#include <vector>

namespace burnish::inline analysis {
namespace {

template <int P>
struct Sample {
  Eigen::Vector<double, P> xi;
  double gap = std::numeric_limits<double>::infinity();
};

/// A box of parameters.
template <int P>
struct Box {
  Eigen::Vector<double, P> low, high;
  Sample<P> best;
  double spacing;  ///< of the samples in space; between two of them the gap falls by no more
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

}  // namespace

template <int Dim>
NearestPoint nearestPoint(const Body<Dim>& body, const FacePlace& place, const Tool& tool, double t) {
  const Patch<Dim>& patch = body.patches[static_cast<std::size_t>(place.patch)];
  constexpr int P = Dim - 1;
  constexpr int kIntervals = Dim == 2 ? 16 : 6;
  constexpr int kZooms = 8;
  using Parameter = Eigen::Vector<double, P>;
  const auto trace = tracePatch(patch, place.face);
  const ToolPose pose = tool.pose(t);
  const auto query = [&](const Parameter& xi) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    x.template head<Dim>() = trace.position(xi);
    return tool.query(pose, x);
  };
  const auto gap = [&](const Parameter& xi) { return query(xi).gap; };

  std::vector<Box<P>> boxes;
  Sample<P> nearest;
  for (int e = 0; e < trace.basis().numSpans(); ++e) {
    const auto index = trace.basis().spanIndex(e);
    Box<P> box;
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
  for (Box<P>& box : boxes) {
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
  const auto outward = outwardNormal(patch, place.face, nearest.xi);
  return {nearest.gap, outward.dot(query(nearest.xi).normal.template head<Dim>())};
}

template NearestPoint nearestPoint(const Body<2>&, const FacePlace&, const Tool&, double);
template NearestPoint nearestPoint(const Body<3>&, const FacePlace&, const Tool&, double);

}  // namespace burnish::inline analysis
