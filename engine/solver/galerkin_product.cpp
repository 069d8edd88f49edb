#include "engine/solver/galerkin_product.h"

#include <algorithm>
#include <array>

#include "engine/core/lanes.h"

namespace burnish::inline solver {
namespace {

/// Room for the rows of a group, in whole registers.
constexpr auto kRoom = static_cast<std::size_t>(roundedToLanes(RowGroups::kMostRows));

/// Numbers that have been noted, each once.
class Noted {
 public:
  explicit Noted(Eigen::Index count) : isNoted_(static_cast<std::size_t>(count), 0) {}

  void note(int number) {
    char& isNoted = isNoted_[static_cast<std::size_t>(number)];
    if (isNoted == 0) numbers_.push_back(number);
    isNoted = 1;
  }

  /// All of them, ascending; begins anew.
  std::vector<int> take() {
    for (const int number : numbers_) isNoted_[static_cast<std::size_t>(number)] = 0;
    std::sort(numbers_.begin(), numbers_.end());
    return std::exchange(numbers_, {});
  }

 private:
  std::vector<char> isNoted_;
  std::vector<int> numbers_;
};

}  // namespace

GalerkinProduct::GalerkinProduct(const RowGroups& fine, const Prolongation& P)
    : fine_(&fine), P_(&P), product_(static_cast<std::size_t>(P.cols()) * kRoom) {
  findRuns({});
  makePattern();
}

GalerkinProduct::GalerkinProduct(const RowGroups& fine, const Prolongation& P, const SparseRows& elsewhere,
                                 const Prolongation& ofElsewhere)
    : fine_(&fine), P_(&P), ofElsewhere_(&ofElsewhere), product_(static_cast<std::size_t>(P.cols()) * kRoom) {
  findRuns(elsewhere);
  makePattern();
}

SparseRows GalerkinProduct::rows() const {
  return {static_cast<int>(P_->cols()), begins_.data(), columns_.data(), values_.data()};
}

std::span<const GalerkinProduct::Run> GalerkinProduct::runsOf(int group) const {
  const auto g = static_cast<std::size_t>(group);
  return {runs_.data() + runBegins_[g], runs_.data() + runBegins_[g + 1]};
}

void GalerkinProduct::findRuns(const SparseRows& elsewhere) {
  Noted noted(P_->cols());
  const auto note = [&](const Prolongation& P, int row) {
    for (Prolongation::InnerIterator entry(P, row); entry; ++entry) noted.note(static_cast<int>(entry.col()));
  };
  std::size_t longest = 0;
  for (int group = 0; group < fine_->size(); ++group) {
    for (const auto [first, length] : fine_->runs(group))
      for (int k = first; k < first + length; ++k) note(*P_, k);
    if (ofElsewhere_ != nullptr)
      for (int k = elsewhere.begins[fine_->begin(group)]; k < elsewhere.begins[fine_->begin(group + 1)]; ++k)
        note(*ofElsewhere_, elsewhere.columns[k]);
    runBegins_.push_back(runs_.size());
    const std::vector<int> columns = noted.take();
    for (const int column : columns) RowGroups::append(column, runs_, runBegins_.back());
    longest = std::max(longest, columns.size());
  }
  runBegins_.push_back(runs_.size());
  row_.resize(longest);
}

void GalerkinProduct::makePattern() {
  std::vector<std::vector<int>> groupsOf(
      static_cast<std::size_t>(P_->cols()));  // of A, per row of the product
  for (int row = 0; row < P_->rows(); ++row)
    for (Prolongation::InnerIterator entry(*P_, row); entry; ++entry) {
      auto& groups = groupsOf[static_cast<std::size_t>(entry.col())];
      if (groups.empty() || groups.back() != fine_->groupOf(row)) groups.push_back(fine_->groupOf(row));
    }
  Noted noted(P_->cols());
  std::vector<int> columns;
  begins_.push_back(0);
  for (std::size_t row = 0; row < groupsOf.size(); ++row) {
    if (row == 0 || groupsOf[row] != groupsOf[row - 1]) {
      for (const int group : groupsOf[row])
        for (const auto [first, length] : runsOf(group))
          for (int k = first; k < first + length; ++k) noted.note(k);
      columns = noted.take();
    }
    columns_.insert(columns_.end(), columns.begin(), columns.end());
    begins_.push_back(static_cast<int>(columns_.size()));
  }
  values_.resize(columns_.size());
  groups_.emplace(rows());
}

void GalerkinProduct::assign(const SparseRows& A, const SparseRows& elsewhere) {
  std::fill(values_.begin(), values_.end(), 0.0);
  for (int group = 0; group < fine_->size(); ++group) {
    multiplyByP(A, group);
    if (ofElsewhere_ != nullptr) addElsewhere(elsewhere, group);
    addTimesP(group);
  }
}

/// The rows of a group need not have the same columns of other ranks.
void GalerkinProduct::addElsewhere(const SparseRows& A, int group) {
  for (int r = 0; r < fine_->count(group); ++r) {
    const int row = fine_->begin(group) + r;
    for (int k = A.begins[row]; k < A.begins[row + 1]; ++k)
      for (Prolongation::InnerIterator entry(*ofElsewhere_, A.columns[k]); entry; ++entry)
        product_[static_cast<std::size_t>(entry.col()) * kRoom + static_cast<std::size_t>(r)] +=
            entry.value() * A.values[k];
  }
}

void GalerkinProduct::multiplyByP(const SparseRows& A, int group) {
  for (const auto [first, length] : runsOf(group))
    std::fill_n(product_.begin() + first * static_cast<std::ptrdiff_t>(kRoom),
                length * static_cast<std::ptrdiff_t>(kRoom), 0.0);
  const int begin = fine_->begin(group), count = fine_->count(group);
  std::array<const double*, RowGroups::kMostRows> rows{};
  for (int r = 0; r < count; ++r) rows[static_cast<std::size_t>(r)] = A.values + A.begins[begin + r];
  const int* const rowsOfP = P_->outerIndexPtr();
  int place = 0;  // in each row
  std::array<double, kRoom> entries{};
  for (const auto [first, length] : fine_->runs(group))
    for (int k = first; k < first + length; ++k, ++place) {
      for (int r = 0; r < count; ++r)
        entries[static_cast<std::size_t>(r)] = rows[static_cast<std::size_t>(r)][place];
      for (int p = rowsOfP[k]; p < rowsOfP[k + 1]; ++p) {
        double* sums = product_.data() + static_cast<std::size_t>(P_->innerIndexPtr()[p]) * kRoom;
        const double weight = P_->valuePtr()[p];
        for (std::size_t r = 0; r < kRoom; ++r) sums[r] += weight * entries[r];
      }
    }
}

void GalerkinProduct::addTimesP(int group) {
  const auto runs = runsOf(group);
  for (int r = 0; r < fine_->count(group); ++r) {
    double* to = row_.data();
    for (const auto [first, length] : runs)
      for (int k = first; k < first + length; ++k)
        *to++ = product_[static_cast<std::size_t>(k) * kRoom + static_cast<std::size_t>(r)];
    for (Prolongation::InnerIterator entry(*P_, fine_->begin(group) + r); entry; ++entry)
      addRow(static_cast<int>(entry.col()), entry.value(), runs);
  }
}

/// Each of the runs lies in one of those of the row.
void GalerkinProduct::addRow(int row, double factor, std::span<const Run> runs) {
  double* to = values_.data() + begins_[static_cast<std::size_t>(row)];
  const double* from = row_.data();
  const Run* own = groups_->runs(groups_->groupOf(row)).data();
  for (const auto [first, length] : runs) {
    while (own->first + own->length <= first) to += (own++)->length;
    double* sums = to + (first - own->first);
    for (int k = 0; k < length; ++k) sums[k] += factor * from[k];
    from += length;
  }
}

}  // namespace burnish::inline solver
