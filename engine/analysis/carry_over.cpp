#include "engine/analysis/carry_over.h"

#include <algorithm>
#include <utility>

#include "engine/analysis/deformed_patch.h"
#include "engine/rezoning/curve.h"
#include "engine/rezoning/inverse_map.h"
#include "engine/solid/span_quadrature.h"

namespace burnish {
namespace {

/// On a new mesh the step begins at a quarter of the nominal one.
constexpr int kFirstLevel = 2;

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

/// Multipliers of all contacts on the new mesh, in x; with friction the ways slipped and its work, too.
void carryContacts(const Model<2>& before, const Eigen::VectorXd& xBefore, const Patch<2>& deformed,
                   const Model<2>& next, Eigen::VectorXd& x) {
  const auto carryContact = [&](const FaceContact<2>& oldTerm, FaceContact<2>& newTerm, FaceId face) {
    const FaceCarryOver carry(before.body(), face, deformed, next.body().patches.front());
    const int numOld = oldTerm.face().numFunctions(), num = newTerm.face().numFunctions();
    x.segment(newTerm.firstMultiplier(), num) = carry.multipliers(oldTerm.state().lambdaHat);
    if (!newTerm.options().hasFriction()) return;
    x.segment(newTerm.firstMultiplier() + num, num) =
        carry.tractions(xBefore.segment(oldTerm.firstMultiplier() + numOld, numOld));
    newTerm.continueFriction(oldTerm.state().frictionWork, carry.values(oldTerm.slipped()));
  };
  for (std::size_t k = 0; k < next.contacts().size(); ++k)
    carryContact(*before.contacts()[k].term, *next.contacts()[k].term, next.contacts()[k].place.face);
  for (std::size_t k = 0; k < next.selfContacts().size(); ++k)
    carryContact(*before.selfContacts()[k].term, *next.selfContacts()[k].term,
                 next.selfContacts()[k].place.face);
}

}  // namespace

CarryOver::CarryOver(const Simulation<2>& before, const Patch<2>& deformed, const Remeshing& mesh,
                     int quadraturePoints)
    : before_(before), deformed_(deformed) {
  const Model<2>& model = *before.model;
  const SteppingState& state = before.stepping.state();
  body_ = {{makeBody(mesh.patch), {{}}}, {}, model.bodies().front().bulk->plasticWork(), state.time};
  body_.named.body.axisymmetric = model.body().axisymmetric;
  const SpanQuadrature<2> quadrature(body_.named.body, quadraturePoints);
  const InverseMap map(deformed);
  const double farthest = kFarthestShare * mesh.smallestSpan;
  points_ = parametersIn(map, pointPositions(quadrature, mesh.patch), farthest);
  anchors_ = parametersIn(map, anchorPositions(mesh.patch), farthest);
  body_.states = interpolated(*model.bodies().front().quadrature, deformed.basis(),
                              model.bodies().front().bulk->carried(state.x), points_);
}

SteppingState CarryOver::startOf(const Model<2>& next) const {
  const Model<2>& model = *before_.model;
  const SteppingState& before = before_.stepping.state();
  SteppingState start = before;
  start.x = Eigen::VectorXd::Zero(next.numUnknowns());
  carryContacts(model, before.x, deformed_, next, start.x);
  start.level = std::max(before.level, kFirstLevel);
  start.easySteps = 0;
  start.lastIncrement.resize(0);
  if (before.lastIncrement.size() == 0) return start;
  start.lastIncrement = Eigen::VectorXd::Zero(next.numUnknowns());
  const Eigen::MatrixXd increments =
      before.lastIncrement.head(model.numDisplacements()).reshaped(2, model.body().numNodes);
  for (Eigen::Index a = 0; a < anchors_.cols(); ++a)
    start.lastIncrement.segment<2>(2 * a) = valueAt(deformed_, increments, anchors_.col(a));
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

}  // namespace burnish
