#include "engine/solver/petsc/border.h"

#include <algorithm>

namespace burnish {

/// The pattern is symmetric: columns of A are rows of K.
void SplitMatrix::analyse(const Columns& A) {
  const auto numRows = static_cast<int>(n_);
  const int* begins = A.outerIndexPtr();
  K_.resize(n_, n_);
  for (int row = 0; row < numRows; ++row) {
    const int *begin = A.innerIndexPtr() + begins[row], *end = A.innerIndexPtr() + begins[row + 1];
    const auto length = static_cast<int>(std::lower_bound(begin, end, numRows) - begin);
    K_.outerIndexPtr()[row + 1] = K_.outerIndexPtr()[row] + length;
  }
  K_.resizeNonZeros(K_.outerIndexPtr()[numRows]);
  for (int row = 0; row < numRows; ++row)
    std::copy_n(A.innerIndexPtr() + begins[row], K_.outerIndexPtr()[row + 1] - K_.outerIndexPtr()[row],
                K_.innerIndexPtr() + K_.outerIndexPtr()[row]);
  if (symmetric_) return;
  // Rows ascend in every column: the entries of a row are met in the order of their columns.
  std::vector<int> next(begins, begins + numRows);
  from_.resize(static_cast<std::size_t>(K_.nonZeros()));
  for (int row = 0; row < numRows; ++row)
    for (int k = K_.outerIndexPtr()[row]; k < K_.outerIndexPtr()[row + 1]; ++k)
      from_[static_cast<std::size_t>(k)] = next[static_cast<std::size_t>(K_.innerIndexPtr()[k])]++;
}

void SplitMatrix::takeLeading(const Columns& A) {
  if (!symmetric_) {
    for (std::size_t k = 0; k < from_.size(); ++k) K_.valuePtr()[k] = A.valuePtr()[from_[k]];
    return;
  }
  for (Eigen::Index row = 0; row < n_; ++row)
    std::copy_n(A.valuePtr() + A.outerIndexPtr()[row], K_.outerIndexPtr()[row + 1] - K_.outerIndexPtr()[row],
                K_.valuePtr() + K_.outerIndexPtr()[row]);
}

void SplitMatrix::take(const Columns& A) {
  if (K_.rows() == 0) analyse(A);
  takeLeading(A);

  const Eigen::Index m = A.cols() - n_;
  std::vector<Eigen::Triplet<double>> b, g, c;
  for (Eigen::Index column = n_; column < A.cols(); ++column)
    for (Columns::InnerIterator entry(A, column); entry; ++entry) {
      if (entry.value() == 0.0) continue;
      if (entry.row() < n_)
        b.emplace_back(entry.row(), column - n_, entry.value());
      else
        c.emplace_back(entry.row() - n_, column - n_, entry.value());
    }
  B_.resize(n_, m);
  B_.setFromTriplets(b.begin(), b.end());
  C_.resize(m, m);
  C_.setFromTriplets(c.begin(), c.end());
  if (symmetric_) {
    G_ = B_.transpose();
    return;
  }
  for (int column = 0; column < n_; ++column) {
    const int length = K_.outerIndexPtr()[column + 1] - K_.outerIndexPtr()[column];
    for (int k = A.outerIndexPtr()[column] + length; k < A.outerIndexPtr()[column + 1]; ++k)
      if (A.valuePtr()[k] != 0.0) g.emplace_back(A.innerIndexPtr()[k] - n_, column, A.valuePtr()[k]);
  }
  G_.resize(m, n_);
  G_.setFromTriplets(g.begin(), g.end());
}

bool BorderZone::factorise(const SplitMatrix& A) {
  std::vector<char> isInZone(static_cast<std::size_t>(A.K().rows()), 0);
  for (Eigen::Index k = 0; k < A.B().nonZeros(); ++k)
    isInZone[static_cast<std::size_t>(A.B().innerIndexPtr()[k])] = 1;
  for (Eigen::Index k = 0; k < A.G().nonZeros(); ++k)
    isInZone[static_cast<std::size_t>(A.G().innerIndexPtr()[k])] = 1;
  unknowns_.clear();
  std::vector<int> place(isInZone.size(), -1);
  for (std::size_t i = 0; i < isInZone.size(); ++i)
    if (isInZone[i] != 0) {
      place[i] = static_cast<int>(unknowns_.size());
      unknowns_.push_back(static_cast<int>(i));
    }

  const auto z = static_cast<int>(unknowns_.size());
  std::vector<Eigen::Triplet<double>> triplets;
  for (int row = 0; row < z; ++row)
    for (SplitMatrix::Rows::InnerIterator entry(A.K(), unknowns_[static_cast<std::size_t>(row)]); entry;
         ++entry)
      if (const int column = place[static_cast<std::size_t>(entry.col())]; column >= 0)
        triplets.emplace_back(row, column, entry.value());
  for (Eigen::Index column = 0; column < A.B().cols(); ++column)
    for (SplitMatrix::Columns::InnerIterator entry(A.B(), column); entry; ++entry)
      triplets.emplace_back(place[static_cast<std::size_t>(entry.row())], z + column, entry.value());
  for (Eigen::Index row = 0; row < A.G().rows(); ++row)
    for (SplitMatrix::Rows::InnerIterator entry(A.G(), row); entry; ++entry)
      triplets.emplace_back(z + row, place[static_cast<std::size_t>(entry.col())], entry.value());
  for (Eigen::Index column = 0; column < A.C().cols(); ++column)
    for (SplitMatrix::Columns::InnerIterator entry(A.C(), column); entry; ++entry)
      triplets.emplace_back(z + entry.row(), z + column, entry.value());
  M_.resize(z + A.C().rows(), z + A.C().cols());
  M_.setFromTriplets(triplets.begin(), triplets.end());
  if (M_.rows() == 0) return true;
  lu_.compute(M_);
  return lu_.info() == Eigen::Success;
}

Eigen::VectorXd BorderZone::solve(const Eigen::VectorXd& g) {
  const auto z = static_cast<Eigen::Index>(unknowns_.size());
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(z + g.size());
  rhs.tail(g.size()) = g;
  if (rhs.size() == 0) return g;
  const Eigen::VectorXd x = lu_.solve(rhs);
  return x.tail(g.size());
}

}  // namespace burnish
