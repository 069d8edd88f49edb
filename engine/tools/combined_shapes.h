#pragma once
#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "engine/tools/gap_query.h"

namespace burnish {

struct AnyShape;

/// A die: the tool fills the space around a solid, the body is in the hollow.
struct Die {
  std::shared_ptr<const AnyShape> solid;
  GapQuery query(const Eigen::Vector3d& x) const;
};

/// Several shapes as one: the smallest gap wins. With a blend the minimum is a C² function that is lower
/// where two gaps differ by less than `blend`, by blend/6 at most for two parts: a fillet along the seam.
struct Union {
  std::vector<std::shared_ptr<const AnyShape>> parts;
  double blend = 0.0;
  GapQuery query(const Eigen::Vector3d& x) const;
};

}  // namespace burnish
