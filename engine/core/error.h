#pragma once
#include <stdexcept>
#include <string>
#include <utility>

namespace burnish::inline core {

/// Something a person can mend: a scene, a file, a flag. The message names the place, what is wrong and what
/// would be right; the command line prints it and exits with 2.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
};

/// What a run meets under way and cannot go on with; its results so far are kept.
class RunError : public Error {
 public:
  using Error::Error;
};

}  // namespace burnish::inline core
