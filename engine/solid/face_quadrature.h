#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/solid/body.h"
#include "engine/solid/span_quadrature.h"

namespace burnish::inline solid {

/// Quadrature over the reference surface of one face: the trace of a patch (25), with basis values and area
/// weights. In axisymmetry the surface is that of the whole ring; a face on the axis has none.
template <int Dim>
class FaceQuadrature {
 public:
  struct Span {
    int number = 0;              ///< span of the trace's basis
    std::vector<int> functions;  ///< n functions of the trace, numbered as in `nodes()`
    int firstPoint = 0;
    Eigen::MatrixXd xi;           ///< (Dim-1) x Q parameters of the trace
    Eigen::MatrixXd R;            ///< n x Q
    Eigen::MatrixXd dR;           ///< n x (Dim-1)·Q: derivatives with respect to the face's parameters
    Eigen::VectorXd weights;      ///< Q: weight times reference area
    Eigen::VectorXd ruleWeights;  ///< Q: weight in the space of the parameters
    double size = 0.0;            ///< length (2D) or square root of the area, of the cut in axisymmetry
  };

  /// Degree + 1 points per direction and span unless `pointsPerDirection` is positive. part: begin and end in
  /// [0, 1] per direction of the face; only what lies in between is covered. All of it when empty.
  FaceQuadrature(const Body<Dim>& body, int patch, FaceId face, int pointsPerDirection,
                 const std::vector<double>& part = {});

  const std::vector<Span>& spans() const { return spans_; }

  /// Node of the body behind each function of the trace.
  const std::vector<int>& nodes() const { return nodes_; }

  /// Reference positions of the trace's control points, Dim x functions.
  const Eigen::MatrixXd& points() const { return trace_.points(); }

  int numFunctions() const { return static_cast<int>(nodes_.size()); }
  int numPoints() const { return numPoints_; }

  const Patch<Dim - 1, Dim>& trace() const { return trace_; }

  /// Quadrature over a box of parameters inside of a span of the trace's basis, with points numbered from
  /// zero. body: the same as before.
  Span part(const Body<Dim>& body, int number, const ParameterBox<Dim - 1>& box,
            int pointsPerDirection) const;

  /// Current positions of the points of a span, Dim x Q. x: displacements of all nodes, Dim per node, first.
  Eigen::MatrixXd positions(const Span& span, const Eigen::VectorXd& x) const;

  /// The same of all points.
  Eigen::MatrixXd positions(const Eigen::VectorXd& x) const;

 private:
  Patch<Dim - 1, Dim> trace_;
  std::vector<Span> spans_;
  std::vector<int> nodes_;
  int numPoints_ = 0;
};

/// Area vector of a face's tangents: (dy, -dx) of (dx, dy) in two dimensions, in three the cross product.
template <int Dim>
Eigen::Vector<double, Dim> areaVector(const Eigen::Matrix<double, Dim, Dim - 1>& tangents) {
  if constexpr (Dim == 2)
    return {tangents(1), -tangents(0)};
  else
    return tangents.col(0).cross(tangents.col(1));
}

/// +1 or -1: whether the area vector of a face's own parameters points out of the patch.
template <int Dim>
double outwardSign(const Patch<Dim>& patch, FaceId face);

}  // namespace burnish::inline solid
