#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/core/error.h"
#include "engine/solver/direct_solver.h"
#include "engine/solver/newton.h"
#include "engine/solver/stepping.h"

namespace burnish {
namespace {

/// A chain of springs between neighbouring unknowns with force k (d + d^3), refusing any elongation above a
/// limit.
class Chain final : public Term {
 public:
  Chain(int size, double limit) : size_(size), limit_(limit) {}

  CouplingGroups couplings() const override {
    CouplingGroups groups;
    for (int i = 0; i + 1 < size_; ++i) groups.push_back({i, i + 1});
    return groups;
  }

  bool evaluate(double, const Eigen::VectorXd& x, Assembly& out) override {
    for (int i = 0; i + 1 < size_; ++i) {
      const double d = x(i + 1) - x(i);
      if (std::abs(d) > limit_) return false;
      const double force = d + d * d * d, stiffness = 1.0 + 3.0 * d * d;
      out.force(i) -= force;
      out.force(i + 1) += force;
      if (out.system == nullptr) continue;
      Eigen::Matrix2d K;
      K << stiffness, -stiffness, -stiffness, stiffness;
      out.system->add(out.term, static_cast<std::size_t>(i), K);
    }
    return true;
  }

  void accept() override { ++accepted_; }
  int accepted() const { return accepted_; }

 private:
  int size_;
  double limit_;
  int accepted_ = 0;
};

std::vector<bool> endsHeld(int size) {
  std::vector<bool> held(static_cast<std::size_t>(size), false);
  held.front() = held.back() = true;
  return held;
}

ResidualScales scalesFor(int size) {
  return {size, 1e-9, Eigen::VectorXd::Zero(size), Eigen::VectorXd()};
}

/// With K over so many of the first unknowns.
class SparseSystemOf : public testing::TestWithParam<int> {};

TEST_P(SparseSystemOf, AddsGroupsInAnyOrderWithGapsAndRepetitions) {
  const std::vector<CouplingGroups> groups{{{4, 0, 1}, {5, 2, 2, 3}}, {{1, 4}}};
  SparseSystem system({false, true, false, false, false, false, false}, groups, GetParam());
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(7, 7);
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (std::size_t term = 0; term < groups.size(); ++term)
    for (std::size_t g = 0; g < groups[term].size(); ++g) {
      const auto& unknowns = groups[term][g];
      const auto n = static_cast<Eigen::Index>(unknowns.size());
      const Eigen::MatrixXd K = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return uniform(generator); });
      system.add(term, g, K);
      system.add(unknowns, 0.5 * K);  // as a list that belongs to no term
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
          expected(unknowns[static_cast<std::size_t>(i)], unknowns[static_cast<std::size_t>(j)]) +=
              1.5 * K(i, j);
    }
  EXPECT_LT((Eigen::MatrixXd(system.tangent()) - expected).cwiseAbs().maxCoeff(), 1e-15);
  Eigen::VectorXd column = Eigen::VectorXd::Zero(7);
  column(2) = 0.5;
  column(5) = -2.0;
  expected.col(3) += column;
  expected(2, 3) += 4.0;
  system.moveIntoColumn(3, column);
  Eigen::VectorXd first = Eigen::VectorXd::Unit(4, 2) * 4.0;  // ends before the rows of the pattern do
  system.moveIntoColumn(3, first.head(3));
  EXPECT_TRUE(first.isZero(0.0));
  EXPECT_LT((Eigen::MatrixXd(system.tangent()) - expected).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_TRUE(column.isZero(0.0)) << "ready for the next one";
  EXPECT_EQ(system.tangent().nonZeros(), 9 + 9 + 1) << "two groups of three unknowns, one in none";
  const std::vector<int> isFree{0, 2, 3, 4, 5, 6};
  EXPECT_EQ(system.freeUnknowns(), isFree);

  const Eigen::MatrixXd all = system.tangent(), A = all(isFree, isFree);
  EXPECT_EQ(Eigen::MatrixXd(system.whole()), A);
  const Eigen::Index n = system.leading().cols(), m = A.cols() - n;
  EXPECT_EQ(n, std::max(0, GetParam() - 1));
  EXPECT_EQ(Eigen::MatrixXd(system.leading()), A.topLeftCorner(n, n));
  const SystemBorder border = system.border();
  EXPECT_EQ(Eigen::MatrixXd(border.B), A.topRightCorner(n, m));
  EXPECT_EQ(Eigen::MatrixXd(border.G), A.bottomLeftCorner(m, n));
  EXPECT_EQ(Eigen::MatrixXd(border.C), A.bottomRightCorner(m, m));

  const Eigen::VectorXd sizes = Eigen::VectorXd::LinSpaced(7, 0.5, 2.0);
  EXPECT_LT((system.timesMagnitudes(sizes) - all.cwiseAbs() * sizes).norm(), 1e-14);
  EXPECT_LT((system.timesPrescribed(sizes) - all.col(1) * sizes(1)).norm(), 1e-15);
  const auto entries = system.entries();
  const Eigen::VectorXd byColumns = system.byColumns(entries);
  EXPECT_EQ(byColumns, system.tangent().coeffs().matrix());
  const auto back = system.fromColumns(byColumns);
  EXPECT_EQ(back.leading, entries.leading);
  EXPECT_EQ(back.rest, entries.rest);
}
INSTANTIATE_TEST_SUITE_P(NumLeading, SparseSystemOf, testing::Values(0, 3, 5, 7));

TEST(Newton, MovesPrescribedUnknownsExactlyAndConvergesQuadratically) {
  Chain chain(6, 10.0);
  Newton newton({&chain}, endsHeld(6), scalesFor(6), {});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(6), target = Eigen::VectorXd::Zero(6);
  x(2) = 0.3;
  target(5) = 2.5;
  const NewtonReport report = newton.solve(0.0, target, x);
  ASSERT_EQ(report.outcome, NewtonOutcome::Converged);
  EXPECT_EQ(x(0), 0.0);
  EXPECT_EQ(x(5), 2.5);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(x(i), 0.5 * i, 1e-9);
  for (std::size_t k = 2; k + 1 < report.history.size(); ++k)
    EXPECT_LT(report.history[k + 1], 50.0 * report.history[k] * report.history[k] + 1e-14);
}

TEST(Newton, FindsTheStateThatAHeldForceKeepsOutOfBalance) {
  constexpr int size = 4;
  Chain chain(size, 10.0);
  Newton newton({&chain}, endsHeld(size), scalesFor(size), NewtonOptions{});
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(size);
  Eigen::VectorXd x = still;
  newton.hold(0.3 * Eigen::VectorXd::Unit(size, 1));
  ASSERT_EQ(newton.solve(0.0, still, x).outcome, NewtonOutcome::Converged);
  EXPECT_NEAR(newton.forces().front()(1), 0.3, 1e-9);
  EXPECT_NEAR(newton.forces().front()(2), 0.0, 1e-9);
  EXPECT_GT(x(1), 0.1);
  newton.hold({});
  ASSERT_EQ(newton.solve(0.0, still, x).outcome, NewtonOutcome::Converged);
  EXPECT_LT(x.norm(), 1e-9);
}

TEST(Newton, ShortensACorrectionThatWouldBeInadmissible) {
  Chain chain(3, 0.6);
  Newton newton({&chain}, {true, false, true}, scalesFor(3), {});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(3), target = Eigen::VectorXd::Zero(3);
  x(1) = 0.55;
  target(2) = 1.15;
  const NewtonReport report = newton.solve(0.0, target, x);
  EXPECT_EQ(report.outcome, NewtonOutcome::Converged);
  EXPECT_NEAR(x(1), 0.575, 1e-9);
}

/// A force on one unknown that rises steeply to either side of zero, and slowly behind that: a tangent of either slow piece
/// leads to the other one.
class SteepInTheMiddle final : public Term {
 public:
  CouplingGroups couplings() const override { return {{0}}; }
  bool evaluate(double, const Eigen::VectorXd& x, Assembly& out) override {
    const double u = x(0), slope = u < 0.0 ? 1.0 : 0.5, kink = 0.4;
    const bool isSteep = std::abs(u) < kink;
    out.force(0) += isSteep ? u / kink + slope * u : std::copysign(1.0, u) + slope * u;
    if (out.system != nullptr)
      out.system->add(out.term, 0, Eigen::MatrixXd::Constant(1, 1, isSteep ? 1.0 / kink + slope : slope));
    return true;
  }
  void accept() override {}
};

TEST(Newton, LeavesACircle) {
  SteepInTheMiddle term;
  const Eigen::VectorXd target = Eigen::VectorXd::Zero(1);
  ResidualScales scales = scalesFor(1);
  scales.forceFloor = 10.0;
  for (const double begin : {1.0, -2.0, 0.7, 5.0}) {
    Newton newton({&term}, {false}, scales, {.harmlessResidual = 1.0});
    Eigen::VectorXd x = Eigen::VectorXd::Constant(1, begin);
    const NewtonReport report = newton.solve(0.0, target, x);
    ASSERT_EQ(report.outcome, NewtonOutcome::Converged);
    EXPECT_GT(report.iterations, 5);
    EXPECT_LT(report.iterations, 15);
    EXPECT_NEAR(x(0), 0.0, 1e-9);
  }
}

/// A spring whose tangent lacks nearly half of its stiffness: each correction is 0.9 of the one before, turned round.
class HalfKnownSpring final : public Term {
 public:
  CouplingGroups couplings() const override { return {{0}}; }
  bool evaluate(double, const Eigen::VectorXd& x, Assembly& out) override {
    out.force(0) += 1.9 * (x(0) - 1.0);
    if (out.system != nullptr) out.system->add(out.term, 0, Eigen::MatrixXd::Constant(1, 1, 1.0));
    return true;
  }
  void accept() override {}
};

TEST(Newton, FindsTheEndOfCorrectionsThatTurnRound) {
  HalfKnownSpring term;
  ResidualScales scales = scalesFor(1);
  scales.forceFloor = 1.0;
  Newton newton({&term}, {false}, scales, {});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(1);
  const NewtonReport report = newton.solve(0.0, Eigen::VectorXd::Zero(1), x);
  EXPECT_EQ(report.outcome, NewtonOutcome::Converged);
  EXPECT_LT(report.iterations, 9) << "log(1e-9)/log(0.9) = 197 without";
  EXPECT_NEAR(x(0), 1.0, 1e-12);
}

TEST(Newton, SaysWhenNothingIsAdmissible) {
  Chain chain(3, 0.1);
  Newton newton({&chain}, {true, false, true}, scalesFor(3), {});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(3), target = Eigen::VectorXd::Zero(3);
  target(2) = 1.0;
  EXPECT_NE(newton.solve(0.0, target, x).outcome, NewtonOutcome::Converged);
}

TEST(Stepping, LandsExactlyAndCutsBackWhenAStepFails) {
  Chain chain(3, 0.6);
  Newton newton({&chain}, {true, false, true}, scalesFor(3), {.maxIterations = 25, .maxBacktracks = 0});
  SteppingState start;
  start.x = Eigen::VectorXd::Zero(3);
  Stepping stepping(
      newton, {&chain},
      [](double t) {
        Eigen::VectorXd target = Eigen::VectorXd::Zero(3);
        target(2) = t;
        return target;
      },
      {.maxCuts = 6}, start);
  // One step of 1 stretches the right spring by 1 before the middle follows: inadmissible, so it has to be
  // cut.
  std::vector<double> times;
  const Walk walk = stepping.advance(1.0, 1.0, [&](const StepReport& step) {
    times.push_back(step.time);
    return true;
  });
  ASSERT_EQ(walk, Walk::Arrived);
  EXPECT_EQ(times.back(), 1.0);
  EXPECT_EQ(stepping.state().time, 1.0);
  EXPECT_EQ(chain.accepted(), static_cast<int>(times.size()));
  EXPECT_NEAR(stepping.state().x(1), 0.5, 1e-9);

  // Beyond 1.2 no state is admissible: the last good state stays.
  EXPECT_EQ(stepping.advance(1.5, 0.1, [](const StepReport&) { return true; }), Walk::Failed);
  EXPECT_LE(stepping.state().time, 1.2);
  EXPECT_GT(stepping.state().time, 1.19);
  EXPECT_NEAR(stepping.state().x(1), 0.5 * stepping.state().time, 1e-9);
}

/// A step that ends at a wanted time is no shorter for one half of a longer one.
TEST(Stepping, DoesNotRepeatAStepThatHasFailed) {
  Chain chain(3, 0.45);  // what no state has at t = 1
  Newton newton({&chain}, {true, false, true}, scalesFor(3), {.maxIterations = 25, .maxBacktracks = 0});
  SteppingState start;
  start.x = Eigen::VectorXd::Zero(3);
  std::vector<double> asked;
  Stepping stepping(
      newton, {&chain},
      [&](double t) {
        asked.push_back(t);
        Eigen::VectorXd target = Eigen::VectorXd::Zero(3);
        target(2) = t;
        return target;
      },
      {.maxCuts = 6}, start);
  EXPECT_EQ(stepping.advance(1.0, 8.0, [](const StepReport&) { return true; }), Walk::Failed);
  ASSERT_GE(asked.size(), 2U);
  EXPECT_EQ(asked[0], 1.0);
  EXPECT_EQ(asked[1], 0.5) << "not 1 again, for halves of 8";
}

TEST(DirectSolver, CholmodHandsAnIndefiniteMatrixToUmfpack) {
  Eigen::SparseMatrix<double> A(2, 2);
  A.insert(0, 0) = 1.0;
  A.insert(0, 1) = 2.0;
  A.insert(1, 0) = 2.0;
  A.insert(1, 1) = 1.0;
  A.makeCompressed();
  DirectSolver solver(2);
  ASSERT_TRUE(solver.factorise(A));
  EXPECT_EQ(solver.numIndefinite(), 1);
  EXPECT_LT((A * solver.solve(Eigen::Vector2d(3.0, 3.0)) - Eigen::Vector2d(3.0, 3.0)).norm(), 1e-14);
  A.coeffRef(1, 1) = 5.0;
  ASSERT_TRUE(solver.factorise(A));
  EXPECT_EQ(solver.numIndefinite(), 1);
  EXPECT_LT((solver.solve(Eigen::Vector2d(3.0, 7.0)) - Eigen::Vector2d(1.0, 1.0)).norm(), 1e-14);
}

/// [K B; Bᵀ C] with K positive definite; of three border unknowns the second is not coupled.
Eigen::SparseMatrix<double> borderedMatrix(int n) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  Eigen::SparseMatrix<double> A(n + 3, n + 3);
  const auto insert = [&](int i, int j, double value) {
    A.coeffRef(i, j) = value;
    A.coeffRef(j, i) = value;
  };
  for (int i = 0; i < n; ++i) {
    insert(i, i, 4.0 + number(random));
    if (i + 1 < n) insert(i, i + 1, number(random));
    if (i + 7 < n) insert(i, i + 7, number(random));
    insert(i, n, i % 5 == 0 ? number(random) : 0.0);
    insert(i, n + 1, 0.0);
    insert(i, n + 2, i % 3 == 0 ? number(random) : 0.0);
  }
  insert(n, n, 0.0);
  insert(n + 1, n + 1, -0.3);
  insert(n + 2, n + 2, -0.1);
  A.makeCompressed();
  return A;
}

TEST(DirectSolver, BorderOfMultipliersGivesTheSolutionOfTheWholeMatrix) {
  const int n = 200;
  const auto A = borderedMatrix(n);
  const Eigen::VectorXd exact = Eigen::VectorXd::LinSpaced(n + 3, -1.0, 2.0);
  DirectSolver solver(n);
  for (int repetition = 0; repetition < 2; ++repetition) {
    ASSERT_TRUE(solver.factorise(A));
    EXPECT_LT((solver.solve(A * exact) - exact).norm(), 1e-12 * exact.norm());
  }
  EXPECT_EQ(solver.numIndefinite(), 0);
}

/// The second one is coupled with the third alone: it takes part in the Schur complement, not in K⁻¹B.
TEST(DirectSolver, MultipliersMayBeCoupledWithOneAnother) {
  const int n = 200;
  auto A = borderedMatrix(n);
  A.coeffRef(n + 1, n + 2) = A.coeffRef(n + 2, n + 1) = 0.05;
  A.makeCompressed();
  const Eigen::VectorXd exact = Eigen::VectorXd::LinSpaced(n + 3, -1.0, 2.0);
  DirectSolver solver(n);
  ASSERT_TRUE(solver.factorise(A));
  EXPECT_LT((solver.solve(A * exact) - exact).norm(), 1e-12 * exact.norm());
  EXPECT_EQ(solver.numIndefinite(), 0);
}

/// Like a tangent with friction: K is not quite symmetric, and the last unknown depends on the one before it,
/// which does not depend on it.
TEST(DirectSolver, GeneralMatricesAreSolvedWithASymmetricOneNearToThem) {
  const int n = 200;
  auto A = borderedMatrix(n);
  for (int i = 0; i + 7 < n; i += 3) A.coeffRef(i, i + 7) += 0.3;
  A.coeffRef(n, n + 2) = 0.0;
  A.coeffRef(n + 2, n) = 5.0;
  A.makeCompressed();
  const Eigen::VectorXd exact = Eigen::VectorXd::LinSpaced(n + 3, -1.0, 2.0);
  DirectSolver solver(n, TangentKind::General);
  for (int repetition = 0; repetition < 2; ++repetition) {
    ASSERT_TRUE(solver.factorise(A));
    EXPECT_LT((solver.solve(A * exact) - exact).norm(), 1e-10 * exact.norm());
    EXPECT_EQ(solver.definiteness(), Definiteness::Definite);
  }
  EXPECT_EQ(solver.numIndefinite(), 0);

  // Far from symmetric: UMFPACK solves.
  for (int i = 0; i + 7 < n; ++i) {
    A.coeffRef(i, i + 7) += 40.0;
    A.coeffRef(i + 7, i) -= 40.0;
  }
  ASSERT_TRUE(solver.factorise(A));
  EXPECT_LT((solver.solve(A * exact) - exact).norm(), 1e-10 * exact.norm());
  EXPECT_EQ(solver.numIndefinite(), 1);
  EXPECT_EQ(solver.definiteness(), Definiteness::NotDefinite) << "not known to be";
}

TEST(DirectSolver, MultiplierThatDoesNothingIsSingular) {
  auto A = borderedMatrix(50);
  A.coeffRef(51, 51) = 0.0;
  EXPECT_FALSE(DirectSolver(50).factorise(A));
}

TEST(LinearSolver, IsMadeByItsName) {
  const auto make = [](const std::string& name) {
    LinearSolverOptions options;
    options.name = name;
    return makeLinearSolver(options, {2});
  };
  for (const char* name : {"direct", "auto"})
    EXPECT_NE(dynamic_cast<DirectSolver*>(make(name).get()), nullptr) << name;
  EXPECT_THROW(make("multigrid"), Error);  // without coarser meshes
  EXPECT_THROW(make("none"), Error);
  EXPECT_THAT(linearSolverNames(), testing::ElementsAre("direct", "multigrid", "auto"));
}

TEST(DirectSolver, ReportsSingularAndNonFiniteMatrices) {
  for (const Eigen::Index leading : {1, 2}) {
    Eigen::SparseMatrix<double> A(2, 2);
    A.insert(0, 0) = 1.0;
    A.insert(0, 1) = 1.0;
    A.insert(1, 0) = 1.0;
    A.insert(1, 1) = 1.0;
    A.makeCompressed();
    EXPECT_FALSE(DirectSolver(leading).factorise(A));
    A.coeffRef(1, 1) = std::nan("");
    EXPECT_FALSE(DirectSolver(leading).factorise(A));
  }
}

TEST(Colouring, NoClassHoldsTwoGroupsWithACommonUnknown) {
  CouplingGroups groups;
  for (int i = 0; i < 40; ++i) groups.push_back({i, i + 1, i + 2});
  const auto colours = colourGroups(groups, 42);
  EXPECT_EQ(colours.size(), 3u);
  for (const auto& colour : colours)
    for (std::size_t k = 1; k < colour.size(); ++k) EXPECT_GE(colour[k] - colour[k - 1], 3);
}

}  // namespace
}  // namespace burnish
