#pragma once
#include <Eigen/Dense>
#include <algorithm>

#include "engine/solver/term.h"

namespace burnish::test {

/// Force of one term at (t, x).
inline Eigen::VectorXd forceOf(Term& term, double t, const Eigen::VectorXd& x, bool* admissible = nullptr) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(x.size());
  Assembly out{force};
  const bool ok = term.evaluate(t, x, out);
  if (admissible != nullptr) *admissible = ok;
  return force;
}

/// Assembled tangent of one term at (t, x).
inline Eigen::MatrixXd tangentOf(Term& term, double t, const Eigen::VectorXd& x) {
  SparseSystem system(std::vector<bool>(static_cast<std::size_t>(x.size()), false), {term.couplings()});
  Eigen::VectorXd force = Eigen::VectorXd::Zero(x.size());
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
