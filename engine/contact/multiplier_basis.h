#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/solid/body.h"

namespace burnish::inline contact {

/// Functions M_A of a field of multipliers on a contact face: those R_a of the face's trace, but for control
/// points that a support holds in the direction of the constraint. There one multiplier is too many, and
/// neighbours alternate: the multiplier of a held control point is that of the neighbour, M_A = R_A + R_held.
/// One without a neighbour that is free has none.
class MultiplierBasis {
 public:
  MultiplierBasis() = default;

  /// No control point is held.
  explicit MultiplierBasis(int numFunctions);

  /// held: whether a support holds a function's control point; basis: of the trace.
  template <int P>
  MultiplierBasis(const TensorBasis<P>& basis, const std::vector<bool>& held);

  int size() const { return size_; }

  /// Multiplier of a function of the trace, -1 if it has none.
  int multiplierOf(int function) const { return multiplierOf_[static_cast<std::size_t>(function)]; }

  /// Coefficients of the field by the functions of the trace that are listed, from those of the multipliers.
  Eigen::VectorXd coefficients(const std::vector<int>& functions,
                               const Eigen::Ref<const Eigen::VectorXd>& multipliers) const;

 private:
  std::vector<int> multiplierOf_;  ///< per function
  int size_ = 0;
};

/// Control points of a face that supports hold.
struct HeldControlPoints {
  std::vector<bool> across;  ///< the free part of the reference normal is shorter than a half
  std::vector<bool> along;   ///< so are the parts along the face of all free directions
};

/// held: of the displacement components.
template <int Dim>
HeldControlPoints heldControlPoints(const Body<Dim>& body, int patch, FaceId face,
                                    const std::vector<bool>& held);

}  // namespace burnish::inline contact
