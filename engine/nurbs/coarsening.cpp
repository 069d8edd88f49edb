#include "engine/nurbs/coarsening.h"

#include <algorithm>
#include <iterator>

#include "engine/nurbs/refinement.h"

namespace burnish::inline nurbs {
namespace {

/// Equal spans whose lengths differ by rounding count as equal.
constexpr double kRounding = 1.0 + 1e-4;

/// Spans shorter than this, over the shortest one, do not stay.
constexpr double kTooShort = 1.5;

/// Entries of T below this are rounding: those of a function are at most one.
constexpr double kNothing = 1e-12;

/// Values of the coarse functions at the nodes of the fine elements.
Eigen::MatrixXd interpolation(const UnivariateBasis& coarse, const UnivariateBasis& fine) {
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(fine.numFunctions(), coarse.numFunctions());
  for (int i = 0; i < fine.numFunctions(); ++i) {
    const int span = coarse.findSpan(fine.anchor(i));
    T.block(i, coarse.firstFunction(span), 1, coarse.degree() + 1) =
        coarse.evaluate(span, fine.anchor(i), 0).transpose();
  }
  return T;
}

}  // namespace

std::vector<int> mergedBreakpoints(const std::vector<double>& lengths, double shortest,
                                   const MergeRule& rule) {
  const double longest = rule.longest * shortest * kRounding;
  std::vector<double> sums;
  std::vector<int> kept{0};
  for (std::size_t e = 0; e < lengths.size();) {
    double sum = lengths[e];
    std::size_t end = e + 1;
    while (end < lengths.size() && static_cast<int>(end - e) < rule.most && sum + lengths[end] <= longest)
      sum += lengths[end++];
    sums.push_back(sum);
    kept.push_back(static_cast<int>(end));
    e = end;
  }
  for (std::size_t k = 0; k < sums.size() && sums.size() > 1;) {
    if (sums[k] > kTooShort * shortest) {
      ++k;
      continue;
    }
    const bool joinsNext = k == 0 || (k + 1 < sums.size() && sums[k + 1] <= sums[k - 1]);
    const std::size_t first = joinsNext ? k : k - 1;
    sums[first] += sums[first + 1];
    const auto at = static_cast<std::ptrdiff_t>(first + 1);
    sums.erase(sums.begin() + at);
    kept.erase(kept.begin() + at);
    k = first;
  }
  return kept;
}

UnivariateBasis coarsened(const UnivariateBasis& fine, const std::vector<int>& kept) {
  std::vector<double> breakpoints;
  for (const int k : kept) breakpoints.push_back(fine.breakpoints()[static_cast<std::size_t>(k)]);
  if (fine.family() == BasisFamily::Lagrange) return UnivariateBasis::lagrange(fine.degree(), breakpoints);
  std::vector<double> knots;
  std::copy_if(fine.knots().begin(), fine.knots().end(), std::back_inserter(knots),
               [&](double knot) { return std::binary_search(breakpoints.begin(), breakpoints.end(), knot); });
  return UnivariateBasis::bspline(KnotVector(fine.degree(), std::move(knots)));
}

Eigen::SparseMatrix<double, Eigen::RowMajor> transferMatrix(const UnivariateBasis& coarse,
                                                            const UnivariateBasis& fine) {
  const Eigen::MatrixXd T = fine.family() == BasisFamily::Lagrange
                                ? interpolation(coarse, fine)
                                : refinementMatrix(KnotVector(coarse.degree(), coarse.knots()),
                                                   KnotVector(fine.degree(), fine.knots()));
  return T.sparseView(1.0, kNothing);
}

}  // namespace burnish::inline nurbs
