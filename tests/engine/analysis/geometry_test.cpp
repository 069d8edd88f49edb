// Bodies as scenes describe them: refinement keeps the geometry, matching faces become one.
#include "engine/analysis/geometry.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "engine/solid/joined_body.h"
#include "engine/solid/span_quadrature.h"
#include "tests/engine/analysis/run_scene.h"

namespace burnish {
namespace {

using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

/// The body of a scene; `geometry` and `more` (top-level keys) are YAML.
template <int Dim>
NamedBody<Dim> bodyOf(const std::string& geometry, const std::string& more = "") {
  return makeBody<Dim>(parseScene(fmt::format("geometry: {}\nmaterial: {{law: neo-hookean, E: 1, nu: 0.3}}\n"
                                              "steps: [{{until: 1, count: 1}}]\n{}\n",
                                              geometry, more),
                                  "scene.yaml"));
}

template <int Dim>
Patch<Dim> patchOf(const std::string& geometry, const std::string& more = "") {
  return bodyOf<Dim>(geometry, more).body.patches.at(0);
}

template <class Body>
std::string errorOf(Body&& body) {
  try {
    body();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

std::string lists(const Eigen::MatrixXd& columns) {
  std::vector<std::string> points;
  for (Eigen::Index a = 0; a < columns.cols(); ++a)
    points.push_back(fmt::format("[{}]", fmt::join(columns.col(a), ", ")));
  return fmt::format("[{}]", fmt::join(points, ", "));
}

/// A patch as YAML of a control net; `mesh` is put behind it.
template <int Dim>
std::string netOf(const Patch<Dim>& patch, const std::string& mesh = "") {
  std::vector<int> degrees;
  std::vector<std::vector<double>> knots;
  for (int d = 0; d < Dim; ++d) {
    degrees.push_back(patch.basis().direction(d).degree());
    knots.push_back(patch.basis().direction(d).knots());
  }
  return fmt::format("shape: control-net, degrees: {}, knots: {}, points: {}, weights: [{}]{}", degrees,
                     knots, lists(patch.points()), fmt::join(patch.weights(), ", "), mesh);
}

/// Largest distance between two patches over random parameters.
template <int Dim>
double distance(const Patch<Dim>& a, const Patch<Dim>& b) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  double largest = 0.0;
  for (int k = 0; k < 200; ++k) {
    const auto xi = Eigen::Vector<double, Dim>::NullaryExpr([&] { return uniform(generator); }).eval();
    largest = std::max(largest, (a.position(xi) - b.position(xi)).norm());
  }
  return largest;
}

const Patch<2> quarterRing = annulus({0.0, 0.0}, 1.0, 2.0, 0.0, kPi / 2);
const std::string ringYaml = "{shape: annulus, inner_radius: 1, outer_radius: 2, ";

TEST(MeshOfAShape, GradingCreasesAndDegreeLeaveTheRingUnchanged) {
  const auto ring =
      patchOf<2>(ringYaml + "spans: [3, 5], grading: [s^2, s^0.7], creases: [[], [0.4, 1]]}", "degree: 4");
  EXPECT_EQ(ring.basis().direction(1).numFunctions(), 4 + 6 + 3);
  EXPECT_LT(distance(ring, quarterRing), 1e-13);
}

TEST(MeshOfAShape, BreakpointsAreTheGradedOnes) {
  const auto patch = patchOf<2>("{shape: rectangle, size: [1, 1], spans: [4, 1], grading: [s^power, s]}",
                                "definitions: [{name: power, formula: 1 + 1}]");
  EXPECT_EQ(patch.basis().direction(0).breakpoints(), (std::vector<double>{0, 1.0 / 16, 0.25, 9.0 / 16, 1}));
}

TEST(MeshOfAShape, ACreaseIsABreakpointWhereTheBasisIsContinuousOnly) {
  const std::string block =
      "{shape: rectangle, size: [1, 1], spans: [2, 2], creases: [[0.5, 0.6], [0.5001]]}";
  const auto nurbs = patchOf<2>(block, "degree: 3");
  EXPECT_EQ(nurbs.basis().direction(0).knots(),
            (std::vector<double>{0, 0, 0, 0, 0.5, 0.5, 0.5, 0.6, 0.6, 0.6, 1, 1, 1, 1}));
  EXPECT_EQ(nurbs.basis().direction(1).knots(), (std::vector<double>{0, 0, 0, 0, 0.5, 0.5, 0.5, 1, 1, 1, 1}))
      << "a breakpoint that is meant is not given a second time";
  const auto lagrange = patchOf<2>(block, "degree: 3\nbasis: lagrange");
  EXPECT_EQ(lagrange.basis().direction(0).breakpoints(), (std::vector<double>{0, 0.5, 0.6, 1}));
}

TEST(RoundBodies, HaveTheirVolumes) {
  const auto volume = [](const std::string& shape, int points) {
    return SpanQuadrature<3>(bodyOf<3>(shape).body, points).volume();
  };
  const std::string tube =
      "{shape: tube, center: [1, 2, 3], axis: [1, 1, 0], inner_radius: 1, outer_radius: 2, length: 3, "
      "start_angle: 20, opening_angle: 100, spans: [2, 3, 2]}";
  EXPECT_NEAR(volume(tube, 10) / (kPi * 3.0 * 3.0 * 100.0 / 360.0), 1.0, 1e-13);
  const std::string cylinder = "{shape: cylinder, axis: [1, 0, 0], radius: 2, length: 3, spans: [4, 4, 2]";
  EXPECT_NEAR(volume(cylinder + "}", 10) / (kPi * 4.0 * 3.0), 1.0, 1e-13);
  EXPECT_NEAR(volume(cylinder + ", opening_angle: 120}", 10) / (kPi * 4.0), 1.0, 1e-13);
  EXPECT_NEAR(volume("{shape: ball-octant, radius: 2, spans: [3, 3, 3]}", 10) / (kPi * 4.0 / 3.0), 1.0,
              1e-13);
}

TEST(RoundBodies, HaveTheirAreas) {
  const auto area = [](const std::string& shape) {
    return SpanQuadrature<2>(bodyOf<2>(shape).body, 10).volume();
  };
  EXPECT_NEAR(area("{shape: disc, center: [7, -3], radius: 2, start_angle: 10, spans: [4, 3]}") / (kPi * 4.0),
              1.0, 1e-13);
  EXPECT_NEAR(area("{shape: disc, radius: 2, opening_angle: 120, functions: [6, 5]}") / (kPi * 4.0 / 3.0),
              1.0, 1e-13);
  EXPECT_NEAR(area("{shape: ellipse, center: [7, -3], size: [4, 1], spans: [4, 3]}") / kPi, 1.0, 1e-13);
}

TEST(RoundBodies, AWholeDiscHasAQuarterOfTheCircleOnEveryFace) {
  const auto patch = patchOf<2>("{shape: disc, center: [7, -3], radius: 2, spans: [4, 4]}");
  const std::array<std::pair<Eigen::Vector2d, Eigen::Vector2d>, 4> middles{
      {{{1.0, 0.5}, {2, 0}}, {{0.5, 1.0}, {0, 2}}, {{0.0, 0.5}, {-2, 0}}, {{0.5, 0.0}, {0, -2}}}};
  for (const auto& [xi, expected] : middles)
    EXPECT_LT((patch.position(xi) - Eigen::Vector2d(7, -3) - expected).norm(), 1e-14);
  EXPECT_NEAR((patch.position(Eigen::Vector2d(0.3, 1.0)) - Eigen::Vector2d(7, -3)).norm(), 2.0, 1e-14);
}

TEST(RoundBodies, ShareTheNodesOfACollapsedEdge) {
  const auto ball = bodyOf<3>("{shape: ball-octant, radius: 2, spans: [2, 2, 2]}").body;
  EXPECT_EQ(ball.numNodes, 1 + 3 * (4 * 3 + 1)) << "one in the centre, one for each radius on the diameter";
}

TEST(ControlNet, IsTakenAsGivenWithoutADegree) {
  const auto shape = refined(quarterRing, {KnotVector::uniform(1, 2), KnotVector::uniform(2, 3)});
  const auto patch = patchOf<2>("{" + netOf(shape) + "}");
  EXPECT_EQ(patch.points(), shape.points());
  EXPECT_EQ(patch.weights(), shape.weights());
  EXPECT_EQ(patch.basis().direction(0).degree(), 1);
}

TEST(ControlNet, IsRaisedAndRefinedWithoutAChangeOfShape) {
  const auto patch =
      patchOf<2>("{" + netOf(quarterRing, ", refine: [2, 3], grading: [s, s^2]") + "}", "degree: 3");
  for (int d = 0; d < 2; ++d) EXPECT_EQ(patch.basis().direction(d).degree(), 3);
  EXPECT_EQ(patch.basis().direction(1).breakpoints(), (std::vector<double>{0, 1.0 / 9, 4.0 / 9, 1}));
  EXPECT_LT(distance(patch, quarterRing), 1e-13);

  const auto shell =
      refined(sphereSegment({1.0, 2.0, 3.0}, 0.5, 1.0, {0.0, kPi / 2}, {-0.4, 1.0}),
              {KnotVector::uniform(1, 2), KnotVector::uniform(2, 1), KnotVector::uniform(2, 2)});
  const auto fine =
      patchOf<3>("{" + netOf(shell, ", refine: [1, 2, 3], creases: [[0.5], [], [0.2]]") + "}", "degree: 3");
  EXPECT_EQ(fine.basis().direction(2).numSpans(), 7);
  EXPECT_LT(distance(fine, shell), 1e-13);
}

TEST(ControlNet, IsInterpolatedByLagrangeElementsOfTheDegree) {
  const auto patch =
      patchOf<2>("{" + netOf(quarterRing, ", refine: [1, 4]") + "}", "degree: 3\nbasis: lagrange");
  EXPECT_EQ(patch.basis().direction(1).numFunctions(), 13);
  for (int a = 0; a < patch.basis().numFunctions(); ++a)
    EXPECT_NEAR(patch.points().col(a).norm(), 1.0 + patch.basis().functionIndex(a)[0] / 3.0, 1e-14 * 4);
  EXPECT_EQ(patchOf<2>("{" + netOf(quarterRing) + "}", "basis: lagrange").basis().direction(0).degree(), 2)
      << "without a degree the highest of the net";
}

/// The same patch with its parameters exchanged and reversed: parameter d of the new one is parameter
/// `from[d]` of the old one.
template <int Dim>
Patch<Dim> turned(const Patch<Dim>& patch, const std::array<int, Dim>& from, unsigned reversed) {
  std::vector<UnivariateBasis> directions;
  for (int d = 0; d < Dim; ++d) {
    const auto& old = patch.basis().direction(from[static_cast<std::size_t>(d)]);
    std::vector<double> knots = old.knots();
    if ((reversed >> d) % 2 != 0) {
      std::reverse(knots.begin(), knots.end());
      for (double& knot : knots) knot = 1.0 - knot;
    }
    directions.push_back(UnivariateBasis::bspline(KnotVector(old.degree(), knots)));
  }
  TensorBasis<Dim> basis(std::move(directions));
  std::vector<int> functions;
  for (int a = 0; a < basis.numFunctions(); ++a) {
    const auto index = basis.functionIndex(a);
    typename TensorBasis<Dim>::Index old{};
    for (int d = 0; d < Dim; ++d) {
      const auto k = static_cast<std::size_t>(d);
      const int last = basis.direction(d).numFunctions() - 1;
      old[static_cast<std::size_t>(from[k])] = (reversed >> d) % 2 != 0 ? last - index[k] : index[k];
    }
    functions.push_back(patch.basis().functionNumber(old));
  }
  return {basis, patch.points()(Eigen::all, functions), patch.weights()(functions)};
}

/// Whether nodes and positions of control points belong to each other one to one.
template <int Dim>
void expectOneNodePerPosition(const Body<Dim>& body) {
  std::vector<Eigen::Vector<double, Dim>> places(static_cast<std::size_t>(body.numNodes));
  std::vector<bool> seen(places.size(), false);
  for (std::size_t p = 0; p < body.patches.size(); ++p)
    for (std::size_t a = 0; a < body.nodes[p].size(); ++a) {
      const auto node = static_cast<std::size_t>(body.nodes[p][a]);
      const Eigen::Vector<double, Dim> X = body.patches[p].points().col(static_cast<Eigen::Index>(a));
      EXPECT_LT(seen[node] ? (places[node] - X).norm() : 0.0, 1e-10);
      seen[node] = true;
      places[node] = X;
    }
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_TRUE(seen[i]);
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT((places[i] - places[j]).norm(), 1e-8);
  }
}

const std::vector<std::string> kTwoNames{"a", "b"};

TEST(JoinedPatches, MeetInAllOrientationsOfAPlane) {
  const KnotVector uneven(2, {0, 0, 0, 0.3, 1, 1, 1});
  const auto left = refined(annulus({0.0, 0.0}, 1.0, 2.0, 1.0, 1.0), {uneven, KnotVector::uniform(2, 2)});
  const auto right = refined(annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 1.0), {uneven, KnotVector::uniform(2, 3)});
  for (const auto& from : {std::array{0, 1}, std::array{1, 0}})
    for (unsigned reversed = 0; reversed < 4; ++reversed) {
      const auto body = joinedBody<2>({left, turned<2>(right, from, reversed)}, kTwoNames);
      EXPECT_EQ(body.numNodes, 4 * 4 + 4 * 5 - 4);
      expectOneNodePerPosition(body);
    }
}

TEST(JoinedPatches, MeetInAllOrientationsOfSpace) {
  const KnotVector a(2, {0, 0, 0, 0.3, 1, 1, 1}), b(1, {0, 0, 0.7, 1, 1}), c = KnotVector::uniform(2, 1);
  const auto first = refined(box({0.0, 0.0, 0.0}, {1.0, 2.0, 3.0}), {c, a, b});
  const auto second = refined(box({1.0, 0.0, 0.0}, {1.0, 2.0, 3.0}), {KnotVector::uniform(1, 2), a, b});
  std::array<int, 3> from{0, 1, 2};
  do {
    for (unsigned reversed = 0; reversed < 8; ++reversed) {
      const auto body = joinedBody<3>({first, turned<3>(second, from, reversed)}, kTwoNames);
      EXPECT_EQ(body.numNodes, 3 * 12 + 3 * 12 - 12);
      expectOneNodePerPosition(body);
    }
  } while (std::next_permutation(from.begin(), from.end()));
}

TEST(JoinedPatches, AreOneWhateverTheirParametersAndTheScaleOfTheirWeights) {
  const auto upper = annulus({0.0, 0.0}, 1.0, 2.0, 1.0, 1.0), lower = annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 1.0);
  const KnotVector wide(1, {-3, -3, 7, 7});
  const Patch<2> scaled(TensorBasis<2>({UnivariateBasis::bspline(wide), lower.basis().direction(1)}),
                        lower.points(), 2.5 * lower.weights());
  EXPECT_EQ(joinedBody<2>({upper, scaled}, kTwoNames).numNodes, 10);
}

/// Four quarters of a disc of radius 2, the inner face of each collapsed to the centre.
TEST(JoinedPatches, CloseRingsAndCollapseFacesToAPoint) {
  std::string yaml = "{shape: patches, patches: [";
  for (int k = 0; k < 4; ++k) {
    auto quarter = annulus({3.0, 0.0}, 1.0, 2.0, k * kPi / 2, kPi / 2);
    Eigen::MatrixXd points = quarter.points();
    for (const int a : faceFunctions(quarter.basis(), 0)) points.col(a) = Eigen::Vector2d(3.0, 0.0);
    yaml += fmt::format("{}{{name: q{}, {}}}", k > 0 ? ", " : "", k,
                        netOf(Patch<2>(quarter.basis(), points, quarter.weights()), ", refine: [3, 1]"));
  }
  const auto disc = bodyOf<2>(yaml + "]}");
  EXPECT_EQ(disc.names, (std::vector<std::string>{"q0", "q1", "q2", "q3"}));
  EXPECT_EQ(disc.body.numNodes, 1 + 3 * 8) << "the centre and three rings of eight";
  expectOneNodePerPosition(disc.body);
  EXPECT_NEAR(SpanQuadrature<2>(disc.body, 12).volume(), 4 * kPi, 1e-9);
}

TEST(JoinedPatches, MayBeOnePatchThatCloses) {
  Eigen::MatrixXd points(2, 18);
  Eigen::VectorXd weights(18);
  for (int j = 0; j < 9; ++j)
    for (int i = 0; i < 2; ++i) {
      const double angle = j * kPi / 4, w = j % 2 == 0 ? 1.0 : std::sqrt(0.5);
      points.col(i + 2 * j) = (i + 1.0) / w * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      weights(i + 2 * j) = w;
    }
  const KnotVector around(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4});
  const auto body =
      joinedBody<2>({Patch<2>(TensorBasis<2>({UnivariateBasis::bspline(KnotVector::uniform(1, 1)),
                                              UnivariateBasis::bspline(around)}),
                              points, weights)},
                    {""});
  EXPECT_EQ(body.numNodes, 16);
  expectOneNodePerPosition(body);
}

std::string twoRings(const std::string& first, const std::string& second, double start = 90) {
  return fmt::format(
      "{{shape: patches, patches: [{{name: a, shape: annulus, inner_radius: 1, outer_radius: 2, {}}},"
      " {{name: b, shape: annulus, inner_radius: 1, outer_radius: 2, start_angle: {}, {}}}]}}",
      first, start, second);
}

TEST(JoinedPatches, ThatDoNotMatchAreNamedWithWhatDiffers) {
  const std::string faces =
      "geometry: face 'top' of patch 'a' and face 'bottom' of patch 'b' lie on each other but do "
      "not "
      "match: ";
  const auto message = [](const std::string& geometry, const std::string& more = "") {
    return errorOf([&] { bodyOf<2>(geometry, more); });
  };
  EXPECT_EQ(message(twoRings("spans: [2, 2]", "spans: [3, 2]")),
            faces +
                "they have 4 and 5 basis functions; allowed: the same degree, knots, weights and control "
                "points along both");
  EXPECT_EQ(message(twoRings("spans: [2, 2]", "spans: [2, 2], grading: [s^2, s]")).substr(faces.size(), 18),
            "their knots differ");
  EXPECT_EQ(message(twoRings("spans: [2, 2]", "spans: [4, 2]"), "basis: lagrange").substr(faces.size(), 32),
            "they have 5 and 9 basis function");
  EXPECT_EQ(message(twoRings("spans: [2, 2]", "spans: [2, 2]", 91)),
            "geometry: patch 'b' is not connected to patch 'a'; allowed: patches that all share whole "
            "faces");
  EXPECT_EQ(message(twoRings("spans: [2, 2]", "spans: [2, 7]")), "no error");
}

TEST(JoinedPatches, SayWhenDegreesOrWeightsDiffer) {
  const auto a = annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 1.0), b = annulus({0.0, 0.0}, 2.0, 3.0, 0.0, 1.0);
  Eigen::VectorXd weights = b.weights();
  weights.segment(2, 2) *= 1.001;
  EXPECT_NE(
      errorOf([&] {
        joinedBody<2>({a, Patch<2>(b.basis(), b.points(), weights)}, kTwoNames);
      })
          .find("face 'right' of patch 'a' and face 'left' of patch 'b' lie on each other but do not match: "
                "their weights differ"),
      std::string::npos);
  const auto raised = refined(b, {KnotVector::uniform(1, 1), KnotVector::uniform(3, 1)});
  EXPECT_NE(errorOf([&] {
              joinedBody<2>({a, raised}, kTwoNames);
            }).find("their degrees are 2 and 3"),
            std::string::npos);
}

TEST(JoinedPatches, MayLeaveAHoleBetweenFacesWithTheSameCorners) {
  const auto arc = annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 1.0);
  Eigen::MatrixXd points(2, 4);
  const auto corners = faceFunctions(arc.basis(), 0);
  points << 0.0, arc.points()(0, corners[0]), 0.0, arc.points()(0, corners[2]), 0.0,
      arc.points()(1, corners[0]), 0.1, arc.points()(1, corners[2]);
  const auto block = rectangle({0.0, 0.0}, {1.0, 1.0});
  EXPECT_NE(errorOf([&] {
              joinedBody<2>({arc, Patch<2>(block.basis(), points, block.weights())}, kTwoNames);
            }).find("not connected"),
            std::string::npos)
      << "the chord is not the arc";
}

/// Strain energy of a block that is pulled and sheared far.
double energyOf(const std::string& geometry, const char* left, const char* right, const char* basis) {
  const Scene scene = parseScene(
      fmt::format("basis: {}\ngeometry: {}\nmaterial: {{law: neo-hookean, E: 1, nu: 0.3}}\n"
                  "supports: [{{{}face: left, fix: [x, y]}},"
                  "{{{}face: right, move: {{times: [0, 1], x: [0, 0.8], y: [0, 0.5]}}}}]\n"
                  "steps: [{{until: 1, count: 4}}]\noutput: {{vtu: false}}\nsolver: {{tolerance: 1e-13}}\n",
                  basis, geometry, left, right),
      "block.yaml");
  return test::run(scene, "joined").summary.end.strainEnergy;
}

TEST(JoinedPatches, MayNotTouchWithoutBeingJoined) {
  const auto at = [](double x, double y, double width) { return rectangle({x, y}, {width, 1.0}); };
  const std::vector<std::string> names{"a", "b", "c", "d"};
  const auto messageOf = [&](std::vector<Patch<2>> patches) -> std::string {
    try {
      const std::vector<std::string> some(names.begin(), names.begin() + std::ssize(patches));
      static_cast<void>(joinedBody<2>(std::move(patches), some));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(messageOf({at(0, 0, 1), at(1, 0, 1), at(0, 1, 1), at(1, 1, 1)}), "");
  EXPECT_THAT(messageOf({at(0, 0, 2), at(2, 0, 1), at(2, 1, 1), at(1, 1, 1)}),
              testing::AllOf(testing::HasSubstr("face 'top' of patch 'a' and face"),
                             testing::HasSubstr("of patch 'd' touch but are not joined")));
  EXPECT_THAT(messageOf({at(0, 0, 1), at(1, 0, 1), at(1, 0, 1)}),
              testing::HasSubstr("matches two other faces"));
}

TEST(JoinedPatches, SolveLikeOnePatchWithACrease) {
  for (const char* basis : {"nurbs", "lagrange"}) {
    const double one =
        energyOf("{shape: rectangle, size: [2, 1], spans: [4, 3], creases: [[0.5], []]}", "", "", basis);
    const double two = energyOf(
        "{shape: patches, patches: [{name: a, shape: rectangle, size: [1, 1], spans: [2, 3]},"
        " {name: b, shape: rectangle, origin: [1, 0], size: [1, 1], spans: [2, 3]}]}",
        "patch: a, ", "patch: b, ", basis);
    EXPECT_GT(one, 0.1);
    EXPECT_NEAR(two / one, 1.0, 1e-10) << basis;
  }
}

/// A quadratic height on a straight face is exact, whatever the mesh; a wave converges with the order of the basis.
TEST(Relief, IsExactWhereTheBasisHasIt) {
  for (const char* basis : {"basis: nurbs", "basis: lagrange"}) {
    const Patch<2> patch = patchOf<2>(
        "{shape: rectangle, size: [2, 1], spans: [5, 3], grading: [\"s^1.3\", s], relief: [{face: top, height: "
        "\"0.1*X*(2-X)\"}]}",
        fmt::format("{}\ndegree: 2", basis));
    const Patch<2> before =
        patchOf<2>("{shape: rectangle, size: [2, 1], spans: [5, 3], grading: [\"s^1.3\", s]}",
                   fmt::format("{}\ndegree: 2", basis));
    for (const double u : {0.0, 0.13, 0.5, 0.77, 1.0}) {
      const Eigen::Vector2d top = patch.position({u, 1.0}), bottom = patch.position({u, 0.0});
      EXPECT_NEAR(top.y(), 1.0 + 0.1 * top.x() * (2.0 - top.x()), 1e-13);
      EXPECT_LT((bottom - before.position({u, 0.0})).norm(), 1e-14);
      EXPECT_GT(patch.jacobian({u, 0.4}).determinant(), 0.0);
    }
  }
}

TEST(Relief, ConvergesWithTheOrderOfTheBasis) {
  double before = 0.0;
  for (const int spans : {16, 32, 64}) {
    const Patch<2> patch = patchOf<2>(
        fmt::format(
            "{{shape: rectangle, size: [1, 1], spans: [{}, 2], relief: [{{face: bottom, height: \"0.01*cos(2*_pi*X/0.25)\"}}]}}",
            spans),
        "degree: 2");
    double worst = 0.0;
    for (int k = 0; k <= 1000; ++k) {
      const Eigen::Vector2d x = patch.position({k / 1000.0, 0.0});
      worst = std::max(worst, std::abs(x.y() + 0.01 * std::cos(8.0 * kPi * x.x())));
    }
    if (before > 0.0) {
      EXPECT_LT(worst, before / 7.0);
    }
    before = worst;
  }
  EXPECT_LT(before, 1e-5);
}

/// A measured profile is met at every anchor, which on a mesh of degree 1 are the knots.
TEST(Relief, IsAsMeasured) {
  const test::ScratchDirectory directory("relief");
  std::filesystem::create_directories(directory.path());
  const auto file = directory.path() / "turned.csv";
  std::ofstream(file) << "# of a stylus\nx [mm],z [um]\n0,0\n0.5,4\n1.5,-2\n3,1\n";
  const auto patch = [&](const std::string& more) {
    return patchOf<2>(
        fmt::format("{{shape: rectangle, size: [2, 1], spans: [4, 1], relief: [{{face: top, file: {}{}}}]}}",
                    file.string(), more),
        "degree: 1\nunits: {length: mm, stress: MPa}");
  };
  const std::vector<double> heights{0.0, 0.004, 0.001, -0.002, -0.001};
  for (std::size_t k = 0; k < heights.size(); ++k)
    EXPECT_NEAR(patch("").position({static_cast<double>(k) / 4.0, 1.0}).y(), 1.0 + heights[k], 1e-15) << k;
  EXPECT_NEAR(patch(", along: X + 1").position({0.25, 1.0}).y(), 1.0 - 0.002, 1e-15);
  EXPECT_THAT(
      errorOf([&] { patch(", along: X + 1.5"); }),
      HasSubstr(
          "relief[0]: the face needs the profile at 3.5 (along, at X = (2, 1, 0)); found one from 0 to 3"));
  EXPECT_THAT(errorOf([&] { patch(", height: 1"); }),
              HasSubstr("found height beside a profile; allowed: one of the two"));
  EXPECT_THAT(errorOf([&] { patch(", places: [0, 1]"); }), HasSubstr("found places beside file"));
  std::ofstream(file) << "x,z,t\n0,0,0\n";
  EXPECT_THAT(errorOf([&] { patch(""); }),
              HasSubstr("holds 3 columns; allowed: two, places along the profile and heights"));
  std::ofstream(file) << "x [furlong],z\n0,0\n1,1\n";
  EXPECT_THAT(errorOf([&] { patch(""); }), HasSubstr("its lengths are in furlong, those of the scene in mm"));
  std::ofstream(file) << "x,z\n0,0\n1,1\n1,2\n";
  EXPECT_THAT(errorOf([&] { patch(""); }),
              HasSubstr("geometry.relief[0].places: found 1 behind 1; allowed: places that increase"));
}

TEST(Relief, RaisesAnArcAlongItsNormal) {
  const Patch<2> ring = patchOf<2>(
      "{shape: annulus, inner_radius: 1, outer_radius: 2, start_angle: 0, opening_angle: 90, spans: [2, 6], relief: "
      "[{face: right, height: 0.1}, {face: left, height: -0.05}]}");
  for (const double v : {0.0, 0.21, 0.5, 1.0}) {
    EXPECT_NEAR(ring.position({1.0, v}).norm(), 2.1, 1e-5);
    EXPECT_NEAR(ring.position({0.0, v}).norm(), 1.05, 1e-5);
  }
}

TEST(Relief, InSpaceIsOnItsFaceAlone) {
  const Patch<3> patch = patchOf<3>(
      "{shape: box, size: [1, 1, 1], spans: [3, 2, 3], relief: [{face: top, height: \"0.1*X*Z\"}]}");
  for (const double u : {0.0, 0.3, 1.0})
    for (const double w : {0.0, 0.6, 1.0}) {
      EXPECT_NEAR(patch.position({u, 1.0, w}).y(), 1.0 + 0.1 * u * w, 1e-13);
      EXPECT_NEAR(patch.position({u, 0.0, w}).y(), 0.0, 1e-15);
    }
}

}  // namespace
}  // namespace burnish
