#include "engine/solid/body.h"

#include <numeric>
#include <utility>

namespace burnish {

template <int Dim>
Eigen::MatrixXd Body<Dim>::nodePositions() const {
  Eigen::MatrixXd positions(Dim, numNodes);
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (std::size_t a = 0; a < nodes[p].size(); ++a)
      positions.col(nodes[p][a]) = patches[p].points().col(static_cast<Eigen::Index>(a));
  return positions;
}

template <int Dim>
double Body<Dim>::size() const {
  Eigen::Vector<double, Dim> low = patches.front().points().col(0), high = low;
  for (const auto& patch : patches) {
    low = low.cwiseMin(patch.points().rowwise().minCoeff());
    high = high.cwiseMax(patch.points().rowwise().maxCoeff());
  }
  return (high - low).maxCoeff();
}

template <int Dim>
Body<Dim> makeBody(Patch<Dim> patch) {
  Body<Dim> body;
  body.numNodes = patch.basis().numFunctions();
  body.nodes.emplace_back(static_cast<std::size_t>(body.numNodes));
  std::iota(body.nodes.front().begin(), body.nodes.front().end(), 0);
  body.patches.push_back(std::move(patch));
  return body;
}

template struct Body<2>;
template struct Body<3>;
template Body<2> makeBody(Patch<2>);
template Body<3> makeBody(Patch<3>);

}  // namespace burnish
