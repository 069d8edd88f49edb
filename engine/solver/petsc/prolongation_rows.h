#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "engine/solver/hierarchy.h"

namespace burnish::inline solver {

/// Per unknown of a division its place in the order of the ranks.
inline std::vector<int> placesIn(const Division& division) {
  std::vector<int> places(division.order.size());
  for (std::size_t place = 0; place < places.size(); ++place)
    places[static_cast<std::size_t>(division.order[place])] = static_cast<int>(place);
  return places;
}

/// Some rows of a prolongation. columnOf: the number that a column gets among `numColumns`.
template <class ColumnOf>
Hierarchy::Prolongation someRows(const Hierarchy::Prolongation& P, std::span<const int> rows,
                                 Eigen::Index numColumns, const ColumnOf& columnOf) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (Hierarchy::Prolongation::InnerIterator entry(P, rows[row]); entry; ++entry)
      entries.emplace_back(static_cast<int>(row), columnOf(static_cast<int>(entry.col())), entry.value());
  Hierarchy::Prolongation some(std::ssize(rows), numColumns);
  some.setFromTriplets(entries.begin(), entries.end());
  return some;
}

}  // namespace burnish::inline solver
