#include "engine/contact/mortar_contact_term.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/contact/face_partner.h"
#include "tests/engine/contact/surface_samples.h"
#include "tests/engine/solid/term_check.h"

namespace burnish {
namespace {

constexpr FaceId kBottom = 2, kTop = 3;

/// A block whose bottom is the slave over one whose top is the master, numbered together; multipliers follow.
template <int Dim>
struct Blocks {
  Body<Dim> upper, lower;
  int numDisplacements;
  MortarContactTerm<Dim> term;

  Blocks(const Patch<Dim>& above, const Patch<Dim>& below, const ContactOptions& options)
      : upper(makeBody(above)),
        lower(below_(below, upper.numNodes)),
        numDisplacements(Dim * (upper.numNodes + lower.numNodes)),
        term(
            upper, 0, kBottom,
            [&](const FaceQuadrature<Dim>& slave) {
              return std::make_unique<FacePartner<Dim>>(
                  slave, tracePatch(above, kBottom), outwardSign(above, kBottom),
                  MasterSurface<Dim>(lower, {{0, kTop}}), PartnerRules{.reach = 0.5});
            },
            options, numDisplacements) {}

  int numUnknowns() const { return numDisplacements + term.numMultipliers(); }

 private:
  static Body<Dim> below_(const Patch<Dim>& patch, int first) {
    Body<Dim> body = makeBody(patch);
    for (int& node : body.nodes.front()) node += first;
    return body;
  }
};

template <int Dim>
Patch<Dim> lifted(const Patch<Dim>& patch, double along, double up) {
  Eigen::Vector<double, Dim> way = Eigen::Vector<double, Dim>::Zero();
  way(0) = along;
  way(1) = up;
  return {patch.basis(), patch.points().colwise() + way, patch.weights()};
}

/// Two wavy blocks of unlike meshes in touch, in a step in which the upper one slides: unknowns of the
/// accepted state and of one in the step.
template <int Dim>
struct SlidingStep {
  Blocks<Dim> blocks;
  Eigen::VectorXd accepted, x;

  SlidingStep(const ContactOptions& options, double way, double tau = 0.02)
      : blocks(lifted<Dim>(test::wavy<Dim>(BasisFamily::BSpline, 2, 2, 0.05, 3), 0.07, 1.0),
               test::wavy<Dim>(BasisFamily::BSpline, 2, 3, 0.05, 4), options) {
    accepted = test::randomState(blocks.numUnknowns(), 2e-3, 5);
    test::forceOf(blocks.term, 0.0, accepted);
    blocks.term.accept();
    x = accepted + test::randomState(blocks.numUnknowns(), 2e-3, 6);
    for (int node = 0; node < blocks.upper.numNodes; ++node) {
      x(Dim * node) += way;
      x(Dim * node + 1) -= 0.02;
    }
    const auto n = blocks.term.numMultipliers();
    x.tail(n) = tau * test::randomState(n, 1.0, 7);
  }
};

ContactOptions withFriction(double mu) {
  ContactOptions options;
  options.parameter = 2.0;
  options.quadraturePoints = 3;
  if (mu > 0.0) options.friction = FormulaText{fmt::format("{}", mu)};
  options.frictionParameter = 1.3;
  return options;
}

/// Components of the sums of forces and moments over all nodes, over the sum of magnitudes.
template <int Dim>
double imbalance(const Blocks<Dim>& blocks, const Eigen::VectorXd& x, const Eigen::VectorXd& force) {
  const auto n = blocks.numDisplacements / Dim;
  Eigen::MatrixXd places = blocks.upper.nodePositions();
  places.conservativeResize(Dim, n);
  for (int a = 0; a < blocks.lower.numNodes; ++a)
    places.col(blocks.upper.numNodes + a) = blocks.lower.patches.front().points().col(a);
  places += x.head(blocks.numDisplacements).reshaped(Dim, n);
  const Eigen::MatrixXd forces = force.head(blocks.numDisplacements).reshaped(Dim, n);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (Eigen::Index a = 0; a < n; ++a) {
    Eigen::Vector3d r = Eigen::Vector3d::Zero(), f = r;
    r.head<Dim>() = places.col(a);
    f.head<Dim>() = forces.col(a);
    moment += r.cross(f);
  }
  return std::max(forces.rowwise().sum().norm(), moment.norm()) / forces.colwise().norm().sum();
}

template <int Dim>
void expectConsistentTangent(double mu, double way) {
  SlidingStep<Dim> step(withFriction(mu), way);
  auto& term = step.blocks.term;
  const Eigen::VectorXd force = test::forceOf(term, 0.0, step.x);
  EXPECT_GT(term.state().numActive(), 2);
  if (mu > 0.0) {
    EXPECT_GT(way > 0.01 ? term.state().slipping : term.state().sticking, 0);
  }
  EXPECT_LT(imbalance(step.blocks, step.x, force), 1e-13);
  EXPECT_LT(test::tangentError(term, 0.0, step.x, 1e-6), 1e-7);
  if (mu == 0.0) {
    EXPECT_LT(test::asymmetry(test::tangentOf(term, 0.0, step.x)), 1e-14);
  }
}

TEST(MortarContact, TangentAgreesWithDifferencesAndForcesBalance) {
  for (const double mu : {0.0, 0.3}) {
    expectConsistentTangent<2>(mu, 0.1);
    expectConsistentTangent<2>(mu, 1e-4);
  }
  expectConsistentTangent<3>(0.0, 0.05);
  expectConsistentTangent<3>(0.3, 0.05);
}

TEST(MortarContact, FrictionIsBoundedByCoulombsLaw) {
  SlidingStep<2> step(withFriction(0.3), 0.1);
  test::forceOf(step.blocks.term, 0.0, step.x);
  const auto& state = step.blocks.term.state();
  for (Eigen::Index q = 0; q < state.pressure.size(); ++q)
    EXPECT_LE(state.traction.col(q).norm(), 0.3 * std::max(0.0, state.pressure(q)) + 1e-14);
  EXPECT_GT(state.frictionForce, 0.0);
}

TEST(MortarContact, RigidMotionsOfBothBodiesAreNoSlip) {
  SlidingStep<2> step(withFriction(0.3), 0.0, 0.0);
  auto& blocks = step.blocks;
  const Eigen::Rotation2Dd turn(0.4);
  Eigen::VectorXd x = step.accepted;
  const auto n = blocks.numDisplacements / 2;
  for (int a = 0; a < n; ++a) {
    const Eigen::Vector2d X = a < blocks.upper.numNodes
                                  ? blocks.upper.patches.front().points().col(a)
                                  : blocks.lower.patches.front().points().col(a - blocks.upper.numNodes);
    const Eigen::Vector2d place = X + step.accepted.segment<2>(2 * a);
    x.segment<2>(2 * a) = turn * place + Eigen::Vector2d(0.3, -0.2) - X;
  }
  x.tail(blocks.term.numMultipliers()).setZero();
  test::forceOf(blocks.term, 0.0, x);
  EXPECT_LT(blocks.term.state().slip.cwiseAbs().maxCoeff(), 1e-13);
}

}  // namespace
}  // namespace burnish
