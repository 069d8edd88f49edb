#pragma once
#include <string>

#include "engine/results/result.h"

/// What makes a record whole: sizes that agree, indices in range, finite geometry. Results are checked when
/// they are written and again when they are read, so that whoever holds a record may index into it. All throw
/// `Error`.
namespace burnish::inline results {

/// `place` begins the message, e.g. the file's name.
void checkMesh(const MeshRecord& mesh, int dim, const std::string& place);

void checkModel(const ModelRecord& model, const std::string& place);

/// The frame on its own and against its model.
void checkFrame(const FrameRecord& frame, const ModelRecord& model, const std::string& place);

}  // namespace burnish::inline results
