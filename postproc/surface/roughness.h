#pragma once
#include <Eigen/Dense>
#include <optional>

/// Roughness of profiles and areas, as ISO 4287 and ISO 25178 name its parameters.
namespace burnish {

/// Heights at equal distances, linear between them.
struct Profile {
  double begin = 0.0, spacing = 0.0;  ///< place of the first height, distance of the next
  Eigen::VectorXd heights;            ///< two or more; upwards, out of the material

  double length() const { return spacing * static_cast<double>(heights.size() - 1); }
};

/// The profile of a curve as a stylus sees it that comes from above: where the curve lies above itself, the highest
/// height. points: 2 x points (two or more) along a polyline, of which x is the way of the stylus. count: of heights, two
/// or more.
Profile profileOf(const Eigen::Matrix2Xd& points, int count);

/// Without its least-squares line.
Profile levelled(Profile profile);

/// Waves longer than the cut-off taken out by the Gaussian filter of ISO 16610-21, which halves those of the cut-off;
/// without a length of the cut-off at both ends, where the filter does not see enough. Throws `Error` if nothing is
/// left.
Profile roughnessProfile(const Profile& profile, double cutOff);

struct ProfileRoughness {
  double a = 0.0, q = 0.0, z = 0.0;  ///< Ra, Rq, Rz
  double length = 0.0;               ///< of the evaluated profile
  int samplingLengths = 1;           ///< over which Rz is a mean
};

/// Ra = 1/l ∫|z|, Rq² = 1/l ∫z², and Rz, the mean over sampling lengths of the highest peak plus the deepest valley. With
/// a cut-off: of the levelled and filtered profile, over the first of its sampling lengths of the cut-off, five at most.
/// Without: of all of the levelled profile, as one sampling length. Throws `Error` for a profile shorter than three
/// cut-offs.
ProfileRoughness roughnessOf(const Profile& profile, std::optional<double> cutOff);

struct AreaRoughness {
  double a = 0.0, q = 0.0, z = 0.0;  ///< Sa, Sq, and Sz = highest peak plus deepest valley of all
  double area = 0.0;                 ///< of the mean plane
  Eigen::VectorXd heights{};         ///< of the points about the mean plane, out of the material
};

/// Of an area about its least-squares plane, without a filter. points: 3 x points; weights: area of each. up: out of
/// the material, roughly.
AreaRoughness roughnessOf(const Eigen::Matrix3Xd& points, const Eigen::VectorXd& weights,
                          const Eigen::Vector3d& up);

}  // namespace burnish
