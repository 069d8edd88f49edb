#include "engine/solver/cholesky.h"

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <new>
#include <numeric>
#include <utility>
#include <vector>

namespace burnish::inline solver {
namespace {

using Matrix = Cholesky::Matrix;

/// An order of the unknowns across lines: those of a patch are numbered along lines in its first direction, and where
/// these are the longer ones, eliminating line by line in the other direction takes few operations. The length of a
/// line is the distance at which most columns have entries again. For a pattern without lines any order.
std::vector<int> orderAcrossLines(const Matrix& K) {
  std::map<int, int> counts;  // of distances between runs of entries in a column
  for (int column = 0; column < K.cols(); ++column)
    for (int start = -1, before = -2, k = K.outerIndexPtr()[column]; k < K.outerIndexPtr()[column + 1]; ++k) {
      const int row = K.innerIndexPtr()[k];
      if (row > before + 1) {
        if (start >= 0) ++counts[row - start];
        start = row;
      }
      before = row;
    }
  const auto most = std::max_element(counts.begin(), counts.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  const int length = most == counts.end() ? 1 : most->first;
  std::vector<int> order(static_cast<std::size_t>(K.cols()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [=](int a, int b) { return a % length < b % length; });
  return order;
}

/// A dense matrix of CHOLMOD.
struct Workspace {
  /// Throws `std::bad_alloc`.
  Workspace(std::size_t rows, std::size_t columns, cholmod_common& common)
      : values(cholmod_allocate_dense(rows, columns, rows, CHOLMOD_REAL, &common)), common_(common) {
    if (values == nullptr) throw std::bad_alloc();
  }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
  ~Workspace() { cholmod_free_dense(&values, &common_); }

  cholmod_dense* values;

 private:
  cholmod_common& common_;
};

}  // namespace

struct Cholesky::Factors : Eigen::CholmodSupernodalLLT<Matrix, Eigen::Upper> {
  double nonZeros = 0.0, operations = 0.0;

  bool isAnalysed() const { return m_analysisIsOk != 0; }

  /// order: of the unknowns; null: what CHOLMOD finds.
  void analyse(const Matrix& K, int* order);

  /// Solves with one of the factors.
  Eigen::MatrixXd apply(int which, Eigen::MatrixXd B);
};

Cholesky::Cholesky(const Matrix& K) : factors_(std::make_unique<Factors>()) {
  constexpr double kFew = 500.0;  // operations per entry of the factor, as in the plane
  factors_->analyse(K, nullptr);
  if (!isAnalysed() || operations() > kFew * nonZeros()) return;
  std::vector<int> order = orderAcrossLines(K);
  auto byLines = std::make_unique<Factors>();
  byLines->analyse(K, order.data());
  if (byLines->isAnalysed() && byLines->operations < operations()) factors_ = std::move(byLines);
}

Cholesky::~Cholesky() = default;

bool Cholesky::isAnalysed() const {
  return factors_->isAnalysed();
}

double Cholesky::nonZeros() const {
  return factors_->nonZeros;
}
double Cholesky::operations() const {
  return factors_->operations;
}

bool Cholesky::factorise(const Matrix& K) {
  factors_->factorize(K);
  if (factors_->cholmod().status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  return factors_->info() == Eigen::Success;
}

Eigen::MatrixXd Cholesky::forward(const Eigen::MatrixXd& B) {
  return factors_->apply(CHOLMOD_L, factors_->apply(CHOLMOD_P, B));
}

Eigen::VectorXd Cholesky::backward(const Eigen::VectorXd& x) {
  return factors_->apply(CHOLMOD_Pt, factors_->apply(CHOLMOD_Lt, x));
}

void Cholesky::Factors::analyse(const Matrix& K, int* order) {
  cholmod_common& common = cholmod();
  common.print = 0;  // a matrix that is not positive definite is no surprise here
  // Supernodes are merged more freely than by default, though that adds zeros: see `cholmod_common`.
  const std::array<std::size_t, 3> columns{8, 32, 64};
  const std::array<double, 3> zeros{0.9, 0.3, 0.1};
  std::copy(columns.begin(), columns.end(), common.nrelax);
  std::copy(zeros.begin(), zeros.end(), common.zrelax);
  if (order != nullptr) {
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
  }
  cholmod_sparse A = Eigen::viewAsCholmod(K.selfadjointView<Eigen::Upper>());
  m_cholmodFactor = cholmod_analyze_p(&A, order, nullptr, 0, &common);
  m_isInitialized = true;
  m_analysisIsOk = m_cholmodFactor != nullptr;
  // METIS without memory gives no order, and CHOLMOD calls that an invalid one.
  if (!m_analysisIsOk && common.status != CHOLMOD_TOO_LARGE) throw std::bad_alloc();
  m_info = m_analysisIsOk ? Eigen::Success : Eigen::InvalidInput;
  nonZeros = common.lnz;
  operations = common.fl;
}

Eigen::MatrixXd Cholesky::Factors::apply(int which, Eigen::MatrixXd B) {
  if (B.cols() == 0) return B;  // which CHOLMOD refuses
  // What CHOLMOD works in is given to it, as it does not look whether it has got it from itself.
  const auto columns = static_cast<std::size_t>(B.cols());
  Workspace solved(m_cholmodFactor->n, columns, cholmod()), permuted(m_cholmodFactor->n, columns, cholmod()),
      gathered(columns, m_cholmodFactor->maxesize, cholmod());
  cholmod_dense given = Eigen::viewAsCholmod(B);
  if (cholmod_solve2(which, m_cholmodFactor, &given, nullptr, &solved.values, nullptr, &permuted.values,
                     &gathered.values, &cholmod()) == 0)
    throw std::bad_alloc();
  B = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(solved.values->x), B.rows(), B.cols());
  return B;
}

}  // namespace burnish::inline solver
