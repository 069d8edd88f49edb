#pragma once
#include <Eigen/Dense>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

/// Data that can be compared, whatever file they come from.
namespace burnish {

/// Numbers of one name at the places of a part.
struct DataArray {
  std::string name{};
  std::string unit{};                     ///< label, may be empty
  std::vector<std::string> components{};  ///< their names; may be empty
  Eigen::MatrixXd values{};               ///< components x places
  bool isExact = false;                   ///< numbers of points and the like, without tolerance
};

/// Arrays at the same places.
struct DataPart {
  std::string name{};       ///< "mesh", "contact", "points", ...
  std::string detail{};     ///< which of several of the name; empty for the only one
  std::string place{};      ///< what a place is: "control point", "cell", ...
  std::string structure{};  ///< what must be the same for places to have the same meaning, in words
  Eigen::Index numPlaces = 0;
  Eigen::MatrixXd positions{};        ///< coordinates x places, or empty
  std::vector<std::string> owners{};  ///< names of what places belong to
  std::vector<int> ownerOf{};         ///< number of a place's owner; empty without owners
  std::vector<DataArray> arrays{};    ///< names differ
};

/// The data of one instant; parts differ in name or detail.
using DataFrame = std::vector<DataPart>;

/// Data over time, read one instant after the other.
struct DataSeries {
  std::string name{};                             ///< of the instants: "frames"
  std::vector<double> times{};                    ///< ascending
  bool isTimed = true;                            ///< else there is one instant, without a time
  std::function<DataFrame(std::size_t)> frame{};  ///< throws `Error` for what cannot be read
};

}  // namespace burnish
