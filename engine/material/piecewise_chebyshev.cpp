#include "engine/material/piecewise_chebyshev.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "engine/core/error.h"

namespace burnish::inline material {
namespace {

constexpr int kSmallestExponent = -10;  // the first piece is [0, 2^-10] before any refinement,
constexpr int kLargestExponent = 10;    // the last one ends at 2^10
constexpr int kMaxDepth = 40;
constexpr std::size_t kMaxPieces = 4000;
constexpr double kTolerance = 1e-14;
constexpr double kNoise =
    1e-11;  // a remainder below this that halving does not reduce is round-off of the function
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Σ c_k T_k(t) by Clenshaw's recurrence.
template <std::size_t N>
double chebyshevSum(const std::array<double, N>& c, double t) {
  double b1 = 0.0;
  double b2 = 0.0;
  for (std::size_t k = N - 1; k > 0; --k) {
    const double b0 = c[k] + 2.0 * t * b1 - b2;
    b2 = b1;
    b1 = b0;
  }
  return c[0] + t * b1 - b2;
}

}  // namespace

PiecewiseChebyshev::PiecewiseChebyshev(const std::function<double(double)>& function) {
  constexpr Parent kNone{std::numeric_limits<double>::infinity(), 0.0};
  resolve(function, 0.0, std::ldexp(1.0, kSmallestExponent), kNone, 0);
  for (int exponent = kSmallestExponent; exponent < kLargestExponent; ++exponent)
    resolve(function, std::ldexp(1.0, exponent), std::ldexp(1.0, exponent + 1), kNone, 0);
}

double PiecewiseChebyshev::value(double x) const {
  const Piece* piece = pieceAt(x);
  return piece ? chebyshevSum(piece->value, piece->local(x)) : kNaN;
}

double PiecewiseChebyshev::slope(double x) const {
  const Piece* piece = pieceAt(x);
  return piece ? chebyshevSum(piece->slope, piece->local(x)) : kNaN;
}

double PiecewiseChebyshev::integral(double x) const {
  const Piece* piece = pieceAt(x);
  return piece ? chebyshevSum(piece->integral, piece->local(x)) : kNaN;
}

const PiecewiseChebyshev::Piece* PiecewiseChebyshev::pieceAt(double x) const {
  if (!(x >= 0.0 && x <= pieces_.back().end)) return nullptr;
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), x,
                                      [](double value, const Piece& piece) { return value < piece.start; });
  return &*std::prev(after);
}

/// Interpolation in the extrema of T_n, ends included, so that neighbouring pieces join.
PiecewiseChebyshev::Coefficients PiecewiseChebyshev::interpolate(
    const std::function<double(double)>& function, double start, double end) {
  constexpr int n = kDegree;
  std::array<double, n + 1> sample;
  for (int j = 0; j <= n; ++j) {
    const double t = std::cos(std::numbers::pi * j / n);
    sample[static_cast<std::size_t>(j)] = function(std::lerp(start, end, 0.5 * (1.0 + t)));
  }
  Coefficients c{};
  for (int k = 0; k <= n; ++k) {
    double sum = 0.0;
    for (int j = 0; j <= n; ++j) {
      const double weight = (j == 0 || j == n) ? 0.5 : 1.0;
      sum +=
          weight * sample[static_cast<std::size_t>(j)] * std::cos(std::numbers::pi * ((j * k) % (2 * n)) / n);
    }
    c[static_cast<std::size_t>(k)] = (k == 0 || k == n ? 1.0 : 2.0) * sum / n;
  }
  return c;
}

void PiecewiseChebyshev::resolve(const std::function<double(double)>& function, double start, double end,
                                 const Parent& parent, int depth) {
  const Coefficients c = interpolate(function, start, end);
  const bool finite = std::isfinite(c[0]);
  const double mid = 0.5 * (start + end);
  double tail = finite ? 0.0 : std::numeric_limits<double>::infinity();
  double scale = parent.scale;
  for (std::size_t k = 0; finite && k <= kDegree; ++k) {
    scale = std::max(scale, std::abs(c[k]));
    if (k + 3 > kDegree) tail = std::max(tail, std::abs(c[k]));
  }
  const bool resolved =
      finite && (tail <= kTolerance * scale || (tail <= kNoise * scale && tail > 0.125 * parent.tail));
  const bool nowhereFinite = !finite && !std::isfinite(function(start)) && !std::isfinite(function(mid)) &&
                             !std::isfinite(function(end));
  if (resolved || nowhereFinite || depth == kMaxDepth) {
    append(start, end, c);
    return;
  }
  resolve(function, start, mid, {tail, scale}, depth + 1);
  resolve(function, mid, end, {tail, scale}, depth + 1);
}

void PiecewiseChebyshev::append(double start, double end, const Coefficients& value) {
  if (pieces_.size() == kMaxPieces)
    throw Error("the function varies too wildly near " + std::to_string(start) +
                "; use a smoother one or a table");
  Piece piece{start, end, value, {}, {}};
  const double half = 0.5 * (end - start);
  double atStart = 0.0;
  for (std::size_t k = kDegree; k > 0; --k)
    piece.slope[k - 1] = piece.slope[k + 1] + 2.0 * static_cast<double>(k) * value[k] / half;
  piece.slope[0] *= 0.5;
  for (std::size_t k = 1; k <= kDegree + 1; ++k) {
    const double before = (k == 1 ? 2.0 : 1.0) * value[k - 1];
    const double after = k <= kDegree ? value[k + 1] : 0.0;
    piece.integral[k] = half * (before - after) / (2.0 * static_cast<double>(k));
    atStart += (k % 2 == 0 ? 1.0 : -1.0) * piece.integral[k];
  }
  piece.integral[0] = (pieces_.empty() ? 0.0 : chebyshevSum(pieces_.back().integral, 1.0)) - atStart;
  pieces_.push_back(piece);
}

}  // namespace burnish::inline material
