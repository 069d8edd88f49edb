#pragma once
#include <Eigen/Dense>
#include <array>
#include <span>
#include <vector>

#include "engine/core/team.h"
#include "engine/solid/span_quadrature.h"

namespace burnish::inline solid {

/// The projection Π of a quadrature-point field onto splines one degree below the body's (Bezier projection:
/// D. C. Thomas, M. A. Scott, J. A. Evans, K. Tew, E. J. Evans, Comput. Methods Appl. Mech. Engrg. 284,
/// 2015): the least-squares fit on each span, whose coefficients are then averaged over the spans of each
/// function. Local, so that what follows from it stays sparse, and it keeps constants and the integral of the
/// field.
///
/// Functions are the B-splines of `derivativeSpace()` without weights, patch by patch; nothing joins two
/// patches.
template <int Dim>
class DilatationProjection {
 public:
  /// m functions and Q points of a span of the quadrature, in the same order.
  struct Span {
    int patch = 0;
    typename TensorBasis<Dim>::Index index{};  ///< of the span in its patch
    std::vector<int> functions;                ///< m
    Eigen::MatrixXd N;                         ///< m x Q values
    Eigen::MatrixXd L;         ///< m x Q: share of the span's point values in the coefficients
    Eigen::VectorXd averaged;  ///< m: weight of the span in the average that a coefficient is
    bool isUneven = false;     ///< the map from parameters to space is nearly singular at its border
  };

  /// `sharesByItself` of univariate bases, by direction and span of that: functions x points.
  using DirectionShares = std::array<std::vector<Eigen::MatrixXd>, static_cast<std::size_t>(Dim)>;

  /// The quadrature must have been made from the same body.
  DilatationProjection(const Body<Dim>& body, const SpanQuadrature<Dim>& quadrature);

  const std::vector<Span>& spans() const { return spans_; }

  /// What stands for Π's coefficients where a span is looked at by itself: m x Q shares of its point values. Averages
  /// reach beyond the span; in each direction these are the functionals of the span's own values that are nearest to
  /// them: as sums over the coefficients of the body's functions, those of the span alone with the least change for which
  /// polynomials that are in Π's space keep their coefficients. They are the span's own least-squares fit where no other
  /// span has a part, on uneven spans, whose polynomials say little beyond them, and with no more points per direction than the
  /// degree.
  Eigen::MatrixXd sharesByItself(std::size_t span) const;
  int numFunctions() const { return numFunctions_; }

  /// From now on a rank of a team, which must outlive the object, works on some spans alone and forgets the others.
  /// workedOn, own: ascending; each span is the own one of one rank, which works on it.
  void divideAmong(const Team& team, std::vector<int> workedOn, std::vector<int> own);

  /// Numbers of the spans that this rank works on.
  const std::vector<int>& workedOn() const { return workedOn_; }

  /// Values at all functions: the sums of those that spans have at theirs, share(e) of span e (m). To be called by
  /// all ranks, and the same for all.
  template <class F>
  Eigen::VectorXd sumOverSpans(const F& share) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(numFunctions_);
    for (const int e : own_) {
      const auto span = static_cast<std::size_t>(e);
      const auto& part = share(span);
      Eigen::Index k = 0;  // Eigen's views by numbers copy these
      for (const int function : spans_[span].functions) sum(function) += part(k++);
    }
    team_->sum(asSpan(sum));
    return sum;
  }

  /// Π applied to values at the points of the spans that this rank works on. firstPoints: per span the place of its first
  /// one. To be called by all ranks.
  Eigen::VectorXd project(std::span<const int> firstPoints, const Eigen::VectorXd& values) const;

 private:
  std::vector<Span> spans_;
  std::vector<DirectionShares> directionShares_;  ///< of each patch
  int numFunctions_ = 0;
  const Team* team_ = &alone();
  std::vector<int> workedOn_, own_;
};

}  // namespace burnish::inline solid
