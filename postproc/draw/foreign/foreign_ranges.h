#pragma once
#include <Eigen/Dense>
#include <array>
#include <optional>
#include <vector>

#include "postproc/draw/foreign/foreign_fields.h"
#include "postproc/foreign/foreign_source.h"

namespace burnish {

/// Values of a field in a file.
struct ForeignRange {
  std::optional<std::array<double, 2>> values{};  ///< smallest and largest finite one; nothing without any
  Eigen::Index gaps = 0, all = 0;                 ///< points or cells without a finite value, and all
};

/// Knows of blocks what their fields are between points, where these have coefficients.
class ForeignRanges {
 public:
  /// blocks: which must outlive the object.
  explicit ForeignRanges(const std::vector<ForeignBlock>& blocks);

  /// Of Bézier cells by samples, eight along an edge.
  ForeignRange of(const ForeignChoice& choice) const;

 private:
  const std::vector<ForeignBlock>& blocks_;
  std::vector<ForeignBlock> values_;  ///< at points
};

}  // namespace burnish
