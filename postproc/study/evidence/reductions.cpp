#include "postproc/study/evidence/reductions.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "postproc/study/evidence/expression.h"

namespace burnish {
namespace {

/// Times and formulas of times carry rounding.
constexpr double kRounding = 1e-9;

double toleranceOf(const std::array<double, 2>& range) {
  return kRounding * std::max({1.0, std::abs(range[0]), std::abs(range[1])});
}

/// a - b at the x that both have: between the points of the coarser curve an interpolation would be compared.
Series difference(const Series& a, const Series& b) {
  Series result;
  for (std::size_t k = 0; k < a.x.size(); ++k) {
    const double tolerance = toleranceOf({a.x[k], a.x[k]});
    const auto same =
        std::find_if(b.x.begin(), b.x.end(), [&](double x) { return std::abs(x - a.x[k]) <= tolerance; });
    if (same == b.x.end()) continue;
    result.x.push_back(a.x[k]);
    result.y.push_back(a.y[k] - b.y[static_cast<std::size_t>(same - b.x.begin())]);
  }
  return result;
}

}  // namespace

Series seriesOf(const HistoryTable& history, const std::string& x, const std::string& y,
                const std::string& where) {
  const auto xs = evaluate(history, x), ys = evaluate(history, y), shown = evaluate(history, where);
  Series series;
  for (std::size_t k = 0; k < xs.size(); ++k) {
    if (!std::isfinite(shown[k]) || shown[k] == 0.0 || !std::isfinite(xs[k]) || !std::isfinite(ys[k]))
      continue;
    series.x.push_back(xs[k]);
    series.y.push_back(ys[k]);
  }
  return series;
}

Series restricted(const Series& series, const std::array<double, 2>& range) {
  const double tolerance = toleranceOf(range);
  Series result;
  for (std::size_t k = 0; k < series.x.size(); ++k) {
    if (series.x[k] < range[0] - tolerance || series.x[k] > range[1] + tolerance) continue;
    result.x.push_back(series.x[k]);
    result.y.push_back(series.y[k]);
  }
  return result;
}

bool reachesEnd(const Series& series, const std::array<double, 2>& range) {
  return std::any_of(series.x.begin(), series.x.end(),
                     [&](double x) { return x >= range[1] - toleranceOf(range); });
}

std::optional<double> interpolate(const Series& series, double x) {
  const double tolerance = toleranceOf({x, x});
  for (std::size_t k = 0; k < series.x.size(); ++k) {
    if (std::abs(series.x[k] - x) <= tolerance) return series.y[k];
    if (k == 0 || (series.x[k - 1] - x) * (series.x[k] - x) > 0.0) continue;
    const double part = (x - series.x[k - 1]) / (series.x[k] - series.x[k - 1]);
    return std::lerp(series.y[k - 1], series.y[k], part);
  }
  return {};
}

std::optional<double> meanOver(const Series& series) {
  if (series.x.empty()) return {};
  if (series.x.size() == 1) return series.y.front();
  double integral = 0.0;
  for (std::size_t k = 1; k < series.x.size(); ++k)
    integral += 0.5 * (series.x[k] - series.x[k - 1]) * (series.y[k] + series.y[k - 1]);
  const double length = series.x.back() - series.x.front();
  if (length == 0.0) return {};
  return integral / length;
}

std::optional<double> oscillation(const Series& series) {
  constexpr Eigen::Index kCoefficients = 5;
  const auto n = static_cast<Eigen::Index>(series.x.size());
  if (n <= kCoefficients) return {};
  const Eigen::Map<const Eigen::VectorXd> x(series.x.data(), n), y(series.y.data(), n);
  const double middle = 0.5 * (x.maxCoeff() + x.minCoeff()), half = 0.5 * (x.maxCoeff() - x.minCoeff());
  if (half == 0.0) return {};
  const Eigen::ArrayXd s = (x.array() - middle) / half;  // in [-1, 1], for the condition of the powers
  Eigen::MatrixXd powers = Eigen::MatrixXd::Ones(n, kCoefficients);
  for (Eigen::Index k = 1; k < kCoefficients; ++k) powers.col(k) = powers.col(k - 1).array() * s;
  const Eigen::VectorXd quartic = powers.colPivHouseholderQr().solve(y);
  return (y - powers * quartic).norm() / std::sqrt(static_cast<double>(n));
}

std::optional<double> reduced(const Series& series, Reduction reduction) {
  switch (reduction) {
    case Reduction::First:
      return series.y.front();
    case Reduction::Last:
      return series.y.back();
    case Reduction::Max:
      return *std::max_element(series.y.begin(), series.y.end());
    case Reduction::Min:
      return *std::min_element(series.y.begin(), series.y.end());
    case Reduction::Mean:
      return meanOver(series);
    case Reduction::Oscillation:
      return oscillation(series);
    case Reduction::At:
      break;
  }
  return {};
}

std::optional<double> largestDifference(const Series& a, const Series& b) {
  const Series d = difference(a, b);
  if (d.y.empty()) return {};
  double largest = 0.0;
  for (const double y : d.y) largest = std::max(largest, std::abs(y));
  return largest;
}

std::optional<double> firstDeparture(const Series& a, const Series& b, double tolerance) {
  const Series d = difference(a, b);
  for (std::size_t k = 0; k < d.x.size(); ++k) {
    if (std::abs(d.y[k]) <= tolerance) continue;
    if (k == 0) return d.x[0];
    const double crossed = std::copysign(tolerance, d.y[k]);
    return std::lerp(d.x[k - 1], d.x[k], (crossed - d.y[k - 1]) / (d.y[k] - d.y[k - 1]));
  }
  return {};
}

double variation(const Eigen::VectorXd& y) {
  if (y.size() < 2) return 0.0;
  return (y.tail(y.size() - 1) - y.head(y.size() - 1)).cwiseAbs().sum();
}

std::optional<double> convergenceOrder(const std::vector<double>& residuals) {
  constexpr double kRoundOff = 1e-12;
  std::vector<double> r = residuals;
  while (!r.empty() && !(r.back() > kRoundOff)) r.pop_back();
  if (r.size() < 3) return {};
  const double before = std::log(r[r.size() - 2] / r[r.size() - 3]),
               last = std::log(r.back() / r[r.size() - 2]);
  if (!(before < 0.0) || !(last < 0.0)) return {};
  return last / before;
}

std::optional<double> median(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t upper = values.size() / 2, lower = (values.size() - 1) / 2;
  return 0.5 * (values[lower] + values[upper]);
}

}  // namespace burnish
