// The measures of a scene at states with known answers.
#include "engine/analysis/measures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>

#include "engine/analysis/build_model.h"
#include "engine/analysis/residual_scales.h"
#include "engine/analysis/simulation.h"
#include "engine/fields/ellipse_measure.h"
#include "engine/fields/percentile_measure.h"
#include "engine/fields/point_measure.h"
#include "engine/solver/newton.h"
#include "tests/engine/scene/scene_samples.h"
#include "tests/engine/solid/term_check.h"
#include "tests/message_of.h"

namespace burnish {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kMeasured = R"(degree: 2
geometry: {shape: rectangle, size: [2, 1], spans: [4, 3]}
material: {law: neo-hookean, E: 1, nu: 0.25}
supports: [{face: bottom, fix: [x, y]}]
steps: [{until: 1, count: 1}]
)";

const std::string kRing = R"(degree: 2
geometry: {shape: annulus, inner_radius: 1, outer_radius: 2, spans: [2, 3]}
material: {law: neo-hookean, E: 1, nu: 0.25}
supports: [{face: bottom, fix: [x, y]}]
steps: [{until: 1, count: 1}]
)";

/// Two squares side by side, from x = 0 to 1 and to 2; the parameters of the second one are no shares.
const std::string kPair = R"(degree: 1
geometry:
  shape: patches
  patches:
    - {name: first, shape: rectangle, size: [1, 1], spans: [1, 1]}
    - name: second
      shape: control-net
      degrees: [1, 1]
      knots: [[3, 3, 5, 5], [-1, -1, 1, 1]]
      points: [[1, 0], [2, 0], [1, 1], [2, 1]]
material: {law: neo-hookean, E: 1, nu: 0.25}
supports: [{patch: first, face: left, fix: [x, y]}]
steps: [{until: 1, count: 1}]
)";

/// A scene's model and its measures.
class MeasuredScene {
 public:
  explicit MeasuredScene(const std::string& yaml) : scene_(parseScene(yaml, "test.yaml", {})) {}

  std::vector<std::string> columns() const { return measures_.columns(); }

  /// Values by column at t = 1 and the displacement gradient · X.
  std::map<std::string, double> atGradient(const Eigen::Matrix2d& gradient) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(model_.numUnknowns());
    const Eigen::MatrixXd u = gradient * model_.body().nodePositions();
    x.head(u.size()) = u.reshaped();
    return at(x);
  }

  /// Values by column in equilibrium at t = 1.
  std::map<std::string, double> inEquilibrium() {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(model_.numUnknowns());
    Newton newton(model_.terms(), model_.prescribed(), residualScales(model_), {.tolerance = 1e-12});
    EXPECT_EQ(newton.solve(1.0, model_.target(1.0), x).outcome, NewtonOutcome::Converged);
    return at(x);
  }

 private:
  std::map<std::string, double> at(const Eigen::VectorXd& x) {
    const auto terms = model_.terms();
    const Eigen::VectorXd bulkForce = test::forceOf(*terms.front(), 1.0, x);
    for (std::size_t k = 1; k < terms.size(); ++k) static_cast<void>(test::forceOf(*terms[k], 1.0, x));
    const auto names = measures_.columns();
    const auto values = measures_.values({1.0, x, bulkForce});
    EXPECT_EQ(names.size(), values.size());
    std::map<std::string, double> result;
    for (std::size_t k = 0; k < names.size(); ++k) result[names[k]] = values[k];
    return result;
  }

  Scene scene_;
  std::unique_ptr<Model<2>> built_ = buildModel<2>(scene_);
  Model<2>& model_ = *built_;
  std::vector<Projection<2>> projections_ = projectionsOf(model_);
  Measures<2> measures_{scene_, model_, projections_};
};

TEST(QuadraturePoints, AsManyAsTheDegreeNeedSmoothSplinesOfTwoSpans) {
  const auto said = [](const std::string& more) {
    return messageOf([&] {
      buildModel<2>(parseScene(kMeasured, "test.yaml", {"quadrature_points=2", more}));
    });
  };
  EXPECT_EQ(said("geometry.spans=[2, 2]"), "");
  for (const char* bad : {"geometry.spans=[4, 1]", "geometry.creases=[[0.5], []]"})
    EXPECT_THAT(said(bad),
                HasSubstr("quadrature_points: found 2 for a body with one knot span in a direction, or "
                          "with knots that stand several times; allowed there: at least 3"));
}

Eigen::Matrix2d someGradient() {
  return (Eigen::Matrix2d() << 0.02, 0.05, -0.03, 0.01).finished();
}

TEST(PointMeasure, FindsAPointByItsPosition) {
  MeasuredScene scene(kRing + "measures: [{name: p, kind: point, position: [1.2, 0.9]}]");
  const Eigen::Vector2d u = someGradient() * Eigen::Vector2d(1.2, 0.9);
  const auto values = scene.atGradient(someGradient());
  EXPECT_NEAR(values.at("p.ux"), u(0), 1e-14);
  EXPECT_NEAR(values.at("p.uy"), u(1), 1e-14);
}

TEST(PointMeasure, FindsThePatchOfAPosition) {
  MeasuredScene scene(kPair + "measures: [{name: p, kind: point, position: [1.7, 0.2]}]");
  EXPECT_NEAR(scene.atGradient(someGradient()).at("p.uy"), -0.03 * 1.7 + 0.01 * 0.2, 1e-14);
}

TEST(PointMeasure, ParametersAreSharesOfThePatch) {
  MeasuredScene scene(kPair + "measures: [{name: p, kind: point, patch: second, parameters: [0.25, 0.4]}]");
  EXPECT_NEAR(scene.atGradient(someGradient()).at("p.uy"), -0.03 * 1.25 + 0.01 * 0.4, 1e-14);
}

TEST(PointMeasure, RefusesAPositionOutsideTheBody) {
  const auto errorFor = [](const std::string& measure) {
    try {
      const MeasuredScene scene(kPair + "measures: [" + measure + "]");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(errorFor("{name: p, kind: point, position: [1.5, 1.5]}"),
              HasSubstr("measures[0]: the point (1.5, 1.5) is not in the body: the nearest one is 0.5 away"));
  EXPECT_THAT(errorFor("{name: p, kind: point, patch: first, position: [1.5, 0.5]}"),
              HasSubstr("the nearest one is 0.5 away"));
}

TEST(PointMeasure, KeepsTheOrderOfItsFields) {
  MeasuredScene scene(
      kMeasured + "measures: [{name: p, kind: point, parameters: [0.5, 1], fields: [stress, displacement]}]");
  EXPECT_THAT(scene.columns(),
              ElementsAre("p.stress_xx", "p.stress_yy", "p.stress_xy", "p.stress_zz", "p.ux", "p.uy"));
  // Lamé's constants are both 0.4; the strain is small.
  const double e = 1e-7;
  const auto values = scene.atGradient((Eigen::Matrix2d() << e, 0.0, 0.0, 0.0).finished());
  EXPECT_NEAR(values.at("p.stress_xx"), 1.2 * e, 1e-5 * e);
  EXPECT_NEAR(values.at("p.stress_yy"), 0.4 * e, 1e-5 * e);
  EXPECT_NEAR(values.at("p.stress_zz"), 0.4 * e, 1e-5 * e);
  EXPECT_NEAR(values.at("p.stress_xy"), 0.0, 1e-5 * e);
  EXPECT_NEAR(values.at("p.ux"), e, 1e-14 * e);
  EXPECT_NEAR(values.at("p.uy"), 0.0, 1e-14 * e);
}

TEST(FaceMeasure, HasTheMeanDisplacementOfAPart) {
  MeasuredScene scene(kMeasured + "measures: [{name: f, kind: face, face: top, part: [0.3, 0.9]}]");
  const Eigen::Vector2d u = someGradient() * Eigen::Vector2d(1.2, 1.0);  // of the part's middle
  const auto values = scene.atGradient(someGradient());
  EXPECT_NEAR(values.at("f.ux"), u(0), 1e-14);
  EXPECT_NEAR(values.at("f.uy"), u(1), 1e-14);
}

TEST(FaceMeasure, HasTheForcesOfItsSupportsAndOfItsOwnLoadsOnly) {
  MeasuredScene scene(kMeasured + R"(loads:
  - {body_force: [0.003, -0.02]}
  - {face: top, traction: [0.004, 0.01]}
  - {face: right, traction: [0, 0.005]}
measures:
  - {name: held, kind: face, face: bottom}
  - {name: loaded, kind: face, face: top}
)");
  const auto values = scene.inEquilibrium();
  EXPECT_NEAR(values.at("loaded.fx"), 2.0 * 0.004, 1e-13);
  EXPECT_NEAR(values.at("loaded.fy"), 2.0 * 0.01, 1e-13);
  EXPECT_NEAR(values.at("held.fx"), -2.0 * 0.003 - 2.0 * 0.004, 1e-13);
  EXPECT_NEAR(values.at("held.fy"), 2.0 * 0.02 - 2.0 * 0.01 - 0.005, 1e-13);
  EXPECT_EQ(values.at("held.ux"), 0.0);
}

/// p = 2 (1 - (s - 1.3)²/0.4²)^½ and its places from 0 to 3.
std::pair<Eigen::VectorXd, Eigen::VectorXd> knownEllipse() {
  const Eigen::VectorXd s = Eigen::VectorXd::LinSpaced(301, 0.0, 3.0);
  const Eigen::ArrayXd share = (s.array() - 1.3) / 0.4;
  return {s, 2.0 * (1.0 - share.square()).max(0.0).sqrt()};
}

TEST(HalfEllipse, IsFoundInItsOwnValues) {
  const auto [s, pressure] = knownEllipse();
  for (const std::optional<double>& middle : {std::optional<double>{}, std::optional(1.3)}) {
    const HalfEllipse fit = fittedHalfEllipse(s, pressure, middle);
    EXPECT_NEAR(fit.peak, 2.0, 1e-12);
    EXPECT_NEAR(fit.halfWidth, 0.4, 1e-12);
    EXPECT_NEAR(fit.middle, 1.3, 1e-12);
    EXPECT_LT(fit.deviation, 1e-12);
  }
}

TEST(HalfEllipse, DeviatesByTheLargestDifferenceOverThePeak) {
  auto [s, pressure] = knownEllipse();
  pressure(130) += 0.2;  // one of many points hardly changes the fit
  EXPECT_NEAR(fittedHalfEllipse(s, pressure, {}).deviation, 0.1, 5e-3);
}

TEST(HalfEllipse, IsZeroForTooFewPointsAndForOtherShapes) {
  const auto [s, pressure] = knownEllipse();
  EXPECT_EQ(fittedHalfEllipse(s.segment(128, 4), pressure.segment(128, 4), {}).peak, 0.0);
  EXPECT_GT(fittedHalfEllipse(s.segment(128, 5), pressure.segment(128, 5), {}).peak, 0.0);
  const Eigen::VectorXd hollow = 1.0 + (s.array() - 1.5).square();
  EXPECT_EQ(fittedHalfEllipse(s, hollow, {}).peak, 0.0);
}

TEST(EllipseMeasure, MeasuresArcLengthsOfTheDeformedFace) {
  MeasuredScene scene(samples::replaced(kMeasured, "[4, 3]", "[200, 1]") + R"(tools:
  - {name: inner, shape: cylinder, center: [1.5, 1.5], radius: 0.5, motion: {times: [0, 1], y: [0, -0.02]}}
  - {name: outer, shape: cylinder, center: [3, 1.5], radius: 0.5, motion: {times: [0, 1], y: [0, -0.02]}}
contact:
  - {tool: inner, face: top, method: pointwise-penalty, parameter: 10}
  - {tool: outer, face: top, method: pointwise-penalty, parameter: 10}
measures:
  - {name: free, kind: ellipse, tool: inner, face: top}
  - {name: end, kind: ellipse, tool: outer, face: top, middle: end}
)");
  const auto values = scene.atGradient((Eigen::Matrix2d() << 0.5, 0.0, 0.0, 0.0).finished());
  EXPECT_NEAR(values.at("free.middle"), 1.5, 1e-3);
  EXPECT_NEAR(values.at("end.middle"), 3.0, 1e-12);
  EXPECT_GT(values.at("free.half_width"), 0.1);
  EXPECT_NEAR(values.at("free.half_width"), values.at("end.half_width"), 1e-3);
  EXPECT_NEAR(values.at("free.peak"), values.at("end.peak"), 1e-3 * values.at("free.peak"));
}

TEST(EllipseMeasure, FitsThePressureOfAPairAndWithFrictionItsReserve) {
  const std::string pair = R"(degree: 2
bodies:
  - name: block
    geometry: {shape: rectangle, size: [2, 1], spans: [20, 3]}
    material: {law: neo-hookean, E: 1, nu: 0.25}
  - name: disc
    geometry: {shape: annulus, center: [1, 1.5], inner_radius: 0.2, outer_radius: 0.5, start_angle: -160, opening_angle: 140, spans: [2, 40]}
    material: {law: neo-hookean, E: 1, nu: 0.25}
supports:
  - {body: block, face: bottom, fix: [x, y]}
  - {body: disc, face: left, move: {times: [0, 1], x: [0, 0], y: [0, -0.02]}}
contact: [{name: touch, body: disc, face: right, against: {body: block, face: top}, friction: 0.3}]
steps: [{until: 1, count: 1}]
measures: [{name: fit, kind: ellipse, tool: touch, body: disc, face: right}]
)";
  MeasuredScene scene(pair);
  auto values = scene.inEquilibrium();
  EXPECT_GT(values.at("fit.half_width"), 0.05);
  EXPECT_GT(values.at("fit.stick_half_width"), 0.05);
  EXPECT_LE(values.at("fit.stick_peak"), 0.31 * values.at("fit.peak"));
  EXPECT_THAT(MeasuredScene(samples::replaced(pair, ", friction: 0.3", "")).columns(),
              ElementsAre("fit.peak", "fit.half_width", "fit.middle", "fit.deviation"));
  EXPECT_THROW(MeasuredScene(samples::replaced(pair, "tool: touch", "tool: other")), Error);
}

TEST(ExtentMeasure, IsTheBoxOfTheDeformedFace) {
  MeasuredScene scene(kMeasured + "measures: [{name: right, kind: extent, face: right}]\n");
  const auto values = scene.atGradient((Eigen::Matrix2d() << 0.5, 0.2, 0.0, -0.1).finished());
  // x = 1.5 X + 0.2 Y, y = 0.9 Y on X = 2, up to the outermost of three Gauss points in each of three spans.
  const double rest = (1.0 - std::sqrt(0.6)) / 6.0;
  EXPECT_NEAR(values.at("right.xmin"), 3.0 + 0.2 * rest, 1e-12);
  EXPECT_NEAR(values.at("right.xmax"), 3.2 - 0.2 * rest, 1e-12);
  EXPECT_NEAR(values.at("right.ymin"), 0.9 * rest, 1e-12);
  EXPECT_NEAR(values.at("right.ymax"), 0.9 * (1.0 - rest), 1e-12);
}

TEST(PercentileMeasure, WeighsValuesByVolume) {
  const Eigen::Vector4d values(3.0, 1.0, 2.0, 4.0), even = Eigen::Vector4d::Ones();
  EXPECT_DOUBLE_EQ(weightedPercentile(values, even, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(weightedPercentile(values, even, 0.375), 2.0);
  EXPECT_DOUBLE_EQ(weightedPercentile(values, even, 0.01), 1.0);
  EXPECT_DOUBLE_EQ(weightedPercentile(values, even, 0.999), 4.0);
  EXPECT_NEAR(weightedPercentile(values, Eigen::Vector4d(1e-6, 1.0, 1.0, 1e-6), 0.5), 1.5, 1e-5);

  MeasuredScene scene(kMeasured + "measures: [{name: p, kind: percentile, field: pressure, share: 0.9}]\n");
  const double uniform = scene.atGradient((Eigen::Matrix2d() << 0.1, 0.0, 0.0, 0.1).finished()).at("p.value");
  EXPECT_LT(uniform, 0.0);
}

}  // namespace
}  // namespace burnish
