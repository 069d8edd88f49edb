#pragma once
#include <string>

#include "engine/results/hdf5_input.h"
#include "engine/results/hdf5_output.h"

namespace burnish::inline results {

constexpr int kResultFormat = 2;

/// The attributes by which a file says what it is: `burnish_format`, `kind` ("model", "frame" or "restart")
/// and `model`, the identity of the model that the frames of one run share.
void writeHeader(const hdf5::OutputGroup& root, const std::string& kind, const std::string& modelId);

/// Returns `model`. Throws `Error` for a file that is foreign, of another format or of another kind.
std::string readHeader(const hdf5::InputGroup& root, const std::string& kind);

}  // namespace burnish::inline results
