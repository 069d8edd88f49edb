#include "engine/nurbs/second_order_shape.h"

#include <algorithm>
#include <array>
#include <vector>

namespace burnish::inline nurbs {
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

/// Products w_A Π_d ∂^k N of wanted orders k, one per direction, of all functions of a span at one place.
template <int P>
class WeightedProducts {
 public:
  using Orders = std::array<int, P>;

  WeightedProducts(const TensorBasis<P>& basis, const Eigen::VectorXd& weights, int span,
                   const Eigen::Vector<double, P>& xi)
      : weights_(weights), functions_(basis.spanFunctions(span)) {
    const auto spans = basis.spanIndex(span);
    for (std::size_t d = 0; d < P; ++d)
      N_[d] = continuedFunctions(basis.direction(static_cast<int>(d)), spans[d], xi(static_cast<int>(d)));
  }

  Eigen::Index size() const { return static_cast<Eigen::Index>(functions_.size()); }

  Eigen::VectorXd operator()(const Orders& orders) const {
    Eigen::VectorXd values(size());
    for (Eigen::Index a = 0, rest = 0; a < size(); ++a, rest = a) {
      values(a) = weights_(functions_[static_cast<std::size_t>(a)]);
      for (std::size_t d = 0; d < P; rest /= N_[d].rows(), ++d)
        values(a) *= N_[d](rest % N_[d].rows(), orders[d]);
    }
    return values;
  }

 private:
  const Eigen::VectorXd& weights_;
  std::vector<int> functions_;
  std::array<Eigen::MatrixXd, P> N_;
};

}  // namespace

template <int P>
SecondOrderShape<P> secondOrderShape(const TensorBasis<P>& basis, const Eigen::VectorXd& weights, int span,
                                     const Eigen::Vector<double, P>& xi) {
  const WeightedProducts<P> product(basis, weights, span, xi);
  const Eigen::Index n = product.size();
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

template <int P>
Eigen::MatrixXd crossingDerivatives(const TensorBasis<P>& basis, const Eigen::VectorXd& weights, int span,
                                    const Eigen::Vector<double, P>& xi, int direction) {
  // W R = w N and W Q = w ∂N - R ∂W with Q = ∂R across, differentiated along up to twice.
  const WeightedProducts<P> product(basis, weights, span, xi);
  constexpr int kColumns = P == 1 ? 1 : 3;
  constexpr double kBinomial[3][3] = {{1.0}, {1.0, 1.0}, {1.0, 2.0, 1.0}};
  Eigen::MatrixXd R(product.size(), kColumns), Q(product.size(), kColumns);
  Eigen::Vector<double, kColumns> W, V;
  for (int k = 0; k < kColumns; ++k) {
    typename WeightedProducts<P>::Orders orders{};
    if constexpr (P == 2) orders[static_cast<std::size_t>(1 - direction)] = k;
    R.col(k) = product(orders);
    orders[static_cast<std::size_t>(direction)] = 1;
    Q.col(k) = product(orders);
    W(k) = R.col(k).sum();
    V(k) = Q.col(k).sum();
    for (int j = 1; j <= k; ++j) R.col(k) -= kBinomial[k][j] * W(j) * R.col(k - j);
    R.col(k) /= W(0);
    for (int j = 0; j <= k; ++j) Q.col(k) -= kBinomial[k][j] * V(j) * R.col(k - j);
    for (int j = 1; j <= k; ++j) Q.col(k) -= kBinomial[k][j] * W(j) * Q.col(k - j);
    Q.col(k) /= W(0);
  }
  return Q;
}

template SecondOrderShape<1> secondOrderShape(const TensorBasis<1>&, const Eigen::VectorXd&, int,
                                              const Eigen::Vector<double, 1>&);
template SecondOrderShape<2> secondOrderShape(const TensorBasis<2>&, const Eigen::VectorXd&, int,
                                              const Eigen::Vector<double, 2>&);
template Eigen::MatrixXd crossingDerivatives(const TensorBasis<1>&, const Eigen::VectorXd&, int,
                                             const Eigen::Vector<double, 1>&, int);
template Eigen::MatrixXd crossingDerivatives(const TensorBasis<2>&, const Eigen::VectorXd&, int,
                                             const Eigen::Vector<double, 2>&, int);

}  // namespace burnish::inline nurbs
