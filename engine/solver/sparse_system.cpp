#include "engine/solver/sparse_system.h"

#include <algorithm>
#include <utility>

namespace burnish {
namespace {

/// Rows of every column, sorted, without repetition.
std::vector<std::vector<int>> columnPattern(std::size_t numUnknowns,
                                            const std::vector<CouplingGroups>& termGroups) {
  std::vector<std::vector<int>> columns(numUnknowns);
  const auto tidy = [](std::vector<int>& rows) {
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  };
  std::vector<std::size_t> tidied(numUnknowns, 64);
  for (const auto& groups : termGroups)
    for (const auto& group : groups)
      for (const int column : group) {
        auto& rows = columns[static_cast<std::size_t>(column)];
        rows.insert(rows.end(), group.begin(), group.end());
        auto& limit = tidied[static_cast<std::size_t>(column)];
        if (rows.size() > limit) {  // keeps the lists short while they grow
          tidy(rows);
          limit = std::max<std::size_t>(64, 4 * rows.size());
        }
      }
  for (std::size_t c = 0; c < numUnknowns; ++c) {
    columns[c].push_back(static_cast<int>(c));
    tidy(columns[c]);
  }
  return columns;
}

Eigen::SparseMatrix<double> zeroMatrix(const std::vector<std::vector<int>>& columns) {
  const auto n = static_cast<Eigen::Index>(columns.size());
  Eigen::SparseMatrix<double> matrix(n, n);
  std::size_t entries = 0;
  for (const auto& rows : columns) entries += rows.size();
  matrix.resizeNonZeros(static_cast<Eigen::Index>(entries));
  int next = 0;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    matrix.outerIndexPtr()[c] = next;
    for (const int row : columns[c]) matrix.innerIndexPtr()[next++] = row;
  }
  matrix.outerIndexPtr()[columns.size()] = next;
  matrix.coeffs().setZero();
  return matrix;
}

}  // namespace

SparseSystem::SparseSystem(std::vector<bool> prescribed, const std::vector<CouplingGroups>& termGroups)
    : prescribed_(std::move(prescribed)),
      tangent_(zeroMatrix(columnPattern(prescribed_.size(), termGroups))) {
  std::vector<int> equation(prescribed_.size(), -1);
  for (std::size_t i = 0; i < prescribed_.size(); ++i)
    if (!prescribed_[i]) {
      equation[i] = static_cast<int>(free_.size());
      free_.push_back(static_cast<int>(i));
    }

  std::vector<std::vector<int>> freeColumns(free_.size());
  for (std::size_t c = 0; c < free_.size(); ++c)
    for (int k = tangent_.outerIndexPtr()[free_[c]]; k < tangent_.outerIndexPtr()[free_[c] + 1]; ++k) {
      const int row = equation[static_cast<std::size_t>(tangent_.innerIndexPtr()[k])];
      if (row < 0) continue;
      freeColumns[c].push_back(row);
      freeEntries_.push_back(k);
    }
  freeTangent_ = zeroMatrix(freeColumns);

  for (const auto& groups : termGroups) {
    Places places;
    for (const auto& group : groups) {
      places.offsets.push_back(places.entries.size());
      for (const int column : group) {
        const int* begin = tangent_.innerIndexPtr() + tangent_.outerIndexPtr()[column];
        const int* end = tangent_.innerIndexPtr() + tangent_.outerIndexPtr()[column + 1];
        for (const int row : group)
          places.entries.push_back(
              static_cast<int>(std::lower_bound(begin, end, row) - tangent_.innerIndexPtr()));
      }
    }
    places_.push_back(std::move(places));
  }
}

void SparseSystem::add(std::size_t term, std::size_t group, const Eigen::Ref<const Eigen::MatrixXd>& K) {
  const auto& places = places_[term];
  const int* entry = places.entries.data() + places.offsets[group];
  double* values = tangent_.valuePtr();
  for (Eigen::Index c = 0; c < K.cols(); ++c)
    for (Eigen::Index r = 0; r < K.rows(); ++r) values[*entry++] += K(r, c);
}

const Eigen::SparseMatrix<double>& SparseSystem::freeTangent() {
  const double* from = tangent_.valuePtr();
  double* to = freeTangent_.valuePtr();
  for (std::size_t k = 0; k < freeEntries_.size(); ++k) to[k] = from[freeEntries_[k]];
  return freeTangent_;
}

Eigen::VectorXd SparseSystem::expandFromFree(const Eigen::VectorXd& free) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(numUnknowns());
  all(free_) = free;
  return all;
}

std::vector<std::vector<int>> colourGroups(const CouplingGroups& groups, int numUnknowns) {
  std::vector<std::vector<int>> colours;
  std::vector<std::vector<bool>> taken;  // one flag per unknown and colour
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::size_t colour = 0;
    const auto isFree = [&](std::size_t c) {
      return std::none_of(groups[g].begin(), groups[g].end(),
                          [&](int unknown) { return taken[c][static_cast<std::size_t>(unknown)]; });
    };
    while (colour < colours.size() && !isFree(colour)) ++colour;
    if (colour == colours.size()) {
      colours.emplace_back();
      taken.emplace_back(static_cast<std::size_t>(numUnknowns), false);
    }
    colours[colour].push_back(static_cast<int>(g));
    for (const int unknown : groups[g]) taken[colour][static_cast<std::size_t>(unknown)] = true;
  }
  return colours;
}

}  // namespace burnish
