#include "engine/contact/face_contact.h"

#include <utility>

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

template <int Dim>
Eigen::Vector3d FaceContact<Dim>::referencePlace(const std::vector<int>& functions,
                                                 const Eigen::Ref<const Eigen::VectorXd>& R) const {
  Eigen::Vector3d X = Eigen::Vector3d::Zero();
  X.template head<Dim>() = face_.points()(Eigen::all, functions) * R;
  return X;
}

template <int Dim>
void FaceContact<Dim>::continueFriction(double work, Eigen::VectorXd slipped) {
  work_.continueFrom(work);
  slipped_ = std::move(slipped);
}

template <int Dim>
void FaceContact<Dim>::reportSlipped() {
  state_.slipped.resize(face_.numPoints());
  for (const auto& span : face_.spans())
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const Eigen::Index number = span.firstPoint + q;
      const double inStep = state_.pressure(number) > 0.0 ? state_.slip.col(number).norm() : 0.0;
      state_.slipped(number) = slipped_(span.functions).dot(span.R.col(q)) + inStep;
    }
}

template <int Dim>
void FaceContact<Dim>::acceptSlipped() {
  Eigen::VectorXd inStep = Eigen::VectorXd::Zero(slipped_.size()), weights = inStep;
  for (const auto& span : face_.spans())
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const Eigen::Index number = span.firstPoint + q;
      const Eigen::VectorXd wR = span.weights(q) * span.R.col(q);
      weights(span.functions) += wR;
      if (state_.pressure(number) > 0.0) inStep(span.functions) += state_.slip.col(number).norm() * wR;
    }
  slipped_ += inStep.cwiseQuotient(weights);
}

template class FaceContact<2>;
template class FaceContact<3>;

}  // namespace burnish
