#pragma once
#include <Eigen/Core>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/portion.h"
#include "engine/core/state_archive.h"
#include "engine/material/material.h"

namespace burnish::inline material {

/// A law with the states of its points: the accepted ones and those of the last evaluation.
template <class Law>
struct PointsOf {
  Law law;
  std::vector<typename Law::State> accepted, trial;

  /// From the accepted state to the one that is evaluated, for laws that ask for it: the length of the last
  /// step where no time has passed, infinite before the first step.
  double timeStep = std::numeric_limits<double>::infinity();

  /// The law at a point, from its accepted state to its trial state; false if it cannot answer.
  template <int Dim>
  [[nodiscard]] bool evaluate(std::size_t point, const Eigen::Matrix3d& F, MaterialResponse<Dim>& out) {
    if constexpr (RateDependent<Law>)
      return law.template evaluate<Dim>(F, timeStep, accepted[point], trial[point], out);
    else
      return law.template evaluate<Dim>(F, accepted[point], trial[point], out);
  }
};

/// What the points of a body have been through, as far as a new reference configuration has to know it.
struct PointStates {
  std::vector<Eigen::Matrix3d> b_e;  ///< elastic left Cauchy-Green tensors, points
  std::vector<CarriedKind> kinds;    ///< of the numbers that go along
  Eigen::MatrixXd numbers;           ///< kinds x points
};

/// The material points of a body, whatever the law. Knows nothing of what a state holds.
class MaterialPoints {
 public:
  MaterialPoints(Material material, std::size_t count);

  /// Calls f with the `PointsOf` the law: to be done once, outside of loops over points.
  template <class F>
  decltype(auto) visit(F&& f) {
    return std::visit(std::forward<F>(f), points_);
  }
  template <class F>
  decltype(auto) visit(F&& f) const {
    return std::visit(std::forward<F>(f), points_);
  }

  Material material() const;

  /// From now on keeps the states of some of the points alone; what follows has those, but for the archive.
  void divide(Portion portion);
  const Portion& portion() const { return portion_; }

  /// To be called before an evaluation at the time t.
  void startEvaluation(double t);

  bool hasSymmetricTangent() const;

  /// Makes the states of the last evaluation the accepted ones.
  void accept();

  /// The accepted states of all points, and the time where the law asks for it. To be called by all ranks that
  /// the points are divided among; the first one saves the states.
  void archive(StateArchive& archive);

  /// Fields that the law makes of a state.
  std::vector<FieldKind> fields() const;
  bool hasField(const std::string& name) const;

  /// A field of the accepted states, components x points. Throws `Error` if the law has none of this name.
  Eigen::MatrixXd field(const std::string& name) const;

  /// What goes along to a new reference configuration. F: deformation gradients that the law sees, points.
  PointStates carried(const std::vector<Eigen::Matrix3d>& F) const;

  /// Begins in a new reference configuration. stretch: elastic ones there, V_e; numbers: kinds x points.
  void begin(const std::vector<Eigen::Matrix3d>& stretch, const Eigen::MatrixXd& numbers);

 private:
  MaterialLaws::Each<PointsOf> points_;
  Portion portion_;
  double time_ = std::numeric_limits<double>::quiet_NaN();  ///< of the accepted states; none before the first
  double trialTime_ = time_;
  double lastStep_ = std::numeric_limits<double>::infinity();
};

}  // namespace burnish::inline material
