#pragma once
#include <Eigen/Dense>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/analysis/geometry.h"
#include "engine/analysis/supports.h"
#include "engine/contact/face_contact.h"
#include "engine/contact/gap_ramp.h"
#include "engine/contact/tool_contact.h"
#include "engine/scene/scene.h"
#include "engine/solid/body.h"
#include "engine/solid/bulk_term.h"
#include "engine/solid/face_place.h"
#include "engine/solid/load_term.h"
#include "engine/solid/released_forces.h"
#include "engine/solid/span_quadrature.h"
#include "engine/solid/stabilisation.h"
#include "engine/solver/stepping.h"
#include "engine/tools/tool.h"
#include "engine/tools/tool_load.h"

namespace burnish::inline analysis {

/// Smallest force that counts over E L (E L² in 3D and axisymmetry).
inline constexpr double kForceFloor = 1e-9;

/// A body of the scene: its patches, whose nodes are numbered over all bodies, and what resists there.
template <int Dim>
struct ModelBody {
  std::string name;    ///< empty for the one body of a scene without `bodies`
  int firstPatch = 0;  ///< its number among the patches of all bodies
  Body<Dim> body;
  std::unique_ptr<SpanQuadrature<Dim>> quadrature;
  std::unique_ptr<BulkTerm<Dim>> bulk;
};

/// A contact pair of the scene: the number of its tool, the face that may touch it, and its term.
template <int Dim>
struct ContactPair {
  std::size_t tool = 0;
  FacePlace place;
  std::unique_ptr<FaceContact<Dim>> term;
};

/// Two faces of the scene that may touch.
template <int Dim>
struct FacePair {
  std::string name;
  FacePlace place;  ///< of the face with the multipliers
  std::vector<FacePlace> against;
  std::unique_ptr<FaceContact<Dim>> term;
  GapRamp fit;  ///< how an interference is resolved
};

/// A tool of the scene with free degrees of freedom: the forces that it carries in them.
struct CarriedLoad {
  std::size_t tool = 0;
  std::unique_ptr<ToolLoad> term;
};

/// A tool that is taken away.
struct LeavingTool {
  std::size_t tool = 0;
  double until = 0.0;
  std::unique_ptr<ReleasedForces> held;  ///< what it pressed and rubbed its faces with, going to zero
  bool hasLeft = false;
};

/// A face that may touch itself and, if it is one of several, the others.
template <int Dim>
struct SelfContact {
  FacePlace place;
  double reach = 0.0;  ///< distance within which parts are partners
  std::unique_ptr<FaceContact<Dim>> term;
};

template <int Dim>
class ModelBuilder;

/// Everything that a scene describes, as terms and constraints over one numbering of unknowns: Dim
/// displacement components per node, the free degrees of freedom of tools, then the contact multipliers.
/// `buildModel` makes it.
template <int Dim>
class Model {
 public:
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  /// The patches of all bodies, body after body.
  const Body<Dim>& body() const { return body_; }
  const std::vector<ModelBody<Dim>>& bodies() const { return bodies_; }

  /// The body that a patch belongs to.
  const ModelBody<Dim>& bodyOf(int patch) const;
  const ModelBody<Dim>& bodyOf(const FacePlace& place) const { return bodyOf(place.patch); }

  /// Whether one of the faces of a pair is the body's.
  bool touches(const FacePair<Dim>& pair, const ModelBody<Dim>& body) const;

  const std::vector<std::unique_ptr<Tool>>& tools() const { return tools_; }
  const std::vector<ContactPair<Dim>>& contacts() const { return contacts_; }
  const std::vector<FacePair<Dim>>& pairs() const { return pairs_; }
  const std::vector<SelfContact<Dim>>& selfContacts() const { return selfContacts_; }
  const std::vector<std::unique_ptr<LoadTerm>>& loads() const { return loads_; }
  const std::vector<CarriedLoad>& toolLoads() const { return toolLoads_; }
  const FaceFinder<Dim>& faces() const { return faces_; }
  const Supports<Dim>& supports() const { return supports_; }

  /// Number of the tool with this name, which there is.
  std::size_t toolNumber(const std::string& name) const;

  /// Null unless the scene asks for it.
  const Stabilisation<Dim>* stabilisation() const { return stabilisation_.get(); }

  /// Bodies, contacts with tools, of pairs of faces, of faces with themselves, loads, loads of tools that are there,
  /// forces of tools that are taken away, of supports that let go, stabilisation, in this order.
  std::vector<Term*> terms() const;

  int numDisplacements() const { return Dim * body_.numNodes; }

  /// Unknowns whose residuals are forces: displacements and degrees of freedom of tools.
  int numForces() const { return numForces_; }
  int numUnknowns() const { return numUnknowns_; }

  /// Smallest force that counts, see `kForceFloor`: of a body, and of the one for which it is smallest.
  double forceFloorOf(const ModelBody<Dim>& body) const;
  double forceFloor() const;

  /// Forces of the bodies' stresses, the sum of what their terms add. forces: of the terms, in their order.
  Eigen::VectorXd bulkForces(const std::vector<Eigen::VectorXd>& forces) const;

  /// Share of the largest force that the stabilisation carries in the state that the terms have been
  /// evaluated at. forces: of the terms, in their order.
  double stabilisedShare(const std::vector<Eigen::VectorXd>& forces) const;

  /// One flag per unknown; changes when supports let go, or tools are taken away.
  const std::vector<bool>& prescribed() const { return prescribed_; }

  /// Frees the unknowns that no support holds behind time t; takes tools away that are not there behind it, whose own
  /// unknowns keep the values they have in x, and whose multipliers are zero. Returns whether that changes anything.
  bool releaseBehind(double t, const Eigen::VectorXd& x);

  /// After that: what supports and tools that have let go at time t carried is held from now on, less and less. forces: of
  /// the terms there were at that time, in their order.
  void holdReleased(double t, const std::vector<Eigen::VectorXd>& forces);

  const std::vector<LeavingTool>& leavingTools() const { return leaving_; }
  bool hasLeft(std::size_t tool) const;

  /// Forces with which supports that have let go still hold the body; null if none ever does.
  const ReleasedForces* released() const { return released_.get(); }

  /// The sum of what all terms but the released forces add: what supports balance, those that have let go with
  /// what they still carry. forces: of the terms, in their order.
  Eigen::VectorXd forcesOnSupports(const std::vector<Eigen::VectorXd>& forces) const;

  /// Values of the prescribed unknowns at time t, zero elsewhere.
  Eigen::VectorXd target(double t) const;

  /// Times at which a schedule has a corner, in order.
  const std::vector<double>& corners() const { return corners_; }

  /// Before t = 0 lifted tools come down: the time at which the run starts, 0 when none is lifted.
  double startTime() const { return start_.time; }

  /// The body at the start time with its tools in place.
  const SteppingState& startState() const { return start_; }

 private:
  friend class ModelBuilder<Dim>;
  Model(const Scene& scene, const std::vector<NamedBody<Dim>>& bodies);

  std::vector<ModelBody<Dim>> bodies_;
  Body<Dim> body_;
  FaceFinder<Dim> faces_;
  Supports<Dim> supports_;
  std::vector<std::unique_ptr<Tool>> tools_;
  std::vector<ContactPair<Dim>> contacts_;
  std::vector<FacePair<Dim>> pairs_;
  std::vector<SelfContact<Dim>> selfContacts_;
  std::vector<std::unique_ptr<LoadTerm>> loads_;
  std::vector<CarriedLoad> toolLoads_;
  std::vector<LeavingTool> leaving_;
  std::map<int, double> kept_;  ///< prescribed values of unknowns of tools that have been taken away
  std::unique_ptr<ReleasedForces> released_;
  std::unique_ptr<Stabilisation<Dim>> stabilisation_;
  std::vector<bool> prescribed_;
  std::vector<double> corners_;
  int numForces_ = 0;
  int numUnknowns_ = 0;
  SteppingState start_;
  Eigen::VectorXd origin_;  ///< prescribed displacements that the reference configuration holds already
};

}  // namespace burnish::inline analysis
