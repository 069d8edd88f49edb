#include "engine/material/material_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/error.h"
#include "tests/engine/material/material_checks.h"

namespace burnish {
namespace {

const J2Plasticity kMetal({100.0, 0.3, ElasticLaw::NeoHookean, LinearHardening{0.5, 5.0}});
const NeoHookean kRubber({1.0, 0.3});

/// Two points, of which the second one has flowed.
MaterialPoints flowed() {
  MaterialPoints points(kMetal, 2);
  MaterialResponse<2> response;
  points.startEvaluation(0.5);
  points.visit([&](auto& law) {
    EXPECT_TRUE(law.template evaluate<2>(0, Eigen::Matrix3d::Identity(), response));
    EXPECT_TRUE(law.template evaluate<2>(1, test::skewed<2>(0.2), response));
  });
  points.accept();
  return points;
}

J2Plasticity::State expectedState() {
  return test::evaluate<2>(kMetal, test::skewed<2>(0.2)).state;
}

TEST(MaterialPoints, ShowTheFieldsOfTheLaw) {
  const Eigen::MatrixXd strain = flowed().field("plastic_strain");
  ASSERT_EQ(strain.rows(), 1);
  EXPECT_EQ(strain(0, 0), 0.0);
  EXPECT_EQ(strain(0, 1), expectedState().e_p);
  EXPECT_GT(strain(0, 1), 0.1);
  EXPECT_FALSE(MaterialPoints(kRubber, 2).hasField("plastic_strain"));
  EXPECT_THROW(MaterialPoints(kRubber, 2).field("plastic_strain"), Error);
}

/// Restart files of earlier versions hold F_inv and b_e by columns and e_p of one point after the other.
TEST(MaterialPoints, AreSavedMemberByMember) {
  StateArchive saved;
  MaterialPoints points = flowed();
  points.archive(saved);
  ASSERT_EQ(saved.values().size(), 1u);
  const Eigen::VectorXd history = saved.values().at("history");
  const J2Plasticity::State state = expectedState();
  Eigen::VectorXd expected(38);
  expected << Eigen::Matrix3d::Identity().reshaped(), Eigen::Matrix3d::Identity().reshaped(), 0.0,
      state.F_inv.reshaped(), state.b_e.reshaped(), state.e_p;
  EXPECT_EQ(history, expected);

  StateArchive restored(saved.values());
  MaterialPoints others(kMetal, 2);
  others.archive(restored);
  EXPECT_EQ(others.field("plastic_strain"), points.field("plastic_strain"));
  EXPECT_EQ(others.carried({2, test::skewed<2>(0.1)}).b_e, points.carried({2, test::skewed<2>(0.1)}).b_e);

  StateArchive wrong(saved.values());
  MaterialPoints three(kMetal, 3);
  EXPECT_THROW(three.archive(wrong), Error);
}

/// Back stresses and the time of the step go through a saved state to the same bits.
TEST(MaterialPoints, WithBackStressesGoOnFromASavedState) {
  Chaboche::Parameters parameters;
  parameters.E = 100.0;
  parameters.nu = 0.3;
  parameters.hardening = LinearHardening{0.5, 5.0};
  parameters.backStresses = {{20.0, 10.0}, {2.0, 0.0}};
  parameters.rate = NortonRate{0.2, 3.0};
  const auto respond = [](MaterialPoints& points, double t, double amount) {
    MaterialResponse<2> response;
    points.startEvaluation(t);
    points.visit(
        [&](auto& law) { EXPECT_TRUE(law.template evaluate<2>(0, test::skewed<2>(amount), response)); });
    return response.tau;
  };
  MaterialPoints points(Chaboche(parameters), 1);
  respond(points, 0.0, 0.0);
  points.accept();
  respond(points, 0.5, 0.1);
  points.accept();
  EXPECT_GT(points.field("back_stress")(0, 0), 0.1);

  StateArchive saved;
  points.archive(saved);
  StateArchive restored(saved.values());
  MaterialPoints others(Chaboche(parameters), 1);
  others.archive(restored);
  EXPECT_EQ(others.field("back_stress"), points.field("back_stress"));
  EXPECT_EQ(respond(others, 0.75, 0.08), respond(points, 0.75, 0.08));
  EXPECT_NE(respond(others, 0.75, 0.08), respond(points, 1.0, 0.08));
}

TEST(MaterialPoints, OfAnElasticLawSaveNothing) {
  StateArchive saved;
  MaterialPoints(kRubber, 2).archive(saved);
  EXPECT_TRUE(saved.values().empty());
}

TEST(MaterialPoints, GoAlongToANewReference) {
  const MaterialPoints points = flowed();
  const std::vector<Eigen::Matrix3d> F{Eigen::Matrix3d::Identity(), test::skewed<2>(0.2)};
  const PointStates states = points.carried(F);
  ASSERT_EQ(states.kinds.size(), 1u);
  EXPECT_EQ(states.kinds[0].name, "e_p");
  EXPECT_EQ(states.numbers, points.field("plastic_strain"));
  const J2Plasticity::State state = expectedState();
  EXPECT_LT((states.b_e[1] - state.b_e).norm(), 1e-14);

  MaterialPoints anew(kMetal, 2);
  anew.begin(F, states.numbers);
  EXPECT_EQ(anew.field("plastic_strain"), points.field("plastic_strain"));
}

/// Laws that depend on rates are given the length of the step.
TEST(MaterialPoints, KnowTheLengthOfTheStep) {
  MaterialPoints points(kRubber, 1);
  const auto step = [&](double t) {
    points.startEvaluation(t);
    return points.visit([](const auto& law) { return law.timeStep; });
  };
  EXPECT_EQ(step(-1.0), std::numeric_limits<double>::infinity());
  points.accept();
  EXPECT_EQ(step(-0.75), 0.25);
  EXPECT_EQ(step(-0.5), 0.5);  // nothing was accepted
  points.accept();
  EXPECT_EQ(step(-0.5), 0.5);  // a state that is settled at its time
  EXPECT_EQ(step(0.0), 0.5);
}

/// A stress of Newton's fluid: τ = 2 η dev d, the rate d from the deformation since the accepted state.
struct Fluid {
  struct State {
    Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  };

  template <int Dim>
  bool evaluate(const Eigen::Matrix3d& F, double dt, const State& old, State& next,
                MaterialResponse<Dim>& out) const {
    next.F = F;
    out.tau = components<Dim>((F * old.F.inverse() - Eigen::Matrix3d::Identity()) / dt);
    return true;
  }
};

TEST(PointsOf, HandTheStepToALawThatDependsOnRates) {
  static_assert(RateDependent<Fluid> && !RateDependent<NeoHookean> && !RateDependent<J2Plasticity>);
  PointsOf<Fluid> points{{}, std::vector<Fluid::State>(1), std::vector<Fluid::State>(1)};
  points.timeStep = 0.5;
  MaterialResponse<2> response;
  ASSERT_TRUE(points.evaluate<2>(0, Eigen::Vector3d(1.1, 1.0, 1.0).asDiagonal(), response));
  EXPECT_NEAR(response.tau(0), 0.2, 1e-15);
  EXPECT_EQ(points.trial[0].F(0, 0), 1.1);
}

TEST(Material, ListsTheFieldsOfItsLaws) {
  for (const auto& names : {materialFieldNames(), materialScalarNames(), materialComponentNames()})
    EXPECT_EQ(std::count(names.begin(), names.end(), "plastic_strain"), 1);
  EXPECT_EQ(whyWithout(NeoHookean::Parameters{}, "plastic_strain"), "the material is elastic");
  EXPECT_EQ(whyWithout(J2Plasticity::Parameters{}, "plastic_strain"), "");
  EXPECT_EQ(whyWithout(NeoHookean::Parameters{}, "stress.xx"), "");
}

TEST(Material, IsMadeFromItsParameters) {
  const Material metal = MaterialLaws::make(J2Plasticity::Parameters{
      200.0, 0.25, ElasticLaw::Hencky, TableHardening::Parameters{{0.0, 0.1}, {3.0, 4.0}}});
  EXPECT_EQ(youngsModulus(metal), 200.0);
  EXPECT_EQ(poissonsRatio(metal), 0.25);
  EXPECT_TRUE(flows(metal));
  EXPECT_DOUBLE_EQ(std::get<J2Plasticity>(metal).yieldStress(0.05), 3.5);
  EXPECT_FALSE(flows(MaterialLaws::make(NeoHookean::Parameters{1.0, 0.3})));
}

}  // namespace
}  // namespace burnish
