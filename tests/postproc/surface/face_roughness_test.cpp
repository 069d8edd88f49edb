#include "postproc/surface/face_roughness.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/message_of.h"
#include "tests/postproc/sample_records.h"

namespace burnish {
namespace {

using samples::Sample;
using testing::HasSubstr;

RoughnessSpec top() {
  RoughnessSpec spec;
  spec.face = "top";
  return spec;
}

/// A slab of length 3 whose upper face is a parabola, 0.15 deep.
TEST(FaceRoughness, OfAParabolaIsKnown) {
  const Sample sample = samples::rubbedSlab();
  const FaceProfile face = faceProfile(sample.model, sample.frame, top());
  EXPECT_NEAR(face.roughness.a, 0.15 * 4.0 / (9.0 * std::sqrt(3.0)), 1e-6);
  EXPECT_NEAR(face.roughness.q, 0.15 * 2.0 / (3.0 * std::sqrt(5.0)), 1e-6);
  EXPECT_NEAR(face.roughness.z, 0.15, 1e-9);
  EXPECT_NEAR(face.roughness.length, 3.0, 1e-9);
  // Up is out of the material: the middle is its deepest place.
  const Eigen::VectorXd& heights = face.profile.heights;
  EXPECT_NEAR(heights(heights.size() / 2), -0.05, 1e-6);

  RoughnessSpec half = top();
  half.within = "0,0:1.5,2";
  EXPECT_NEAR(faceProfile(sample.model, sample.frame, half).roughness.z, 0.15 / 4.0, 2e-3);
}

TEST(FaceRoughness, IsThatOfBothSidesOfASlab) {
  const Sample sample = samples::rubbedSlab();
  RoughnessSpec bottom = top();
  bottom.face = "bottom";
  EXPECT_NEAR(faceProfile(sample.model, sample.frame, bottom).roughness.z, 0.0, 1e-12);
}

TEST(FaceRoughness, OfATiltedAreaIsNothing) {
  Sample sample = samples::cube();
  const Eigen::MatrixXd& x = sample.model.mesh.patches.front().points;
  sample.frame.displacement.setZero();
  sample.frame.displacement.row(1) = 0.1 * x.row(0) - 0.3 * x.row(2);
  const AreaRoughness tilted = faceArea(sample.model, sample.frame, top()).roughness;
  EXPECT_NEAR(tilted.z, 0.0, 1e-12);
  EXPECT_NEAR(tilted.area, std::sqrt(1.0 + 0.01 + 0.09), 1e-12);

  sample.frame.displacement.row(1) =
      0.1 * x.row(0).cwiseProduct(x.row(2));  // of Greville abscissae: xz, exact
  const AreaRoughness twisted = faceArea(sample.model, sample.frame, top()).roughness;
  EXPECT_NEAR(twisted.q, 0.1 / 12.0, 2e-5);  // of (x - 1/2)(z - 1/2)
  EXPECT_NEAR(twisted.z, 0.1 / 2.0, 1e-4);   // over a plane that is a little tilted
}

/// A cube whose upper face is y = 1 + x z/10, which is straight along x and a parabola along its diagonal.
Sample twistedCube() {
  Sample sample = samples::cube();
  const Eigen::MatrixXd& x = sample.model.mesh.patches.front().points;
  sample.frame.displacement.setZero();
  sample.frame.displacement.row(1) = 0.1 * x.row(1).cwiseProduct(x.row(0).cwiseProduct(x.row(2)));
  return sample;
}

TEST(FaceRoughness, OfALineOverAFaceInSpaceIsThatOfItsProfile) {
  const Sample sample = twistedCube();
  RoughnessSpec along = top(), diagonal = top();
  along.line = "0.1,1,0.3:0.9,1,0.3";
  EXPECT_LT(faceProfile(sample.model, sample.frame, along).roughness.z, 5e-5);  // along the tilted mean plane
  diagonal.line = "0,1,0:1,1.1,1";
  const FaceProfile face = faceProfile(sample.model, sample.frame, diagonal);
  EXPECT_NEAR(face.roughness.z, 0.1 / 4.0, 1e-4);
  EXPECT_NEAR(face.roughness.a, 0.1 / 4.0 * 4.0 / (9.0 * std::sqrt(3.0)), 1e-4);
  EXPECT_NEAR(face.roughness.length, std::sqrt(2.0), 5e-3);
  EXPECT_LT(face.profile.heights(face.profile.heights.size() / 2), 0.0);
  diagonal.cutoff = 0.2;
  EXPECT_LT(faceProfile(sample.model, sample.frame, diagonal).roughness.z, 0.01 * face.roughness.z);
}

/// Across a steep flank of a valley: a bump is as high as it is along the normal there, not along that of the whole face.
TEST(FaceRoughness, OfALineIsMeasuredAlongTheNormalWhereItLies) {
  Sample sample = samples::cube(8);
  const Eigen::MatrixXd& x = sample.model.mesh.patches.front().points;
  sample.frame.displacement.setZero();
  for (Eigen::Index a = 0; a < x.cols(); ++a)
    sample.frame.displacement(1, a) =
        x(1, a) * (4.0 * std::pow(x(0, a) - 0.5, 2) + 0.1 * x(2, a) * (1.0 - x(2, a)));
  RoughnessSpec spec = top();
  spec.line = "0.8,1.37,0.1:0.8,1.37,0.9";
  const double slope = 8.0 * 0.3, bump = 0.1 * (0.25 - 0.09);
  EXPECT_NEAR(faceProfile(sample.model, sample.frame, spec).roughness.z, bump / std::hypot(1.0, slope),
              0.05 * bump / slope);
  spec.line = "0.1,1.64,0.5:0.9,1.64,0.5";
  EXPECT_THAT(messageOf([&] { faceProfile(sample.model, sample.frame, spec); }),
              HasSubstr("line: the face turns by more than 60 degrees"));
}

/// As seen from above: x to the right and z down.
TEST(HeightMap, HasTheHeightsWhereTheyAreSeen) {
  const Sample sample = twistedCube();
  for (const char* within : {"", "0,0.9,0:0.6,1.1,1"}) {
    RoughnessSpec spec = top();
    spec.within = within;
    const FaceArea area = faceArea(sample.model, sample.frame, spec);
    const ModelFrame map = heightMap(sample.model, sample.frame, area);
    const PatchRecord& patch = map.model.mesh.patches.front();
    const Eigen::MatrixXd& heights = map.frame.fields.at(kHeightField).values;
    ASSERT_EQ(patch.points.cols(), heights.cols());
    ASSERT_EQ(patch.points.cols(), area.grid[0] * area.grid[1]);
    const Eigen::Vector2d low = patch.points.rowwise().minCoeff(), high = patch.points.rowwise().maxCoeff();
    const double length = *within == 0 ? 1.0 : 0.6;
    EXPECT_NEAR(high(0) - low(0), length, 0.07);
    EXPECT_NEAR(high(1) - low(1), 1.0, 0.01);
    const Eigen::Vector2d middle = 0.5 * (low + high);
    for (Eigen::Index k = 0; k < heights.cols(); ++k) {
      const Eigen::Vector2d from = patch.points.col(k) - middle;
      EXPECT_NEAR(heights(k), 0.1 * from(0) * -from(1), 1.5e-3);
    }
    EXPECT_GT(patch.points(1, patch.points.cols() - 1), patch.points(1, 0));  // a right-handed patch
  }
}

TEST(FaceRoughness, KnowsPlacesThatAreNone) {
  RoughnessSpec spec;
  EXPECT_TRUE(mistakesIn(spec).empty());
  for (const char* box : {"0,0:1,1", "0,0,0:1,1,1"}) {
    spec.within = box;
    EXPECT_TRUE(mistakesIn(spec).empty()) << box;
  }
  spec.within = "1,1";
  ASSERT_EQ(mistakesIn(spec).size(), 1U);
  EXPECT_EQ(mistakesIn(spec).front().path, "within");
}

TEST(FaceRoughness, SaysWhatWouldBeRight) {
  const Sample slab = samples::rubbedSlab(), cube = samples::cube();
  RoughnessSpec spec = top();
  spec.within = "1,1";
  EXPECT_THAT(messageOf([&] { faceProfile(slab.model, slab.frame, spec); }),
              HasSubstr("within: found \"1,1\"; expected X0,Y0:X1,Y1"));
  spec.within = "7,7:8,8";
  EXPECT_THAT(messageOf([&] { faceProfile(slab.model, slab.frame, spec); }),
              HasSubstr("nothing of the face"));
  spec = top();
  spec.cutoff = 0.5;
  EXPECT_THAT(messageOf([&] { faceArea(cube.model, cube.frame, spec); }),
              HasSubstr("cutoff: areas are not filtered"));
  spec = top();
  spec.line = "0.1,1,0.3:0.9,1,1.3";
  EXPECT_THAT(messageOf([&] { faceProfile(cube.model, cube.frame, spec); }),
              HasSubstr("line: found (0.9, 1, 1.3), which lies 0.3 beside the face"));
  spec.line = "0.1,1,0.3:0.1,2,0.3";
  EXPECT_THAT(messageOf([&] { faceProfile(cube.model, cube.frame, spec); }),
              HasSubstr("line: goes across the face"));
  spec.within = "0,0,0:1,2,1";
  EXPECT_THAT(messageOf([&] { faceProfile(cube.model, cube.frame, spec); }),
              HasSubstr("line: found beside within"));
  spec.within.clear();
  spec.line = "0.1,1";
  EXPECT_THAT(messageOf([&] { faceProfile(cube.model, cube.frame, spec); }),
              HasSubstr("line: found \"0.1,1\"; expected X0,Y0,Z0:X1,Y1,Z1"));
  EXPECT_THAT(messageOf([&] { faceProfile(slab.model, slab.frame, spec); }),
              HasSubstr("line: found a plane body"));
  spec = top();
  EXPECT_THAT(messageOf([&] { faceProfile(cube.model, cube.frame, spec); }), HasSubstr("line: missing"));
  spec.face = "middle";
  EXPECT_THAT(messageOf([&] { faceProfile(slab.model, slab.frame, spec); }), HasSubstr("face: 'middle'"));
}

}  // namespace
}  // namespace burnish
