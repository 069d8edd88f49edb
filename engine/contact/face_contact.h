#pragma once
#include <Eigen/Dense>
#include <functional>
#include <utility>
#include <vector>

#include "engine/contact/averaged_gaps.h"
#include "engine/contact/contact_options.h"
#include "engine/contact/friction_law.h"
#include "engine/contact/friction_work.h"
#include "engine/solid/face_quadrature.h"
#include "engine/solver/term.h"

namespace burnish::inline contact {

/// Contact quantities at the last evaluated state; the partner is a tool or faces of a body. Methods that
/// close averaged gaps have g_A and λ̂_A per function, the integral one gap and contact pressure -p where the
/// function's anchor is.
struct ContactState : FaceContactState {
  Eigen::MatrixXd normal;  ///< of the partner, away from it, 3 x quadrature points; zero without
  Eigen::Vector3d reaction =
      Eigen::Vector3d::Zero();  ///< force of the face on the partner; whole rings in axisymmetry
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< of that force about the partner's pivot
  double energy = 0.0;
  double pressed = 0.0;  ///< ∫ p dΓ, of contact over a `Partner` alone
  double area = 0.0;     ///< reference area under pressure; the integral method alone knows it

  /// Force with which a tool that is free to move would have to be held back to stay in touch; > 0 where
  /// its load pulls it off the body.
  double pull = 0.0;

  // With friction.
  Eigen::Matrix3Xd traction;  ///< of friction on the partner, nominal, quadrature points; else empty
  Eigen::Matrix3Xd slip;      ///< way of the face on the partner in this step; of points that are not open
  Eigen::VectorXd slipped;    ///< way slipped under pressure since the start, quadrature points
  std::vector<int> sliding;   ///< quadrature points: 0 open, 1 stick, 2 slip; empty without friction
  int sticking = 0, slipping = 0;  ///< functions; with the point-wise penalty quadrature points
  double frictionForce = 0.0;      ///< ∫ |t| dΓ
  double frictionWork = 0.0;       ///< taken by friction since the start

  /// Leaves of the reaction what whole rings do not balance by themselves: its axial part.
  void keepAxialReaction() {
    reaction(0) = 0.0;
    moment.setZero();
  }
};

/// Gap of a place in the reference state.
using GapAt = std::function<double(const Eigen::Vector3d&)>;

/// Contact of one face of a body, which has the quadrature and the multipliers, whatever its partner and the
/// method.
template <int Dim>
class FaceContact : public Term {
 public:
  /// Multipliers that the term adds to the unknowns, and the first of them.
  virtual int numMultipliers() const = 0;
  int firstMultiplier() const { return firstMultiplier_; }

  /// Whether every function has its multipliers, also at ends that supports hold.
  bool hasAllMultipliers() const {
    return numMultipliers() == (options_.hasFriction() ? Dim : 1) * face_.numFunctions();
  }

  /// Number among the unknowns of a multiplier of a function: with component 0 of λ, else of a part of τ; -1 for none.
  /// Functions may share one. Of methods that have multipliers.
  virtual int multiplierOf(int function, int component) const;

  /// Coefficients by functions of one of these fields in x; zero without a multiplier.
  Eigen::VectorXd multipliers(int component, const Eigen::VectorXd& x) const;

  /// Sets them in x: a multiplier that functions share has their mean.
  void setMultipliers(int component, const Eigen::VectorXd& coefficients, Eigen::VectorXd& x) const;

  /// What residuals of multipliers are compared with, one per multiplier: integrals of their functions over
  /// the reference face. With penalties, which have no multipliers, one per function.
  const Eigen::VectorXd& weights() const { return A_; }

  /// The same by functions, one each, also where they share multipliers.
  Eigen::VectorXd functionWeights() const;

  /// As much as takes the pressure away, where the whole correction would leave the face pulled by its partner:
  /// multipliers that pull let go next, and so a body comes free by its own springback instead of under a
  /// tension in which it flows.
  double usefulPart(const Eigen::VectorXd& x, const Eigen::VectorXd& correction) const override;

  /// Replaces ε. With an augmented Lagrangian the way into equilibrium depends on it, the equilibrium does
  /// not.
  void setParameter(double parameter) { options_.parameter = parameter; }
  double parameter() const { return *options_.parameter; }

  const FrictionLaw& frictionLaw() const { return frictionLaw_; }

  /// There is no friction until the time.
  void beginFrictionAt(double time) { frictionLaw_.beginAt(time); }

  /// Goes on with friction from another mesh. work: that it has taken; slipped: coefficients of the way that
  /// the face has slipped under pressure, functions.
  void continueFriction(double work, Eigen::VectorXd slipped);

  /// Coefficients of the way that the face has slipped under pressure until the accepted state, functions.
  const Eigen::VectorXd& slipped() const { return slipped_; }

  /// Makes this pair the one that keeps a partner with free degrees of freedom in touch with the body,
  /// without which its place is not determined: while nothing is active, here or in the partner's other pairs
  /// (which are evaluated before), the nearest function (or point) counts as active. Every point needs a
  /// partner.
  void keepInTouch(std::vector<const FaceContact*> others);

  /// The partner is no more: from now on nothing of the face is pressed, and evaluations add nothing. What friction has
  /// done stays known.
  void loseTouch();
  bool hasLostTouch() const { return hasLostTouch_; }

  /// Gaps are measured from these values instead of zero: those with which a state that does not fit begins
  /// can be taken away little by little. One per function, of averaged gaps or of a field of gaps; empty:
  /// from zero.
  void measureGapsFrom(Eigen::VectorXd origin) { gapOrigin_ = std::move(origin); }

  /// Gaps of the undeformed face as the method takes them, one per function: averaged ones, limited as the
  /// options say, or those at the functions' anchors.
  virtual Eigen::VectorXd referenceGaps(const GapAt& gapAt) const;

  /// Smallest gap of the undeformed face, of those that the method closes: averaged ones, or those of points.
  virtual double smallestReferenceGap(const GapAt& gapAt) const { return referenceGaps(gapAt).minCoeff(); }

  /// Reference area of the face where gaps of its quadrature points are negative, and the smallest gap. x: unknowns.
  struct Cover {
    double area = 0.0, smallestGap = 0.0;
  };
  Cover coverAt(const Eigen::VectorXd& x, const GapAt& gapAt) const;

  const ContactState& state() const { return state_; }
  const FaceQuadrature<Dim>& face() const { return face_; }
  const ContactOptions& options() const { return options_; }

 protected:
  /// options: with a parameter. definitions: of names in the formula for friction. Throws `Error` as
  /// `FrictionLaw`.
  FaceContact(const Body<Dim>& body, int patch, FaceId face, const ContactOptions& options,
              int firstMultiplier, const std::vector<DefinitionSpec>& definitions = {})
      : face_(body, patch, face, contactPoints(body, patch, options.quadraturePoints)),
        options_(options),
        firstMultiplier_(firstMultiplier),
        axisymmetric_(body.axisymmetric),
        frictionLaw_(options, definitions),
        slipped_(Eigen::VectorXd::Zero(face_.numFunctions())) {}

  double frictionParameter() const { return options_.frictionParameter.value_or(parameter()); }

  /// Area of the face at a point over that of its reference place. points: control points of the point's
  /// functions, n each; R, dR: values and derivatives of these, of shape n and n x (Dim-1).
  double areaStretch(const std::vector<int>& functions, const Eigen::Ref<const Eigen::MatrixXd>& points,
                     const Eigen::Ref<const Eigen::VectorXd>& R,
                     const Eigen::Ref<const Eigen::MatrixXd>& dR) const;

  /// The reference place of a point of a span with the values R of its functions.
  Eigen::Vector3d referencePlace(const std::vector<int>& functions,
                                 const Eigen::Ref<const Eigen::VectorXd>& R) const;

  /// Length of the slip of the step under pressure at a quadrature point in the last evaluated state.
  double slipUnderPressure(Eigen::Index point) const {
    return state_.pressure(point) > 0.0 ? state_.slip.col(point).norm() : 0.0;
  }

  /// The state of a face that has lost touch. Returns true.
  bool reportUntouched();

  /// State of an evaluation that has not begun: nothing is pressed, nothing has a partner.
  void clearState(bool hasFriction);

  /// Fills in `ContactState::slipped` from the way until the accepted state and the slip of the step.
  void reportSlipped();

  /// Adds averages of the slip of the last evaluated state, which is accepted, to `slipped_`.
  void acceptSlipped();

  /// Smallest gap of the undeformed face's quadrature points.
  double smallestGapOfPoints(const GapAt& gapAt) const;

  /// Smallest gap of some places, Dim x places.
  static double smallestGapAmong(const Eigen::MatrixXd& places, const GapAt& gapAt);

  /// Whether the partner touches the body nowhere else.
  bool isAlone() const;

  FaceQuadrature<Dim> face_;
  ContactOptions options_;
  int firstMultiplier_;
  bool axisymmetric_;
  FrictionLaw frictionLaw_;
  FrictionWork work_;
  Eigen::VectorXd slipped_;
  Eigen::VectorXd A_;
  ContactState state_;
  Eigen::VectorXd gapOrigin_;
  bool keepsInTouch_ = false, hasLostTouch_ = false;
  std::vector<const FaceContact*> others_;
};

}  // namespace burnish::inline contact
