#include "engine/solver/petsc/divided_product.h"

#include <algorithm>
#include <span>

#include "engine/solver/petsc/matrix_blocks.h"
#include "engine/solver/petsc/prolongation_rows.h"

namespace burnish::inline solver {
namespace {

using petsc::check;
using petsc::rowsOf;

}  // namespace

DividedProduct::DividedProduct(Mat A, const RowGroups& groups, const Hierarchy::Prolongation& P,
                               const Division& rows, const Division& columns)
    : rank_(columns.rank), ranks_(PetscObjectComm(reinterpret_cast<PetscObject>(A))) {
  check(PetscObjectGetNewTag(reinterpret_cast<PetscObject>(A), &tag_));
  makeProduct(A, groups, P, rows, placesIn(columns));
  for (const int begin : columns.begins)
    begins_.push_back(static_cast<int>(std::ranges::lower_bound(places_, begin) - places_.begin()));
  makeMatrix(patternsOfRanks(), columns, static_cast<int>(P.cols()));
}

void DividedProduct::makeProduct(Mat A, const RowGroups& groups, const Hierarchy::Prolongation& P,
                                 const Division& rows, const std::vector<int>& placeOf) {
  const petsc::MatrixBlocks blocks(A);
  PetscInt count = 0;
  const PetscInt* numbers = nullptr;
  check(MatGetGhosts(A, &count, &numbers));
  std::vector<int> elsewhere;
  for (const PetscInt place : std::span(numbers, static_cast<std::size_t>(count)))
    elsewhere.push_back(rows.order[static_cast<std::size_t>(place)]);
  for (const std::span<const int> some : {rows.own(), std::span<const int>(elsewhere)})
    for (const int row : some)
      for (Hierarchy::Prolongation::InnerIterator entry(P, row); entry; ++entry)
        places_.push_back(placeOf[static_cast<std::size_t>(entry.col())]);
  std::ranges::sort(places_);
  places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
  const auto columnOf = [&](int column) {
    return static_cast<int>(std::ranges::lower_bound(places_, placeOf[static_cast<std::size_t>(column)]) -
                            places_.begin());
  };
  own_ = someRows(P, rows.own(), std::ssize(places_), columnOf);
  ofElsewhere_ = someRows(P, elsewhere, std::ssize(places_), columnOf);
  product_.emplace(groups, own_, rowsOf(blocks.offDiagonal), ofElsewhere_);
}

/// What every rank's product has in rows of this one: the place of each row, the number of its columns, and their places.
std::vector<std::vector<int>> DividedProduct::patternsOfRanks() const {
  const SparseRows rows = product_->rows();
  const std::size_t ranks = begins_.size() - 1;
  std::vector<int> sent, sizes(ranks), begins(ranks);
  for (std::size_t r = 0; r < ranks; ++r) {
    begins[r] = static_cast<int>(sent.size());
    for (int row = begins_[r]; row < begins_[r + 1]; ++row) {
      const auto columns = std::span(rows.columns + rows.begins[row], rows.columns + rows.begins[row + 1]);
      if (columns.empty()) continue;
      sent.push_back(places_[static_cast<std::size_t>(row)]);
      sent.push_back(static_cast<int>(columns.size()));
      for (const int column : columns) sent.push_back(places_[static_cast<std::size_t>(column)]);
    }
    sizes[r] = static_cast<int>(sent.size()) - begins[r];
  }
  std::vector<int> sizesHere(ranks), beginsHere(ranks);
  MPI_Alltoall(sizes.data(), 1, MPI_INT, sizesHere.data(), 1, MPI_INT, ranks_);
  for (std::size_t r = 1; r < ranks; ++r) beginsHere[r] = beginsHere[r - 1] + sizesHere[r - 1];
  std::vector<int> received(static_cast<std::size_t>(beginsHere.back() + sizesHere.back()));
  MPI_Alltoallv(sent.data(), sizes.data(), begins.data(), MPI_INT, received.data(), sizesHere.data(),
                beginsHere.data(), MPI_INT, ranks_);
  std::vector<std::vector<int>> patterns;
  for (std::size_t r = 0; r < ranks; ++r) {
    const auto begin = received.begin() + beginsHere[r];
    patterns.emplace_back(begin, begin + sizesHere[r]);
  }
  return patterns;
}

void DividedProduct::makeMatrix(const std::vector<std::vector<int>>& patterns, const Division& columns,
                                int numColumns) {
  const int first = columns.begins[static_cast<std::size_t>(rank_)],
            end = columns.begins[static_cast<std::size_t>(rank_) + 1];
  const auto isHere = [&](int place) { return place >= first && place < end; };
  const auto forRows = [](const std::vector<int>& pattern, const auto& act) {
    for (std::size_t k = 0; k < pattern.size(); k += 2 + static_cast<std::size_t>(pattern[k + 1]))
      act(pattern[k], std::span(pattern).subspan(k + 2, static_cast<std::size_t>(pattern[k + 1])));
  };
  std::vector<std::vector<int>> all(static_cast<std::size_t>(end - first));  // columns of each row
  for (const auto& pattern : patterns)
    forRows(pattern, [&](int place, std::span<const int> found) {
      auto& row = all[static_cast<std::size_t>(place - first)];
      row.insert(row.end(), found.begin(), found.end());
    });
  for (auto& row : all) {
    std::ranges::sort(row);
    row.erase(std::unique(row.begin(), row.end()), row.end());
    for (const int place : row)
      isHere(place) ? diagonal_.columns.push_back(place - first) : offDiagonal_.columns.push_back(place);
    for (Block* block : {&diagonal_, &offDiagonal_})
      block->begins.push_back(static_cast<int>(block->columns.size()));
  }
  const auto placeIn = [](const Block& block, std::size_t row, int column) {
    const auto begin = block.columns.begin() + block.begins[row],
               stop = block.columns.begin() + block.begins[row + 1];
    return static_cast<int>(std::lower_bound(begin, stop, column) - block.columns.begin());
  };
  for (std::size_t r = 0; r < patterns.size(); ++r) {
    if (patterns[r].empty()) continue;
    Share& share = shares_.emplace_back();
    share.rank = static_cast<int>(r);
    forRows(patterns[r], [&](int place, std::span<const int> found) {
      const auto row = static_cast<std::size_t>(place - first);
      for (const int column : found)
        share.targets.push_back(isHere(column) ? placeIn(diagonal_, row, column - first)
                                               : ~placeIn(offDiagonal_, row, column));
    });
    if (share.rank != rank_) share.values.resize(share.targets.size());
  }
  for (Block* block : {&diagonal_, &offDiagonal_}) block->values.resize(block->columns.size());
  const PetscInt own = end - first;
  check(MatCreateMPIAIJWithSplitArrays(ranks_, own, own, numColumns, numColumns, diagonal_.begins.data(),
                                       diagonal_.columns.data(), diagonal_.values.data(),
                                       offDiagonal_.begins.data(), offDiagonal_.columns.data(),
                                       offDiagonal_.values.data(), matrix_.place()));
}

void DividedProduct::assign(Mat A) {
  std::vector<MPI_Request> received(shares_.size(), MPI_REQUEST_NULL), sent;
  for (std::size_t k = 0; k < shares_.size(); ++k)
    if (shares_[k].rank != rank_)
      MPI_Irecv(shares_[k].values.data(), static_cast<int>(shares_[k].values.size()), MPI_DOUBLE,
                shares_[k].rank, tag_, ranks_, &received[k]);
  const petsc::MatrixBlocks blocks(A);
  product_->assign(rowsOf(blocks.diagonal), rowsOf(blocks.offDiagonal));
  const SparseRows rows = product_->rows();
  const auto valuesFor = [&](int rank) {
    return rows.values + rows.begins[begins_[static_cast<std::size_t>(rank)]];
  };
  for (int r = 0; r + 1 < static_cast<int>(begins_.size()); ++r) {
    const auto count = static_cast<int>(valuesFor(r + 1) - valuesFor(r));
    if (r == rank_ || count == 0) continue;
    MPI_Isend(valuesFor(r), count, MPI_DOUBLE, r, tag_, ranks_, &sent.emplace_back(MPI_REQUEST_NULL));
  }
  for (Block* block : {&diagonal_, &offDiagonal_}) std::ranges::fill(block->values, 0.0);
  for (std::size_t k = 0; k < shares_.size(); ++k) {
    MPI_Wait(&received[k], MPI_STATUS_IGNORE);
    add(shares_[k], shares_[k].rank == rank_ ? valuesFor(rank_) : shares_[k].values.data());
  }
  MPI_Waitall(static_cast<int>(sent.size()), sent.data(), MPI_STATUSES_IGNORE);
  petsc::noteChangedValues(matrix_);
}

void DividedProduct::add(const Share& share, const double* values) {
  for (const int target : share.targets)
    (target >= 0 ? diagonal_.values[static_cast<std::size_t>(target)]
                 : offDiagonal_.values[static_cast<std::size_t>(~target)]) += *values++;
}

}  // namespace burnish::inline solver
