#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <random>

#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "engine/solid/body.h"
#include "engine/solver/term.h"

namespace burnish::test {

/// Entries between -amplitude and amplitude.
inline Eigen::VectorXd randomState(Eigen::Index size, double amplitude, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
  return Eigen::VectorXd::NullaryExpr(size, [&] { return uniform(generator); });
}

/// A sector of opening 1 between the radii 1 and 2. Rational; the radial direction has a double knot from
/// degree 2 on.
inline Body<2> ring(int degree) {
  KnotVector radial = KnotVector::uniform(degree, 3);
  if (degree > 1) radial = withKnots(radial, {radial.breakpoints()[1]});
  const Patch<2> shape = annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 1.0);
  if (degree > 1) return makeBody(refined(shape, {radial, KnotVector::uniform(degree, 2)}));
  return makeBody(lagrangeInterpolant(shape, 1, {radial.breakpoints(), {0.0, 0.5, 1.0}}));
}

/// Force of one term at (t, x).
inline Eigen::VectorXd forceOf(Term& term, double t, const Eigen::VectorXd& x, bool* admissible = nullptr) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(x.size());
  const bool ok = evaluateForce(term, t, x, force);
  if (admissible != nullptr) *admissible = ok;
  return force;
}

/// Assembled tangent of one term at (t, x).
inline Eigen::MatrixXd tangentOf(Term& term, double t, const Eigen::VectorXd& x) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(x.size());
  if (!evaluateForce(term, t, x, force)) return Eigen::MatrixXd::Constant(x.size(), x.size(), 1e300);
  SparseSystem system(std::vector<bool>(static_cast<std::size_t>(x.size()), false), {term.couplings()});
  force.setZero();
  Assembly out{force, &system, 0};
  if (!term.evaluate(t, x, out)) return Eigen::MatrixXd::Constant(x.size(), x.size(), 1e300);
  return system.tangent();
}

/// Largest difference between a matrix and its transpose, relative to the largest entry.
inline double asymmetry(const Eigen::MatrixXd& K) {
  return (K - K.transpose()).cwiseAbs().maxCoeff() / K.cwiseAbs().maxCoeff();
}

/// Largest difference between the tangent and central differences of the force (step h), relative to the
/// tangent's largest entry.
inline double tangentError(Term& term, double t, const Eigen::VectorXd& x, double h) {
  const Eigen::MatrixXd K = tangentOf(term, t, x);
  double error = 0.0;
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    Eigen::VectorXd forward = x, backward = x;
    forward(j) += h;
    backward(j) -= h;
    const Eigen::VectorXd column = (forceOf(term, t, forward) - forceOf(term, t, backward)) / (2.0 * h);
    error = std::max(error, (column - K.col(j)).cwiseAbs().maxCoeff());
  }
  return error / K.cwiseAbs().maxCoeff();
}

}  // namespace burnish::test
