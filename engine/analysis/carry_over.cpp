#include "engine/analysis/carry_over.h"

#include <algorithm>
#include <utility>

#include "engine/analysis/deformed_patch.h"
#include "engine/analysis/mesh_renewal.h"
#include "engine/nurbs/arc_length_curve.h"
#include "engine/nurbs/inverse_map.h"
#include "engine/solid/span_quadrature.h"

namespace burnish::inline analysis {
namespace {

/// Of the smallest span: how far a new mesh may be from the old body.
constexpr double kFarthestShare = 0.5;

/// Circumference over the body's size below which a point is on the axis.
constexpr double kOnAxis = 1e-9;

Eigen::Matrix2Xd anchorPositions(const Patch<2>& patch) {
  const auto& basis = patch.basis();
  Eigen::Matrix2Xd positions(2, basis.numFunctions());
  for (int a = 0; a < basis.numFunctions(); ++a) positions.col(a) = patch.position(basis.anchor(a));
  return positions;
}

/// Displacements of the nodes outside of a range, 2 x nodes.
Eigen::MatrixXd displacementsOfOthers(const Eigen::VectorXd& x, int numNodes, std::pair<int, int> range) {
  const auto nodes = x.head(2 * Eigen::Index{numNodes}).reshaped(2, numNodes);
  Eigen::MatrixXd others(2, numNodes - (range.second - range.first));
  others << nodes.leftCols(range.first), nodes.rightCols(numNodes - range.second);
  return others;
}

}  // namespace

CarryOver::CarryOver(const Simulation<2>& before, std::size_t body, const Patch<2>& deformed,
                     const Remeshing& mesh, int quadraturePoints)
    : before_(before), number_(body), deformed_(deformed) {
  const Model<2>& model = *before.model;
  const ModelBody<2>& old = model.bodies()[number_];
  const SteppingState& state = before.stepping.state();
  body_ = {{makeBody(mesh.patch), {{}}},
           {},
           {},
           old.bulk->plasticWork(),
           state.time,
           displacementsOfOthers(state.x, model.body().numNodes, old.body.nodeRange()),
           {}};
  body_.named.body.axisymmetric = old.body.axisymmetric;
  for (const FacePair<2>& pair : model.pairs()) body_.fits.push_back(pair.fit);
  const SpanQuadrature<2> quadrature(body_.named.body, quadraturePoints);
  const InverseMap<2> map(deformed);
  const double farthest = kFarthestShare * mesh.smallestSpan;
  points_ = parametersIn(map, pointPositions(quadrature, mesh.patch), farthest);
  anchors_ = parametersIn(map, anchorPositions(mesh.patch), farthest);
  body_.states = interpolated(*old.quadrature, deformed.basis(), old.bulk->carried(state.x), points_);
}

/// Multipliers of all contacts on the new mesh, in x; with friction the ways slipped and its work, too.
void CarryOver::carryContacts(const Model<2>& next, Eigen::VectorXd& x) const {
  const Model<2>& before = *before_.model;
  const Eigen::VectorXd& xBefore = before_.stepping.state().x;
  const ModelBody<2>& oldBody = before.bodies()[number_];
  const Patch<2>& newPatch = next.bodies()[number_].body.patches.front();
  const auto carryToNewFace = [&](const FaceContact<2>& oldTerm, FaceContact<2>& newTerm, FaceId face) {
    const FaceCarryOver carry(oldBody.body, face, deformed_, newPatch);
    newTerm.setMultipliers(0, carry.multipliers(oldTerm.state().lambdaHat), x);
    if (!newTerm.options().hasFriction()) return;
    newTerm.setMultipliers(1, carry.tractions(oldTerm.multipliers(1, xBefore)), x);
    newTerm.continueFriction(oldTerm.state().frictionWork, carry.values(oldTerm.slipped()));
  };
  const auto keep = [&](const FaceContact<2>& oldTerm, FaceContact<2>& newTerm) {
    x.segment(newTerm.firstMultiplier(), newTerm.numMultipliers()) =
        xBefore.segment(oldTerm.firstMultiplier(), oldTerm.numMultipliers());
    if (newTerm.options().hasFriction())
      newTerm.continueFriction(oldTerm.state().frictionWork, oldTerm.slipped());
  };
  const auto carryAll = [&](const auto& oldContacts, const auto& newContacts) {
    for (std::size_t k = 0; k < newContacts.size(); ++k)
      if (&before.bodyOf(oldContacts[k].place) == &oldBody)
        carryToNewFace(*oldContacts[k].term, *newContacts[k].term, newContacts[k].place.face);
      else
        keep(*oldContacts[k].term, *newContacts[k].term);
  };
  carryAll(before.contacts(), next.contacts());
  carryAll(before.pairs(), next.pairs());
  carryAll(before.selfContacts(), next.selfContacts());
}

SteppingState CarryOver::startOf(const Model<2>& next) const {
  const Model<2>& model = *before_.model;
  const SteppingState& before = before_.stepping.state();
  SteppingState start = continuedSteps(before_, next);
  for (std::size_t k = 0; k < next.bodies().size(); ++k)
    if (k != number_) copyHistory(*model.bodies()[k].bulk, *next.bodies()[k].bulk);
  carryContacts(next, start.x);
  if (before.lastIncrement.size() == 0) return start;
  start.lastIncrement = Eigen::VectorXd::Zero(next.numUnknowns());
  const int numNodes = model.body().numNodes;
  const auto range = model.bodies()[number_].body.nodeRange();
  const auto [first, end] = next.bodies()[number_].body.nodeRange();
  const Eigen::MatrixXd increments =
      before.lastIncrement.head(model.numDisplacements()).reshaped(2, numNodes);
  auto nodes = start.lastIncrement.head(next.numDisplacements()).reshaped(2, next.body().numNodes);
  nodes.leftCols(first) = increments.leftCols(first);
  nodes.rightCols(next.body().numNodes - end) = increments.rightCols(numNodes - range.second);
  const Eigen::MatrixXd own = increments.middleCols(range.first, range.second - range.first);
  for (Eigen::Index a = 0; a < anchors_.cols(); ++a)
    nodes.col(first + a) = valueAt(deformed_, own, anchors_.col(a));
  toolUnknowns(next, start.lastIncrement) = toolUnknowns(model, before.lastIncrement);
  return start;
}

Eigen::MatrixXd CarryOver::atQuadraturePoints(const Eigen::MatrixXd& coefficients) const {
  Eigen::MatrixXd values(points_.cols(), coefficients.rows());
  for (Eigen::Index k = 0; k < points_.cols(); ++k)
    values.row(k) = valueAt(deformed_, coefficients, points_.col(k)).transpose();
  return values;
}

FaceCarryOver::FaceCarryOver(const Body<2>& body, FaceId face, const Patch<2>& deformed,
                             const Patch<2>& next) {
  const auto before = tracePatch(body.patches.front(), face), now = tracePatch(deformed, face);
  const auto newTrace = tracePatch(next, face);
  const ArcLengthCurve oldCurve(now), newCurve(newTrace);
  for (int a = 0; a < newTrace.basis().numFunctions(); ++a) {
    const double share = newCurve.lengthTo(newTrace.basis().direction(0).anchor(a)) / newCurve.length();
    const Eigen::Vector<double, 1> xi(oldCurve.parameterAt(share * oldCurve.length()));
    const int span = before.findSpan(xi);
    const double along = now.jacobian(xi).norm() / before.jacobian(xi).norm();
    const double ring = body.circumference(before.position(xi));
    const bool onAxis = ring < kOnAxis * body.size();  // where both stretches are the same
    const double around = onAxis ? along : body.circumference(now.position(xi)) / ring;
    places_.push_back({before.basis().spanFunctions(span), before.shape(span, xi).R,
                       body.axisymmetric ? along * around : along});
  }
}

Eigen::VectorXd FaceCarryOver::values(const Eigen::VectorXd& coefficients) const {
  Eigen::VectorXd result(std::ssize(places_));
  for (Eigen::Index a = 0; a < result.size(); ++a) {
    const Place& place = places_[static_cast<std::size_t>(a)];
    result(a) = place.R.dot(coefficients(place.functions));
  }
  return result;
}

Eigen::VectorXd FaceCarryOver::tractions(const Eigen::VectorXd& coefficients) const {
  Eigen::VectorXd result = values(coefficients);
  for (Eigen::Index a = 0; a < result.size(); ++a) result(a) /= places_[static_cast<std::size_t>(a)].stretch;
  return result;
}

}  // namespace burnish::inline analysis
