#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "postproc/draw/contour/contour_series.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/mesh/contact_field.h"
#include "postproc/mesh/mirror.h"
#include "postproc/mesh/patch_geometry.h"
#include "tests/postproc/draw/contour_fixture.h"

/// Pictures of what happens on faces in contact.
namespace burnish {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;

constexpr Color kPlain{238, 238, 238};

double middle(const samples::Sample& sample, const std::string& field) {
  const auto faces = contactFieldFaces(sample.model, sample.frame, field);
  return faces->GetPointData()->GetScalars()->GetTuple1(25);  // behind the end of the face: s = 24.5/48
}

/// The cube with equal pressure at two by two points of every knot span of its top.
samples::Sample pressedCube() {
  samples::Sample sample = samples::cube(2);
  const auto top = tracePatch(patchGeometry<3>(sample.model.mesh.patches.front()), faceFromName<3>("top"));
  ContactRecord contact;
  contact.tool = sample.model.tools.front().name;
  contact.face = "top";
  contact.quadraturePoints.resize(3, 16);
  for (int k = 0; k < 16; ++k) {
    const auto index = top.basis().spanIndex(k / 4);
    Eigen::Vector2d xi;
    for (int d = 0; d < 2; ++d) {
      const UnivariateBasis& basis = top.basis().direction(d);
      const int span = index[static_cast<std::size_t>(d)], point = d == 0 ? k % 2 : k % 4 / 2;
      xi(d) = std::lerp(basis.spanBegin(span), basis.spanEnd(span), 0.25 + 0.5 * point);
    }
    contact.quadraturePoints.col(k) = top.position(xi);
  }
  contact.quadraturePressure = Eigen::VectorXd::Constant(16, 2.0);
  contact.quadratureGap = Eigen::VectorXd::Zero(16);
  contact.quadratureNormal = Eigen::MatrixXd::Zero(3, 16);
  sample.frame.contact = {contact};
  return sample;
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

TEST(ContactField, ReachesTheEdgesOfTheFace) {
  const samples::Sample slab = samples::rubbedSlab();
  const auto line = contactFieldFaces(slab.model, slab.frame, "slipped");
  ASSERT_EQ(line->GetNumberOfPoints(), 50);
  for (const auto& [point, x] : {std::pair{0, 0.0}, std::pair{49, 3.0}}) {
    EXPECT_EQ(line->GetPoint(point)[0], x);
    EXPECT_EQ(line->GetPoint(point)[1], 1.0);
  }
  vtkDataArray& slipped = *line->GetPointData()->GetScalars();
  EXPECT_EQ(slipped.GetTuple1(0), slipped.GetTuple1(1));
  EXPECT_EQ(slipped.GetTuple1(49), slipped.GetTuple1(48));

  const samples::Sample cube = pressedCube();
  for (const bool isMirrored : {false, true}) {
    const ModelFrame image = mirrored(cube.model, cube.frame, {{.axis = 0, .at = 0.0}});
    const auto faces = isMirrored ? contactFieldFaces(image.model, image.frame, "contact_pressure")
                                  : contactFieldFaces(cube.model, cube.frame, "contact_pressure");
    EXPECT_EQ(faces->GetNumberOfPolys(), isMirrored ? 50 : 25);
    double area = 0.0;
    for (vtkIdType k = 0; k < faces->GetNumberOfCells(); ++k) {
      const double* b = faces->GetCell(k)->GetBounds();
      EXPECT_NEAR(b[2], b[3], 1e-12);
      area += (b[1] - b[0]) * (b[5] - b[4]);
    }
    EXPECT_NEAR(area, isMirrored ? 2.0 : 1.0, 1e-9);
  }
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
