#pragma once
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/nurbs/univariate_basis.h"

namespace burnish {

/// Of a knot span in one direction.
struct SpanCells {
  int count = 1;               ///< of equal ones
  std::vector<double> cuts{};  ///< of these cells, parts of the span, ascending

  /// Takes the larger count and all cuts of both.
  void refine(const SpanCells& other);
  /// The same from the other end of the span.
  SpanCells reversed() const;
  bool operator==(const SpanCells&) const = default;
};

/// Into how many equal cells the knot spans of a mesh are cut: a number for all of them, or one for every
/// patch, direction and span, which may be cut further.
class Subdivision {
 public:
  using Counts = std::vector<std::vector<std::vector<SpanCells>>>;  ///< by patch, direction and span

  /// Throws `Error` for less than 1.
  Subdivision(int perSpan);  // a number is one, so that calls read as they are meant
  /// counts: at least 1 each, of all patches of the mesh.
  explicit Subdivision(Counts counts) : counts_(std::move(counts)) {}

  /// Takes the larger counts of both, of which each is a number or neither is.
  void refine(const Subdivision& other);

  /// Where the points lie in a direction of a patch, which has this basis; both ends of the domain included.
  std::vector<double> parameters(std::size_t patch, std::size_t direction,
                                 const UnivariateBasis& basis) const;

 private:
  int perSpan_ = 1;
  Counts counts_;  ///< empty: `perSpan_` everywhere
};

}  // namespace burnish
