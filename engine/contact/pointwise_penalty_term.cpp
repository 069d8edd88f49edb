#include "engine/contact/pointwise_penalty_term.h"

#include <utility>

#include "engine/contact/unknown_lists.h"

namespace burnish::inline contact {

/// A quadrature point that is pressed.
template <int Dim>
struct PointwisePenaltyTerm<Dim>::Touch {
  Eigen::Index q;  ///< of the span
  SlavePoint<Dim> slave;
  ContactPoint<Dim> contact;
};

template <int Dim>
CouplingGroups PointwisePenaltyTerm<Dim>::couplings() const {
  CouplingGroups groups;
  for (std::size_t e = 0; e < face_.spans().size(); ++e) groups.push_back(this->spanCouplings(e));
  return groups;
}

/// Gaps of points, and their averages.
template <int Dim>
void PointwisePenaltyTerm<Dim>::measure(const Eigen::MatrixXd& positions) {
  Eigen::VectorXd A = Eigen::VectorXd::Zero(face_.numFunctions()), G = A;
  for (std::size_t e = 0; e < face_.spans().size(); ++e) {
    const auto& span = face_.spans()[e];
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const auto contact = partner_->at(pointAt(e, q, positions), PointDetail::Gap);
      if (!contact) continue;
      const Eigen::Index number = span.firstPoint + q;
      state_.gap(number) = contact->gap;
      state_.normal.col(number).template head<Dim>() = contact->normal;
      const Eigen::VectorXd wR = span.weights(q) * span.R.col(q);
      A(span.functions) += wR;
      G(span.functions) += contact->gap * wR;
    }
  }
  for (Eigen::Index a = 0; a < A.size(); ++a)
    if (A(a) > 0.0) state_.averageGap(a) = G(a) / A(a);
}

/// The point that keeps a free tool in touch; -1 if there is none.
template <int Dim>
Eigen::Index PointwisePenaltyTerm<Dim>::pointInTouch() const {
  Eigen::Index nearest = -1;
  if (!keepsInTouch_ || state_.gap.minCoeff(&nearest) < touching_ || !this->isAlone()) return -1;
  return nearest;
}

template <int Dim>
bool PointwisePenaltyTerm<Dim>::assemble(double t, const Eigen::VectorXd&, const Eigen::MatrixXd& positions,
                                         Assembly& out) {
  measure(positions);
  const Eigen::Index nearest = pointInTouch();
  if (hasFriction_) tractions_ = Components::Zero(Dim - 1, face_.numPoints());
  for (std::size_t e = 0; e < face_.spans().size(); ++e) {
    const auto& span = face_.spans()[e];
    std::vector<Touch> touches;
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const Eigen::Index number = span.firstPoint + q;
      if (!(state_.gap(number) < touching_) && number != nearest) continue;
      const auto slave = pointAt(e, q, positions);
      auto contact = *partner_->at(
          slave, out.system != nullptr ? PointDetail::SecondDerivatives : PointDetail::Derivatives);
      if (hasFriction_) partner_->addSlip(slave, contact);
      touches.push_back({q, slave, std::move(contact)});
    }
    if (touches.empty()) continue;
    addSpan(e, touches, t, out);
    state_.pressed += span.weights.dot(state_.pressure.segment(span.firstPoint, span.weights.size()));
  }
  return true;
}

template <int Dim>
FrictionTraction<Dim - 1> PointwisePenaltyTerm<Dim>::frictionOf(const Touch& touch, double t) const {
  const auto& span = face_.spans()[touch.slave.span];
  const double lambdaHat = parameter() * pressedGap(touch.contact);
  const FrictionPlace place{this->referencePlace(span.functions, touch.slave.R), t,
                            slipped_(span.functions).dot(touch.slave.R),
                            this->acceptedStretch(touch.slave.span, span, touch.q)};
  const Tangential trial = remembered_.at(touch.slave.number) + frictionParameter() * touch.contact.slip;
  return coulombTraction<Dim - 1>(trial, lambdaHat, frictionLaw_.at(place, -lambdaHat));
}

template <int Dim>
void PointwisePenaltyTerm<Dim>::addSpan(std::size_t e, const std::vector<Touch>& touches, double t,
                                        Assembly& out) {
  const double eps = parameter(), epsT = frictionParameter();
  std::vector<int> unknowns;
  for (const Touch& touch : touches)
    unknowns.insert(unknowns.end(), touch.contact.unknowns.begin(), touch.contact.unknowns.end());
  sortOnce(unknowns);
  Eigen::VectorXd normalForce = Eigen::VectorXd::Zero(std::ssize(unknowns)), friction = normalForce;
  Eigen::MatrixXd K;
  if (out.system != nullptr) K = Eigen::MatrixXd::Zero(normalForce.size(), normalForce.size());
  for (const Touch& touch : touches) {
    const ContactPoint<Dim>& contact = touch.contact;
    const double w = face_.spans()[e].weights(touch.q), gap = pressedGap(contact), lambdaHat = eps * gap;
    const auto places = placesIn(unknowns, contact.unknowns);
    const auto add = [&](const Eigen::VectorXd& part, Eigen::VectorXd& force) {
      for (std::size_t i = 0; i < places.size(); ++i) force(places[i]) += part(static_cast<Eigen::Index>(i));
    };
    add(w * lambdaHat * contact.dGap, normalForce);
    state_.energy += 0.5 * w * lambdaHat * gap;
    if (gap > 0.0) state_.pull += w * lambdaHat;
    FrictionTraction<Dim - 1> law;
    if (hasFriction_) {
      law = frictionOf(touch, t);
      tractions_.col(touch.slave.number) = law.traction;
      ++(law.slips ? state_.slipping : state_.sticking);
      add(w * contact.virtualSlip * law.traction, friction);
    }
    this->addResultants(touch.slave, w, contact, lambdaHat, law.traction);
    this->reportPoint(touch.slave, contact, lambdaHat, law.traction, law.slips);
    if (out.system == nullptr) continue;
    Eigen::MatrixXd part = eps * contact.dGap * contact.dGap.transpose() + lambdaHat * contact.d2Gap;
    if (hasFriction_)
      part += contact.virtualSlip * (epsT * law.byTrial * contact.dSlip.transpose() +
                                     eps * law.byPressure * contact.dGap.transpose()) +
              partner_->frictionTangent(touch.slave, contact, law.traction);
    addAt(places, w * part, K);
  }
  out.force(unknowns) += normalForce + friction;
  if (hasFriction_) work_.force()(unknowns) += friction;
  if (out.system != nullptr) out.system->add(unknowns, K);
}

template class PointwisePenaltyTerm<2>;
template class PointwisePenaltyTerm<3>;

}  // namespace burnish::inline contact
