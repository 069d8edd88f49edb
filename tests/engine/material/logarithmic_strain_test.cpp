#include "engine/material/logarithmic_strain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/engine/material/material_checks.h"

namespace burnish::logarithmic_strain_test {
namespace {

/// T = T_0 + D E with a stress that is not coaxial with E and moduli without any symmetry.
struct SkewLaw {
  struct State {};

  template <int Dim>
  static MandelVector<Dim> initialStress() {
    return MandelVector<Dim>::LinSpaced(0.8, -0.3);
  }

  template <int Dim>
  static MandelMatrix<Dim> moduli() {
    MandelMatrix<Dim> D;
    for (int i = 0; i < kVoigt<Dim>; ++i)
      for (int j = 0; j < kVoigt<Dim>; ++j)
        D(i, j) = std::sin(3.0 * i + 1.7 * j + 0.4) + (i == j ? 2.0 : 0.0);
    return D;
  }

  template <int Dim>
  bool evaluate(const Eigen::Matrix3d& F, const State&, State&, MaterialResponse<Dim>& out) const {
    const LogarithmicStrain<Dim> strain(F);
    if (!strain.isDefined()) return false;
    const MandelMatrix<Dim> D = moduli<Dim>();
    strain.setResponse(initialStress<Dim>() + D * strain.value(), D, out);
    return true;
  }
};

/// Stretches that are all different, two or three of them equal, and nearly so.
std::vector<Eigen::Vector3d> patterns() {
  std::vector<Eigen::Vector3d> stretches{{1.0, 1.0, 1.0}, {1.3, 1.3, 1.3}, {1.2, 1.2, 0.7},
                                         {0.8, 1.5, 0.8}, {1.4, 1.1, 0.6}, {2.5, 0.6, 0.9}};
  for (const double gap : {1e-10, 1e-8, 1e-5, 1e-3, 1.5e-2})
    stretches.emplace_back(1.1, 1.1 * (1.0 + gap), 1.1 * (1.0 - 0.3 * gap));
  return stretches;
}

template <class P>
class LogarithmicStrainTest : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(LogarithmicStrainTest, Dimensions);

TYPED_TEST(LogarithmicStrainTest, TangentIsTheDerivativeOfTheStress) {
  for (const Eigen::Vector3d& s : patterns())
    EXPECT_LT(test::tangentError<TypeParam::value>(
                  SkewLaw(), test::stretched<TypeParam::value>(s[0], s[1], s[2]), {}, 1e-3),
              5e-11)
        << s.transpose();
}

/// τ : d = T : Ė.
TYPED_TEST(LogarithmicStrainTest, StressesDoTheSameWork) {
  constexpr int Dim = TypeParam::value;
  for (const Eigen::Vector3d& s : patterns()) {
    const Eigen::Matrix3d F = test::stretched<Dim>(s[0], s[1], s[2]);
    const auto response = test::evaluate<Dim>(SkewLaw(), F).response;
    const MandelVector<Dim> T =
        SkewLaw::initialStress<Dim>() + SkewLaw::moduli<Dim>() * LogarithmicStrain<Dim>(F).value();
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) {
        if (!test::isAdmissible<Dim>(k, l)) continue;
        Eigen::Matrix3d L = Eigen::Matrix3d::Zero();
        L(k, l) = 1.0;
        const auto rate = test::derivative(
            [](const Eigen::Matrix3d& G) { return LogarithmicStrain<Dim>(G).value(); }, F, L, 1e-3);
        EXPECT_NEAR(fullTensor<Dim>(response.tau)(k, l), T.dot(rate), 1e-11) << s.transpose();
      }
  }
}

TYPED_TEST(LogarithmicStrainTest, SplitsStretchAndRotation) {
  constexpr int Dim = TypeParam::value;
  const Eigen::Matrix3d F = test::skewed<Dim>(0.4);
  const LogarithmicStrain<Dim> strain(F);
  const Eigen::Matrix3d U = exponential<Dim>(strain.value());
  EXPECT_LT((strain.rotation() * U - F).norm(), 1e-14);
  EXPECT_LT((strain.rotation().transpose() * strain.rotation() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_LT((halfLogarithm<Dim>(U * U) - strain.value()).norm(), 1e-14);
}

/// The plane is a part of space.
TEST(LogarithmicStrain, InThePlaneIsThatOfSpace) {
  for (const Eigen::Vector3d& s : patterns()) {
    const Eigen::Matrix3d F = test::stretched<2>(s[0], s[1], s[2]);
    const LogarithmicStrain<2> plane(F);
    const LogarithmicStrain<3> space(F);
    EXPECT_LT((plane.value() - space.value().head<4>()).norm(), 1e-14);
    MandelVector<3> T = MandelVector<3>::Zero();
    T.head<4>() = SkewLaw::initialStress<2>();
    MandelMatrix<3> D = MandelMatrix<3>::Identity();
    D.topLeftCorner<4, 4>() = SkewLaw::moduli<2>();
    MaterialResponse<2> inPlane;
    MaterialResponse<3> inSpace;
    plane.setResponse(T.head<4>(), D.topLeftCorner<4, 4>(), inPlane);
    space.setResponse(T, D, inSpace);
    EXPECT_LT((inPlane.tau - inSpace.tau.head<4>()).norm(), 1e-13);
    EXPECT_LT((inPlane.c - inSpace.c.topLeftCorner<4, 4>()).norm(), 1e-12);
  }
}

__extension__ using Quad = __float128;

/// In 113-bit arithmetic, from the formula with a quotient: differences of ln down to gaps of 1e-16 in relation to the
/// numbers. Equal numbers have the limits −1/(2a²) and (1/a − p_ab)/(a − b).
TEST(SecondDifferenceOfLog, HasAllItsDigits) {
  EXPECT_NEAR(secondDifferenceOfLog(2.0, 2.0, 2.0), -0.125, 1e-16);
  for (const double a : {0.3, 1.0, 7.0})
    for (int exponent = -15; exponent <= 0; ++exponent)
      for (const double mantissa : {1.0, 2.9, 3.1, 6.0})
        for (const double middle : {0.1, 0.5, 0.93}) {
          const double gap = mantissa * std::pow(10.0, exponent);
          const double b = a * (1.0 + middle * gap), c = a * (1.0 + gap);
          const Quad A = a, B = b, C = c;
          // ln(y/x) by the series of 2 artanh((y − x)/(y + x))
          const auto log = [](Quad x, Quad y) {
            const Quad t = (y - x) / (y + x), square = t * t;
            Quad power = t, sum = 0;
            for (int k = 1; k < 400; k += 2, power *= square) sum += power / k;
            return 2 * sum;
          };
          if (B == A || C == B) continue;
          const Quad exact = (log(A, B) / (B - A) - log(B, C) / (C - B)) / (A - C);
          const auto expected = static_cast<double>(exact);
          // the quotient of 34 digits loses those of the gap
          EXPECT_NEAR(secondDifferenceOfLog(a, b, c) / expected, 1.0, 3e-14 + 1e-31 / gap / gap)
              << a << " " << gap << " " << middle;
          EXPECT_EQ(secondDifferenceOfLog(a, b, c), secondDifferenceOfLog(c, a, b));
        }
}

}  // namespace
}  // namespace burnish::logarithmic_strain_test
