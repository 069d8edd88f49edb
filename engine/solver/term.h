#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/core/state_archive.h"
#include "engine/core/team.h"
#include "engine/solver/sparse_system.h"

namespace burnish::inline solver {

/// Where a term puts what it computes: its own force vector over all unknowns and, when asked for, the shared
/// tangent.
struct Assembly {
  Eigen::VectorXd& force;          ///< zero on entry; unknowns
  SparseSystem* system = nullptr;  ///< null: no tangent is wanted
  std::size_t term = 0;            ///< the term's number in the system
};

/// Anything that adds to the balance of forces and constraints: a body, a contact pair, a traction.
/// Newton and the step control know nothing else.
class Term {
 public:
  virtual ~Term() = default;

  /// Groups of unknowns that the tangent couples; fixed from the first call on.
  virtual CouplingGroups couplings() const = 0;

  /// From now on what the term has of products (`TangentProduct`) is left to them, and not in its couplings.
  virtual void keepProducts() {}

  /// From now on the columns of the tangent are divided among the ranks of a team, which must outlive the term.
  /// Every rank may leave what does not touch its unknowns to the others, and has of them what its results lack.
  virtual void divideAmong(const Team&, const Division&) {}

  /// Adds the residual (and tangent) at the unknowns x and the time t, starting from the last accepted
  /// history. Returns false if the state is not admissible (J <= 0, a failed return map, a tool that comes
  /// through): the step control mends that.
  [[nodiscard]] virtual bool evaluate(double t, const Eigen::VectorXd& x, Assembly& out) = 0;

  /// Part, at most 1, of the displacements of a correction at x beyond which the term's tangent is known to say
  /// nothing. Multipliers take all of the correction.
  virtual double usefulPart(const Eigen::VectorXd& /*x*/, const Eigen::VectorXd& /*correction*/) const {
    return 1.0;
  }

  /// Takes unknowns along from one time to another, x those of the first, of which Newton's method would have to find
  /// the way where no tangent says it. For a step that does not begin with an extrapolation.
  virtual void takeAlong(double /*from*/, double /*to*/, Eigen::VectorXd& /*x*/) const {}

  /// Whether the tangent is symmetric in every state; that of a load which follows the body is not.
  virtual bool hasSymmetricTangent() const { return true; }

  /// Makes the history of the last evaluation the accepted one.
  virtual void accept() {}

  /// The accepted history.
  virtual void archive(StateArchive&) {}
};

}  // namespace burnish::inline solver
