#pragma once

namespace burnish {

/// A library beside the program that holds what few runs need and takes long to load.
struct Module {
  const char* library;             ///< name of its file
  const char* builtFor = nullptr;  ///< "PETSc"; null for what is always built
  const char* option = nullptr;    ///< of the build, which may have left it out
};

/// A function of a module, which is loaded by the first call and kept until the process ends. whatFor: what needs it, for
/// the message of the `Error` that is thrown if it is not there.
void* moduleFunction(const Module& module, const char* name, const char* whatFor);

}  // namespace burnish
