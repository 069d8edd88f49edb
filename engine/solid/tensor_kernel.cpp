#include "engine/solid/tensor_kernel.h"

#include "engine/core/blas.h"
#include "engine/solid/span_kernel.h"

namespace burnish::inline solid {
namespace {

/// The sums still to be taken, over the directions that are left: whether the derivative of the function a,
/// and of b, may still be due in one of them. The derivatives of a pair of univariate functions are, in this
/// order: of a, none, of b, both; so that those that a group needs stand one after the other.
struct Group {
  bool a, b;

  constexpr int first() const { return a ? 0 : 1; }
  constexpr int count() const { return (a ? 2 : 1) * (b ? 2 : 1); }

  /// What is left to be due behind one of the four derivatives.
  constexpr Group behind(int derivative) const {
    return {a && (derivative == 1 || derivative == 2), b && derivative <= 1};
  }

  /// Number of pairs (m, n) of a group over so many directions.
  constexpr int size(int directions) const { return (a ? directions + 1 : 1) * (b ? directions + 1 : 1); }
};

/// Groups before the sum over the last direction (9), over the last two (4) and over all three (1), each
/// level in the order of the one before it.
template <int Count, int Next>
constexpr std::array<Group, Next> groupsBehind(const std::array<Group, Count>& groups) {
  std::array<Group, Next> result{};
  std::size_t place = 0;
  for (const Group group : groups)
    for (int k = 0; k < group.count(); ++k) result[place++] = group.behind(group.first() + k);
  return result;
}
constexpr std::array<Group, 1> kAll{Group{true, true}};
constexpr auto kBehindFirst = groupsBehind<1, 4>(kAll);
constexpr auto kBehindSecond = groupsBehind<4, 9>(kBehindFirst);

/// Place of the pair (m, n) of derivatives among the sixteen of the last level; 3 stands for none.
constexpr int placeOf(int m, int n) {
  constexpr int kDerivative[2][2] = {{1, 2}, {0, 3}};
  Group group{true, true};
  int place = 0;
  for (int d = 0; d < 3; ++d) {
    const int derivative = kDerivative[m == d][n == d];
    for (int k = group.first(); k < derivative; ++k) place += group.behind(k).size(2 - d);
    group = group.behind(derivative);
  }
  return place;
}
constexpr auto kPlaces = [] {
  std::array<int, 16> places{};
  for (int m = 0; m < 4; ++m)
    for (int n = 0; n < 4; ++n) places[static_cast<std::size_t>(4 * n + m)] = placeOf(m, n);
  return places;
}();

/// Sums each group over one direction. products: all pairs of univariate functions x 4·points; in: for each
/// group, rows x count·points; out: for each group, pairs of functions x rows.
template <std::size_t Count>
void sumDirection(const std::array<Group, Count>& groups, const Eigen::MatrixXd& products,
                  const Eigen::VectorXd& in, Eigen::Index rows, Eigen::VectorXd& out) {
  const Eigen::Index points = products.cols() / 4, pairs = products.rows();
  out.resize(static_cast<Eigen::Index>(Count) * pairs * rows);
  const double* from = in.data();
  double* to = out.data();
  for (const Group group : groups) {
    const Eigen::Index columns = group.count() * points;
    multiplyTransposedInto(products.middleCols(group.first() * points, columns),
                           Eigen::Map<const Eigen::MatrixXd>(from, rows, columns),
                           Eigen::Map<Eigen::MatrixXd>(to, pairs, rows));
    from += rows * columns;
    to += rows * pairs;
  }
}

}  // namespace

void TensorKernel::start(const Span& span, const Eigen::MatrixXd& gradients, bool wantTangent) {
  span_ = &span;
  gradients_ = &gradients;
  wantTangent_ = wantTangent;
  points_ = span.factors.N[0].cols() / 2;
  stress_.resize(3 * span.weights.size(), 3);
  if (wantTangent) sums_[0].resize(kPairs * 16 * span.weights.size());
}

void TensorKernel::setGradients(Eigen::Index, const Eigen::Matrix3d& F) {
  Finv_ = F.inverse();
}

void TensorKernel::setStress(Eigen::Index q, const Stress& weighted) {
  Eigen::Matrix3d tau;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) tau(i, j) = weighted(voigtPlace(i, j));
  stress_.middleRows<3>(3 * q) = Finv_ * tau;
}

void TensorKernel::setModuli(Eigen::Index q, double w, const Stress& tau, const Tangent& c, double r) {
  const Eigen::Matrix<double, 4, 3> map = span_->factors.map.middleCols<3>(3 * q) * Finv_;
  const Eigen::Index Q = span_->weights.size();
  Eigen::Matrix<double, 16, kPairs> M;
  int pair = 0;
  for (int i = 0; i < 3; ++i)
    for (int k = i; k < 3; ++k, ++pair) {
      Eigen::Matrix3d moduli;
      for (int j = 0; j < 3; ++j)
        for (int l = 0; l < 3; ++l) moduli(j, l) = w * modulus<Kinematics::Solid>(i, j, k, l, tau, c);
      moduli(k, i) += w * r;
      const Eigen::Matrix<double, 4, 3> left = map.lazyProduct(moduli);
      Eigen::Map<Eigen::Matrix4d>(M.col(pair).data()).noalias() = left.lazyProduct(map.transpose());
    }
  for (Eigen::Index mn = 0; mn < 16; ++mn)
    sums_[0].segment<kPairs>(kPairs * (q + Q * kPlaces[static_cast<std::size_t>(mn)])) = M.row(mn);
}

void TensorKernel::multiply() {
  forces_.resize(gradients_->rows(), 3);
  forces_.noalias() = *gradients_ * stress_;
  if (!wantTangent_) return;
  makeProducts();
  sumOverPoints();
  arrange();
}

/// N_a N_b at the points of one direction, pair by pair, with the derivatives in the order of `Group`.
void TensorKernel::makeProducts() {
  for (std::size_t d = 0; d < 3; ++d) {
    const auto& N = span_->factors.N[d];
    const Eigen::Index n = N.rows();
    products_[d].resize(n * n, 4 * points_);
    constexpr std::array<std::array<int, 2>, 4> kDerivatives{{{1, 0}, {0, 0}, {0, 1}, {1, 1}}};
    Eigen::Index column = 0;
    for (const auto& [ofA, ofB] : kDerivatives)
      for (Eigen::Index q = 0; q < points_; ++q, ++column)
        for (Eigen::Index b = 0; b < n; ++b)
          products_[d].col(column).segment(b * n, n) = N(b, ofB * points_ + q) * N.col(ofA * points_ + q);
  }
}

void TensorKernel::sumOverPoints() {
  const Eigen::Index last = kPairs * points_ * points_;
  sumDirection(kBehindSecond, products_[2], sums_[0], last, sums_[1]);
  const Eigen::Index second = products_[2].rows() * kPairs * points_;
  sumDirection(kBehindFirst, products_[1], sums_[1], second, sums_[2]);
  sumDirection(kAll, products_[0], sums_[2], products_[1].rows() * products_[2].rows() * kPairs, sums_[3]);
}

void TensorKernel::arrange() {
  const Eigen::Index n = span_->factors.weights.size();
  tangent_.resize(3 * n, 3 * n);
  switch (span_->factors.N[0].rows()) {
    case 3:
      return arrangeFor<3>();
    case 4:
      return arrangeFor<4>();
    default:
      return arrangeFor<Eigen::Dynamic>();
  }
}

template <int First>
void TensorKernel::arrangeFor() {
  const auto& [N1, N2, N3] = span_->factors.N;
  const Eigen::Index n1 = First == Eigen::Dynamic ? N1.rows() : First;
  const Eigen::Index n2 = N2.rows(), n3 = N3.rows(), n = n1 * n2 * n3;
  const auto& weights = span_->factors.weights;
  const double* from = sums_[3].data();
  for (int i = 0; i < 3; ++i)
    for (int k = i; k < 3; ++k)
      for (Eigen::Index b3 = 0; b3 < n3; ++b3)
        for (Eigen::Index a3 = 0; a3 < n3; ++a3)
          for (Eigen::Index b2 = 0; b2 < n2; ++b2)
            for (Eigen::Index a2 = 0; a2 < n2; ++a2) {
              const Eigen::Index a = n1 * (a2 + n2 * a3);
              for (Eigen::Index b = n1 * (b2 + n2 * b3), end = b + n1; b < end; ++b, from += n1) {
                double* entries = &tangent_(3 * a + i, 3 * b + k);
                double* mirrored = &tangent_(3 * b + k, 3 * a + i);
                for (Eigen::Index a1 = 0; a1 < n1; ++a1)
                  entries[3 * a1] = mirrored[9 * n * a1] = weights(b) * (from[a1] * weights(a + a1));
              }
            }
}

}  // namespace burnish::inline solid
