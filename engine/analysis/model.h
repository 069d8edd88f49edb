#pragma once
#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "engine/contact/contact_term.h"
#include "engine/contact/tool.h"
#include "engine/scene/scene.h"
#include "engine/solid/body.h"
#include "engine/solid/bulk_term.h"
#include "engine/solid/span_quadrature.h"
#include "engine/solid/traction_term.h"
#include "engine/solver/newton.h"
#include "engine/solver/stepping.h"

namespace burnish {

/// A contact pair of the scene: its term and the place of its tool.
template <int Dim>
struct ContactPair {
  std::size_t tool = 0;
  int patch = 0;
  std::string faceName;
  std::unique_ptr<ContactTerm<Dim>> term;
};

/// Everything that a scene describes, as terms and constraints over one numbering of unknowns: Dim
/// displacement components per node, then the contact multipliers.
template <int Dim>
class Model {
 public:
  /// Throws `Error` if the scene cannot be computed: folded geometry, a symmetric support on a face that is
  /// not flat, a tool that overlaps the body at the start, supports that leave the body free to move away.
  explicit Model(const Scene& scene);
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  const Body<Dim>& body() const { return body_; }
  const SpanQuadrature<Dim>& quadrature() const { return *quadrature_; }
  BulkTerm<Dim>& bulk() { return *bulk_; }
  const BulkTerm<Dim>& bulk() const { return *bulk_; }
  const std::vector<std::unique_ptr<Tool>>& tools() const { return tools_; }
  const std::vector<ContactPair<Dim>>& contacts() const { return contacts_; }
  const std::vector<std::unique_ptr<TractionTerm<Dim>>>& tractions() const { return tractions_; }

  /// Bulk, contacts, tractions, in this order.
  std::vector<Term*> terms() const;

  int numUnknowns() const { return numUnknowns_; }
  int numDisplacements() const { return Dim * body_.numNodes; }

  /// One flag per unknown.
  const std::vector<bool>& prescribed() const { return prescribed_; }

  /// Values of the prescribed unknowns at time t, zero elsewhere.
  Eigen::VectorXd target(double t) const;

  ResidualScales residualScales() const;

  /// Times at which a schedule has a corner.
  const std::vector<double>& corners() const { return corners_; }

  /// Before t = 0 lifted tools come down: the time at which the run starts, 0 when none is lifted.
  double startTime() const { return startTime_; }

  /// The undeformed body at the start time.
  SteppingState startState() const;

 private:
  struct PrescribedMotion {
    int unknown;
    Schedule motion;
  };

  void addSupport(const SupportSpec& spec);
  void addTools(const Scene& scene);
  void addContacts(const Scene& scene);
  void requireReachable(const Tool& tool, FaceId face, const ContactSpec& spec) const;
  void liftTools(const Scene& scene);
  void requireSupported() const;

  Body<Dim> body_;
  std::unique_ptr<SpanQuadrature<Dim>> quadrature_;
  std::unique_ptr<BulkTerm<Dim>> bulk_;
  std::vector<std::unique_ptr<Tool>> tools_;
  std::vector<ContactPair<Dim>> contacts_;
  std::vector<std::unique_ptr<TractionTerm<Dim>>> tractions_;
  std::vector<bool> prescribed_;
  std::vector<PrescribedMotion> motions_;
  std::vector<double> corners_;
  int numUnknowns_ = 0;
  double startTime_ = 0.0;
};

}  // namespace burnish
