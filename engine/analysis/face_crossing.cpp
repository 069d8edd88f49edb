#include "engine/analysis/face_crossing.h"

#include <algorithm>
#include <vector>

#include "engine/analysis/boundary_crossing.h"
#include "engine/results/doubts.h"

namespace burnish {
namespace {

constexpr double kCrossing = 1e-9;  // relative to the body's size

/// Whether the line through the columns crosses itself.
bool crossesItself(const Eigen::MatrixXd& line, double rounding) {
  std::vector<BoundaryPiece> pieces;
  for (Eigen::Index q = 1; q < line.cols(); ++q)
    if (line.col(q) != line.col(q - 1)) pieces.push_back({line.col(q - 1), line.col(q), {}});
  return findCrossing(pieces, rounding).has_value();
}

template <int Dim>
bool mayTouchItself(const Model<Dim>& model, const ContactPair<Dim>& pair) {
  const auto& contacts = model.selfContacts();
  return std::any_of(contacts.begin(), contacts.end(),
                     [&](const SelfContact& contact) { return contact.place == pair.place; });
}

}  // namespace

template <int Dim>
bool anyFaceCrossesItself(const Model<Dim>& model, const Eigen::VectorXd& x) {
  if constexpr (Dim == 3) return false;
  const double rounding = kCrossing * model.body().size();
  for (const ContactPair<Dim>& pair : model.contacts())
    if (!mayTouchItself(model, pair) && crossesItself(pair.term->face().positions(x), rounding)) return true;
  // Parts of a face may be inside of one another by what is not doubtful yet.
  const double apart = limitOf(Condition::Penetration);
  for (const SelfContact& contact : model.selfContacts())
    if (crossesItself(contact.term->positionsApart(apart), rounding)) return true;
  return false;
}

template bool anyFaceCrossesItself(const Model<2>&, const Eigen::VectorXd&);
template bool anyFaceCrossesItself(const Model<3>&, const Eigen::VectorXd&);

}  // namespace burnish
