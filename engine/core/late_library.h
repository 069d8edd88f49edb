#pragma once

namespace burnish::inline core {

/// A library of the system that few commands need: it is loaded when the first of them does, which saves all others its time
/// and memory, and kept until the process ends.
class LateLibrary {
 public:
  /// file: such as "libembree3.so.3". package: of Debian, for the message of the `Error` that is thrown if it cannot be loaded.
  LateLibrary(const char* file, const char* package);

  /// A function of the library. Throws `Error` if it has none of that name.
  template <class Function>
  Function find(const char* name) const {
    return reinterpret_cast<Function>(address(name));
  }

 private:
  void* address(const char* name) const;

  const char* file_;
  void* library_;
};

}  // namespace burnish::inline core
