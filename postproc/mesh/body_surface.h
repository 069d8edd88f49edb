#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>

#include "engine/results/result.h"
#include "postproc/mesh/patch_borders.h"
#include "postproc/mesh/tensor_points.h"

class vtkCellArray;
class vtkPolyData;

namespace burnish {

/// What can be seen of the body, cut into quadrilaterals, `subdivision` per knot span and direction: a plane
/// body itself, of one in space the faces that no two patches share. Patches and faces do not share points,
/// so that edges stay sharp. The quadrilaterals go round counterclockwise for who looks at them from outside.
class BodySurface {
 public:
  /// Which faces: those that can be seen, or of a body in space those between and around its knot spans.
  enum class Faces { Outside, OfSpans };

  /// Throws `Error` if `subdivision` < 1 or the mesh is inconsistent.
  BodySurface(const MeshRecord& mesh, int subdivision, Faces faces = Faces::Outside);

  int numPoints() const { return points_.size(); }

  /// Values at the points (components x points) of a field with these coefficients (components x nodes).
  /// Throws `Error` if the number of nodes does not fit.
  Eigen::MatrixXd evaluate(const Eigen::MatrixXd& coefficients) const {
    return points_.evaluate(coefficients);
  }

  /// The displaced surface in double precision, in space with normals at its points. displacement: dim x
  /// nodes. Throws `Error` if it does not fit.
  vtkSmartPointer<vtkPolyData> displaced(const Eigen::MatrixXd& displacement) const;

 private:
  /// All of a plane patch, or a face.
  void addSide(const PatchRecord& patch, const std::vector<PatchSide::End>& ends, int subdivision);

  void addFacesOfSpans(const PatchRecord& patch, int subdivision);

  /// Adds points, which have one row and column, and the quadrilaterals between them.
  void add(TensorPoints points, bool clockwise);

  PointLattices points_;
  std::vector<int> corners_;  ///< 4 per quadrilateral
  vtkSmartPointer<vtkCellArray> cells_;
};

}  // namespace burnish
