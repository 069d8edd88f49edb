#include "engine/solid/rough_factor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace burnish::inline solid {
namespace {

/// Rows that are gone through together, in sums of their own: the compiler must not change the order of one sum.
constexpr Eigen::Index kLanes = 16;

constexpr double kLargest = 32767.0;

}  // namespace

void RoughFactor::assign(std::initializer_list<const Eigen::MatrixXd*> matrices) {
  const Eigen::Index rows = (*matrices.begin())->rows();
  stride_ = (rows + kLanes - 1) / kLanes * kLanes;
  Eigen::Index columns = 0;
  for (const Eigen::MatrixXd* matrix : matrices) columns += matrix->cols();
  scales_.resize(static_cast<std::size_t>(columns));
  numbers_.assign(static_cast<std::size_t>(stride_ * columns), 0);
  std::int16_t* into = numbers_.data();
  float* scale = scales_.data();
  for (const Eigen::MatrixXd* matrix : matrices)
    for (Eigen::Index j = 0; j < matrix->cols(); ++j, into += stride_) {
      const double largest = matrix->col(j).cwiseAbs().maxCoeff();
      *scale++ = static_cast<float>(largest / kLargest);
      if (!(largest > 0.0)) continue;
      const double perUnit = kLargest / largest;
      for (Eigen::Index i = 0; i < rows; ++i)
        into[i] = static_cast<std::int16_t>(std::lround(perUnit * (*matrix)(i, j)));
    }
}

void RoughFactor::timesTransposed(const Eigen::VectorXf& x, Eigen::Ref<Eigen::VectorXd> y) const {
  thread_local std::vector<float> padded;
  padded.assign(static_cast<std::size_t>(stride_), 0.0F);
  std::copy(x.begin(), x.end(), padded.begin());
  const std::int16_t* number = numbers_.data();
  for (std::size_t j = 0; j < scales_.size(); ++j) {
    std::array<float, kLanes> sums{};
    for (Eigen::Index i = 0; i < stride_; i += kLanes, number += kLanes)
      for (Eigen::Index k = 0; k < kLanes; ++k)
        sums[static_cast<std::size_t>(k)] +=
            static_cast<float>(number[k]) * padded[static_cast<std::size_t>(i + k)];
    float sum = 0.0F;
    for (const float part : sums) sum += part;
    y(static_cast<Eigen::Index>(j)) = scales_[j] * sum;
  }
}

void RoughFactor::times(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::VectorXf& y) const {
  y.setZero(stride_);
  float* const into = y.data();
  const std::int16_t* number = numbers_.data();
  for (std::size_t j = 0; j < scales_.size(); ++j, number += stride_) {
    const float factor = scales_[j] * static_cast<float>(x(static_cast<Eigen::Index>(j)));
    for (Eigen::Index i = 0; i < stride_; ++i) into[i] += factor * static_cast<float>(number[i]);
  }
}

}  // namespace burnish::inline solid
