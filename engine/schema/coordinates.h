#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <iterator>
#include <vector>

namespace burnish::inline schema {

/// Coordinates as a document gives them, in a space of three dimensions: those that are not given are zero.
class Coordinates : public Eigen::Vector3d {
 public:
  /// None is given.
  Coordinates() : Eigen::Vector3d(Eigen::Vector3d::Zero()) {}

  Coordinates(double x, double y) : Eigen::Vector3d(x, y, 0.0), entries_(2) {}
  Coordinates(double x, double y, double z) : Eigen::Vector3d(x, y, z), entries_(3) {}

  template <class Derived>
  Coordinates(const Eigen::MatrixBase<Derived>& vector) : Eigen::Vector3d(vector), entries_(3) {}

  /// Of more than three the first ones.
  explicit Coordinates(const std::vector<double>& given) : Coordinates() {
    entries_ = std::min<Eigen::Index>(std::ssize(given), 3);
    std::copy_n(given.begin(), entries_, begin());
  }

  template <class Derived>
  Coordinates& operator=(const Eigen::MatrixBase<Derived>& vector) {
    return *this = Coordinates(vector);
  }

  bool empty() const { return entries_ == 0; }

  /// Those that were given.
  std::vector<double> given() const { return {begin(), begin() + entries_}; }

 private:
  Eigen::Index entries_ = 0;
};

/// A place and a vector of any length. A document gives as many entries as the scene has dimensions.
using Point = Coordinates;
using Direction = Coordinates;

}  // namespace burnish::inline schema
