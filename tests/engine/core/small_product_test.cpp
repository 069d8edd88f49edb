#include "engine/core/small_product.h"

#include <gtest/gtest.h>

namespace burnish {
namespace {

TEST(SmallProduct, IsTheProductForAllNumbersOfRows) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(44, 7), B = Eigen::MatrixXd::Random(13, 7);
  for (Eigen::Index rows = 4; rows <= 40; rows += 4)
    for (Eigen::Index columns = 1; columns <= B.rows(); ++columns) {
      Eigen::MatrixXd C = Eigen::MatrixXd::Constant(rows + 3, columns, 7.0);
      multiplyTransposedSmall(A.middleRows(2, rows), B.topRows(columns), C.middleRows(1, rows));
      const Eigen::MatrixXd expected = A.middleRows(2, rows) * B.topRows(columns).transpose();
      EXPECT_LT((C.middleRows(1, rows) - expected).cwiseAbs().maxCoeff(), 1e-14) << rows << " x " << columns;
      EXPECT_TRUE((C.topRows(1).array() == 7.0).all() && (C.bottomRows(2).array() == 7.0).all());
    }
}

TEST(SmallProduct, HasTheLowerPart) {
  for (Eigen::Index n = 1; n <= 25; ++n) {
    const Eigen::MatrixXd A = Eigen::MatrixXd::Random((n + 3) / 4 * 4, 9), B = Eigen::MatrixXd::Random(n, 9);
    Eigen::MatrixXd C = Eigen::MatrixXd::Zero(A.rows(), n);
    multiplyTransposedSmall(A, B, C, ProductPart::Lower);
    const Eigen::MatrixXd difference = (C - A * B.transpose()).topRows(n).triangularView<Eigen::Lower>();
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-14) << n;
  }
}

}  // namespace
}  // namespace burnish
