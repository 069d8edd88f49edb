#pragma once
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/core/schedule.h"

/// A scene as a value: what a YAML file says, with every default filled in. Lengths, stresses and times are
/// in the consistent units of the scene; vectors have as many entries as the scene has dimensions unless
/// stated otherwise.
namespace burnish {

enum class BasisChoice { Nurbs, Lagrange };

struct RectangleSpec {
  std::vector<double> origin{0.0, 0.0};  ///< lower left corner
  std::vector<double> size;              ///< width and height, > 0
};

/// Part of a ring: first parameter along the radius (inner to outer), second along the angle.
struct AnnulusSpec {
  std::vector<double> center{0.0, 0.0};
  double innerRadius = 0.0;
  double outerRadius = 0.0;
  double startAngle = 0.0;     ///< degrees
  double openingAngle = 90.0;  ///< degrees, (0, 180)
};

struct BoxSpec {
  std::vector<double> origin{0.0, 0.0, 0.0};
  std::vector<double> size;
};

/// Control points, weights and knot vectors given in the scene; a NURBS body. `degrees`, `knots` one entry
/// per direction; points with the first direction fastest; weights may be left out (all 1).
struct ControlNetSpec {
  std::vector<int> degrees;
  std::vector<std::vector<double>> knots;
  std::vector<std::vector<double>> points;
  std::vector<double> weights;
};

struct GeometrySpec {
  std::variant<RectangleSpec, AnnulusSpec, BoxSpec, ControlNetSpec> shape;
  /// Number of basis functions per direction; or `spans`: number of knot spans. Exactly one of the two for
  /// the named shapes; a control net is taken as it is.
  std::vector<int> functions;
  std::vector<int> spans;
};

struct NeoHookeanSpec {
  double E = 0.0;   ///< Young's modulus, > 0
  double nu = 0.0;  ///< Poisson's ratio, (-1, 0.5)
  enum class Volumetric { Log, Simo } volumetric = Volumetric::Log;
};

struct VoceSpec {
  double sigma0 = 0.0, sigmaInf = 0.0, beta = 0.0;
};
struct TwoTermVoceSpec {
  double sigma0 = 0.0, q1 = 0.0, beta1 = 0.0, q2 = 0.0, beta2 = 0.0;
};
struct LinearHardeningSpec {
  double sigma0 = 0.0, modulus = 0.0;
};
struct VoceLinearSpec {
  double sigma0 = 0.0, sigmaInf = 0.0, beta = 0.0, modulus = 0.0;
};
struct TableHardeningSpec {
  std::vector<double> ep;      ///< starts at 0, strictly increasing
  std::vector<double> stress;  ///< > 0; constant beyond the last entry
};
struct FormulaHardeningSpec {
  std::string formula;  ///< yield stress as a function of `ep`
};
using HardeningSpec = std::variant<VoceSpec, TwoTermVoceSpec, LinearHardeningSpec, VoceLinearSpec,
                                   TableHardeningSpec, FormulaHardeningSpec>;

struct J2Spec {
  double E = 0.0;
  double nu = 0.0;
  enum class Elastic { NeoHookean, Hencky } elastic = Elastic::NeoHookean;
  HardeningSpec hardening;
};

using MaterialSpec = std::variant<NeoHookeanSpec, J2Spec>;

/// Displacement components as piecewise linear functions of time, constant before the first and after the
/// last time.
struct MotionSpec {
  std::vector<double> times;                   ///< strictly increasing
  std::optional<std::vector<double>> x, y, z;  ///< one value per time; at least one component is given
};

/// Exactly one of `fix`, `move`, `symmetry`.
struct SupportSpec {
  std::string face;                ///< left, right, bottom, top, back, front
  std::vector<std::string> fix;    ///< components held: x, y, z
  std::optional<MotionSpec> move;  ///< prescribed components; those left out are free
  bool symmetry = false;  ///< holds the component normal to a face that is flat and aligned with an axis
};

/// Dead traction: force per reference area, constant in direction, scaled by the schedule (1 when left out).
struct LoadSpec {
  std::string face;
  std::vector<double> traction;
  std::optional<Schedule> schedule;
};

struct PlaneToolSpec {
  std::vector<double> origin;
  std::vector<double> normal;  ///< points away from the tool, towards the body
};
struct CylinderToolSpec {
  std::vector<double> center;
  double radius = 0.0;
  std::vector<double> axis{0.0, 0.0, 1.0};  ///< 3D only
};
struct SphereToolSpec {
  std::vector<double> center;
  double radius = 0.0;
};

struct ToolSpec {
  std::string name;
  std::variant<PlaneToolSpec, CylinderToolSpec, SphereToolSpec> shape;
  std::optional<MotionSpec> motion;  ///< at rest when left out, and so is a component that is left out
};

enum class ContactMethod { AugmentedLagrangian, Penalty, PointwisePenalty };

struct ContactSpec {
  std::string tool;
  std::string face;
  ContactMethod method = ContactMethod::AugmentedLagrangian;
  std::optional<double> parameter;      ///< ε, stress per length; derived from the body when left out
  std::optional<int> quadraturePoints;  ///< per span and direction; 2p when left out
};

/// A phase of the run: `count` equal nominal steps from the end of the previous phase (or 0) to `until`.
struct PhaseSpec {
  double until = 0.0;
  int count = 0;
};

struct SolverSpec {
  double tolerance = 1e-9;  ///< relative residual
  int maxIterations = 25;   ///< per step, then the step is cut
  int maxCuts = 12;         ///< smallest step: nominal step / 2^maxCuts
};

struct OutputSpec {
  std::vector<double> times;    ///< times at which a frame is written, beside the start and the end
  std::optional<double> every;  ///< a frame every so much time
  int subdivision = 4;          ///< cells per knot span and direction in VTU files and pictures
  bool vtu = true;
};

struct PictureSpec {
  std::string field;
  std::optional<std::string> name;  ///< file name stem; the field's name when left out
  std::vector<double> times;        ///< one picture for each; the last frame when empty
  std::optional<std::array<double, 2>> range;
  std::array<int, 2> size{1600, 900};
  int bands = 0;           ///< number of colour bands; 0: smooth
  bool knots = false;      ///< draw knot lines
  bool undeformed = true;  ///< draw the outline of the undeformed body
};

struct UnitsSpec {
  std::string length, stress;  ///< labels only; empty: no unit is shown
};

struct Scene {
  std::string title;
  UnitsSpec units;
  BasisChoice basis = BasisChoice::Nurbs;
  int degree = 2;  ///< of a named shape; the highest of its degrees for a control net
  GeometrySpec geometry;
  MaterialSpec material;
  std::vector<SupportSpec> supports;
  std::vector<LoadSpec> loads;
  std::vector<ToolSpec> tools;
  std::vector<ContactSpec> contact;
  std::vector<PhaseSpec> steps;
  SolverSpec solver;
  OutputSpec output;
  std::vector<PictureSpec> pictures;

  std::string source;  ///< file the scene was read from, for messages
  std::string
      resolvedYaml;  ///< the whole scene with every default, as YAML that reads back to the same scene

  /// 2 (plane strain) or 3, from the geometry.
  int dim() const;
};

}  // namespace burnish
