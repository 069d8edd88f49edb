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

template <int Dim>
void DilatationProduct<Dim>::addTimes(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  const auto& spans = projection_.spans();
  const auto& numbers = projection_.workedOn();
  const auto forAll = [&](const auto& f) {
    parallelAll(numbers.size(), 64, [&](std::size_t i) {
      f(static_cast<std::size_t>(numbers[i]));
      return true;
    });
  };
  const auto partOf = [&](Eigen::VectorXd& all, std::size_t e) {
    return all.segment(begins_[e], begins_[e + 1] - begins_[e]);
  };
  const auto sumOver = [&](Eigen::VectorXd& all) {
    return projection_.sumOverSpans([&](std::size_t e) { return partOf(all, e); });
  };

  Eigen::VectorXd Zx(begins_.back()), Cx(begins_.back());  // of each span
  forAll([&](std::size_t e) {
    const Eigen::VectorXd ofSpan = x(unknowns_[e]);
    partOf(Zx, e).noalias() = shares_[e].Z.transpose() * ofSpan;
    partOf(Cx, e).noalias() = shares_[e].C.transpose() * ofSpan;
  });
  const Eigen::VectorXd change = sumOver(Zx);
  Eigen::VectorXd met(begins_.back());
  forAll([&](std::size_t e) { partOf(met, e) = shares_[e].E * change(spans[e].functions) + partOf(Cx, e); });
  const Eigen::VectorXd answer = sumOver(met);
  parallelBatches(batches_, [&](std::size_t e) {
    const DilatationShare& share = shares_[e];
    const auto& functions = spans[e].functions;
    const Eigen::VectorXd own = share.z.transpose() * x(unknowns_[e]);
    y(unknowns_[e]) += share.Z * answer(functions) + share.C * (change(functions) - own) -
                       share.z * (share.E * own + partOf(Cx, e));
    return true;
  });
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
