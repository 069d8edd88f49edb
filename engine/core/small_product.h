#pragma once
#include <Eigen/Dense>

namespace burnish::inline core {

/// Entries of a product that are asked for: all, or those on and below the diagonal, with some above it.
enum class ProductPart { All, Lower };

/// C = A Bᵀ like `multiplyTransposedInto`, for matrices of some ten rows, where libraries take as long to prepare
/// as to multiply. Rows of A and C: a multiple of `kLanes`.
void multiplyTransposedSmall(const Eigen::Ref<const Eigen::MatrixXd>& A,
                             const Eigen::Ref<const Eigen::MatrixXd>& B, Eigen::Ref<Eigen::MatrixXd> C,
                             ProductPart part = ProductPart::All);

}  // namespace burnish::inline core
