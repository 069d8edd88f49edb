#pragma once
#include <Eigen/Dense>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "engine/results/result.h"
#include "postproc/mesh/index_box.h"
#include "postproc/mesh/mesh_pieces.h"
#include "postproc/mesh/tensor_points.h"

class vtkUnstructuredGrid;

namespace burnish {

/// What a point holds of a field.
enum class PointMeaning {
  Value,       ///< its value there
  Coefficient  ///< its coefficient in the rational Bernstein basis of a knot span
};

/// The points of one patch: `steps` per knot span and direction; neighbouring spans share points. Of a
/// surface, the third direction has one span of no steps.
struct PatchLattice {
  int firstPoint = 0;
  IndexBox spans;
  std::array<int, 3> steps{0, 0, 0};

  IndexBox points() const;

  /// The point that stands `local` steps into a span.
  int point(const IndexBox::Index& span, const IndexBox::Index& local) const;
};

/// Points on a lattice over the knot spans of every patch. Patches do not share points.
class SpanPoints {
 public:
  /// `steps`: how many per knot span of a direction; their degree for coefficients. piece: with points alone,
  /// all other patches then have no spans; null: all of the mesh. Throws `Error` if a number of steps is < 1 or
  /// the mesh is inconsistent.
  SpanPoints(const MeshRecord& mesh, PointMeaning meaning,
             const std::function<int(const DirectionRecord&)>& steps, const MeshPiece* piece = nullptr);

  int dim() const { return static_cast<int>(referencePoints_.rows()); }
  int size() const { return static_cast<int>(referencePoints_.cols()); }
  const std::vector<PatchLattice>& patches() const { return patches_; }

  /// What the points hold (components x points) of a field with these coefficients (components x nodes).
  /// Throws `Error` if the number of nodes does not fit.
  Eigen::MatrixXd evaluate(const Eigen::MatrixXd& coefficients) const {
    return points_.evaluate(coefficients);
  }

  /// What they hold of the reference positions, dim x points.
  const Eigen::MatrixXd& referencePoints() const { return referencePoints_; }

  /// Weights of the Bernstein polynomials, for coefficients only.
  Eigen::VectorXd weights() const { return points_.weights(); }

 private:
  std::vector<PatchLattice> patches_;
  PointLattices points_;
  Eigen::MatrixXd referencePoints_;
};

/// Gives a grid these points and what they hold of a frame: `displacement` (components X Y Z) and every field
/// of the frame with its component names; units stand behind the names, see `labelled`. The points are the
/// current positions if `deformed`, else the reference positions. Throws `Error` if a field does not fit the
/// mesh.
void setPoints(vtkUnstructuredGrid& grid, const SpanPoints& points, const FrameRecord& frame, bool deformed,
               const std::string& lengthUnit);

}  // namespace burnish
