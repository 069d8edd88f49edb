#pragma once
#include <Eigen/Dense>
#include <vector>

#include "postproc/compare/picture.h"

/// Colours by how they are seen: CIE L*a*b* for the white of sRGB (D65).
namespace burnish {

using Lab = Eigen::Array3f;  ///< L* from 0 to 100, a* and b* from about -128 to 127

Lab toLab(const Color& color);

/// Every pixel, lowest row first.
std::vector<Lab> toLab(const Picture& picture);

/// The distance of two colours (CIE 1976).
float deltaE(const Lab& a, const Lab& b);

/// Two colours side by side are told apart above this distance.
inline constexpr float kVisibleDeltaE = 2.3F;

}  // namespace burnish
