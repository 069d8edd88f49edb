#pragma once
#include <Eigen/Dense>
#include <cstddef>
#include <vector>

#include "engine/solid/dilatation_product.h"
#include "engine/solid/dilatation_projection.h"
#include "engine/solid/run_columns.h"
#include "engine/solver/sparse_system.h"

namespace burnish::inline solid {

/// The entries of the part of a tangent that couples displacements through a projected volume change, see
/// `DilatationShare`. The product is made column by column as (Z E + C) Zᵀ + Z Cᵀ for the whole body: a function
/// of Π then takes part once, and not on every span of its own, and each entry of the tangent is written once,
/// by one thread and in one order of sums.
template <int Dim>
class DilatationCoupling {
 public:
  /// shares: of all spans; must outlive the object.
  DilatationCoupling(const SpanQuadrature<Dim>& quadrature, const DilatationProjection<Dim>& projection,
                     const std::vector<DilatationShare>& shares);

  /// Unknowns that are coupled through each span.
  static CouplingGroups groups(const SpanQuadrature<Dim>& quadrature,
                               const DilatationProjection<Dim>& projection);

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
  void gather(std::size_t function, Eigen::MatrixXd DilatationShare::*part, RunColumns& into,
              Workspace& work) const;
  void multiplyByE(std::size_t function, Workspace& work);
  void addColumns(int node, SparseSystem& system, Workspace& work) const;

  const std::vector<DilatationShare>& shares_;
  std::vector<std::vector<int>> nodes_;               ///< of each span
  std::vector<std::vector<int>> functions_;           ///< of Π, on each span
  std::vector<std::vector<int>> overlapping_;         ///< functions of Π, with each one
  std::vector<std::vector<Use>> uses_;                ///< of each function of Π
  std::vector<std::vector<Dependence>> dependences_;  ///< of each node
  RunColumns Z_, C_, Y_;                              ///< Y = Z E + C
  RunColumns transposedC_;                            ///< in place of C in Z Cᵀ, where shares have it
  bool isSymmetric_ = true;                           ///< they have not
};

}  // namespace burnish::inline solid
