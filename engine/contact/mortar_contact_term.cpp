#include "engine/contact/mortar_contact_term.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace burnish {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Part of its integral that R_A has to keep over points with partners to take part.
constexpr double kSmallestPart = 0.05;

/// Where unknowns stand in a list that is ascending and holds them all.
std::vector<Eigen::Index> placesIn(const std::vector<int>& all, const std::vector<int>& unknowns) {
  std::vector<Eigen::Index> places;
  for (const int unknown : unknowns) {
    const auto at = std::lower_bound(all.begin(), all.end(), unknown);
    assert(at != all.end() && *at == unknown);
    places.push_back(at - all.begin());
  }
  return places;
}

void sortOnce(std::vector<int>& unknowns) {
  std::sort(unknowns.begin(), unknowns.end());
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
}

}  // namespace

/// Averages of a function.
template <int Dim>
struct MortarContactTerm<Dim>::Average {
  std::vector<int> unknowns;             ///< what its points depend on, ascending
  double A = 0.0, G = 0.0, B = 0.0;      ///< ∫' R_A dΓ, ∫' R_A φ dΓ, ∫' R_A φ' dΓ
  Eigen::VectorXd D;                     ///< ∂G, unknowns
  Tangential slip = Tangential::Zero();  ///< ∫' R_A φ' s dΓ = B s_A
  double area = 0.0;                     ///< ∫' R_A j dΓ, j the stretch of area; where the law needs it
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< ∫' R_A X dΓ; with friction
  Rows T, S;                                        ///< S = B ∂s_A
};

template <int Dim>
struct MortarContactTerm<Dim>::Sums {
  std::vector<std::optional<ContactPoint<Dim>>> points;  ///< points of the parts
  std::vector<LimitedGap> limited;                       ///< points of the parts: φ, φ', φ''
  std::vector<std::vector<int>> unknowns;                ///< parts: what their points depend on, ascending
  std::vector<Average> averages;                         ///< functions
};

/// Tractions at a point.
template <int Dim>
struct MortarContactTerm<Dim>::Traction {
  double average = 0.0;                        ///< λ̂
  double normal = 0.0;                         ///< φ' λ̂
  Tangential tangential = Tangential::Zero();  ///< φ' t
};

template <int Dim>
MortarContactTerm<Dim>::MortarContactTerm(const Body<Dim>& body, int patch, FaceId face,
                                          const PartnerMaker<Dim>& makePartner, const ContactOptions& options,
                                          int firstMultiplier, const std::vector<DefinitionSpec>& definitions)
    : FaceContact<Dim>(body, patch, face, options, firstMultiplier, definitions),
      body_(body),
      partner_(makePartner(face_)),
      hasFriction_(options.hasFriction()) {
  A_ = Eigen::VectorXd::Zero(numMultipliers());
  for (std::size_t e = 0; e < face_.spans().size(); ++e) {
    const auto& span = face_.spans()[e];
    A_(span.functions) += span.R * span.weights;
    auto& own = slaveUnknowns_.emplace_back();
    for (const int a : span.functions)
      for (int d = 0; d < Dim; ++d) own.push_back(Dim * face_.nodes()[static_cast<std::size_t>(a)] + d);
  }
  requireAveragedGaps(A_.head(face_.numFunctions()), axisymmetric_);
  for (Eigen::Index A = 0; hasFriction_ && A < face_.numFunctions(); ++A)
    A_.template segment<Dim - 1>(face_.numFunctions() + (Dim - 1) * A).setConstant(A_(A));
  chooseParts();
}

template <int Dim>
void MortarContactTerm<Dim>::chooseParts() {
  parts_.clear();
  numPoints_ = 0;
  const auto add = [&](std::size_t e, Span rule) {
    rule.firstPoint = numPoints_;
    numPoints_ += static_cast<int>(rule.weights.size());
    parts_.push_back({e, std::move(rule)});
  };
  for (std::size_t e = 0; e < face_.spans().size(); ++e) {
    const Span& span = face_.spans()[e];
    const std::vector<Segment> segments = partner_->segments(e);
    if (segments.empty()) {
      add(e, span);
      continue;
    }
    if constexpr (Dim == 2) {
      hasSegments_ = true;
      const int points = options_.quadraturePoints.value_or(segmentPoints(face_.trace()));
      for (const Segment& segment : segments)
        if (segment.foot)
          add(e, face_.part(body_, span.number,
                            {Eigen::Vector<double, 1>(segment.begin), Eigen::Vector<double, 1>(segment.end)},
                            points));
    }
  }
}

template <int Dim>
CouplingGroups MortarContactTerm<Dim>::couplings() const {
  // Spans first, then one group per function with its multipliers.
  CouplingGroups groups;
  CouplingGroups ofFunctions(static_cast<std::size_t>(face_.numFunctions()));
  for (std::size_t e = 0; e < face_.spans().size(); ++e) {
    auto& group = groups.emplace_back(slaveUnknowns_[e]);
    const auto others = partner_->couplings(e);
    group.insert(group.end(), others.begin(), others.end());
    sortOnce(group);
    for (const int a : face_.spans()[e].functions) {
      auto& unknowns = ofFunctions[static_cast<std::size_t>(a)];
      unknowns.insert(unknowns.end(), group.begin(), group.end());
    }
  }
  for (int A = 0; A < face_.numFunctions(); ++A) {
    auto& group = ofFunctions[static_cast<std::size_t>(A)];
    sortOnce(group);
    const auto own = multiplierUnknowns(A);
    group.insert(group.end(), own.begin(), own.end());
    groups.push_back(std::move(group));
  }
  return groups;
}

template <int Dim>
std::vector<int> MortarContactTerm<Dim>::multiplierUnknowns(int A) const {
  std::vector<int> unknowns{firstMultiplier_ + A};
  for (int alpha = 0; hasFriction_ && alpha < Dim - 1; ++alpha)
    unknowns.push_back(firstMultiplier_ + face_.numFunctions() + (Dim - 1) * A + alpha);
  return unknowns;
}

template <int Dim>
Eigen::MatrixXd MortarContactTerm<Dim>::acceptedPoints(std::size_t e) const {
  const auto& functions = face_.spans()[e].functions;
  return face_.points()(Eigen::all, functions) +
         work_.acceptedUnknowns()(slaveUnknowns_[e]).reshaped(Dim, std::ssize(functions));
}

template <int Dim>
SlavePoint<Dim> MortarContactTerm<Dim>::pointAt(std::size_t e, const Span& rule, Eigen::Index q, int number,
                                                const Eigen::Ref<const Eigen::MatrixXd>& positions) const {
  const Eigen::Vector<double, Dim> position = positions.col(rule.firstPoint + q);
  Eigen::Vector<double, Dim> accepted = position;
  if (work_.acceptedUnknowns().size() > 0) accepted = acceptedPoints(e) * rule.R.col(q);
  return {e, number, rule.xi.col(q), slaveUnknowns_[e], rule.R.col(q), position, accepted};
}

template <int Dim>
SlavePoint<Dim> MortarContactTerm<Dim>::pointAt(const Part& part, Eigen::Index q,
                                                const Eigen::MatrixXd& positions) const {
  const int number = hasSegments_ ? -1 : part.rule.firstPoint + static_cast<int>(q);
  return pointAt(part.span, part.rule, q, number, positions);
}

/// With slip, if there is friction.
template <int Dim>
std::optional<ContactPoint<Dim>> MortarContactTerm<Dim>::contactAt(const SlavePoint<Dim>& slave) const {
  auto point = partner_->at(slave, PointDetail::Derivatives);
  if (point && hasFriction_) partner_->addSlip(slave, *point);
  return point;
}

template <int Dim>
LimitedGap MortarContactTerm<Dim>::limitedAt(std::size_t e, const ContactPoint<Dim>& point) const {
  return limitedGap(point.gap, options_.gapLimit.value_or(kAnyGap) * face_.spans()[e].size);
}

template <int Dim>
Eigen::MatrixXd MortarContactTerm<Dim>::partPositions(const Eigen::VectorXd& x) const {
  Eigen::MatrixXd positions(Dim, numPoints_);
  for (const Part& part : parts_)
    positions.middleCols(part.rule.firstPoint, part.rule.R.cols()) = face_.positions(part.rule, x);
  return positions;
}

/// Gaps and slips of all points, and the unknowns of each function's points. None if a segment has lost its
/// partner.
template <int Dim>
std::optional<typename MortarContactTerm<Dim>::Sums> MortarContactTerm<Dim>::measure(
    const Eigen::MatrixXd& positions) const {
  Sums sums;
  sums.points.resize(static_cast<std::size_t>(numPoints_));
  sums.limited.resize(sums.points.size());
  sums.averages.resize(static_cast<std::size_t>(face_.numFunctions()));
  for (const Part& part : parts_) {
    auto& unknowns = sums.unknowns.emplace_back();
    for (Eigen::Index q = 0; q < part.rule.R.cols(); ++q) {
      const auto number = static_cast<std::size_t>(part.rule.firstPoint + q);
      auto& point = sums.points[number] = contactAt(pointAt(part, q, positions));
      if (!point && hasSegments_) return std::nullopt;
      if (!point) continue;
      sums.limited[number] = limitedAt(part.span, *point);
      unknowns.insert(unknowns.end(), point->unknowns.begin(), point->unknowns.end());
    }
    sortOnce(unknowns);
    for (const int a : part.rule.functions) {
      auto& all = sums.averages[static_cast<std::size_t>(a)].unknowns;
      all.insert(all.end(), unknowns.begin(), unknowns.end());
    }
  }
  return sums;
}

template <int Dim>
void MortarContactTerm<Dim>::integrate(Sums& sums) const {
  std::vector<Eigen::VectorXd> curved;  // ∫' R_A φ'' N dΓ per function
  for (Average& average : sums.averages) {
    sortOnce(average.unknowns);
    const auto size = std::ssize(average.unknowns);
    average.D = Eigen::VectorXd::Zero(size);
    if (!hasFriction_) continue;
    average.T = average.S = Rows::Zero(size, Dim - 1);
    curved.emplace_back(Eigen::VectorXd::Zero(size));
  }
  for (const Part& part : parts_) {
    const Span& span = part.rule;
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const auto number = static_cast<std::size_t>(span.firstPoint + q);
      const auto& point = sums.points[number];
      if (!point) continue;
      const LimitedGap& limited = sums.limited[number];
      const double stretch = frictionLaw_.needsStretch()
                                 ? areaStretch(span.functions, acceptedPoints(part.span), span.R.col(q),
                                               span.dR.middleCols((Dim - 1) * q, Dim - 1))
                                 : 0.0;
      Eigen::Vector3d place = Eigen::Vector3d::Zero();
      if (hasFriction_) place = this->referencePlace(span.functions, span.R.col(q));
      for (std::size_t a = 0; a < span.functions.size(); ++a) {
        const auto A = static_cast<std::size_t>(span.functions[a]);
        const double wR = span.weights(q) * span.R(static_cast<Eigen::Index>(a), q);
        const double slope = wR * limited.slope;
        auto& average = sums.averages[A];
        average.A += wR;
        average.G += wR * limited.value;
        average.B += slope;
        average.area += wR * stretch;
        // The rows of unknowns that stand on both sides are added one after the other.
        const auto places = placesIn(average.unknowns, point->unknowns);
        for (std::size_t i = 0; i < places.size(); ++i) {
          const auto row = static_cast<Eigen::Index>(i);
          average.D(places[i]) += slope * point->dGap(row);
          if (!hasFriction_) continue;
          average.T.row(places[i]) += slope * point->virtualSlip.row(row);
          average.S.row(places[i]) += slope * point->dSlip.row(row);
          if (limited.curvature == 0.0) continue;
          const double turned = wR * limited.curvature * point->dGap(row);
          average.S.row(places[i]) += turned * point->slip.transpose();
          curved[A](places[i]) += turned;
        }
        if (!hasFriction_) continue;
        average.slip += slope * point->slip;
        average.place += wR * place;
      }
    }
  }
  for (std::size_t A = 0; A < curved.size(); ++A) {
    Average& average = sums.averages[A];
    if (options_.gapLimit && average.B > 0.0) average.S -= curved[A] / average.B * average.slip.transpose();
  }
}

template <int Dim>
FrictionTraction<Dim - 1> MortarContactTerm<Dim>::frictionOf(int A, const Average& average, double t,
                                                             const Eigen::VectorXd& x) const {
  const auto a = static_cast<std::size_t>(A);
  if (!state_.active[a]) {
    FrictionTraction<Dim - 1> none;
    none.byTrial.setZero();
    return none;
  }
  const Tangential tau = x.template segment<Dim - 1>(firstMultiplier_ + face_.numFunctions() + (Dim - 1) * A);
  const Tangential trial = tau + frictionParameter() / average.B * average.slip;
  const FrictionPlace place{average.place / average.A, t, slipped_(A), average.area / average.A};
  return coulombTraction<Dim - 1>(trial, state_.lambdaHat(A), frictionLaw_.at(place, -state_.lambdaHat(A)));
}

template <int Dim>
bool MortarContactTerm<Dim>::evaluate(double t, const Eigen::VectorXd& x, Assembly& out) {
  const Eigen::MatrixXd positions = face_.positions(x);
  if (!partner_->update(t, x, positions)) return false;
  if (hasFriction_) work_.start(x);
  const Eigen::MatrixXd ofParts = hasSegments_ ? partPositions(x) : positions;
  std::optional<Sums> sums = measure(ofParts);
  if (!sums) return false;
  if (partner_->hasLeftCouplings()) {
    partner_->widenCouplings();
    return false;
  }
  integrate(*sums);
  const std::vector<bool> before = std::move(state_.active);
  state_ = {};
  addFunctions(t, x, out, *sums);
  state_.countChanges(before);
  addPoints(out, ofParts, *sums);
  reportPoints(positions, *sums);
  if (hasFriction_) {
    work_.end(*partner_);
    state_.frictionWork = work_.work();
    this->reportSlipped();
  }
  if (axisymmetric_) state_.keepAxialReaction();
  return true;
}

template <int Dim>
void MortarContactTerm<Dim>::addFunctions(double t, const Eigen::VectorXd& x, Assembly& out,
                                          const Sums& sums) {
  const int numFunctions = face_.numFunctions();
  const double eps = parameter(), epsT = frictionParameter();
  state_.averageGap = Eigen::VectorXd::Constant(numFunctions, kInfinity);
  state_.lambdaHat = Eigen::VectorXd::Zero(numFunctions);
  state_.active.assign(static_cast<std::size_t>(numFunctions), false);
  tractions_.assign(hasFriction_ ? static_cast<std::size_t>(numFunctions) : 0, {});
  for (int A = 0; A < numFunctions; ++A) {
    const auto a = static_cast<std::size_t>(A);
    const Average& average = sums.averages[a];
    const double lambda = x(firstMultiplier_ + A);
    if (average.A > kSmallestPart * A_(A)) {
      state_.averageGap(A) = average.G / average.A;
      state_.lambdaHat(A) = lambda + eps * state_.averageGap(A);
      state_.active[a] = state_.lambdaHat(A) <= 0.0 && average.B > kOpenSlope * average.A;
    }
    const bool active = state_.active[a];
    if (!active) state_.lambdaHat(A) = 0.0;
    std::vector<int> unknowns;
    if (active) unknowns = average.unknowns;
    const Eigen::Index n = std::ssize(unknowns), size = n + (hasFriction_ ? Dim : 1);
    // Of functions that are not active, what vanishes over the face is weighed as all of it.
    const double weight = active ? average.A : A_(A);
    Eigen::MatrixXd K;
    if (out.system != nullptr) K = Eigen::MatrixXd::Zero(size, size);
    if (active) {
      out.force(unknowns) += state_.lambdaHat(A) * average.D;
      out.force(firstMultiplier_ + A) += average.G;
      if (out.system != nullptr)
        K.topLeftCorner(n + 1, n + 1) = averagedGapTangent(average.D, eps / weight, true);
    } else {
      out.force(firstMultiplier_ + A) -= lambda * weight / eps;
      if (out.system != nullptr) K(n, n) = -weight / eps;
    }
    if (hasFriction_) {
      const int first = firstMultiplier_ + numFunctions + (Dim - 1) * A;
      const auto& law = tractions_[a] = frictionOf(A, average, t, x);
      if (active) {
        ++(law.slips ? state_.slipping : state_.sticking);
        const Eigen::VectorXd force = average.T * law.traction;
        out.force(unknowns) += force;
        work_.force()(unknowns) += force;
      }
      out.force.template segment<Dim - 1>(first) +=
          weight / epsT * (law.traction - x.template segment<Dim - 1>(first));
      if (out.system != nullptr) {
        const auto tau = Eigen::seqN(n + 1, Dim - 1), own = Eigen::seqN(0, n);
        K(tau, tau) += weight / epsT * (law.byTrial - Eigen::Matrix<double, Dim - 1, Dim - 1>::Identity());
        if (active) {
          const Rows TM = average.T * law.byTrial, SM = average.S * law.byTrial.transpose();
          const Eigen::VectorXd Tc = average.T * law.byPressure;
          K(own, own) +=
              epsT / average.B * TM * average.S.transpose() + eps / weight * Tc * average.D.transpose();
          K(own, tau) += TM;
          K.col(n).head(n) += Tc;
          K(tau, own) +=
              weight / average.B * SM.transpose() + eps / epsT * law.byPressure * average.D.transpose();
          K(tau, n) += weight / epsT * law.byPressure;
        }
      }
    }
    if (out.system == nullptr) continue;
    const auto own = multiplierUnknowns(A);
    unknowns.insert(unknowns.end(), own.begin(), own.end());
    out.system->add(unknowns, K);
  }
}

template <int Dim>
typename MortarContactTerm<Dim>::Traction MortarContactTerm<Dim>::tractionAt(
    const std::vector<int>& functions, const Eigen::Ref<const Eigen::VectorXd>& R,
    const LimitedGap& limited) const {
  Traction traction;
  traction.average = R.dot(state_.lambdaHat(functions));
  traction.normal = limited.slope * traction.average;
  if (!hasFriction_) return traction;
  for (std::size_t a = 0; a < functions.size(); ++a)
    traction.tangential +=
        R(static_cast<Eigen::Index>(a)) * tractions_[static_cast<std::size_t>(functions[a])].traction;
  traction.tangential *= limited.slope;
  return traction;
}

/// ∫' λ̂ (φ' ∂²g + φ'' N Nᵀ) + ∂(φ' t·δs_T) dΓ, and resultants.
template <int Dim>
void MortarContactTerm<Dim>::addPoints(Assembly& out, const Eigen::MatrixXd& positions, const Sums& sums) {
  const Eigen::Vector3d pivot = partner_->pivot();
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Span& span = parts_[k].rule;
    const auto& unknowns = sums.unknowns[k];
    Eigen::VectorXd pressure = Eigen::VectorXd::Zero(span.R.cols());
    Eigen::MatrixXd K;
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const auto number = static_cast<std::size_t>(span.firstPoint + q);
      const auto& point = sums.points[number];
      if (!point) continue;
      const LimitedGap& limited = sums.limited[number];
      const auto [average, lambdaHat, traction] = tractionAt(span.functions, span.R.col(q), limited);
      const double w = span.weights(q);
      pressure(q) = -lambdaHat;
      Eigen::Vector3d normalForce = Eigen::Vector3d::Zero(), tangentialForce = Eigen::Vector3d::Zero();
      normalForce.template head<Dim>() = w * lambdaHat * point->normal;
      if (hasFriction_) {
        tangentialForce.template head<Dim>() = w * point->frame * traction;
        state_.frictionForce += w * traction.norm();
      }
      Eigen::Vector3d arm = -pivot;
      arm.head<Dim>() += positions.col(span.firstPoint + q);
      state_.reaction += normalForce + tangentialForce;
      state_.moment += arm.cross(normalForce + tangentialForce);
      work_.reaction() += tangentialForce;
      work_.moment() += arm.cross(tangentialForce);
      if (out.system == nullptr || (lambdaHat == 0.0 && traction.isZero(0.0))) continue;
      if (K.size() == 0) K = Eigen::MatrixXd::Zero(std::ssize(unknowns), std::ssize(unknowns));
      const auto slave = pointAt(parts_[k], q, positions);
      const auto add = [&](const std::vector<int>& of, const Eigen::MatrixXd& part) {
        const auto places = placesIn(unknowns, of);
        for (std::size_t j = 0; j < places.size(); ++j)
          for (std::size_t i = 0; i < places.size(); ++i)
            K(places[i], places[j]) += part(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      };
      const auto curved = partner_->at(slave, PointDetail::SecondDerivatives);
      add(curved->unknowns, w * lambdaHat * curved->d2Gap);
      if (hasFriction_) add(point->unknowns, w * partner_->frictionTangent(slave, *point, traction));
      if (limited.curvature == 0.0) continue;
      Eigen::VectorXd force = average * point->dGap;
      if (hasFriction_) force += point->virtualSlip * traction / limited.slope;
      add(point->unknowns, w * limited.curvature * force * point->dGap.transpose());
    }
    state_.pressed += span.weights.dot(pressure);
    if (out.system != nullptr && K.size() > 0) out.system->add(unknowns, K);
  }
}

/// What there is to say of a quadrature point of the face.
template <int Dim>
void MortarContactTerm<Dim>::reportPoint(const Span& span, Eigen::Index q, const ContactPoint<Dim>& point,
                                         const LimitedGap& limited) {
  const Eigen::Index number = span.firstPoint + q;
  const Traction traction = tractionAt(span.functions, span.R.col(q), limited);
  state_.gap(number) = point.gap;
  state_.pressure(number) = -traction.normal;
  state_.normal.col(number).template head<Dim>() = point.normal;
  if (!hasFriction_) return;
  state_.traction.col(number).template head<Dim>() = point.frame * traction.tangential;
  state_.slip.col(number).template head<Dim>() = point.frame * point.slip;
  // As the function does that is largest here.
  Eigen::Index largest = 0;
  span.R.col(q).maxCoeff(&largest);
  const auto& law = tractions_[static_cast<std::size_t>(span.functions[static_cast<std::size_t>(largest)])];
  if (traction.normal < 0.0) state_.sliding[static_cast<std::size_t>(number)] = law.slips ? 2 : 1;
}

template <int Dim>
void MortarContactTerm<Dim>::reportPoints(const Eigen::MatrixXd& positions, const Sums& sums) {
  state_.gap = Eigen::VectorXd::Constant(face_.numPoints(), kInfinity);
  state_.pressure = Eigen::VectorXd::Zero(face_.numPoints());
  state_.normal = Eigen::MatrixXd::Zero(3, face_.numPoints());
  if (hasFriction_) {
    state_.traction = state_.slip = Eigen::Matrix3Xd::Zero(3, face_.numPoints());
    state_.sliding.assign(static_cast<std::size_t>(face_.numPoints()), 0);
  }
  for (std::size_t e = 0; e < face_.spans().size(); ++e) {
    const Span& span = face_.spans()[e];
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const int number = span.firstPoint + static_cast<int>(q);
      if (!hasSegments_) {
        const auto& point = sums.points[static_cast<std::size_t>(number)];
        if (point) reportPoint(span, q, *point, sums.limited[static_cast<std::size_t>(number)]);
      } else if (const auto point = contactAt(pointAt(e, span, q, number, positions))) {
        reportPoint(span, q, *point, limitedAt(e, *point));
      }
    }
  }
}

template <int Dim>
void MortarContactTerm<Dim>::accept() {
  partner_->accept();
  if (hasSegments_) chooseParts();
  if (!hasFriction_) return;
  work_.accept();
  this->acceptSlipped();
}

template <int Dim>
void MortarContactTerm<Dim>::archive(StateArchive& archive) {
  partner_->archive(archive);
  if (hasSegments_ && archive.restores()) chooseParts();
  if (!hasFriction_) return;
  archive.part("friction", work_);
  archive.fixedField("slipped", slipped_);
}

template class MortarContactTerm<2>;
template class MortarContactTerm<3>;

}  // namespace burnish
