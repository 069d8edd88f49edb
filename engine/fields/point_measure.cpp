#include "engine/fields/point_measure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <utility>

#include "engine/core/error.h"
#include "engine/nurbs/closest_point.h"

namespace burnish::inline fields {

template <int Dim>
PointMeasure<Dim>::PointMeasure(const Body<Dim>& body, int patch, const Eigen::Vector<double, Dim>& xi,
                                std::vector<std::string> names, std::function<const Fields&()> fields)
    : names_(std::move(names)), fields_(std::move(fields)) {
  const auto& geometry = body.patches[static_cast<std::size_t>(patch)];
  const int span = geometry.findSpan(xi);
  R_ = geometry.shape(span, xi).R;
  for (const int a : geometry.basis().spanFunctions(span))
    nodes_.push_back(body.nodes[static_cast<std::size_t>(patch)][static_cast<std::size_t>(a)]);
}

template <int Dim>
std::vector<std::string> PointMeasure<Dim>::columns() const {
  std::vector<std::string> columns;
  for (const auto& name : names_) {
    if (name == "displacement") {
      columns.insert(columns.end(), {"ux", "uy"});
      if (Dim == 3) columns.emplace_back("uz");
      continue;
    }
    const auto& components = fields_().at(name).components;
    if (components.empty()) columns.push_back(name);
    for (const auto& component : components) columns.push_back(name + "_" + component);
  }
  return columns;
}

template <int Dim>
std::vector<double> PointMeasure<Dim>::values(const MeasuredState& state) const {
  std::vector<double> result;
  for (const auto& name : names_) {
    Eigen::VectorXd value = Eigen::VectorXd::Zero(Dim);
    if (name == "displacement") {
      for (std::size_t a = 0; a < nodes_.size(); ++a)
        value += R_(static_cast<Eigen::Index>(a)) * state.x.template segment<Dim>(Dim * nodes_[a]);
    } else {
      value = fields_().at(name).values(Eigen::all, nodes_) * R_;
    }
    result.insert(result.end(), value.begin(), value.end());
  }
  return result;
}

template <int Dim>
std::pair<int, Eigen::Vector<double, Dim>> findPoint(const Body<Dim>& body, int patch,
                                                     const Eigen::Vector<double, Dim>& position) {
  constexpr int kIntervals = 20, kSteps = 50;
  std::vector<double> shares;
  for (int k = 0; k <= kIntervals; ++k) shares.push_back(static_cast<double>(k) / kIntervals);
  std::pair<int, Eigen::Vector<double, Dim>> best{0, Eigen::Vector<double, Dim>::Zero()};
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < body.patches.size(); ++p) {
    if (patch >= 0 && patch != static_cast<int>(p)) continue;
    const auto starts = parameterGrid(body.patches[p].basis(), shares);
    const auto closest = closestPoint(body.patches[p], position, starts, kSteps);
    if (closest.distance < nearest) {
      nearest = closest.distance;
      best = {static_cast<int>(p), closest.xi};
    }
  }
  if (!(nearest <= 1e-6 * body.size()))
    throw Error(fmt::format("the point ({:.6g}) is not in the body: the nearest one is {:.3g} away",
                            fmt::join(position, ", "), nearest));
  return best;
}

template class PointMeasure<2>;
template class PointMeasure<3>;
template std::pair<int, Eigen::Vector<double, 2>> findPoint(const Body<2>&, int,
                                                            const Eigen::Vector<double, 2>&);
template std::pair<int, Eigen::Vector<double, 3>> findPoint(const Body<3>&, int,
                                                            const Eigen::Vector<double, 3>&);

}  // namespace burnish::inline fields
