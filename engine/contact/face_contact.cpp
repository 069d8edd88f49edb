#include "engine/contact/face_contact.h"

namespace burnish {

template <int Dim>
double FaceContact<Dim>::areaStretch(const std::vector<int>& functions,
                                     const Eigen::Ref<const Eigen::MatrixXd>& points,
                                     const Eigen::Ref<const Eigen::VectorXd>& R,
                                     const Eigen::Ref<const Eigen::MatrixXd>& dR) const {
  const Eigen::MatrixXd reference = face_.points()(Eigen::all, functions);
  const auto areaOf = [&](const Eigen::MatrixXd& at) {
    const Eigen::Matrix<double, Dim, Dim - 1> tangents = at * dR;
    return areaVector<Dim>(tangents).norm();
  };
  const double stretch = areaOf(points) / areaOf(reference);
  if (!axisymmetric_) return stretch;
  const double radius = reference.row(0) * R;
  return radius > 0.0 ? stretch * points.row(0).dot(R) / radius : stretch * stretch;
}

template class FaceContact<2>;
template class FaceContact<3>;

}  // namespace burnish
