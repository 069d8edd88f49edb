#include "postproc/probe/path_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "engine/core/interruption.h"
#include "engine/nurbs/quadrature.h"

namespace burnish {
namespace {

constexpr double kResolution = 1e-12;  // of where a body ends, relative to the path
constexpr int kMostBorders = 16;       // between two neighbouring points
constexpr int kGaussPoints = 3;

ProbePoint nothingAt(double distance, ProbePoint like) {
  like.at = distance;
  like.body = ProbePoint::kOutside;
  like.current.setConstant(ProbePoint::kNone);
  like.reference.setConstant(ProbePoint::kNone);
  like.values.setConstant(ProbePoint::kNone);
  return like;
}

/// Adds the two points around each border between two points of a path.
void addBorders(const PathProbe& probe, ProbePoint from, const ProbePoint& to, double resolution,
                std::vector<ProbePoint>& points) {
  for (int k = 0; k < kMostBorders && from.body != to.body; ++k) {
    ProbePoint before = from, behind = to;
    while (behind.at - before.at > resolution) {
      ProbePoint middle = probe(0.5 * (before.at + behind.at));
      (middle.body == from.body ? before : behind) = std::move(middle);
    }
    points.push_back(before);
    if (before.body != ProbePoint::kOutside && behind.body != ProbePoint::kOutside)
      points.push_back(nothingAt(before.at, before));
    points.push_back(behind);
    from = std::move(behind);
  }
}

/// Integrals along a path of fields, and of 1 where there is a value of them, from its first point on.
class RunningIntegral {
 public:
  RunningIntegral(const PathProbe& probe, std::vector<ProbePoint> points)
      : probe_(probe), points_(std::move(points)) {
    sums_.emplace_back(Eigen::ArrayX2d::Zero(points_.front().values.size(), 2));
    for (std::size_t k = 0; k + 1 < points_.size(); ++k)
      sums_.push_back(sums_.back() + over(k, points_[k + 1].at));
  }

  /// Fields x (integral, length), up to a distance.
  Eigen::ArrayX2d to(double distance) const {
    const auto above = std::ranges::upper_bound(points_, distance, {}, &ProbePoint::at);
    const auto k = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(above - points_.begin() - 1, 0, std::ssize(points_) - 2));
    return sums_[k] + over(k, distance);
  }

  Eigen::ArrayX2d total() const { return sums_.back(); }

 private:
  /// From a point to a distance no farther than the next one.
  Eigen::ArrayX2d over(std::size_t k, double end) const {
    static const QuadratureRule rule = gaussLegendre(kGaussPoints);
    const ProbePoint& begin = points_[k];
    Eigen::ArrayX2d sum = Eigen::ArrayX2d::Zero(begin.values.size(), 2);
    const double length = end - begin.at;
    if (begin.body == ProbePoint::kOutside || points_[k + 1].body != begin.body || !(length > 0.0))
      return sum;
    for (int q = 0; q < kGaussPoints; ++q) {
      const Eigen::ArrayXd values = probe_(begin.at + rule.points(q) * length).values.array();
      const Eigen::ArrayXd weight =
          values.isNaN().select(Eigen::ArrayXd::Zero(values.size()), rule.weights(q) * length);
      sum.col(0) += values.isNaN().select(Eigen::ArrayXd::Zero(values.size()), values) * weight;
      sum.col(1) += weight;
    }
    return sum;
  }

  const PathProbe& probe_;
  std::vector<ProbePoint> points_;
  std::vector<Eigen::ArrayX2d> sums_;  ///< up to each point
};

/// Integrals of the fields, and of 1 where there is a value of them, over a panel, weighed by
/// e^{-(distance - from)/penetration}.
Eigen::ArrayX2d weighed(const PathProbe& probe, double from, double begin, double length,
                        double penetration) {
  static const QuadratureRule rule = gaussLegendre(kGaussPoints);
  Eigen::ArrayX2d sum;
  for (int q = 0; q < kGaussPoints; ++q) {
    const double at = begin + rule.points(q) * length;
    const Eigen::ArrayXd values = probe(at).values.array();
    if (q == 0) sum.setZero(values.size(), 2);
    const Eigen::ArrayXd none = Eigen::ArrayXd::Zero(values.size());
    const Eigen::ArrayXd weight =
        values.isNaN().select(none, rule.weights(q) * length * std::exp(-(at - from) / penetration));
    sum.col(0) += values.isNaN().select(none, values) * weight;
    sum.col(1) += weight;
  }
  return sum;
}

}  // namespace

std::vector<ProbePoint> samplesAlong(const PathProbe& probe, double begin, double end, int count) {
  const double resolution = kResolution * std::max({std::abs(begin), std::abs(end), end - begin});
  std::vector<ProbePoint> points{probe(begin)};
  for (int k = 1; k < count; ++k) {
    throwIfInterrupted();
    const ProbePoint next = probe(k + 1 == count ? end : std::lerp(begin, end, k / (count - 1.0)));
    addBorders(probe, points.back(), next, resolution, points);
    points.push_back(next);
  }
  return points;
}

void requireAnyInside(const std::vector<ProbePoint>& samples, const char* path, const std::string& where) {
  if (std::ranges::all_of(samples, [](const ProbePoint& p) { return p.body == ProbePoint::kOutside; }))
    throw Error(fmt::format("{}: no point of it is {}", path, where));
}

std::vector<ProbePoint> windowAverages(const PathProbe& probe, std::vector<ProbePoint> samples, double width,
                                       double begin, double end) {
  const double share = (end - begin) / (samples.back().at - samples.front().at);
  const int count = 2 + static_cast<int>(std::min(1e6, share * static_cast<double>(samples.size())));
  const RunningIntegral integral(probe, samplesAlong(probe, begin, end, count));
  for (ProbePoint& sample : samples) {
    if (sample.body == ProbePoint::kOutside) continue;
    const Eigen::ArrayX2d sum = integral.to(std::min(end, sample.at + 0.5 * width)) -
                                integral.to(std::max(begin, sample.at - 0.5 * width));
    sample.values = sample.values.array().isNaN().select(sample.values, (sum.col(0) / sum.col(1)).matrix());
  }
  return samples;
}

std::vector<ProbePoint> penetrationAverages(const PathProbe& probe, std::vector<ProbePoint> samples,
                                            double penetration, double end) {
  constexpr double kDeepest = 40.0;      // over the penetration: where the weight is rounding
  constexpr double kLongestPanel = 0.5;  // likewise: three points have ten digits of the weight there
  const auto panelsOf = [&](double length) {
    return 1 + static_cast<int>(length / penetration / kLongestPanel);
  };
  const double last = samples.back().at, bottom = std::min(end, last + kDeepest * penetration);
  std::vector<ProbePoint> points = samples;
  if (bottom > last) {
    const std::vector<ProbePoint> below = samplesAlong(probe, last, bottom, 1 + panelsOf(bottom - last));
    points.insert(points.end(), below.begin() + 1, below.end());
  }
  Eigen::ArrayX2d deeper = Eigen::ArrayX2d::Zero(points.back().values.size(), 2);
  for (std::size_t k = points.size() - 1; k-- > 0;) {
    throwIfInterrupted();
    const double whole = points[k + 1].at - points[k].at, length = std::min(whole, kDeepest * penetration);
    deeper *= std::exp(-whole / penetration);
    if (points[k].body != ProbePoint::kOutside && points[k + 1].body == points[k].body) {
      const int panels = panelsOf(length);
      for (int panel = 0; panel < panels; ++panel)
        deeper += weighed(probe, points[k].at, points[k].at + length * panel / panels, length / panels,
                          penetration);
    }
    if (k >= samples.size() || samples[k].body == ProbePoint::kOutside) continue;
    // Where nothing lies deeper that has the field, the value at the point is the limit of the means above it.
    const Eigen::ArrayXd mean =
        (deeper.col(1) > 0.0).select(deeper.col(0) / deeper.col(1), samples[k].values.array());
    samples[k].values = samples[k].values.array().isNaN().select(samples[k].values, mean.matrix());
  }
  return samples;
}

Eigen::VectorXd meanAlong(const PathProbe& probe, std::vector<ProbePoint> samples) {
  const Eigen::ArrayX2d sum = RunningIntegral(probe, std::move(samples)).total();
  return (sum.col(1) > 0.0).select(sum.col(0) / sum.col(1), ProbePoint::kNone).matrix();
}

}  // namespace burnish
