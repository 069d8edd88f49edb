#include "engine/core/small_product.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <type_traits>

#include "engine/core/lanes.h"

namespace burnish::inline core {
namespace {

/// A matrix whose columns follow each other with a stride.
struct Columns {
  const double* data;
  Eigen::Index stride;
};

/// The product for some rows of A and of B. 3 x 4 or 2 x 5 sums of lanes with their factors fit into the sixteen
/// registers of a processor without AVX-512.
template <int Vectors, int Rows>
[[gnu::always_inline]] inline void multiplyPanel(Columns A, Columns B, Eigen::Index depth, double* C,
                                                 Eigen::Index strideC) {
  Lanes sum[Rows][Vectors];
  unrolled<Rows>([&](auto j) { unrolled<Vectors>([&](auto v) { sum[j][v] = Lanes{}; }); });
  const double *a = A.data, *b = B.data;
  for (Eigen::Index k = 0; k < depth; ++k, a += A.stride, b += B.stride) {
    Lanes column[Vectors];
    unrolled<Vectors>([&](auto v) { std::memcpy(&column[v], a + kLanes * v, sizeof(Lanes)); });
    unrolled<Rows>([&](auto j) { unrolled<Vectors>([&](auto v) { sum[j][v] += column[v] * b[j]; }); });
  }
  unrolled<Rows>([&](auto j) {
    unrolled<Vectors>([&](auto v) { std::memcpy(C + j * strideC + kLanes * v, &sum[j][v], sizeof(Lanes)); });
  });
}

/// The product for all rows of A and some of B.
template <int Rows>
void multiplyRows(Columns A, Eigen::Index rows, Columns B, Eigen::Index depth, double* C,
                  Eigen::Index strideC) {
  constexpr int kVectors = Rows > 4 ? 2 : 3;
  const auto step = [&](auto vectors) {
    multiplyPanel<vectors, Rows>(A, B, depth, C, strideC);
    A.data += kLanes * vectors;
    C += kLanes * vectors;
    rows -= kLanes * vectors;
  };
  while (rows >= kLanes * kVectors) step(std::integral_constant<int, kVectors>{});
  if constexpr (kVectors > 2)
    if (rows == kLanes * 2) step(std::integral_constant<int, 2>{});
  if (rows == kLanes) step(std::integral_constant<int, 1>{});
}

/// How many rows of B to take at a time: four, and five where that leaves four for the end.
Eigen::Index rowsToTake(Eigen::Index rows) {
  return rows > 4 && rows % 4 != 0 ? 5 : std::min<Eigen::Index>(rows, 4);
}

}  // namespace

void multiplyTransposedSmall(const Eigen::Ref<const Eigen::MatrixXd>& A,
                             const Eigen::Ref<const Eigen::MatrixXd>& B, Eigen::Ref<Eigen::MatrixXd> C,
                             ProductPart part) {
  assert(A.rows() % kLanes == 0 && A.cols() == B.cols() && C.rows() == A.rows() && C.cols() == B.rows());
  for (Eigen::Index j = 0, taken = 0; j < B.rows(); j += taken) {
    const Eigen::Index first = part == ProductPart::Lower ? j / kLanes * kLanes : 0;
    const auto multiply = [&](auto rows) {
      multiplyRows<rows>({A.data() + first, A.outerStride()}, A.rows() - first,
                         {B.data() + j, B.outerStride()}, A.cols(), C.data() + first + j * C.outerStride(),
                         C.outerStride());
    };
    taken = rowsToTake(B.rows() - j);
    switch (taken) {
      case 1:
        multiply(std::integral_constant<int, 1>{});
        break;
      case 2:
        multiply(std::integral_constant<int, 2>{});
        break;
      case 3:
        multiply(std::integral_constant<int, 3>{});
        break;
      case 4:
        multiply(std::integral_constant<int, 4>{});
        break;
      default:
        multiply(std::integral_constant<int, 5>{});
    }
  }
}

}  // namespace burnish::inline core
