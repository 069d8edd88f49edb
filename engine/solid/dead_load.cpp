#include "engine/solid/dead_load.h"

#include <algorithm>
#include <utility>

namespace burnish::inline solid {
namespace {

template <int Dim>
Eigen::Matrix3Xd padded(const Eigen::MatrixXd& positions) {
  Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, positions.cols());
  result.template topRows<Dim>() = positions;
  return result;
}

bool dependOnTime(const std::vector<Formula>& formulas) {
  return std::any_of(formulas.begin(), formulas.end(), [](const Formula& f) { return f.dependsOn("t"); });
}

}  // namespace

template <int Dim>
DeadLoad<Dim>::DeadLoad(const Body<Dim>& body, const FaceQuadrature<Dim>& face,
                        std::vector<Formula> components, Schedule factor)
    : components_(std::move(components)), factor_(std::move(factor)), varies_(dependOnTime(components_)) {
  for (const auto& span : face.spans()) {
    Span own{{}, span.R * span.weights.asDiagonal(), {}};
    for (const int a : span.functions) own.nodes.push_back(face.nodes()[static_cast<std::size_t>(a)]);
    own.X = padded<Dim>(face.points()(Eigen::all, span.functions) * span.R);
    spans_.push_back(std::move(own));
  }
  forces_.setZero(Dim * body.numNodes);
  unit_ = integrate(unitTime_);
}

template <int Dim>
DeadLoad<Dim>::DeadLoad(const Body<Dim>& body, const SpanQuadrature<Dim>& quadrature, int patch,
                        std::vector<Formula> components, Schedule factor)
    : components_(std::move(components)), factor_(std::move(factor)), varies_(dependOnTime(components_)) {
  const Eigen::MatrixXd nodes = body.nodePositions();
  Eigen::MatrixXd buffer;
  for (const auto& span : quadrature.spans()) {
    if (patch >= 0 && span.patch != patch) continue;
    const Eigen::MatrixXd& R = span.values(buffer);
    spans_.push_back(
        {span.nodes, R * span.weights.asDiagonal(), padded<Dim>(nodes(Eigen::all, span.nodes) * R)});
  }
  forces_.setZero(Dim * body.numNodes);
  unit_ = integrate(unitTime_);
}

template <int Dim>
Eigen::VectorXd DeadLoad<Dim>::integrate(double t) const {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(forces_.size());
  for (const Span& span : spans_) {
    Eigen::MatrixXd values(span.X.cols(), Dim);
    for (Eigen::Index q = 0; q < span.X.cols(); ++q)
      for (int d = 0; d < Dim; ++d) values(q, d) = components_[static_cast<std::size_t>(d)](span.X.col(q), t);
    const Eigen::MatrixXd nodal = span.weightedR * values;
    for (std::size_t a = 0; a < span.nodes.size(); ++a)
      load.segment<Dim>(Dim * span.nodes[a]) += nodal.row(static_cast<Eigen::Index>(a)).transpose();
  }
  return load;
}

template <int Dim>
bool DeadLoad<Dim>::evaluate(double time, const Eigen::VectorXd&, Assembly& out) {
  const double t = std::max(time, 0.0);  // lifted tools come down before
  if (varies_ && t != unitTime_) {
    unit_ = integrate(t);
    unitTime_ = t;
  }
  forces_ = (factor_.times.empty() ? 1.0 : factor_(t)) * unit_;
  out.force.head(forces_.size()) -= forces_;
  return true;
}

template <int Dim>
void DeadLoad<Dim>::requireFinite(const std::vector<double>& times) const {
  Eigen::Index count = 0;
  for (const Span& span : spans_) count += span.X.cols();
  Eigen::Matrix3Xd points(3, count);
  for (Eigen::Index next = 0; const Span& span : spans_) {
    points.middleCols(next, span.X.cols()) = span.X;
    next += span.X.cols();
  }
  burnish::requireFinite(components_, points, times);
}

template class DeadLoad<2>;
template class DeadLoad<3>;

}  // namespace burnish::inline solid
