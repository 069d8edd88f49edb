#include "engine/material/neo_hookean.h"

#include <cmath>

#include "engine/material/symmetric_tensor.h"
#include "engine/material/volume_change.h"

namespace burnish::inline material {

template <int Dim>
bool NeoHookean::evaluate(const Eigen::Matrix3d& F, const State&, State&, MaterialResponse<Dim>& out) const {
  const Eigen::Matrix3d H = F - Eigen::Matrix3d::Identity();
  const VolumeChange volume(H);
  if (!(volume.J() > 0.0)) return false;
  const double mu = moduli_.mu;
  const double lambda = moduli_.lambda;
  const double logJ = std::log1p(volume.minusOne());
  const double halfJ2 = volume.minusOne() * (1.0 + 0.5 * volume.minusOne());  // ½(J² − 1)

  double U = 0.5 * lambda * logJ * logJ;
  double pressure = lambda * logJ;  // J U'
  double stiffness = lambda;        // d(J U')/d(ln J)
  if (parameters_.volumetric == Volumetric::Simo) {
    U = 0.5 * lambda * (halfJ2 - logJ);
    pressure = lambda * halfJ2;
    stiffness = lambda * (1.0 + 2.0 * halfJ2);
  }

  const Eigen::Matrix3d bMinusOne = H + H.transpose() + H * H.transpose();
  out.tau = mu * components<Dim>(bMinusOne) + pressure * identityComponents<Dim>();
  out.c = isotropicTangent<Dim>(stiffness, 2.0 * (mu - pressure));
  // tr C − 3 − 2 ln J with the parts of first order taken out
  const double shear = H.squaredNorm() - 2.0 * volume.higher + 2.0 * (volume.minusOne() - logJ);
  out.strainEnergy = 0.5 * mu * shear + U;
  out.plasticWork = 0.0;
  return std::isfinite(out.strainEnergy) && std::isfinite(out.tau.sum());
}

template bool NeoHookean::evaluate<2>(const Eigen::Matrix3d&, const State&, State&,
                                      MaterialResponse<2>&) const;
template bool NeoHookean::evaluate<3>(const Eigen::Matrix3d&, const State&, State&,
                                      MaterialResponse<3>&) const;

}  // namespace burnish::inline material
