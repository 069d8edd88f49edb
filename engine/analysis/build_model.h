#pragma once
#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "engine/analysis/geometry.h"
#include "engine/analysis/model.h"
#include "engine/contact/gap_ramp.h"
#include "engine/rezoning/state_transfer.h"
#include "engine/scene/scene.h"

namespace burnish::inline analysis {

/// The model of a scene. Throws `Error` if it cannot be computed, every line with its place in the scene's
/// file: patches that do not fit, folded geometry, supports that contradict each other or leave the body free
/// to move away, a tool that overlaps the body at the start, a formula without a finite value at a time
/// point.
template <int Dim>
std::unique_ptr<Model<Dim>> buildModel(const Scene& scene);

/// A body of one patch that was remeshed under way, with the place that it had at a time. With it the other bodies of
/// its scene, which keep their references.
template <int Dim>
struct RezonedBody {
  NamedBody<Dim> named;

  /// Of its nodes at that time, Dim x nodes. Empty: its place at that time is the new reference.
  Eigen::MatrixXd displacement;
  PointStates states;  ///< at the quadrature points that the scene asks for
  double plasticWork = 0.0;
  double time = 0.0;
  Eigen::MatrixXd others;     ///< displacements of the other bodies' nodes at that time, Dim x nodes
  std::vector<GapRamp> fits;  ///< of the pairs of faces
};

/// The model with the same tools, supports and contact pairs for a body that was remeshed, in the state that
/// it begins with; what the scene's own bodies were checked for is not checked again. The terms of the other
/// bodies are without history. Throws `Error` if the map of the body is folded.
template <int Dim>
std::unique_ptr<Model<Dim>> rebuildModel(const Scene& scene, const RezonedBody<Dim>& rezoned);

}  // namespace burnish::inline analysis
