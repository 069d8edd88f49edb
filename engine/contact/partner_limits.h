#pragma once

/// Which points of faces are partners: limits that contact of a face with itself and with other faces share.
namespace burnish {

/// Cosine between the outward normals of partners: at least 120 degrees apart.
inline constexpr double kOpposed = -0.5;

/// A slave that hangs over a free end by less than this part of the last span there still has a partner.
inline constexpr double kOverhang = 0.25;

/// A closest point is used up to this share of the distance to the centre of curvature, where it ends to be
/// one: for new partners, and during a step.
inline constexpr double kShareOfRadius = 0.75;
inline constexpr double kLargestShareOfRadius = 0.95;

/// New partners are found before they touch, as the two sides of a thin part of the body, which face away
/// from each other, penetrate one another. But where a fold closes, within a span of the slave, beside a
/// slave that has a partner, and on new meshes they may do so by a part of the length of the face between
/// them, and of the slave's span.
inline constexpr double kFold = 1.0;
inline constexpr double kShareOfLength = 0.05;
inline constexpr double kShareOfSpan = 0.25;

}  // namespace burnish
