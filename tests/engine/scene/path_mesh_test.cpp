#include "engine/scene/path_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "engine/core/error.h"
#include "engine/scene/path_of_tool.h"
#include "engine/scene/reader.h"

namespace burnish {
namespace {

using testing::HasSubstr;
using Overrides = std::vector<std::string>;

/// A box of 4 x 3 x 2 whose upper face a ball with a contact of the half width 0.1 passes twice, from (1.5, 1) to (2, 1)
/// and from (1.5, 1.2) to (2, 1.2).
const std::string kScene = R"(
geometry: {shape: box, origin: [-1, 0, 0], size: [4, 3, 2], resolution: {along: ball, half_width: 0.1}}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports: [{face: back, fix: [x, y, z]}]
tools:
  - name: ball
    shape: sphere
    center: [1, 1, 3]
    radius: 1
    path: {course: raster, start: [0.5, 0, -0.01], stroke: [0.5, 0, 0], feed: [0, 0.2, 0], passes: 2, speed: 1, clearance: [0.7, 0, 0.5]}
contact: [{tool: ball, face: front}]
steps: [{until: 9, count: 1}]
)";

/// Breakpoints as coordinates, the ends among them.
std::vector<double> places(const Scene& scene, std::size_t direction, double origin, double size) {
  std::vector<double> found{origin};
  for (const double s : scene.body.geometry.mesh.resolution->breaks[direction])
    found.push_back(origin + size * s);
  found.push_back(origin + size);
  return found;
}

/// Sizes of spans between two places.
std::vector<double> sizesIn(const std::vector<double>& places, double begin, double end) {
  std::vector<double> sizes;
  for (std::size_t k = 1; k < places.size(); ++k)
    if (places[k - 1] > begin - 1e-9 && places[k] < end + 1e-9) sizes.push_back(places[k] - places[k - 1]);
  return sizes;
}

double largestGrowth(const std::vector<double>& places) {
  double largest = 0.0;
  for (std::size_t k = 2; k < places.size(); ++k) {
    const double a = places[k - 1] - places[k - 2], b = places[k] - places[k - 1];
    largest = std::max({largest, a / b, b / a});
  }
  return largest;
}

TEST(PathMesh, IsFineAlongAllPassesAndGrowsBeyond) {
  const Scene scene = parseScene(kScene, "test.yaml");
  const std::vector<double> x = places(scene, 0, -1.0, 4.0), y = places(scene, 1, 0.0, 3.0);
  // 2a = 0.2 beyond the passes; 8 spans over 2a
  for (const auto& [along, begin, end] : {std::tuple{x, 1.3, 2.2}, std::tuple{y, 0.8, 1.4}}) {
    const std::vector<double> fine = sizesIn(along, begin, end);
    ASSERT_EQ(std::ssize(fine), std::lround((end - begin) / 0.025));
    for (const double size : fine) EXPECT_NEAR(size, 0.025, 1e-12);
    EXPECT_LE(largestGrowth(along), 1.3 * (1.0 + 1e-9));
    EXPECT_LT(along.size(), 70u);
  }
}

TEST(PathMesh, IsFinestAtTheFaceThatTheToolTouches) {
  const std::vector<double> z = places(parseScene(kScene, "test.yaml"), 2, 0.0, 2.0);
  const double first = z.back() - z[z.size() - 2];
  EXPECT_LE(first, 0.0125 * (1.0 + 1e-12));
  EXPECT_GT(first, 0.0125 / 1.3);
  EXPECT_LE(largestGrowth(z), 1.3 * (1.0 + 1e-9));
  const Scene below = parseScene(kScene, "test.yaml",
                                 {"contact=[{tool: ball, face: back}]",
                                  "supports=[{face: front, fix: [x, y, z]}]", "tools[0].center=[1, 1, -1]"});
  const std::vector<double> other = places(below, 2, 0.0, 2.0);
  EXPECT_NEAR(other[1], first, 1e-12);
}

TEST(PathMesh, IsThatOfTheSceneReadAgain) {
  const Scene scene = parseScene(kScene, "test.yaml");
  const Scene again = parseScene(scene.resolvedYaml, "again.yaml");
  EXPECT_EQ(scene.body.geometry.mesh.resolution->breaks, again.body.geometry.mesh.resolution->breaks);
}

TEST(PathMesh, KnowsHowMuchRoomThereIs) {
  const PathRoom room = pathRoom(parseScene(kScene, "test.yaml"), 0);
  EXPECT_NEAR(room.beside, 10.0, 1e-12) << "1 in y";
  EXPECT_NEAR(room.below, 20.0, 1e-12);
}

std::vector<double> placesOf(const FollowingMesh& mesh, std::size_t direction, double origin, double size) {
  std::vector<double> found{origin};
  for (const double s : mesh.breaks[direction]) found.push_back(origin + size * s);
  found.push_back(origin + size);
  return found;
}

TEST(FollowingMeshes, AreFineAroundOnePartOfThePassesAfterTheOther) {
  const Scene scene = parseScene(kScene, "test.yaml", {"rezoning={travel: 0.25}"});
  const std::vector<FollowingMesh> meshes = followingMeshes(scene, 0);
  // Each pass of 0.5 has two parts of 0.25; from pass to pass the place jumps by 0.54.
  ASSERT_EQ(meshes.size(), 4u);
  const ToolPath path = pathOf(scene.tools.front());
  const std::vector<ToolPath::Pass>& passes = path.passes();
  EXPECT_EQ(meshes[0].from, 0.0);
  EXPECT_NEAR(meshes[1].from, passes[0].begin + 0.25, 1e-9);
  EXPECT_NEAR(meshes[2].from, 0.5 * (passes[0].end + passes[1].begin), 1e-9) << "in the air";
  EXPECT_NEAR(meshes[3].from, passes[1].begin + 0.25, 1e-9);
  for (const auto& [mesh, x, y] : {std::tuple{0, 1.5, 1.0}, std::tuple{1, 1.75, 1.0}, std::tuple{2, 1.5, 1.2},
                                   std::tuple{3, 1.75, 1.2}}) {
    const auto k = static_cast<std::size_t>(mesh);
    const std::vector<double> along = placesOf(meshes[k], 0, -1.0, 4.0),
                              across = placesOf(meshes[k], 1, 0.0, 3.0);
    for (const auto& [places, begin, end] :
         {std::tuple{along, x - 0.2, x + 0.45}, std::tuple{across, y - 0.2, y + 0.2}}) {
      const std::vector<double> fine = sizesIn(places, begin, end);
      ASSERT_EQ(std::ssize(fine), std::lround((end - begin) / 0.025)) << mesh;
      for (const double size : fine) EXPECT_NEAR(size, 0.025, 1e-12);
      EXPECT_LE(largestGrowth(places), 1.3 * (1.0 + 1e-9));
    }
    EXPECT_EQ(meshes[k].breaks[2], meshes[0].breaks[2]);
  }
  EXPECT_EQ(scene.body.geometry.mesh.resolution->breaks, meshes[0].breaks);
  EXPECT_EQ(parseScene(scene.resolvedYaml, "again.yaml").body.geometry.mesh.resolution->breaks,
            meshes[0].breaks);
}

TEST(FollowingMeshes, AreOneWhereAllPassesAreNear) {
  const Scene scene = parseScene(kScene, "test.yaml", {"rezoning={travel: 0.6}"});
  const std::vector<FollowingMesh> meshes = followingMeshes(scene, 0);
  ASSERT_EQ(meshes.size(), 1u);
  EXPECT_EQ(meshes[0].breaks, parseScene(kScene, "test.yaml").body.geometry.mesh.resolution->breaks);
  EXPECT_FALSE(hasFollowingMeshes(parseScene(kScene, "test.yaml"), 0));
}

TEST(FollowingMeshes, ReachTwoWidthsWhereNoTravelIsGiven) {
  const Scene scene = parseScene(kScene, "test.yaml", {"rezoning={}"});
  EXPECT_EQ(followingMeshes(scene, 0)[1].from,
            followingMeshes(parseScene(kScene, "test.yaml", {"rezoning={travel: 0.4}"}), 0)[1].from);
}

TEST(FollowingMeshes, RefuseWhatTheyCannotFollow) {
  const auto error = [](const Overrides& more) {
    Overrides overrides{"rezoning={travel: 0.25}"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    try {
      parseScene(kScene, "test.yaml", overrides);
    } catch (const Error& problem) {
      return std::string(problem.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(error({}), "no error");
  EXPECT_THAT(error({"geometry.resolution=null", "geometry.spans=[4, 4, 4]"}),
              HasSubstr("rezoning: found in a scene of three dimensions for a body without a resolution"));
  EXPECT_THAT(error({"rezoning.stretch=2"}),
              HasSubstr("rezoning.stretch: found stretch in a scene of three"));
  EXPECT_THAT(error({"rezoning.spans=[4, 4, 4]"}),
              HasSubstr("rezoning.spans: found spans in a scene of three"));
  EXPECT_THAT(error({"contact[0].method=penalty"}), HasSubstr("contact[0].method: found a penalty method"));
  EXPECT_THAT(error({"supports[0].part=[0, 0.5, 0, 1]"}),
              HasSubstr("supports[0]: found a support on a part"));
  EXPECT_THAT(error({"geometry.relief=[{face: front, height: '0'}]"}), HasSubstr("found a relief"));
  EXPECT_THAT(error({"initial={stress: {xx: '0.1'}}"}), HasSubstr("initial: found an initial state"));
}

std::string meshErrorOf(const Overrides& overrides) {
  try {
    parseScene(kScene, "test.yaml", overrides);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(PathMesh, SaysWhatIsWrong) {
  EXPECT_EQ(meshErrorOf({}), "no error");
  EXPECT_THAT(meshErrorOf({"geometry.resolution.along=disc"}),
              HasSubstr("geometry.resolution.along: found \"disc\", which is no tool"));
  EXPECT_THAT(meshErrorOf({"tools[0].path=null"}),
              HasSubstr("geometry.resolution.along: found \"ball\", a tool without a path"));
  EXPECT_THAT(meshErrorOf({"contact=[]"}), HasSubstr("which no face of the body has a contact with"));
  EXPECT_THAT(meshErrorOf({"geometry.spans=[2, 2, 2]"}),
              HasSubstr("geometry.spans: found spans beside resolution; allowed: one of the two."));
  EXPECT_THAT(meshErrorOf({"geometry.resolution.half_width=1e-9"}),
              HasSubstr("geometry.resolution.half_width: found one that asks"));
  EXPECT_THAT(meshErrorOf({"geometry.origin=[2.5, 0, 0]"}), HasSubstr("whose passes lead beside the box"));
}

}  // namespace
}  // namespace burnish
