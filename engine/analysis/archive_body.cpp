#include "engine/analysis/archive_body.h"

#include <fmt/format.h>

#include <array>
#include <utility>
#include <vector>

#include "engine/core/error.h"

namespace burnish::inline analysis {
namespace {

void archiveBasis(StateArchive& archive, const std::string& name, std::optional<UnivariateBasis>& basis) {
  int degree = basis ? basis->degree() : 0;
  int isLagrange = basis && basis->family() == BasisFamily::Lagrange ? 1 : 0;
  std::vector<double> knots = basis ? basis->knots() : std::vector<double>{};
  archive.field(name + "degree", degree);
  archive.field(name + "is_lagrange", isLagrange);
  archive.field(name + "knots", knots);
  if (!archive.restores()) return;
  basis = isLagrange == 1 ? UnivariateBasis::lagrange(degree, knots)
                          : UnivariateBasis::bspline(KnotVector(degree, knots));
}

void archiveStates(StateArchive& archive, PointStates& states) {
  Eigen::MatrixXd b_e(9, std::ssize(states.b_e));
  for (Eigen::Index k = 0; k < b_e.cols(); ++k)
    b_e.col(k) = states.b_e[static_cast<std::size_t>(k)].reshaped();
  archiveMatrix(archive, "b_e", 9, b_e);
  if (archive.restores()) states.numbers.resize(std::ssize(states.kinds), b_e.cols());
  for (std::size_t k = 0; k < states.kinds.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    Eigen::VectorXd numbers = states.numbers.row(row);
    archive.field(states.kinds[k].name, numbers);
    if (b_e.cols() != numbers.size()) throw Error("the saved states are not those of one mesh");
    states.numbers.row(row) = numbers;
  }
  if (!archive.restores()) return;
  states.b_e.clear();
  for (Eigen::Index k = 0; k < b_e.cols(); ++k) states.b_e.emplace_back(b_e.col(k).reshaped(3, 3));
}

void archiveFits(StateArchive& archive, std::vector<GapRamp>& fits) {
  Eigen::MatrixXd numbers(3, std::ssize(fits));
  for (std::size_t k = 0; k < fits.size(); ++k)
    numbers.col(static_cast<Eigen::Index>(k)) << fits[k].amount, fits[k].from, fits[k].until;
  archiveMatrix(archive, "fits", 3, numbers);
  fits.clear();
  for (const auto& fit : numbers.colwise()) fits.push_back({fit(0), fit(1), fit(2)});
}

}  // namespace

void archiveMatrix(StateArchive& archive, const std::string& name, Eigen::Index rows,
                   Eigen::MatrixXd& matrix) {
  Eigen::VectorXd values = matrix.reshaped();
  archive.field(name, values);
  if (values.size() % rows != 0) throw Error(fmt::format("the saved {} is not that of a mesh", name));
  matrix = values.reshaped(rows, values.size() / rows).eval();
}

template <int Dim>
void archiveBody(StateArchive& archive, const MaterialParameters& material,
                 std::optional<RezonedBody<Dim>>& body) {
  constexpr std::array kDirections{"first_", "second_", "third_"};
  std::array<std::optional<UnivariateBasis>, Dim> directions;
  Eigen::MatrixXd points;
  bool axisymmetric = false;
  if (body) {
    const Patch<Dim>& patch = body->named.body.patches.front();
    for (std::size_t d = 0; d < Dim; ++d) directions[d] = patch.basis().direction(static_cast<int>(d));
    points = patch.points();
    axisymmetric = body->named.body.axisymmetric;
  } else {
    body.emplace().states.kinds = carriedKinds(material);
  }
  int isAxisymmetric = axisymmetric ? 1 : 0;
  for (std::size_t d = 0; d < Dim; ++d) archiveBasis(archive, kDirections[d], directions[d]);
  archiveMatrix(archive, "points", Dim, points);
  archive.field("is_axisymmetric", isAxisymmetric);
  archive.field("time", body->time);
  archive.field("plastic_work", body->plasticWork);
  archiveStates(archive, body->states);
  archiveMatrix(archive, "others", Dim, body->others);
  archiveFits(archive, body->fits);
  if constexpr (Dim == 3) archiveMatrix(archive, "displacement", Dim, body->displacement);
  if (!archive.restores()) return;
  const Eigen::Index n = points.cols();
  std::vector<UnivariateBasis> bases;
  for (const auto& direction : directions) bases.push_back(*direction);
  body->named = {
      makeBody(Patch<Dim>(TensorBasis<Dim>(std::move(bases)), std::move(points), Eigen::VectorXd::Ones(n))),
      {{}}};
  body->named.body.axisymmetric = isAxisymmetric == 1;
}

template void archiveBody(StateArchive&, const MaterialParameters&, std::optional<RezonedBody<2>>&);
template void archiveBody(StateArchive&, const MaterialParameters&, std::optional<RezonedBody<3>>&);

}  // namespace burnish::inline analysis
