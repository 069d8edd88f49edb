#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "postproc/probe/section_numbers.h"
#include "tests/message_of.h"
#include "tests/postproc/sample_records.h"

namespace burnish {
namespace {

using samples::Sample;
using testing::HasSubstr;

const std::vector<std::string> kAllBodies;

CutPlane planeAt(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  return {point, normal};
}

SectionNumbers numbersOf(const Sample& sample, const CutPlane& plane) {
  return sectionNumbers(sample.model, sample.frame, plane, kAllBodies);
}

/// A cube turned by `turn` with the stresses xx = 10 - 20 Y + 6 Z, xy = 3 of the directions that turn with it.
Sample loadedCube(const Eigen::Matrix3d& turn) {
  Sample cube = samples::cube();
  const Eigen::MatrixXd X = cube.model.mesh.patches.front().points;
  cube.frame.displacement = turn * X - X;
  Eigen::MatrixXd values(6, X.cols());
  for (Eigen::Index a = 0; a < X.cols(); ++a) {
    Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
    stress(0, 0) = 10.0 - 20.0 * X(1, a) + 6.0 * X(2, a);
    stress(0, 1) = stress(1, 0) = 3.0;
    const Eigen::Matrix3d s = turn * stress * turn.transpose();
    values.col(a) << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0);
  }
  cube.frame.fields["stress"] = {{"xx", "yy", "zz", "xy", "yz", "zx"}, "MPa", values};
  return cube;
}

TEST(SectionNumbers, AreTheForceAndTheMomentOfALinearStressHoweverTheBodyLies) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
  for (const Eigen::Matrix3d& R : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), turn}) {
    const SectionNumbers numbers =
        numbersOf(loadedCube(R), planeAt(R * Eigen::Vector3d(0.37, 0.0, 0.0), 5.0 * R.col(0)));
    EXPECT_NEAR(numbers.area, 1.0, 1e-9);
    EXPECT_NEAR(numbers.force, 3.0, 1e-9);
    EXPECT_NEAR(numbers.tension, 4.3, 1e-9);  // above y = 0.5 + 0.3 z there is none
    EXPECT_NEAR(numbers.compression, -1.3, 1e-9);
    EXPECT_NEAR(numbers.largest, 16.0, 1e-9);
    EXPECT_NEAR(numbers.balance(), 3.0 / 16.0, 1e-9);
    EXPECT_LT(numbers.unsettled, 1e-9);
    EXPECT_LT((R.transpose() * numbers.traction - Eigen::Vector3d(3.0, 3.0, 0.0)).norm(), 1e-9);
    EXPECT_LT((R.transpose() * numbers.moment - Eigen::Vector3d(0.0, 0.5, 20.0 / 12.0)).norm(), 1e-9);
  }
}

TEST(SectionNumbers, AreThereInTheFacesOfTheBodyToo) {
  const Sample cube = loadedCube(Eigen::Matrix3d::Identity());
  for (const double x : {0.0, 1.0 / 3.0, 1.0}) {
    const SectionNumbers numbers = numbersOf(cube, planeAt({x, 0.0, 0.0}, Eigen::Vector3d::UnitX()));
    EXPECT_NEAR(numbers.area, 1.0, 1e-9) << x;
    EXPECT_NEAR(numbers.force, 3.0, 1e-6) << x;
  }
}

/// The side to which the normal points pulls: the same forces the other way for the other normal.
TEST(SectionNumbers, TurnTheirSignWithTheNormalButForTheNormalForce) {
  const Sample cube = loadedCube(Eigen::Matrix3d::Identity());
  const SectionNumbers there = numbersOf(cube, planeAt({0.5, 0.0, 0.0}, Eigen::Vector3d::UnitX())),
                       back = numbersOf(cube, planeAt({0.5, 0.0, 0.0}, -Eigen::Vector3d::UnitX()));
  EXPECT_NEAR(there.force, back.force, 1e-12);
  EXPECT_LT((there.traction + back.traction).norm(), 1e-12);
  EXPECT_LT((there.moment + back.moment).norm(), 1e-12);
}

Sample ringUnderTension() {
  Sample ring = samples::ring();
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(4, ring.model.mesh.numNodes);
  values.row(1).setConstant(10.0);
  ring.frame.fields["stress"] = {{"xx", "yy", "xy", "zz"}, "MPa", values};
  return ring;
}

/// A chord of a ring, across its curved knot spans.
TEST(SectionNumbers, AreThoseOfACurvedBody) {
  const double length = std::sqrt(4.0 - 0.25) - std::sqrt(1.0 - 0.25);
  const SectionNumbers numbers =
      numbersOf(ringUnderTension(), planeAt({0.0, 0.5, 0.0}, Eigen::Vector3d::UnitY()));
  EXPECT_NEAR(numbers.area, length, 2e-5 * length);
  EXPECT_NEAR(numbers.force, 10.0 * length, 2e-4 * length);
  EXPECT_NEAR(numbers.balance(), 1.0, 1e-9);
  EXPECT_GT(numbers.unsettled, 1e-7) << "cells are straight";
  EXPECT_LE(numbers.unsettled, 1e-5);
}

TEST(SectionNumbers, AreOfTheWholeRingInAxisymmetry) {
  Sample ring = ringUnderTension();
  ring.model.sceneYaml = "kinematics: axisymmetric\n";
  ASSERT_TRUE(isAxisymmetric(ring.model));
  const SectionNumbers numbers = numbersOf(ring, planeAt({0.0, 0.5, 0.0}, Eigen::Vector3d::UnitY()));
  const double area = std::numbers::pi * (4.0 - 0.25 - (1.0 - 0.25));
  EXPECT_NEAR(numbers.area, area, 2e-5 * area);
  EXPECT_NEAR(numbers.traction.y(), 10.0 * area, 2e-4 * area);
  EXPECT_EQ(numbers.traction.x(), 0.0);
  EXPECT_THAT(messageOf([&] {
                numbersOf(ring, planeAt({1.5, 0.0, 0.0}, Eigen::Vector3d::UnitX()));
              }),
              HasSubstr("section: found a plane that is not across the axis"));
}

TEST(SectionNumbers, MistakesAreTold) {
  const Sample cube = loadedCube(Eigen::Matrix3d::Identity());
  EXPECT_THAT(messageOf([&] {
                numbersOf(cube, planeAt({1.5, 0.0, 0.0}, Eigen::Vector3d::UnitX()));
              }),
              HasSubstr("section: the plane does not cut the deformed body"));
  EXPECT_THAT(messageOf([&] {
                numbersOf(samples::cube(), planeAt({0.5, 0.0, 0.0}, Eigen::Vector3d::UnitX()));
              }),
              HasSubstr("section: frame 0 has no stress"));
  EXPECT_THAT(messageOf([&] {
                numbersOf(ringUnderTension(), planeAt({0, 0, 0}, Eigen::Vector3d::UnitZ()));
              }),
              HasSubstr("that is not across a plane body"));
}

}  // namespace
}  // namespace burnish
