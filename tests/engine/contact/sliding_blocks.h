#pragma once
#include <algorithm>
#include <memory>

#include "engine/contact/face_partner.h"
#include "engine/contact/partner_contact.h"
#include "tests/engine/contact/surface_samples.h"
#include "tests/engine/solid/term_check.h"

namespace burnish::test {

/// A block whose bottom is the slave over one whose top is the master, numbered together; multipliers follow.
template <int Dim>
struct Blocks {
  Body<Dim> upper, lower;
  int numDisplacements;
  std::unique_ptr<FaceContact<Dim>> term;

  Blocks(const Patch<Dim>& above, const Patch<Dim>& below, const ContactOptions& options, bool axisymmetric,
         const PartnerRules& rules = {.reach = 0.5})
      : upper(bodyOf(above, 0, axisymmetric)),
        lower(bodyOf(below, upper.numNodes, axisymmetric)),
        numDisplacements(Dim * (upper.numNodes + lower.numNodes)),
        term(makePartnerContact<Dim>(upper, 0, kBottom,
                                     [&](const FaceQuadrature<Dim>& slave) {
                                       return std::make_unique<FacePartner<Dim>>(
                                           slave, tracePatch(above, kBottom), outwardSign(above, kBottom),
                                           MasterSurface<Dim>(lower, {{0, kTop}}), rules);
                                     },
                                     options, numDisplacements,
                                     std::vector<bool>(static_cast<std::size_t>(numDisplacements), false),
                                     {})) {}

  int numUnknowns() const { return numDisplacements + term->numMultipliers(); }

  /// Current places of all nodes, Dim x nodes.
  Eigen::MatrixXd places(const Eigen::VectorXd& x) const {
    const auto n = numDisplacements / Dim;
    Eigen::MatrixXd result = upper.nodePositions();
    result.conservativeResize(Dim, n);
    for (int a = 0; a < lower.numNodes; ++a)
      result.col(upper.numNodes + a) = lower.patches.front().points().col(a);
    return result + x.head(numDisplacements).reshaped(Dim, n);
  }

  /// Components of the sums of forces and moments over all nodes, over the sum of magnitudes.
  double imbalance(const Eigen::VectorXd& x, const Eigen::VectorXd& force) const {
    const Eigen::MatrixXd at = places(x);
    const Eigen::MatrixXd forces = force.head(numDisplacements).reshaped(Dim, at.cols());
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    for (Eigen::Index a = 0; a < at.cols(); ++a) {
      Eigen::Vector3d r = Eigen::Vector3d::Zero(), f = r;
      r.head<Dim>() = at.col(a);
      f.head<Dim>() = forces.col(a);
      moment += r.cross(f);
    }
    return std::max(forces.rowwise().sum().norm(), moment.norm()) / forces.colwise().norm().sum();
  }

 private:
  static Body<Dim> bodyOf(const Patch<Dim>& patch, int firstNode, bool axisymmetric) {
    Body<Dim> body = makeBody(patch);
    body.axisymmetric = axisymmetric;
    for (int& node : body.nodes.front()) node += firstNode;
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

  SlidingStep(const ContactOptions& options, double way, double tau = 0.02, bool axisymmetric = false,
              double down = 0.02, bool segments = false)
      : blocks(lifted<Dim>(wavy<Dim>(BasisFamily::BSpline, 2, 2, 0.05, 3), 0.07, 1.0),
               wavy<Dim>(BasisFamily::BSpline, 2, 3, 0.05, 4), options, axisymmetric,
               {.reach = 0.5, .segments = segments}) {
    accepted = randomState(blocks.numUnknowns(), 2e-3, 5);
    forceOf(*blocks.term, 0.0, accepted);
    blocks.term->accept();
    x = accepted + randomState(blocks.numUnknowns(), 2e-3, 6);
    for (int node = 0; node < blocks.upper.numNodes; ++node) {
      x(Dim * node) += way;
      x(Dim * node + 1) -= down;
    }
    const auto n = blocks.term->numMultipliers();
    x.tail(n) = tau * randomState(n, 1.0, 7);
  }
};

}  // namespace burnish::test
