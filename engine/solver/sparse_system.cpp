#include "engine/solver/sparse_system.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace burnish {
namespace {

/// A square matrix of zeros from the begins of its columns and their rows.
Eigen::SparseMatrix<double> zeroMatrix(const std::vector<int>& begins, const std::vector<int>& rows) {
  const auto n = static_cast<Eigen::Index>(begins.size()) - 1;
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.resizeNonZeros(static_cast<Eigen::Index>(rows.size()));
  std::copy(begins.begin(), begins.end(), matrix.outerIndexPtr());
  std::copy(rows.begin(), rows.end(), matrix.innerIndexPtr());
  matrix.coeffs().setZero();
  return matrix;
}

}  // namespace

SparseSystem::SparseSystem(std::vector<bool> prescribed, const std::vector<CouplingGroups>& termGroups)
    : prescribed_(std::move(prescribed)) {
  for (const auto& groups : termGroups) {
    auto& sorted = groups_.emplace_back();
    for (const auto& group : groups) sorted.push_back(sortedGroup(group));
  }
  tangent_ = patternOf(prescribed_.size(), groups_);
  findFreeEntries();
}

SparseSystem::Group SparseSystem::sortedGroup(const std::vector<int>& unknowns) {
  const auto at = [&](int place) { return unknowns[static_cast<std::size_t>(place)]; };
  Group group;
  group.order.resize(unknowns.size());
  std::iota(group.order.begin(), group.order.end(), 0);
  std::stable_sort(group.order.begin(), group.order.end(), [&](int a, int b) { return at(a) < at(b); });
  for (const int place : group.order) {
    auto& runs = group.runs;
    if (runs.empty() || at(place) != runs.back().first + runs.back().length)
      runs.push_back({at(place), 0});  // also where an unknown stands in the group a second time
    ++runs.back().length;
  }
  return group;
}

/// Every unknown is coupled with itself and with all others of its groups.
Eigen::SparseMatrix<double> SparseSystem::patternOf(std::size_t numUnknowns,
                                                    const std::vector<std::vector<Group>>& terms) {
  std::vector<std::vector<const Group*>> groupsOf(numUnknowns);
  for (const auto& groups : terms)
    for (const auto& group : groups)
      for (const Run& run : group.runs)
        for (int k = run.first; k < run.first + run.length; ++k)
          groupsOf[static_cast<std::size_t>(k)].push_back(&group);

  std::vector<int> begins{0}, rows;
  std::vector<char> isCoupled(numUnknowns, 0);
  for (std::size_t c = 0; c < numUnknowns; ++c) {
    if (c > 0 && !groupsOf[c].empty() && groupsOf[c] == groupsOf[c - 1]) {  // directions of one node
      const int begin = begins[c - 1], end = begins[c];
      for (int k = begin; k < end; ++k) rows.push_back(rows[static_cast<std::size_t>(k)]);
    } else {
      auto first = isCoupled.begin() + static_cast<std::ptrdiff_t>(c), last = first + 1;
      *first = 1;
      for (const Group* group : groupsOf[c]) {
        for (const Run& run : group->runs) std::fill_n(isCoupled.begin() + run.first, run.length, char{1});
        first = std::min(first, isCoupled.begin() + group->runs.front().first);
        last = std::max(last, isCoupled.begin() + group->runs.back().first + group->runs.back().length);
      }
      for (auto it = first; it != last; ++it)
        if (*it != 0) rows.push_back(static_cast<int>(it - isCoupled.begin()));
      std::fill(first, last, char{0});
    }
    begins.push_back(static_cast<int>(rows.size()));
  }
  return zeroMatrix(begins, rows);
}

void SparseSystem::findFreeEntries() {
  std::vector<int> equation(prescribed_.size(), -1);
  for (std::size_t i = 0; i < prescribed_.size(); ++i)
    if (!prescribed_[i]) {
      equation[i] = static_cast<int>(free_.size());
      free_.push_back(static_cast<int>(i));
    }

  std::vector<int> begins{0}, rows;
  for (const int column : free_) {
    for (int k = tangent_.outerIndexPtr()[column]; k < tangent_.outerIndexPtr()[column + 1]; ++k) {
      const int row = equation[static_cast<std::size_t>(tangent_.innerIndexPtr()[k])];
      if (row < 0) continue;
      rows.push_back(row);
      freeEntries_.push_back(k);
    }
    begins.push_back(static_cast<int>(rows.size()));
  }
  freeTangent_ = zeroMatrix(begins, rows);
}

void SparseSystem::findStarts(Group& group) const {
  std::vector<int> unknowns(group.order.size());
  const int* place = group.order.data();
  for (const Run& run : group.runs)
    for (int k = 0; k < run.length; ++k) unknowns[static_cast<std::size_t>(*place++)] = run.first + k;
  group.starts.reserve(unknowns.size() * group.runs.size());
  for (const int column : unknowns) {
    const int* entry = tangent_.innerIndexPtr() + tangent_.outerIndexPtr()[column];
    const int* end = tangent_.innerIndexPtr() + tangent_.outerIndexPtr()[column + 1];
    for (const Run& run : group.runs) {
      entry = std::lower_bound(entry, end, run.first);
      group.starts.push_back(static_cast<int>(entry - tangent_.innerIndexPtr()));
    }
  }
}

/// Asks for the entries of a column before they are added to: in a tangent that no cache holds, waiting for
/// them takes longer than adding.
void SparseSystem::fetchAhead(const Group& group, const int* start) {
  for (const Run& run : group.runs) {
    const double* entry = tangent_.valuePtr() + *start++;
    __builtin_prefetch(entry, 1);
    __builtin_prefetch(entry + run.length - 1, 1);
  }
}

void SparseSystem::add(std::size_t term, std::size_t number, const Eigen::Ref<const Eigen::MatrixXd>& K) {
  Group& group = groups_[term][number];
  if (group.starts.empty()) findStarts(group);
  add(group, K);
}

void SparseSystem::add(const std::vector<int>& unknowns, const Eigen::Ref<const Eigen::MatrixXd>& K) {
  Group group = sortedGroup(unknowns);
  findStarts(group);
  add(group, K);
}

void SparseSystem::add(const Group& group, const Eigen::Ref<const Eigen::MatrixXd>& K) {
  const int* start = group.starts.data();
  for (Eigen::Index c = 0; c < K.cols(); ++c) {
    if (c + 1 < K.cols()) fetchAhead(group, start + group.runs.size());
    const double* column = K.col(c).data();
    const int* row = group.order.data();
    for (const Run& run : group.runs) {
      double* entry = tangent_.valuePtr() + *start++;
      for (int k = 0; k < run.length; ++k) entry[k] += column[*row++];
    }
  }
}

void SparseSystem::moveIntoColumn(int unknown, Eigen::Ref<Eigen::VectorXd> values) {
  const int end = tangent_.outerIndexPtr()[unknown + 1];
  for (int k = tangent_.outerIndexPtr()[unknown]; k < end; ++k) {
    const int row = tangent_.innerIndexPtr()[k];
    if (row >= values.size()) return;
    double& value = values(row);
    tangent_.valuePtr()[k] += value;
    value = 0.0;
  }
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
