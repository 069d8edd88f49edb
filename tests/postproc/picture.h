#pragma once
#include <filesystem>
#include <string>

#include "postproc/compare/picture.h"

namespace burnish {

/// Largest difference of a channel.
int difference(const Color& a, const Color& b);

/// Compares a picture with images/baseline/NAME.png; with BURNISH_WRITE_BASELINES in the environment writes
/// that file instead, and fails all the same, because a person is to look at it.
void expectBaseline(const std::filesystem::path& drawn, const std::string& name);

}  // namespace burnish
