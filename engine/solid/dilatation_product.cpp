#include "engine/solid/dilatation_product.h"

#include <cstddef>

#include "engine/solid/parallel_spans.h"

namespace burnish::inline solid {
namespace {

using Columns = Eigen::SparseMatrix<double>;

/// Z E Zᵀ + C Zᵀ + Z Cᵀ
template <class Matrix>
Matrix symmetricProduct(const Matrix& Z, const Matrix& C, const Matrix& E) {
  const Matrix transposed = Z.transpose(), left = Z * E + C, right = C.transpose();
  return left * transposed + Z * right;
}

}  // namespace

template <int Dim>
DilatationProduct<Dim>::DilatationProduct(const CouplingGroups& unknowns,
                                          const DilatationProjection<Dim>& projection,
                                          const std::vector<DilatationShare>& shares,
                                          const std::vector<SpanBatches>& batches)
    : unknowns_(unknowns), projection_(projection), shares_(shares), batches_(batches) {
  Eigen::Index begin = 0;
  for (const auto& span : projection.spans()) {
    begins_.push_back(begin);
    begin += std::ssize(span.functions);
  }
  begins_.push_back(begin);
}

template <int Dim>
Eigen::MatrixXd DilatationProduct<Dim>::ofSpan(std::size_t e) const {
  const DilatationShare& share = shares_[e];
  return symmetricProduct<Eigen::MatrixXd>(share.z, share.C, share.E);
}

namespace {

/// Numbers of a vector, which views of Eigen would copy their places for.
template <class Number>
void gather(const Eigen::VectorXd& from, const std::vector<int>& places, Eigen::Matrix<Number, -1, 1>& into) {
  into.resize(std::ssize(places));
  for (Eigen::Index k = 0; k < into.size(); ++k)
    into(k) = static_cast<Number>(from(places[static_cast<std::size_t>(k)]));
}

/// y += A x, for matrices that are too small for Eigen's product.
template <class X, class Y>
void addSmallProduct(const Eigen::MatrixXd& A, const X& x, Y&& y) {
  for (Eigen::Index j = 0; j < A.cols(); ++j) y += x(j) * A.col(j);
}

/// As shares have them.
struct DoubleFactors {
  using Number = double;
  const std::vector<DilatationShare>& shares;

  void timesTransposed(std::size_t e, const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> y) const {
    const DilatationShare& share = shares[e];
    const Eigen::Index m = share.Z.cols();
    y.head(m).noalias() = share.Z.transpose() * x;
    y.segment(m, m).noalias() = share.C.transpose() * x;
    y.tail(m).noalias() = share.z.transpose() * x;
  }

  void times(std::size_t e, const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::VectorXd& y) const {
    const DilatationShare& share = shares[e];
    const Eigen::Index m = share.Z.cols();
    y.noalias() = share.Z * x.head(m);
    y.noalias() += share.C * x.segment(m, m);
    y.noalias() += share.z * x.tail(m);
  }
};

struct RoughFactors {
  using Number = float;
  const std::vector<RoughFactor>& factors;

  void timesTransposed(std::size_t e, const Eigen::VectorXf& x, Eigen::Ref<Eigen::VectorXd> y) const {
    factors[e].timesTransposed(x, y);
  }

  void times(std::size_t e, const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::VectorXf& y) const {
    factors[e].times(x, y);
  }
};

}  // namespace

template <int Dim>
template <class Factors>
void DilatationProduct<Dim>::addTimes(const Eigen::VectorXd& x, Eigen::VectorXd& y,
                                      const Factors& factors) const {
  using Numbers = Eigen::Matrix<typename Factors::Number, Eigen::Dynamic, 1>;
  const auto& spans = projection_.spans();
  const auto& numbers = projection_.workedOn();
  const auto forAll = [&](const auto& f) {
    parallelAll(numbers.size(), 64, [&](std::size_t i) {
      f(static_cast<std::size_t>(numbers[i]));
      return true;
    });
  };
  // Of each span, three numbers for each of its functions: those with Z, with C and with z.
  Eigen::VectorXd all(3 * begins_.back()), met(begins_.back());
  const auto partOf = [&](std::size_t e, Eigen::Index which) {
    const Eigen::Index m = begins_[e + 1] - begins_[e];
    return all.segment(3 * begins_[e] + which * m, m);
  };
  const auto allOf = [&](std::size_t e) {
    return all.segment(3 * begins_[e], 3 * (begins_[e + 1] - begins_[e]));
  };
  const auto metBy = [&](std::size_t e) { return met.segment(begins_[e], begins_[e + 1] - begins_[e]); };

  forAll([&](std::size_t e) {
    thread_local Numbers ofSpan;
    gather(x, unknowns_[e], ofSpan);
    factors.timesTransposed(e, ofSpan, allOf(e));
  });
  const Eigen::VectorXd change = projection_.sumOverSpans([&](std::size_t e) { return partOf(e, 0); });
  forAll([&](std::size_t e) {
    thread_local Eigen::VectorXd changeOf;
    gather(change, spans[e].functions, changeOf);
    metBy(e) = partOf(e, 1);
    addSmallProduct(shares_[e].E, changeOf, metBy(e));
    partOf(e, 0) = changeOf;
  });
  const Eigen::VectorXd answer = projection_.sumOverSpans(metBy);
  parallelBatches(batches_, [&](std::size_t e) {
    thread_local Eigen::VectorXd answerOf, metByItself;
    thread_local Numbers product;
    auto first = partOf(e, 0), second = partOf(e, 1),
         third = partOf(e, 2);  // of change, C and z; then for Z, C and z
    metByItself = second;
    addSmallProduct(shares_[e].E, third, metByItself);
    second = first - third;
    third = -metByItself;
    gather(answer, spans[e].functions, answerOf);
    first = answerOf;
    factors.times(e, allOf(e), product);
    Eigen::Index k = 0;
    for (const int unknown : unknowns_[e]) y(unknown) += static_cast<double>(product(k++));
    return true;
  });
}

template <int Dim>
void DilatationProduct<Dim>::addTimes(const Eigen::VectorXd& x, Eigen::VectorXd& y,
                                      Precision precision) const {
  if (precision == Precision::Full) {
    addTimes(x, y, DoubleFactors{shares_});
    return;
  }
  if (!hasRough_) makeRough();
  addTimes(x, y, RoughFactors{rough_});
}

template <int Dim>
void DilatationProduct<Dim>::makeRough() const {
  rough_.resize(shares_.size());
  const auto& numbers = projection_.workedOn();
  parallelAll(numbers.size(), 64, [&](std::size_t i) {
    const auto e = static_cast<std::size_t>(numbers[i]);
    const DilatationShare& share = shares_[e];
    rough_[e].assign({&share.Z, &share.C, &share.z});
    return true;
  });
  hasRough_ = true;
}

template <int Dim>
Eigen::SparseMatrix<double> DilatationProduct<Dim>::entries(const std::vector<int>& numbers, int size) const {
  using Triplets = std::vector<Eigen::Triplet<double>>;
  // Functions of Π of the body, and those of each span by itself.
  Triplets Z, C, E, ownZ, ownC, ownE;
  for (std::size_t e = 0; e < shares_.size(); ++e) {
    const DilatationShare& share = shares_[e];
    const auto& span = projection_.spans()[e];
    const std::vector<int>& unknowns = unknowns_[e];
    const auto first = static_cast<int>(begins_[e]), m = static_cast<int>(span.functions.size());
    for (int a = 0; a < m; ++a) {
      const int function = span.functions[static_cast<std::size_t>(a)];
      for (int b = 0; b < m; ++b) {
        E.emplace_back(span.functions[static_cast<std::size_t>(b)], function, share.E(b, a));
        ownE.emplace_back(first + b, first + a, share.E(b, a));
      }
      for (std::size_t k = 0; k < unknowns.size(); ++k) {
        const int row = numbers[static_cast<std::size_t>(unknowns[k])];
        if (row < 0) continue;
        const auto i = static_cast<Eigen::Index>(k);
        Z.emplace_back(row, function, share.Z(i, a));
        C.emplace_back(row, function, share.C(i, a));
        ownZ.emplace_back(row, first + a, share.z(i, a));
        ownC.emplace_back(row, first + a, share.C(i, a));
      }
    }
  }
  const auto made = [](const Triplets& triplets, Eigen::Index rows, Eigen::Index columns) {
    Columns matrix(rows, columns);
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    return matrix;
  };
  const auto productOf = [&](const Triplets& z, const Triplets& c, const Triplets& e, Eigen::Index m) {
    return symmetricProduct<Columns>(made(z, size, m), made(c, size, m), made(e, m, m));
  };
  return productOf(Z, C, E, projection_.numFunctions()) - productOf(ownZ, ownC, ownE, begins_.back());
}

template class DilatationProduct<2>;
template class DilatationProduct<3>;

}  // namespace burnish::inline solid
