#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "engine/analysis/model.h"
#include "engine/core/state_archive.h"
#include "engine/fields/measure.h"
#include "engine/results/run_account.h"

namespace burnish::inline analysis {

/// Follows what the supports of a scene carry: force of the body on each, and its moment about the origin.
///
/// A component of a control point that several supports hold belongs to the first of them, so that the sum
/// over the supports is the whole reaction of the body.
template <int Dim>
class Reactions {
 public:
  /// The model must outlive the object.
  Reactions(const Scene& scene, const Model<Dim>& model);

  /// NAME.fx, NAME.fy, (NAME.fz), NAME.mz (3D: NAME.mx, NAME.my, NAME.mz; none in axisymmetry)
  std::vector<std::string> columns() const;

  /// Of the current state, one per column.
  std::vector<double> values() const;

  /// force: sum of all terms' forces at the state, which the supports balance.
  void update(const MeasuredState& state, const Eigen::VectorXd& force);

  /// Goes on with the largest forces of the same supports of another mesh.
  void continueFrom(const Reactions& before) { records_ = before.records_; }

  /// One per support.
  const std::vector<ReactionRecord>& records() const { return records_; }

  void archive(StateArchive& archive);

 private:
  /// Calls f with everything that changes from state to state.
  template <class F>
  void forEachNumber(const F& f);

  const Model<Dim>& model_;
  Eigen::MatrixXd nodes_;  ///< reference positions, Dim x nodes
  std::vector<ReactionRecord> records_;
};

}  // namespace burnish::inline analysis
