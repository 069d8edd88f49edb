#include "engine/solver/cholesky.h"

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/blas.h"

namespace burnish {
namespace {

using Matrix = Cholesky::Matrix;

/// Supernodes of CHOLMOD.
class SparseCholesky final : public Cholesky {
 public:
  explicit SparseCholesky(const Matrix& K) {
    factors_.cholmod().print = 0;  // a matrix that is not positive definite is no surprise here
    factors_.analyzePattern(K);
    nonZeros_ = factors_.cholmod().lnz;
    operations_ = factors_.cholmod().fl;
  }

  bool isAnalysed() const { return factors_.info() == Eigen::Success; }

  bool factorise(const Matrix& K) override {
    factors_.factorize(K);
    return factors_.info() == Eigen::Success;
  }

  Eigen::MatrixXd forward(const Eigen::MatrixXd& B) override {
    return factors_.apply(CHOLMOD_L, factors_.apply(CHOLMOD_P, B));
  }
  Eigen::VectorXd backward(const Eigen::VectorXd& x) override {
    return factors_.apply(CHOLMOD_Pt, factors_.apply(CHOLMOD_Lt, x));
  }

  double nonZeros() const override { return nonZeros_; }
  double operations() const override { return operations_; }

 private:
  struct Factors : Eigen::CholmodSupernodalLLT<Matrix, Eigen::Upper> {
    /// Solves with one of the factors.
    Eigen::MatrixXd apply(int factor, Eigen::MatrixXd B) {
      cholmod_dense given = Eigen::viewAsCholmod(B);
      cholmod_dense* solved = cholmod_solve(factor, m_cholmodFactor, &given, &cholmod());
      if (solved == nullptr) throw std::bad_alloc();
      B = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(solved->x), B.rows(), B.cols());
      cholmod_free_dense(&solved, &cholmod());
      return B;
    }
  };

  Factors factors_;
  double nonZeros_ = 0.0, operations_ = 0.0;
};

/// King's order: from one end of the graph to the other, next always one of those that are coupled with what
/// has been ordered, the front, and of them one that adds few to the front: the oldest of those that add hardly
/// more than any other one. On a grid that goes line by line, where breadth first mixes as many lines as a
/// point is coupled with.
class NarrowOrder {
 public:
  /// K: the upper triangle.
  explicit NarrowOrder(const Matrix& K)
      : graph_(K.selfadjointView<Eigen::Upper>()), isKnown_(size()), numBeyond_(size()) {
    for (std::size_t i = 0; i < size(); ++i)
      numBeyond_[i] = graph_.outerIndexPtr()[i + 1] - graph_.outerIndexPtr()[i];
  }

  /// The unknowns; nothing if the front grows to more than `limit`, which no band is narrower than.
  std::optional<std::vector<int>> find(double limit) {
    std::vector<int> order, front;
    for (int start = 0; order.size() < size();) {
      if (front.empty()) {
        while (isKnown_[static_cast<std::size_t>(start)]) ++start;
        for (const int i : end(start)) meet(i, front);
      }
      int least = std::numeric_limits<int>::max();
      for (const int i : front) least = std::min(least, beyond(i));
      const auto next = std::find_if(front.begin(), front.end(),
                                     [&](int i) { return beyond(i) <= least + kUnknownsOfNode; });
      order.push_back(*next);
      front.erase(next);
      forEachNeighbour(order.back(), [&](int i) {
        if (!isKnown_[static_cast<std::size_t>(i)]) meet(i, front);
      });
      if (static_cast<double>(front.size()) > limit) return std::nullopt;
    }
    return order;
  }

 private:
  /// Those that do not add more than so many above the fewest are alike; without that the last lines of a grid,
  /// which add nothing, would come before those that wait.
  static constexpr int kUnknownsOfNode = 3;

  std::size_t size() const { return static_cast<std::size_t>(graph_.cols()); }
  int beyond(int i) const { return numBeyond_[static_cast<std::size_t>(i)]; }

  template <class F>
  void forEachNeighbour(int i, const F& f) const {
    for (int k = graph_.outerIndexPtr()[i]; k < graph_.outerIndexPtr()[i + 1]; ++k)
      f(graph_.innerIndexPtr()[k]);
  }

  void meet(int i, std::vector<int>& front) {
    isKnown_[static_cast<std::size_t>(i)] = true;
    front.push_back(i);
    forEachNeighbour(i, [this](int k) { --numBeyond_[static_cast<std::size_t>(k)]; });
  }

  /// Those at one end of the part of the graph in which `start` lies: of a long grid all of the first lines.
  std::vector<int> end(int start) const {
    const std::vector<int> far = farthest({start});
    const int corner =
        *std::min_element(far.begin(), far.end(), [this](int a, int b) { return beyond(a) < beyond(b); });
    return farthest(farthest({corner}));
  }

  /// Those that are farthest from others.
  std::vector<int> farthest(const std::vector<int>& from) const {
    std::vector<int> walk = from, depths(size(), -1);
    for (const int i : from) depths[static_cast<std::size_t>(i)] = 0;
    for (std::size_t next = 0; next < walk.size(); ++next)
      forEachNeighbour(walk[next], [&, depth = depths[static_cast<std::size_t>(walk[next])] + 1](int i) {
        if (depths[static_cast<std::size_t>(i)] >= 0) return;
        depths[static_cast<std::size_t>(i)] = depth;
        walk.push_back(i);
      });
    const int deepest = depths[static_cast<std::size_t>(walk.back())];
    const auto last = std::find_if(walk.begin(), walk.end(),
                                   [&](int i) { return depths[static_cast<std::size_t>(i)] == deepest; });
    return {last, walk.end()};
  }

  Matrix graph_;
  std::vector<bool> isKnown_;   ///< ordered, or in the front
  std::vector<int> numBeyond_;  ///< neighbours that are not
};

/// All entries of a band beside the diagonal.
class BandCholesky final : public Cholesky {
 public:
  BandCholesky(const Matrix& K, std::vector<int> order) : order_(std::move(order)), place_(order_.size()) {
    for (std::size_t k = 0; k < order_.size(); ++k)
      place_[static_cast<std::size_t>(order_[k])] = static_cast<int>(k);
    forEachEntry(K, [&](Eigen::Index row, Eigen::Index column) { width_ = std::max(width_, row - column); });
  }

  bool factorise(const Matrix& K) override {
    band_.setZero(width_ + 1, K.cols());
    const double* value = K.valuePtr();
    forEachEntry(K, [&](Eigen::Index row, Eigen::Index column) { band_(row - column, column) = *value++; });
    return factoriseBand(band_);
  }

  Eigen::MatrixXd forward(const Eigen::MatrixXd& B) override {
    Eigen::MatrixXd X = B(order_, Eigen::all);
    for (auto x : X.colwise()) solveBand(band_, x);
    return X;
  }
  Eigen::VectorXd backward(const Eigen::VectorXd& x) override {
    Eigen::VectorXd solved = x;
    solveBandTransposed(band_, solved);
    return solved(place_);
  }

  double nonZeros() const override { return static_cast<double>((width_ + 1) * std::ssize(order_)); }
  double operations() const override {
    const auto width = static_cast<double>(width_);
    return width * width * static_cast<double>(order_.size());
  }

 private:
  /// Calls f with the row and the column of all entries in the new order, lower triangle.
  template <class F>
  void forEachEntry(const Matrix& K, const F& f) const {
    for (int column = 0; column < K.cols(); ++column)
      for (Matrix::InnerIterator entry(K, column); entry; ++entry) {
        const int a = place_[static_cast<std::size_t>(entry.row())];
        const int b = place_[static_cast<std::size_t>(column)];
        f(std::max(a, b), std::min(a, b));
      }
  }

  std::vector<int> order_;  ///< unknown at each place
  std::vector<int> place_;  ///< place of each unknown
  Eigen::Index width_ = 0;  ///< entries beside the diagonal
  Eigen::MatrixXd band_;    ///< width + 1 x unknowns: columns of the lower triangle from the diagonal on
};

}  // namespace

std::unique_ptr<Cholesky> makeCholesky(const Matrix& K) {
  // LAPACK's blocks are so much larger than supernodes that they do twice as many operations in that time.
  constexpr double kFaster = 2.0;
  auto sparse = std::make_unique<SparseCholesky>(K);
  if (!sparse->isAnalysed()) return nullptr;
  const double operations = kFaster * sparse->operations();
  if (auto order = NarrowOrder(K).find(std::sqrt(operations / static_cast<double>(K.cols())))) {
    auto band = std::make_unique<BandCholesky>(K, *std::move(order));
    if (band->operations() < operations) return band;
  }
  return sparse;
}

}  // namespace burnish
