#pragma once
#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "engine/analysis/geometry.h"
#include "engine/analysis/model.h"
#include "engine/contact/gap_ramp.h"
#include "engine/rezoning/state_transfer.h"
#include "engine/scene/scene.h"

namespace burnish {

/// The model of a scene. Throws `Error` if it cannot be computed, every line with its place in the scene's
/// file: patches that do not fit, folded geometry, supports that contradict each other or leave the body free
/// to move away, a tool that overlaps the body at the start, a formula without a finite value at a time
/// point.
template <int Dim>
std::unique_ptr<Model<Dim>> buildModel(const Scene& scene);

/// A plane or axisymmetric body that was remeshed under way, in the configuration that it had at a time: its
/// new reference. With it the other bodies of its scene, which keep their references.
struct RezonedBody {
  NamedBody<2> named;
  PointStates states;  ///< at the quadrature points that the scene asks for
  double plasticWork = 0.0;
  double time = 0.0;
  Eigen::MatrixXd others;     ///< displacements of the other bodies' nodes at that time, 2 x nodes
  std::vector<GapRamp> fits;  ///< of the pairs of faces
};

/// The model with the same tools, supports and contact pairs for a body that was remeshed, in the state that
/// it begins with; what the scene's own bodies were checked for is not checked again. The terms of the other
/// bodies are without history. Throws `Error` if the map of the body is folded.
std::unique_ptr<Model<2>> rebuildModel(const Scene& scene, const RezonedBody& rezoned);

}  // namespace burnish
