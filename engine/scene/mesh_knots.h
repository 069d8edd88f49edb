#pragma once
#include <vector>

#include "engine/nurbs/knot_vector.h"
#include "engine/scene/scene.h"

namespace burnish::inline scene {

/// Number of parts into which a mesh divides every knot span of a shape in one direction.
int partsOf(const BodySpec& body, const MeshSpec& mesh, std::size_t direction);

/// The knots that a mesh makes of those of a shape in one direction: raised to the body's degree if that is
/// higher, divided into equal or graded spans, creased. Lagrange elements take their breakpoints only.
/// Throws `Error` for a grading that does not fit, the only mistake left in a scene that has been checked
/// otherwise.
KnotVector meshKnots(const BodySpec& body, const std::vector<DefinitionSpec>& definitions,
                     const MeshSpec& mesh, std::size_t direction, const KnotVector& shape);

/// Number of basis functions of the body's basis on knots from `meshKnots`.
int numFunctions(const BodySpec& body, const KnotVector& knots);

}  // namespace burnish::inline scene
