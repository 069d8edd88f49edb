#include "engine/solid/relief.h"

#include <Eigen/Sparse>
#include <vector>

#include "engine/core/error.h"
#include "engine/solid/face_quadrature.h"

namespace burnish::inline solid {
namespace {

/// Coefficients of the function on a surface that has these values at its anchors, values: components x functions.
template <int P, int S>
Eigen::MatrixXd interpolated(const Patch<P, S>& surface, const Eigen::MatrixXd& values) {
  const TensorBasis<P>& basis = surface.basis();
  const int n = basis.numFunctions();
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < n; ++row) {
    const Eigen::Vector<double, P> xi = basis.anchor(row);
    const int span = surface.findSpan(xi);
    const Eigen::VectorXd R = surface.shape(span, xi).R;
    const std::vector<int> functions = basis.spanFunctions(span);
    for (std::size_t a = 0; a < functions.size(); ++a)
      entries.emplace_back(row, functions[a], R(static_cast<Eigen::Index>(a)));
  }
  Eigen::SparseMatrix<double> collocation(n, n);
  collocation.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> factor(collocation);
  if (factor.info() != Eigen::Success) throw Error("the face has no interpolation at its anchors");
  const Eigen::MatrixXd right = values.transpose();
  return Eigen::MatrixXd(factor.solve(right)).transpose();
}

}  // namespace

template <int Dim>
Patch<Dim> withRelief(const Patch<Dim>& patch, FaceId face,
                      const std::function<double(const Eigen::Vector<double, Dim>&)>& height) {
  const Patch<Dim - 1, Dim> surface = tracePatch(patch, face);
  const double sign = outwardSign(patch, face);
  const std::vector<int> onFace = faceFunctions(patch.basis(), face);
  Eigen::MatrixXd raised(Dim, std::ssize(onFace));
  for (Eigen::Index k = 0; k < raised.cols(); ++k) {
    const auto xi = surface.basis().anchor(static_cast<int>(k));
    const Eigen::Vector<double, Dim> area = sign * areaVector<Dim>(surface.jacobian(xi));
    if (!(area.norm() > 0.0)) throw Error("the face has no normal at one of its points");
    raised.col(k) = height(surface.position(xi)) * area.normalized();
  }
  const Eigen::MatrixXd shifts = interpolated(surface, raised);
  const auto across = face / 2;
  const auto direction = static_cast<std::size_t>(across);
  const int count = patch.basis().direction(across).numFunctions();
  Eigen::MatrixXd points = patch.points();
  for (Eigen::Index k = 0; k < shifts.cols(); ++k) {
    auto index = patch.basis().functionIndex(onFace[static_cast<std::size_t>(k)]);
    std::vector<int> line;  // of control points, from the face on
    for (int i = 0; i < count; ++i) {
      index[direction] = face % 2 == 0 ? i : count - 1 - i;
      line.push_back(patch.basis().functionNumber(index));
    }
    std::vector<double> way{0.0};
    for (std::size_t i = 1; i < line.size(); ++i)
      way.push_back(way.back() + (patch.points().col(line[i]) - patch.points().col(line[i - 1])).norm());
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      points.col(line[i]) += (way.back() > 0.0 ? 1.0 - way[i] / way.back() : 0.0) * shifts.col(k);
  }
  return {patch.basis(), std::move(points), patch.weights()};
}

template Patch<2> withRelief(const Patch<2>&, FaceId, const std::function<double(const Eigen::Vector2d&)>&);
template Patch<3> withRelief(const Patch<3>&, FaceId, const std::function<double(const Eigen::Vector3d&)>&);

}  // namespace burnish::inline solid
