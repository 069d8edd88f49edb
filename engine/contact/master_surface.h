#pragma once
#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "engine/core/state_archive.h"
#include "engine/nurbs/second_order_shape.h"
#include "engine/solid/body.h"
#include "engine/solid/face_place.h"

namespace burnish::inline contact {

/// A place on a surface of one or several faces. A place on a knot belongs to any of the spans around it.
template <int Dim>
struct SurfacePlace {
  int face = 0;  ///< number in the list of faces
  int span = 0;  ///< of that face
  Eigen::Vector<double, Dim - 1> xi;
};

/// A point of a surface in its current place, with derivatives by the face's parameters.
template <int Dim>
struct SurfacePoint {
  SurfacePlace<Dim> place;
  std::vector<int> nodes;                                    ///< of the body, n
  SecondOrderShape<Dim - 1> shape;                           ///< of these nodes
  Eigen::Vector<double, Dim> x;                              ///< y = Σ R_b y_b
  Eigen::Matrix<double, Dim, Dim - 1> tangents;              ///< y_α = ∂y/∂η^α
  Eigen::Matrix<double, Dim, Dim*(Dim - 1) / 2> curvatures;  ///< y_αβ, see `secondDerivative`
  Eigen::Vector<double, Dim> normal;                         ///< unit, out of the body
  std::array<bool, Dim - 1> isRounded{};                     ///< across which parameter on a rounded kink
};

/// Closest point of a surface to a position x. Where the surface has a kink only some of the two parameters
/// move with the position, or none:
///
///     inside a span, or on a knot without a kink   all of them            n: normal of the surface
///     on a line between two smooth parts           the one along the line n = (x - y)/g
///     on a kink of a curve, at a corner            none                   n = (x - y)/g
///
/// and (x - y)·y_α = 0 for those that move. g = (x - y)·n is positive outside.
template <int Dim>
struct Foot {
  SurfacePoint<Dim> point;
  std::array<bool, Dim - 1> moves{};
  Eigen::Vector<double, Dim> normal;
  double gap = 0.0;
  double edgeCurvature = 0.0;  ///< 1/g if n turns about a kink; 0 for gaps below rounding and elsewhere

  bool isSmooth() const { return moves.front() && moves.back(); }

  /// Gap over the distance to the nearer centre of curvature, positive on its side, where the foot ends to be
  /// the closest point at 1: the largest eigenvalue of g m⁻¹ κ of the parameters that move, with
  /// m_αβ = y_α·y_β and κ_αβ = n·y_αβ. Rounded kinks, whose radii are short, are left out.
  double shareOfRadius() const;
};

/// One or several faces of a body as one surface: rims with the same nodes are glued to one another. Beyond a
/// rim that is not, the surface goes on along its tangents by the size of the last span.
///
/// Where two spans meet that are continuous only, the surface gets a kink under pressure. The normal would jump
/// where a foot goes over it, and with it forces: states in between, in which both sides hold a point, would
/// have no equilibrium. Kinks are therefore rounded (`roundKinks`),
///
///     ỹ = y + b Σ y_d,  b = ¼ (1 - s)² for s <= 1,
///
/// with s the distance from the kink in parts of a width, a small part of the shorter of both spans, and the sum of
/// both sides' derivatives ∂y/∂s on the kink, away from it. ỹ has a continuous tangent, and is a sum of control
/// points as y is. In space a kink is a line of constant parameter, y_d and the width go along it, and where two of
/// them cross both are rounded, one after the other in either order:
///
///     ỹ = y + b_0 Σ y_0 + b_1 Σ y_1 + b_0 b_1 Σ y_01,
///
/// the last sum going over the four spans around the crossing. Widths belong to the corners of spans, zero at
/// those from which a line does not go on as one, and change along edges such that their derivative is zero at
/// corners: what is rounded then goes on over them with a continuous tangent plane.
template <int Dim>
class MasterSurface {
 public:
  /// In its reference place. Throws `Error` if a face is named twice or more than two faces meet in a rim.
  MasterSurface(const Body<Dim>& body, const std::vector<FacePlace>& faces);

  /// Moves it to where the displacements of all nodes put it, which come first among the unknowns.
  void moveTo(const Eigen::VectorXd& x);

  /// Rounds the kinks that the surface has in its current place, but for corners from 45 degrees on; which ones
  /// they are, and how far, stays so until it is called again.
  void roundKinks();

  /// Longest way of a control point from another place of the same surface; no point of it has gone farther
  /// where weights are positive.
  double largestWayFrom(const MasterSurface& other) const;

  /// Its current place, without what is rounded.
  void archive(StateArchive& archive);

  int numFaces() const { return static_cast<int>(faces_.size()); }
  const TensorBasis<Dim - 1>& basis(int face) const { return at(face).trace.basis(); }

  /// Body's node behind each function of a face.
  const std::vector<int>& nodes(int face) const { return at(face).nodes; }

  SurfacePlace<Dim> placeOf(int face, const Eigen::Vector<double, Dim - 1>& xi) const;
  SurfacePoint<Dim> at(const SurfacePlace<Dim>& place) const;

  /// The foot that one comes to from a place when one walks downhill over the squared distance to a position:
  /// by Newton's method for (x - y)·y_α = 0, over knots and glued rims, along lines and into corners. Nothing
  /// where that does not converge (also near places where a face is collapsed to a point) and beyond the
  /// continued surface.
  std::optional<Foot<Dim>> project(const Eigen::Vector<double, Dim>& position,
                                   const SurfacePlace<Dim>& start) const;

  /// How far a place lies beyond a rim that is not glued, in parts of its span; at most 0 on the surface.
  double overhang(const SurfacePlace<Dim>& place) const;

  /// All spans that a place belongs to, each with its own parameters; the one that is given comes first.
  /// Around a rim that is collapsed to a point also the middles of its spans.
  std::vector<SurfacePlace<Dim>> around(const SurfacePlace<Dim>& place) const;

  /// Box in which a span lies in its current place, that of its Bézier points and, where it is rounded, a part of
  /// the way to those of the spans around; empty if their weights are not positive (possible for Lagrange bases
  /// with weights only).
  Eigen::AlignedBox<double, Dim> box(int face, int span) const;

 private:
  static constexpr int P = Dim - 1;

  /// Across a rim: the first span of another rim, whose parameter along it may run the other way.
  struct Glue {
    int face = 0, rim = 0;
    bool reversed = false;
  };

  struct Face {
    Patch<P, Dim> trace;  ///< in the reference place
    std::vector<int> nodes;
    double outward = 1.0;
    Eigen::MatrixXd points;  ///< current control points
    std::array<std::optional<Glue>, 2 * P> glued;
    std::array<bool, 2 * P> collapsed{};

    /// Per span, of what is rounded at its edge 2 d + side, in the parameter d: at the begin and end of the
    /// edge (equal in the plane), zero where it is sharp. Empty if all edges are.
    std::vector<std::array<std::array<double, 2>, 2 * P>> widths;
  };

  /// A place on the edge of a span, seen from that span: parameter d at its begin (side 0) or end (1). `stretch`
  /// is the derivative of the parameter along it by that of the span from which one came over the edge.
  struct Edge {
    SurfacePlace<Dim> place;
    int direction = 0, side = 0;
    double stretch = 1.0;
  };

  /// What an edge between two spans that are continuous only is like somewhere along it, and sums over places on
  /// it of the lengths of the tangents by either span's parameter across.
  struct Crease {
    bool isKink = false, isCorner = false;
    double speed = 0.0, speedThere = 0.0;
  };
  using Creases = std::vector<std::vector<std::array<std::optional<Crease>, 2 * P>>>;

  /// A factor with derivatives by the parameters.
  struct Blend {
    double b = 0.0;
    Eigen::Vector<double, P> d = Eigen::Vector<double, P>::Zero();
    Eigen::Vector<double, P*(P + 1) / 2> dd = Eigen::Vector<double, P*(P + 1) / 2>::Zero();

    Blend operator*(const Blend& other) const;
  };

  /// Both sides of an edge about which a place of the first one is rounded, with b of `MasterSurface`.
  struct Rounding {
    Edge here, there;
    Blend blend;
  };

  /// A sum of control points on an edge, Σ f_b y_b, and its derivatives along the edge, one column each.
  struct EdgeSum {
    std::vector<int> nodes;
    Eigen::MatrixXd f;
    Eigen::Matrix<double, Dim, Eigen::Dynamic> y;
  };

  const Face& at(int face) const { return faces_[static_cast<std::size_t>(face)]; }
  void glueRims();
  double spanEnd(const SurfacePlace<Dim>& place, int direction, int side) const;
  double spanSize(const SurfacePlace<Dim>& place, int direction) const;
  int sideOf(const SurfacePlace<Dim>& corner, int direction) const;
  std::optional<Crease> creaseAt(Edge edge) const;
  double widthAtCorner(const Edge& edge, const Creases& creases) const;
  Blend widthAlong(const Edge& edge, int along) const;
  std::optional<Rounding> roundingAt(const SurfacePlace<Dim>& place, int direction) const;
  EdgeSum slopeInto(const Edge& edge) const;
  static void add(const Blend& blend, const EdgeSum& sum, int along, SurfacePoint<Dim>& point);
  std::vector<int> spanNodes(const SurfacePlace<Dim>& place) const;
  Eigen::Matrix<double, Dim, Eigen::Dynamic> spanPoints(const SurfacePlace<Dim>& place) const;
  Eigen::Matrix<double, Dim + 1, Eigen::Dynamic> bezierPoints(int face, int span) const;
  bool isRounded(int face, int span) const;
  SurfacePoint<Dim> unroundedAt(const SurfacePlace<Dim>& place) const;
  void round(SurfacePoint<Dim>& point) const;
  void roundCrossing(const Rounding& first, const Rounding& second, SurfacePoint<Dim>& point) const;
  bool isAtRim(const SurfacePlace<Dim>& place, int direction, int side) const;
  bool isFree(const SurfacePlace<Dim>& place, int direction, int side) const;

  /// How far a foot may go in a span: to its ends, or on beyond those at free rims.
  double limit(const SurfacePlace<Dim>& place, int direction, int side, bool beyondRims) const;
  std::optional<Edge> across(const SurfacePlace<Dim>& place, int direction, int side) const;
  std::vector<Edge> edgesAround(const SurfacePlace<Dim>& place) const;
  std::optional<Foot<Dim>> footAt(const SurfacePoint<Dim>& point, const Eigen::Vector<double, Dim>& position,
                                  const std::array<bool, Dim - 1>& held) const;

  std::vector<Face> faces_;
};

}  // namespace burnish::inline contact
