#include "engine/contact/face_contact.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>
#include <utility>

namespace burnish::inline contact {

template <int Dim>
void FaceContact<Dim>::keepInTouch(std::vector<const FaceContact*> others) {
  assert(options_.gapLimit.value_or(kAnyGap) == kAnyGap);
  keepsInTouch_ = true;
  others_ = std::move(others);
}

template <int Dim>
int FaceContact<Dim>::multiplierOf(int function, int component) const {
  if (component == 0) return firstMultiplier_ + function;
  return firstMultiplier_ + face_.numFunctions() + (Dim - 1) * function + component - 1;
}

template <int Dim>
Eigen::VectorXd FaceContact<Dim>::multipliers(int component, const Eigen::VectorXd& x) const {
  Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(face_.numFunctions());
  for (int a = 0; a < face_.numFunctions(); ++a)
    if (const int number = multiplierOf(a, component); number >= 0) coefficients(a) = x(number);
  return coefficients;
}

template <int Dim>
void FaceContact<Dim>::setMultipliers(int component, const Eigen::VectorXd& coefficients,
                                      Eigen::VectorXd& x) const {
  std::map<int, int> sharers;  // per number
  for (int a = 0; a < face_.numFunctions(); ++a) {
    const int number = multiplierOf(a, component);
    if (number < 0) continue;
    const int count = ++sharers[number];
    x(number) = count == 1 ? coefficients(a) : x(number) + (coefficients(a) - x(number)) / count;
  }
}

template <int Dim>
Eigen::VectorXd FaceContact<Dim>::functionWeights() const {
  if (hasAllMultipliers()) return A_.head(face_.numFunctions());
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(face_.numFunctions());
  for (const auto& span : face_.spans()) weights(span.functions) += span.R.cwiseAbs() * span.weights;
  return weights;
}

template <int Dim>
double FaceContact<Dim>::usefulPart(const Eigen::VectorXd& x, const Eigen::VectorXd& correction) const {
  constexpr double kLeast = 0.05;
  if (!hasAllMultipliers() || keepsInTouch_ || hasLostTouch_) return 1.0;
  const auto n = face_.numFunctions();
  const double force = A_.head(n).dot(x.segment(firstMultiplier_, n));
  const double change = A_.head(n).dot(correction.segment(firstMultiplier_, n));
  const bool pulls = force < 0.0 && force + change > 0.0;  // multipliers are negative under pressure
  return pulls ? std::max(kLeast, -force / change) : 1.0;
}

template <int Dim>
bool FaceContact<Dim>::isAlone() const {
  return std::none_of(others_.begin(), others_.end(), [](const FaceContact* other) {
    return other->state().pressure.size() > 0 && other->state().pressure.maxCoeff() > 0.0;
  });
}

template <int Dim>
Eigen::VectorXd FaceContact<Dim>::referenceGaps(const GapAt& gapAt) const {
  Eigen::VectorXd G = Eigen::VectorXd::Zero(face_.numFunctions());
  for (const auto& span : face_.spans()) {
    const Eigen::MatrixXd places = face_.points()(Eigen::all, span.functions) * span.R;
    for (Eigen::Index q = 0; q < places.cols(); ++q) {
      Eigen::Vector3d x = Eigen::Vector3d::Zero();
      x.head<Dim>() = places.col(q);
      const double gap = limitedGap(gapAt(x), options_.gapLimit.value_or(kAnyGap) * span.size).value;
      for (std::size_t a = 0; a < span.functions.size(); ++a)
        G(span.functions[a]) += span.weights(q) * span.R(static_cast<Eigen::Index>(a), q) * gap;
    }
  }
  return G.cwiseQuotient(A_.head(G.size()));
}

template <int Dim>
typename FaceContact<Dim>::Cover FaceContact<Dim>::coverAt(const Eigen::VectorXd& x,
                                                           const GapAt& gapAt) const {
  Cover cover{0.0, std::numeric_limits<double>::infinity()};
  for (const auto& span : face_.spans()) {
    Eigen::MatrixXd points = face_.points()(Eigen::all, span.functions);
    for (std::size_t a = 0; a < span.functions.size(); ++a)
      points.col(static_cast<Eigen::Index>(a)) +=
          x.template segment<Dim>(Dim * face_.nodes()[static_cast<std::size_t>(span.functions[a])]);
    const Eigen::MatrixXd places = points * span.R;
    for (Eigen::Index q = 0; q < places.cols(); ++q) {
      Eigen::Vector3d place = Eigen::Vector3d::Zero();
      place.head<Dim>() = places.col(q);
      const double gap = gapAt(place);
      cover.smallestGap = std::min(cover.smallestGap, gap);
      if (gap < 0.0) cover.area += span.weights(q);
    }
  }
  return cover;
}

template <int Dim>
void FaceContact<Dim>::clearState(bool hasFriction) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  state_ = {};
  state_.averageGap = Eigen::VectorXd::Constant(face_.numFunctions(), kInfinity);
  state_.lambdaHat = Eigen::VectorXd::Zero(face_.numFunctions());
  state_.gap = Eigen::VectorXd::Constant(face_.numPoints(), kInfinity);
  state_.pressure = Eigen::VectorXd::Zero(face_.numPoints());
  state_.normal = Eigen::MatrixXd::Zero(3, face_.numPoints());
  if (!hasFriction) return;
  state_.traction = state_.slip = Eigen::Matrix3Xd::Zero(3, face_.numPoints());
  state_.sliding.assign(static_cast<std::size_t>(face_.numPoints()), 0);
}

template <int Dim>
void FaceContact<Dim>::loseTouch() {
  hasLostTouch_ = true;
  reportUntouched();
}

template <int Dim>
bool FaceContact<Dim>::reportUntouched() {
  clearState(options_.hasFriction());
  if (!options_.hasFriction()) return true;
  state_.frictionWork = work_.work();
  reportSlipped();
  return true;
}

template <int Dim>
double FaceContact<Dim>::smallestGapOfPoints(const GapAt& gapAt) const {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& span : face_.spans())
    smallest =
        std::min(smallest, smallestGapAmong(face_.points()(Eigen::all, span.functions) * span.R, gapAt));
  return smallest;
}

template <int Dim>
double FaceContact<Dim>::smallestGapAmong(const Eigen::MatrixXd& places, const GapAt& gapAt) {
  double smallest = std::numeric_limits<double>::infinity();
  for (Eigen::Index k = 0; k < places.cols(); ++k) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    x.head<Dim>() = places.col(k);
    smallest = std::min(smallest, gapAt(x));
  }
  return smallest;
}

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
      state_.slipped(number) = slipped_(span.functions).dot(span.R.col(q)) + slipUnderPressure(number);
    }
}

template <int Dim>
void FaceContact<Dim>::acceptSlipped() {
  Eigen::VectorXd inStep = Eigen::VectorXd::Zero(slipped_.size()), weights = inStep;
  for (const auto& span : face_.spans())
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const Eigen::VectorXd wR = span.weights(q) * span.R.col(q);
      weights(span.functions) += wR;
      inStep(span.functions) += slipUnderPressure(span.firstPoint + q) * wR;
    }
  slipped_ += inStep.cwiseQuotient(weights);
}

template class FaceContact<2>;
template class FaceContact<3>;

}  // namespace burnish::inline contact
