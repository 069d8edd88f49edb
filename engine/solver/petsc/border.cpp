#include "engine/solver/petsc/border.h"

#include <algorithm>

#include "engine/core/shares.h"

namespace burnish::inline solver {

using Columns = Eigen::SparseMatrix<double>;
using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

namespace {

/// Whether factors of a zone of so many of n unknowns are cheap beside the V-cycles that they save.
bool isSmall(std::ptrdiff_t zone, std::ptrdiff_t n) {
  return zone <= std::clamp<std::ptrdiff_t>(n / 4, 1'000, 10'000);
}

/// Of unknowns with a flag, those that K couples them with as well. firstColumn: of K that this rank has.
std::vector<char> addNeighbours(const SystemMatrix& A, const std::vector<char>& flags, const Team& team,
                                int firstColumn) {
  std::vector<char> all = flags;
  std::vector<double> others;
  const auto add = [&](const Columns& part, int firstRow) {
    for (int k = 0; k < part.cols(); ++k)
      if (flags[static_cast<std::size_t>(firstColumn + k)] != 0)
        for (Columns::InnerIterator entry(part, k); entry; ++entry) {
          char& flag = all[static_cast<std::size_t>(firstRow + entry.row())];
          if (flag == 0 && !team.isAlone()) others.push_back(static_cast<double>(firstRow + entry.row()));
          flag = 1;
        }
  };
  add(A.leading(), firstColumn);
  add(A.leadingElsewhere(), 0);
  gatherLists(team, others);
  for (const double unknown : others) all[static_cast<std::size_t>(unknown)] = 1;
  return all;
}

}  // namespace

std::vector<Eigen::Triplet<double>> BorderZone::entriesOfK(const SystemMatrix& A,
                                                           const std::vector<int>& place, const Team& team,
                                                           int firstColumn) {
  std::vector<double> entries;  // row, column, value
  const auto add = [&](const Columns& part, int firstRow) {
    for (int k = 0; k < part.cols(); ++k) {
      const int column = place[static_cast<std::size_t>(firstColumn + k)];
      if (column < 0) continue;
      for (Columns::InnerIterator entry(part, k); entry; ++entry)
        if (const int row = place[static_cast<std::size_t>(firstRow + entry.row())]; row >= 0)
          entries.insert(entries.end(),
                         {static_cast<double>(row), static_cast<double>(column), entry.value()});
    }
  };
  add(A.leading(), firstColumn);
  add(A.leadingElsewhere(), 0);
  gatherLists(team, entries);
  std::vector<Eigen::Triplet<double>> triplets;
  for (std::size_t k = 0; k < entries.size(); k += 3)
    triplets.emplace_back(static_cast<int>(entries[k]), static_cast<int>(entries[k + 1]), entries[k + 2]);
  return triplets;
}

BorderZone::BorderZone() {
  // Of what is a few layers thick nested dissection makes factors of half the size that minimum degree does.
  lu_.umfpackControl()[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
  lu_.umfpackControl()[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
  lu_.umfpackControl()[UMFPACK_IRSTEP] = 0;  // of no use to GMRES, which knows the residual
}

bool BorderZone::factorise(const SystemMatrix& A, const SystemBorder& border, const Team& team,
                           int firstColumn) {
  const auto& [B, G, C] = border;
  std::vector<char> isInZone(static_cast<std::size_t>(B.rows()), 0);
  for (Eigen::Index k = 0; k < B.nonZeros(); ++k)
    isInZone[static_cast<std::size_t>(B.innerIndexPtr()[k])] = 1;
  for (Eigen::Index k = 0; k < G.nonZeros(); ++k)
    isInZone[static_cast<std::size_t>(G.innerIndexPtr()[k])] = 1;
  std::vector<char> withNeighbours = addNeighbours(A, isInZone, team, firstColumn);
  if (isSmall(std::count(withNeighbours.begin(), withNeighbours.end(), 1), B.rows()))
    isInZone = std::move(withNeighbours);
  unknowns_.clear();
  std::vector<int> place(isInZone.size(), -1);
  for (std::size_t i = 0; i < isInZone.size(); ++i)
    if (isInZone[i] != 0) {
      place[i] = static_cast<int>(unknowns_.size());
      unknowns_.push_back(static_cast<int>(i));
    }

  const auto z = static_cast<int>(unknowns_.size());
  std::vector<Eigen::Triplet<double>> triplets = entriesOfK(A, place, team, firstColumn);
  if (!team.isLast()) return team.all(true);
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
  if (M_.rows() > 0) lu_.compute(M_);
  return team.all(M_.rows() == 0 || lu_.info() == Eigen::Success);
}

Eigen::VectorXd BorderZone::solve(const Eigen::VectorXd& r) {
  if (r.size() == 0) return r;
  return lu_.solve(r);
}

}  // namespace burnish::inline solver
