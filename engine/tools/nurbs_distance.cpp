#include "engine/tools/nurbs_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/error.h"
#include "engine/tools/outline_parts.h"

namespace burnish::inline tools {
namespace {

/// Lengths below this share of the patch's size are zero.
constexpr double kTiny = 1e-13;
/// Two points that are closer than this share of the size are the same control point.
constexpr double kSame = 1e-10;

/// A knot span of degree p > 1 is cut into this many times p pieces to be drawn and searched: 5 degrees each
/// for a quarter of a circle.
constexpr int kCutsPerDegree = 9;

}  // namespace

template <int P>
NurbsDistance<P>::NurbsDistance(Patch<P, 3> patch, bool flip)
    : patch_(std::move(patch)), side_(flip ? -1.0 : 1.0) {
  size_ = (patch_.points().rowwise().maxCoeff() - patch_.points().rowwise().minCoeff()).norm();
  findIntervals();
  for (int d = 0; d < P; ++d) joined_[static_cast<std::size_t>(d)] = isJoined(d);
  tessellate();
  if (mesh_.cells.cols() == 0) throw Error(P == 1 ? "the curve has no length" : "the surface has no area");
  tree_.emplace(mesh_.points, mesh_.cells);
  mesh_.closed = true;
  for (int d = 0; d < P; ++d)
    mesh_.closed = mesh_.closed && (joined_[static_cast<std::size_t>(d)] ||
                                    (P == 2 && isCollapsed(2 * d) && isCollapsed(2 * d + 1)));
}

template <int P>
void NurbsDistance<P>::findIntervals() {
  for (int d = 0; d < P; ++d) {
    const UnivariateBasis& basis = patch_.basis().direction(d);
    auto& intervals = intervals_[static_cast<std::size_t>(d)];
    int first = 0;
    for (int e = 0; e < basis.numSpans(); ++e) {
      const auto multiplicity = std::count(basis.knots().begin(), basis.knots().end(), basis.spanEnd(e));
      if (multiplicity < basis.degree()) continue;
      intervals.push_back({first, e, basis.spanBegin(first), basis.spanEnd(e)});
      first = e + 1;
    }
  }
}

template <int P>
bool NurbsDistance<P>::isJoined(int direction) const {
  const auto first = faceLayer(2 * direction), last = faceLayer(2 * direction + 1);
  for (std::size_t k = 0; k < first.size(); ++k)
    if ((patch_.points().col(first[k]) - patch_.points().col(last[k])).norm() > kSame * size_ ||
        std::abs(patch_.weights()(first[k]) - patch_.weights()(last[k])) > kSame)
      return false;
  return true;
}

template <int P>
bool NurbsDistance<P>::isCollapsed(FaceId face) const {
  const auto layer = faceLayer(face);
  return std::all_of(layer.begin(), layer.end(), [&](int a) {
    return (patch_.points().col(a) - patch_.points().col(layer.front())).norm() <= kSame * size_;
  });
}

/// Control points on an end of a direction, in the same order on both ends.
template <int P>
std::vector<int> NurbsDistance<P>::faceLayer(FaceId face) const {
  const auto direction = static_cast<std::size_t>(face / 2);
  const int layer = face % 2 == 0 ? 0 : patch_.basis().direction(face / 2).numFunctions() - 1;
  std::vector<int> functions;
  for (int a = 0; a < patch_.basis().numFunctions(); ++a)
    if (patch_.basis().functionIndex(a)[direction] == layer) functions.push_back(a);
  return functions;
}

/// Parameters at which an interval of a direction is cut.
template <int P>
std::vector<double> NurbsDistance<P>::cutsOf(int direction, const Interval& interval) const {
  const UnivariateBasis& basis = patch_.basis().direction(direction);
  const int cuts = basis.degree() == 1 ? 1 : kCutsPerDegree * basis.degree();
  std::vector<double> values{interval.begin};
  for (int e = interval.first; e <= interval.last; ++e)
    for (int k = 1; k <= cuts; ++k)
      values.push_back(basis.spanBegin(e) + (basis.spanEnd(e) - basis.spanBegin(e)) * k / cuts);
  return values;
}

template <int P>
void NurbsDistance<P>::tessellate() {
  std::vector<SurfaceMesh> meshes;
  const std::size_t across = intervals_[0].size(), pieces = across * intervals_[P - 1].size();
  for (std::size_t k = 0; k < (P == 1 ? across : pieces); ++k) {
    Index piece{};
    piece[0] = static_cast<int>(k % across);
    std::vector<double> seconds{0.0};
    if constexpr (P == 2) {
      piece[1] = static_cast<int>(k / across);
      seconds = cutsOf(1, intervals_[1][k / across]);
    }
    std::vector<std::vector<Eigen::Vector3d>> rows;
    for (const double v : seconds) {
      rows.emplace_back();
      for (const double u : cutsOf(0, intervals_[0][k % across])) {
        Parameter xi = Parameter::Constant(v);
        xi(0) = u;
        parameters_.push_back(xi);
        rows.back().push_back(evaluate(piece, xi).y);
      }
    }
    meshes.push_back(P == 1 ? line(rows.front(), false) : strips(rows, false, false));
    cellPieces_.insert(cellPieces_.end(), static_cast<std::size_t>(meshes.back().cells.cols()), piece);
  }
  mesh_ = together(meshes);
}

template <int P>
SurfaceMesh NurbsDistance<P>::outline() const {
  return side_ < 0.0 ? turnedOver(mesh_) : mesh_;
}

template <int P>
double NurbsDistance<P>::halfThickness() const {
  if (!isSolid(outline())) return std::numeric_limits<double>::infinity();
  const Eigen::Vector3d extent = mesh_.points.rowwise().maxCoeff() - mesh_.points.rowwise().minCoeff();
  return 0.5 * extent.head<P + 1>().minCoeff();
}

/// Position and derivatives from the homogeneous ones: y = A/W, y_a = (A_a - W_a y)/W,
/// y_ab = (A_ab - W_a y_b - W_b y_a - W_ab y)/W.
template <int P>
typename NurbsDistance<P>::Local NurbsDistance<P>::evaluate(const Index& piece, const Parameter& xi) const {
  const TensorBasis<P>& basis = patch_.basis();
  Index spans{};
  std::array<Eigen::MatrixXd, P> values;
  for (int d = 0; d < P; ++d) {
    const auto k = static_cast<std::size_t>(d);
    const Interval& interval = intervals_[k][static_cast<std::size_t>(piece[k])];
    spans[k] = std::clamp(basis.direction(d).findSpan(xi(d)), interval.first, interval.last);
    values[k] = basis.direction(d).evaluate(spans[k], xi(d), 2);
  }
  const auto functions = basis.spanFunctions(basis.spanNumber(spans));
  const auto sum = [&](const std::array<int, P>& order) {
    Eigen::Vector4d total = Eigen::Vector4d::Zero();
    for (std::size_t a = 0; a < functions.size(); ++a) {
      const auto local = static_cast<Eigen::Index>(a);
      double N = values[0](local % values[0].rows(), order[0]);
      if constexpr (P == 2) N *= values[1](local / values[0].rows(), order[1]);
      N *= patch_.weights()(functions[a]);
      total += N * patch_.points().col(functions[a]).homogeneous();
    }
    return total;
  };
  const auto order = [](int a, int b) {
    std::array<int, P> result{};
    for (const int d : {a, b})
      if (d >= 0) ++result[static_cast<std::size_t>(d)];
    return result;
  };
  const Eigen::Vector4d A = sum(order(-1, -1));
  Local local;
  local.y = A.head<3>() / A(3);
  Eigen::Vector<double, P> W;
  for (int a = 0; a < P; ++a) {
    const Eigen::Vector4d Aa = sum(order(a, -1));
    W(a) = Aa(3);
    local.dy.col(a) = (Aa.head<3>() - Aa(3) * local.y) / A(3);
  }
  for (int a = 0; a < P; ++a)
    for (int b = 0; b <= a; ++b) {
      const Eigen::Vector4d Aab = sum(order(a, b));
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      local.ddy[i][j] = local.ddy[j][i] =
          (Aab.head<3>() - W(a) * local.dy.col(b) - W(b) * local.dy.col(a) - Aab(3) * local.y) / A(3);
    }
  return local;
}

/// Not of length one.
template <int P>
Eigen::Vector3d NurbsDistance<P>::outward(const Local& local) const {
  if constexpr (P == 1)
    return side_ * local.dy.col(0).cross(Eigen::Vector3d::UnitZ());
  else
    return side_ * local.dy.col(0).cross(local.dy.col(1));
}

template <int P>
typename NurbsDistance<P>::Foot NurbsDistance<P>::start(const Eigen::Vector3d& x) const {
  const FacetTree::Hit hit = tree_->nearest(x);
  const auto corner = [&](int k) { return mesh_.cells(k, hit.cell); };
  const Eigen::Vector3d origin = mesh_.points.col(corner(0));
  Eigen::Matrix<double, 3, P> edges;
  for (int k = 0; k < P; ++k) edges.col(k) = mesh_.points.col(corner(k + 1)) - origin;
  const Eigen::Vector<double, P> share =
      (edges.transpose() * edges).inverse() * edges.transpose() * (hit.point - origin);
  const auto at = [&](int k) { return parameters_[static_cast<std::size_t>(corner(k))]; };
  Foot foot;
  foot.piece = cellPieces_[static_cast<std::size_t>(hit.cell)];
  foot.xi = at(0);
  for (int k = 0; k < P; ++k) foot.xi += share(k) * (at(k + 1) - at(0));
  return foot;
}

/// Evaluates a foot and finds at which ends of its piece the distance would fall further outside.
template <int P>
void NurbsDistance<P>::look(Foot& foot, const Eigen::Vector3d& x) const {
  foot.local = evaluate(foot.piece, foot.xi);
  const Eigen::Vector3d r = foot.local.y - x;
  foot.distance = r.norm();
  foot.residual = 0.0;
  for (int d = 0; d < P; ++d) {
    const auto k = static_cast<std::size_t>(d);
    const Interval& interval = intervals_[k][static_cast<std::size_t>(foot.piece[k])];
    const double slope = r.dot(foot.local.dy.col(d));
    const double small = kTiny * size_ * foot.local.dy.col(d).norm();
    foot.held[k] = 0;
    if (foot.xi(d) <= interval.begin && slope > small) foot.held[k] = -1;
    if (foot.xi(d) >= interval.end && slope < -small) foot.held[k] = 1;
    if (foot.held[k] == 0 && small > 0.0)
      foot.residual = std::max(foot.residual, std::abs(slope) / foot.local.dy.col(d).norm());
  }
}

/// Newton's step for ½|y - x|² in the directions that are not held, without curvature where that is not
/// convex; `coupled`: else in every direction alone, which goes down also where the piece ends.
template <int P>
typename NurbsDistance<P>::Parameter NurbsDistance<P>::stepFrom(const Foot& foot, const Eigen::Vector3d& x,
                                                                bool coupled) const {
  const Eigen::Vector3d r = foot.local.y - x;
  Parameter slope = foot.local.dy.transpose() * r;
  Eigen::Matrix<double, P, P> metric = foot.local.dy.transpose() * foot.local.dy;
  if (!coupled) metric = 2.0 * metric.diagonal().asDiagonal().toDenseMatrix();
  Eigen::Matrix<double, P, P> hessian = metric;
  for (int a = 0; a < P && coupled; ++a)
    for (int b = 0; b < P; ++b)
      hessian(a, b) += r.dot(foot.local.ddy[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)]);
  for (int d = 0; d < P; ++d) {
    if (foot.held[static_cast<std::size_t>(d)] == 0 && metric(d, d) > kTiny * kTiny * size_ * size_) continue;
    slope(d) = 0.0;
    for (auto* matrix : {&metric, &hessian}) {
      matrix->row(d).setZero();
      matrix->col(d).setZero();
      (*matrix)(d, d) = 1.0;
    }
  }
  const Eigen::LLT<Eigen::Matrix<double, P, P>> convex(hessian);
  if (convex.info() == Eigen::Success) return -convex.solve(slope);
  return -metric.ldlt().solve(slope);
}

/// Goes from a foot along a step, shortened until the distance falls or, where rounding hides that, the
/// slope. False if it does not.
template <int P>
bool NurbsDistance<P>::goAlong(Foot& foot, const Parameter& step, const Eigen::Vector3d& x) const {
  constexpr int kHalvings = 12;
  constexpr double kRounding = 1e-12;
  Foot next = foot;
  double factor = 1.0;
  for (int halving = 0; halving < kHalvings; ++halving, factor *= 0.5) {
    for (int d = 0; d < P; ++d) {
      const auto k = static_cast<std::size_t>(d);
      const Interval& interval = intervals_[k][static_cast<std::size_t>(foot.piece[k])];
      next.xi(d) = std::clamp(foot.xi(d) + factor * step(d), interval.begin, interval.end);
    }
    if (next.xi == foot.xi) return false;
    look(next, x);
    const bool isCloser = next.distance < foot.distance * (1.0 - kRounding);
    const bool isFlatter =
        next.distance <= foot.distance * (1.0 + kRounding) && next.residual < 0.5 * foot.residual;
    if (!isCloser && !isFlatter) continue;
    foot = next;
    return true;
  }
  return false;
}

template <int P>
void NurbsDistance<P>::project(Foot& foot, const Eigen::Vector3d& x) const {
  constexpr int kIterations = 100;
  look(foot, x);
  for (int iteration = 0; iteration < kIterations && foot.residual > kTiny * size_; ++iteration)
    if (!goAlong(foot, stepFrom(foot, x, true), x) && !goAlong(foot, stepFrom(foot, x, false), x)) return;
}

template <int P>
std::optional<typename NurbsDistance<P>::Foot> NurbsDistance<P>::across(const Foot& foot,
                                                                        int direction) const {
  const auto d = static_cast<std::size_t>(direction);
  const int count = static_cast<int>(intervals_[d].size());
  Foot other = foot;
  other.piece[d] += foot.held[d];
  if (other.piece[d] < 0 || other.piece[d] >= count) {
    if (!joined_[d]) return std::nullopt;
    other.piece[d] = (other.piece[d] + count) % count;
  }
  const Interval& interval = intervals_[d][static_cast<std::size_t>(other.piece[d])];
  other.xi(direction) = foot.held[d] < 0 ? interval.end : interval.begin;
  other.local = evaluate(other.piece, other.xi);
  return other;
}

template <int P>
typename NurbsDistance<P>::Foot NurbsDistance<P>::closest(const Eigen::Vector3d& x) const {
  constexpr int kPieces = 8;
  Foot best = start(x);
  project(best, x);
  for (int piece = 0; piece < kPieces; ++piece) {
    bool better = false;
    for (int d = 0; d < P && !better; ++d) {
      if (best.held[static_cast<std::size_t>(d)] == 0) continue;
      auto other = across(best, d);
      if (!other) continue;
      project(*other, x);
      better = other->distance < best.distance * (1.0 - 1e-14);
      if (better) best = *other;
    }
    if (!better) break;
  }
  return best;
}

template <int P>
bool NurbsDistance<P>::isAtRim(const Foot& foot) const {
  for (int d = 0; d < P; ++d)
    if (foot.held[static_cast<std::size_t>(d)] != 0 && !across(foot, d)) return true;
  return false;
}

/// Mean of the normals of the pieces that meet in the point.
template <int P>
Eigen::Vector3d NurbsDistance<P>::meanNormal(const Foot& foot) const {
  std::vector<Foot> feet{foot};
  for (int d = 0; d < P; ++d) {
    if (foot.held[static_cast<std::size_t>(d)] == 0) continue;
    const std::size_t known = feet.size();
    for (std::size_t k = 0; k < known; ++k)
      if (const auto other = across(feet[k], d)) feet.push_back(*other);
  }
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Foot& one : feet) mean += outward(one.local).normalized();
  return mean.normalized();
}

/// Where the closest point is inside a piece. With a_ab = y_a·y_b and b_ab = y_ab·n the point moves by
/// dξ = (a - g b)⁻¹ yᵀ dx and the normal by dn = -y a⁻¹ b dξ.
template <int P>
GapQuery NurbsDistance<P>::smoothGap(const Foot& foot, const Eigen::Vector3d& x) const {
  Local local = foot.local;
  const Eigen::Matrix<double, P, P> given = local.dy.transpose() * local.dy;
  if (given.diagonal().minCoeff() <= kSame * kSame * size_ * size_) {
    // A collapsed edge has no normal of its own; a hair beside it there is one.
    constexpr double kHair = 1e-6;
    Parameter beside = foot.xi;
    for (int d = 0; d < P; ++d) {
      const auto k = static_cast<std::size_t>(d);
      const Interval& interval = intervals_[k][static_cast<std::size_t>(foot.piece[k])];
      beside(d) += kHair * (0.5 * (interval.begin + interval.end) - beside(d));
    }
    local = evaluate(foot.piece, beside);
  }
  GapQuery answer;
  answer.normal = outward(local).normalized();
  answer.gap = (x - foot.local.y).dot(answer.normal);
  const Eigen::Matrix<double, P, P> a = local.dy.transpose() * local.dy;
  Eigen::Matrix<double, P, P> b;
  for (int i = 0; i < P; ++i)
    for (int j = 0; j < P; ++j)
      b(i, j) = local.ddy[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].dot(answer.normal);
  const Eigen::Matrix<double, P, P> moves = (a - answer.gap * b).eval().inverse();
  answer.dNormal = -local.dy * a.inverse() * b * moves * local.dy.transpose();
  return answer;
}

/// Where the closest point is on a kink or a rim: the distance to that point, or to that curve, along whose
/// tangent t it moves by t·dx / (t·t - (x - y)·y_tt). Beyond a rim every point is outside.
template <int P>
GapQuery NurbsDistance<P>::cornerGap(const Foot& foot, const Eigen::Vector3d& x) const {
  const Eigen::Vector3d away = x - foot.local.y;
  const Eigen::Vector3d mean = meanNormal(foot);
  GapQuery answer;
  if (foot.distance <= kTiny * size_) {
    answer.normal = mean;
    return answer;
  }
  const double sign = isAtRim(foot) || away.dot(mean) >= 0.0 ? 1.0 : -1.0;
  const Eigen::Vector3d m = away / foot.distance;
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity() - m * m.transpose();
  if constexpr (P == 1) H(2, 2) = 0.0;
  if constexpr (P == 2)
    for (std::size_t k = 0; k < 2; ++k)
      if (foot.held[k] == 0) {
        const Eigen::Vector3d t = foot.local.dy.col(static_cast<Eigen::Index>(k));
        const double stretch = t.squaredNorm() - away.dot(foot.local.ddy[k][k]);
        if (stretch > 0.0) H -= t * t.transpose() / stretch;
      }
  answer.gap = sign * foot.distance;
  answer.normal = sign * m;
  answer.dNormal = sign / foot.distance * H;
  return answer;
}

template <int P>
GapQuery NurbsDistance<P>::query(const Eigen::Vector3d& x) const {
  const Foot foot = closest(x);
  const bool isInside = std::all_of(foot.held.begin(), foot.held.end(), [](int held) { return held == 0; });
  GapQuery answer = isInside ? smoothGap(foot, x) : cornerGap(foot, x);
  answer.part = partOf(foot);
  return answer;
}

/// Of a curve: its knot spans, and a number below zero for each of the corners between and beyond its pieces.
template <int P>
int NurbsDistance<P>::partOf(const Foot& foot) const {
  if constexpr (P == 1) {
    const Interval& interval = intervals_[0][static_cast<std::size_t>(foot.piece[0])];
    if (foot.held[0] != 0) return -1 - foot.piece[0] - (foot.held[0] > 0 ? 1 : 0);
    return std::clamp(patch_.basis().direction(0).findSpan(foot.xi(0)), interval.first, interval.last);
  }
  return 0;
}

template class NurbsDistance<1>;
template class NurbsDistance<2>;

}  // namespace burnish::inline tools
