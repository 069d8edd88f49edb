#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "postproc/draw/contour/contour_series.h"
#include "tests/postproc/draw/contour_fixture.h"

/// Contour pictures of several bodies.
namespace burnish {
namespace {

TEST_F(ContourPictures, SeveralBodiesShareOneColourScale) {
  ContourOptions options = small("von_mises");
  options.undeformed = false;
  const Picture picture = drawn(samples::twoBodies(), options);
  const ColorScale scale("viridis", {0.0, 45.0}, 0);
  expectColor(picture, Eigen::Vector2d(0.5, 0.3), scale.color(5.0));
  expectColor(picture, Eigen::Vector2d(3.7, 0.3), scale.color(37.0));
  expectColor(picture, Eigen::Vector2d(4.3, 0.8), scale.color(43.0));
  expectColor(picture, Eigen::Vector2d(3.25, 0.5), {255, 255, 255});  // between the bodies
}

TEST_F(ContourPictures, ABodyWithoutTheFieldIsDrawnPlain) {
  const samples::Sample sample = samples::twoBodies();
  const Picture picture = expectBaseline(sample, small("plastic_strain"), "two_bodies");
  const ColorScale scale("viridis", {0.0, 1.0}, 0);
  expectColor(picture, Eigen::Vector2d(1.5, 0.425), scale.color(0.25));  // s = t = 0.5
  expectColor(picture, Eigen::Vector2d(4.0, 0.5), {238, 238, 238});
  // The zeros that stand for it do not widen the scale.
  samples::Sample offset = sample;
  offset.frame.fields.at("plastic_strain").values.array() += 2.0;
  const auto range = shownRanges(offset.model, offset.frame, small("plastic_strain")).shown;
  EXPECT_NEAR(range[0], 2.0, 1e-12);
}

TEST_F(ContourPictures, ChosenBodiesAreDrawnAlone) {
  ContourOptions options = small("von_mises");
  options.bodies = {"stamp"};
  options.tools = false;
  const samples::Sample sample = samples::twoBodies();
  const Picture picture = drawn(sample, options);
  const ColorScale scale("viridis", {35.0, 45.0}, 0);
  expectColor(picture, Eigen::Vector2d(4.0, 0.5), scale.color(40.0));
  const Eigen::AlignedBox2d seen = contentOf(sample.model, sample.frame, options);
  EXPECT_NEAR(seen.min().x(), 3.5, 1e-9);
  EXPECT_NEAR(seen.max().x(), 4.5, 1e-9);
}

TEST_F(ContourPictures, AFieldThatNoChosenBodyHasIsRefused) {
  ContourOptions options = small("plastic_strain");
  options.bodies = {"stamp"};
  const samples::Sample sample = samples::twoBodies();
  EXPECT_THROW(drawn(sample, options), Error);
  options.bodies = {"anvil"};
  EXPECT_THROW(drawn(sample, options), Error);
}

}  // namespace
}  // namespace burnish
