#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/solid/dilatation_projection.h"
#include "engine/solid/parallel_spans.h"
#include "engine/solid/rough_factor.h"
#include "engine/solver/coupling_groups.h"
#include "engine/solver/tangent_product.h"

namespace burnish::inline solid {

/// What a span contributes to the part of a tangent that couples displacements through a projected volume
/// change, Z E Zᵀ + C Zᵀ + Z Cᵀ: Z (unknowns x functions of Π) holds the derivatives of the coefficients of
/// J̄, C what the displacements of a point meet them with, and E (functions x functions) what they meet each
/// other with. Where the law's tangent is not symmetric, Cᵀ gives way to that of another matrix. With n functions of the body, component by component, and m functions of Π:
struct DilatationShare {
  Eigen::MatrixXd Z;            ///< Dim·n x m
  Eigen::MatrixXd C;            ///< Dim·n x m
  Eigen::MatrixXd E;            ///< m x m, symmetric
  Eigen::MatrixXd transposedC;  ///< Dim·n x m, in place of C in Z Cᵀ; empty if it is C
  Eigen::MatrixXd z;            ///< Dim·n x m, in place of Z on this span by itself; where products are kept
};

/// The part of that tangent which is left when each span adds to the entries of its own unknowns what stands there for
/// the averages of Π over spans, z of `DilatationProjection::sharesByItself`:
///
///     Z E Zᵀ + C Zᵀ + Z Cᵀ − Σ ( z E zᵀ + C zᵀ + z Cᵀ ).
///
/// The entries alone are near the tangent, also near incompressibility: at `ν = 0.49`, on equal spans of degree 2, the
/// eigenvalues of the one against the other lie between a quarter and three, and most of them between 0.6 and 1.6. (With the
/// spans' own fits in place of z, which see changes of volume that averages do not, they begin at 0.02.) C stands in
/// for `transposedC`: in space, where products are kept, both are the same for laws whose volume change is elastic.
template <int Dim>
class DilatationProduct final : public TangentProduct {
 public:
  /// unknowns: of each span, node by node; batches: of spans, those of one list without a common unknown. All must
  /// outlive the product. Of several ranks each has the shares of the spans that it works on.
  DilatationProduct(const CouplingGroups& unknowns, const DilatationProjection<Dim>& projection,
                    const std::vector<DilatationShare>& shares, const std::vector<SpanBatches>& batches);

  /// z E zᵀ + C zᵀ + z Cᵀ of a span: Dim·n x Dim·n.
  Eigen::MatrixXd ofSpan(std::size_t e) const;

  /// The shares have changed.
  void renew() { hasRough_ = false; }

  void addTimes(const Eigen::VectorXd& x, Eigen::VectorXd& y, Precision precision) const override;
  Eigen::SparseMatrix<double> entries(const std::vector<int>& numbers, int size) const override;

 private:
  /// factors: of the spans, in a precision; see `DoubleFactors` in the source.
  template <class Factors>
  void addTimes(const Eigen::VectorXd& x, Eigen::VectorXd& y, const Factors& factors) const;
  void makeRough() const;

  const CouplingGroups& unknowns_;
  const DilatationProjection<Dim>& projection_;
  const std::vector<DilatationShare>& shares_;
  const std::vector<SpanBatches>& batches_;
  /// Of the functions of each span among those of all that are worked on, and their number.
  std::vector<Eigen::Index> begins_;

  // What `addTimes` makes of the shares when it needs them roughly.
  mutable std::vector<RoughFactor> rough_;  ///< Z, C and z of each span beside one another
  mutable bool hasRough_ = false;           ///< of the present shares
};

}  // namespace burnish::inline solid
