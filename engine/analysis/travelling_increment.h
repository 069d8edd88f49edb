#pragma once
#include <Eigen/Dense>

#include "engine/analysis/model.h"

namespace burnish::inline analysis {

/// What a tool that travels over a face does to a body in one step it does to what lies a way further on in the next
/// one: the increment of the unknowns, moved along with the tool, is a better start than the increment itself, of
/// which a body that does not flow knows no more once the tool has passed.
///
/// It is moved in directions of the parameters along which a coordinate of the undeformed body depends on that
/// parameter alone (boxes, whatever their grading, and bars with any section along their axis), of a body that is all of
/// the model, of one patch without weights, and touched by one tool only. Elsewhere it stays as it is, and in the plane,
/// where steps are short against spans, and what a tool does to one of them is not what it does to the next.
template <int Dim>
class TravellingIncrement {
 public:
  /// The model must outlive the object.
  explicit TravellingIncrement(const Model<Dim>& model);

  /// Moves the increment of a step that began at `before` to where the tool is in the next one, which ends at `to`.
  void move(double before, double to, Eigen::VectorXd& increment) const;

 private:
  /// A direction of the parameters, the coordinate that follows it, and its values at the functions.
  struct Along {
    int direction;
    int axis;
    Eigen::VectorXd coordinates;
  };

  /// Coefficients of functions along a direction of those that have, at each anchor, the values which the given ones
  /// have a way behind; beyond the begin of the body, those at its begin.
  Eigen::MatrixXd movedBy(const Along& along, double way) const;

  const Model<Dim>& model_;
  std::vector<Along> along_;  ///< of the face that is touched; empty: increments stay as they are
};

}  // namespace burnish::inline analysis
