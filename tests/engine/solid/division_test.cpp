#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "engine/solid/bulk_term.h"
#include "tests/engine/core/thread_team.h"
#include "tests/engine/solid/term_check.h"

/// What each of several ranks has of a tangent against the tangent of one.
namespace burnish {
namespace {

/// One of several ranks without the others: what they have to say is not asked for.
class RankOf final : public Team {
 public:
  RankOf(int rank, int size) : rank_(rank), size_(size) {}
  int rank() const override { return rank_; }
  int size() const override { return size_; }
  void sum(std::span<double>) const override {}
  void gather(std::span<double>, const std::vector<int>&) const override {}
  void share(std::span<double>, int) const override {}
  double bytesSent() const override { return 0.0; }
  std::optional<bool> meet(bool) const override { return false; }
  [[noreturn]] void abort(int exitCode) const override { std::exit(exitCode); }

 private:
  int rank_, size_;
};

/// A block on a mesh of unequal spans that is held at its bottom.
struct Block {
  Body<3> body = makeBody(refined(
      box({0.0, 0.0, 0.0}, {1.0, 1.0, 2.0}),
      {KnotVector::uniform(2, 3), KnotVector::uniform(2, 2), withKnots(KnotVector::uniform(2, 6), {0.05})}));
  SpanQuadrature<3> quadrature{body};
  int numUnknowns = 3 * body.numNodes + 2;  // two multipliers

  Division division(int rank, int ranks) const {
    NodeGrid grid{.nodes = body.nodes.front()};
    for (int d = 0; d < 3; ++d)
      grid.size[static_cast<std::size_t>(d)] = body.patches.front().basis().direction(d).numFunctions();
    return divideUnknowns({term()->couplings(), contact()}, held(), 3 * body.numNodes, {grid}, rank, ranks);
  }

  std::vector<bool> held() const {
    std::vector<bool> held(static_cast<std::size_t>(numUnknowns), false);
    for (int node = 0; node < body.numNodes; ++node)
      if (body.nodePositions()(2, node) == 0.0)
        for (int d = 0; d < 3; ++d) held[static_cast<std::size_t>(3 * node + d)] = true;
    return held;
  }

  std::unique_ptr<BulkTerm<3>> term(Formulation formulation = Formulation::Displacement) const {
    return makeBulkTerm<3>(body, quadrature,
                           J2Plasticity({100.0, 0.3, ElasticLaw::NeoHookean, VoceHardening{0.5, 1.0, 10.0}}),
                           formulation);
  }

  /// Multipliers on nodes in the middle and at the end, which may be far from a rank's own.
  CouplingGroups contact() const {
    const int n = 3 * body.numNodes;
    return {{n / 2, n / 2 + 1, n}, {n - 3, n - 1, n + 1}};
  }
};

/// A tangent and the forces that go with it.
struct Assembled {
  SparseSystem system;
  Eigen::VectorXd forces;
  int spans = 0;

  Assembled(const Block& block, int rank, int ranks)
      : system(block.held(), {block.term()->couplings(), block.contact()}, 3 * block.body.numNodes,
               block.division(rank, ranks)),
        forces(Eigen::VectorXd::Zero(block.numUnknowns)) {
    const auto term = block.term();
    const RankOf team(rank, ranks);
    if (ranks > 1) term->divideAmong(team, system.division());
    Assembly out{forces, &system, 0};
    EXPECT_TRUE(term->evaluate(1.0, test::randomState(block.numUnknowns, 0.02, 3), out));
    const auto contact = block.contact();
    for (std::size_t k = 0; k < contact.size(); ++k)
      system.add(1, k, Eigen::MatrixXd::Constant(std::ssize(contact[k]), std::ssize(contact[k]), 0.1));
    system.add({contact[0][0], contact[1][2]}, Eigen::Matrix2d::Zero());
    spans = term->numWorkedOn();
  }
};

class DividedAmong : public testing::TestWithParam<int> {};

TEST_P(DividedAmong, RanksHaveTheColumnsAndForcesOfOneBitByBit) {
  const int ranks = GetParam();
  const Block block;
  Assembled one(block, 0, 1);
  const Eigen::MatrixXd K = one.system.leading();
  const SystemBorder border = one.system.border();
  const Eigen::VectorXd sizes = Eigen::VectorXd::LinSpaced(block.numUnknowns, 0.5, 2.0);
  Eigen::VectorXd prescribed = Eigen::VectorXd::Zero(block.numUnknowns), magnitudes = prescribed;
  Eigen::Index columns = 0;
  int spans = 0;
  std::vector<double> entries;
  for (int rank = 0; rank < ranks; ++rank) {
    const Assembled part(block, rank, ranks);
    const Division division = part.system.leadingDivision();
    const std::vector<int>& order = division.order;
    const Eigen::Index first = division.begins[static_cast<std::size_t>(rank)],
                       n = part.system.leading().cols();
    ASSERT_EQ(first, columns);
    ASSERT_GT(n, 0);
    Eigen::MatrixXd own = part.system.leadingElsewhere();
    own.middleRows(first, n) += Eigen::MatrixXd(part.system.leading());
    const Eigen::MatrixXd same = K(order, order);
    EXPECT_EQ(own, same.middleCols(first, n)) << "rank " << rank;
    const auto [B, G, C] = part.system.border();
    EXPECT_EQ(Eigen::MatrixXd(B), Eigen::MatrixXd(border.B)(order, Eigen::all));
    EXPECT_EQ(Eigen::MatrixXd(G), Eigen::MatrixXd(border.G)(Eigen::all, order));
    EXPECT_EQ(Eigen::MatrixXd(C), Eigen::MatrixXd(border.C));
    const auto unknowns = part.system.division().own();
    EXPECT_EQ(part.forces(unknowns), one.forces(unknowns));
    prescribed += part.system.timesPrescribed(sizes);
    magnitudes += part.system.timesMagnitudes(sizes);
    entries.push_back(
        static_cast<double>(part.system.leading().nonZeros() + part.system.leadingElsewhere().nonZeros()));
    columns += n;
    spans += part.spans;
  }
  EXPECT_EQ(columns, K.cols());
  EXPECT_LT((prescribed - one.system.timesPrescribed(sizes)).norm(), 1e-13 * prescribed.norm());
  EXPECT_LT((magnitudes - one.system.timesMagnitudes(sizes)).norm(), 1e-13 * magnitudes.norm());
  EXPECT_GT(spans, one.spans) << "spans at borders are assembled more than once";
  EXPECT_LT(spans, ranks * one.spans);
  // As far as layers of nodes are not divided, of which blocks have two or three here.
  const double mean = std::accumulate(entries.begin(), entries.end(), 0.0) / ranks;
  EXPECT_LT(*std::max_element(entries.begin(), entries.end()), 1.3 * mean);
}

/// Has a term flow; returns its forces.
Eigen::VectorXd flow(BulkTerm<3>& term, const Block& block) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(block.numUnknowns);
  Assembly out{forces};
  EXPECT_TRUE(term.evaluate(1.0, test::randomState(block.numUnknowns, 0.02, 3), out));
  term.accept();
  return forces;
}

TEST_P(DividedAmong, RanksKeepTheHistoriesOfTheirSpansAndHaveThoseOfOneTogether) {
  const Block block;
  const auto one = block.term();
  const Eigen::VectorXd forces = flow(*one, block);
  const Eigen::MatrixXd flowed = one->points().field("plastic_strain");
  ASSERT_GT(flowed.maxCoeff(), 1e-2);
  StateArchive ofOne;
  one->archive(ofOne);
  test::asTeam(GetParam(), [&](const Team& team) {
    const auto dividedTerm = [&] {
      auto term = block.term();
      term->divideAmong(team, block.division(team.rank(), team.size()));
      return term;
    };
    const auto term = dividedTerm();
    EXPECT_EQ(flow(*term, block), forces);
    EXPECT_EQ(term->summary().strainEnergy, one->summary().strainEnergy);
    EXPECT_EQ(term->plasticWork(), one->plasticWork());
    const Eigen::MatrixXd kept = term->points().field("plastic_strain");
    EXPECT_LT(kept.cols(), flowed.cols());
    EXPECT_EQ(kept.cols(), term->numWorkedOn() * block.quadrature.spans().front().weights.size());
    EXPECT_EQ(term->kirchhoffStress().size(), term->jacobians().size());
    EXPECT_EQ(std::ssize(term->jacobians()), kept.cols());
    EXPECT_EQ(term->portion().whole(kept, Receivers::All), flowed);
    EXPECT_EQ(term->portion().part(flowed), kept) << "of spans next to the border, too";

    StateArchive saved;
    term->archive(saved);
    if (team.isFirst())
      EXPECT_EQ(saved.values(), ofOne.values());
    else
      EXPECT_EQ(saved.values().at("history").size(), 0);
    const auto again = dividedTerm();
    StateArchive restored(ofOne.values());
    again->archive(restored);
    EXPECT_EQ(again->points().field("plastic_strain"), kept);
  });
}

/// Volume changes are averaged over spans of several ranks, whose sums may be rounded otherwise.
TEST_P(DividedAmong, ProjectedVolumeChangesAreThoseOfOne) {
  const Block block;
  const Eigen::VectorXd x = test::randomState(block.numUnknowns, 0.02, 3);
  const Eigen::VectorXd sizes = Eigen::VectorXd::LinSpaced(block.numUnknowns, 0.5, 2.0);
  struct Divided {
    std::unique_ptr<BulkTerm<3>> term;
    SparseSystem system;
    Eigen::VectorXd forces;
  };
  const auto evaluated = [&](const Team& team) {
    auto term = block.term(Formulation::ProjectedDilatation);
    term->keepProducts();
    SparseSystem system(block.held(), {term->couplings(), block.contact()}, 3 * block.body.numNodes,
                        block.division(team.rank(), team.size()));
    if (!team.isAlone()) term->divideAmong(team, system.division());
    Divided all{std::move(term), std::move(system), Eigen::VectorXd::Zero(block.numUnknowns)};
    Assembly out{all.forces, &all.system, 0};
    EXPECT_TRUE(all.term->evaluate(1.0, x, out));
    return all;
  };
  const Divided one = evaluated(alone());
  const Eigen::Index n = one.system.leading().cols();
  const Eigen::VectorXd direction = test::randomState(static_cast<int>(n), 1.0, 5);
  Eigen::VectorXd product = Eigen::VectorXd::Zero(n);
  one.system.addProducts(direction, product, Precision::Full);
  const Eigen::VectorXd prescribed = one.system.timesPrescribed(sizes);
  const double entries = Eigen::MatrixXd(one.system.leading()).norm();

  test::asTeam(GetParam(), [&](const Team& team) {
    const Divided part = evaluated(team);
    EXPECT_LT((part.forces - one.forces).norm(), 1e-13 * one.forces.norm());
    EXPECT_NEAR(part.term->summary().strainEnergy, one.term->summary().strainEnergy,
                1e-13 * one.term->summary().strainEnergy);
    EXPECT_EQ(part.term->summary().minJ, one.term->summary().minJ);
    const Division division = part.system.leadingDivision();
    Eigen::VectorXd own = Eigen::VectorXd::Zero(std::ssize(division.own()));
    part.system.addProducts(direction(division.order), own, Precision::Full);
    const Eigen::VectorXd ofOne = product(std::vector<int>(division.own().begin(), division.own().end()));
    EXPECT_LT((own - ofOne).norm(), 1e-13 * entries);
    EXPECT_GT(ofOne.norm(), 1e-3 * entries) << "else nothing was compared";
    Eigen::VectorXd moved = part.system.timesPrescribed(sizes);
    team.sum(asSpan(moved));
    EXPECT_LT((moved - prescribed).norm(), 1e-12 * prescribed.norm());
  });
}
INSTANTIATE_TEST_SUITE_P(Ranks, DividedAmong, testing::Values(2, 3, 4));

}  // namespace
}  // namespace burnish
