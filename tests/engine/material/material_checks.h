#pragma once
#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/material/response.h"
#include "engine/material/symmetric_tensor.h"

/// Evaluation and numerical differentiation of material laws, for tests.
namespace burnish::test {

template <int Dim, class Law>
struct Evaluated {
  MaterialResponse<Dim> response;
  typename Law::State state;
};

template <int Dim, class Law>
Evaluated<Dim, Law> evaluate(const Law& law, const Eigen::Matrix3d& F, const typename Law::State& old = {}) {
  Evaluated<Dim, Law> result;
  if (!law.template evaluate<Dim>(F, old, result.state, result.response))
    throw std::runtime_error("the law refused a deformation gradient");
  return result;
}

/// Velocity gradients e_k ⊗ e_l that keep the structure of F: all nine, or in 2D the plane and the third
/// direction.
template <int Dim>
bool isAdmissible(int k, int l) {
  return Dim == 3 || (k < 2 && l < 2) || (k == 2 && l == 2);
}

/// Order of central differences. The eighth, which reaches to 4 h, is for responses without a yield surface.
enum class Differences { Fourth, Eighth };

/// d/dh of f((I + h L) F) at h = 0 by central differences.
template <class Function>
auto derivative(const Function& f, const Eigen::Matrix3d& F, const Eigen::Matrix3d& L, double h,
                Differences order = Differences::Fourth) -> decltype(f(F)) {
  const auto at = [&](double s) { return f(((Eigen::Matrix3d::Identity() + s * L) * F).eval()); };
  if (order == Differences::Fourth)
    return (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
  return (672.0 * (at(h) - at(-h)) - 168.0 * (at(2.0 * h) - at(-2.0 * h)) +
          32.0 * (at(3.0 * h) - at(-3.0 * h)) - 3.0 * (at(4.0 * h) - at(-4.0 * h))) /
         (840.0 * h);
}

/// Largest difference between c : L and the Lie derivative of τ, over all L = e_k ⊗ e_l, relative to the
/// largest component of c. The antisymmetric part of L must not count.
template <int Dim, class Law>
double tangentError(const Law& law, const Eigen::Matrix3d& F, const typename Law::State& old, double h,
                    Differences order = Differences::Fourth) {
  const auto stress = [&](const Eigen::Matrix3d& G) -> Eigen::Matrix3d {
    return fullTensor<Dim>(evaluate<Dim>(law, G, old).response.tau);
  };
  const MaterialResponse<Dim> response = evaluate<Dim>(law, F, old).response;
  const Eigen::Matrix3d tau = fullTensor<Dim>(response.tau);
  double worst = 0.0;
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      if (!isAdmissible<Dim>(k, l)) continue;
      Eigen::Matrix3d L = Eigen::Matrix3d::Zero();
      L(k, l) = 1.0;
      const Eigen::Matrix3d lie = derivative(stress, F, L, h, order) - L * tau - tau * L.transpose();
      SymmetricTensor<Dim> strain = components<Dim>(0.5 * (L + L.transpose()));
      strain.template tail<kVoigt<Dim> - 3>() *= 2.0;
      const SymmetricTensor<Dim> difference = response.c * strain - components<Dim>(lie);
      worst = std::max(worst, difference.cwiseAbs().maxCoeff());
    }
  return worst / response.c.cwiseAbs().maxCoeff();
}

/// Largest difference between τ : L and the derivative of the stored energy, relative to `scale`.
template <int Dim, class Law>
double stressError(const Law& law, const Eigen::Matrix3d& F, const typename Law::State& old, double h,
                   double scale) {
  const auto energy = [&](const Eigen::Matrix3d& G) {
    return evaluate<Dim>(law, G, old).response.strainEnergy;
  };
  const Eigen::Matrix3d tau = fullTensor<Dim>(evaluate<Dim>(law, F, old).response.tau);
  double worst = 0.0;
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      if (!isAdmissible<Dim>(k, l)) continue;
      Eigen::Matrix3d L = Eigen::Matrix3d::Zero();
      L(k, l) = 1.0;
      worst = std::max(worst, std::abs(derivative(energy, F, L, h) - tau(k, l)));
    }
  return worst / scale;
}

/// A rotation about z in 2D, about a skew axis in 3D.
template <int Dim>
Eigen::Matrix3d rotation(double angle) {
  const Eigen::Vector3d axis =
      Dim == 2 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d(1.0, -2.0, 0.5).normalized();
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

/// A deformation gradient with these principal stretches, rotated before and after.
template <int Dim>
Eigen::Matrix3d stretched(double a, double b, double c) {
  return rotation<Dim>(0.7) * Eigen::Vector3d(a, b, c).asDiagonal() * rotation<Dim>(-0.3);
}

/// A deformation gradient with shear, volume change and rotation.
template <int Dim>
Eigen::Matrix3d skewed(double amount) {
  Eigen::Matrix3d H;
  H << 0.5, 1.1, -0.3, -0.4, -0.7, 0.6, 0.2, 0.9, 0.8;
  if constexpr (Dim == 2) {
    H.row(2).head<2>().setZero();
    H.col(2).head<2>().setZero();
  }
  return Eigen::Matrix3d::Identity() + amount * H;
}

}  // namespace burnish::test
