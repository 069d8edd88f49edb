#include "postproc/mesh/subdivision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "engine/core/error.h"
#include "postproc/mesh/patch_geometry.h"

namespace burnish {

void SpanCells::refine(const SpanCells& other) {
  count = std::max(count, other.count);
  std::vector<double> all;
  std::ranges::set_union(cuts, other.cuts, std::back_inserter(all));
  cuts = std::move(all);
}

SpanCells SpanCells::reversed() const {
  SpanCells cells{count, cuts};
  std::ranges::reverse(cells.cuts);
  for (double& cut : cells.cuts) cut = 1.0 - cut;
  return cells;
}

Subdivision::Subdivision(int perSpan) : perSpan_(perSpan) {
  if (perSpan < 1)
    throw Error(fmt::format("subdivision: found {}; expected at least 1 cell per knot span", perSpan));
}

void Subdivision::refine(const Subdivision& other) {
  perSpan_ = std::max(perSpan_, other.perSpan_);
  for (std::size_t patch = 0; patch < counts_.size(); ++patch)
    for (std::size_t d = 0; d < counts_[patch].size(); ++d)
      for (std::size_t span = 0; span < counts_[patch][d].size(); ++span)
        counts_[patch][d][span].refine(other.counts_[patch][d][span]);
}

std::vector<double> Subdivision::parameters(std::size_t patch, std::size_t direction,
                                            const UnivariateBasis& basis) const {
  if (counts_.empty()) return subdividedSpans(basis, perSpan_);
  std::vector<double> parameters;
  for (int span = 0; span < basis.numSpans(); ++span) {
    const SpanCells& cells = counts_[patch][direction][static_cast<std::size_t>(span)];
    std::vector<double> equal, places;
    for (int k = 0; k < cells.count; ++k)
      equal.push_back(static_cast<double>(k) / static_cast<double>(cells.count));
    std::ranges::set_union(equal, cells.cuts, std::back_inserter(places));
    for (const double place : places)
      parameters.push_back(std::lerp(basis.spanBegin(span), basis.spanEnd(span), place));
  }
  parameters.push_back(basis.breakpoints().back());
  return parameters;
}

}  // namespace burnish
