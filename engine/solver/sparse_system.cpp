#include "engine/solver/sparse_system.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace burnish::inline solver {
namespace {

/// The pattern of a matrix, column by column.
struct Pattern {
  std::vector<int> begins{0}, rows;

  void endColumn() { begins.push_back(static_cast<int>(rows.size())); }

  Eigen::SparseMatrix<double> zeros() const { return zeros(std::ssize(begins) - 1); }

  Eigen::SparseMatrix<double> zeros(Eigen::Index numRows) const {
    Eigen::SparseMatrix<double> matrix(numRows, std::ssize(begins) - 1);
    matrix.resizeNonZeros(static_cast<Eigen::Index>(rows.size()));
    std::copy(begins.begin(), begins.end(), matrix.outerIndexPtr());
    std::copy(rows.begin(), rows.end(), matrix.innerIndexPtr());
    matrix.coeffs().setZero();
    return matrix;
  }
};

/// The entry of a row in a column, or where it would stand, from an entry of that column on.
int firstFrom(int entry, const Eigen::SparseMatrix<double>& matrix, int row, int column) {
  const int* rows = matrix.innerIndexPtr();
  return static_cast<int>(std::lower_bound(rows + entry, rows + matrix.outerIndexPtr()[column + 1], row) -
                          rows);
}

}  // namespace

SparseSystem::SparseSystem(std::vector<bool> prescribed, const std::vector<CouplingGroups>& termGroups,
                           int numLeading, std::optional<Division> division)
    : prescribed_(std::move(prescribed)),
      numLeading_(numLeading),
      equations_(prescribed_.size(), -1),
      division_(division ? std::move(*division) : undivided(numUnknowns())) {
  for (const int unknown : division_.order) {
    if (isPrescribed(unknown)) continue;
    equations_[static_cast<std::size_t>(unknown)] = static_cast<int>(free_.size());
    free_.push_back(unknown);
    if (unknown >= numLeading_) continue;
    ++numFreeLeading_;
    if (division_.ownerOf(unknown) < division_.rank) ++firstEquation_;
  }
  for (const auto& groups : termGroups) {
    auto& sorted = groups_.emplace_back();
    for (const auto& group : groups) sorted.push_back(isKept(group) ? sortedGroup(group) : Group{});
  }
  makePattern();
}

Division SparseSystem::leadingDivision() const {
  std::vector<int> owners;
  for (int unknown = 0; unknown < std::min(numLeading_, numUnknowns()); ++unknown)
    if (!isPrescribed(unknown)) owners.push_back(division_.ownerOf(unknown));
  return {std::move(owners), division_.rank, division_.ranks()};
}

SparseSystem::Kind SparseSystem::kindOf(int unknown) const {
  if (isPrescribed(unknown)) return Kind::Prescribed;
  if (unknown >= numLeading_) return Kind::Border;
  return division_.isOwn(unknown) ? Kind::Own : Kind::Elsewhere;
}

int SparseSystem::columnOfK(int unknown) const {
  return kindOf(unknown) == Kind::Own ? equationOf(unknown) - firstEquation_ : -1;
}

bool SparseSystem::isKept(const std::vector<int>& unknowns) const {
  return std::any_of(unknowns.begin(), unknowns.end(), [&](int unknown) {
    return division_.isOwn(unknown) || kindOf(unknown) == Kind::Border;
  });
}

SparseSystem::Group SparseSystem::sortedGroup(const std::vector<int>& unknowns) const {
  const auto at = [&](int place) { return unknowns[static_cast<std::size_t>(place)]; };
  Group group;
  group.order.resize(unknowns.size());
  std::iota(group.order.begin(), group.order.end(), 0);
  std::stable_sort(group.order.begin(), group.order.end(), [&](int a, int b) { return at(a) < at(b); });
  for (const int place : group.order) {
    auto& runs = group.runs;
    if (runs.empty() || at(place) != runs.back().first + runs.back().length ||
        kindOf(at(place)) != kindOf(runs.back().first) ||
        division_.ownerOf(at(place)) != division_.ownerOf(runs.back().first))
      runs.push_back({at(place), 0});  // also where an unknown stands in the group a second time
    ++runs.back().length;
  }
  if (std::is_sorted(group.order.begin(), group.order.end())) group.order.clear();
  return group;
}

/// Every unknown is coupled with itself and with all others of its groups.
void SparseSystem::makePattern() {
  std::vector<std::vector<const Group*>> groupsOf(prescribed_.size());
  for (const auto& groups : groups_)
    for (const auto& group : groups)
      for (const Run& run : group.runs)
        for (int k = run.first; k < run.first + run.length; ++k)
          groupsOf[static_cast<std::size_t>(k)].push_back(&group);

  Pattern here, elsewhere, ofRest;
  std::vector<char> isCoupled(prescribed_.size(), 0);
  struct Row {
    int unknown;
    Kind kind;
  };
  std::vector<Row> rows;
  for (std::size_t c = 0; c < prescribed_.size(); ++c) {
    const bool isSameNode = c > 0 && !groupsOf[c].empty() && groupsOf[c] == groupsOf[c - 1];
    if (!isSameNode) {
      auto first = isCoupled.begin() + static_cast<std::ptrdiff_t>(c), last = first + 1;
      *first = 1;
      for (const Group* group : groupsOf[c]) {
        for (const Run& run : group->runs) std::fill_n(isCoupled.begin() + run.first, run.length, char{1});
        first = std::min(first, isCoupled.begin() + group->runs.front().first);
        last = std::max(last, isCoupled.begin() + group->runs.back().first + group->runs.back().length);
      }
      rows.clear();
      for (auto it = first; it != last; ++it)
        if (const auto row = static_cast<int>(it - isCoupled.begin()); *it != 0)
          rows.push_back({row, kindOf(row)});
      std::fill(first, last, char{0});
    }
    const int column = static_cast<int>(c);
    const Kind kind = kindOf(column);
    const bool isKept = division_.isOwn(column) || kind == Kind::Border;
    for (const auto [row, kindOfRow] : rows) {
      if (kind == Kind::Own && kindOfRow == Kind::Own)
        here.rows.push_back(equationOf(row) - firstEquation_);
      else if (kind == Kind::Own && kindOfRow == Kind::Elsewhere)
        elsewhere.rows.push_back(equationOf(row));
      else if (isKept || kindOfRow == Kind::Border)
        ofRest.rows.push_back(row);
    }
    if (kind == Kind::Own) {
      std::sort(elsewhere.rows.begin() + elsewhere.begins.back(), elsewhere.rows.end());
      here.endColumn();
      elsewhere.endColumn();
    }
    ofRest.endColumn();
  }
  K_ = here.zeros();
  numHere_ = static_cast<int>(K_.nonZeros());
  elsewhere_ = elsewhere.zeros(numFreeLeading_);
  rest_ = ofRest.zeros();
}

void SparseSystem::setZero() {
  K_.coeffs().setZero();
  elsewhere_.coeffs().setZero();
  rest_.coeffs().setZero();
  products_.clear();
}

void SparseSystem::findStarts(Group& group) const {
  std::vector<int> unknowns;
  for (const Run& run : group.runs)
    for (int k = 0; k < run.length; ++k) unknowns.push_back(run.first + k);
  const std::vector<int> ascending = unknowns;
  for (std::size_t k = 0; k < group.order.size(); ++k)
    unknowns[static_cast<std::size_t>(group.order[k])] = ascending[k];
  group.starts.reserve(unknowns.size() * group.runs.size());
  for (const int column : unknowns) {
    const int ofK = columnOfK(column);
    int here = ofK >= 0 ? K_.outerIndexPtr()[ofK] : 0, inRest = rest_.outerIndexPtr()[column];
    const bool isKept = division_.isOwn(column) || kindOf(column) == Kind::Border;
    for (const Run& run : group.runs) {
      const Kind kind = kindOf(run.first);
      if (ofK >= 0 && kind == Kind::Own) {
        here = firstFrom(here, K_, equationOf(run.first) - firstEquation_, ofK);
        group.starts.push_back(here);
      } else if (ofK >= 0 && kind == Kind::Elsewhere) {
        const int begin = elsewhere_.outerIndexPtr()[ofK];
        group.starts.push_back(numHere_ + firstFrom(begin, elsewhere_, equationOf(run.first), ofK));
      } else if (isKept || kind == Kind::Border) {
        inRest = firstFrom(inRest, rest_, run.first, column);
        group.starts.push_back(~inRest);
      } else {
        group.starts.push_back(kNowhere);
      }
    }
  }
}

/// Asks for the entries of a column before they are added to: in a tangent that no cache holds, waiting for
/// them takes longer than adding.
void SparseSystem::fetchAhead(const Group& group, const int* start) {
  for (const Run& run : group.runs) {
    const int place = *start++;
    if (place == kNowhere) continue;
    const double* entry = &entryAt(place);
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
  // valueAt: by ascending unknown.
  const auto addToColumn = [&](const auto& valueAt) {
    int row = 0;
    for (const Run& run : group.runs) {
      const int place = *start++;
      if (place != kNowhere) {
        double* entry = &entryAt(place);
        for (int k = 0; k < run.length; ++k) entry[k] += valueAt(row + k);
      }
      row += run.length;
    }
  };
  for (Eigen::Index c = 0; c < K.cols(); ++c) {
    if (c + 1 < K.cols()) fetchAhead(group, start + group.runs.size());
    const double* column = K.col(c).data();
    if (group.order.empty())
      addToColumn([&](int row) { return column[row]; });
    else
      addToColumn([&](int row) { return column[group.order[static_cast<std::size_t>(row)]]; });
  }
}

void SparseSystem::moveIntoColumn(int unknown, Eigen::Ref<Eigen::VectorXd> values) {
  const auto move = [&](int row, double& entry) {
    double& value = values(row);
    entry += value;
    value = 0.0;
  };
  for (Matrix::InnerIterator entry(rest_, unknown); entry && entry.row() < values.size(); ++entry)
    move(static_cast<int>(entry.row()), entry.valueRef());
  const int column = columnOfK(unknown);
  if (column < 0) return;
  const auto moveAll = [&](Matrix& matrix, int firstEquation) {
    for (Matrix::InnerIterator entry(matrix, column); entry; ++entry) {
      const int row = free_[static_cast<std::size_t>(firstEquation + entry.row())];
      if (row >= values.size()) return;
      move(row, entry.valueRef());
    }
  };
  moveAll(K_, firstEquation_);
  moveAll(elsewhere_, 0);
}

/// Calls f(row, column, place) for all entries, column by column.
template <class F>
void SparseSystem::forEachByColumns(const F& f) const {
  assert(division_.isWhole());
  for (int column = 0; column < numUnknowns(); ++column) {
    const int equation = columnOfK(column);
    int k = equation >= 0 ? K_.outerIndexPtr()[equation] : 0;
    const int end = equation >= 0 ? K_.outerIndexPtr()[equation + 1] : 0;
    const auto rowOfK = [&] { return free_[static_cast<std::size_t>(K_.innerIndexPtr()[k])]; };
    for (int r = rest_.outerIndexPtr()[column]; r < rest_.outerIndexPtr()[column + 1]; ++r) {
      const int row = rest_.innerIndexPtr()[r];
      for (; k < end && rowOfK() < row; ++k) f(rowOfK(), column, k);
      f(row, column, ~r);
    }
    for (; k < end; ++k) f(rowOfK(), column, k);
  }
}

void SparseSystem::findWhole() {
  Pattern pattern;
  std::vector<int> places;
  int next = 0;  // column
  forEachByColumns([&](int row, int column, int place) {
    const int r = equations_[static_cast<std::size_t>(row)], c = equations_[static_cast<std::size_t>(column)];
    if (r < 0 || c < 0) return;
    for (; next < c; ++next) pattern.endColumn();
    pattern.rows.push_back(r);
    places.push_back(place);
  });
  pattern.endColumn();
  whole_ = pattern.zeros();
  wholePlaces_ = std::move(places);  // last, as the memory may end before
}

void SparseSystem::addProducts(const Eigen::VectorXd& x, Eigen::VectorXd& y, Precision precision) const {
  const auto leading = Eigen::Map<const Eigen::VectorXi>(free_.data(), numFreeLeading_);
  Eigen::VectorXd all = Eigen::VectorXd::Zero(numUnknowns()), product = all;
  all(leading) = x;
  for (const TangentProduct* part : products_) part->addTimes(all, product, precision);
  y += product(leading.segment(firstEquation_, K_.cols()));
}

const SparseSystem::Matrix& SparseSystem::whole() {
  if (products_.empty()) return wholeOfEntries();
  wholeWithProducts_ = wholeOfEntries();
  for (const TangentProduct* part : products_)
    wholeWithProducts_ += part->entries(equations_, static_cast<int>(free_.size()));
  return wholeWithProducts_;
}

const SparseSystem::Matrix& SparseSystem::wholeOfEntries() {
  assert(division_.isWhole());
  if (K_.cols() == std::ssize(free_)) return K_;
  if (wholePlaces_.empty()) findWhole();
  double* to = whole_.valuePtr();
  for (const int place : wholePlaces_) *to++ = entryAt(place);
  return whole_;
}

SystemBorder SparseSystem::border() const {
  const Eigen::Index n = numFreeLeading_, m = std::ssize(free_) - n;
  std::vector<Eigen::Triplet<double>> b, g, c;
  for (const int column : free_) {
    const int j = equations_[static_cast<std::size_t>(column)];
    for (Matrix::InnerIterator entry(rest_, column); entry; ++entry) {
      const int i = equations_[static_cast<std::size_t>(entry.row())];
      if (i < 0 || entry.value() == 0.0) continue;
      if (i < n)
        b.emplace_back(i, j - n, entry.value());
      else if (j < n)
        g.emplace_back(i - n, j, entry.value());
      else
        c.emplace_back(i - n, j - n, entry.value());
    }
  }
  SystemBorder border;
  border.B.resize(n, m);
  border.B.setFromTriplets(b.begin(), b.end());
  border.G.resize(m, n);
  border.G.setFromTriplets(g.begin(), g.end());
  border.C.resize(m, m);
  border.C.setFromTriplets(c.begin(), c.end());
  return border;
}

Eigen::VectorXd SparseSystem::timesPrescribed(const Eigen::VectorXd& increments) const {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(numUnknowns());
  for (const int column : division_.own())
    if (isPrescribed(column)) product += rest_.col(column) * increments(column);
  if (products_.empty()) return product;
  Eigen::VectorXd prescribed = increments;
  prescribed(free_).setZero();
  Eigen::VectorXd ofProducts = Eigen::VectorXd::Zero(numUnknowns());
  for (const TangentProduct* part : products_) part->addTimes(prescribed, ofProducts, Precision::Full);
  for (const int unknown : division_.own()) product(unknown) += ofProducts(unknown);
  return product;
}

Eigen::VectorXd SparseSystem::timesMagnitudes(const Eigen::VectorXd& magnitudes) const {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(numUnknowns());
  for (const int column : division_.own()) product += rest_.col(column).cwiseAbs() * magnitudes(column);
  const auto here = Eigen::Map<const Eigen::VectorXi>(free_.data() + firstEquation_, K_.cols());
  product(here) += K_.cwiseAbs() * magnitudes(here);
  const auto all = Eigen::Map<const Eigen::VectorXi>(free_.data(), elsewhere_.rows());
  if (elsewhere_.nonZeros() > 0) product(all) += elsewhere_.cwiseAbs() * magnitudes(here);
  return product;
}

void SparseSystem::setEntries(const Entries& entries) {
  K_.coeffs() = entries.leading;
  rest_.coeffs() = entries.rest;
}

Eigen::VectorXd SparseSystem::byColumns(const Entries& entries) const {
  Eigen::VectorXd values(nonZeros());
  double* to = values.data();
  forEachByColumns(
      [&](int, int, int place) { *to++ = place >= 0 ? entries.leading(place) : entries.rest(~place); });
  return values;
}

SparseSystem::Entries SparseSystem::fromColumns(const Eigen::VectorXd& values) const {
  Entries entries{Eigen::VectorXd(K_.nonZeros()), Eigen::VectorXd(rest_.nonZeros())};
  const double* from = values.data();
  forEachByColumns(
      [&](int, int, int place) { (place >= 0 ? entries.leading(place) : entries.rest(~place)) = *from++; });
  return entries;
}

SparseSystem::Matrix SparseSystem::tangent() const {
  Pattern pattern;
  int next = 0;
  forEachByColumns([&](int row, int column, int) {
    for (; next < column; ++next) pattern.endColumn();
    pattern.rows.push_back(row);
  });
  pattern.endColumn();
  Matrix tangent = pattern.zeros();
  tangent.coeffs() = byColumns(entries());
  return tangent;
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

}  // namespace burnish::inline solver
