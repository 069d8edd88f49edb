#pragma once
#include <Eigen/Dense>

#include "engine/solver/petsc/library.h"

namespace burnish::inline solver::petsc {

/// This rank's numbers of a vector of the library for reading, as a vector of Eigen.
template <class F>
void read(Vec vector, const F& f) {
  const PetscScalar* values = nullptr;
  PetscInt size = 0;
  check(VecGetLocalSize(vector, &size));
  check(VecGetArrayRead(vector, &values));
  f(Eigen::Map<const Eigen::VectorXd>(values, size));
  check(VecRestoreArrayRead(vector, &values));
}

template <class F>
void write(Vec vector, const F& f) {
  PetscScalar* values = nullptr;
  PetscInt size = 0;
  check(VecGetLocalSize(vector, &size));
  check(VecGetArray(vector, &values));
  f(Eigen::Map<Eigen::VectorXd>(values, size));
  check(VecRestoreArray(vector, &values));
}

/// Fills a vector from another one: f(from, to), of their numbers.
template <class F>
void fill(Vec from, Vec to, const F& f) {
  read(from, [&](auto in) { write(to, [&](auto out) { f(in.data(), out.data()); }); });
}

}  // namespace burnish::inline solver::petsc
