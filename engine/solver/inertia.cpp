#include "engine/solver/inertia.h"

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <utility>
#include <vector>

namespace burnish::inline solver {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// W over the largest diagonal entry of K that it meets.
constexpr double kStiffness = 1e4;

/// L D Lᵀ whose diagonal can be asked for.
struct SimplicialFactors : Eigen::CholmodSimplicialLDLT<Matrix, Eigen::Upper> {
  int negativePivots() const {
    const auto* starts = static_cast<const StorageIndex*>(m_cholmodFactor->p);
    const auto* values = static_cast<const double*>(m_cholmodFactor->x);
    // Elimination ends at a pivot that vanishes; what follows it is not known.
    const auto done = std::min(m_cholmodFactor->minor, m_cholmodFactor->n);
    int count = done < m_cholmodFactor->n ? 1 : 0;
    for (std::size_t k = 0; k < done; ++k) count += values[starts[k]] < 0.0 ? 1 : 0;
    return count;
  }
};

/// The part of a column of the border that stands beside K.
struct BorderColumn {
  std::vector<std::pair<Eigen::Index, double>> entries;
  double square = 0.0, largest = 0.0;  ///< of the entries; of the diagonal entries of K that they meet

  BorderColumn(const Matrix& A, Eigen::Index n, const Eigen::VectorXd& diagonal, Eigen::Index column) {
    for (Matrix::InnerIterator entry(A, column); entry; ++entry) {
      if (entry.row() >= n || entry.value() == 0.0) continue;
      entries.emplace_back(entry.row(), entry.value());
      square += entry.value() * entry.value();
      largest = std::max(largest, diagonal(entry.row()));
    }
  }
};

/// Adds w b bᵀ to the upper triangle of K for every column b of the border whose multiplier is active: those
/// of the others are empty.
void addBorder(const Matrix& A, Matrix& K) {
  const Eigen::Index n = K.rows();
  const Eigen::VectorXd diagonal = K.diagonal().cwiseAbs();  // before anything is added
  for (Eigen::Index column = n; column < A.cols(); ++column) {
    const BorderColumn border(A, n, diagonal, column);
    for (const auto& [j, bj] : border.entries)
      for (const auto& [i, bi] : border.entries)
        if (i <= j) K.coeffRef(i, j) += kStiffness * border.largest / border.square * bi * bj;
  }
}

/// Whether multipliers are coupled with one another.
bool couplesMultipliers(const Matrix& A, Eigen::Index n) {
  for (Eigen::Index column = n; column < A.cols(); ++column)
    for (Matrix::InnerIterator entry(A, column); entry; ++entry)
      if (entry.row() >= n && entry.row() != column) return true;
  return false;
}

/// The upper triangle of A with C - W⁻¹. A multiplier that is not coupled with K and has no equation of its
/// own counts as -1.
Matrix relaxed(const Matrix& A, Eigen::Index n) {
  Matrix result = A.triangularView<Eigen::Upper>();
  const Eigen::VectorXd diagonal = A.diagonal().cwiseAbs();
  for (Eigen::Index column = n; column < A.cols(); ++column) {
    const BorderColumn border(A, n, diagonal, column);
    double& own = result.coeffRef(column, column);
    if (!border.entries.empty())
      own -= border.square / (kStiffness * border.largest);
    else if (own == 0.0)
      own = -1.0;
  }
  return result;
}

}  // namespace

/// Cholesky's method first: it is faster, and says no only where there is something to count.
class Inertia::Factors {
 public:
  explicit Factors(const Matrix& K) {
    for (auto* common : {&llt_.cholmod(), &ldlt_.cholmod()}) common->print = 0;
    llt_.analyzePattern(K);
  }

  int negativePivots(const Matrix& K) {
    llt_.factorize(K);
    if (llt_.info() == Eigen::Success) return 0;
    if (!analysed_) ldlt_.analyzePattern(K);
    analysed_ = true;
    ldlt_.factorize(K);
    return ldlt_.negativePivots();
  }

 private:
  Eigen::CholmodSupernodalLLT<Matrix, Eigen::Upper> llt_;
  SimplicialFactors ldlt_;
  bool analysed_ = false;
};

Inertia::Inertia(Eigen::Index leading) : n_(leading) {}

Inertia::~Inertia() = default;

int Inertia::unstableDirections(const Matrix& A) {
  const Matrix symmetric = 0.5 * (A + Matrix(A.transpose()));
  if (couplesMultipliers(symmetric, n_)) {
    const Matrix whole = relaxed(symmetric, n_);
    if (!factors_) factors_ = std::make_unique<Factors>(whole);
    return factors_->negativePivots(whole) - static_cast<int>(A.cols() - n_);
  }
  Matrix K = symmetric.topLeftCorner(n_, n_).triangularView<Eigen::Upper>();
  addBorder(symmetric, K);
  if (!factors_) factors_ = std::make_unique<Factors>(K);
  return factors_->negativePivots(K);
}

}  // namespace burnish::inline solver
