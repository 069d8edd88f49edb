#pragma once
#include <Eigen/Dense>
#include <span>
#include <vector>

namespace burnish::inline contact {

/// Puts unknowns into ascending order, each there once.
void sortOnce(std::vector<int>& unknowns);

/// Where unknowns stand in a list that is ascending and holds them all.
std::vector<Eigen::Index> placesIn(const std::vector<int>& all, const std::vector<int>& unknowns);

/// Adds part to K, rows and columns at the same places; places may be there more than once.
void addAt(const std::vector<Eigen::Index>& places, const Eigen::Ref<const Eigen::MatrixXd>& part,
           Eigen::MatrixXd& K);

/// Where other numbers stand in a list: those that are not there yet are added at its end.
std::vector<int> placesAmong(std::vector<int>& list, std::span<const int> others);

}  // namespace burnish::inline contact
