#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "engine/contact/carried_frame.h"
#include "engine/contact/gap_ramp.h"
#include "engine/contact/master_search.h"
#include "engine/contact/master_surface.h"
#include "engine/contact/partner.h"
#include "engine/contact/segments.h"
#include "engine/solid/face_quadrature.h"

namespace burnish::inline contact {

/// A slave that hangs over a free end by less than this part of the last span there still has a partner.
inline constexpr double kOverhang = 0.25;

/// Spans of the master that a slave may slip over within one step with friction: a foot that goes farther has
/// jumped. And a limit that no slip reaches.
inline constexpr double kLargestSlip = 3.0;
inline constexpr double kAnySlip = std::numeric_limits<double>::infinity();

/// Which feet are partners. It is decided at accepted states and kept during a step, in which the feet move.
struct PartnerRules {
  /// Largest distance of partners, either side of the surface.
  double reach = 0.0;

  /// How deep a point may be inside when it finds a partner; from the other side of a thin part it has to
  /// find none.
  double newPenetration = std::numeric_limits<double>::infinity();

  /// How far beyond a free rim of the surface a foot may be, in parts of the last span there: of a partner,
  /// and of a new one.
  double overhang = kOverhang, newOverhang = 0.0;

  /// Whether a partner is left for a foot that is nearer by more than a thousandth of the slave's span.
  bool takesNearer = true;

  /// A state is not admissible if a foot has moved farther since the accepted one, in lengths of the span that
  /// it was on.
  double largestSlip = kAnySlip;

  /// In the plane: whether spans of the slave are cut into `FacePartner::segments`.
  bool segments = false;

  /// If the slave is one of the surface's own faces, its number: of two points that face each other the one
  /// on the face with the smaller number is the slave; on one face the one with the smaller parameter, of
  /// those in which they differ most over the face. Where a fold closes, within a span of the slave along
  /// the face, beside points that have partners, and if `isNewMesh` at first, new partners may be inside of
  /// one another by a twentieth of the way along the face and a quarter of the span.
  std::optional<int> ownFace = std::nullopt;

  /// The reference state goes on from one of another mesh.
  bool isNewMesh = false;
};

/// Rules of a face with the number ownFace that may touch the surface which it is part of.
inline PartnerRules selfContactRules(double reach, int ownFace, bool isNewMesh = false) {
  return {.reach = reach,
          .newPenetration = 0.0,
          .newOverhang = kOverhang,
          .takesNearer = false,
          .ownFace = ownFace,
          .isNewMesh = isNewMesh};
}

/// Default of `PartnerRules::reach` for two bodies of these sizes.
inline double defaultReach(double size, double otherSize) {
  return std::min(size, otherSize) / 20.0;
}

/// Faces of a body, of another one or of the slave's own, as the partner of a face. See `PairRows` for the
/// derivatives; the slave's unknowns may be there a second time among the master's.
///
/// The slip of a step is s = (I - n⊗n)(x - y(η̄_n)): the way of the slave point from the material point of
/// the master that was its foot η̄_n in the accepted state, both in their present places. It vanishes in rigid
/// motions of both bodies. With v = x - y(η̄_n) and the frame e_α of `CarriedFrame`,
/// d(e_α·s) = e_α·(Σ R_a dx_a - Σ R_b(η̄_n) dy_b) + v·de_α. The frame's origin is the mean normal of all feet
/// in the accepted state.
template <int Dim>
class FacePartner final : public Partner<Dim> {
 public:
  /// slave: must outlive the object; slaveTrace, outward: its `tracePatch` and `outwardSign`. Both faces are in
  /// their reference places, where partners are chosen.
  FacePartner(const FaceQuadrature<Dim>& slave, Patch<Dim - 1, Dim> slaveTrace, double outward,
              MasterSurface<Dim> surface, const PartnerRules& rules);

  /// Begins at time t with displacements x instead of in the reference state: partners are chosen there.
  void beginAt(double t, const Eigen::VectorXd& x);

  /// Not admissible is a state in which a foot is lost or has gone too far, or in which a point without a
  /// partner has come from before the surface, if that is not its own, to deeper behind it than where new partners
  /// are found.
  [[nodiscard]] bool update(double t, const Eigen::VectorXd& x, const Eigen::MatrixXd& positions) override;

  /// Between quadrature points there is a partner where the segment has one; without segments, where the
  /// nearest quadrature point of the span has one.
  std::optional<ContactPoint<Dim>> at(const SlavePoint<Dim>& point, PointDetail detail) const override;

  /// Adds to the unknowns those of nodes that only the foot in the accepted state stands on.
  void addSlip(const SlavePoint<Dim>& point, ContactPoint<Dim>& contact) const override;
  Eigen::MatrixXd frictionTangent(const SlavePoint<Dim>& point, const ContactPoint<Dim>& contact,
                                  const Eigen::Vector<double, Dim - 1>& traction) const override;

  /// Those of the whole surface, so that the pattern of the tangent stays the same wherever the slave goes.
  std::vector<int> couplings(std::size_t span) const override;

  /// Faces that overlap at first are let into one another step by step.
  void resolveInterference(const GapRamp& ramp) { ramp_ = ramp; }

  /// Segments of a span, begin to end, frozen since the accepted state; empty unless the rules want them.
  std::vector<Segment> segments(std::size_t span) const override { return segments_[span]; }

  Eigen::Vector3d pivot() const override { return Eigen::Vector3d::Zero(); }

  /// None: what is prescribed on the master's body are its supports.
  double prescribedWork(const Eigen::Vector3d&, const Eigen::Vector3d&) const override { return 0.0; }

  void accept() override;
  void archive(StateArchive& archive) override;

  /// Smallest gap of the quadrature points that have a partner in the last updated state, at first the
  /// reference state; infinite without any.
  double smallestGap() const;

  const MasterSurface<Dim>& surface() const { return surface_; }

  /// Foot of a quadrature point in the last updated state, if it has one.
  const std::optional<Foot<Dim>>& foot(int number) const { return feet_[static_cast<std::size_t>(number)]; }

 private:
  using Vector = Eigen::Vector<double, Dim>;
  using Place = SurfacePlace<Dim>;
  using Span = typename MasterSearch<Dim>::Span;
  using Frame = Eigen::Matrix<double, Dim, Dim - 1>;

  struct Slave;

  void moveTo(double t, const Eigen::VectorXd& x, const Eigen::MatrixXd& positions);
  bool hasSlippedTooFar(const Place& start, const Foot<Dim>& foot) const;
  bool anyHasCrossed() const;
  Slave slaveAt(std::size_t e, Eigen::Index q, const Eigen::MatrixXd& controlPoints, const Vector& x) const;
  bool faces(const Slave& slave, const Foot<Dim>& foot) const;
  int nearestNumber(std::size_t span, const Eigen::Vector<double, Dim - 1>& xi) const;
  std::optional<Place> startOf(const SlavePoint<Dim>& point, bool inAcceptedState) const;
  std::optional<Foot<Dim>> footOf(const SlavePoint<Dim>& point) const;
  Place acceptedPlaceOf(const SlavePoint<Dim>& point, const Foot<Dim>& foot) const;
  bool suits(const Slave& slave, const Foot<Dim>& foot, bool isNew) const;
  std::vector<int> neighbours(std::size_t span, Eigen::Index point) const;
  bool isLater(const Place& place, const Slave& slave) const;
  bool mayHoldPartner(const Span& span, const Eigen::Matrix<double, Dim, Eigen::Dynamic>& normals,
                      const Slave& slave) const;
  double wayTo(const Place& place, const Slave& slave) const;
  double deepestNew(const Slave& slave, const Foot<Dim>& foot) const;
  void choosePartners(bool isNewMesh);
  void chooseAnew(bool isNewMesh);
  void cutSegments(const MasterSearch<Dim>& search);
  void chooseFrame();
  Span savedSpan(double face, double span) const;

  const FaceQuadrature<Dim>& slave_;
  double outward_;
  Patch<Dim - 1, Dim> slaveTrace_;
  MasterSurface<Dim> surface_, reference_, acceptedSurface_;
  PartnerRules rules_;
  GapRamp ramp_;
  double addedGap_ = 0.0;                       ///< in the last updated state
  Eigen::MatrixXd slavePoints_, positions_;     ///< control points, quadrature points: last updated state
  Eigen::MatrixXd acceptedSlavePoints_;         ///< control points in the accepted state
  std::vector<std::optional<Foot<Dim>>> feet_;  ///< in the last updated state
  std::vector<std::optional<Place>> places_;    ///< of feet in the accepted state
  std::vector<std::vector<Segment>> segments_;  ///< per span of the slave
  Vector originNormal_;
  Frame origin_;
};

}  // namespace burnish::inline contact
