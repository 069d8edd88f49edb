#include "engine/solver/inertia.h"

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <utility>
#include <vector>

namespace burnish {
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

/// Adds w b bᵀ to the upper triangle of K for every column b of the border whose multiplier is active: those
/// of the others are empty.
void addBorder(const Matrix& A, Matrix& K) {
  const Eigen::Index n = K.rows();
  const Eigen::VectorXd diagonal = K.diagonal().cwiseAbs();  // before anything is added
  for (Eigen::Index column = n; column < A.cols(); ++column) {
    std::vector<std::pair<Eigen::Index, double>> entries;
    double square = 0.0, largest = 0.0;
    for (Matrix::InnerIterator entry(A, column); entry; ++entry) {
      if (entry.row() >= n || entry.value() == 0.0) continue;
      entries.emplace_back(entry.row(), entry.value());
      square += entry.value() * entry.value();
      largest = std::max(largest, diagonal(entry.row()));
    }
    for (const auto& [j, bj] : entries)
      for (const auto& [i, bi] : entries)
        if (i <= j) K.coeffRef(i, j) += kStiffness * largest / square * bi * bj;
  }
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
  Matrix K = symmetric.topLeftCorner(n_, n_).triangularView<Eigen::Upper>();
  addBorder(symmetric, K);
  if (!factors_) factors_ = std::make_unique<Factors>(K);
  return factors_->negativePivots(K);
}

}  // namespace burnish
