#include "engine/fields/face_measure.h"

#include <set>
#include <utility>

#include "engine/core/error.h"

namespace burnish::inline fields {

template <int Dim>
FaceMeasure<Dim>::FaceMeasure(FaceQuadrature<Dim> face, std::vector<const LoadTerm*> elsewhere)
    : face_(std::move(face)), elsewhere_(std::move(elsewhere)) {
  for (const auto& span : face_.spans()) area_ += span.weights.sum();
  if (!(area_ > 0.0))
    throw Error("the face has no area: it is collapsed or lies on the axis of revolution; name another one");
}

template <int Dim>
std::vector<std::string> FaceMeasure<Dim>::columns() const {
  if constexpr (Dim == 2)
    return {"ux", "uy", "fx", "fy"};
  else
    return {"ux", "uy", "uz", "fx", "fy", "fz"};
}

template <int Dim>
std::vector<double> FaceMeasure<Dim>::values(const MeasuredState& state) const {
  using Vector = Eigen::Vector<double, Dim>;
  Vector displacement = Vector::Zero(), force = Vector::Zero();
  std::set<int> nodes;
  for (const auto& span : face_.spans()) {
    for (std::size_t a = 0; a < span.functions.size(); ++a) {
      const int node = face_.nodes()[static_cast<std::size_t>(span.functions[a])];
      nodes.insert(node);
      displacement += span.R.row(static_cast<Eigen::Index>(a)).dot(span.weights) *
                      state.x.template segment<Dim>(Dim * node);
    }
  }
  for (const int node : nodes) {
    force += state.bulkForce.template segment<Dim>(Dim * node);
    for (const LoadTerm* load : elsewhere_) force -= load->nodalForces().template segment<Dim>(Dim * node);
  }
  displacement /= area_;
  std::vector<double> result(displacement.begin(), displacement.end());
  result.insert(result.end(), force.begin(), force.end());
  return result;
}

template class FaceMeasure<2>;
template class FaceMeasure<3>;

}  // namespace burnish::inline fields
