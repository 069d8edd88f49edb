#include "postproc/mesh/chosen_bodies.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "postproc/mesh/tessellation.h"
#include "tests/postproc/sample_records.h"

namespace burnish {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ChosenBodies, KeepTheirPatchesFieldsContactAndPoints) {
  samples::Sample sample = samples::twoBodies();
  sample.frame.contact.resize(2);
  sample.frame.contact[0].patch = 0;
  sample.frame.contact[1].patch = 1;
  sample.frame.contact[1].face = "top";
  sample.frame.quadrature.numPoints = {2, 3};
  sample.frame.quadrature.positions = Eigen::MatrixXd::Random(2, 5);
  sample.frame.quadrature.fields["J"] = {{}, "", Eigen::RowVectorXd::LinSpaced(5, 0.0, 4.0), {}};

  const ModelFrame stamp = chosenBodies(sample.model, sample.frame, {"stamp"});
  ASSERT_EQ(stamp.model.mesh.patches.size(), 1u);
  EXPECT_EQ(stamp.model.mesh.patches[0].points, sample.model.mesh.patches[1].points);
  EXPECT_EQ(stamp.model.bodies, sample.model.bodies);
  ASSERT_EQ(stamp.frame.contact.size(), 1u);
  EXPECT_EQ(stamp.frame.contact[0].face, "top");
  EXPECT_EQ(stamp.frame.contact[0].patch, 0);
  EXPECT_FALSE(stamp.frame.fields.contains("plastic_strain"));
  EXPECT_TRUE(stamp.frame.fields.contains("von_mises"));
  EXPECT_EQ(stamp.frame.quadrature.positions, sample.frame.quadrature.positions.rightCols(3));
  EXPECT_EQ(stamp.frame.quadrature.fields.at("J").values, (Eigen::RowVector3d(2.0, 3.0, 4.0)));

  // Nodes keep their numbers, so that fields are evaluated where they were.
  const Tessellation cells(stamp.model.mesh, 2);
  const Eigen::MatrixXd mises = cells.evaluate(stamp.frame.fields.at("von_mises").values);
  EXPECT_TRUE(mises.isApprox(10.0 * cells.referencePoints().row(0), 1e-12));
}

TEST(ChosenBodies, RefuseNamesThatNoneHas) {
  const samples::Sample two = samples::twoBodies(), one = samples::slab();
  const auto refusal = [](const samples::Sample& sample) -> std::string {
    try {
      chosenBodies(sample.model, sample.frame, {"stmp"});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(two), "body: found \"stmp\"; the bodies are block, stamp. Did you mean \"stamp\"?");
  EXPECT_EQ(refusal(one), "body: found \"stmp\"; the bodies are one without a name.");
}

TEST(FieldMesh, PartsBodiesByWhetherTheyHaveTheField) {
  const samples::Sample sample = samples::twoBodies();
  EXPECT_THAT(bodiesWithout(sample.model, sample.frame, "plastic_strain"), ElementsAre("stamp"));
  EXPECT_THAT(bodiesWithout(sample.model, sample.frame, "von_mises"), IsEmpty());
  EXPECT_THAT(bodiesWithout(sample.model, sample.frame, "displacement.y"), IsEmpty());

  const FieldMesh strain(sample.model, sample.frame, "plastic_strain");
  ASSERT_NE(strain.without(), nullptr);
  EXPECT_EQ(strain.with().patches.at(0).body, 0);
  EXPECT_EQ(strain.without()->patches.at(0).body, 1);
  EXPECT_EQ(FieldMesh(sample.model, sample.frame, "von_mises").without(), nullptr);
}

}  // namespace
}  // namespace burnish
