#pragma once
#include <Eigen/Sparse>
#include <vector>

namespace burnish::inline solver {

/// That products are computed in. Rough ones are as linear, and the same every time, but of a tangent that is off by a few
/// hundred-thousandths of its factors: enough to precondition with.
enum class Precision { Full, Rough };

/// A symmetric part of a tangent that couples so many unknowns, by narrow factors, that one multiplies by it
/// instead of keeping its entries.
class TangentProduct {
 public:
  virtual ~TangentProduct() = default;

  /// Adds the product with x to y, both over all unknowns; unknowns that have no part in it may stand behind
  /// the others. Where ranks divide the unknowns, all call it together, each with those of x that are coupled with
  /// its own unknowns, for which y is then complete.
  virtual void addTimes(const Eigen::VectorXd& x, Eigen::VectorXd& y, Precision precision) const = 0;

  /// Its entries, for those who cannot do without: size x size, in the rows and columns with the numbers that
  /// are given for all unknowns, where -1 leaves one out. Of the same pattern every time. For a process alone.
  virtual Eigen::SparseMatrix<double> entries(const std::vector<int>& numbers, int size) const = 0;
};

}  // namespace burnish::inline solver
