#include "engine/analysis/face_crossing.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/analysis/boundary_crossing.h"
#include "engine/results/doubts.h"

namespace burnish::inline analysis {
namespace {

constexpr double kCrossing = 1e-9;  // relative to the body's size

/// Whether the line through the columns crosses itself.
bool crossesItself(const Eigen::MatrixXd& line, double rounding) {
  std::vector<BoundaryPiece> pieces;
  for (Eigen::Index q = 1; q < line.cols(); ++q)
    if (line.col(q) != line.col(q - 1)) pieces.push_back({line.col(q - 1), line.col(q), {}});
  return findCrossing(pieces, rounding).has_value();
}

/// Positions of the quadrature points. Those that touch their partners, or are nearer to them or inside of
/// them by less than a share of their span, are moved out to that distance.
template <int Dim>
Eigen::MatrixXd positionsApart(const FaceContact<Dim>& term, const Eigen::VectorXd& x, double share) {
  Eigen::MatrixXd positions = term.face().positions(x);
  const ContactState& state = term.state();
  for (const auto& span : term.face().spans()) {
    const double apart = share * span.size;
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const Eigen::Index number = span.firstPoint + q;
      if (const double gap = state.gap(number); std::abs(gap) < apart)
        positions.col(number) += (apart - gap) * state.normal.col(number).template head<Dim>();
    }
  }
  return positions;
}

template <int Dim>
bool mayTouchItself(const Model<Dim>& model, const ContactPair<Dim>& pair) {
  const auto& contacts = model.selfContacts();
  return std::any_of(contacts.begin(), contacts.end(),
                     [&](const SelfContact<Dim>& contact) { return contact.place == pair.place; });
}

}  // namespace

template <int Dim>
bool anyFaceCrossesItself(const Model<Dim>& model, const ModelBody<Dim>& body, const Eigen::VectorXd& x) {
  if constexpr (Dim == 3) return false;
  const auto isOfBody = [&](const auto& contact) { return &model.bodyOf(contact.place) == &body; };
  const double rounding = kCrossing * model.body().size();
  for (const ContactPair<Dim>& pair : model.contacts())
    if (isOfBody(pair) && !mayTouchItself(model, pair) &&
        crossesItself(pair.term->face().positions(x), rounding))
      return true;
  // Parts of a face may be inside of one another by what is not doubtful yet.
  const double apart = limitOf(Condition::Penetration);
  for (const SelfContact<Dim>& contact : model.selfContacts())
    if (isOfBody(contact) && crossesItself(positionsApart(*contact.term, x, apart), rounding)) return true;
  return false;
}

template bool anyFaceCrossesItself(const Model<2>&, const ModelBody<2>&, const Eigen::VectorXd&);
template bool anyFaceCrossesItself(const Model<3>&, const ModelBody<3>&, const Eigen::VectorXd&);

}  // namespace burnish::inline analysis
