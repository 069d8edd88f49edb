#include "engine/analysis/history_columns.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "engine/analysis/build_model.h"
#include "engine/scene/reader.h"

namespace burnish {
namespace {

/// The columns of an example's history, and the names of its tools.
template <int Dim>
struct Columns {
  std::vector<std::string> names, tools;

  explicit Columns(const std::string& example, const std::vector<std::string>& changes = {}) {
    const Scene scene =
        readScene(fmt::format("{}/scenes/examples/{}.yaml", BURNISH_SOURCE_DIR, example), changes);
    const auto model = buildModel<Dim>(scene);
    for (const HistoryColumn& column : historyColumns(scene, *model, {"bottom.fx"}, {"top.uy"}))
      names.push_back(column.name);
    for (const ToolSpec& tool : scene.tools) tools.push_back(tool.name);
  }

  std::string words(const std::string& column) const {
    const auto meaning = columnMeaning(column, names, tools);
    return meaning ? meaning->words : "";
  }
};

template <int Dim>
void expectWordsForAll(const Columns<Dim>& columns) {
  std::set<std::string> different;
  for (const std::string& name : columns.names) {
    if (name == "bottom.fx" || name == "top.uy") continue;
    EXPECT_NE(columns.words(name), "") << name;
    EXPECT_TRUE(different.insert(columns.words(name)).second) << name << ": " << columns.words(name);
  }
  EXPECT_EQ(columns.words("bottom.fx"), "");  // reactions and measures are called by their scene
  EXPECT_EQ(columns.words("top.uy"), "");
}

TEST(HistoryColumns, HaveWords) {
  expectWordsForAll(Columns<3>("ball_friction"));
  expectWordsForAll(Columns<2>("punch_plough"));
  expectWordsForAll(Columns<2>("hairpin"));
  expectWordsForAll(Columns<2>("seal"));
}

TEST(HistoryColumns, AreCalledByToolsPairsAndBodies) {
  const Columns<3> ball("ball_friction");
  EXPECT_EQ(ball.words(ball.tools.front() + ".fz"), "Force on " + ball.tools.front() + " in z");
  const Columns<2> fit("shrink_fit");
  EXPECT_EQ(fit.words("seat.pressed"), "Contact force of seat");
  EXPECT_EQ(fit.words("hub.strain_energy"), "Strain energy of hub");
  EXPECT_EQ(columnMeaning("seat.penetration", fit.names, fit.tools)->measured, Measured::Length);
}

TEST(HistoryColumns, WithoutASceneToolsHaveDisplacementsBesideTheirForces) {
  const std::vector<std::string> columns{"time", "die.ux", "die.fx", "face.fx"};
  EXPECT_EQ(columnMeaning("die.fx", columns, {})->words, "Force on die in x");
  EXPECT_FALSE(columnMeaning("face.fx", columns, {}));
  EXPECT_FALSE(columnMeaning("die.fx", columns, std::vector<std::string>{"punch"}));
}

}  // namespace
}  // namespace burnish
