#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "tests/cli/shell.h"
#include "tests/postproc/picture.h"

/// Pictures of other programs' files as the user meets them. BURNISH_COMMAND is the program.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class ForeignCommand : public testing::Test {
 protected:
  ForeignCommand() { fs::create_directories(dir_); }
  ~ForeignCommand() override { fs::remove_all(dir_); }

  auto burnish(const std::string& arguments) { return shell(dir_, BURNISH_COMMAND " " + arguments); }

  static std::string sample(const std::string& name) {
    return std::string(BURNISH_SOURCE_DIR) + "/tests/postproc/foreign/samples/" + name;
  }

  const fs::path dir_ = fs::temp_directory_path() / ("burnish_foreign_command_" + std::to_string(::getpid()));
};

TEST_F(ForeignCommand, InfoTellsCellsAndFields) {
  const auto info = burnish("info " + sample("meshio.vtu"));
  EXPECT_EQ(info.code, 0);
  EXPECT_THAT(info.out,
              AllOf(HasSubstr("49 points, 54 cells (18 quad, 36 triangle)"),
                    HasSubstr("temperature of points: 1 to 2.41954"), HasSubstr("region of cells: 0 to 1")));
}

/// The sheet is of region 0 at the left and of region 1 at the right.
TEST_F(ForeignCommand, CellsHaveTheirColoursInTheirPlaces) {
  ASSERT_EQ(burnish("render " + sample("meshio.vtu") + " --field region --size 400,400 -o a.png").code, 0);
  const Picture picture = readPicture(dir_ / "a.png");
  const Color first{68, 1, 84}, last{253, 231, 37};  // of viridis
  constexpr int kBody = 280;                         // the colour scale is beyond
  const int middle = picture.height / 2;
  int lastOfFirst = -1, firstOfLast = kBody, ofFirst = 0, ofLast = 0;
  for (int x = 0; x < kBody; ++x) {
    const Color& color = picture.at({x + 0.5, middle + 0.5});
    if (difference(color, first) <= 2) {
      lastOfFirst = x;
      ++ofFirst;
    } else if (difference(color, last) <= 2) {
      firstOfLast = std::min(firstOfLast, x);
      ++ofLast;
    }
  }
  EXPECT_GT(ofFirst, 50);
  EXPECT_GT(ofLast, 50);
  EXPECT_LE(lastOfFirst + 1, firstOfLast);
  EXPECT_GE(lastOfFirst + 3, firstOfLast);
}

TEST_F(ForeignCommand, EveryFormatMakesAPicture) {
  for (const char* name :
       {"meshio.vtu", "meshio.vtk", "gmsh.vtk", "gmsh.stl", "h5py.vtkhdf", "a.exo", "tri.case"})
    EXPECT_EQ(burnish("render " + sample(name) + " --size 300,200 -o " + name + ".png").code, 0) << name;
}

TEST_F(ForeignCommand, WhatBelongsToRunsIsRefused) {
  for (const char* option :
       {"--control-net", "--subdivision 3", "--vectors displacement", "--clip 90", "--tool-opacity 1",
        "--warp 2", "--body nothing", "--field region --isolines 3"}) {
    const auto refused = burnish("render " + sample("meshio.vtu") + " -o b.png " + option);
    EXPECT_EQ(refused.code, 2) << option;
    EXPECT_FALSE(fs::exists(dir_ / "b.png")) << option;
  }
}

}  // namespace
}  // namespace burnish
