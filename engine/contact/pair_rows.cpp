#include "engine/contact/pair_rows.h"

namespace burnish::inline contact {

template <int Dim>
PairRows<Dim>::PairRows(const Eigen::Ref<const Eigen::VectorXd>& R, const Foot<Dim>& foot, int others)
    : foot_(foot), slaves_(R.size()), size_(Dim * (R.size() + foot.point.shape.R.size() + others)), R_(R) {
  const SurfacePoint<Dim>& point = foot.point;
  difference_ = -shiftedBy(point.shape.R);
  for (Eigen::Index k = 0; k < slaves_; ++k)
    difference_.template middleCols<Dim>(Dim * k).diagonal().array() += R(k);

  // Parameters that stay are decoupled from the others, and then taken out.
  Parameters m = point.tangents.transpose() * point.tangents;
  for (int i = 0; i < P; ++i)
    for (int j = 0; j < P; ++j) {
      const bool move = foot.moves[static_cast<std::size_t>(i)] && foot.moves[static_cast<std::size_t>(j)];
      kappa_(i, j) = move ? foot.normal.dot(point.curvatures.col(secondDerivative(i, j))) : 0.0;
      if (!move) m(i, j) = i == j ? 1.0 : 0.0;
    }
  mInverse_ = m.inverse();
  hInverse_ = (m - foot.gap * kappa_).eval().inverse();
  a_ = point.tangents.transpose() * difference_;
  b_.resize(P, size_);
  for (int i = 0; i < P; ++i) {
    b_.row(i) = foot.normal.transpose() * shiftedBy(point.shape.dR.col(i));
    if (foot.moves[static_cast<std::size_t>(i)]) continue;
    mInverse_(i, i) = hInverse_(i, i) = 0.0;
    a_.row(i).setZero();
    b_.row(i).setZero();
  }
  dual_ = point.tangents * mInverse_;
  dEta_ = hInverse_ * (a_ + foot.gap * b_);
  edge_ = foot.edgeCurvature * (Eigen::Matrix<double, Dim, Dim>::Identity() -
                                foot.normal * foot.normal.transpose() - dual_ * point.tangents.transpose());
  dNormal_ = -dual_ * (b_ + kappa_ * dEta_);
  if (foot.edgeCurvature != 0.0) dNormal_ += edge_ * difference_;
}

/// Σ values_b δy_b over the nodes of the foot.
template <int Dim>
typename PairRows<Dim>::Rows PairRows<Dim>::shiftedBy(const Eigen::Ref<const Eigen::VectorXd>& values) const {
  Rows rows = Rows::Zero(Dim, size_);
  for (Eigen::Index k = 0; k < values.size(); ++k)
    rows.template middleCols<Dim>(Dim * (slaves_ + k)).diagonal().setConstant(values(k));
  return rows;
}

template <int Dim>
Eigen::MatrixXd PairRows<Dim>::d2Gap() const {
  const Eigen::MatrixXd mixed = a_.transpose() * (hInverse_ * b_);
  const Parameters turn = mInverse_ * kappa_ * hInverse_;
  Eigen::MatrixXd second = -mixed - mixed.transpose();
  second -= a_.transpose() * (0.5 * (turn + turn.transpose())) * a_;
  second -= foot_.gap * b_.transpose() * hInverse_ * b_;
  if (foot_.edgeCurvature != 0.0) second += difference_.transpose() * edge_ * difference_;
  return second;
}

template <int Dim>
typename PairRows<Dim>::Rows PairRows<Dim>::differenceTo(const Eigen::Ref<const Eigen::VectorXd>& R,
                                                         const std::vector<int>& nodes) const {
  Rows rows = Rows::Zero(Dim, size_);
  for (Eigen::Index k = 0; k < slaves_; ++k)
    rows.template middleCols<Dim>(Dim * k).diagonal().setConstant(R_(k));
  for (std::size_t k = 0; k < nodes.size(); ++k)
    rows.template middleCols<Dim>(Dim * (slaves_ + nodes[k])).diagonal().array() -=
        R(static_cast<Eigen::Index>(k));
  return rows;
}

template <int Dim>
typename PairRows<Dim>::FrameRows PairRows<Dim>::dSlip(const CarriedFrame<Dim>& frame, const Vector& way,
                                                       const Rows& difference) const {
  FrameRows rows = difference.transpose() * frame.vectors;
  for (int k = 0; k < P; ++k)
    rows.col(k) += dNormal_.transpose() * (frame.byNormal[static_cast<std::size_t>(k)].transpose() * way);
  return rows;
}

template <int Dim>
typename PairRows<Dim>::FrameRows PairRows<Dim>::virtualSlip(const CarriedFrame<Dim>& frame) const {
  return difference_.transpose() * frame.vectors +
         foot_.gap * b_.transpose() * (dual_.transpose() * frame.vectors);
}

template <int Dim>
Eigen::MatrixXd PairRows<Dim>::frictionTangent(const Vector& traction,
                                               const Eigen::Matrix<double, Dim, Dim>& byNormal) const {
  const SurfacePoint<Dim>& point = foot_.point;
  const double g = foot_.gap;
  const Rows dTraction = byNormal * dNormal_;
  Eigen::MatrixXd K = difference_.transpose() * dTraction;
  const Eigen::Vector<double, P> c = dual_.transpose() * traction;
  Vector rest = traction;
  for (int i = 0; i < P; ++i) rest -= c(i) * point.tangents.col(i);

  Eigen::Matrix<double, P, Eigen::Dynamic> dc = dual_.transpose() * dTraction;
  const Eigen::RowVectorXd dGapRow = dGap().transpose();
  for (int j = 0; j < P; ++j) {
    if (!foot_.moves[static_cast<std::size_t>(j)]) continue;
    const Rows dTangent = shiftedBy(point.shape.dR.col(j));
    Rows total = dTangent;
    for (int k = 0; k < P; ++k) total += point.curvatures.col(secondDerivative(j, k)) * dEta_.row(k);
    dc -= c(j) * (dual_.transpose() * total);
    dc += mInverse_.col(j) * (rest.transpose() * total);
    K -= (dTangent.transpose() * traction) * dEta_.row(j);
    K += c(j) * b_.row(j).transpose() * dGapRow;
    K += g * c(j) * dTangent.transpose() * dNormal_;
    for (int k = 0; k < P; ++k) {
      const Eigen::VectorXd turn =
          shiftedBy(point.shape.ddR.col(secondDerivative(j, k))).transpose() * foot_.normal;
      K += g * c(j) * turn * dEta_.row(k);
    }
  }
  K += g * b_.transpose() * dc;
  return K;
}

template class PairRows<2>;
template class PairRows<3>;

}  // namespace burnish::inline contact
