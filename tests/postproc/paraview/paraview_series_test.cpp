#include "postproc/paraview/paraview_series.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "postproc/draw/page/color_scale.h"
#include "tests/cli/shell.h"
#include "tests/postproc/export/vtu_files.h"
#include "tests/postproc/sample_records.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

/// Series with their scripts, which a stub of ParaView runs: it looks up every block and array in the files.
class ParaView : public test::VtuFiles {
 protected:
  void write(const samples::Sample& sample, const PictureOptions& picture, const VtuOptions& options = {}) {
    ParaViewSeries(directory_, sample.model, options, picture).write(sample.frame);
  }

  /// What the script shows, from wherever it is called.
  std::string shown(const std::string& arguments = "", const fs::path& from = "/") const {
    const std::string script = (directory_ / "frames.py").string();
    const Outcome compiled =
        shell(directory_, std::string(BURNISH_PYTHON) + " -W error -m py_compile " + script);
    EXPECT_EQ(compiled.code, 0) << compiled.err;
    fs::remove_all(directory_ / "__pycache__");
    const Outcome outcome = shell(
        directory_, "cd " + from.string() +
                        " && PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=" + std::string(BURNISH_SOURCE_DIR) +
                        "/tests/postproc/paraview/stub " + BURNISH_PYTHON + " " + script + " " + arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.out;
  }

  std::string script() const { return bytes(directory_ / "frames.py"); }

  static PictureOptions pictureOf(const std::string& field) {
    PictureOptions picture;
    picture.field = field;
    return picture;
  }
};

TEST_F(ParaView, ShowsEveryKindOfBodyAndCell) {
  for (const CellKind cells : {CellKind::Linear, CellKind::Lagrange, CellKind::Bezier}) {
    write(samples::slab(), {}, {.cells = cells});
    EXPECT_THAT(shown(), StartsWith("tool_cylinder visible  \nbody visible plastic_strain \n"));
    EXPECT_THAT(script(), HasSubstr(cells == CellKind::Linear ? "subdivision = 1 " : "subdivision = 4 "));
    write(samples::ring(), {}, {.cells = cells});
    EXPECT_THAT(shown(), StartsWith("body visible von_mises [MPa] \n"));
    write(samples::cube(), pictureOf("pressure"), {.cells = cells, .pieces = 2});
    EXPECT_THAT(shown(), StartsWith("tool_ball visible  \nbody visible pressure"));
  }
}

TEST_F(ParaView, ShowsComponentsAsTheFilesNameThem) {
  write(samples::slab(), pictureOf("displacement"));
  EXPECT_THAT(shown(), HasSubstr("body visible displacement [mm] Magnitude\n"));
  write(samples::slab(), pictureOf("displacement.y"));
  EXPECT_THAT(shown(), HasSubstr("body visible displacement [mm] Y\n"));
  write(samples::square(), pictureOf("stress.xx"));
  EXPECT_THAT(shown(), HasSubstr(" xx\n"));
}

TEST_F(ParaView, BodiesWithoutTheFieldArePlain) {
  write(samples::twoBodies(), pictureOf("plastic_strain"),
        {.parts = {ExportPart::Body, ExportPart::Points, ExportPart::Net, ExportPart::Knots}});
  EXPECT_THAT(shown(), StartsWith("body_stamp visible  \n"
                                  "knots_block visible  \nknots_stamp visible  \n"
                                  "points_block hidden  \npoints_stamp hidden  \n"
                                  "net_block hidden  \nnet_stamp hidden  \n"
                                  "body_block visible plastic_strain \n"));
  PictureOptions picture = pictureOf("von_mises");
  picture.bodies = {"stamp"};
  write(samples::twoBodies(), picture, {.parts = {ExportPart::Body}});
  EXPECT_THAT(shown(), StartsWith("body_block hidden  \nbody_stamp visible von_mises [MPa] \n"));
}

TEST_F(ParaView, FieldsOfContactAreOnTheContact) {
  samples::Sample sample = samples::rubbedSlab();
  sample.model.tools.front().name = "disc";
  for (const auto& [field, array] :
       std::vector<std::pair<std::string, std::string>>{{"contact_pressure", "contact_pressure [MPa] "},
                                                        {"friction_traction", "friction [MPa] Magnitude"},
                                                        {"slip", "slip [mm] Magnitude"},
                                                        {"slipped", "slipped [mm] "},
                                                        {"sliding", "sliding "}}) {
    write(sample, pictureOf(field));
    const std::string lines = shown();
    EXPECT_THAT(lines, StartsWith("body visible  \ntool_disc visible  \n"));
    EXPECT_THAT(lines, HasSubstr("contact_disc visible " + array + "\n"));
  }
  // States have their own colours, in the middle of which their numbers lie.
  EXPECT_THAT(shown(), HasSubstr("scale 3 -0.5 2.5\n"));
}

TEST_F(ParaView, ColoursSpanAllFramesThatAreThere) {
  samples::Sample sample = samples::slab();
  ParaViewSeries series(directory_, sample.model, {}, pictureOf("plastic_strain"));
  series.write(sample.frame);
  EXPECT_THAT(shown(), HasSubstr("scale 17 0.0 1.0\n"));  // 4 s (1-s) t²
  FrameRecord second = sample.frame;
  second.index = 1;
  second.fields.at("plastic_strain").values *= 3.0;
  series.write(second);
  EXPECT_THAT(shown(), HasSubstr("scale 17 0.0 3.0\n"));
  FrameRecord third = sample.frame;
  third.index = 2;
  series.write(third);
  EXPECT_THAT(shown(), HasSubstr("scale 17 0.0 3.0\n"));
  third.index = 1;  // takes the place of both
  series.write(third);
  EXPECT_THAT(shown(), HasSubstr("scale 17 0.0 1.0\n"));
}

TEST_F(ParaView, FramesWithoutTheFieldAreShownPlain) {
  write(samples::slab(), pictureOf("contact_pressure"));
  EXPECT_THAT(shown(), StartsWith("body visible  \ntool_cylinder visible  \ntime 1.0\ncamera "));
}

TEST_F(ParaView, ShowsTheTimeOfThePicture) {
  samples::Sample sample = samples::slab();
  ParaViewSeries series(directory_, sample.model, {}, pictureOf("plastic_strain"), {0.0, 0.3, 0.7});
  const std::vector<std::pair<double, std::string>> frames{{0.0, "time 0\n"},         {0.1, "time 0\n"},
                                                           {0.1 + 0.2, "time 0.3\n"}, {0.5, "time 0.3\n"},
                                                           {0.7, "time 0.7\n"},       {2.0, "time 0.7\n"}};
  for (const auto& [time, words] : frames) {
    sample.frame.time = time;
    series.write(sample.frame);
    ++sample.frame.index;
    EXPECT_THAT(shown(), HasSubstr(words));
  }
  write(samples::slab(), {});
  EXPECT_THAT(shown(), HasSubstr("time 1.0\n")) << "the last one";
}

TEST_F(ParaView, TakesRangeBandsAndColoursOfThePicture) {
  PictureOptions picture = pictureOf("plastic_strain");
  picture.range = {0.25, 0.5};
  picture.bands = 5;
  picture.colormap = "grey";
  write(samples::slab(), picture);
  EXPECT_THAT(shown(), HasSubstr("scale 5 0.25 0.5\n"));
  EXPECT_THAT(script(), HasSubstr("\"#282828 #5a5a5a #8c8c8c #bebebe #f0f0f0\""));
}

TEST_F(ParaView, LooksFromWhereThePictureIsSeen) {
  write(samples::slab(), {});
  EXPECT_THAT(script(), HasSubstr("eye, up = [0, 0, 1], [0, 1, 0]"));
  PictureOptions picture = pictureOf("pressure");
  picture.view.name = "xz";
  picture.tools = false;
  picture.window = Eigen::AlignedBox2d(Eigen::Vector2d(0.0, 0.25), Eigen::Vector2d(1.0, 0.75));
  write(samples::cube(), picture);
  EXPECT_THAT(script(), HasSubstr("eye, up = [0, -1, 0], [0, 0, 1]"));
  EXPECT_THAT(script(), HasSubstr("center, width, height = [0.5, 0.5, 0.5], 1, 0.5"));
  // In a view of 800 x 600 the width decides.
  EXPECT_THAT(shown(), HasSubstr("camera 0.5 0.5 0.5 0 0 1 0.44"));
  EXPECT_THAT(shown("picture.png"), StartsWith("picture picture.png 1600 900\n"));
}

TEST_F(ParaView, MovesWithItsDirectory) {
  write(samples::slab(), {});
  const fs::path moved = directory_.string() + "_moved ' é";
  fs::rename(directory_, moved);
  const Outcome outcome =
      shell("/", "cd / && PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=" + std::string(BURNISH_SOURCE_DIR) +
                     "/tests/postproc/paraview/stub " + BURNISH_PYTHON + " \"" +
                     (moved / "frames.py").string() + "\"");
  fs::rename(moved, directory_);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("body visible plastic_strain"));
}

TEST_F(ParaView, NamesOfUnitsCannotLeaveTheirText) {
  samples::Sample sample = samples::slab();
  sample.frame.fields.at("plastic_strain").unit = "µ\"\\\n'''";
  ParaViewSeries series(directory_, sample.model, {}, pictureOf("plastic_strain"));
  series.write(sample.frame);
  EXPECT_THAT(script(), HasSubstr(R"(array, component = "plastic_strain [µ\"\\\x0a''']", None)"));
}

TEST_F(ParaView, AScriptOfAnEarlierSeriesIsRemoved) {
  write(samples::slab(), {});
  ASSERT_TRUE(fs::exists(directory_ / "frames.py"));
  const ParaViewSeries series(directory_, samples::slab().model, {}, {});
  EXPECT_FALSE(fs::exists(directory_ / "frames.py"));
}

TEST(ColorScale, JointsJoinedStraightAreTheScale) {
  for (const std::string& name : colormapNames())
    for (const std::optional<double> middle : {std::optional<double>(), std::optional(0.0)}) {
      const ColorScale scale(name, {-1.0, 3.0}, 0, isDiverging(name) ? middle : std::nullopt);
      const auto& joints = scale.joints();
      const auto& colors = scale.colors();
      for (std::size_t k = 0; k < colors.size(); ++k) {
        const double place =
            static_cast<double>(k * (joints.size() - 1)) / static_cast<double>(colors.size() - 1);
        const std::size_t joint = std::min(static_cast<std::size_t>(place), joints.size() - 2);
        const double along = place - static_cast<double>(joint);
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR((1.0 - along) * joints[joint][c] + along * joints[joint + 1][c], colors[k][c], 2.0)
              << name << ' ' << k;
      }
    }
}

}  // namespace
}  // namespace burnish
