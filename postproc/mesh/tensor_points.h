#pragma once
#include <Eigen/Dense>
#include <cstddef>
#include <optional>
#include <vector>

#include "engine/nurbs/univariate_basis.h"
#include "engine/results/result.h"
#include "postproc/mesh/index_box.h"

namespace burnish {

/// Points along one direction of a patch: what each makes of the p+1 functions of its span.
struct PointRow {
  int numFunctions = 0;            ///< of the direction
  std::vector<int> firstFunction;  ///< of the span of each point
  Eigen::MatrixXd factors;         ///< (p+1) x points
  Eigen::MatrixXd slopes{};  ///< their derivatives by the parameter; empty where nobody asks for tangents
};

/// Where a parameter between two spans belongs: the functions of both have the same values there, but not
/// always the same derivatives.
enum class SpanSide { Before, Behind };

/// Some neighbouring points of a row.
PointRow neighbouring(const PointRow& row, int first, int count);

/// The values of the functions at these parameters.
PointRow valuesAt(const UnivariateBasis& basis, const std::vector<double>& parameters);

/// The values and slopes of the functions at these parameters, in the span before or behind each.
PointRow slopesAt(const UnivariateBasis& basis, const std::vector<double>& parameters, SpanSide side);

/// Of which functions the Bernstein coefficients of all spans are made: p points per span, and one more.
PointRow bernsteinPoints(const UnivariateBasis& basis);

/// Points of a patch in rows and columns, one row per direction, first direction fastest. What they hold of a
/// field is computed one direction after the other, which takes p+1 products per direction and point.
class TensorPoints {
 public:
  /// directions: one per direction of the patch.
  TensorPoints(const PatchRecord& patch, std::vector<PointRow> directions);

  const IndexBox& box() const { return points_; }
  int size() const { return points_.size(); }

  /// What the points hold (components x points) of a field with these coefficients (components x nodes of the
  /// mesh). There must be one for every node of the patch.
  Eigen::MatrixXd evaluate(const Eigen::MatrixXd& coefficients) const;

  /// What they hold of the reference positions, dim x points.
  Eigen::MatrixXd referencePoints() const { return rational(patchPoints_); }

  /// The directions (components x points) in which the positions go with a direction of the patch whose row has
  /// slopes: derivatives times the weight Σ N_A w_A. displacement: dim x nodes; empty: undeformed.
  Eigen::MatrixXd tangents(std::size_t direction, const Eigen::MatrixXd& displacement) const;

  /// Σ N_A w_A of each point.
  const Eigen::VectorXd& weights() const { return weights_; }

 private:
  /// Σ R_A q_A, q: components x functions.
  Eigen::MatrixXd rational(const Eigen::MatrixXd& q) const;
  /// Σ N_A q_A; by the parameter of a direction, if one is given.
  Eigen::MatrixXd polynomial(Eigen::MatrixXd q, std::optional<std::size_t> slope = {}) const;

  std::vector<PointRow> directions_;
  IndexBox points_;
  // Of the functions that any of the points needs:
  IndexBox functions_;
  std::vector<int> nodes_;
  Eigen::MatrixXd patchPoints_;
  Eigen::VectorXd functionWeights_;
  bool equalWeights_ = false;  ///< the weights cancel
  Eigen::VectorXd weights_;
};

/// Lattices of points one after the other. No two of them share points.
class PointLattices {
 public:
  explicit PointLattices(int numNodes) : numNodes_(numNodes) {}

  void add(TensorPoints points);

  const std::vector<TensorPoints>& lattices() const { return lattices_; }
  int size() const { return size_; }

  /// As `TensorPoints`. Throws `Error` if the number of nodes does not fit.
  Eigen::MatrixXd evaluate(const Eigen::MatrixXd& coefficients) const;
  Eigen::MatrixXd referencePoints() const;
  Eigen::VectorXd weights() const;

  /// Positions, dim x points. displacement: dim x nodes; empty: undeformed. Throws `Error` if it does not
  /// fit.
  Eigen::MatrixXd positions(const Eigen::MatrixXd& displacement) const;

 private:
  int numNodes_;  ///< of the mesh
  int size_ = 0;
  std::vector<TensorPoints> lattices_;
};

}  // namespace burnish
