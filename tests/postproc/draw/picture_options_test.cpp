#include "postproc/draw/contour/picture_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/schema/declaration_collector.h"
#include "engine/schema/rule_check.h"
#include "postproc/study/figures/schema_figure.h"

/// What the declaration of a picture's options says, whichever door they come through.
namespace burnish {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

template <class T>
std::optional<T> spelled(const std::string& text) {
  return Spelling<T>::read(text);
}

/// The keys of a problem's list.
std::vector<std::string> keysOf(const std::vector<InputProblem>& problems) {
  std::vector<std::string> keys;
  for (const InputProblem& problem : problems) keys.push_back(problem.path);
  return keys;
}

std::vector<std::string> keysOf(const Declarations& declarations) {
  std::vector<std::string> keys;
  for (const Declaration& declaration : declarations) keys.push_back(declaration.key);
  return keys;
}

TEST(Planes, AreOfACoordinateOrAPointAndANormal) {
  const auto z = spelled<CutPlane>("z=-2.5");
  EXPECT_EQ(z->point, Eigen::Vector3d(0.0, 0.0, -2.5));
  EXPECT_EQ(z->normal, Eigen::Vector3d(0.0, 0.0, 1.0));
  const auto any = spelled<CutPlane>("1,2,3,0,-1,0.5");
  EXPECT_EQ(any->point, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(any->normal, Eigen::Vector3d(0.0, -1.0, 0.5));
  for (const char* text : {"", "z", "z=", "w=1", "z=nan", "1,2,3", "1,2,3,0,0,0", "1,2,3,0,0,1,2"})
    EXPECT_FALSE(spelled<CutPlane>(text)) << text;
}

TEST(MirrorPlanes, AreAxesWithAPlace) {
  const auto planes = spelled<std::vector<MirrorPlane>>("x,z=2.5");
  ASSERT_EQ(planes->size(), 2U);
  EXPECT_EQ((*planes)[0].axis, 0);
  EXPECT_EQ((*planes)[0].at, 0.0);
  EXPECT_EQ((*planes)[1].axis, 2);
  EXPECT_EQ((*planes)[1].at, 2.5);
  for (const char* text : {"w", "x,x=1", ",x", "x=", "1"})
    EXPECT_FALSE(spelled<std::vector<MirrorPlane>>(text)) << text;
}

TEST(Windows, AreTwoCornersInAnyOrder) {
  const auto window = spelled<Eigen::AlignedBox2d>("3,-1,1,2.5");
  EXPECT_EQ(window->min(), Eigen::Vector2d(1.0, -1.0));
  EXPECT_EQ(window->max(), Eigen::Vector2d(3.0, 2.5));
  for (const char* text : {"", "1,2,3", "1,1,1,2", "0,0,1,inf", "0,0,1,1,", "0,0,1,1,2", "-1e308,0,1e308,1"})
    EXPECT_FALSE(spelled<Eigen::AlignedBox2d>(text)) << text;
}

TEST(Views, AreNamesOrDirections) {
  EXPECT_TRUE(viewAxes(*spelled<ViewName>("0,0,2"), 3).isApprox(viewAxes({"xy"}, 3)));
  for (const char* text : {"", "isso", "0,0,0", "1,1", "1,1,nan"})
    EXPECT_FALSE(spelled<ViewName>(text)) << text;
}

TEST(Spellings, ReadBackToTheSame) {
  const auto expectSame = [](auto value, const std::string& text) {
    using T = decltype(value);
    EXPECT_EQ(Spelling<T>::write(*Spelling<T>::read(text)), text);
  };
  for (const char* text : {"z=-2.5", "x=0", "1,2,3,0,-1,0.5"}) expectSame(CutPlane{}, text);
  for (const char* text : {"x", "x,z=2.5"}) expectSame(std::vector<MirrorPlane>{}, text);
  expectSame(Eigen::AlignedBox2d{}, "1,-1,3,2.5");
  expectSame(Color{}, "#10ff07");
  expectSame(ChosenTheme{}, "complas");
  expectSame(FontName{}, "DejaVu Serif");
  expectSame(ViewName{}, "1,0.5,2");
}

TEST(PictureSizes, HaveOneLimitEverywhere) {
  for (const std::array<int, 2>& size : {std::array{199, 300}, std::array{300, 149}, std::array{300, 8001}}) {
    EXPECT_FALSE(isPictureSize(size));
    EXPECT_THAT(keysOf(conflictsIn(picturesOfSize(size), {})), ElementsAre("size"));
  }
  for (const std::array<int, 2>& size : {std::array{200, 150}, std::array{8000, 8000}}) {
    EXPECT_TRUE(isPictureSize(size));
    EXPECT_THAT(conflictsIn(picturesOfSize(size), {}), IsEmpty());
    EXPECT_THAT(ruleProblems(picturesOfSize(size)), IsEmpty());
  }
  PictureOptions scaled = picturesOfSize({1600, 900});
  scaled.scale = 9.0;
  const auto problems = conflictsIn(scaled, {});
  ASSERT_THAT(keysOf(problems), ElementsAre("scale"));
  EXPECT_EQ(problems[0].text, "found 9, which makes 14400 x 8100 pixels; expected 200 x 150 to 8000 x 8000");
}

TEST(PictureOptions, ThatExcludeEachOtherAreTold) {
  PictureOptions options;
  options.range = {0.0, 1.0};
  options.clip = 99.0;
  options.cut = options.slice = CutPlane{};
  options.background = Color{};
  options.transparent = true;
  EXPECT_THAT(keysOf(conflictsIn(options, {})), ElementsAre("clip", "background", "slice"));
  EXPECT_THAT(keysOf(conflictsIn(options, 2)), ElementsAre("clip", "background", "slice", "cut"));
}

TEST(PictureOptions, RulesHoldForThoseMadeInCode) {
  PictureOptions options;
  EXPECT_THAT(ruleProblems(options), IsEmpty());
  options.bands = 257;
  options.toolOpacity = 0.0;
  options.clip = 50.0;
  options.colormap = "virdis";
  EXPECT_THAT(keysOf(ruleProblems(options)), ElementsAre("clip", "tool_opacity", "colormap", "bands"));
}

/// A new option reaches every door by its declaration.
TEST(PictureOptions, EveryDoorHasThem) {
  const std::vector<std::string> part = keysOf(declarationsOf<PanelOptions>());
  EXPECT_GT(part.size(), 20U);
  for (const std::string& key : part) {
    if (key != "range") {
      EXPECT_THAT(keysOf(declarationsOf<PictureOptions>()), Contains(key));
    }
    EXPECT_THAT(keysOf(declarationsOf<ContourSheetSpec>()), Contains(key));
    EXPECT_THAT(keysOf(declarationsOf<AnimationSpec>()), Contains(key));
  }
}

}  // namespace
}  // namespace burnish
