#pragma once
#include <string>

namespace burnish {

/// The program as it was compiled for processors with AVX2 and FMA, where this is one and that program is installed: packages, which
/// must run on every processor, hold both. Empty otherwise.
std::string programForProcessor();

/// To be called first in main() by what computes: starts the program again as `programForProcessor()`, or has BLAS take the kernels
/// of this processor. Does not come back from the former, unless it fails.
void startFastest(char** argv);

}  // namespace burnish
