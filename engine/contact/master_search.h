#pragma once
#include <Eigen/Dense>
#include <functional>
#include <optional>
#include <vector>

#include "engine/contact/box_tree.h"
#include "engine/contact/master_surface.h"

namespace burnish::inline contact {

/// Finds the spans of a surface, in the place where it was when this was made, that are near to something, by
/// their boxes.
template <int Dim>
class MasterSearch {
 public:
  using Point = Eigen::Vector<double, Dim>;

  struct Span {
    int face = 0, span = 0;
  };

  MasterSearch() = default;

  /// withNormals: for `MayHold`.
  explicit MasterSearch(const MasterSurface<Dim>& surface, bool withNormals = false);

  /// Whether a span, with the surface's normals at a few places in it and at all sides of its corners, may have
  /// a foot that suits.
  using MayHold = std::function<bool(const Span&, const Eigen::Matrix<double, Dim, Eigen::Dynamic>& normals)>;

  /// The nearest of the feet that are at most `reach` away from a position and suit. One foot per span is
  /// tried, from the nearest box on until the next box is farther away than the best foot. surface: in the
  /// place in which it was before. mayHold: to leave out spans that are not worth trying.
  std::optional<Foot<Dim>> nearest(const MasterSurface<Dim>& surface, const Point& position, double reach,
                                   const std::function<bool(const Foot<Dim>&)>& suits,
                                   const MayHold& mayHold = {}) const;

 private:
  struct Candidate {
    Span span;
    Point low, high;                                     ///< of its box, infinite where it has none
    Eigen::Matrix<double, Dim, Eigen::Dynamic> samples;  ///< degree + 1 points per direction
    Eigen::Matrix<double, Dim, Eigen::Dynamic>
        normals;  ///< there, then around its corners; empty unless wanted
  };

  std::vector<Candidate> candidates_;  ///< ascending
  BoxTree tree_;                       ///< of those with boxes
  std::vector<int> inTree_;            ///< their numbers
  std::vector<int> others_;
};

}  // namespace burnish::inline contact
