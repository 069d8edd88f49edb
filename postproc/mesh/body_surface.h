#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <vector>

#include "engine/results/result.h"
#include "postproc/mesh/patch_borders.h"
#include "postproc/mesh/subdivision.h"
#include "postproc/mesh/tensor_points.h"

class vtkCellArray;
class vtkPolyData;

namespace burnish {

/// What can be seen of the body, cut into quadrilaterals, `subdivision` per knot span and direction: a plane
/// body itself, of one in space the faces that no two patches share. Patches and faces do not share points,
/// so that edges stay sharp. The cells go round counterclockwise for who looks at them from outside.
class BodySurface {
 public:
  /// Which faces: those that can be seen, or of a body in space those between and around its knot spans.
  enum class Faces { Outside, OfSpans };

  /// The cells: quadrilaterals, or four triangles of each about the exact point in its middle. These have no
  /// diagonal, along which a picture of a symmetric body would not be symmetric.
  enum class Cells { Quadrilaterals, TrianglesAboutMiddles };

  /// Throws `Error` if the mesh is inconsistent.
  BodySurface(const MeshRecord& mesh, const Subdivision& subdivision, Faces faces = Faces::Outside,
              Cells cells = Cells::Quadrilaterals);

  int numPoints() const { return points_.size(); }

  /// How the points of a plane patch or a face lie.
  struct Lattice {
    IndexBox corners;  ///< rows and columns of the corners of its cells
    IndexBox
        middles;  ///< behind them, of the middles of the cells; of no extent where they are quadrilaterals
  };

  /// In the order of the points.
  std::vector<Lattice> lattices() const;

  /// Values at the points (components x points) of a field with these coefficients (components x nodes).
  /// Throws `Error` if the number of nodes does not fit.
  Eigen::MatrixXd evaluate(const Eigen::MatrixXd& coefficients) const {
    return points_.evaluate(coefficients);
  }

  /// The displaced surface in double precision; faces of a body in space that can be seen have the exact outward
  /// normals at their points, at a crease between spans their mean. displacement: dim x nodes. Throws `Error` if
  /// it does not fit.
  vtkSmartPointer<vtkPolyData> displaced(const Eigen::MatrixXd& displacement) const;

 private:
  /// What the tangents at the points of a face in space follow from.
  struct Tangents {
    std::array<std::size_t, 2> directions;  ///< of the patch, so that their cross product points outwards
    std::vector<TensorPoints> sides;        ///< the same points as ends of the spans before and behind them
    TensorPoints inside;                    ///< a trifle further in, where no edge has shrunk to a point
  };

  /// All of a plane patch, or a face.
  void addSide(const MeshRecord& mesh, const PatchSide& side, const Subdivision& subdivision);

  void addFacesOfSpans(const MeshRecord& mesh, std::size_t patch, const Subdivision& subdivision);

  /// Adds points at these parameters, which have one row and column, and the cells between them.
  void add(const PatchRecord& patch, const std::vector<std::vector<double>>& parameters, bool clockwise);

  /// directions: of the face, in the order of `Tangents`.
  static Tangents tangentsAt(const PatchRecord& patch, const std::vector<std::vector<double>>& parameters,
                             const std::array<std::size_t, 2>& directions);

  /// Unit vectors, 3 x points.
  Eigen::Matrix3Xd normals(const Eigen::MatrixXd& displacement) const;

  /// Numbers of the points of each cell x cells.
  Eigen::Map<const Eigen::MatrixXi> cornersOfCells() const;

  PointLattices points_;
  std::vector<Tangents> tangents_;  ///< of the lattices of faces in space that can be seen
  Cells kind_;
  std::vector<int> corners_;  ///< 4 per quadrilateral, 3 per triangle
  vtkSmartPointer<vtkCellArray> cells_;
};

}  // namespace burnish
