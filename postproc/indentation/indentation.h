#pragma once
#include <array>
#include <optional>
#include <string>

#include "engine/results/result_reader.h"
#include "engine/schema/leaf.h"
#include "postproc/indentation/oliver_pharr.h"

namespace burnish {

/// How an indentation is evaluated, as options spell it.
struct IndentationSpec {
  std::string tool;          ///< empty: the only one
  std::optional<double> nu;  ///< of the body; that of the scene when left out
  std::array<double, 2> fit{0.4, 0.98};
  double epsilon = 0.75;
  std::optional<double> beta;
};

template <class Visitor>
void describe(Visitor& v, IndentationSpec& s) {
  v.field("tool", s.tool, {}, "The indenter, of several tools.");
  v.field("nu", s.nu, {.above = -1, .below = 0.5}, "Poisson's ratio of the body, instead of the scene's.");
  v.field("fit", s.fit, {.above = 0, .atMost = 1, .increasing = true},
          "Parts of the largest force between which the unloading is fitted.");
  v.field("epsilon", s.epsilon, {.above = 0, .atMost = 1},
          "How far the surface sinks in beside the contact: 0.75 of a paraboloid, 0.7268 of a cone.");
  v.field("beta", s.beta, {.above = 0},
          "Factor of the stiffness: 1 of a sphere, Hay's of a cone when left out, by its angle and nu.");
}

/// An indentation of a body of revolution by a rigid sphere or cone along its axis.
struct Indentation {
  Indenter indenter;
  IndentationCurve curve;   ///< of the whole run, from the highest point of the undeformed body
  std::size_t largest = 0;  ///< row of the largest force
  OliverPharr found;
  double nu = 0.0, beta = 1.0;
  double modulus = 0.0;  ///< Young's, of the rigid indenter: (1 - nu²) E*
  std::optional<double> sceneModulus;

  /// The circle that was in contact at the largest force, if a frame was kept then and the method of contact has pressures
  /// point by point: its area, how much one and a half distances of these points leave open, and what follows with it.
  struct Computed {
    double area, uncertainty, modulus, hardness;
  };
  std::optional<Computed> computed;
  std::string noArea;  ///< why it is not known

  std::string shortUnloading;  ///< what is missing of it for the fit; mostly empty
};

/// Throws `Error` that begins with an option for a run that is none: a body that is not of revolution, a tool that is no
/// sphere or cone on the axis, no unloading.
Indentation indentationOf(const ResultReader& result, const IndentationSpec& spec);

}  // namespace burnish
