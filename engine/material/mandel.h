#pragma once
#include <Eigen/Core>
#include <numbers>

#include "engine/material/symmetric_tensor.h"

/// Symmetric tensors as vectors in the order of `kVoigt` with shears times √2 (Mandel's notation): the scalar product of
/// tensors is that of the vectors, and a fourth-order tensor with its minor symmetries is a matrix that multiplies them.
namespace burnish::inline material {

template <int Dim>
using MandelVector = Eigen::Matrix<double, kVoigt<Dim>, 1>;
template <int Dim>
using MandelMatrix = Eigen::Matrix<double, kVoigt<Dim>, kVoigt<Dim>>;

/// What components are multiplied by: 1, and √2 for shears.
template <int Dim>
MandelVector<Dim> mandelFactors() {
  MandelVector<Dim> factors = MandelVector<Dim>::Constant(std::numbers::sqrt2);
  factors.template head<3>().setOnes();
  return factors;
}

/// For Dim 2 the components that couple the plane with the third direction are dropped.
template <int Dim>
MandelVector<Dim> toMandel(const Eigen::Matrix3d& T) {
  return components<Dim>(T).cwiseProduct(mandelFactors<Dim>());
}

template <int Dim>
Eigen::Matrix3d fromMandel(const MandelVector<Dim>& T) {
  return fullTensor<Dim>(T.cwiseQuotient(mandelFactors<Dim>()));
}

/// The orthogonal matrix that makes components in fixed axes from those in axes n_A, the columns of `directions`.
template <int Dim>
MandelMatrix<Dim> mandelRotation(const Eigen::Matrix3d& directions) {
  MandelMatrix<Dim> rotation;
  for (int k = 0; k < kVoigt<Dim>; ++k) {
    const int A = k % 3, B = k < 3 ? A : (k + 1) % 3;
    const Eigen::Matrix3d product = directions.col(A) * directions.col(B).transpose();
    rotation.col(k) = toMandel<Dim>(
        k < 3 ? product : Eigen::Matrix3d((product + product.transpose()) / std::numbers::sqrt2));
  }
  return rotation;
}

}  // namespace burnish::inline material
