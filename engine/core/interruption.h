#pragma once
#include <exception>

/// A signal that asks the program to end, where long work can be left.
namespace burnish::inline core {

/// Leaves the work between two pieces of it, such as pictures. No `Error`: nothing is to be mended.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// For signal handlers.
void noteInterruption(int signal) noexcept;

/// Forgets signals of earlier work.
void forgetInterruptions() noexcept;

/// The last signal that was noted, or 0.
int interruption() noexcept;

/// How many were noted.
int numInterruptions() noexcept;

/// Throws `Interrupted` if a signal was noted.
void throwIfInterrupted();

}  // namespace burnish::inline core
