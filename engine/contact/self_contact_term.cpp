#include "engine/contact/self_contact_term.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/contact/partner_limits.h"

namespace burnish {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Stands for the parameter of a partner that is not there; a number that can be saved.
constexpr double kNone = -std::numeric_limits<double>::max();

/// Rounding errors of gaps, in parts of the body's size: touching parts are outside of one another.
constexpr double kRounding = 1e-12;

/// Part of its integral R_A has to keep over points with partners to take part.
constexpr double kSmallestPart = 0.1;

/// Gap over the distance to the centre of curvature, positive on its side.
double shareOfRadius(const SurfaceCurve::Point& point, double gap) {
  return point.isKink ? 0.0 : gap * point.ddx.dot(point.normal) / point.dx.squaredNorm();
}

}  // namespace

/// A quadrature point.
struct SelfContactTerm::Slave {
  double xi = 0.0;
  Eigen::Vector2d x, normal;
  double spanSize = 0.0;
  double along = 0.0;  ///< length of the curve up to it
};

/// Integrals over the reference face in the last evaluated state.
struct SelfContactTerm::Mortar {
  std::vector<std::optional<SurfaceCurve::Point>> partners;  ///< quadrature points
  Eigen::VectorXd gap;                                       ///< quadrature points, infinite without partners
  std::vector<LimitedGap> limited;                           ///< quadrature points: as averages take them
  Eigen::VectorXd A;                                         ///< ∫ R_A dΓ over points with partners
  Eigen::VectorXd G;                                         ///< ∫ R_A g dΓ of limited gaps
  Eigen::VectorXd S;                                         ///< ∫ R_A φ' dΓ of their slopes
  Eigen::MatrixXd D;  ///< ∂G_A/∂u: unknowns of the face x functions
};

SelfContactTerm::SelfContactTerm(const Body<2>& body, int patch, FaceId face, Options options,
                                 int firstMultiplier, bool mayPenetrate)
    : face_(body, patch, face, contactPoints(body, patch, options.quadraturePoints)),
      trace_(tracePatch(body.patches[static_cast<std::size_t>(patch)], face)),
      outward_(outwardSign(body.patches[static_cast<std::size_t>(patch)], face)),
      axisymmetric_(body.axisymmetric),
      rounding_(kRounding * body.size()),
      options_(options),
      firstMultiplier_(firstMultiplier),
      A_(Eigen::VectorXd::Zero(face_.numFunctions())),
      curve_(trace_, outward_) {
  for (const auto& span : face_.spans()) A_(span.functions) += span.R * span.weights;
  requireAveragedGaps(A_, body.axisymmetric);
  for (const int node : face_.nodes())
    for (int d = 0; d < 2; ++d) unknowns_.push_back(2 * node + d);
  partners_.assign(static_cast<std::size_t>(face_.numPoints()), kNone);
  findPartners(mayPenetrate);
}

CouplingGroups SelfContactTerm::couplings() const {
  // All nodes of the face; then, per function, those with its multiplier; then the multipliers alone.
  CouplingGroups groups{unknowns_};
  for (int A = 0; A < face_.numFunctions(); ++A) {
    groups.push_back(unknowns_);
    groups.back().push_back(firstMultiplier_ + A);
  }
  for (int A = 0; A < face_.numFunctions(); ++A) groups.push_back({firstMultiplier_ + A});
  return groups;
}

SurfaceCurve SelfContactTerm::curveAt(const Eigen::VectorXd& x) const {
  Eigen::MatrixXd points = trace_.points();
  points += x(unknowns_).reshaped(2, points.cols());
  return {{trace_.basis(), std::move(points), trace_.weights()}, outward_};
}

/// The closest point to a slave, if the two face each other; gaps down to -largestPenetration.
std::optional<SurfaceCurve::Point> SelfContactTerm::partnerOf(const Slave& slave, double start,
                                                              double largestPenetration) const {
  auto point = curve_.project(slave.x, start);
  if (!point || !(point->xi > slave.xi) || !(point->normal.dot(slave.normal) < kOpposed)) return std::nullopt;
  const UnivariateBasis& basis = trace_.basis().direction(0);
  const int last = basis.numSpans() - 1;
  if (point->xi > std::lerp(basis.spanEnd(last), basis.spanBegin(last), -kOverhang)) return std::nullopt;
  const double gap = (slave.x - point->x).dot(point->normal);
  if (!(gap > -largestPenetration - rounding_) || !(gap < reach())) return std::nullopt;
  if (shareOfRadius(*point, gap) > kShareOfRadius) return std::nullopt;
  return point;
}

/// A parameter near the partner of a slave that has none yet: the nearest quadrature point that faces it.
std::optional<double> SelfContactTerm::searchPartner(const std::vector<Slave>& slaves, std::size_t number,
                                                     bool mayPenetrate) const {
  const Slave& slave = slaves[number];
  const Slave* nearest = nullptr;
  double smallest = reach();
  for (std::size_t k = number + 1; k < slaves.size(); ++k) {
    const double distance = (slaves[k].x - slave.x).norm();
    if (!(distance < smallest) || !(slaves[k].normal.dot(slave.normal) < kOpposed)) continue;
    smallest = distance;
    nearest = &slaves[k];
  }
  if (nearest == nullptr) return std::nullopt;
  const double length = nearest->along - slave.along;
  const double penetration = mayPenetrate || length < kFold * slave.spanSize
                                 ? std::min(kShareOfLength * length, kShareOfSpan * slave.spanSize)
                                 : 0.0;
  const auto point = partnerOf(slave, nearest->xi, penetration);
  return point ? std::optional(point->xi) : std::nullopt;
}

void SelfContactTerm::findPartners(bool mayPenetrate) {
  std::vector<Slave> slaves;
  for (const auto& span : face_.spans())
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const auto point = curve_.at(span.xi(0, q));
      const double along = slaves.empty() ? 0.0 : slaves.back().along + (point.x - slaves.back().x).norm();
      slaves.push_back({point.xi, point.x, point.normal, span.size, along});
    }
  std::vector<bool> had;
  for (std::size_t k = 0; k < slaves.size(); ++k) {
    had.push_back(partners_[k] != kNone);
    if (!had[k]) continue;
    // The averages are what is closed: a partner that is known may be penetrated between them.
    const auto point = partnerOf(slaves[k], partners_[k], reach());
    partners_[k] = point ? point->xi : kNone;
  }
  for (std::size_t k = 0; k < slaves.size(); ++k) {
    if (partners_[k] != kNone) continue;
    const bool isBeside = (k > 0 && had[k - 1]) || (k + 1 < slaves.size() && had[k + 1]);
    partners_[k] = searchPartner(slaves, k, mayPenetrate || isBeside).value_or(kNone);
  }
}

/// False where a closest point is lost.
bool SelfContactTerm::integrate(Mortar& mortar) const {
  const Eigen::Index n = face_.numFunctions();
  mortar.partners.resize(partners_.size());
  mortar.gap = Eigen::VectorXd::Constant(face_.numPoints(), kInfinity);
  mortar.limited.resize(partners_.size());
  mortar.A = mortar.G = mortar.S = Eigen::VectorXd::Zero(n);
  mortar.D = Eigen::MatrixXd::Zero(2 * n, n);
  for (const auto& span : face_.spans()) {
    const Eigen::Matrix2Xd points = curve_.patch().points()(Eigen::all, span.functions) * span.R;
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const auto number = static_cast<std::size_t>(span.firstPoint + q);
      if (partners_[number] == kNone) continue;
      auto& partner = mortar.partners[number] = curve_.project(points.col(q), partners_[number]);
      if (!partner) return false;
      const Eigen::Vector2d& normal = partner->normal;
      const double gap = mortar.gap(span.firstPoint + q) = (points.col(q) - partner->x).dot(normal);
      if (shareOfRadius(*partner, gap) > kLargestShareOfRadius) return false;
      const LimitedGap& limited = mortar.limited[number] =
          limitedGap(gap, options_.gapLimit.value_or(kAnyGap) * span.size);
      const Eigen::Vector2d slope = limited.slope * normal;
      for (std::size_t a = 0; a < span.functions.size(); ++a) {
        const int A = span.functions[a];
        const double wR = span.weights(q) * span.R(static_cast<Eigen::Index>(a), q);
        mortar.A(A) += wR;
        mortar.G(A) += wR * limited.value;
        mortar.S(A) += wR * limited.slope;
        for (std::size_t b = 0; b < span.functions.size(); ++b)
          mortar.D.block<2, 1>(2 * span.functions[b], A) +=
              wR * span.R(static_cast<Eigen::Index>(b), q) * slope;
        for (std::size_t b = 0; b < partner->functions.size(); ++b)
          mortar.D.block<2, 1>(2 * partner->functions[b], A) -=
              wR * partner->R(static_cast<Eigen::Index>(b)) * slope;
      }
    }
  }
  return true;
}

bool SelfContactTerm::evaluate(double, const Eigen::VectorXd& x, Assembly& out) {
  curve_ = curveAt(x);
  Mortar mortar;
  if (!integrate(mortar)) return false;
  addForces(x, out, mortar);
  if (out.system != nullptr) addGeometricTangent(out, mortar);
  return true;
}

void SelfContactTerm::addForces(const Eigen::VectorXd& x, Assembly& out, const Mortar& mortar) {
  const double eps = parameter();
  const Eigen::Index n = face_.numFunctions();
  const std::vector<bool> before = std::move(state_.active);
  state_ = {};
  state_.averageGap = Eigen::VectorXd::Constant(n, kInfinity);
  state_.lambdaHat = Eigen::VectorXd::Zero(n);
  state_.active.assign(static_cast<std::size_t>(n), false);
  for (int A = 0; A < n; ++A) {
    const double lambda = x(firstMultiplier_ + A);
    bool active = false;
    if (mortar.A(A) > kSmallestPart * A_(A)) {
      state_.averageGap(A) = mortar.G(A) / mortar.A(A);
      state_.lambdaHat(A) = lambda + eps * state_.averageGap(A);
      active = state_.lambdaHat(A) <= 0.0 && mortar.S(A) > kOpenSlope * mortar.A(A);
    }
    state_.active[static_cast<std::size_t>(A)] = active;
    if (!active) {
      state_.lambdaHat(A) = 0.0;
      out.force(firstMultiplier_ + A) -= lambda * A_(A) / eps;
      if (out.system != nullptr)
        out.system->add(out.term, static_cast<std::size_t>(1 + n + A),
                        Eigen::MatrixXd::Constant(1, 1, -A_(A) / eps));
      continue;
    }
    const auto D = mortar.D.col(A);
    out.force(unknowns_) += state_.lambdaHat(A) * D;
    out.force(firstMultiplier_ + A) += mortar.G(A);
    if (out.system != nullptr)
      out.system->add(out.term, static_cast<std::size_t>(1 + A),
                      averagedGapTangent(D, eps / mortar.A(A), true));
  }
  state_.countChanges(before);
  state_.gap = mortar.gap;
  state_.partner = state_.normal = Eigen::Matrix2Xd::Zero(2, face_.numPoints());
  state_.pressure = Eigen::VectorXd::Zero(face_.numPoints());
  for (const auto& span : face_.spans()) {
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const auto& partner = mortar.partners[static_cast<std::size_t>(span.firstPoint + q)];
      if (!partner) continue;
      const double slope = mortar.limited[static_cast<std::size_t>(span.firstPoint + q)].slope;
      const double pressure = -slope * span.R.col(q).dot(state_.lambdaHat(span.functions));
      state_.pressure(span.firstPoint + q) = pressure;
      state_.partner.col(span.firstPoint + q) = partner->x;
      state_.normal.col(span.firstPoint + q) = partner->normal;
      state_.force -= span.weights(q) * pressure * partner->normal;
    }
  }
  if (axisymmetric_) state_.force(0) = 0.0;  // radial forces around the ring balance one another
}

/// ∫ λ̂ (φ' δ²g + φ'' (δg)²) dΓ of gaps that count as φ(g).
void SelfContactTerm::addGeometricTangent(Assembly& out, const Mortar& mortar) const {
  const auto n = static_cast<Eigen::Index>(unknowns_.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  bool any = false;
  for (const auto& span : face_.spans())
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const auto point = span.firstPoint + q;
      if (state_.pressure(point) == 0.0) continue;
      any = true;
      const auto& partner = *mortar.partners[static_cast<std::size_t>(point)];
      const double g = state_.gap(point);
      const Eigen::Vector2d t =
          partner.isKink ? Eigen::Vector2d(-partner.normal(1), partner.normal(0)) : partner.dx;
      std::vector<int> places;
      const Eigen::Index size = 2 * (span.R.rows() + partner.R.size());
      Eigen::VectorXd normal(size), tangential(size), turning = Eigen::VectorXd::Zero(size);
      Eigen::Index next = 0;
      const auto append = [&](int function, double R, const Eigen::Vector2d& turn) {
        for (int d = 0; d < 2; ++d) places.push_back(2 * function + d);
        normal.segment<2>(next) = R * partner.normal;
        tangential.segment<2>(next) = R * t;
        turning.segment<2>(next) = turn;
        next += 2;
      };
      for (Eigen::Index a = 0; a < span.R.rows(); ++a)
        append(span.functions[static_cast<std::size_t>(a)], span.R(a, q), Eigen::Vector2d::Zero());
      for (Eigen::Index b = 0; b < partner.R.size(); ++b)
        append(partner.functions[static_cast<std::size_t>(b)], -partner.R(b), partner.dR(b) * partner.normal);
      const double weighted = -span.weights(q) * state_.pressure(point);
      const LimitedGap& limited = mortar.limited[static_cast<std::size_t>(point)];
      Eigen::MatrixXd second = Eigen::MatrixXd::Zero(size, size);
      if (limited.curvature != 0.0)
        second = weighted * limited.curvature / limited.slope * normal * normal.transpose();
      if (!partner.isKink) {
        const double m = t.squaredNorm(), k = partner.normal.dot(partner.ddx), h = m - g * k;
        const Eigen::MatrixXd mixed = tangential * turning.transpose();
        second -= weighted / h *
                  (mixed + mixed.transpose() + k / m * tangential * tangential.transpose() +
                   g * turning * turning.transpose());
      } else if (g > rounding_) {
        second += weighted / g * tangential * tangential.transpose();
      }
      // A function may stand on both sides: its entries are added one after the other.
      for (std::size_t j = 0; j < places.size(); ++j)
        for (std::size_t i = 0; i < places.size(); ++i)
          K(places[i], places[j]) += second(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  if (any) out.system->add(out.term, 0, K);
}

Eigen::Matrix2Xd SelfContactTerm::positionsApart(double share) const {
  Eigen::Matrix2Xd positions(2, face_.numPoints());
  for (const auto& span : face_.spans()) {
    auto points = positions.middleCols(span.firstPoint, span.R.cols());
    points = curve_.patch().points()(Eigen::all, span.functions) * span.R;
    const double apart = share * span.size;
    for (Eigen::Index q = 0; q < points.cols(); ++q) {
      const auto number = span.firstPoint + q;
      if (std::abs(state_.gap(number)) < apart)
        points.col(q) = state_.partner.col(number) + apart * state_.normal.col(number);
    }
  }
  return positions;
}

}  // namespace burnish
