#pragma once
#include <string>

/// For processes that shall not print what another one prints, too.
namespace burnish {

/// From now on nothing is printed; what is meant for standard error is kept.
void keepSilent();

/// Prints again; returns what was kept.
std::string endSilence();

}  // namespace burnish
