#pragma once
#include <filesystem>
#include <string>

namespace burnish {

/// Throws `Error` if a file of a baseline lies elsewhere, beyond a symbolic link: what that leads to is not to be
/// changed. file: to be written or replaced, there or not. name: of the picture or result, which says how far up from
/// `baseline`, where it is kept, the directory of all baselines is.
void requireInBaselines(const std::string& name, const std::filesystem::path& baseline,
                        const std::filesystem::path& file);

}  // namespace burnish
