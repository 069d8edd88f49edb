#include "postproc/probe/probe.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/error.h"
#include "postproc/probe/depth_numbers.h"
#include "postproc/probe/probe_spec.h"
#include "postproc/probe/probed_run.h"
#include "tests/message_of.h"
#include "tests/postproc/sample_records.h"

namespace burnish {
namespace {

using samples::Sample;
using testing::HasSubstr;

constexpr double kExact = 1e-10;
constexpr double kBorder = 1e-8;  // of the size of a body: where a path leaves it

Eigen::VectorXd at(std::initializer_list<double> coordinates) {
  return Eigen::Map<const Eigen::VectorXd>(std::data(coordinates), std::ssize(coordinates));
}

std::vector<ProbePoint> probed(const Sample& sample, const std::string& field, const ProbePath& path,
                               const ProbeOptions& options = {}) {
  return probedPath(sample.model, sample.frame, ProbedFields(sample.model, sample.frame, {field}), path,
                    options);
}

std::vector<ProbePoint> inside(std::vector<ProbePoint> points) {
  std::erase_if(points, [](const ProbePoint& point) { return point.body == ProbePoint::kOutside; });
  return points;
}

std::string mistake(const Sample& sample, const std::string& field, const ProbePath& path) {
  return messageOf([&] { probed(sample, field, path); });
}

TEST(ProbedLine, HasTheExactValuesOfARingAndEndsAtItsCircles) {
  const Eigen::Vector2d direction(std::cos(0.7), std::sin(0.7));
  const auto points = probed(samples::ring(), "von_mises", LinePath{at({0, 0}), 3.0 * direction});
  const auto body = inside(points);
  ASSERT_GT(body.size(), 100U);
  for (const ProbePoint& point : body) {
    EXPECT_NEAR(point.values(0), 100.0 * (point.current.norm() - 1.0), 100.0 * kExact);
    EXPECT_NEAR((point.current - point.at * direction).norm(), 0.0, kBorder);
  }
  EXPECT_NEAR(body.front().at, 1.0, kBorder);
  EXPECT_NEAR(body.back().at, 2.0, kBorder);
  for (const ProbePoint& point : points)
    if (point.at < 1.0 - kBorder || point.at > 2.0 + kBorder) {
      EXPECT_TRUE(std::isnan(point.values(0))) << point.at;
    }
}

TEST(ProbedLine, LiesInTheDeformedBodyOrInTheUndeformedOne) {
  // At x = 1.5 the slab is pressed to 0.85 of its height, and the strain is y² of the undeformed one.
  const LinePath upwards{at({1.5, -0.1}), at({1.5, 1.2})};
  const auto deformed = inside(probed(samples::slab(), "plastic_strain", upwards));
  EXPECT_NEAR(deformed.back().current(1), 0.85, kBorder);
  for (const ProbePoint& point : deformed) {
    EXPECT_NEAR(point.values(0), std::pow(point.current(1) / 0.85, 2), kExact);
    EXPECT_NEAR(point.reference(1), point.current(1) / 0.85, kExact);
  }
  const auto undeformed =
      inside(probed(samples::slab(), "plastic_strain", upwards, {.body = ProbedBody::Undeformed}));
  EXPECT_NEAR(undeformed.back().at, 1.1, kBorder);
  for (const ProbePoint& point : undeformed)
    EXPECT_NEAR(point.values(0), std::pow(point.reference(1), 2), kExact);
}

TEST(ProbedLine, IsInterruptedWhereItLeavesTheBody) {
  // The top lies at 1 - 0.6 s (1 - s), below the line between these two s.
  const double s = 0.5 * (1.0 - std::sqrt(1.0 - 4.0 * 0.05 / 0.6));
  const auto points = probed(samples::slab(), "plastic_strain", LinePath{at({-0.5, 0.95}), at({3.5, 0.95})});
  std::vector<double> borders;
  for (std::size_t k = 1; k < points.size(); ++k)
    if (points[k].body != points[k - 1].body) borders.push_back(points[k].at - 0.5);
  ASSERT_EQ(borders.size(), 4U);
  EXPECT_NEAR(borders[0], 0.0, 3.0 * kBorder);
  EXPECT_NEAR(borders[1], 3.0 * s, 3.0 * kBorder);
  EXPECT_NEAR(borders[2], 3.0 * (1.0 - s), 3.0 * kBorder);
  EXPECT_NEAR(borders[3], 3.0, 3.0 * kBorder);
}

TEST(ProbedDepth, IsTheMeanOverASpotOfTheFace) {
  // 4 s (1 - s) t², s = X/3, over X = 1.5 ± 0.5.
  const ProbeOptions spot{.body = ProbedBody::Undeformed, .points = 11, .spot = 1.0};
  const DepthPath below{{"top", ""}, at({1.5})};
  for (const ProbePoint& point : inside(probed(samples::slab(), "plastic_strain", below, spot))) {
    const double t = 1.0 - point.at;
    EXPECT_NEAR(point.values(0), (1.0 - 4.0 / 9.0 / 12.0) * t * t, 5e-5);
    EXPECT_NEAR(point.reference(0), 1.5, kBorder);
  }
  EXPECT_THAT(messageOf([&] {
                probed(samples::slab(), "plastic_strain", {DepthPath{{"top", ""}, at({0.4})}}, spot);
              }),
              HasSubstr("spot: found a length of 1 around 0.4 along the face, which is 3 long"));
  EXPECT_THAT(messageOf([&] {
                probed(samples::cube(), "pressure", {DepthPath{{"top", ""}, at({0.5, 0.5, 1.0})}}, spot);
              }),
              HasSubstr("that reaches beyond face top; expected a smaller one, or another place"));
  // In space over a square: of x + y + z the mean is the value in its middle.
  const ProbeOptions square{.body = ProbedBody::Undeformed, .points = 5, .spot = 0.4};
  const DepthPath under{{"top", ""}, at({0.3, 1.0, 0.6})};
  for (const ProbePoint& point : inside(probed(samples::cube(), "pressure", under, square)))
    EXPECT_NEAR(point.values(0), 0.9 + 1.0 - point.at, 1e-6);
}

/// The slab turned by 0.3, with a stress along it that grows by 400 from -200 at the face above, 20 across it, and a
/// plastic strain of 0.01 there that fades to 0.
Sample bentSlab() {
  Sample sample = samples::slab();
  const Eigen::MatrixXd& X = sample.model.mesh.patches.front().points;
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.3).toRotationMatrix();
  sample.frame.displacement = turn * X - X;
  Eigen::MatrixXd stress(4, X.cols());
  for (Eigen::Index a = 0; a < X.cols(); ++a) {
    const Eigen::Matrix2d turned =
        turn * Eigen::Vector2d(200.0 - 400.0 * X(1, a), 20.0).asDiagonal() * turn.transpose();
    stress.col(a) << turned(0, 0), turned(1, 1), turned(0, 1), 1000.0;
  }
  sample.frame.fields["stress"] = {{"xx", "yy", "xy", "zz"}, "MPa", stress};
  sample.frame.fields["plastic_strain"].values = 0.01 * X.row(1);
  return sample;
}

TEST(DepthNumbers, AreThoseOfABentStripHoweverItLies) {
  const Sample sample = bentSlab();
  ProbeSpec spec;
  spec.depth = "top@1.2";
  const DepthNumbers numbers = depthNumbers(sample.model, sample.frame, spec);
  EXPECT_NEAR(numbers.depth, 1.0, 1e-8);
  EXPECT_NEAR(numbers.force, 0.0, 1e-6);
  EXPECT_NEAR(numbers.moment, -400.0 / 12.0, 1e-3);
  EXPECT_NEAR(numbers.balance, 0.0, 1e-8);
  EXPECT_NEAR(numbers.unsteadiness, 0.1, 1e-8);
  EXPECT_NEAR(numbers.along.atFace, -200.0, 1e-6);
  EXPECT_NEAR(numbers.along.lowest, -200.0, 1e-6);
  EXPECT_NEAR(numbers.along.lowestAt, 0.0, 1e-8);
  EXPECT_NEAR(numbers.along.compressedDepth, 0.5, 1e-8);
  EXPECT_NEAR(numbers.across.atFace, 1000.0, 1e-6);
  EXPECT_EQ(numbers.across.compressedDepth, 0.0);
  EXPECT_NEAR(numbers.hardenedDepth, 0.8, 1e-8);
  spec.length = 0.25;
  spec.hardenedBelow = 0.02;
  const DepthNumbers part = depthNumbers(sample.model, sample.frame, spec);
  EXPECT_NEAR(part.force, -200.0 * 0.25 + 0.5 * 400.0 * 0.25 * 0.25, 1e-6);
  EXPECT_NEAR(part.along.compressedDepth, 0.25, 1e-8);
  EXPECT_EQ(part.hardenedDepth, 0.0);
}

TEST(ProbedRun, HasAFormulaInsteadOfFields) {
  const Sample sample = bentSlab();
  ProbeSpec spec;
  spec.depth = "top@1.2";
  spec.fields = {"plastic_strain", "stress.zz"};
  spec.formula = "3 * (200 + 1e4 * plastic_strain) + stress_zz";
  spec.formulaName = "Hardness [MPa]";
  EXPECT_TRUE(conflictsIn(spec).empty());
  const ProbedRun run = probedFrame(sample.model, sample.frame, spec);
  ASSERT_EQ(run.fields.size(), 1U);
  for (const ProbePoint& point : run.points) {
    if (point.body == ProbePoint::kOutside) continue;
    EXPECT_NEAR(point.values(0), 3.0 * (200.0 + 100.0 * (1.0 - point.at)) + 1000.0, 1e-6);
  }
  EXPECT_EQ(titlesOf(spec, {run}).y, "Hardness [MPa]");
  spec.formula = "2 * stress.zz";
  EXPECT_EQ(conflictsIn(spec).front().path, "formula");
}

Eigen::Matrix3d cubeTurn() {
  return Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
}

/// Below a turned face of a cube: stresses of -100 and -50 at the face in its directions that grow by 200 and by 100, a tenth
/// of the first one normal to it, and on the face shear stresses of 7 and -4 in its directions.
Sample turnedCube() {
  Sample cube = samples::cube();
  const Eigen::MatrixXd X = cube.model.mesh.patches.front().points;
  const Eigen::Matrix3d turn = cubeTurn();
  cube.frame.displacement = turn * X - X;
  Eigen::MatrixXd stress(6, X.cols());
  for (Eigen::Index a = 0; a < X.cols(); ++a) {
    const double depth = 1.0 - X(1, a);
    Eigen::Matrix3d local =
        Eigen::Vector3d(-100.0 + 200.0 * depth, -10.0, -50.0 + 100.0 * depth).asDiagonal();
    local(0, 1) = local(1, 0) = 7.0;
    local(1, 2) = local(2, 1) = -4.0;
    const Eigen::Matrix3d turned = turn * local * turn.transpose();
    stress.col(a) << turned(0, 0), turned(1, 1), turned(2, 2), turned(0, 1), turned(1, 2), turned(2, 0);
  }
  cube.frame.fields["stress"] = {{"xx", "yy", "zz", "xy", "yz", "zx"}, "MPa", stress};
  return cube;
}

TEST(DepthNumbers, AreInTheAxesOfASurfaceInSpace) {
  const Sample cube = turnedCube();
  const Eigen::Vector3d above = cubeTurn() * Eigen::Vector3d(0.4, 1.0, 0.5);
  ProbeSpec spec;
  spec.depth = fmt::format("top@{},{},{}", above(0), above(1), above(2));
  const DepthNumbers numbers = depthNumbers(cube.model, cube.frame, spec);
  EXPECT_NEAR(numbers.depth, 1.0, 1e-8);
  EXPECT_NEAR(numbers.along.lowest, -100.0, 1e-6);
  EXPECT_NEAR(numbers.along.compressedDepth, 0.5, 1e-8);
  EXPECT_NEAR(numbers.across.atFace, -50.0, 1e-6);
  EXPECT_NEAR(numbers.across.lowestAt, 0.0, 1e-8);
  EXPECT_NEAR(numbers.unsteadiness, 0.1, 1e-8);
  EXPECT_TRUE(std::isnan(numbers.force));
}

/// The same stresses as curves, as means over a spot and over a window, and along a face.
TEST(ProbedRun, HasStressesInTheAxesOfASurface) {
  const Sample cube = turnedCube();
  const Eigen::Vector3d above = cubeTurn() * Eigen::Vector3d(0.4, 1.0, 0.5);
  ProbeSpec spec;
  spec.depth = fmt::format("top@{},{},{}", above(0), above(1), above(2));
  spec.fields = {"stress.across",      "stress.along",        "stress.normal",
                 "stress.shear_along", "stress.shear_across", "pressure"};
  for (const std::optional<double>& spot : {std::optional<double>(), std::optional(0.2)}) {
    spec.spot = spot;
    EXPECT_TRUE(conflictsIn(spec).empty());
    const ProbedRun run = probedFrame(cube.model, cube.frame, spec);
    EXPECT_EQ(run.fields[0].name, "stress.across");
    EXPECT_EQ(run.fields[0].unit, "MPa");
    for (const ProbePoint& point : inside(run.points)) {
      EXPECT_NEAR(point.values(0), -50.0 + 100.0 * point.at, 1e-6);
      EXPECT_NEAR(point.values(1), -100.0 + 200.0 * point.at, 1e-6);
      EXPECT_NEAR(point.values(2), -10.0, 1e-6);
      EXPECT_NEAR(point.values(3), 7.0, 1e-6);
      EXPECT_NEAR(point.values(4), -4.0, 1e-6);
    }
  }
  const Sample strip = bentSlab();
  ProbeSpec along;
  along.face = "left";
  along.fields = {"stress.along", "stress.normal", "stress.across"};
  const std::vector<ProbePoint> points = inside(probedFrame(strip.model, strip.frame, along).points);
  for (const ProbePoint& point : points) {
    EXPECT_NEAR(point.values(0), 20.0, 1e-6);  // this face lies across the strip
    EXPECT_NEAR(point.values(1), 200.0 - 400.0 * point.reference(1), 1e-6);
    EXPECT_NEAR(point.values(2), 1000.0, 1e-6);
  }
  along.window = 0.1;
  EXPECT_NEAR(inside(probedFrame(strip.model, strip.frame, along).points).front().values(1), 190.0, 1e-4);
}

/// Of the traction on a face with its normal out of the body, in the direction of its parameter: a shear stress of 5 pulls
/// to the right above and upwards on the right.
TEST(ProbedRun, HasShearStressesWithTheSignOfTheTractionOnTheFace) {
  Sample slab = samples::slab();
  slab.frame.displacement.setZero();
  Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(4, slab.model.mesh.numNodes);
  stress.row(2).setConstant(5.0);
  slab.frame.fields["stress"] = {{"xx", "yy", "xy", "zz"}, "MPa", stress};
  ProbeSpec spec;
  spec.fields = {"stress.shear_along"};
  for (const auto& [face, expected] : {std::pair{"top@1.5", 5.0}, std::pair{"bottom@1.5", -5.0},
                                       std::pair{"right@0.5", 5.0}, std::pair{"left@0.5", -5.0}}) {
    spec.depth = face;
    spec.face.clear();
    EXPECT_NEAR(inside(probedFrame(slab.model, slab.frame, spec).points).front().values(0), expected, 1e-9)
        << face;
    spec.face = std::string(face).substr(0, std::string(face).find('@'));
    spec.depth.clear();
    EXPECT_NEAR(probedFrame(slab.model, slab.frame, spec).points[7].values(0), expected, 1e-9) << face;
  }
}

TEST(ProbedRun, HasStressesInTheAxesOfASurfaceOfFacesAlone) {
  ProbeSpec spec;
  spec.line = "0,0:1,1";
  spec.fields = {"stress.along"};
  EXPECT_THAT(conflictsIn(spec).front().text, HasSubstr("expected depth or face as place"));
  spec.line.clear();
  spec.depth = "top@1";
  spec.reference = true;
  EXPECT_EQ(conflictsIn(spec).front().path, "reference");
  spec.reference = false;
  const Sample strip = samples::slab();
  spec.fields = {"stress.allong"};
  EXPECT_THAT(messageOf([&] { probedFrame(bentSlab().model, bentSlab().frame, spec); }),
              HasSubstr("Did you mean \"stress.along\"?"));
}

TEST(DepthNumbers, AreNotANumberWhereABodyHasNone) {
  ProbeSpec spec;
  spec.depth = "top@0.5,0.5,1";
  const Sample cube = samples::cube();
  const DepthNumbers numbers = depthNumbers(cube.model, cube.frame, spec);
  EXPECT_NEAR(numbers.depth, 1.0, 1e-8);
  EXPECT_TRUE(std::isnan(numbers.force));
  EXPECT_TRUE(std::isnan(numbers.hardenedDepth));
  spec.reference = true;
  EXPECT_THAT(messageOf([&] { depthNumbers(cube.model, cube.frame, spec); }), HasSubstr("reference: "));
}

TEST(ProbedLine, GoesThroughLagrangeElementsAndSpace) {
  for (const ProbePoint& point :
       inside(probed(samples::square(), "pressure", LinePath{at({-1, 0.5}), at({2, 0.5})}))) {
    const double X = point.current(0) - 0.1;
    EXPECT_NEAR(point.values(0), 1e-5 * (X * X * X - 0.5), 1e-5 * kExact);
  }
  const auto diagonal =
      inside(probed(samples::cube(), "pressure", LinePath{at({-0.5, -0.5, -0.5}), at({2, 2, 2})}));
  EXPECT_NEAR(diagonal.front().values(0), 0.0, kBorder);
  EXPECT_NEAR(diagonal.back().values(0), 3.0, kBorder);
  for (const ProbePoint& point : diagonal) EXPECT_NEAR(point.values(0), point.current.sum(), kExact);
}

TEST(ProbedLine, GoesThroughTheBodiesThatHaveTheField) {
  const Sample sample = samples::twoBodies();
  const LinePath across{at({2.5, 0.3}), at({5, 0.3})};
  const auto stress = inside(probed(sample, "von_mises", across));
  for (const ProbePoint& point : stress)
    EXPECT_NEAR(point.values(0), 10.0 * point.reference(0), 10.0 * kExact);
  EXPECT_EQ(stress.front().body, 0);
  EXPECT_EQ(stress.back().body, 1);
  EXPECT_NEAR(stress.back().at, 2.0, 5.0 * kBorder);
  for (const ProbePoint& point : inside(probed(sample, "plastic_strain", across)))
    EXPECT_EQ(std::isnan(point.values(0)), point.body == 1);
  EXPECT_THAT(mistake(sample, "plastic_strain", LinePath{at({3.7, 0.3}), at({4, 0.3})}),
              HasSubstr("line: none of the bodies on it has the field plastic_strain"));
}

TEST(ProbedLine, IsInterruptedBetweenBodiesThatTouch) {
  Sample sample = samples::twoBodies();
  for (const int node : sample.model.mesh.patches[1].nodes) sample.frame.displacement(0, node) = -0.5;
  const auto points = probed(sample, "von_mises", LinePath{at({2.5, 0.3}), at({3.5, 0.3})});
  std::size_t gaps = 0;
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    if (points[k].body != ProbePoint::kOutside) continue;
    ++gaps;
    EXPECT_NEAR(points[k - 1].values(0), 30.0, 1e-6);
    EXPECT_NEAR(points[k + 1].values(0), 35.0, 1e-6);
  }
  EXPECT_EQ(gaps, 1U);
}

TEST(ProbedFace, RunsAlongItsArc) {
  const double length = 7.5 * (0.2 * std::sqrt(1.04) + std::asinh(0.2));  // of the parabola of the top
  const auto deformed = probed(samples::slab(), "plastic_strain", FacePath{{"top", ""}});
  EXPECT_NEAR(deformed.back().at, length, kExact);
  for (const ProbePoint& point : deformed) {
    const double s = point.reference(0) / 3.0;
    EXPECT_NEAR(point.values(0), 4.0 * s * (1.0 - s), kExact);
    EXPECT_NEAR(point.current(1), 1.0 - 0.6 * s * (1.0 - s), kExact);
  }
  const auto undeformed =
      probed(samples::slab(), "plastic_strain", FacePath{{"top", ""}}, {.body = ProbedBody::Undeformed});
  for (const ProbePoint& point : undeformed) EXPECT_NEAR(point.at, point.reference(0), kExact);
  EXPECT_NEAR(undeformed.back().at, 3.0, kExact);
}

TEST(ProbedDepth, GoesAlongTheInwardNormalToTheOtherSide) {
  const auto slab = probed(samples::slab(), "plastic_strain", DepthPath{{"top", ""}, at({1.5, 1.0})});
  EXPECT_NEAR(slab.back().at, 0.85, kBorder);
  for (const ProbePoint& point : slab)
    EXPECT_NEAR(point.values(0), std::pow((0.85 - point.at) / 0.85, 2), kExact);

  for (const Eigen::VectorXd& place : {at({3.0, 3.0}), at({0.5 * M_PI})}) {
    const auto ring = probed(samples::ring(), "von_mises", DepthPath{{"right", ""}, place});
    EXPECT_NEAR(ring.front().current(0), std::sqrt(2.0), 1e-7);
    EXPECT_NEAR(ring.back().at, 1.0, kBorder);
    for (const ProbePoint& point : ring) EXPECT_NEAR(point.values(0), 100.0 * (1.0 - point.at), 1e-6);
  }
  const auto part = probed(samples::ring(), "von_mises", DepthPath{{"left", ""}, at({0.3}), 0.25});
  EXPECT_EQ(part.back().at, 0.25);
  EXPECT_NEAR(part.back().values(0), 25.0, 1e-6);

  const auto cube = probed(samples::cube(), "pressure", DepthPath{{"top", ""}, at({0.3, 1.0, 0.6})});
  EXPECT_NEAR(cube.back().at, 1.0, kBorder);
  for (const ProbePoint& point : cube) EXPECT_NEAR(point.values(0), 1.9 - point.at, 1e-9);
}

TEST(ProbeWindow, MeanOfALinearFieldIsItsMiddle) {
  const auto linear = probed(samples::cube(), "pressure", LinePath{at({0.2, 0.2, 0.2}), at({0.8, 0.7, 0.6})},
                             {.window = 0.3});
  for (const ProbePoint& point : linear) EXPECT_NEAR(point.values(0), point.current.sum(), kExact);
}

TEST(ProbeWindow, CountsWhatLiesInTheBody) {
  const auto points = probed(samples::cube(), "pressure", LinePath{at({-0.5, 0.5, 0.5}), at({1.5, 0.5, 0.5})},
                             {.window = 0.2});
  for (const ProbePoint& point : inside(points)) {
    const double begin = std::max(0.0, point.current(0) - 0.1), end = std::min(1.0, point.current(0) + 0.1);
    EXPECT_NEAR(point.values(0), 1.0 + 0.5 * (begin + end), kBorder);
  }
  EXPECT_NEAR(inside(points).front().values(0), 1.05, kBorder);
  EXPECT_TRUE(std::isnan(points.front().values(0)));
}

TEST(ProbeWindow, MeanOfASquareIsThatOfItsIntegral) {
  const double width = 0.2;
  const auto points =
      inside(probed(samples::slab(), "plastic_strain", LinePath{at({1.5, 0.2}), at({1.5, 0.8})},
                    {.body = ProbedBody::Undeformed, .points = 7, .window = width}));
  EXPECT_EQ(points.size(), 7U);
  for (const ProbePoint& point : points)
    EXPECT_NEAR(point.values(0), std::pow(point.reference(1), 2) + width * width / 12.0, kExact);
}

TEST(ProbePenetration, ThatIsSmallGivesTheValuesAtThePointsThemselves) {
  const DepthPath depth{{"top", ""}, at({0.3, 1.0, 0.6}), 1.0};
  const auto exact = probed(samples::cube(), "pressure", depth, {.points = 10});
  for (const double penetration : {1e-8, 1e-12, 1e-17, 1e-300, 5e-324}) {
    const auto points =
        probed(samples::cube(), "pressure", depth, {.points = 10, .penetration = penetration});
    ASSERT_EQ(points.size(), exact.size());
    for (std::size_t k = 0; k < points.size(); ++k)
      EXPECT_NEAR(points[k].values(0), exact[k].values(0), 2.0 * penetration + kExact)
          << penetration << " " << k;
  }
}

TEST(ProbePenetration, WeighsALinearFieldByTheExponential) {
  for (const double penetration : {0.03, 0.2, 5.0}) {
    const auto points = probed(samples::cube(), "pressure", DepthPath{{"top", ""}, at({0.3, 1.0, 0.6}), 0.9},
                               {.points = 10, .penetration = penetration});
    for (const ProbePoint& point : points) {
      const double below = 1.0 - point.at, rest = std::exp(-below / penetration);
      EXPECT_NEAR(point.values(0), 1.9 - point.at - penetration + below * rest / (1.0 - rest), 1e-8)
          << penetration;
    }
  }
}

TEST(ProbedMean, IsThatOfThePartsInTheBody) {
  const Sample slab = samples::slab(), two = samples::twoBodies();
  const ProbedFields strain(slab.model, slab.frame, {"plastic_strain"}),
      ofTwo(two.model, two.frame, {"plastic_strain", "von_mises"});
  const ProbePoint upwards =
      probedMean(slab.model, slab.frame, strain, LinePath{at({1.5, -1.0}), at({1.5, 2.0})});
  EXPECT_EQ(upwards.at, 1.5);  // the time
  EXPECT_NEAR(upwards.values(0), 1.0 / 3.0, kBorder);
  const ProbePoint along =
      probedMean(slab.model, slab.frame, strain, FacePath{{"top", ""}}, {.body = ProbedBody::Undeformed});
  EXPECT_NEAR(along.values(0), 2.0 / 3.0, kExact);
  const ProbePoint across = probedMean(two.model, two.frame, ofTwo, LinePath{at({3.7, 0.3}), at({9.7, 0.3})});
  EXPECT_TRUE(std::isnan(across.values(0)));
  EXPECT_NEAR(across.values(1), 41.0, 1e-6);
}

TEST(MaterialPoint, IsFollowedAlsoIntoANewMesh) {
  const Sample first = samples::slab();
  const MaterialPoint material(first.model, at({1.5, 0.8}));
  for (const Sample& sample : {first, samples::meshedAnew(first, samples::slab({7, 5}))}) {
    const ProbePoint point =
        material.in(sample.frame, ProbedFields(first.model, sample.frame, {"plastic_strain"}));
    EXPECT_EQ(point.at, 1.5);
    EXPECT_NEAR(point.values(0), 0.64, kExact);
    EXPECT_NEAR((point.current - at({1.5, 0.68})).norm(), 0.0, kExact);
  }
  EXPECT_THAT(
      messageOf([&] {
        MaterialPoint(first.model, at({1.5, 2.0}));
      }),
      HasSubstr("point: (1.5, 2) is 1 outside of the undeformed body, which lies between (0, 0) and (3, 1)"));
}

ProbeSpec contactSpec(std::vector<std::string> fields) {
  ProbeSpec spec;
  spec.face = "top";
  spec.fields = std::move(fields);
  return spec;
}

TEST(ProbedContact, HasThePointsOfTheSolverOverTheLengthOfTheDeformedFace) {
  const Sample sample = samples::rubbedSlab();
  const ContactRecord& contact = sample.frame.contact.front();
  const ProbedRun run = probedFrame(sample.model, sample.frame,
                                    contactSpec({"contact_pressure", "friction_traction", "sliding"}));
  ASSERT_EQ(std::ssize(run.points), contact.quadraturePoints.cols());
  EXPECT_EQ(run.fields[0].unit, "MPa");
  double length = 0.0;  // of the parabola, in short chords
  Eigen::Vector2d before(0.0, 1.0);
  Eigen::Index next = 0;
  constexpr int kChords = 48'000;
  for (int k = 1; k <= kChords && next < std::ssize(run.points); ++k) {
    const double s = static_cast<double>(k) / kChords;
    const Eigen::Vector2d here(3.0 * s, 1.0 - 0.6 * s * (1.0 - s));
    length += (here - before).norm();
    before = here;
    if (here.x() < contact.quadraturePoints(0, next) - 1e-9) continue;
    const ProbePoint& point = run.points[static_cast<std::size_t>(next)];
    EXPECT_NEAR(point.at, length, 1e-6);
    EXPECT_LT((point.current - contact.quadraturePoints.col(next)).norm(), 1e-12);
    EXPECT_EQ(point.values(0), contact.quadraturePressure(next));
    EXPECT_NEAR(point.values(1), 0.3 * contact.quadraturePressure(next), 1e-12);
    EXPECT_EQ(point.values(2), contact.quadratureSliding[static_cast<std::size_t>(next)]);
    ++next;
  }
  EXPECT_EQ(next, std::ssize(run.points));
}

/// The pressure goes up and down linearly over half of the face.
TEST(ProbedContact, WindowsTakeTheMean) {
  const Sample sample = samples::rubbedSlab();
  ProbeSpec spec = contactSpec({"contact_pressure"});
  const ProbedRun whole = probedFrame(sample.model, sample.frame, spec);
  spec.window = 100.0;
  double area = 0.0;
  for (std::size_t k = 1; k < whole.points.size(); ++k)
    area += 0.5 * (whole.points[k].at - whole.points[k - 1].at) *
            (whole.points[k].values(0) + whole.points[k - 1].values(0));
  const double length = whole.points.back().at + whole.points.front().at;  // as much is left at both ends
  for (const ProbePoint& point : probedFrame(sample.model, sample.frame, spec).points)
    EXPECT_NEAR(point.values(0), area / length, 1e-3 * area / length);
}

TEST(ProbedContact, SaysWhatIsNotThere) {
  const Sample sample = samples::rubbedSlab(), still = samples::slab();
  EXPECT_THAT(messageOf([&] { probedFrame(still.model, still.frame, contactSpec({"slip"})); }),
              HasSubstr("field: found \"slip\"; contact fields of frame 0: none."));
  ProbeSpec bottom = contactSpec({"slip"});
  bottom.face = "bottom";
  EXPECT_THAT(messageOf([&] { probedFrame(sample.model, sample.frame, bottom); }),
              HasSubstr("face: bottom is in no contact"));
  const auto problem = [](ProbeSpec spec) { return conflictsIn(spec).front().text; };
  EXPECT_THAT(problem(contactSpec({"slip", "von_mises"})), HasSubstr("a chart for each"));
  ProbeSpec line = contactSpec({"slip"});
  line.face.clear();
  line.line = "0,0:1,1";
  EXPECT_THAT(problem(line), HasSubstr("which faces alone have"));
}

TEST(Probe, SaysWhatWouldBeRight) {
  const Sample slab = samples::slab(), rubbed = samples::rubbedSlab();
  const LinePath line{at({0, 0.5}), at({1, 0.5})};
  EXPECT_THAT(
      mistake(slab, "plastic_strian", line),
      HasSubstr("field: found \"plastic_strian\"; available in frame 0: displacement, displacement.x, "
                "displacement.y, plastic_strain. Did you mean \"plastic_strain\"?"));
  EXPECT_THAT(mistake(rubbed, "contact_pressure", line),
              HasSubstr("found \"contact_pressure\", which only faces in contact have; available"));
  EXPECT_THAT(
      mistake(slab, "plastic_strain", LinePath{at({0, 5}), at({1, 5})}),
      HasSubstr("line: no point of it is in the deformed body of frame 0, which lies between (0, 0) and"));
  EXPECT_THAT(mistake(slab, "plastic_strain", LinePath{at({1, 1}), at({1, 1})}),
              HasSubstr("line: found (1, 1) twice; expected two points"));
  EXPECT_THAT(
      mistake(slab, "plastic_strain", LinePath{at({1, 0.5}), at({1e300, 1})}),
      HasSubstr("line: found a length of 1e+300; expected at most 1000 times the size of the body, 3"));
  EXPECT_THAT(mistake(slab, "plastic_strain", LinePath{at({1, 1, 1}), at({1, 1, 2})}),
              HasSubstr("line: found (1, 1, 1); the body has 2 dimensions"));
  EXPECT_THAT(
      mistake(slab, "plastic_strain", FacePath{{"topp", ""}}),
      HasSubstr("face: 'topp' is not a face; in 2 dimensions the faces are left, right, bottom, top"));
  EXPECT_THAT(mistake(slab, "plastic_strain", FacePath{{"top", "p"}}),
              HasSubstr("patch: found \"p\"; the body has one patch"));
  EXPECT_THAT(mistake(slab, "plastic_strain", DepthPath{{"top", ""}, at({9.0})}),
              HasSubstr("depth: found the place 9; expected a length along the face, 0 to 3.01"));
  EXPECT_THAT(
      mistake(samples::cube(), "pressure", FacePath{{"top", ""}}),
      HasSubstr(
          "face: a face of a body in space is an area, not a path; expected a line on it as well, such as "
          "line 0.1,1,0.5:0.9,1,0.5, or depth top@X,Y,Z"));
  EXPECT_THAT(mistake(slab, "plastic_strain", LaidPath{{"top", ""}, line}),
              HasSubstr("line: found beside a face of a plane body, which is a path itself"));
  EXPECT_THAT(mistake(samples::twoBodies(), "von_mises", FacePath{{"top", ""}}),
              HasSubstr("face: there are the bodies block, stamp; expected one of them, as --body block"));
}

}  // namespace
}  // namespace burnish
