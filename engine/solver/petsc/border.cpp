#include "engine/solver/petsc/border.h"

#include <algorithm>

namespace burnish {

using Columns = Eigen::SparseMatrix<double>;
using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

bool BorderZone::factorise(const Eigen::SparseMatrix<double>& K, const SystemBorder& border) {
  const auto& [B, G, C] = border;
  std::vector<char> isInZone(static_cast<std::size_t>(K.rows()), 0);
  for (Eigen::Index k = 0; k < B.nonZeros(); ++k)
    isInZone[static_cast<std::size_t>(B.innerIndexPtr()[k])] = 1;
  for (Eigen::Index k = 0; k < G.nonZeros(); ++k)
    isInZone[static_cast<std::size_t>(G.innerIndexPtr()[k])] = 1;
  unknowns_.clear();
  std::vector<int> place(isInZone.size(), -1);
  for (std::size_t i = 0; i < isInZone.size(); ++i)
    if (isInZone[i] != 0) {
      place[i] = static_cast<int>(unknowns_.size());
      unknowns_.push_back(static_cast<int>(i));
    }

  const auto z = static_cast<int>(unknowns_.size());
  std::vector<Eigen::Triplet<double>> triplets;
  for (int column = 0; column < z; ++column)
    for (Columns::InnerIterator entry(K, unknowns_[static_cast<std::size_t>(column)]); entry; ++entry)
      if (const int row = place[static_cast<std::size_t>(entry.row())]; row >= 0)
        triplets.emplace_back(row, column, entry.value());
  for (Eigen::Index column = 0; column < B.cols(); ++column)
    for (Columns::InnerIterator entry(B, column); entry; ++entry)
      triplets.emplace_back(place[static_cast<std::size_t>(entry.row())], z + column, entry.value());
  for (Eigen::Index row = 0; row < G.rows(); ++row)
    for (Rows::InnerIterator entry(G, row); entry; ++entry)
      triplets.emplace_back(z + row, place[static_cast<std::size_t>(entry.col())], entry.value());
  for (Eigen::Index column = 0; column < C.cols(); ++column)
    for (Columns::InnerIterator entry(C, column); entry; ++entry)
      triplets.emplace_back(z + entry.row(), z + column, entry.value());
  M_.resize(z + C.rows(), z + C.cols());
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
