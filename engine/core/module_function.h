#pragma once
#include <string>

#include "engine/core/error.h"

namespace burnish::inline core {

/// A library beside the program that holds what few runs need and takes long to load.
struct Module {
  const char* library;             ///< name of its file
  const char* builtFor = nullptr;  ///< "PETSc"; null for what is always built
  const char* option = nullptr;    ///< of the build, which may have left it out
  const char* package = nullptr;   ///< of Debian, which brings it
  /// Its functions are looked for when they are called: it is there sooner, but one that is missing ends the program.
  bool bindsLate = false;
};

/// A module is not there, or cannot be loaded.
class ModuleError : public Error {
 public:
  /// whatFor: what needs it; what: is wrong with it; remedy: what helps.
  ModuleError(const std::string& whatFor, const std::string& what, const std::string& remedy)
      : Error(whatFor + " needs " + what + "; " + remedy), what_(what), remedy_(remedy) {}

  const std::string& whatIsWrong() const { return what_; }
  const std::string& remedy() const { return remedy_; }

 private:
  std::string what_;
  std::string remedy_;
};

/// A function of a module, which is loaded by the first call and kept until the process ends. whatFor: what needs it, for
/// the message of the `ModuleError` that is thrown if it is not there.
void* moduleFunction(const Module& module, const char* name, const char* whatFor);

}  // namespace burnish::inline core
