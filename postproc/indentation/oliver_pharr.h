#pragma once
#include <variant>
#include <vector>

/// Modulus and hardness from the unloading of an indentation, by W. C. Oliver and G. M. Pharr (1992).
namespace burnish {

struct SphereIndenter {
  double radius = 0.0;
};

/// A cone whose tip is rounded.
struct ConeIndenter {
  double halfAngle = 0.0;  ///< between axis and flank, in radians
  double radius = 0.0;     ///< of the tip; 0: sharp
};

using Indenter = std::variant<SphereIndenter, ConeIndenter>;

/// Area of the section at this distance from the tip. A cone is a sphere up to ρ (1 - sin α) and
/// π tan² α (h + ρ (1/sin α - 1))² above.
double sectionArea(const Indenter& indenter, double depth);

/// The factor β of the stiffness that is used unless another one is given: 1 of a sphere; of a cone, whose surface moves
/// inwards where Sneddon's solution does not see it, π (π/4 + 0.15483073 k)/(π/2 - 0.83119312 k)² with
/// k = cot α (1 - 2ν)/(4 (1 - ν)): J. L. Hay, A. Bolshakov, G. M. Pharr (1999).
double usualBeta(const Indenter& indenter, double nu);

/// Depths from the undeformed surface and forces.
struct IndentationCurve {
  std::vector<double> depths, forces;
};

struct OliverPharrOptions {
  double from = 0.4, to = 0.98;  ///< the part of the largest force between which the unloading is fitted
  double epsilon = 0.75;         ///< 0.75 of a paraboloid, 2 (1 - 2/π) of a cone
  double beta = 1.0;
};

/// What the unloading says. E* of the pair: 1/E* = (1 - ν²)/E + (1 - νi²)/Ei.
struct OliverPharr {
  double force = 0.0, depth = 0.0;                        ///< the largest
  double factor = 0.0, exponent = 0.0, finalDepth = 0.0;  ///< P = B (h - h_f)^m
  double stiffness = 0.0;                                 ///< S = dP/dh at the largest depth
  double contactDepth = 0.0;                              ///< h_c = h - ε P/S
  double area = 0.0;                                      ///< of the indenter at h_c
  double modulus = 0.0;                                   ///< E* = √π/(2β) S/√A
  double hardness = 0.0;                                  ///< P/A
  double misfit = 0.0;                                    ///< root mean square, over the largest force
  int numPoints = 0;                                      ///< of the fit
};

/// unloading: from the largest force on. Throws `Error` if fewer than four points lie in the part that is fitted, or no
/// power law fits them.
OliverPharr oliverPharr(const IndentationCurve& unloading, const Indenter& indenter,
                        const OliverPharrOptions& options);

/// The same with another contact area.
struct ModulusAndHardness {
  double modulus = 0.0, hardness = 0.0;
};
ModulusAndHardness withArea(const OliverPharr& found, double area, double beta);

}  // namespace burnish
