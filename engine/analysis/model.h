#pragma once
#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "engine/analysis/geometry.h"
#include "engine/analysis/supports.h"
#include "engine/contact/contact_term.h"
#include "engine/contact/self_contact_term.h"
#include "engine/rezoning/state_transfer.h"
#include "engine/scene/scene.h"
#include "engine/solid/body.h"
#include "engine/solid/bulk_term.h"
#include "engine/solid/load_term.h"
#include "engine/solid/span_quadrature.h"
#include "engine/solid/stabilisation.h"
#include "engine/solver/newton.h"
#include "engine/solver/stepping.h"
#include "engine/tools/tool.h"
#include "engine/tools/tool_load.h"

namespace burnish {

/// A contact pair of the scene: its term and the place of its tool.
template <int Dim>
struct ContactPair {
  std::size_t tool = 0;
  int patch = 0;
  std::string faceName;
  std::unique_ptr<ContactTerm<Dim>> term;
};

/// A face that may touch itself.
struct SelfContact {
  int patch = 0;
  FaceId face = 0;
  std::unique_ptr<SelfContactTerm> term;
};

/// A body that was meshed anew under way, in the configuration that it had at a time: its new reference.
template <int Dim>
struct RezonedBody {
  NamedBody<Dim> named;
  PointStates states;  ///< at the quadrature points that the scene asks for
  double plasticWork = 0.0;
  double time = 0.0;
};

/// Everything that a scene describes, as terms and constraints over one numbering of unknowns: Dim
/// displacement components per node, the free ways of tools, then the contact multipliers.
template <int Dim>
class Model {
 public:
  /// Throws `InputError` if the scene cannot be computed: patches that do not fit, folded geometry, supports
  /// that contradict each other or leave the body free to move away, a tool that overlaps the body at the
  /// start, a formula without a finite value at a time on which the steps land.
  explicit Model(const Scene& scene);

  /// The same tools, supports and contact pairs for a body that was meshed anew; what the scene's own body
  /// was checked for is not checked again. Throws `InputError` if the map of the body is folded.
  Model(const Scene& scene, RezonedBody<Dim> rezoned);
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  const Body<Dim>& body() const { return body_; }
  const SpanQuadrature<Dim>& quadrature() const { return *quadrature_; }
  BulkTerm<Dim>& bulk() { return *bulk_; }
  const BulkTerm<Dim>& bulk() const { return *bulk_; }
  const std::vector<std::unique_ptr<Tool>>& tools() const { return tools_; }
  const std::vector<ContactPair<Dim>>& contacts() const { return contacts_; }
  const std::vector<SelfContact>& selfContacts() const { return selfContacts_; }
  const std::vector<std::unique_ptr<LoadTerm>>& loads() const { return loads_; }
  const FaceFinder<Dim>& faces() const { return faces_; }
  const Supports<Dim>& supports() const { return supports_; }

  /// Null unless the scene asks for it.
  const Stabilisation<Dim>* stabilisation() const { return stabilisation_.get(); }

  /// Share of the largest force that the stabilisation carries in the state that the terms have been
  /// evaluated at. forces: of the terms, in their order.
  double stabilisedShare(const std::vector<Eigen::VectorXd>& forces) const;

  /// Bulk, contacts, contacts of faces with themselves, loads, loads of tools, stabilisation, in this order.
  std::vector<Term*> terms() const;

  int numUnknowns() const { return numUnknowns_; }
  int numDisplacements() const { return Dim * body_.numNodes; }

  /// One flag per unknown.
  const std::vector<bool>& prescribed() const { return prescribed_; }

  /// Values of the prescribed unknowns at time t, zero elsewhere.
  Eigen::VectorXd target(double t) const;

  ResidualScales residualScales() const;

  /// Name of a tool that has to be held by what it carries to stay in touch with the body, in the state that
  /// the terms have been evaluated at; empty if there is none.
  std::string pulledTool() const;

  /// Key of a free way in which a tool has moved too far since the last accepted state; empty if none has.
  std::string runawayWay() const;

  /// Times at which a schedule has a corner.
  const std::vector<double>& corners() const { return corners_; }

  /// Before t = 0 lifted tools come down: the time at which the run starts, 0 when none is lifted.
  double startTime() const { return startTime_; }

  /// The undeformed body at the start time.
  SteppingState startState() const;

 private:
  void addLoad(const Scene& scene, std::size_t number);
  void requireFiniteFormulas(const Scene& scene) const;
  void addTool(const Scene& scene, std::size_t number);
  void addContact(const Scene& scene, std::size_t number);
  void addSelfContact(const Scene& scene, std::size_t number);
  void requireReachable(const Tool& tool, const ContactSpec& spec, const std::string& place) const;
  void addStabilisation(const Scene& scene);
  void liftTools(const Scene& scene);
  void placeFreeTool(const ToolLoad& load, const Scene& scene);
  std::vector<ContactTerm<Dim>*> pairsOf(std::size_t tool) const;
  std::size_t numberOf(const Tool& tool) const;
  void requireSupported() const;

  /// Smallest force that counts, a share of E L (E L² in 3D and axisymmetry).
  double forceFloor() const;

  Model(const Scene& scene, NamedBody<Dim> body);
  void addBoundary(const Scene& scene);

  Body<Dim> body_;
  FaceFinder<Dim> faces_;
  Supports<Dim> supports_;
  std::unique_ptr<SpanQuadrature<Dim>> quadrature_;
  std::unique_ptr<BulkTerm<Dim>> bulk_;
  std::vector<std::unique_ptr<Tool>> tools_;
  std::vector<ContactPair<Dim>> contacts_;
  std::vector<SelfContact> selfContacts_;  ///< none in 3D
  std::vector<std::unique_ptr<LoadTerm>> loads_;
  std::vector<std::unique_ptr<ToolLoad>> toolLoads_;
  std::unique_ptr<Stabilisation<Dim>> stabilisation_;
  std::vector<bool> prescribed_;
  std::vector<double> corners_;
  int numUnknowns_ = 0;
  int numForces_ = 0;  ///< unknowns before the multipliers
  bool rezoned_ = false;
  double startTime_ = 0.0;
  Eigen::VectorXd start_;   ///< unknowns of the undeformed body with its tools in place
  Eigen::VectorXd origin_;  ///< prescribed displacements that the reference configuration holds already
};

/// The model of a scene. Throws `Error` if it cannot be computed, every line with its place in the scene's
/// file.
template <int Dim>
std::unique_ptr<Model<Dim>> buildModel(const Scene& scene);

}  // namespace burnish
