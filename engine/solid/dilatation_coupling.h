#pragma once
#include <Eigen/Dense>
#include <cstddef>
#include <vector>

#include "engine/solid/dilatation_projection.h"
#include "engine/solid/run_columns.h"
#include "engine/solver/sparse_system.h"

namespace burnish {

/// The part of a tangent that couples displacements through a projected volume change: Z E Zᵀ + C Zᵀ + Z Cᵀ,
/// where Z (unknowns x functions of Π) holds the derivatives of the coefficients of J̄, C what the
/// displacements of a point meet them with, and E (functions x functions) what they meet each other with.
///
/// The three are sums over spans. The product is made column by column as (Z E + C) Zᵀ + Z Cᵀ for the whole
/// body: a function of Π then takes part once, and not on every span of its own, and each entry of the
/// tangent is written once, by one thread and in one order of sums.
template <int Dim>
class DilatationCoupling {
 public:
  /// Share of one span, with n functions of the body, component by component, and m functions of Π.
  struct Share {
    Eigen::MatrixXd Z;  ///< Dim·n x m
    Eigen::MatrixXd C;  ///< Dim·n x m
    Eigen::MatrixXd E;  ///< m x m, symmetric
  };

  DilatationCoupling(const SpanQuadrature<Dim>& quadrature, const DilatationProjection<Dim>& projection);

  /// Unknowns that are coupled through each span.
  const CouplingGroups& groups() const { return groups_; }

  /// Share of span number e, to be set anew for each tangent.
  Share& share(std::size_t e) { return shares_[e]; }

  /// Adds the product to the tangent.
  void addTo(SparseSystem& system);

 private:
  /// A function of Π on a span where it lives.
  struct Use {
    std::size_t span;
    Eigen::Index place;
  };
  /// A function of Π that depends on a node, and where the node's values stand in its column.
  struct Dependence {
    std::size_t function;
    std::size_t entry;
  };
  struct Workspace;

  void findColumns(const std::vector<std::vector<int>>& nodes);
  void gather(std::size_t function, Eigen::MatrixXd Share::*part, RunColumns& into, Workspace& work) const;
  void multiplyByE(std::size_t function, Workspace& work);
  void addColumns(int node, SparseSystem& system, Workspace& work) const;

  CouplingGroups groups_;
  std::vector<Share> shares_;
  std::vector<std::vector<int>> nodes_;               ///< of each span
  std::vector<std::vector<int>> functions_;           ///< of Π, on each span
  std::vector<std::vector<int>> overlapping_;         ///< functions of Π, with each one
  std::vector<std::vector<Use>> uses_;                ///< of each function of Π
  std::vector<std::vector<Dependence>> dependences_;  ///< of each node
  RunColumns Z_, C_, Y_;                              ///< Y = Z E + C
};

}  // namespace burnish
