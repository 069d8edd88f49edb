#include "postproc/surface/roughness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/core/error.h"

namespace burnish {
namespace {

constexpr int kMostSamplingLengths = 5;

/// Integrals of |z| and z² over a piece on which z is linear, of length 1.
double meanAmount(double z0, double z1) {
  if (z0 * z1 >= 0.0) return 0.5 * (std::abs(z0) + std::abs(z1));
  return 0.5 * (z0 * z0 + z1 * z1) / (std::abs(z0) + std::abs(z1));
}
double meanSquare(double z0, double z1) {
  return (z0 * z0 + z0 * z1 + z1 * z1) / 3.0;
}

/// Heights of a part of a profile, whose ends are between two heights.
Profile partOf(const Profile& profile, double begin, double length, Eigen::Index count) {
  Profile part{begin, length / static_cast<double>(count - 1), Eigen::VectorXd(count)};
  for (Eigen::Index k = 0; k < count; ++k) {
    const double at = (begin + static_cast<double>(k) * part.spacing - profile.begin) / profile.spacing;
    const Eigen::Index i =
        std::clamp<Eigen::Index>(static_cast<Eigen::Index>(at), 0, profile.heights.size() - 2);
    part.heights(k) = std::lerp(profile.heights(i), profile.heights(i + 1), at - static_cast<double>(i));
  }
  return part;
}

/// About the line z = 0.
ProfileRoughness sums(const Profile& profile) {
  ProfileRoughness result;
  const Eigen::Index pieces = profile.heights.size() - 1;
  for (Eigen::Index k = 0; k < pieces; ++k) {
    result.a += meanAmount(profile.heights(k), profile.heights(k + 1));
    result.q += meanSquare(profile.heights(k), profile.heights(k + 1));
  }
  result.a /= static_cast<double>(pieces);
  result.q = std::sqrt(result.q / static_cast<double>(pieces));
  result.length = profile.length();
  return result;
}

}  // namespace

Profile profileOf(const Eigen::Matrix2Xd& points, int count) {
  const double begin = points.row(0).minCoeff(), end = points.row(0).maxCoeff();
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  Profile profile{begin, (end - begin) / (count - 1), Eigen::VectorXd::Constant(count, kNone)};
  const auto raise = [&](Eigen::Index k, double height) {
    profile.heights(k) = std::max(profile.heights(k), height);
  };
  for (Eigen::Index p = 0; p + 1 < points.cols(); ++p) {
    Eigen::Vector2d left = points.col(p), right = points.col(p + 1);
    if (left.x() > right.x()) std::swap(left, right);
    const auto first = static_cast<Eigen::Index>(std::ceil((left.x() - begin) / profile.spacing - 1e-9));
    const auto last = static_cast<Eigen::Index>(std::floor((right.x() - begin) / profile.spacing + 1e-9));
    for (Eigen::Index k = std::max<Eigen::Index>(first, 0); k <= std::min<Eigen::Index>(last, count - 1);
         ++k) {
      const double x = begin + static_cast<double>(k) * profile.spacing, width = right.x() - left.x();
      const double share = width > 0.0 ? std::clamp((x - left.x()) / width, 0.0, 1.0) : 1.0;
      raise(k, width > 0.0 ? std::lerp(left.y(), right.y(), share) : std::max(left.y(), right.y()));
    }
  }
  return profile;
}

Profile levelled(Profile profile) {
  const Eigen::Index n = profile.heights.size();
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, -0.5, 0.5);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(n);  // of a trapezoidal rule
  weights(0) = weights(n - 1) = 0.5;
  const double mean = weights.dot(profile.heights) / weights.sum();
  const Eigen::VectorXd weighted = weights.cwiseProduct(x);
  const double slope = weighted.dot(profile.heights) / weighted.dot(x);
  profile.heights -= (mean + slope * x.array()).matrix();
  return profile;
}

Profile roughnessProfile(const Profile& profile, double cutOff) {
  const auto half = static_cast<Eigen::Index>(std::ceil(cutOff / profile.spacing - 1e-9));
  const Eigen::Index left = profile.heights.size() - 2 * half;
  if (left < 2)
    throw Error(fmt::format("cutoff: found {:.6g}; the profile is {:.6g} long, expected less than half of it",
                            cutOff, profile.length()));
  const double width = std::sqrt(std::numbers::ln2 / std::numbers::pi) * cutOff;
  Eigen::VectorXd weights(2 * half + 1);
  for (Eigen::Index k = 0; k < weights.size(); ++k)
    weights(k) =
        std::exp(-std::numbers::pi * std::pow(static_cast<double>(k - half) * profile.spacing / width, 2));
  weights /= weights.sum();
  Profile rough{profile.begin + static_cast<double>(half) * profile.spacing, profile.spacing,
                Eigen::VectorXd(left)};
  for (Eigen::Index k = 0; k < left; ++k)
    rough.heights(k) = profile.heights(k + half) - weights.dot(profile.heights.segment(k, weights.size()));
  return rough;
}

ProfileRoughness roughnessOf(const Profile& profile, std::optional<double> cutOff) {
  if (!cutOff) {
    const Profile level = levelled(profile);
    ProfileRoughness result = sums(level);
    result.z = level.heights.maxCoeff() - level.heights.minCoeff();
    return result;
  }
  if (!(*cutOff >= 4.0 * profile.spacing))
    throw Error(fmt::format(
        "cutoff: found {:.6g}; the profile has heights at distances of {:.6g}, expected at least four of these",
        *cutOff, profile.spacing));
  const double longest = profile.length() / 3.0;
  if (!(*cutOff <= longest))
    throw Error(fmt::format(
        "cutoff: found {:.6g}; the profile is {:.6g} long and loses one cut-off at both ends, expected at most {:.6g}",
        *cutOff, profile.length(), longest));
  const Profile rough = roughnessProfile(levelled(profile), *cutOff);
  const int count = std::clamp(static_cast<int>(rough.length() / *cutOff + 1e-6), 1, kMostSamplingLengths);
  const double length = std::min(*cutOff, rough.length());
  const auto heights =
      std::max<Eigen::Index>(2, static_cast<Eigen::Index>(std::lround(length / rough.spacing)) + 1);
  ProfileRoughness result = sums(partOf(rough, rough.begin, count * length, count * (heights - 1) + 1));
  result.samplingLengths = count;
  for (int k = 0; k < count; ++k) {
    const Profile part = partOf(rough, rough.begin + k * length, length, heights);
    result.z += (part.heights.maxCoeff() - part.heights.minCoeff()) / count;
  }
  return result;
}

AreaRoughness roughnessOf(const Eigen::Matrix3Xd& points, const Eigen::VectorXd& weights,
                          const Eigen::Vector3d& up) {
  const double total = weights.sum();
  const Eigen::Vector3d middle = points * weights / total;
  const Eigen::Matrix3Xd from = points.colwise() - middle;
  Eigen::Matrix3d frame;
  frame.col(2) = up.normalized();
  frame.col(0) = frame.col(2).unitOrthogonal();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  const Eigen::Matrix3Xd local = frame.transpose() * from;
  const Eigen::Matrix2Xd xy = local.topRows<2>();
  const Eigen::Vector2d slope = (xy * weights.asDiagonal() * xy.transpose())
                                    .ldlt()
                                    .solve(xy * weights.cwiseProduct(local.row(2).transpose()));
  const Eigen::RowVectorXd heights =
      (local.row(2) - slope.transpose() * xy) / std::sqrt(1.0 + slope.squaredNorm());
  AreaRoughness result;
  result.a = heights.cwiseAbs().dot(weights.transpose()) / total;
  result.q = std::sqrt(heights.cwiseAbs2().dot(weights.transpose()) / total);
  result.z = heights.maxCoeff() - heights.minCoeff();
  result.area = total;
  result.heights = heights.transpose();
  return result;
}

}  // namespace burnish
