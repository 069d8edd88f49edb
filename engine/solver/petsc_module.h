#pragma once

namespace burnish::inline solver {

/// A function of the library that has all of PETSc and MPI: found beside the program, loaded by the first call and
/// kept until the process ends. whatFor: what needs it, for the message of the `Error` that is thrown if it is
/// not there.
void* petscFunction(const char* name, const char* whatFor);

}  // namespace burnish::inline solver
