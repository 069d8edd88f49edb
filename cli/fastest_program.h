#pragma once
#include <string>

namespace burnish {

/// The program as it was compiled for processors with AVX2 and FMA, where this is one and that program is installed: packages, which
/// must run on every processor, hold both. Empty otherwise.
std::string programForProcessor();

/// To be called first in main() by what computes: starts the program again where it would compute faster, as
/// `programForProcessor()` or with other kernels of BLAS. Comes back if there is no need to, or if that fails.
void startFastest(char** argv);

}  // namespace burnish
