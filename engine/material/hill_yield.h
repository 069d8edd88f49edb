#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace burnish::inline schema {
class Problems;
}  // namespace burnish::inline schema

namespace burnish::inline material {

/// Hill's yield condition of 1948 from the ratios r of the strains across the width and the thickness of a strip that
/// is cut at 0°, 45° and 90° to the rolling direction. Stresses are measured by the yield stress in that direction.
struct HillYield {
  double r0 = 1.0;
  double r45 = 1.0;
  double r90 = 1.0;
  std::vector<double> rolling{1.0, 0.0, 0.0};
  std::vector<double> transverse{0.0, 1.0, 0.0};

  /// Factors of F (T22 − T33)² + G (T33 − T11)² + H (T11 − T22)² + 2 L T23² + 2 M T31² + 2 N T12².
  struct Factors {
    double F, G, H, L, M, N;
  };
  Factors factors() const;

  /// Columns: unit vectors of the rolling, transverse and normal direction.
  Eigen::Matrix3d axes() const;
};

/// Beyond this ratio and its inverse one of the directions would hardly yield at all.
inline constexpr double kLeastRatio = 0.01;

template <class Visitor>
void describe(Visitor& v, HillYield& s) {
  v.field(
      "r0", s.r0, {.required = true, .atLeast = kLeastRatio, .atMost = 1.0 / kLeastRatio},
      "Plastic strain across the width over that across the thickness of a strip along the rolling direction.");
  v.field("r45", s.r45, {.required = true, .atLeast = kLeastRatio, .atMost = 1.0 / kLeastRatio},
          "The same at 45 degrees to it.");
  v.field("r90", s.r90, {.required = true, .atLeast = kLeastRatio, .atMost = 1.0 / kLeastRatio},
          "The same at 90 degrees to it.");
  v.field("rolling", s.rolling, {.minEntries = 3, .maxEntries = 3},
          "Rolling direction at the start, in the coordinates x, y, z.");
  v.field("transverse", s.transverse, {.minEntries = 3, .maxEntries = 3},
          "Direction in the sheet across it, at a right angle.");
}

/// Reports directions that are not at a right angle and, in the plane, those that are neither in it nor normal to it: the
/// body would not stay in it. key: under which they stand.
void check(const HillYield& hill, const Problems& problems, const std::string& key);
void checkInPlane(const HillYield& hill, const Problems& problems, const std::string& key);

}  // namespace burnish::inline material
