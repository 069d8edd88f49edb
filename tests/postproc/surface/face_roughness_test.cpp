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
  spec.face = "middle";
  EXPECT_THAT(messageOf([&] { faceProfile(slab.model, slab.frame, spec); }), HasSubstr("face: 'middle'"));
}

}  // namespace
}  // namespace burnish
