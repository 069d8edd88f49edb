#include "postproc/draw/foreign/foreign_ranges.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "postproc/draw/foreign/linear_parts.h"

namespace burnish {

ForeignRanges::ForeignRanges(const std::vector<ForeignBlock>& blocks) : blocks_(blocks), values_(blocks) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  for (ForeignBlock& block : values_)
    if (hasBezier(*block.grid))
      block.grid = linearParts(*block.grid, Eigen::VectorXd::Zero(block.grid->GetNumberOfPoints()),
                               {-kInfinite, kInfinite});
}

ForeignRange ForeignRanges::of(const ForeignChoice& choice) const {
  ForeignRange range;
  for (const ForeignBlock& block : blocks_) {
    const Eigen::VectorXd values = choice.valuesOf(block);
    range.all += values.size();
    range.gaps += values.size() - values.array().isFinite().count();
  }
  for (const ForeignBlock& block : choice.field.ofCells ? blocks_ : values_)
    for (const double value : choice.valuesOf(block)) {
      if (!std::isfinite(value)) continue;
      if (!range.values) range.values = {value, value};
      range.values = {std::min((*range.values)[0], value), std::max((*range.values)[1], value)};
    }
  return range;
}

}  // namespace burnish
