#include "engine/contact/unknown_lists.h"

#include <algorithm>
#include <cassert>

namespace burnish::inline contact {

void sortOnce(std::vector<int>& unknowns) {
  std::sort(unknowns.begin(), unknowns.end());
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
}

std::vector<Eigen::Index> placesIn(const std::vector<int>& all, const std::vector<int>& unknowns) {
  std::vector<Eigen::Index> places;
  for (const int unknown : unknowns) {
    const auto at = std::lower_bound(all.begin(), all.end(), unknown);
    assert(at != all.end() && *at == unknown);
    places.push_back(at - all.begin());
  }
  return places;
}

void addAt(const std::vector<Eigen::Index>& places, const Eigen::Ref<const Eigen::MatrixXd>& part,
           Eigen::MatrixXd& K) {
  for (std::size_t j = 0; j < places.size(); ++j)
    for (std::size_t i = 0; i < places.size(); ++i)
      K(places[i], places[j]) += part(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
}

std::vector<int> placesAmong(std::vector<int>& list, std::span<const int> others) {
  std::vector<int> places;
  for (const int number : others) {
    const auto found = std::find(list.begin(), list.end(), number);
    places.push_back(static_cast<int>(found - list.begin()));
    if (found == list.end()) list.push_back(number);
  }
  return places;
}

}  // namespace burnish::inline contact
