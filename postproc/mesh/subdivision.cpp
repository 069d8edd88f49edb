#include "postproc/mesh/subdivision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "postproc/mesh/patch_geometry.h"

namespace burnish {

Subdivision::Subdivision(int perSpan) : perSpan_(perSpan) {
  if (perSpan < 1)
    throw Error(fmt::format("subdivision: found {}; expected at least 1 cell per knot span", perSpan));
}

void Subdivision::refine(const Subdivision& other) {
  perSpan_ = std::max(perSpan_, other.perSpan_);
  for (std::size_t patch = 0; patch < counts_.size(); ++patch)
    for (std::size_t d = 0; d < counts_[patch].size(); ++d)
      for (std::size_t span = 0; span < counts_[patch][d].size(); ++span)
        counts_[patch][d][span] = std::max(counts_[patch][d][span], other.counts_[patch][d][span]);
}

std::vector<double> Subdivision::parameters(std::size_t patch, std::size_t direction,
                                            const UnivariateBasis& basis) const {
  if (counts_.empty()) return subdividedSpans(basis, perSpan_);
  const std::vector<int>& counts = counts_[patch][direction];
  std::vector<double> parameters;
  for (int span = 0; span < basis.numSpans(); ++span) {
    const int count = counts[static_cast<std::size_t>(span)];
    for (int k = 0; k < count; ++k)
      parameters.push_back(std::lerp(basis.spanBegin(span), basis.spanEnd(span),
                                     static_cast<double>(k) / static_cast<double>(count)));
  }
  parameters.push_back(basis.breakpoints().back());
  return parameters;
}

}  // namespace burnish
