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

/// λ_A of all contacts on the new mesh, in x.
void setMultipliers(const Model<2>& before, const Patch<2>& deformed, const Model<2>& next,
                    Eigen::VectorXd& x) {
  const auto set = [&](const auto& oldTerm, const auto& newTerm, FaceId face) {
    x.segment(newTerm.firstMultiplier(), newTerm.numMultipliers()) = carriedMultipliers(
        before.body(), face, deformed, next.body().patches.front(), oldTerm.state().lambdaHat);
  };
  for (std::size_t k = 0; k < next.contacts().size(); ++k)
    set(*before.contacts()[k].term, *next.contacts()[k].term, next.contacts()[k].place.face);
  for (std::size_t k = 0; k < next.selfContacts().size(); ++k)
    set(*before.selfContacts()[k].term, *next.selfContacts()[k].term, next.selfContacts()[k].place.face);
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
  setMultipliers(model, deformed_, next, start.x);
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

Eigen::VectorXd carriedMultipliers(const Body<2>& body, FaceId face, const Patch<2>& deformed,
                                   const Patch<2>& next, const Eigen::VectorXd& lambdaHat) {
  const auto before = tracePatch(body.patches.front(), face), now = tracePatch(deformed, face);
  const auto newTrace = tracePatch(next, face);
  const ArcLengthCurve oldCurve(now), newCurve(newTrace);
  Eigen::VectorXd result(newTrace.basis().numFunctions());
  for (int a = 0; a < result.size(); ++a) {
    const double share = newCurve.lengthTo(newTrace.basis().direction(0).anchor(a)) / newCurve.length();
    const Eigen::Vector<double, 1> xi(oldCurve.parameterAt(share * oldCurve.length()));
    const int span = before.findSpan(xi);
    const auto shape = before.shape(span, xi);
    const double along = now.jacobian(xi).norm() / before.jacobian(xi).norm();
    const double ring = body.circumference(before.position(xi));
    const bool onAxis = ring < kOnAxis * body.size();  // where both stretches are the same
    const double around = onAxis ? along : body.circumference(now.position(xi)) / ring;
    const double stretch = body.axisymmetric ? along * around : along;
    const double lambda = shape.R.dot(lambdaHat(before.basis().spanFunctions(span))) / stretch;
    result(a) = std::min(0.0, lambda);
  }
  return result;
}

}  // namespace burnish
