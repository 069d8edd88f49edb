#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <vector>

#include "engine/core/error.h"
#include "postproc/draw/contour/contour_series.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/mesh/contact_field.h"
#include "postproc/mesh/mirror.h"
#include "tests/postproc/draw/contour_fixture.h"

/// Pictures of what happens on faces in contact.
namespace burnish {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;

constexpr Color kPlain{238, 238, 238};

double middle(const samples::Sample& sample, const std::string& field) {
  const auto faces = contactFieldFaces(sample.model, sample.frame, field);
  return faces->GetPointData()->GetScalars()->GetTuple1(24);  // s = 24.5/48
}

TEST(ContactField, HasTheRecordedAmounts) {
  const samples::Sample sample = samples::rubbedSlab();
  const double s = 24.5 / 48.0, p = 10.0 - 40.0 * (s - 0.5);
  EXPECT_NEAR(middle(sample, "contact_pressure"), p, 1e-13);
  EXPECT_NEAR(middle(sample, "friction_traction"), 0.3 * p, 1e-13);
  EXPECT_EQ(middle(sample, "slip"), 0.0);
  EXPECT_NEAR(middle(sample, "slipped"), s, 1e-15);
  EXPECT_EQ(middle(sample, "contact_pressure"), p) << "amounts are at the points themselves";
}

TEST(ContactField, IsOfferedWhereThereIsContactAndFriction) {
  samples::Sample sample = samples::rubbedSlab();
  EXPECT_THAT(fieldNames(sample.frame), IsSupersetOf(contactFieldNames()));
  sample.frame.contact.front().quadratureSliding.clear();
  EXPECT_EQ(contactFieldsOf(sample.frame), std::vector<std::string>{"contact_pressure"});
  sample.frame.contact.clear();
  EXPECT_TRUE(contactFieldsOf(sample.frame).empty());
}

TEST(ContactField, AMirrorTurnsVectorsOfFriction) {
  const samples::Sample sample = samples::rubbedSlab();
  const ModelFrame whole = mirrored(sample.model, sample.frame, {{.axis = 0, .at = 0.0}});
  ASSERT_EQ(whole.frame.contact.size(), 2U);
  const ContactRecord &own = whole.frame.contact[0], &image = whole.frame.contact[1];
  EXPECT_EQ(image.quadratureFriction.row(0), -own.quadratureFriction.row(0));
  EXPECT_EQ(image.quadratureSlip.row(0), -own.quadratureSlip.row(0));
}

TEST_F(ContourPictures, AContactFieldIsDrawnAlongTheFace) {
  ContourOptions options = small("contact_pressure");
  options.undeformed = false;
  const Picture picture = expectBaseline(samples::rubbedSlab(), options, "slab_contact");
  const ColorScale scale("viridis", {0.0, 10.0 - 40.0 * (24.5 / 48.0 - 0.5)}, 0);
  expectColor(picture, Eigen::Vector2d(1.5, 0.85), scale.color(scale.range()[1]));
  expectColor(picture, Eigen::Vector2d(0.3, 1.0 - 0.6 * 0.1 * 0.9), scale.color(0.0));
  expectColor(picture, Eigen::Vector2d(1.37, 0.43), kPlain);
}

TEST_F(ContourPictures, StatesHaveTheSameColoursEverywhereAndNoneBetweenThem) {
  samples::Sample sample = samples::rubbedSlab();
  std::vector<int>& states = sample.frame.contact.front().quadratureSliding;
  for (int& state : states) state = state == 1 ? 2 : state;  // from open to slip
  ContourOptions options = small("sliding");
  options.undeformed = false;
  const Picture picture = expectBaseline(sample, options, "slab_sliding");
  const ColorScale scale("viridis", {-0.5, 2.5}, 3);
  const auto place = [](double s) { return Eigen::Vector2d(3.0 * s, 1.0 - 0.6 * s * (1.0 - s)); };
  for (const double s : {0.23, 0.24, 0.245}) expectColor(picture, place(s), scale.color(0.0));
  for (const double s : {0.255, 0.26, 0.27}) expectColor(picture, place(s), scale.color(2.0));
  expectColor(picture, place(0.5), scale.color(2.0));
  expectColor(picture, place(0.1), scale.color(0.0));
  options.range = {0.0, 2.0};
  EXPECT_THROW(drawn(sample, options), Error);
}

TEST_F(ContourPictures, AContactFieldIsRefusedWhereItCannotBeDrawn) {
  samples::Sample sample = samples::rubbedSlab();
  ContourOptions warped = small("slip");
  warped.warp = 2.0;
  EXPECT_THROW(drawn(sample, warped), Error);
  sample.frame.contact.clear();
  try {
    drawn(sample, small("slip"));
    FAIL() << "drawn";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("field: found \"slip\"; available in frame"));
  }
}

}  // namespace
}  // namespace burnish
