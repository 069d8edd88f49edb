#include "engine/nurbs/second_order_shape.h"

#include <algorithm>
#include <array>

namespace burnish {
namespace {

/// Values and two derivatives of a span's functions, (p+1) x 3, continued linearly beyond its ends.
Eigen::MatrixXd continuedFunctions(const UnivariateBasis& basis, int span, double xi) {
  const double inside = std::clamp(xi, basis.spanBegin(span), basis.spanEnd(span));
  Eigen::MatrixXd N = basis.evaluate(span, inside, 2);
  if (xi != inside) {
    N.col(0) += (xi - inside) * N.col(1);
    N.col(2).setZero();
  }
  return N;
}

}  // namespace

template <int P>
SecondOrderShape<P> secondOrderShape(const TensorBasis<P>& basis, const Eigen::VectorXd& weights, int span,
                                     const Eigen::Vector<double, P>& xi) {
  const auto spans = basis.spanIndex(span);
  const auto functions = basis.spanFunctions(span);
  const auto n = static_cast<Eigen::Index>(functions.size());
  std::array<Eigen::MatrixXd, P> N;
  for (std::size_t d = 0; d < P; ++d)
    N[d] = continuedFunctions(basis.direction(static_cast<int>(d)), spans[d], xi(static_cast<int>(d)));

  // Products w_A Π_d ∂^k N of the wanted orders k, one per direction.
  const auto product = [&](const std::array<int, P>& orders) {
    Eigen::VectorXd values(n);
    for (Eigen::Index a = 0, rest = 0; a < n; ++a, rest = a) {
      values(a) = weights(functions[static_cast<std::size_t>(a)]);
      for (std::size_t d = 0; d < P; rest /= N[d].rows(), ++d)
        values(a) *= N[d](rest % N[d].rows(), orders[d]);
    }
    return values;
  };
  SecondOrderShape<P> shape;
  const Eigen::VectorXd values = product({});
  const double W = values.sum();
  shape.R = values / W;
  Eigen::Vector<double, P> dW;
  shape.dR.resize(n, P);
  for (int d = 0; d < P; ++d) {
    std::array<int, P> orders{};
    orders[static_cast<std::size_t>(d)] = 1;
    const Eigen::VectorXd first = product(orders);
    dW(d) = first.sum();
    shape.dR.col(d) = (first - dW(d) * shape.R) / W;
  }
  shape.ddR.resize(n, P * (P + 1) / 2);
  for (int c = 0; c < P; ++c)
    for (int d = c; d < P; ++d) {
      std::array<int, P> orders{};
      ++orders[static_cast<std::size_t>(c)];
      ++orders[static_cast<std::size_t>(d)];
      const Eigen::VectorXd second = product(orders);
      shape.ddR.col(secondDerivative(c, d)) =
          (second - dW(c) * shape.dR.col(d) - dW(d) * shape.dR.col(c) - second.sum() * shape.R) / W;
    }
  return shape;
}

template SecondOrderShape<1> secondOrderShape(const TensorBasis<1>&, const Eigen::VectorXd&, int,
                                              const Eigen::Vector<double, 1>&);
template SecondOrderShape<2> secondOrderShape(const TensorBasis<2>&, const Eigen::VectorXd&, int,
                                              const Eigen::Vector<double, 2>&);

}  // namespace burnish
