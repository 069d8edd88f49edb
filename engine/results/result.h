#pragma once
#include <Eigen/Dense>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/nurbs/univariate_basis.h"
#include "engine/tools/recorded_shape.h"

/// What a result holds, as plain values: the one place where engine and post-processor meet.
namespace burnish::inline results {

struct DirectionRecord {
  BasisFamily family = BasisFamily::BSpline;
  int degree = 1;
  std::vector<double> knots;  ///< knot vector (B-spline) or breakpoints (Lagrange)
};

struct PatchRecord {
  std::vector<DirectionRecord> directions;
  Eigen::MatrixXd points;   ///< dim x functions, first direction fastest
  Eigen::VectorXd weights;  ///< functions
  std::vector<int> nodes;   ///< global node of each function; patches that share a face share nodes
  int body = 0;             ///< number of the body that it belongs to
};

/// A mesh of the bodies: their patches and the nodes that these share.
struct MeshRecord {
  int numNodes = 0;
  std::vector<PatchRecord> patches;

  /// 0 without patches.
  int dim() const { return patches.empty() ? 0 : static_cast<int>(patches.front().directions.size()); }
};

struct ToolRecord {
  std::string name;
  RecordedShape shape;  ///< at its reference position
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< through the pivot; the tool turns about it
  /// How deep a point can be inside before the nearest surface is on another side; may be infinite.
  double halfThickness = std::numeric_limits<double>::infinity();
  std::optional<double> until{};  ///< when it is taken away; nothing if it stays

  /// Whether a frame of this time has it; that of the time at which it is taken away has, with its forces.
  bool isThereAt(double time) const { return !until || time <= *until * (1.0 + 1e-9); }
};

/// A field of control-point coefficients: field(ξ) = Σ R_A(ξ) q_A.
struct FieldRecord {
  std::vector<std::string> components;  ///< {"xx","yy","xy","zz"}; empty for a scalar
  std::string unit;                     ///< label, may be empty
  Eigen::MatrixXd values;               ///< components x nodes
  /// Names of the bodies that have the field, if not all have it; zeros stand for the others.
  std::vector<std::string> bodies{};
};

/// Contact quantities of one pair along the contact face, at the face's control points and at its quadrature
/// points. In self-contact of two parts that touch the one with the smaller parameter carries them, and gaps
/// are not larger than the reach, within which partners are looked for.
struct ContactRecord {
  std::string tool;    ///< empty in contact with a face of a body
  std::string pair{};  ///< name of the pair in contact with another face, else empty
  std::string face;
  int patch = 0;
  std::vector<int> nodes;              ///< global nodes of the face's control points
  Eigen::VectorXd pressure;            ///< -λ̂_A (>= 0 in compression), per control point, nominal
  Eigen::VectorXd averageGap;          ///< g_A per control point
  std::vector<int> active;             ///< 0 or 1 per control point
  Eigen::MatrixXd quadraturePoints;    ///< dim x points: current positions
  Eigen::VectorXd quadraturePressure;  ///< contact pressure (nominal) at these points
  Eigen::VectorXd quadratureGap;       ///< point-wise gap at these points
  Eigen::MatrixXd quadratureNormal;    ///< dim x points: of the tool or the other part, away from it; zero
                                       ///< without a partner

  // With friction, else empty.
  Eigen::MatrixXd quadratureFriction{};  ///< dim x points: tangential traction on the body, nominal
  Eigen::MatrixXd quadratureSlip{};      ///< dim x points: way of the body on the tool in the last step
  std::vector<int> quadratureSliding{};  ///< 0 open, 1 stick, 2 slip
  Eigen::VectorXd quadratureSlipped{};   ///< way slipped under pressure since the start; older results: empty
};

/// Raw values at the quadrature points of the volume.
struct QuadratureRecord {
  Eigen::MatrixXd positions;                  ///< dim x points, current configuration, body after body
  std::vector<int> numPoints;                 ///< of each body, if there are several
  std::map<std::string, FieldRecord> fields;  ///< `values` components x points
};

/// The immutable part of a result, written once.
struct ModelRecord {
  std::string program;  ///< "burnish 0.1.0"
  std::string title;
  std::string sceneYaml;  ///< resolved scene, every default filled in
  int dim = 2;
  std::string lengthUnit, stressUnit;
  MeshRecord mesh;                  ///< of the undeformed bodies, at the start
  std::vector<std::string> bodies;  ///< their names; empty for one without a name
  std::vector<ToolRecord> tools;
  int subdivision = 4;
};

/// Whether its scene says so.
bool isAxisymmetric(const ModelRecord& model);

/// One output instant. Nodes and patches are those of its mesh, see `meshOf`.
struct FrameRecord {
  int index = 0;
  int step = 0;
  double time = 0.0;
  /// If the body has been meshed anew, its mesh in this frame. A control point stands where the material that
  /// is there now was at the start, as nearly as the mesh can say.
  std::optional<MeshRecord> mesh;
  Eigen::MatrixXd displacement;               ///< dim x nodes, from the start on
  std::map<std::string, FieldRecord> fields;  ///< plastic_strain, von_mises, stress, pressure
  Eigen::MatrixXd toolDisplacement;           ///< of the pivots, dim x tools
  Eigen::VectorXd toolAngle;  ///< turn about the axes, radians, one per tool; empty if none is turned
  std::vector<ContactRecord> contact;
  QuadratureRecord quadrature;
};

/// The mesh that a frame's displacements, fields and contact belong to: its own or, without one, the model's.
inline const MeshRecord& meshOf(const ModelRecord& model, const FrameRecord& frame) {
  return frame.mesh ? *frame.mesh : model.mesh;
}

}  // namespace burnish::inline results
