#include "engine/contact/partner_term.h"

#include <utility>

#include "engine/contact/unknown_lists.h"

namespace burnish::inline contact {
namespace {

/// Share of the size of a body that no rounding of a gap reaches.
constexpr double kTouching = 1e-13;

}  // namespace

template <int Dim>
PartnerTerm<Dim>::PartnerTerm(const Body<Dim>& body, int patch, FaceId face,
                              const PartnerMaker<Dim>& makePartner, const ContactOptions& options,
                              int firstMultiplier, const std::vector<DefinitionSpec>& definitions,
                              TractionsOf tractions)
    : FaceContact<Dim>(body, patch, face, options, firstMultiplier, definitions),
      partner_(makePartner(face_)),
      hasFriction_(options.hasFriction()),
      touching_(isPenalty(options.method) ? kTouching * body.size() : 0.0),
      remembered_(tractions == TractionsOf::Functions ? face_.numFunctions() : face_.numPoints()),
      tractionsOf_(tractions) {
  A_ = Eigen::VectorXd::Zero(face_.numFunctions());
  for (const auto& span : face_.spans()) {
    A_(span.functions) += span.R * span.weights;
    auto& own = slaveUnknowns_.emplace_back();
    for (const int a : span.functions)
      for (int d = 0; d < Dim; ++d) own.push_back(Dim * face_.nodes()[static_cast<std::size_t>(a)] + d);
  }
}

template <int Dim>
std::vector<int> PartnerTerm<Dim>::spanCouplings(std::size_t e) const {
  std::vector<int> unknowns = slaveUnknowns_[e];
  const auto others = partner_->couplings(e);
  unknowns.insert(unknowns.end(), others.begin(), others.end());
  sortOnce(unknowns);
  return unknowns;
}

/// Control points of a span's functions in the accepted state; with friction alone.
template <int Dim>
Eigen::MatrixXd PartnerTerm<Dim>::acceptedPoints(std::size_t e) const {
  const auto& functions = face_.spans()[e].functions;
  return face_.points()(Eigen::all, functions) +
         work_.acceptedUnknowns()(slaveUnknowns_[e]).reshaped(Dim, std::ssize(functions));
}

template <int Dim>
SlavePoint<Dim> PartnerTerm<Dim>::pointAt(std::size_t e, Eigen::Index q,
                                          const Eigen::MatrixXd& positions) const {
  const auto& span = face_.spans()[e];
  const int number = span.firstPoint + static_cast<int>(q);
  return pointAt(e, span, q, number, positions.col(number));
}

template <int Dim>
SlavePoint<Dim> PartnerTerm<Dim>::pointAt(std::size_t e, const Span& rule, Eigen::Index q, int number,
                                          const Eigen::Ref<const Eigen::VectorXd>& position) const {
  Eigen::Vector<double, Dim> accepted = position;
  if (work_.acceptedUnknowns().size() > 0) accepted = acceptedPoints(e) * rule.R.col(q);
  return {e, number, rule.xi.col(q), slaveUnknowns_[e], rule.R.col(q), position, accepted};
}

template <int Dim>
double PartnerTerm<Dim>::acceptedStretch(std::size_t e, const Span& rule, Eigen::Index q) const {
  if (!frictionLaw_.needsStretch()) return 0.0;
  return this->areaStretch(rule.functions, acceptedPoints(e), rule.R.col(q),
                           rule.dR.middleCols((Dim - 1) * q, Dim - 1));
}

template <int Dim>
bool PartnerTerm<Dim>::evaluate(double t, const Eigen::VectorXd& x, Assembly& out) {
  if (this->hasLostTouch()) return this->reportUntouched();
  const Eigen::MatrixXd positions = face_.positions(x);
  if (!partner_->update(t, x, positions)) return false;
  if (hasFriction_) work_.start(x);
  ContactState last = std::move(state_);
  this->clearState(hasFriction_);
  if (!assemble(t, x, positions, out)) {
    state_ = std::move(last);
    return false;
  }
  state_.countChanges(last.active);
  if (hasFriction_) {
    work_.end(*partner_);
    state_.frictionWork = work_.work();
    this->reportSlipped();
  }
  if (axisymmetric_) state_.keepAxialReaction();
  return true;
}

template <int Dim>
void PartnerTerm<Dim>::addResultants(const SlavePoint<Dim>& slave, double weight,
                                     const ContactPoint<Dim>& point, double lambdaHat,
                                     const Tangential& traction) {
  Eigen::Vector3d normalForce = Eigen::Vector3d::Zero(), tangentialForce = normalForce;
  normalForce.template head<Dim>() = weight * lambdaHat * point.normal;
  Eigen::Vector3d arm = -partner_->pivot();
  arm.template head<Dim>() += slave.x;
  if (hasFriction_) {
    tangentialForce.template head<Dim>() = weight * point.frame * traction;
    state_.frictionForce += weight * traction.norm();
    work_.reaction() += tangentialForce;
    work_.moment() += arm.cross(tangentialForce);
  }
  state_.reaction += normalForce + tangentialForce;
  state_.moment += arm.cross(normalForce + tangentialForce);
}

template <int Dim>
void PartnerTerm<Dim>::reportPoint(const SlavePoint<Dim>& slave, const ContactPoint<Dim>& point,
                                   double lambdaHat, const Tangential& traction, bool slips) {
  const Eigen::Index number = slave.number;
  state_.gap(number) = point.gap;
  state_.pressure(number) = -lambdaHat;
  state_.normal.col(number).template head<Dim>() = point.normal;
  if (!hasFriction_) return;
  state_.traction.col(number).template head<Dim>() = point.frame * traction;
  state_.slip.col(number).template head<Dim>() = point.frame * point.slip;
  if (lambdaHat < 0.0) state_.sliding[static_cast<std::size_t>(number)] = slips ? 2 : 1;
}

template <int Dim>
void PartnerTerm<Dim>::accept() {
  if (this->hasLostTouch()) return;
  partner_->accept();
  takeSegments();
  if (!hasFriction_) return;
  work_.accept();
  this->acceptSlipped();
  if (remembers()) remembered_.accept(lastTractions(), directionsOfFace());
}

/// Directions of the face's first parameter in the accepted state, in the frames of the step that comes: at
/// points, or averaged over functions. In the plane, where frames do not change, zero.
template <int Dim>
typename PartnerTerm<Dim>::Components PartnerTerm<Dim>::directionsOfFace() const {
  const bool averages = tractionsOf_ == TractionsOf::Functions;
  Components along = Components::Zero(Dim - 1, averages ? face_.numFunctions() : face_.numPoints());
  if constexpr (Dim == 3) {
    const Eigen::MatrixXd positions = face_.positions(work_.acceptedUnknowns());
    for (std::size_t e = 0; e < face_.spans().size(); ++e) {
      const auto& span = face_.spans()[e];
      const Eigen::MatrixXd points = acceptedPoints(e);
      for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
        const auto slave = pointAt(e, q, positions);
        auto point = partner_->at(slave, PointDetail::Derivatives);
        if (!point) continue;
        partner_->addSlip(slave, *point);
        const Tangential direction = point->frame.transpose() * (points * span.dR.col((Dim - 1) * q));
        if (averages)
          along(Eigen::all, span.functions) += span.weights(q) * direction * span.R.col(q).transpose();
        else
          along.col(span.firstPoint + q) = direction;
      }
    }
  }
  return along;
}

template <int Dim>
void PartnerTerm<Dim>::archive(StateArchive& archive) {
  partner_->archive(archive);
  if (archive.restores()) takeSegments();
  if (!hasFriction_) return;
  archive.part("friction", work_);
  archive.fixedField("slipped", slipped_);
  if (remembers()) archive.part("remembered", remembered_);
}

template class PartnerTerm<2>;
template class PartnerTerm<3>;

}  // namespace burnish::inline contact
