#pragma once
#include <array>
#include <string>
#include <vector>

#include "engine/contact/contact_term.h"
#include "engine/solid/body.h"
#include "engine/tools/tool.h"
#include "engine/tools/tool_load.h"

namespace burnish {

/// Gaps smaller than this share of a length count as touching.
inline constexpr double kTouching = 1e-9;

/// Keys of the ways under `carry`.
inline constexpr std::array<const char*, kToolWays> kCarryKeys{"x", "y", "z", "moment"};

/// Where an undeformed face comes nearest to a tool.
struct NearestPoint {
  double gap = 0.0;     ///< smallest point-wise gap
  double facing = 0.0;  ///< outward normal of the face times the tool's normal: -1 where they face each other
};

/// Nearest point of the undeformed face and the tool where its motion has it at time t, found by sampling and
/// zooming in.
template <int Dim>
NearestPoint nearestPoint(const Body<Dim>& body, int patch, FaceId face, const Tool& tool, double t);

/// How far a tool has to be lifted at the start so that no averaged gap of the undeformed face is negative.
/// Functions of a Lagrange basis have negative lobes: their averaged gap can be negative although nothing
/// touches, and the first step would start with a jump. Zero when no gap is negative by more than rounding
/// explains. Throws `InputError` at `place` if no lift up to the body's size separates them.
template <int Dim>
Eigen::Vector3d liftToSeparate(const std::vector<const ContactTerm<Dim>*>& pairs, const Tool& tool,
                               double bodySize, const std::string& place);

/// Throws `InputError` that names the keys at `place` (`tools[0].carry`) of the free ways in which the shape
/// of a tool moves in itself, for instance a disc that turns about its middle: no contact resists it there.
void requireDetermined(const Tool& tool, const std::string& place, int dim, double bodySize);

/// Direction of the first force, of all times up to `end`, that a tool carries; zero if there is none.
Eigen::Vector3d firstDirection(const ToolLoad& load, double end);

/// Displacement along a direction that brings a tool from its place at t = 0 to the undeformed body, so that
/// its smallest averaged gap vanishes. Throws `InputError` at `place` if the tool does not meet the body on
/// this way.
template <int Dim>
Eigen::Vector3d shiftToTouch(const std::vector<const ContactTerm<Dim>*>& pairs, const Tool& tool,
                             const Eigen::Vector3d& direction, double bodySize, const std::string& place);

/// Throws `InputError` at `place` if no gap between the undeformed faces and a tool at t = 0 vanishes.
template <int Dim>
void requireTouch(const std::vector<const ContactTerm<Dim>*>& pairs, const Tool& tool, double bodySize,
                  const std::string& place);

}  // namespace burnish
