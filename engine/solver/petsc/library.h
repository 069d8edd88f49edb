#pragma once
#include <petscksp.h>

#include <utility>

namespace burnish::inline solver::petsc {

/// Begins to use the library, once per process; it is ended with the process. Throws `Error` if it cannot.
void begin();

/// Throws `RunError` with the library's words unless a call has succeeded; `Error` in one of several ranks, as others
/// may not know.
void check(PetscErrorCode code);

/// Owner of an object of the library.
template <class Object, PetscErrorCode (*destroy)(Object*)>
class Owned {
 public:
  Owned() = default;
  explicit Owned(Object object) : object_(object) {}
  ~Owned() { reset(); }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  Owned(Owned&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }

  void reset() {
    if (object_ != nullptr) destroy(&object_);
    object_ = nullptr;
  }

  /// For functions that create the object.
  Object* place() {
    reset();
    return &object_;
  }
  operator Object() const { return object_; }

 private:
  Object object_ = nullptr;
};

using Matrix = Owned<Mat, MatDestroy>;
using Vector = Owned<Vec, VecDestroy>;
using Indices = Owned<IS, ISDestroy>;
using Scatter = Owned<VecScatter, VecScatterDestroy>;
using Solver = Owned<KSP, KSPDestroy>;
using Preconditioner = Owned<PC, PCDestroy>;

}  // namespace burnish::inline solver::petsc
