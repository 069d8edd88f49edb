#include "engine/contact/mortar_contact_term.h"

#include <cmath>
#include <utility>

#include "engine/contact/unknown_lists.h"

namespace burnish::inline contact {
namespace {

/// Part of its integral that R_A has to keep over points with partners to take part.
constexpr double kSmallestPart = 0.05;

/// Gap or overlap over the size of the body that means no pressure yet.
constexpr double kNoPressure = 1e-6;

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
    : PartnerTerm<Dim>(body, patch, face, makePartner, options, firstMultiplier, definitions,
                       PartnerTerm<Dim>::TractionsOf::Functions),
      body_(body) {
  chooseParts();
  requireAveragedGaps(A_, axisymmetric_);
  const Eigen::Index numFunctions = face_.numFunctions();
  if (numMultipliers() <= numFunctions) return;
  A_.conservativeResize(numMultipliers());
  for (Eigen::Index A = 0; A < numFunctions; ++A)
    A_.template segment<Dim - 1>(numFunctions + (Dim - 1) * A).setConstant(A_(A));
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
    const auto& group = groups.emplace_back(this->spanCouplings(e));
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
  if (numMultipliers() == 0) return {};
  std::vector<int> unknowns{firstMultiplier_ + A};
  for (int alpha = 0; hasFriction_ && alpha < Dim - 1; ++alpha)
    unknowns.push_back(firstMultiplier_ + face_.numFunctions() + (Dim - 1) * A + alpha);
  return unknowns;
}

template <int Dim>
SlavePoint<Dim> MortarContactTerm<Dim>::pointAt(const Part& part, Eigen::Index q,
                                                const Eigen::MatrixXd& positions) const {
  const int number = part.rule.firstPoint + static_cast<int>(q);
  return pointAt(part.span, part.rule, q, hasSegments_ ? -1 : number, positions.col(number));
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
      const double stretch = this->acceptedStretch(part.span, span, q);
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
  Tangential tau = remembered_.at(A);
  if (numMultipliers() > 0)
    tau = x.template segment<Dim - 1>(firstMultiplier_ + face_.numFunctions() + (Dim - 1) * A);
  const Tangential trial = tau + frictionParameter() / average.B * average.slip;
  const FrictionPlace place{average.place / average.A, t, slipped_(A), average.area / average.A};
  auto law =
      coulombTraction<Dim - 1>(trial, state_.lambdaHat(A), frictionLaw_.at(place, -state_.lambdaHat(A)));
  // What touches without a pressure slips as soon as anything moves, and then no tangent would know of friction.
  if (std::abs(state_.lambdaHat(A)) < parameter() * kNoPressure * body_.size()) {
    law.byTrial.setIdentity();
    law.byPressure.setZero();
    law.share = 1.0;
  }
  return law;
}

template <int Dim>
void MortarContactTerm<Dim>::chooseTractions(double t, const Eigen::VectorXd& x, const Sums& sums) {
  tractions_.clear();
  if (!hasFriction_) return;
  drag_ = Drag<Dim>(partner_->freeTurns());
  for (int A = 0; A < face_.numFunctions(); ++A) {
    const auto a = static_cast<std::size_t>(A);
    const Average& average = sums.averages[a];
    const auto& law = tractions_.emplace_back(frictionOf(A, average, t, x));
    if (!state_.active[a]) continue;
    ++(law.slips ? state_.slipping : state_.sticking);
    drag_.add(law, Tangential(average.A * law.traction));
    for (std::size_t i = 0; i < average.unknowns.size(); ++i)
      if (drag_.isFreeTurn(average.unknowns[i]))
        drag_.addSlope(average.D(static_cast<Eigen::Index>(i)) / average.A);
  }
}

template <int Dim>
bool MortarContactTerm<Dim>::assemble(double t, const Eigen::VectorXd& x, const Eigen::MatrixXd& positions,
                                      Assembly& out) {
  const Eigen::MatrixXd ofParts = hasSegments_ ? partPositions(x) : positions;
  std::optional<Sums> sums = measure(ofParts);
  if (!sums) return false;
  integrate(*sums);
  for (Eigen::Index A = 0; A < face_.numFunctions(); ++A) {
    Average& average = sums->averages[static_cast<std::size_t>(A)];
    average.G -= average.A * (touching_ + (gapOrigin_.size() > 0 ? gapOrigin_(A) : 0.0));
  }
  chooseActive(x, *sums);
  addFunctions(t, x, out, *sums);
  addPoints(out, ofParts, *sums);
  if (hasSegments_) reportPoints(positions);
  return true;
}

template <int Dim>
void MortarContactTerm<Dim>::chooseActive(const Eigen::VectorXd& x, const Sums& sums) {
  state_.active.assign(sums.averages.size(), false);
  Eigen::Index nearest = -1;
  for (int A = 0; A < face_.numFunctions(); ++A) {
    const Average& average = sums.averages[static_cast<std::size_t>(A)];
    if (!(average.A > kSmallestPart * A_(A))) continue;
    const double lambda = numMultipliers() > 0 ? x(firstMultiplier_ + A) : 0.0;
    state_.averageGap(A) = average.G / average.A;
    state_.lambdaHat(A) = lambda + parameter() * state_.averageGap(A);
    state_.active[static_cast<std::size_t>(A)] =
        state_.lambdaHat(A) <= 0.0 && average.B > kOpenSlope * average.A;
    if (nearest < 0 || state_.lambdaHat(A) < state_.lambdaHat(nearest)) nearest = A;
  }
  if (keepsInTouch_ && state_.lambdaHat(nearest) > 0.0 && this->isAlone()) {
    state_.active[static_cast<std::size_t>(nearest)] = true;
    state_.pull = state_.lambdaHat(nearest) * A_(nearest);
  }
  for (std::size_t a = 0; a < state_.active.size(); ++a)
    if (!state_.active[a]) state_.lambdaHat(static_cast<Eigen::Index>(a)) = 0.0;
}

template <int Dim>
void MortarContactTerm<Dim>::addFunctions(double t, const Eigen::VectorXd& x, Assembly& out,
                                          const Sums& sums) {
  const double eps = parameter();
  chooseTractions(t, x, sums);
  for (int A = 0; A < face_.numFunctions(); ++A) {
    const auto a = static_cast<std::size_t>(A);
    const Average& average = sums.averages[a];
    const auto multipliers = multiplierUnknowns(A);
    const bool active = state_.active[a], hasMultipliers = !multipliers.empty();
    std::vector<int> unknowns;
    if (active) unknowns = average.unknowns;
    const Eigen::Index n = std::ssize(unknowns);
    Eigen::MatrixXd K;
    if (out.system != nullptr)
      K = Eigen::MatrixXd::Zero(n + std::ssize(multipliers), n + std::ssize(multipliers));
    if (active) {
      out.force(unknowns) += state_.lambdaHat(A) * average.D;
      if (hasMultipliers)
        out.force(firstMultiplier_ + A) += average.G;
      else
        state_.energy += 0.5 * state_.lambdaHat(A) * average.G;
      const Eigen::Index size = n + (hasMultipliers ? 1 : 0);
      if (out.system != nullptr)
        K.topLeftCorner(size, size) = averagedGapTangent(average.D, eps / average.A, hasMultipliers);
    } else if (hasMultipliers) {
      out.force(firstMultiplier_ + A) -= x(firstMultiplier_ + A) * A_(A) / eps;
      if (out.system != nullptr) K(n, n) = -A_(A) / eps;
    }
    if (hasFriction_) addFriction(A, average, x, out, K);
    if (out.system == nullptr || K.size() == 0) continue;
    unknowns.insert(unknowns.end(), multipliers.begin(), multipliers.end());
    out.system->add(unknowns, K);
  }
}

/// K: tangent of the function's unknowns if it is active, then of its multipliers; empty if not wanted.
template <int Dim>
void MortarContactTerm<Dim>::addFriction(int A, const Average& average, const Eigen::VectorXd& x,
                                         Assembly& out, Eigen::MatrixXd& K) {
  const auto a = static_cast<std::size_t>(A);
  const double eps = parameter(), epsT = frictionParameter();
  const bool active = state_.active[a], hasMultipliers = numMultipliers() > 0;
  const auto& law = tractions_[a];
  if (active) {
    const Eigen::VectorXd force = average.T * law.traction;
    out.force(average.unknowns) += force;
    work_.force()(average.unknowns) += force;
  }
  // Of functions that are not active, what vanishes over the face is weighed as all of it.
  const double weight = active ? average.A : A_(A);
  if (hasMultipliers) {
    const int first = firstMultiplier_ + face_.numFunctions() + (Dim - 1) * A;
    out.force.template segment<Dim - 1>(first) +=
        weight / epsT * (law.traction - x.template segment<Dim - 1>(first));
  }
  if (K.size() == 0) return;
  const Eigen::Index n = active ? std::ssize(average.unknowns) : 0;
  const auto own = Eigen::seqN(0, n), tau = Eigen::seqN(n + 1, Dim - 1);
  if (hasMultipliers)
    K(tau, tau) += weight / epsT * (law.byTrial - Eigen::Matrix<double, Dim - 1, Dim - 1>::Identity());
  if (!active) return;
  const Rows TM = average.T * law.byTrial, SM = average.S * law.byTrial.transpose();
  const Eigen::VectorXd Tc = average.T * law.byPressure;
  K(own, own) += epsT / average.B * TM * average.S.transpose() + eps / weight * Tc * average.D.transpose();
  if (hasMultipliers) {
    K(own, tau) += TM;
    K.col(n).head(n) += Tc;
    K(tau, own) += weight / average.B * SM.transpose() + eps / epsT * law.byPressure * average.D.transpose();
    K(tau, n) += weight / epsT * law.byPressure;
  }
  for (Eigen::Index i = 0; i < n && drag_ && law.slips; ++i) {
    if (!drag_.isFreeTurn(average.unknowns[static_cast<std::size_t>(i)])) continue;
    const Tangential more = law.share * average.S.row(i).transpose() - SM.row(i).transpose();
    K(own, i) += epsT / average.B * average.T * more;
    K.row(i).head(n) -= eps / weight * Tc(i) * average.D.transpose();
    if (!hasMultipliers) continue;
    K(tau, i) += weight / average.B * more;
    K(i, n) -= Tc(i);
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

/// ∫' λ̂ (φ' ∂²g + φ'' N Nᵀ) + ∂(φ' t·δs_T) dΓ, resultants, and what the face's quadrature points bear where the
/// points of the parts are those.
template <int Dim>
void MortarContactTerm<Dim>::addPoints(Assembly& out, const Eigen::MatrixXd& positions, const Sums& sums) {
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
      const Traction here = tractionAt(span.functions, span.R.col(q), limited);
      const auto& [average, lambdaHat, traction] = here;
      const double w = span.weights(q);
      pressure(q) = -lambdaHat;
      const auto slave = pointAt(parts_[k], q, positions);
      this->addResultants(slave, w, *point, lambdaHat, traction);
      if (!hasSegments_) reportAt(slave, *point, here);
      if (out.system == nullptr || (lambdaHat == 0.0 && traction.isZero(0.0))) continue;
      if (K.size() == 0) K = Eigen::MatrixXd::Zero(std::ssize(unknowns), std::ssize(unknowns));
      const auto add = [&](const std::vector<int>& of, const Eigen::MatrixXd& part) {
        addAt(placesIn(unknowns, of), part, K);
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
    if (K.size() > 0) out.system->add(unknowns, K);
  }
}

template <int Dim>
void MortarContactTerm<Dim>::reportAt(const SlavePoint<Dim>& slave, const ContactPoint<Dim>& point,
                                      const Traction& traction) {
  bool slips = false;
  if (hasFriction_) {
    // As the function does that is largest here.
    Eigen::Index largest = 0;
    slave.R.maxCoeff(&largest);
    const int function = face_.spans()[slave.span].functions[static_cast<std::size_t>(largest)];
    slips = tractions_[static_cast<std::size_t>(function)].slips;
  }
  this->reportPoint(slave, point, traction.normal, traction.tangential, slips);
}

/// What the face's quadrature points bear, of which segments have none.
template <int Dim>
void MortarContactTerm<Dim>::reportPoints(const Eigen::MatrixXd& positions) {
  for (std::size_t e = 0; e < face_.spans().size(); ++e) {
    const Span& span = face_.spans()[e];
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const auto slave = pointAt(e, q, positions);
      if (const auto point = contactAt(slave))
        reportAt(slave, *point, tractionAt(span.functions, slave.R, limitedAt(e, *point)));
    }
  }
}

template <int Dim>
typename MortarContactTerm<Dim>::Components MortarContactTerm<Dim>::lastTractions() const {
  Components tractions(Dim - 1, std::ssize(tractions_));
  for (std::size_t a = 0; a < tractions_.size(); ++a)
    tractions.col(static_cast<Eigen::Index>(a)) = tractions_[a].traction;
  return tractions;
}

template class MortarContactTerm<2>;
template class MortarContactTerm<3>;

}  // namespace burnish::inline contact
