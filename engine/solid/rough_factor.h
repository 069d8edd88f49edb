#pragma once
#include <Eigen/Dense>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace burnish::inline solid {

/// A matrix whose columns are kept as whole numbers times a scale, off by no more than 1.6e-5 of a column's largest number:
/// where one multiplies by many of them, most of the time goes into fetching them, and this is a quarter of doubles.
class RoughFactor {
 public:
  /// Matrices of finite numbers with one number of rows, at least one, beside one another.
  void assign(std::initializer_list<const Eigen::MatrixXd*> matrices);

  /// y = Aᵀ x. x: one number for each row; y: for each column.
  void timesTransposed(const Eigen::VectorXf& x, Eigen::Ref<Eigen::VectorXd> y) const;

  /// y = A x. x: one number for each column; y becomes the numbers of the rows, and some zeros.
  void times(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::VectorXf& y) const;

 private:
  Eigen::Index stride_ = 0;            ///< rows, with some zeros below them
  std::vector<float> scales_;          ///< of columns
  std::vector<std::int16_t> numbers_;  ///< column by column
};

}  // namespace burnish::inline solid
