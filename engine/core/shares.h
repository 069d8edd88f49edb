#pragma once
#include <cstddef>
#include <vector>

#include "engine/core/team.h"

namespace burnish::inline core {

/// Numbers of things of which each rank of a team has its own: rank r those from begins[r] to begins[r + 1].
struct Shares {
  std::vector<int> items;
  std::vector<int> begins{0};
};

/// Hands `width` numbers of each thing from the rank that has it to all others: get(item, to) writes those of
/// its own, set(item, from) takes those of others.
template <class Get, class Set>
void exchange(const Team& team, const Shares& shares, int width, const Get& get, const Set& set) {
  if (team.isAlone() || width == 0) return;
  const auto step = static_cast<std::size_t>(width);
  std::vector<double> values(step * shares.items.size());
  const auto forItems = [&](int rank, const auto& f) {
    const auto r = static_cast<std::size_t>(rank);
    for (auto k = static_cast<std::size_t>(shares.begins[r]);
         k < static_cast<std::size_t>(shares.begins[r + 1]); ++k)
      f(shares.items[k], values.data() + step * k);
  };
  forItems(team.rank(), get);
  std::vector<int> begins;
  for (const int begin : shares.begins) begins.push_back(width * begin);
  team.gather(values, begins);
  for (int rank = 0; rank < team.size(); ++rank)
    if (rank != team.rank()) forItems(rank, set);
}

/// Puts the numbers of all ranks together, in their order.
void gatherLists(const Team& team, std::vector<double>& numbers);

}  // namespace burnish::inline core
