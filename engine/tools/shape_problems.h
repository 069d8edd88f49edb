#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "engine/schema/coordinates.h"
#include "engine/schema/problems.h"

namespace burnish::inline tools {

/// Where the checks of a shape report what is wrong with it, and what they may know of the body.
class ShapeProblems : public Problems {
 public:
  struct Body {
    int dim = 0;  ///< 0: not known
    bool axisymmetric = false;
  };

  ShapeProblems(const Problems& problems, Body body) : Problems(problems), body_(body) {}

  /// Whether nothing is wrong with a key, and with the choice of the shape.
  bool clean(const std::string& key) const { return Problems::clean("shape") && Problems::clean(key); }

  int dim() const { return body_.dim; }
  bool isAxisymmetric() const { return body_.axisymmetric; }

  /// The same for the shape of a part.
  ShapeProblems ofPart(const std::string& key) const { return {at(pathOf(key)), body_}; }

  /// The direction of a tip or an edge has a length.
  void requireFront(const char* key, const Direction& direction) const;

  /// An axis has a length, and is that of z in two dimensions.
  void requireAxis(const char* key, const Eigen::Vector3d& axis) const;

  /// As many coordinates as the body has dimensions.
  void requireDimension(const char* key, const std::vector<std::vector<double>>& points, int dim) const;

 private:
  Body body_;
};

/// "1, 0, 0"
std::string entriesText(const Coordinates& coordinates);

bool areParallel(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

}  // namespace burnish::inline tools
