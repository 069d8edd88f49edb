#pragma once
#include <Eigen/Dense>
#include <array>
#include <optional>
#include <vector>

#include "engine/core/state_archive.h"
#include "engine/nurbs/second_order_shape.h"
#include "engine/solid/body.h"
#include "engine/solid/face_place.h"

namespace burnish {

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
  bool isRounded = false;                                    ///< on a rounded kink
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
  /// m_αβ = y_α·y_β and κ_αβ = n·y_αβ.
  double shareOfRadius() const;
};

/// One or several faces of a body as one surface: rims with the same nodes are glued to one another. Beyond a
/// rim that is not, the surface goes on along its tangents by the size of the last span.
///
/// Where two spans meet that are continuous only, the surface gets a kink under pressure. The normal would jump
/// where a foot goes over it, and with it forces: states in between, in which both sides hold a point, would
/// have no equilibrium. In the plane kinks are therefore rounded (`roundKinks`),
///
///     ỹ(s) = y(s) + ¼ (1 - |s|)² (y'(0⁺) - y'(0⁻)) for |s| <= 1,
///
/// with s the distance from the kink over a small part of the shorter of both spans. ỹ has a continuous tangent,
/// and is a sum of control points as y is.
template <int Dim>
class MasterSurface {
 public:
  /// In its reference place. Throws `Error` if a face is named twice or more than two faces meet in a rim.
  MasterSurface(const Body<Dim>& body, const std::vector<FacePlace>& faces);

  /// Moves it to where the displacements of all nodes put it, which come first among the unknowns.
  void moveTo(const Eigen::VectorXd& x);

  /// Rounds the kinks that the surface has in its current place, in the plane, but for corners from 45 degrees
  /// on; which ones they are, and how far, stays so until it is called again.
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

  /// Current Bézier points of a span, with those of its rounded ends, in whose convex hull it lies; empty if
  /// their weights are not positive (possible for Lagrange bases with weights only).
  Eigen::Matrix<double, Dim, Eigen::Dynamic> hull(int face, int span) const;

 private:
  static constexpr int P = Dim - 1;

  /// Across a rim: the first span of another rim, whose parameter along it may run the other way.
  struct Glue {
    int face = 0, rim = 0;
    bool reversed = false;
  };

  /// How the kink at an end of a span is rounded, seen from that span.
  struct Rounding {
    SurfacePlace<Dim> here, there;                   ///< the kink as a place of both spans
    double width = 0.0;                              ///< of the rounded part, in the span's parameter
    double hereByLength = 0.0, thereByLength = 0.0;  ///< parameters by s, which grows from here to there
  };

  struct Face {
    Patch<P, Dim> trace;  ///< in the reference place
    std::vector<int> nodes;
    double outward = 1.0;
    Eigen::MatrixXd points;  ///< current control points
    std::array<std::optional<Glue>, 2 * P> glued;
    std::array<bool, 2 * P> collapsed{};
    std::vector<std::array<std::optional<Rounding>, 2>> roundings;  ///< per span, at its ends; in the plane
  };

  /// A place on the edge of a span, seen from that span: parameter d at its begin (side 0) or end (1).
  struct Edge {
    SurfacePlace<Dim> place;
    int direction = 0, side = 0;
  };

  const Face& at(int face) const { return faces_[static_cast<std::size_t>(face)]; }
  void glueRims();
  std::optional<Rounding> roundingOf(const SurfacePlace<Dim>& place, int side) const;
  SurfacePoint<Dim> unroundedAt(const SurfacePlace<Dim>& place) const;
  void round(SurfacePoint<Dim>& point) const;
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

}  // namespace burnish
