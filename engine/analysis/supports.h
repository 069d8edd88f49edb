#pragma once
#include <Eigen/Dense>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/face_finder.h"
#include "engine/scene/scene.h"

namespace burnish::inline analysis {

/// Displacement components that the supports of a scene prescribe.
///
/// On a part of a face those control points are held whose Greville abscissae (or nodes) lie in it. A formula
/// is interpolated there by the trace of the basis at the same places.
template <int Dim>
class Supports {
 public:
  /// Throws `InputError` for a symmetric support on a face that is not flat, for a part without control
  /// points, and where two supports prescribe one component differently.
  Supports(const Scene& scene, const FaceFinder<Dim>& faces);

  /// One flag per displacement component: whether a support holds it, if only for a time.
  const std::vector<bool>& prescribed() const { return prescribed_; }

  /// Whether a support holds a displacement component behind time t.
  bool holdsBehind(double t, int unknown) const {
    return heldUntil_[static_cast<std::size_t>(unknown)] > t * (1.0 + 1e-9);
  }

  /// Writes the values at time t into the entries that are held up to then.
  void setValues(double t, Eigen::VectorXd& x) const;

  /// Unknowns that a support prescribes, by its place in the scene, without those of one that holds them as
  /// long or longer and comes before it.
  const std::vector<int>& owned(std::size_t support) const { return owned_[support]; }

  /// Times at which a schedule has a corner.
  const std::vector<double>& corners() const { return corners_; }

  /// Throws `InputError` at every support whose formulas have no finite value at one of these times up to which it
  /// holds.
  void requireFinite(const std::vector<double>& times) const;

 private:
  /// How the trace of the basis interpolates on a part of a face.
  struct Interpolation {
    Eigen::Matrix3Xd places;  ///< reference positions of the whole face's anchors
    Eigen::MatrixXd matrix;   ///< coefficients of the part's control points from values at the places
  };

  /// Values of one component on the control points of one face over time.
  struct Motion {
    std::string place;   ///< of the support in the scene
    double until = 0.0;  ///< infinite for one that never lets go
    std::vector<int> unknowns;
    Schedule schedule;               ///< the same for all; or, if there is one,
    std::optional<Formula> formula;  ///< interpolated
    std::shared_ptr<const Interpolation> interpolation;

    Eigen::VectorXd values(double t) const;
  };

  void add(const SupportSpec& spec, const std::string& place, const Scene& scene,
           const FaceFinder<Dim>& faces);
  static Interpolation interpolationOn(const Patch<Dim - 1, Dim>& trace,
                                       const std::vector<std::size_t>& chosen);
  void append(Motion motion, const std::string& face, int component);

  std::vector<bool> prescribed_;
  std::vector<double> heldUntil_;  ///< per displacement component; below any time where it is free
  std::vector<Motion> motions_;
  std::vector<std::vector<int>> owned_;  ///< per support
  std::vector<double> corners_;
  std::vector<double> times_;  ///< at which two supports of one component are compared
};

}  // namespace burnish::inline analysis
