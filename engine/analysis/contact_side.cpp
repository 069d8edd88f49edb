#include "engine/analysis/contact_side.h"

#include "engine/solid/face_quadrature.h"

namespace burnish::inline analysis {

template <int Dim>
double forceFromInside(const Body<Dim>& body, const ContactPair<Dim>& pair, const Eigen::VectorXd& x) {
  const auto& face = pair.term->face();
  const ContactState& state = pair.term->state();
  const double outward =
      outwardSign(body.patches[static_cast<std::size_t>(pair.place.patch)], pair.place.face);
  double all = 0.0, inside = 0.0;
  for (const auto& span : face.spans()) {
    Eigen::MatrixXd points(Dim, span.functions.size());
    for (std::size_t a = 0; a < span.functions.size(); ++a) {
      const int function = span.functions[a];
      const int node = face.nodes()[static_cast<std::size_t>(function)];
      points.col(static_cast<Eigen::Index>(a)) = face.points().col(function) + x.segment<Dim>(Dim * node);
    }
    for (Eigen::Index q = 0; q < span.weights.size(); ++q) {
      const double force = span.weights(q) * state.pressure(span.firstPoint + q);
      if (!(force > 0.0)) continue;
      all += force;
      const Eigen::Matrix<double, Dim, Dim - 1> tangents =
          points * span.dR.template middleCols<Dim - 1>((Dim - 1) * q);
      const double facing =
          outward * areaVector<Dim>(tangents).dot(state.normal.col(span.firstPoint + q).template head<Dim>());
      if (facing > 0.0) inside += force;
    }
  }
  return all > 0.0 ? inside / all : 0.0;
}

template double forceFromInside(const Body<2>&, const ContactPair<2>&, const Eigen::VectorXd&);
template double forceFromInside(const Body<3>&, const ContactPair<3>&, const Eigen::VectorXd&);

}  // namespace burnish::inline analysis
