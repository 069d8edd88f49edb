#pragma once
#include <Eigen/Dense>

#include "engine/core/state_archive.h"

namespace burnish::inline contact {

/// Tangential tractions that penalties of friction remember from the accepted state, of functions or points of
/// a face, by their components in the frames of the step that comes.
///
/// A partner chooses its frames anew in every accepted state. The tractions turn with the face: between two
/// accepted states their components along the face's first parameter, and across it, stay the same. In the
/// plane there is one frame.
template <int Dim>
class RememberedTractions {
 public:
  using Tangential = Eigen::Vector<double, Dim - 1>;
  using Components = Eigen::Matrix<double, Dim - 1, Eigen::Dynamic>;  ///< one column each

  /// None so far. number: of functions or points.
  explicit RememberedTractions(Eigen::Index number) : tractions_(Components::Zero(Dim - 1, number)) {
    along_ = tractions_;
    along_.row(0).setOnes();
  }

  Tangential at(Eigen::Index number) const { return tractions_.col(number); }

  /// tractions: in the frames of the step that has been accepted. along: directions of the face's first
  /// parameter in the frames of the next one, of any length; only looked at in space.
  void accept(const Components& tractions, const Components& along);

  void archive(StateArchive& archive);

 private:
  Components tractions_;
  Components along_;  ///< unit vectors: of the first parameter
};

}  // namespace burnish::inline contact
