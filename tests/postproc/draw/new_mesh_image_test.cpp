#include <gmock/gmock.h>

#include <optional>
#include <string>

#include "engine/results/result_writer.h"
#include "postproc/compare/comparison.h"
#include "postproc/draw/contour/color_range.h"
#include "tests/cli/shell.h"
#include "tests/postproc/draw/contour_fixture.h"

/// Pictures and commands go on without a seam over a change of the mesh.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using samples::Sample;
using testing::HasSubstr;

class NewMesh : public ContourPictures {
 protected:
  /// The same functions of space on another mesh look the same.
  void expectSamePicture(const Sample& before, const Sample& after, ContourOptions options) const {
    options.subdivision = 30;  // the cells differ, but cannot be seen
    const Sample anew = samples::meshedAnew(before, after);
    drawContour(before.model, before.frame, options, dir / "before.png");
    drawContour(anew.model, anew.frame, options, dir / "after.png");
    const Comparison comparison = compareFiles("after", dir / "after.png", dir / "before.png", {});
    EXPECT_EQ(comparison.verdict, PictureVerdict::Equal) << comparison.message;
  }
};

TEST_F(NewMesh, LooksLikeTheOneBefore) {
  expectSamePicture(samples::slab(), samples::slab({7, 9}), small("plastic_strain"));
  expectSamePicture(samples::slab(), samples::slab({13, 4}), small("displacement.y"));
  expectSamePicture(samples::ring(), samples::ring({7, 6}), small("von_mises"));  // the same arcs
  ContourOptions options = small("plastic_strain");
  options.range = {0.0, 1.0};  // ticks do not jump by a pixel where a range has rounding errors
  options.mirror = {{0, 0.0}};
  expectSamePicture(samples::slab(), samples::slab({5, 5}), options);
}

TEST_F(NewMesh, HasTheColourRangeOfTheOneBefore) {
  const Sample before = samples::slab(), anew = samples::meshedAnew(before, samples::slab({17, 10}));
  for (const std::optional<double> clip : {std::optional<double>(), std::optional<double>(95.0)}) {
    const auto expected = fieldRange(before.model, before.frame, "plastic_strain", 30, clip),
               found = fieldRange(anew.model, anew.frame, "plastic_strain", 30, clip);
    EXPECT_NEAR(found[0], expected[0], 1e-3);
    EXPECT_NEAR(found[1], expected[1], 3e-3);
  }
}

TEST_F(NewMesh, LooksLikeTheOneBeforeInSpace) {
  ContourOptions options = small("pressure");
  expectSamePicture(samples::cube(), samples::cube(4), options);
  options.cut = CutPlane{{0.0, 0.0, 0.4}, {0.0, 0.0, 1.0}};
  expectSamePicture(samples::cube(), samples::cube(2), options);
  options.cut.reset();
  options.slice = CutPlane{{0.0, 0.0, 0.4}, {0.2, 0.0, 1.0}};
  expectSamePicture(samples::cube(), samples::cube(5), options);
}

TEST_F(NewMesh, HasItsOwnKnotsAndControlNet) {
  ContourOptions options = small("plastic_strain");
  options.knots = true;
  options.controlNet = true;
  expectBaseline(samples::meshedAnew(samples::slab(), samples::slab({5, 3})), options, "slab_new_mesh");
  options = small("pressure");
  options.knots = true;
  options.cut = CutPlane{{0.0, 0.0, 0.4}, {0.0, 0.0, 1.0}};
  expectBaseline(samples::meshedAnew(samples::cube(), samples::cube(5)), options, "cube_new_mesh_cut");
}

TEST_F(NewMesh, UndeformedBodyIsThatOfTheModel) {
  Sample anew = samples::meshedAnew(samples::slab(), samples::slab({7, 9}));
  const Picture expected = drawn(anew, small("plastic_strain"));
  const Eigen::Vector2d shift(0.4, -0.3);
  anew.frame.mesh->patches.front().points.colwise() += shift;
  anew.frame.displacement.colwise() -= shift;
  EXPECT_EQ(drawn(anew, small("plastic_strain")).pixels, expected.pixels);
}

TEST_F(NewMesh, EveryCommandTakesAResultWithSeveralMeshes) {
  Sample sample = samples::slab();
  {
    ResultWriter result(dir / "run", sample.model);
    result.append(sample.frame);
    sample = samples::meshedAnew(sample, samples::slab({7, 9}));
    sample.frame.index = 1;
    result.append(sample.frame);
  }
  const auto burnish = [&](const std::string& arguments) {
    const Outcome outcome = shell(dir, BURNISH_COMMAND " " + arguments);
    EXPECT_EQ(outcome.code, 0) << arguments << ": " << outcome.err;
    return outcome.out;
  };
  EXPECT_THAT(burnish("info run"),
              HasSubstr("last mesh   99 nodes\npatch       NURBS of degree 2 x 2, 7 x 9"));
  burnish(
      "render run --field plastic_strain --frame all -o shot_{frame}.png --size 400,300 --subdivision 20");
  burnish("compare shot_0.png shot_1.png");
  burnish("export run --cells bezier --parts body,tools,net");
  EXPECT_TRUE(fs::exists(dir / "run/frames/body_000001.vtu"));
  burnish("animate run --field plastic_strain --size 400,300 -o run.png");
  burnish("report run");
}

}  // namespace
}  // namespace burnish
