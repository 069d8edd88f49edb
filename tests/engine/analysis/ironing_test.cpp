// The ironing problem: what an exact answer must have, whatever the mesh. The elastic slide is the paper's
// own, 49 x 25 functions; the rest runs on a coarser mesh.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "engine/analysis/build_model.h"
#include "engine/analysis/residual_scales.h"
#include "engine/solver/stepping.h"
#include "tests/engine/analysis/run_scene.h"

namespace burnish {
namespace {

using Overrides = std::vector<std::string>;

Scene fullScene(const std::string& name, Overrides overrides) {
  for (const char* quiet : {"pictures=[]", "output={vtu: false}"}) overrides.insert(overrides.begin(), quiet);
  return readScene(std::string(BURNISH_SOURCE_DIR) + "/scenes/paper/" + name + ".yaml", overrides);
}

Scene coarseScene(const std::string& name, Overrides overrides) {
  for (const char* coarse : {"geometry.functions=[25, 13]", "steps[0].count=10", "steps[1].count=40"})
    overrides.insert(overrides.begin(), coarse);
  return fullScene(name, std::move(overrides));
}

double largest(const std::vector<double>& values) {
  double result = 0.0;
  for (const double v : values) result = std::max(result, std::abs(v));
  return result;
}

class ElasticIroning : public testing::TestWithParam<std::string> {};

TEST_P(ElasticIroning, IsMirrorSymmetricAndConservesEnergyWithoutACutBack) {
  const auto outcome = test::run(fullScene("elastic", {"basis=" + GetParam()}), "ironing_" + GetParam());
  ASSERT_TRUE(outcome.summary.completed);
  EXPECT_EQ(outcome.summary.cuts, 0);
  const auto &t = outcome.history.column("time"), &fx = outcome.history.column("cylinder.fx"),
             &fy = outcome.history.column("cylinder.fy");
  std::map<long, std::size_t> rowAt;
  for (std::size_t k = 0; k < t.size(); ++k) rowAt[std::lround(1e6 * t[k])] = k;
  const double scale = largest(fy);
  for (std::size_t k = 0; k < t.size(); ++k) {
    if (t[k] < 1.0) continue;
    const std::size_t mirror = rowAt.at(std::lround(1e6 * (3.0 - t[k])));
    EXPECT_NEAR(fy[k], fy[mirror], 1e-6 * scale) << "t = " << t[k];
    EXPECT_NEAR(fx[k], -fx[mirror], 1e-6 * scale) << "t = " << t[k];
    const double stored = outcome.history.column("strain_energy")[k];
    EXPECT_NEAR(outcome.history.column("external_work")[k], stored, 0.002 * stored) << "t = " << t[k];
  }
  EXPECT_GT(scale, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Bases, ElasticIroning, testing::Values("nurbs", "lagrange"));

TEST(Ironing, DoesNotDependOnTheAugmentedLagrangianParameter) {
  const Overrides shortSlide{"steps[1].until=1.3", "steps[1].count=12",
                             "tools[0].motion={times: [0, 1, 1.3], x: [0, 0, 0.6], y: [0, -0.075, -0.075]}"};
  for (const char* basis : {"basis=nurbs", "basis=lagrange"}) {
    Overrides soft = shortSlide, stiff = shortSlide;
    soft.push_back(basis);
    stiff.push_back(basis);
    soft.push_back("contact[0].parameter=0.1");
    stiff.push_back("contact[0].parameter=10");
    const auto a = test::run(coarseScene("elastic", soft), "soft"),
               b = test::run(coarseScene("elastic", stiff), "stiff");
    ASSERT_EQ(a.history.numRows(), b.history.numRows());
    for (const char* column : {"cylinder.fx", "cylinder.fy", "strain_energy", "external_work"}) {
      const double scale = largest(a.history.column(column));
      for (std::size_t k = 0; k < a.history.numRows(); ++k)
        EXPECT_NEAR(a.history.column(column)[k], b.history.column(column)[k], 1e-8 * scale)
            << column << " row " << k;
    }
    EXPECT_LT((a.lastFrame.displacement - b.lastFrame.displacement).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST(Ironing, NurbsAndLagrangeOfDegreeOneAreTheSame) {
  for (const char* scene : {"elastic", "plastic"}) {
    const Overrides press{"degree=1", "steps=[{until: 1, count: 10}]"};
    Overrides nurbs = press, lagrange = press;
    nurbs.push_back("basis=nurbs");
    lagrange.push_back("basis=lagrange");
    const auto a = test::run(coarseScene(scene, nurbs), "p1n"),
               b = test::run(coarseScene(scene, lagrange), "p1l");
    ASSERT_EQ(a.history.numRows(), b.history.numRows());
    for (std::size_t c = 0; c < a.history.columns.size(); ++c) {
      // The moment about the cylinder's axis vanishes up to rounding of the forces.
      const bool isMoment = a.history.columns[c] == "cylinder.mz";
      const double scale =
          std::max(1e-300, largest(isMoment ? a.history.column("cylinder.fy") : a.history.values[c]));
      for (std::size_t k = 0; k < a.history.numRows(); ++k)
        EXPECT_NEAR(a.history.values[c][k], b.history.values[c][k], 1e-12 * scale) << a.history.columns[c];
    }
  }
}

/// Steps a model through the press phase and hands every accepted step to `check`.
template <class Check>
void press(const Scene& scene, const Check& check) {
  const auto built = buildModel<2>(scene);
  Model<2>& model = *built;
  const auto terms = model.terms();
  Newton newton(terms, model.prescribed(), residualScales(model), {});
  Stepping stepping(
      newton, terms, [&](double t) { return model.target(t); }, {}, model.startState());
  const Walk walk = stepping.advance(1.0, 0.1, [&](const StepReport& step) {
    check(model, newton, step);
    return true;
  });
  ASSERT_EQ(walk, Walk::Arrived);
}

TEST(Ironing, TheToolsReactionIsTheReactionOfTheBottom) {
  for (const auto& [scene, tolerance] : {std::pair{"elastic", 1e-9}, std::pair{"plastic", 1e-7}})
    press(coarseScene(scene, {}),
          [&, tol = tolerance](Model<2>& model, const Newton& newton, const StepReport&) {
            Eigen::Vector2d bottom = Eigen::Vector2d::Zero();
            for (int i = 0; i < model.numDisplacements(); ++i)
              if (model.prescribed()[static_cast<std::size_t>(i)]) bottom(i % 2) += newton.forces()[0](i);
            const Eigen::Vector2d tool = model.contacts().front().term->state().reaction.head<2>();
            // The body hangs between the two: what its bottom is held with, the tool presses against.
            EXPECT_LT((bottom - tool).norm(), tol * tool.norm());
            EXPECT_GT(tool(1), 0.0);
          });
}

TEST(Ironing, NewtonEndsQuadratically) {
  int judged = 0;
  press(coarseScene("elastic", {}), [&](Model<2>&, const Newton&, const StepReport& step) {
    const auto& r = step.newton.history;
    for (std::size_t k = 1; k + 1 < r.size(); ++k) {
      if (r[k] > 1e-3) continue;  // the active set may still change
      EXPECT_LT(r[k + 1], 100.0 * r[k] * r[k] + 1e-12);
      ++judged;
    }
  });
  EXPECT_GE(judged, 5);
  judged = 0;
  press(coarseScene("plastic", {}), [&](Model<2>&, const Newton&, const StepReport& step) {
    const auto& r = step.newton.history;
    const std::size_t last = r.size() - 1;
    if (r[last - 1] > 1e-3) return;
    EXPECT_LT(r[last], 1e3 * r[last - 1] * r[last - 1] + 1e-10);
    ++judged;
  });
  EXPECT_GE(judged, 5);
}

TEST(Ironing, ElastoplasticWorkIsStoredOrDissipated) {
  const auto outcome =
      test::run(coarseScene("plastic",
                            {"steps[1].until=1.3", "steps[1].count=30",
                             "tools[0].motion={times: [0, 1, 1.3], x: [0, 0, 0.6], y: [0, -0.075, -0.075]}"}),
                "plastic");
  ASSERT_TRUE(outcome.summary.completed);
  const auto& end = outcome.summary.end;
  EXPECT_NEAR(end.externalWork, end.strainEnergy + end.plasticWork, 0.01 * end.externalWork);
  EXPECT_GT(end.maxPlasticStrain, 0.3);
  EXPECT_GT(end.plasticWork, 5.0 * end.strainEnergy);
}

TEST(Ironing, OfThePapersElastoplasticSlabReachesTheEndOfTheSlide) {
  const auto outcome = test::run(fullScene("plastic", {}), "plastic_full");
  ASSERT_TRUE(outcome.summary.completed);
  const auto& end = outcome.summary.end;
  EXPECT_EQ(end.toolPoses.front().displacement(0), 2.0);
  EXPECT_LT(outcome.summary.worstResidual, 1e-9);
  EXPECT_NEAR(end.externalWork, end.strainEnergy + end.plasticWork, 0.01 * end.externalWork);
  EXPECT_FALSE(outcome.summary.doubts.empty()) << "the plough loses its resolution and the run has to say so";
}

TEST(Ironing, HasTheSameBitsWithAnyNumberOfThreads) {
  const auto scene = coarseScene("plastic", {"steps=[{until: 0.4, count: 4}]"});
  const auto one = test::run(scene, "threads1", 1), two = test::run(scene, "threads2", 2),
             four = test::run(scene, "threads4", 4);
  EXPECT_EQ(one.history.values, two.history.values);
  EXPECT_EQ(one.history.values, four.history.values);
  EXPECT_EQ(one.lastFrame.displacement, two.lastFrame.displacement);
  EXPECT_EQ(one.lastFrame.displacement, four.lastFrame.displacement);
  EXPECT_GT(one.summary.end.maxPlasticStrain, 0.0);
}

/// The tool is lifted by several times the springback in one step, from a body that has flowed.
class LiftedTool : public testing::TestWithParam<std::string> {};

TEST_P(LiftedTool, LetsGoInAFewIterations) {
  const auto outcome = test::run(
      coarseScene("plastic", {"contact[0].method=" + GetParam(),
                              "tools[0].motion={times: [0, 1, 2], x: [0, 0, 0], y: [0, -0.03, 0.02]}",
                              "steps=[{until: 1, count: 5}, {until: 2, count: 5}]"}),
      "let_go");
  ASSERT_TRUE(outcome.summary.completed);
  EXPECT_EQ(outcome.summary.cuts, 0);
  const auto &time = outcome.history.column("time"), &force = outcome.history.column("cylinder.fy"),
             &iterations = outcome.history.column("newton_iterations");
  for (std::size_t k = 0; k < time.size(); ++k) {
    if (time[k] <= 1.0) continue;
    EXPECT_LE(iterations[k], time[k] < 1.25 ? 6 : 1) << "at t = " << time[k];
    EXPECT_EQ(force[k], 0.0);
  }
  EXPECT_GT(largest(force), 1.0);
  EXPECT_GT(outcome.summary.end.maxPlasticStrain, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Methods, LiftedTool,
                         testing::Values("augmented-lagrangian", "integral-augmented-lagrangian"),
                         [](const auto& method) { return method.index == 0 ? "ByAverages" : "AtPoints"; });

TEST(Ironing, WithALiftedToolBeginsAtZeroToo) {
  const auto scene = coarseScene("plastic", {"basis=lagrange", "steps=[{until: 0.2, count: 2}]"});
  ASSERT_LT(buildModel<2>(scene)->startTime(), 0.0);
  const auto outcome = test::run(scene, "lifted");
  ASSERT_TRUE(outcome.summary.completed);
  EXPECT_EQ(outcome.history.column("time").front(), 0.0);
}

}  // namespace
}  // namespace burnish
