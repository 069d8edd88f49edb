#include "engine/nurbs/knot_vector.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <utility>

#include "engine/core/error.h"

namespace burnish::inline nurbs {

KnotVector::KnotVector(int degree, std::vector<double> knots) : degree_(degree), knots_(std::move(knots)) {
  if (degree_ < 1) throw Error(fmt::format("knot vector: degree {} is below 1", degree_));
  const auto p = static_cast<std::size_t>(degree_);
  if (knots_.size() < 2 * (p + 1))
    throw Error(fmt::format("knot vector: {} knots, but degree {} needs at least {}", knots_.size(), degree_,
                            2 * (p + 1)));
  for (std::size_t i = 0; i < knots_.size(); ++i) {
    if (!std::isfinite(knots_[i]))
      throw Error(fmt::format("knot vector: knot {} is not a finite number", i + 1));
    if (i > 0 && knots_[i] < knots_[i - 1])
      throw Error(fmt::format(
          "knot vector: knot {} = {} is smaller than the one before it ({}); knots must not decrease", i + 1,
          knots_[i], knots_[i - 1]));
  }

  std::vector<int> multiplicities;
  for (std::size_t i = 0; i < knots_.size(); ++i) {
    if (breakpoints_.empty() || knots_[i] > breakpoints_.back()) {
      if (i > 0) intervals_.push_back(static_cast<int>(i) - 1);
      breakpoints_.push_back(knots_[i]);
      multiplicities.push_back(0);
    }
    ++multiplicities.back();
  }
  if (breakpoints_.size() < 2) throw Error("knot vector: all knots are equal, so there is no knot span");
  if (multiplicities.front() != degree_ + 1 || multiplicities.back() != degree_ + 1)
    throw Error(
        fmt::format("knot vector: the end knots stand {} and {} times; an open knot vector of degree {} "
                    "repeats each of them {} times",
                    multiplicities.front(), multiplicities.back(), degree_, degree_ + 1));
  for (std::size_t b = 1; b + 1 < breakpoints_.size(); ++b)
    if (multiplicities[b] > degree_)
      throw Error(fmt::format(
          "knot vector: the interior knot {} stands {} times; at most {} (the degree) are allowed",
          breakpoints_[b], multiplicities[b], degree_));
}

KnotVector KnotVector::uniform(int degree, int spans) {
  if (spans < 1) throw Error(fmt::format("knot vector: {} knot spans; at least 1 is needed", spans));
  std::vector<double> knots(static_cast<std::size_t>(degree), 0.0);
  for (int i = 0; i <= spans; ++i) knots.push_back(static_cast<double>(i) / spans);
  knots.insert(knots.end(), static_cast<std::size_t>(degree), 1.0);
  return {degree, std::move(knots)};
}

double KnotVector::greville(int function) const {
  const auto first = knots_.begin() + function + 1;
  return std::accumulate(first, first + degree_, 0.0) / degree_;
}

}  // namespace burnish::inline nurbs
