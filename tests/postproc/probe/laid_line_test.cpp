#include "postproc/probe/laid_line.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/error.h"
#include "engine/nurbs/quadrature.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "postproc/probe/probe.h"
#include "postproc/probe/probe_spec.h"
#include "postproc/probe/probed_run.h"
#include "tests/message_of.h"
#include "tests/postproc/sample_records.h"

namespace burnish {
namespace {

using samples::Sample;
using testing::HasSubstr;

constexpr double kClose = 1e-9;

Eigen::Vector3d point(double x, double y, double z) {
  return {x, y, z};
}

/// The cube, moved by y² in its first direction and bulged above by a height h(x) = 0.4 x (1 - x), which grows with y.
Sample bulgedCube() {
  Sample cube = samples::cube();
  const KnotVector knots = KnotVector::uniform(2, 3);
  const int n = knots.numFunctions();
  const auto square = [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    return knots.knots()[k + 1] * knots.knots()[k + 2];
  };
  for (int a = 0; a < n * n * n; ++a) {
    const int i = a % n, j = a / n % n;
    cube.frame.displacement(0, a) = square(j);
    cube.frame.displacement(1, a) = 0.4 * (knots.greville(i) - square(i)) * knots.greville(j);
  }
  return cube;
}

std::vector<ProbePoint> inBody(std::vector<ProbePoint> points) {
  std::erase_if(points, [](const ProbePoint& p) { return p.body == ProbePoint::kOutside; });
  return points;
}

ProbeSpec onFace(const std::string& face, const std::string& line, const std::string& field) {
  ProbeSpec spec;
  spec.face = face;
  spec.line = line;
  spec.fields = {field};
  EXPECT_TRUE(conflictsIn(spec).empty());
  return spec;
}

/// Length of the parabola y = 0.4 x (1 - x) between two x.
double lengthOfBulge(double from, double to) {
  const auto integral = [](double slope) { return slope * std::hypot(1.0, slope) + std::asinh(slope); };
  return (integral(0.4 * (1.0 - 2.0 * from)) - integral(0.4 * (1.0 - 2.0 * to))) / 1.6;
}

/// Above the face and inclined: feet are those of normals, and lengths those of the parabola between them.
TEST(LaidLine, HasTheArcLengthOfTheDeformedFaceAndTheFieldsThere) {
  const Sample cube = bulgedCube();
  const ProbedRun run =
      probedFrame(cube.model, cube.frame, onFace("top", "1.2,1.15,0.5:1.8,1.15,0.5", "pressure"));
  ASSERT_EQ(run.points.size(), 401U);
  const double first = run.points.front().current(0) - 1.0;
  for (std::size_t k = 0; k < run.points.size(); ++k) {
    const ProbePoint& p = run.points[k];
    const double x = p.current(0) - 1.0;
    EXPECT_NEAR(p.at, lengthOfBulge(first, x), kClose);
    EXPECT_NEAR(p.current(1), 1.0 + 0.4 * x * (1.0 - x), kClose);
    EXPECT_NEAR((p.reference - point(x, 1.0, 0.5)).norm(), 0.0, kClose);
    EXPECT_NEAR(p.values(0), x + 1.5, kClose);
  }
  for (const std::size_t k :
       {std::size_t{0}, std::size_t{400}}) {  // across the face from the ends of the line
    const double x = run.points[k].current(0) - 1.0;
    const Eigen::Vector2d way(k == 0 ? 0.2 - x : 0.8 - x, 0.15 - 0.4 * x * (1.0 - x));
    EXPECT_NEAR(way.dot(Eigen::Vector2d(1.0, 0.4 * (1.0 - 2.0 * x))), 0.0, kClose);
  }
}

TEST(LaidLine, LiesOnTheUndeformedFaceOnDemand) {
  const Sample cube = bulgedCube();
  ProbeSpec spec = onFace("top", "0.2,1,0.3:0.8,1,0.7", "displacement.x");
  spec.reference = true;
  const double length = std::hypot(0.6, 0.4);
  const ProbedRun run = probedFrame(cube.model, cube.frame, spec);
  EXPECT_NEAR(run.points.back().at, length, kClose);
  for (const ProbePoint& p : run.points) {
    EXPECT_NEAR((p.reference - point(0.2, 1, 0.3) - p.at / length * point(0.6, 0, 0.4)).norm(), 0.0, kClose);
    EXPECT_NEAR(p.values(0), 1.0, kClose);
  }
  EXPECT_THAT(titlesOf(spec, {run}).x,
              HasSubstr("Distance along the line on face top of the undeformed body"));
}

/// Of chords and tangents of a cylinder; on a sphere great circles.
TEST(LaidLine, OfRoundFacesIsAsLongAsTheirAngles) {
  const KnotVector along = KnotVector::uniform(2, 5), straight = KnotVector::uniform(1, 2);
  const double right = 0.5 * std::numbers::pi;
  const Patch<3> pipe =
      refined(cylinderSegment({0, 0, 0}, 1.0, 2.0, 0.0, right, 3.0), {straight, along, straight});
  const Patch<2, 3> outer = tracePatch(pipe, faceFromName<3>("right"));
  const auto on = [](double radius, double angle, double z) {
    return point(radius * std::cos(angle), radius * std::sin(angle), z);
  };
  const LaidLine chord(outer, on(2.0, 0.1, 1.0), on(2.0, 1.4, 1.0), 401, 0.0);
  EXPECT_NEAR(chord.length(), 2.0 * 1.3, 1e-9);
  EXPECT_NEAR((chord.at(1.0).position - on(2.0, 0.6, 1.0)).norm(), 0.0, 1e-9);
  // Far from the face, where the method of Gauss and Newton would not arrive.
  const LaidLine tangent(outer, on(2.0 / std::cos(0.7), 0.1, 1.0), on(2.0 / std::cos(0.7), 1.5, 1.0), 401,
                         0.0);
  EXPECT_NEAR(tangent.length(), 2.0 * 1.4, 1e-9);
  const LaidLine far(outer, on(90.0, 0.1, 1.0), on(90.0, 1.5, 1.0), 401, 0.0);
  EXPECT_NEAR(far.length(), 2.0 * 1.4, 1e-9);
  const Patch<2, 3> ball =
      tracePatch(sphereSegment({0, 0, 0}, 1.0, 2.0, {-0.7, 0.7}, {-0.6, 0.6}), faceFromName<3>("right"));
  const Eigen::Vector3d begin =
      2.0 * point(std::cos(0.5) * std::cos(0.4), -std::sin(0.5) * std::cos(0.4), -std::sin(0.4));
  const Eigen::Vector3d end(begin(0), -begin(1), -begin(2));
  EXPECT_NEAR(LaidLine(ball, begin, end, 401, 0.0).length(), 2.0 * std::acos(begin.dot(end) / 4.0), 1e-8);
}

/// Where the line runs on beyond the face there are gaps, as long as it is.
TEST(LaidLine, EndsWhereItRunsOnBeyondTheFace) {
  const Sample cube = samples::cube();
  const ProbedRun run =
      probedFrame(cube.model, cube.frame, onFace("top", "-0.5,1.2,0.5:2,1.2,0.5", "pressure"));
  const auto body = inBody(run.points);
  EXPECT_NEAR(body.front().at, 0.5, 1e-8);
  EXPECT_NEAR(body.back().at, 1.5, 1e-8);
  EXPECT_NEAR(run.points.back().at, 2.5, 1e-8);
  EXPECT_TRUE(std::isnan(run.points.back().values(0)));
  for (const ProbePoint& p : body) {
    EXPECT_NEAR(p.at, p.current(0) + 0.5, 1e-8);
    EXPECT_NEAR(p.values(0), p.current(0) + 1.5, 1e-8);
  }
}

/// A border in a plane of symmetry: a face that is a little steep there is not left by a line above the border.
TEST(LaidLine, FollowsTheBorderThatItRunsBeside) {
  for (const double steep : {-0.05, 0.05}) {
    Sample cube = samples::cube();
    const Eigen::MatrixXd& X = cube.model.mesh.patches.front().points;
    cube.frame.displacement.row(1) = steep * (X.row(2).array() - 1.0) * X.row(1).array();
    const ProbedRun run =
        probedFrame(cube.model, cube.frame, onFace("top", "-0.5,1.4,1:1.5,1.4,1", "pressure"));
    const auto body = inBody(run.points);
    EXPECT_NEAR(body.front().at, 0.5, 1e-8);
    EXPECT_NEAR(body.back().at, 1.5, 1e-8);
    EXPECT_NEAR(run.points.back().at, 2.0, 1e-8);
    for (const ProbePoint& p : body) EXPECT_NEAR(p.values(0), p.at - 0.5 + p.reference(2) + 1.0, 1e-7);
    EXPECT_NEAR(body.front().current(2), steep < 0.0 ? 1.0 - 0.05 * 0.4 / (1.0 + 0.05 * 0.05) : 1.0, 1e-7);
  }
}

/// From above a groove that is narrower than its distance the nearest point jumps across it.
TEST(LaidLine, HasAGapWhereTheNearestPointJumps) {
  Patch<2, 3> sheet =
      tracePatch(refined(box({-1, 0, 0}, {2, 1, 1}),
                         {KnotVector::uniform(2, 16), KnotVector::uniform(1, 1), KnotVector::uniform(1, 1)}),
                 faceFromName<3>("top"));
  Eigen::MatrixXd points = sheet.points();
  for (Eigen::Index a = 0; a < points.cols(); ++a)
    points(1, a) -= std::exp(-50.0 * points(0, a) * points(0, a));
  const LaidLine line({sheet.basis(), points, sheet.weights()}, {-0.8, 1.5, 0.5}, {0.8, 1.5, 0.5}, 401, 0.0);
  double gap = 0.0;
  Eigen::Vector3d before = line.at(0.0).position;
  for (int k = 1; k <= 2000; ++k) {
    const LaidLine::Place place = line.at(line.length() * k / 2000);
    if (!place.xi) {
      gap += line.length() / 2000;
      continue;
    }
    if (gap == 0.0) before = place.position;
    if (place.position(0) > 0.0 && before(0) < 0.0) {
      EXPECT_NEAR((place.position - before).norm(), gap, 2e-3);
      EXPECT_GT(gap, 0.1);
      before = place.position;
    }
  }
  EXPECT_GT(gap, 0.1);
}

TEST(LaidLine, HasStressesInTheAxesOfTheFaceAtEachOfItsPoints) {
  const Patch<3> pipe =
      refined(cylinderSegment({0, 0, 0}, 1.0, 2.0, 0.2, 1.0, 3.0),
              {KnotVector::uniform(1, 1), KnotVector::uniform(2, 3), KnotVector::uniform(1, 1)});
  Sample sample = samples::cube();
  PatchRecord& record = sample.model.mesh.patches.front();
  record.directions.clear();
  for (int d = 0; d < 3; ++d) {
    const UnivariateBasis& basis = pipe.basis().direction(d);
    record.directions.push_back({basis.family(), basis.degree(), basis.knots()});
  }
  record.points = pipe.points();
  record.weights = pipe.weights();
  record.nodes.resize(static_cast<std::size_t>(pipe.points().cols()));
  for (std::size_t k = 0; k < record.nodes.size(); ++k) record.nodes[k] = static_cast<int>(k);
  sample.model.mesh.numNodes = static_cast<int>(record.nodes.size());
  sample.frame.displacement = Eigen::MatrixXd::Zero(3, pipe.points().cols());
  Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(6, pipe.points().cols());
  stress.row(0).setConstant(30.0);
  sample.frame.fields.clear();
  sample.frame.fields["stress"] = {{"xx", "yy", "zz", "xy", "yz", "zx"}, "MPa", stress};
  ProbeSpec spec = onFace("right", "1.9,0.5,1:1,1.7,2", "stress.normal");
  spec.fields = {"stress.normal", "stress.along", "stress.across", "stress.shear_along"};
  for (const ProbePoint& p : inBody(probedFrame(sample.model, sample.frame, spec).points)) {
    const double angle = std::atan2(p.current(1), p.current(0));
    EXPECT_NEAR(p.values(0), 30.0 * std::pow(std::cos(angle), 2), 1e-6);
    EXPECT_NEAR(p.values(1), 30.0 * std::pow(std::sin(angle), 2), 1e-6);
    EXPECT_NEAR(p.values(2), 0.0, 1e-6);
    EXPECT_NEAR(p.values(3), -15.0 * std::sin(2.0 * angle), 1e-6);
  }
}

/// A window goes on beyond the ends of the line, up to the border of the face.
TEST(LaidLine, HasMeansOverWindowsAndOverAllOfIt) {
  const Sample cube = samples::cube();
  ProbeSpec spec = onFace("top", "0.1,1.3,0.5:0.6,1.3,0.5", "pressure");
  spec.window = 0.4;
  for (const ProbePoint& p : probedFrame(cube.model, cube.frame, spec).points) {
    const double x = p.current(0), begin = std::max(0.0, x - 0.2), end = x + 0.2;
    EXPECT_NEAR(p.values(0), 1.5 + 0.5 * (begin + end), 1e-7);
  }
  const LaidPath path{{"top", ""}, {point(0.2, 1.1, 0.5), point(2.0, 1.1, 0.5)}};
  EXPECT_NEAR(
      probedMean(cube.model, cube.frame, ProbedFields(cube.model, cube.frame, {"pressure"}), path).values(0),
      2.1, 1e-7);
}

/// The bulged cube under a ball: what the solver has at 2 x 2 points of each of the 3 x 3 knot spans of its upper face.
Sample pressedCube() {
  Sample cube = bulgedCube();
  const Eigen::VectorXd gauss = gaussLegendre(2).points;
  ContactRecord contact;
  contact.tool = "ball";
  contact.face = "top";
  constexpr int kPoints = 36;
  contact.quadraturePoints.resize(3, kPoints);
  contact.quadraturePressure.resize(kPoints);
  contact.quadratureGap = Eigen::VectorXd::Zero(kPoints);
  contact.quadratureNormal = Eigen::MatrixXd::Zero(3, kPoints);
  contact.quadratureFriction = Eigen::MatrixXd::Zero(3, kPoints);
  contact.quadratureSlip = Eigen::MatrixXd::Zero(3, kPoints);
  contact.quadratureSlipped = Eigen::VectorXd::Zero(kPoints);
  for (int k = 0; k < kPoints; ++k) {
    const int span = k / 4;
    const double x = (span % 3 + gauss(k % 2)) / 3.0, z = (span / 3 + gauss(k / 2 % 2)) / 3.0;
    contact.quadraturePoints.col(k) << x + 1.0, 1.0 + 0.4 * x * (1.0 - x), z;
    contact.quadraturePressure(k) = (2.0 + 3.0 * x) * (1.0 + z);
    contact.quadratureFriction.col(k) << 0.0, 0.3 * contact.quadraturePressure(k), 0.0;
    contact.quadratureSliding.push_back(x < 0.5 ? 1 : 2);
  }
  cube.frame.contact = {contact};
  return cube;
}

/// Bilinear between the outermost points and constant beyond.
TEST(LaidLine, HasContactFieldsBetweenThePointsOfTheSolver) {
  const Sample cube = pressedCube();
  const double first = gaussLegendre(2).points(0) / 3.0;
  ProbeSpec spec = onFace("top", "0.5,1.2,0.3:2.5,1.2,0.6", "contact_pressure");
  spec.fields = {"contact_pressure", "friction_traction"};
  const auto body = inBody(probedFrame(cube.model, cube.frame, spec).points);
  ASSERT_GT(body.size(), 150U);
  for (const ProbePoint& p : body) {
    EXPECT_NEAR(p.current(0), p.reference(0) + 1.0, 1e-9);
    const double x = std::clamp(p.reference(0), first, 1.0 - first), z = p.reference(2);
    EXPECT_NEAR(p.values(0), (2.0 + 3.0 * x) * (1.0 + z), 1e-8);
    EXPECT_NEAR(p.values(1), 0.3 * p.values(0), 1e-12);
  }
  spec.fields = {"sliding"};
  for (const ProbePoint& p : inBody(probedFrame(cube.model, cube.frame, spec).points))
    if (std::abs(p.reference(0) - 0.5) > 1e-6) {
      EXPECT_EQ(p.values(0), p.reference(0) < 0.5 ? 1.0 : 2.0);
    }
}

TEST(LaidLine, HasMeansOfContactFieldsAndSeveralPartners) {
  Sample cube = pressedCube();
  ProbeSpec spec = onFace("top", "1.5,1.2,0.3:1.5,1.2,0.7", "contact_pressure");
  spec.window = 0.1;
  for (const ProbePoint& p : probedFrame(cube.model, cube.frame, spec).points)
    EXPECT_NEAR(p.values(0), 3.5 * (1.0 + p.current(2)), 1e-8);
  cube.frame.contact.push_back(cube.frame.contact.front());
  spec.window.reset();
  for (const ProbePoint& p : probedFrame(cube.model, cube.frame, spec).points)
    EXPECT_NEAR(p.values(0), 7.0 * (1.0 + p.current(2)), 1e-8);
  spec.fields = {"sliding"};
  for (const ProbePoint& p : probedFrame(cube.model, cube.frame, spec).points)
    EXPECT_TRUE(p.values(0) == 1.0 || p.values(0) == 2.0);
}

TEST(LaidLine, OfContactFieldsSaysWhatIsWrong) {
  const Sample cube = pressedCube();
  const auto mistake = [&](const std::string& face, const std::string& line) {
    ProbeSpec spec;
    spec.face = face;
    spec.line = line;
    spec.fields = {"contact_pressure"};
    return messageOf([&] { probedFrame(cube.model, cube.frame, spec); });
  };
  EXPECT_THAT(mistake("top", ""),
              HasSubstr("expected a line on it as well, such as line 1.1,1.036,0.5:1.9,1.036,0.5"));
  EXPECT_THAT(mistake("left", "0,0,0:0,0,1"), HasSubstr("face: left is in no contact"));
  EXPECT_THAT(mistake("top", "0,0,0:0,0,0"), HasSubstr("line: found (0, 0, 0) twice"));
  EXPECT_THAT(mistake("top", "5,1,0:6,1,0"),
              HasSubstr("line: no point of it is across from face top, which lies"));
  const Sample slab = samples::rubbedSlab();
  ProbeSpec plane;
  plane.face = "top";
  plane.line = "0,1:3,1";
  plane.fields = {"contact_pressure"};
  EXPECT_THAT(messageOf([&] { probedFrame(slab.model, slab.frame, plane); }),
              HasSubstr("line: found beside a face of a plane body"));
}

TEST(LaidLine, SaysWhatIsWrong) {
  const Sample cube = samples::cube();
  const auto mistake = [&](const std::string& line) {
    return messageOf([&] { probedFrame(cube.model, cube.frame, onFace("top", line, "pressure")); });
  };
  EXPECT_THAT(
      mistake("2,1,0.5:3,1,0.5"),
      HasSubstr("line: no point of it is across from face top, which lies between (0, 1, 0) and (1, 1, 1)"));
  EXPECT_THAT(mistake("0.5,1,0.5:0.5,2,0.5"),
              HasSubstr("line: found one across the face, which is a point on it"));
  EXPECT_THAT(mistake("0.5,1,0.5:0.5,1,0.5"), HasSubstr("line: found (0.5, 1, 0.5) twice"));
  EXPECT_THAT(mistake("0,1:1,1"), HasSubstr("line: found \"0,1:1,1\"; expected X0,Y0,Z0:X1,Y1,Z1"));
  ProbeSpec spec = onFace("above", "0,1,0:1,1,1", "pressure");
  EXPECT_THAT(messageOf([&] { requirePlace(cube.model, cube.frame, spec); }),
              HasSubstr("face: 'above' is not a face"));
  spec.depth = "top@0,1,0";
  EXPECT_THAT(conflictsIn(spec).front().text, HasSubstr("found line and face and depth; expected one of"));
}

}  // namespace
}  // namespace burnish
