#include "engine/nurbs/collocation.h"

#include "engine/nurbs/refinement.h"

namespace burnish::inline nurbs {
namespace {

/// Coefficients with a matrix applied along each direction. matrix: of a direction.
template <int P, class MatrixOf>
Eigen::MatrixXd appliedAlongAll(const Eigen::MatrixXd& coefficients, const MatrixOf& matrix) {
  Eigen::MatrixXd values = coefficients.transpose();
  Eigen::Index stride = 1;
  for (int d = 0; d < P; ++d) {
    const Eigen::MatrixXd T = matrix(d);
    values = appliedAlong(values, T, stride);
    stride *= T.rows();
  }
  return values.transpose();
}

}  // namespace

Eigen::MatrixXd functionValuesAt(const UnivariateBasis& basis, const std::vector<double>& parameters) {
  Eigen::MatrixXd N =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(parameters.size()), basis.numFunctions());
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const int span = basis.findSpan(parameters[k]);
    N.row(static_cast<Eigen::Index>(k)).segment(basis.firstFunction(span), basis.degree() + 1) =
        basis.evaluate(span, parameters[k], 0).col(0);
  }
  return N;
}

Eigen::MatrixXd valuesAtAnchors(const UnivariateBasis& basis, const UnivariateBasis& places) {
  std::vector<double> anchors;
  for (int a = 0; a < places.numFunctions(); ++a) anchors.push_back(places.anchor(a));
  return functionValuesAt(basis, anchors);
}

template <int P>
Eigen::MatrixXd valuesAtAnchors(const TensorBasis<P>& basis, const Eigen::MatrixXd& coefficients,
                                const TensorBasis<P>& places) {
  return appliedAlongAll<P>(coefficients,
                            [&](int d) { return valuesAtAnchors(basis.direction(d), places.direction(d)); });
}

template <int P>
Eigen::MatrixXd interpolatedOn(const TensorBasis<P>& to, const TensorBasis<P>& from,
                               const Eigen::MatrixXd& coefficients) {
  return appliedAlongAll<P>(coefficients, [&](int d) -> Eigen::MatrixXd {
    const UnivariateBasis& next = to.direction(d);
    return valuesAtAnchors(next, next).partialPivLu().solve(valuesAtAnchors(from.direction(d), next));
  });
}

template Eigen::MatrixXd valuesAtAnchors(const TensorBasis<2>&, const Eigen::MatrixXd&,
                                         const TensorBasis<2>&);
template Eigen::MatrixXd valuesAtAnchors(const TensorBasis<3>&, const Eigen::MatrixXd&,
                                         const TensorBasis<3>&);
template Eigen::MatrixXd interpolatedOn(const TensorBasis<3>&, const TensorBasis<3>&, const Eigen::MatrixXd&);

}  // namespace burnish::inline nurbs
