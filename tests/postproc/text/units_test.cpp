#include "postproc/text/units.h"

#include <gtest/gtest.h>

namespace burnish {
namespace {

DerivedUnits unitsOf(const std::string& length, const std::string& stress, int dim,
                     const std::string& scene = "") {
  ModelRecord model;
  model.lengthUnit = length;
  model.stressUnit = stress;
  model.dim = dim;
  model.sceneYaml = scene;
  return derivedUnits(model);
}

TEST(Units, OfForcesHaveTheirUsualNames) {
  EXPECT_EQ(unitsOf("mm", "MPa", 3).force, "N");
  EXPECT_EQ(unitsOf("m", "Pa", 3).energy, "N·m");
  EXPECT_EQ(unitsOf("mm", "GPa", 3).force, "kN");
  EXPECT_EQ(unitsOf("in", "psi", 3).force, "lbf");
  EXPECT_EQ(unitsOf("ft", "psf", 3).force, "psf·ft²");
  EXPECT_EQ(unitsOf("ft", "psf", 3).energy, "psf·ft³");
}

TEST(Units, AreThoseOfAUnitOfDepthInPlaneStrainOnly) {
  EXPECT_EQ(unitsOf("mm", "MPa", 2).force, "N/mm");
  EXPECT_EQ(unitsOf("mm", "MPa", 2).energy, "N·mm/mm");
  EXPECT_EQ(unitsOf("mm", "MPa", 2).area, "mm");
  EXPECT_EQ(unitsOf("ft", "psf", 2).force, "psf·ft");
  const DerivedUnits ring = unitsOf("mm", "MPa", 2, "kinematics: axisymmetric\n");
  EXPECT_EQ(ring.force, "N");
  EXPECT_EQ(ring.area, "mm²");
}

TEST(Units, AreLeftOutWhereTheSceneHasNone) {
  EXPECT_EQ(unitsOf("", "", 3).force, "");
  EXPECT_EQ(unitsOf("mm", "", 3).area, "mm²");
  EXPECT_EQ(withUnit("Force", ""), "Force");
  EXPECT_EQ(withUnit("Force", "N"), "Force [N]");
}

}  // namespace
}  // namespace burnish
