#pragma once
#include "engine/solver/coupling_groups.h"

namespace burnish::inline solver {

/// What sparse factors of a symmetric matrix take.
struct FactorSize {
  double nonZeros = 0.0;
  double operations = 0.0;
};

/// Of a matrix in whose groups of rows every pair is coupled, by the same ordering as that of factors. groups:
/// of numbers from 0 to size - 1. blockSize: rows that each number stands for.
FactorSize factorSize(const CouplingGroups& groups, int size, int blockSize);

}  // namespace burnish::inline solver
