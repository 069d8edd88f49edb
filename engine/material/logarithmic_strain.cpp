#include "engine/material/logarithmic_strain.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/material/principal_axes.h"

namespace burnish::inline material {
namespace {

/// (ln a − ln b)/(a − b).
double differenceOfLog(double a, double b) {
  return a == b ? 1.0 / a : std::log1p((a - b) / b) / (a - b);
}

/// The same as `secondDifferenceOfLog` by the series about the mean m of the numbers, whose terms are the complete
/// homogeneous polynomials h_k of their distances d = (·−m)/m; as these add up to nothing, 1/((1−d₁t)(1−d₂t)(1−d₃t)) =
/// Σ h_k tᵏ gives h_k = −e₂ h_{k−2} + e₃ h_{k−3}, with the elementary symmetric polynomials e of d.
double seriesOfSecondDifference(double a, double b, double c) {
  constexpr std::size_t kTerms = 10;
  const double m = (a + b + c) / 3.0;
  const double x = (a - m) / m, y = (b - m) / m, z = (c - m) / m;
  const double e2 = x * y + (x + y) * z, e3 = x * y * z;
  std::array<double, kTerms> h{1.0, 0.0, -e2};
  for (std::size_t k = 3; k < kTerms; ++k) h[k] = e3 * h[k - 3] - e2 * h[k - 2];
  double sum = 0.0;
  for (std::size_t k = kTerms; k-- > 0;) sum = h[k] / static_cast<double>(k + 2) - sum;
  return -sum / (m * m);
}

/// x/sinh x.
double overSinh(double x) {
  return x == 0.0 ? 1.0 : x / std::sinh(x);
}

/// Place of the component AB in the order of `kVoigt`; none (-1) if it couples the plane with the third direction.
template <int Dim>
int placeOf(int A, int B) {
  if (A == B) return A;
  constexpr int kSize = kVoigt<Dim>;
  const int place = A + B == 1 ? 3 : A + B == 3 ? 4 : 5;
  return place < kSize ? place : -1;
}

}  // namespace

template <>
EigenSystem<2>::EigenSystem(const Eigen::Matrix3d& T) {
  const PrincipalAxes<2> axes(T);
  values = axes.values;
  // basis: columns n_1 ⊗ n_1 = (c², s², 0, −cs), … with c > 0
  const double c = std::sqrt(axes.basis(0, 0)), s = -axes.basis(3, 0) / c;
  vectors << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;
}

template <>
EigenSystem<3>::EigenSystem(const Eigen::Matrix3d& T) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.compute(T);  // iterative: the direct formula loses half the digits near equal values
  values = solver.eigenvalues();
  vectors = solver.eigenvectors();
}

double secondDifferenceOfLog(double a, double b, double c) {
  constexpr double kNear = 0.03;  // of the largest number: here the series and the quotient are equally good
  if (a > b) std::swap(a, b);
  if (b > c) std::swap(b, c);
  if (a > b) std::swap(a, b);
  if (c - a <= kNear * c) return seriesOfSecondDifference(a, b, c);
  return (differenceOfLog(a, b) - differenceOfLog(b, c)) / (a - c);
}

template <int Dim>
LogarithmicStrain<Dim>::LogarithmicStrain(const Eigen::Matrix3d& F) {
  const EigenSystem<Dim> C(F.transpose() * F);
  if (!(C.values.minCoeff() > 0.0) || !std::isfinite(C.values.sum())) return;
  isDefined_ = true;
  squares_ = C.values;
  logs_ = 0.5 * squares_.array().log();
  material_ = C.vectors;
  spatial_ = F * material_ * squares_.cwiseSqrt().cwiseInverse().asDiagonal();
  E_ = toMandel<Dim>(material_ * logs_.asDiagonal() * material_.transpose());
}

template <int Dim>
void LogarithmicStrain<Dim>::setResponse(const MandelVector<Dim>& T, const MandelMatrix<Dim>& D,
                                         MaterialResponse<Dim>& out) const {
  const MandelVector<Dim> factors = mandelFactors<Dim>();
  const MandelMatrix<Dim> fromPrincipal = mandelRotation<Dim>(material_);
  const MandelVector<Dim> inAxes = fromPrincipal.transpose() * T;
  const MandelVector<Dim> t = inAxes.cwiseQuotient(factors);
  MandelVector<Dim> p = MandelVector<Dim>::Ones();
  for (int k = 3; k < kVoigt<Dim>; ++k) p[k] = overSinh(logs_[k % 3] - logs_[(k + 1) % 3]);

  MandelMatrix<Dim> c = fromPrincipal.transpose() * D * fromPrincipal;
  c = p.asDiagonal() * c * p.asDiagonal();
  const Eigen::Vector3d stretches = squares_.cwiseSqrt();
  // the terms of q̂_AKB and q̂_BKA
  const auto addTurn = [&](int A, int K, int B, double difference) {
    const int AB = placeOf<Dim>(A, B), AK = placeOf<Dim>(A, K), KB = placeOf<Dim>(K, B);
    if (AB < 0 || AK < 0 || KB < 0) return;
    const double q = 2.0 * stretches[A] * stretches[B] * squares_[K] * difference;
    const double value = (A == B ? 1.0 : 2.0) * q * t[AB] / (factors[AK] * factors[KB]);
    c(AK, KB) += value;
    c(KB, AK) += value;
  };
  for (int A = 0; A < 3; ++A)
    for (int B = A; B < 3; ++B)
      for (int C = B; C < 3; ++C) {
        const double difference = secondDifferenceOfLog(squares_[A], squares_[B], squares_[C]);
        addTurn(B, A, C, difference);
        if (A != B) addTurn(A, B, C, difference);
        if (B != C) addTurn(A, C, B, difference);
      }

  const MandelMatrix<Dim> toSpace = mandelRotation<Dim>(spatial_);
  const MandelMatrix<Dim> scaled = factors.cwiseInverse().asDiagonal() * toSpace;
  out.tau.noalias() = scaled * p.cwiseProduct(inAxes);
  out.c.noalias() = scaled * c * scaled.transpose();
}

template <int Dim>
Eigen::Matrix3d exponential(const MandelVector<Dim>& E) {
  return EigenSystem<Dim>(fromMandel<Dim>(E)).function([](double e) { return std::exp(e); });
}

template <int Dim>
MandelVector<Dim> halfLogarithm(const Eigen::Matrix3d& b) {
  return toMandel<Dim>(EigenSystem<Dim>(b).function([](double v) { return 0.5 * std::log(v); }));
}

template class LogarithmicStrain<2>;
template class LogarithmicStrain<3>;
template Eigen::Matrix3d exponential<2>(const MandelVector<2>&);
template Eigen::Matrix3d exponential<3>(const MandelVector<3>&);
template MandelVector<2> halfLogarithm<2>(const Eigen::Matrix3d&);
template MandelVector<3> halfLogarithm<3>(const Eigen::Matrix3d&);

}  // namespace burnish::inline material
