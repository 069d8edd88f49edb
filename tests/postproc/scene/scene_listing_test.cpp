#include "postproc/scene/scene_listing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "engine/core/error.h"
#include "engine/schema/explanation.h"
#include "engine/schema/json_schema.h"

namespace burnish {
namespace {

TEST(SceneListing, namesEveryKeyWithTypeDefaultAndSentence) {
  const std::string listing = describeScene();
  for (const char* line : {
           "- `degree`: a whole number from 1 to 10, default 2. ",
           "- `geometry`: a mapping, required without bodies. ",
           "- `shape: annulus`: Part of a ring",
           "  - `nu`: a number above -1 and below 0.5, required. Poisson's ratio.\n",
           "  - `sigma_inf`: a number above 0 (stress), required. ",
           "  - `tolerance`: a number from 1e-14 to 0.001, default 1e-09. ",
       })
    EXPECT_NE(listing.find(line), std::string::npos) << line;
}

TEST(SceneListing, ListsWhatSeveralKeysShareOnceWithLinks) {
  const std::string list = describeScene();
  const auto count = [&list](const std::string& text) {
    int found = 0;
    for (std::size_t at = list.find(text); at != std::string::npos; at = list.find(text, at + 1)) ++found;
    return found;
  };
  for (const char* shape : {"rectangle", "annulus", "control-net", "patches", "torus", "edge", "union"})
    EXPECT_EQ(count(std::string("- `shape: ") + shape + "`: "), 1) << shape;
  EXPECT_EQ(count("](#geometry-shape)"), 3);
  EXPECT_EQ(count("\n### geometry shape\n"), 1);
  EXPECT_EQ(count("](#tools-shape)"), 2);
  EXPECT_EQ(count("\n### tools shape\n"), 1);
}

TEST(SceneListing, isWhatTheDocumentationShows) {
  std::ifstream file(std::string(BURNISH_SOURCE_DIR) + "/docs/scene.md");
  const std::string page((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  EXPECT_NE(page.find(describeScene()), std::string::npos)
      << "docs/scene.md is out of date: replace its list by the output of burnish info --keys";
}

TEST(SceneSchema, isTheOneThatIsShipped) {
  std::ifstream file(std::string(BURNISH_SOURCE_DIR) + "/docs/scene.schema.json");
  const std::string shipped((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  EXPECT_TRUE(shipped == jsonSchema("burnish scene", sceneDeclarations()))
      << "docs/scene.schema.json is out of date: replace it by the output of burnish schema";
}

std::string explained(const std::string& key) {
  try {
    return explainKey(sceneDeclarations(), key);
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(Explanation, tellsTypeUnitAndDefault) {
  EXPECT_EQ(explained("steps[1].until"),
            "steps[1].until\n"
            "  Time at which the phase ends; it begins where the one before ended, the first one at 0.\n"
            "  allowed  a number above 0\n"
            "  unit     time\n"
            "  default  none, the key is required\n");
  EXPECT_NE(explained("solver.tolerance").find("  default  1e-09\n"), std::string::npos);
  EXPECT_NE(explained("solver").find("    max_cuts: a whole number from 0 to 30. "), std::string::npos);
}

TEST(Explanation, namesTheAlternativesThatHaveAKey) {
  const std::string radius = explained("tools.radius");
  EXPECT_NE(radius.find("with tools.shape: cylinder\nwith tools.shape: sphere\n  Radius.\n"),
            std::string::npos)
      << radius;
  EXPECT_NE(radius.find("with tools.shape: torus\n  Radius of the circle"), std::string::npos) << radius;
  EXPECT_NE(explained("material.hardening.q1")
                .find("with material.law: j2, material.hardening.law: two-term-voce\n"),
            std::string::npos);
  EXPECT_NE(explained("geometry.shape").find("  box: A box along the axes. Its keys: origin, size.\n"),
            std::string::npos);
}

TEST(Explanation, ofAnUnknownKeyNamesTheNearest) {
  EXPECT_EQ(explained("solver.tolerence"),
            "solver.tolerence: \"tolerence\" is not a key of solver; allowed: tolerance, max_iterations, "
            "max_cuts, linear, linear_tolerance. Did you mean \"tolerance\"?");
  EXPECT_NE(explained("max_cuts").find("The keys of this name are solver.max_cuts."), std::string::npos);
  EXPECT_THAT(explained("tolerence"),
              testing::ContainsRegex(
                  "Did you mean geometry.tolerance or .* or solver.tolerance or checks.tolerance\\?"));
  EXPECT_NE(explained("degree.x").find("allowed: no keys."), std::string::npos);
  EXPECT_NE(explained("a..b").find("allowed: a key such as"), std::string::npos);
}

}  // namespace
}  // namespace burnish
