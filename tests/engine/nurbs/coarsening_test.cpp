#include "engine/nurbs/coarsening.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/nurbs/refinement.h"

namespace burnish {
namespace {

using testing::ElementsAre;

TEST(MergedBreakpoints, MakeThirdsOfEqualSpans) {
  EXPECT_THAT(mergedBreakpoints(std::vector<double>(9, 0.1), 0.1, {}), ElementsAre(0, 3, 6, 9));
  EXPECT_THAT(mergedBreakpoints(std::vector<double>(9, 0.1), 0.1, {.longest = 2.0, .most = 2}),
              ElementsAre(0, 2, 4, 6, 9));  // the last one joins what stands before it
}

TEST(MergedBreakpoints, LeaveLongSpansAsTheyAre) {
  EXPECT_THAT(mergedBreakpoints({1, 1, 1, 1, 4, 9, 9}, 1.0, {}), ElementsAre(0, 3, 5, 6, 7));
  // In a direction of long spans alone, nothing.
  EXPECT_THAT(mergedBreakpoints({8, 8, 8}, 1.0, {}), ElementsAre(0, 1, 2, 3));
  // A short span beside one that is too long to be merged is merged all the same: levels must end.
  EXPECT_THAT(mergedBreakpoints({1, 50}, 1.0, {}), ElementsAre(0, 2));
}

/// A function of the coarse basis is the same function of the fine one.
void expectTheSameFunction(const UnivariateBasis& coarse, const UnivariateBasis& fine) {
  const auto T = transferMatrix(coarse, fine);
  ASSERT_EQ(T.rows(), fine.numFunctions());
  ASSERT_EQ(T.cols(), coarse.numFunctions());
  const Eigen::VectorXd c = Eigen::VectorXd::LinSpaced(coarse.numFunctions(), 0.3, 5.0).array().sin();
  const Eigen::VectorXd f = T * c;
  const auto valueOf = [](const UnivariateBasis& basis, const Eigen::VectorXd& coefficients, double xi) {
    const int span = basis.findSpan(xi);
    return basis.evaluate(span, xi, 0)
        .col(0)
        .dot(coefficients.segment(basis.firstFunction(span), basis.degree() + 1));
  };
  for (int k = 0; k <= 40; ++k) {
    const double xi = fine.parameterAt(k / 40.0);
    EXPECT_NEAR(valueOf(fine, f, xi), valueOf(coarse, c, xi), 1e-13) << xi;
  }
}

TEST(TransferMatrix, KeepsFunctionsOfSplinesWithUnevenAndRepeatedKnots) {
  for (const int degree : {1, 2, 3, 4}) {
    const KnotVector even = KnotVector::uniform(degree, 7);
    const auto fine = UnivariateBasis::bspline(creased(withKnots(even, {0.03, 0.031, 0.9}), {0.5}));
    for (const auto& kept :
         {std::vector<int>{0, 2, 5, fine.numSpans()}, std::vector<int>{0, fine.numSpans()}}) {
      const auto coarse = coarsened(fine, kept);
      EXPECT_EQ(coarse.numSpans(), static_cast<int>(kept.size()) - 1);
      expectTheSameFunction(coarse, fine);
    }
  }
}

TEST(TransferMatrix, KeepsFunctionsOfLagrangeElements) {
  for (const int degree : {1, 2, 3}) {
    const auto fine = UnivariateBasis::lagrange(degree, {0.0, 0.1, 0.3, 0.35, 0.8, 1.0});
    expectTheSameFunction(coarsened(fine, {0, 2, 3, 5}), fine);
  }
}

TEST(TransferMatrix, RefusesSpacesThatAreNotNested) {
  const auto fine = UnivariateBasis::bspline(KnotVector::uniform(2, 4));
  EXPECT_THROW(transferMatrix(UnivariateBasis::bspline(KnotVector::uniform(2, 3)), fine), Error);
}

}  // namespace
}  // namespace burnish
