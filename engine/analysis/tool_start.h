#pragma once
#include <vector>

#include "engine/contact/contact_term.h"
#include "engine/contact/tool.h"
#include "engine/solid/body.h"

namespace burnish {

/// Smallest point-wise gap between the undeformed face and the tool at t = 0, found by sampling and zooming
/// in.
template <int Dim>
double smallestGap(const Body<Dim>& body, int patch, FaceId face, const Tool& tool);

/// How far a tool has to be lifted at the start so that no averaged gap of the undeformed face is negative.
/// Functions of a Lagrange basis have negative lobes: their averaged gap can be negative although nothing
/// touches, and the first step would start with a jump. Zero when no gap is below `-touching`, a length that
/// rounding explains.
template <int Dim>
Eigen::Vector3d liftToSeparate(const std::vector<const ContactTerm<Dim>*>& pairs, const Tool& tool,
                               double touching);

}  // namespace burnish
