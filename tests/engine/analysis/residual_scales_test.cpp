#include "engine/analysis/residual_scales.h"

#include <gtest/gtest.h>

#include "engine/analysis/build_model.h"
#include "engine/scene/reader.h"

namespace burnish {
namespace {

/// A disc that touches a block of 2 x 1 with 8 x 4 spans; its height is a degree of freedom.
Scene discOnBlock() {
  return parseScene(R"(
degree: 2
geometry: {shape: rectangle, origin: [0, 0], size: [2, 1], spans: [8, 4]}
material: {law: neo-hookean, E: 10.0, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}]
tools: [{name: disc, shape: cylinder, center: [1, 1.5], radius: 0.5, carry: {y: '-t'}}]
contact: [{tool: disc, face: top}]
steps: [{until: 1, count: 4}]
)",
                    "disc");
}

TEST(ResidualScales, ForcesAreThoseOfDisplacementsAndOfToolsConstraintsThoseOfContact) {
  const auto model = buildModel<2>(discOnBlock());
  const ResidualScales scales = residualScales(*model);
  const FaceContact<2>& contact = *model->contacts().front().term;
  EXPECT_EQ(scales.numForces, model->numDisplacements() + 1);
  ASSERT_EQ(scales.constraints.size(), contact.numMultipliers());
  EXPECT_DOUBLE_EQ(scales.constraints.sum(), 2.0 * 2.0) << "size of the body times length of the face";
  EXPECT_DOUBLE_EQ(scales.forceFloor, 1e-9 * 10.0 * 2.0);
}

TEST(ResidualScales, LengthsAreThoseOfTheLargestSpanAroundANode) {
  const auto model = buildModel<2>(discOnBlock());
  const Eigen::VectorXd sizes = residualScales(*model).spanSizes;
  const Eigen::Index n = model->numDisplacements();
  EXPECT_NEAR(sizes.head(n).minCoeff(), 0.25, 0.1);
  EXPECT_NEAR(sizes.head(n).maxCoeff(), 0.25, 0.1);
  EXPECT_EQ(sizes(n), 0.0) << "a tool has no span";
}

}  // namespace
}  // namespace burnish
