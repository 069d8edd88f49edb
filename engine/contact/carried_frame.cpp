#include "engine/contact/carried_frame.h"

namespace burnish::inline contact {

template <int Dim>
CarriedFrame<Dim> carriedFrame(const Eigen::Matrix<double, Dim, Dim - 1>& origin,
                               const Eigen::Vector<double, Dim>& originNormal,
                               const Eigen::Vector<double, Dim>& normal) {
  CarriedFrame<Dim> frame;
  if constexpr (Dim == 2) {
    frame.vectors << normal(1), -normal(0);
    frame.byNormal[0] << 0.0, 1.0, -1.0, 0.0;
  } else {
    const Eigen::Vector3d sum = originNormal + normal;
    const double c = 1.0 + originNormal.dot(normal);
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector3d E = origin.col(k);
      const double across = normal.dot(E);
      frame.vectors.col(k) = E - across / c * sum;
      frame.byNormal[static_cast<std::size_t>(k)] =
          -(sum * E.transpose() + across * Eigen::Matrix3d::Identity()) / c +
          across / (c * c) * sum * originNormal.transpose();
    }
  }
  return frame;
}

template <int Dim>
Eigen::Matrix<double, Dim, Dim - 1> anyFrame(const Eigen::Vector<double, Dim>& normal) {
  Eigen::Matrix<double, Dim, Dim - 1> frame;
  if constexpr (Dim == 2) {
    frame << normal(1), -normal(0);
  } else {
    frame.col(0) = normal.unitOrthogonal();
    frame.col(1) = normal.cross(frame.col(0));
  }
  return frame;
}

template CarriedFrame<2> carriedFrame(const Eigen::Matrix<double, 2, 1>&, const Eigen::Vector2d&,
                                      const Eigen::Vector2d&);
template CarriedFrame<3> carriedFrame(const Eigen::Matrix<double, 3, 2>&, const Eigen::Vector3d&,
                                      const Eigen::Vector3d&);
template Eigen::Matrix<double, 2, 1> anyFrame(const Eigen::Vector2d&);
template Eigen::Matrix<double, 3, 2> anyFrame(const Eigen::Vector3d&);

}  // namespace burnish::inline contact
