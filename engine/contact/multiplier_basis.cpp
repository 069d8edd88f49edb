#include "engine/contact/multiplier_basis.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/solid/face_quadrature.h"

namespace burnish::inline contact {
namespace {

constexpr double kHeldBelow = 0.5;

}  // namespace

MultiplierBasis::MultiplierBasis(int numFunctions)
    : multiplierOf_(static_cast<std::size_t>(numFunctions)), size_(numFunctions) {
  std::iota(multiplierOf_.begin(), multiplierOf_.end(), 0);
}

template <int P>
MultiplierBasis::MultiplierBasis(const TensorBasis<P>& basis, const std::vector<bool>& held)
    : multiplierOf_(held.size(), -1) {
  for (std::size_t a = 0; a < held.size(); ++a)
    if (!held[a]) multiplierOf_[a] = size_++;
  std::vector<int> tied = multiplierOf_;
  for (std::size_t a = 0; a < held.size(); ++a) {
    if (!held[a]) continue;
    for (std::size_t d = 0; d < static_cast<std::size_t>(P) && tied[a] < 0; ++d)
      for (const int step : {-1, 1}) {
        auto index = basis.functionIndex(static_cast<int>(a));
        index[d] += step;
        if (index[d] < 0 || index[d] >= basis.direction(static_cast<int>(d)).numFunctions()) continue;
        const int neighbour = multiplierOf_[static_cast<std::size_t>(basis.functionNumber(index))];
        if (neighbour >= 0) tied[a] = neighbour;
      }
  }
  multiplierOf_ = std::move(tied);
}

Eigen::VectorXd MultiplierBasis::coefficients(const std::vector<int>& functions,
                                              const Eigen::Ref<const Eigen::VectorXd>& multipliers) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(std::ssize(functions));
  for (std::size_t a = 0; a < functions.size(); ++a)
    if (const int A = multiplierOf(functions[a]); A >= 0)
      result(static_cast<Eigen::Index>(a)) = multipliers(A);
  return result;
}

template <int Dim>
HeldControlPoints heldControlPoints(const Body<Dim>& body, int patch, FaceId face,
                                    const std::vector<bool>& held) {
  const auto& volume = body.patches[static_cast<std::size_t>(patch)];
  const auto trace = tracePatch(volume, face);
  const auto functions = faceFunctions(volume.basis(), face);
  HeldControlPoints result{std::vector<bool>(functions.size(), false),
                           std::vector<bool>(functions.size(), false)};
  for (std::size_t a = 0; a < functions.size(); ++a) {
    const auto node = static_cast<std::size_t>(
        body.nodes[static_cast<std::size_t>(patch)][static_cast<std::size_t>(functions[a])]);
    const Eigen::Vector<double, Dim> area =
        areaVector<Dim>(trace.jacobian(trace.basis().anchor(static_cast<int>(a))));
    if (!(area.norm() > 0.0)) continue;
    const Eigen::Vector<double, Dim> normal = area.normalized();
    double across = 0.0, along = 0.0;  // squares of free parts
    for (std::size_t d = 0; d < static_cast<std::size_t>(Dim); ++d) {
      if (held[static_cast<std::size_t>(Dim) * node + d]) continue;
      const double square = std::pow(normal(static_cast<Eigen::Index>(d)), 2);
      across += square;
      along = std::max(along, 1.0 - square);
    }
    result.across[a] = across < kHeldBelow * kHeldBelow;
    result.along[a] = along < kHeldBelow * kHeldBelow;
  }
  return result;
}

template MultiplierBasis::MultiplierBasis(const TensorBasis<1>&, const std::vector<bool>&);
template MultiplierBasis::MultiplierBasis(const TensorBasis<2>&, const std::vector<bool>&);
template HeldControlPoints heldControlPoints(const Body<2>&, int, FaceId, const std::vector<bool>&);
template HeldControlPoints heldControlPoints(const Body<3>&, int, FaceId, const std::vector<bool>&);

}  // namespace burnish::inline contact
