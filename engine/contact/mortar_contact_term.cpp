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

/// Averages of a function, over the unknowns of `functionUnknowns_`.
template <int Dim>
struct MortarContactTerm<Dim>::Average {
  double A = 0.0, G = 0.0;  ///< ∫' R_A dΓ, ∫' R_A g dΓ
  Eigen::VectorXd D;
  Tangential slip = Tangential::Zero();  ///< ∫' R_A s dΓ
  double area = 0.0;                     ///< ∫' R_A j dΓ, j the stretch of area; where the law needs it
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< ∫' R_A X dΓ; with friction
  Rows T, S;
};

template <int Dim>
struct MortarContactTerm<Dim>::Sums {
  std::vector<std::optional<ContactPoint<Dim>>> points;  ///< quadrature points
  std::vector<Average> averages;                         ///< functions
};

template <int Dim>
MortarContactTerm<Dim>::MortarContactTerm(const Body<Dim>& body, int patch, FaceId face,
                                          const PartnerMaker<Dim>& makePartner, const ContactOptions& options,
                                          int firstMultiplier, const std::vector<DefinitionSpec>& definitions)
    : FaceContact<Dim>(body, patch, face, options, firstMultiplier, definitions),
      partner_(makePartner(face_)),
      hasFriction_(options.hasFriction()),
      functionUnknowns_(static_cast<std::size_t>(face_.numFunctions())) {
  A_ = Eigen::VectorXd::Zero(numMultipliers());
  for (std::size_t e = 0; e < face_.spans().size(); ++e) {
    const auto& span = face_.spans()[e];
    A_(span.functions) += span.R * span.weights;
    auto& own = slaveUnknowns_.emplace_back();
    for (const int a : span.functions)
      for (int d = 0; d < Dim; ++d) own.push_back(Dim * face_.nodes()[static_cast<std::size_t>(a)] + d);
    auto& all = spanUnknowns_.emplace_back(own);
    const auto others = partner_->couplings(e);
    all.insert(all.end(), others.begin(), others.end());
    sortOnce(all);
    for (const int a : span.functions) {
      auto& unknowns = functionUnknowns_[static_cast<std::size_t>(a)];
      unknowns.insert(unknowns.end(), all.begin(), all.end());
    }
  }
  for (auto& unknowns : functionUnknowns_) sortOnce(unknowns);
  requireAveragedGaps(A_.head(face_.numFunctions()), axisymmetric_);
  for (Eigen::Index A = 0; hasFriction_ && A < face_.numFunctions(); ++A)
    A_.template segment<Dim - 1>(face_.numFunctions() + (Dim - 1) * A).setConstant(A_(A));
}

template <int Dim>
CouplingGroups MortarContactTerm<Dim>::couplings() const {
  // Spans first, then one group per function with its multipliers.
  CouplingGroups groups = spanUnknowns_;
  for (int A = 0; A < face_.numFunctions(); ++A) {
    auto& group = groups.emplace_back(functionUnknowns_[static_cast<std::size_t>(A)]);
    group.push_back(firstMultiplier_ + A);
    for (int alpha = 0; hasFriction_ && alpha < Dim - 1; ++alpha)
      group.push_back(firstMultiplier_ + face_.numFunctions() + (Dim - 1) * A + alpha);
  }
  return groups;
}

template <int Dim>
Eigen::MatrixXd MortarContactTerm<Dim>::acceptedPoints(std::size_t e) const {
  const auto& functions = face_.spans()[e].functions;
  return face_.points()(Eigen::all, functions) +
         work_.acceptedUnknowns()(slaveUnknowns_[e]).reshaped(Dim, std::ssize(functions));
}

template <int Dim>
SlavePoint<Dim> MortarContactTerm<Dim>::pointAt(std::size_t e, Eigen::Index q,
                                                const Eigen::MatrixXd& positions) const {
  const auto& span = face_.spans()[e];
  Eigen::Vector<double, Dim> accepted = positions.col(span.firstPoint + q);
  if (work_.acceptedUnknowns().size() > 0) accepted = acceptedPoints(e) * span.R.col(q);
  return {e,
          span.firstPoint + static_cast<int>(q),
          span.xi.col(q),
          slaveUnknowns_[e],
          span.R.col(q),
          positions.col(span.firstPoint + q),
          accepted};
}

template <int Dim>
typename MortarContactTerm<Dim>::Sums MortarContactTerm<Dim>::integrate(
    const Eigen::MatrixXd& positions) const {
  Sums sums;
  sums.points.resize(static_cast<std::size_t>(face_.numPoints()));
  for (const auto& unknowns : functionUnknowns_) {
    auto& average = sums.averages.emplace_back();
    average.D = Eigen::VectorXd::Zero(std::ssize(unknowns));
    if (hasFriction_) average.T = average.S = Rows::Zero(std::ssize(unknowns), Dim - 1);
  }
  for (std::size_t e = 0; e < face_.spans().size(); ++e) {
    const auto& span = face_.spans()[e];
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const auto slave = pointAt(e, q, positions);
      auto& point = sums.points[static_cast<std::size_t>(slave.number)] =
          partner_->at(slave, PointDetail::Derivatives);
      if (!point) continue;
      if (hasFriction_) partner_->addSlip(slave, *point);
      const double stretch = frictionLaw_.needsStretch()
                                 ? areaStretch(span.functions, acceptedPoints(e), span.R.col(q),
                                               span.dR.middleCols((Dim - 1) * q, Dim - 1))
                                 : 0.0;
      const Eigen::Vector3d place = this->referencePlace(span.functions, span.R.col(q));
      for (std::size_t a = 0; a < span.functions.size(); ++a) {
        const auto A = static_cast<std::size_t>(span.functions[a]);
        const double wR = span.weights(q) * span.R(static_cast<Eigen::Index>(a), q);
        auto& average = sums.averages[A];
        average.A += wR;
        average.G += wR * point->gap;
        average.area += wR * stretch;
        // The rows of unknowns that stand on both sides are added one after the other.
        const auto places = placesIn(functionUnknowns_[A], point->unknowns);
        for (std::size_t i = 0; i < places.size(); ++i) {
          const auto row = static_cast<Eigen::Index>(i);
          average.D(places[i]) += wR * point->dGap(row);
          if (!hasFriction_) continue;
          average.T.row(places[i]) += wR * point->virtualSlip.row(row);
          average.S.row(places[i]) += wR * point->dSlip.row(row);
        }
        if (!hasFriction_) continue;
        average.slip += wR * point->slip;
        average.place += wR * place;
      }
    }
  }
  return sums;
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
  const Tangential trial = tau + frictionParameter() / average.A * average.slip;
  const FrictionPlace place{average.place / average.A, t, slipped_(A), average.area / average.A};
  return coulombTraction<Dim - 1>(trial, state_.lambdaHat(A), frictionLaw_.at(place, -state_.lambdaHat(A)));
}

template <int Dim>
bool MortarContactTerm<Dim>::evaluate(double t, const Eigen::VectorXd& x, Assembly& out) {
  const Eigen::MatrixXd positions = face_.positions(x);
  if (!partner_->update(t, x, positions)) return false;
  if (hasFriction_) work_.start(x);
  const Sums sums = integrate(positions);
  const std::vector<bool> before = std::move(state_.active);
  state_ = {};
  addFunctions(t, x, out, sums);
  state_.countChanges(before);
  addPoints(out, positions, sums);
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
    const auto& unknowns = functionUnknowns_[a];
    const Eigen::Index n = average.D.size(), size = n + (hasFriction_ ? Dim : 1);
    const double lambda = x(firstMultiplier_ + A);
    if (average.A > kSmallestPart * A_(A)) {
      state_.averageGap(A) = average.G / average.A;
      state_.lambdaHat(A) = lambda + eps * state_.averageGap(A);
      state_.active[a] = state_.lambdaHat(A) <= 0.0;
    }
    const bool active = state_.active[a];
    if (!active) state_.lambdaHat(A) = 0.0;
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
      if (active) ++(law.slips ? state_.slipping : state_.sticking);
      const Eigen::VectorXd force = average.T * law.traction;
      out.force(unknowns) += force;
      work_.force()(unknowns) += force;
      out.force.template segment<Dim - 1>(first) +=
          weight / epsT * (law.traction - x.template segment<Dim - 1>(first));
      if (out.system != nullptr) {
        const Rows TM = average.T * law.byTrial, SM = average.S * law.byTrial.transpose();
        const Eigen::VectorXd Tc = average.T * law.byPressure;
        const auto tau = Eigen::seqN(n + 1, Dim - 1), own = Eigen::seqN(0, n);
        K(tau, tau) += weight / epsT * (law.byTrial - Eigen::Matrix<double, Dim - 1, Dim - 1>::Identity());
        if (active) {
          K(own, own) +=
              epsT / weight * TM * average.S.transpose() + eps / weight * Tc * average.D.transpose();
          K(own, tau) += TM;
          K.col(n).head(n) += Tc;
          K(tau, own) += SM.transpose() + eps / epsT * law.byPressure * average.D.transpose();
          K(tau, n) += weight / epsT * law.byPressure;
        }
      }
    }
    if (out.system != nullptr) out.system->add(out.term, face_.spans().size() + a, K);
  }
}

/// ∫' λ̂ ∂²g + ∂(t·δs_T) dΓ, and what there is to say of the points.
template <int Dim>
void MortarContactTerm<Dim>::addPoints(Assembly& out, const Eigen::MatrixXd& positions, const Sums& sums) {
  state_.gap = Eigen::VectorXd::Constant(face_.numPoints(), kInfinity);
  state_.pressure = Eigen::VectorXd::Zero(face_.numPoints());
  state_.normal = Eigen::MatrixXd::Zero(3, face_.numPoints());
  if (hasFriction_) {
    state_.traction = state_.slip = Eigen::Matrix3Xd::Zero(3, face_.numPoints());
    state_.sliding.assign(static_cast<std::size_t>(face_.numPoints()), 0);
  }
  const Eigen::Vector3d pivot = partner_->pivot();
  for (std::size_t e = 0; e < face_.spans().size(); ++e) {
    const auto& span = face_.spans()[e];
    const auto& unknowns = spanUnknowns_[e];
    Eigen::MatrixXd K;
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const Eigen::Index number = span.firstPoint + q;
      const auto& point = sums.points[static_cast<std::size_t>(number)];
      if (!point) continue;
      const double w = span.weights(q), lambdaHat = span.R.col(q).dot(state_.lambdaHat(span.functions));
      state_.gap(number) = point->gap;
      state_.pressure(number) = -lambdaHat;
      state_.normal.col(number).template head<Dim>() = point->normal;
      Eigen::Vector3d normalForce = Eigen::Vector3d::Zero(), tangentialForce = Eigen::Vector3d::Zero();
      normalForce.template head<Dim>() = w * lambdaHat * point->normal;
      Tangential traction = Tangential::Zero();
      if (hasFriction_) {
        for (std::size_t a = 0; a < span.functions.size(); ++a)
          traction += span.R(static_cast<Eigen::Index>(a), q) *
                      tractions_[static_cast<std::size_t>(span.functions[a])].traction;
        tangentialForce.template head<Dim>() = w * point->frame * traction;
        state_.traction.col(number).template head<Dim>() = point->frame * traction;
        state_.slip.col(number).template head<Dim>() = point->frame * point->slip;
        state_.frictionForce += w * traction.norm();
        // As the function does that is largest here.
        Eigen::Index largest = 0;
        span.R.col(q).maxCoeff(&largest);
        const auto& law =
            tractions_[static_cast<std::size_t>(span.functions[static_cast<std::size_t>(largest)])];
        if (lambdaHat < 0.0) state_.sliding[static_cast<std::size_t>(number)] = law.slips ? 2 : 1;
      }
      Eigen::Vector3d arm = -pivot;
      arm.head<Dim>() += positions.col(number);
      state_.reaction += normalForce + tangentialForce;
      state_.moment += arm.cross(normalForce + tangentialForce);
      work_.reaction() += tangentialForce;
      work_.moment() += arm.cross(tangentialForce);
      if (out.system == nullptr || (lambdaHat == 0.0 && traction.isZero(0.0))) continue;
      if (K.size() == 0) K = Eigen::MatrixXd::Zero(std::ssize(unknowns), std::ssize(unknowns));
      const auto slave = pointAt(e, q, positions);
      const auto add = [&](const std::vector<int>& of, const Eigen::MatrixXd& part) {
        const auto places = placesIn(unknowns, of);
        for (std::size_t j = 0; j < places.size(); ++j)
          for (std::size_t i = 0; i < places.size(); ++i)
            K(places[i], places[j]) += part(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      };
      const auto curved = partner_->at(slave, PointDetail::SecondDerivatives);
      add(curved->unknowns, w * lambdaHat * curved->d2Gap);
      if (hasFriction_) add(point->unknowns, w * partner_->frictionTangent(slave, *point, traction));
    }
    state_.pressed += span.weights.dot(state_.pressure.segment(span.firstPoint, span.weights.size()));
    if (out.system != nullptr && K.size() > 0) out.system->add(out.term, e, K);
  }
}

template <int Dim>
void MortarContactTerm<Dim>::accept() {
  partner_->accept();
  if (!hasFriction_) return;
  work_.accept();
  this->acceptSlipped();
}

template <int Dim>
void MortarContactTerm<Dim>::archive(StateArchive& archive) {
  partner_->archive(archive);
  if (!hasFriction_) return;
  archive.part("friction", work_);
  archive.fixedField("slipped", slipped_);
}

template class MortarContactTerm<2>;
template class MortarContactTerm<3>;

}  // namespace burnish
