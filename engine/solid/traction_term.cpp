#include "engine/solid/traction_term.h"

#include <utility>

#include "engine/solid/face_quadrature.h"

namespace burnish {

template <int Dim>
TractionTerm<Dim>::TractionTerm(const Body<Dim>& body, int patch, FaceId face,
                                const Eigen::Vector<double, Dim>& traction, Schedule factor)
    : unitLoad_(Eigen::VectorXd::Zero(Dim * body.numNodes)), factor_(std::move(factor)) {
  const FaceQuadrature<Dim> quadrature(body, patch, face, 0);
  for (const auto& span : quadrature.spans())
    for (std::size_t a = 0; a < span.functions.size(); ++a) {
      const int node = quadrature.nodes()[static_cast<std::size_t>(span.functions[a])];
      unitLoad_.segment<Dim>(Dim * node) +=
          span.R.row(static_cast<Eigen::Index>(a)).dot(span.weights) * traction;
    }
}

template <int Dim>
Eigen::VectorXd TractionTerm<Dim>::load(double t) const {
  return (factor_.times.empty() ? 1.0 : factor_(t)) * unitLoad_;
}

template <int Dim>
bool TractionTerm<Dim>::evaluate(double t, const Eigen::VectorXd&, Assembly& out) {
  out.force.head(unitLoad_.size()) -= load(t);
  return true;
}

template class TractionTerm<2>;
template class TractionTerm<3>;

}  // namespace burnish
