#include "engine/solid/body.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace burnish::inline solid {

template <int Dim>
Eigen::MatrixXd Body<Dim>::nodePositions() const {
  Eigen::MatrixXd positions = Eigen::MatrixXd::Zero(Dim, numNodes);
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (std::size_t a = 0; a < nodes[p].size(); ++a)
      positions.col(nodes[p][a]) = patches[p].points().col(static_cast<Eigen::Index>(a));
  return positions;
}

template <int Dim>
std::pair<int, int> Body<Dim>::nodeRange() const {
  std::pair<int, int> range{numNodes, 0};
  for (const auto& ofPatch : nodes) {
    const auto [lowest, highest] = std::minmax_element(ofPatch.begin(), ofPatch.end());
    range = {std::min(range.first, *lowest), std::max(range.second, *highest + 1)};
  }
  return range;
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

template <int Dim>
void numberTogether(std::vector<Body<Dim>>& bodies) {
  int count = 0;
  for (Body<Dim>& body : bodies) {
    for (auto& nodes : body.nodes)
      for (int& node : nodes) node += count;
    count += body.numNodes;
  }
  for (Body<Dim>& body : bodies) body.numNodes = count;
}

template <int Dim>
Body<Dim> unitedBody(const std::vector<Body<Dim>>& bodies) {
  Body<Dim> united = bodies.front();
  for (std::size_t k = 1; k < bodies.size(); ++k) {
    united.patches.insert(united.patches.end(), bodies[k].patches.begin(), bodies[k].patches.end());
    united.nodes.insert(united.nodes.end(), bodies[k].nodes.begin(), bodies[k].nodes.end());
  }
  return united;
}

template struct Body<2>;
template struct Body<3>;
template Body<2> makeBody(Patch<2>);
template Body<3> makeBody(Patch<3>);
template void numberTogether(std::vector<Body<2>>&);
template void numberTogether(std::vector<Body<3>>&);
template Body<2> unitedBody(const std::vector<Body<2>>&);
template Body<3> unitedBody(const std::vector<Body<3>>&);

}  // namespace burnish::inline solid
