#pragma once
#include <string>

#include "engine/scene/scene.h"

namespace burnish {

/// What is wrong with a field that is asked of results of a scene, as "found NAME, ...; allowed here: ..."; empty if its frames
/// have it.
std::string fieldProblem(const Scene& scene, const std::string& field);

/// The same, looked at one by one: components of bodies in space, fields of other laws, fields of faces in contact.
std::string componentProblem(int dim, const std::string& field);
std::string lawProblem(const Scene& scene, const std::string& field);
std::string contactProblem(const Scene& scene, const std::string& field);

}  // namespace burnish
