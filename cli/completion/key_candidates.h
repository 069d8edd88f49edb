#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "cli/completion/completion.h"
#include "engine/schema/declaration.h"

namespace burnish {

/// How the paths of keys are written: to be explained, tools.motion; or to be set, tools[0].motion.x=.
enum class KeyUse { Explained, Set };

/// Keys that a path which is being written may name, one level of the document at a time, and the values of a key behind its =.
/// document: the file whose entries are meant, or empty: then every list has an entry, and every alternative is possible.
std::vector<Candidate> keyCandidates(const Declarations& keys, const std::string& path, KeyUse use,
                                     const std::filesystem::path& document);

}  // namespace burnish
