#pragma once
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/contact/contact_options.h"
#include "engine/core/enum_names.h"
#include "engine/core/formula.h"
#include "engine/core/schedule.h"
#include "engine/material/material.h"
#include "engine/rezoning/rezoning_options.h"
#include "engine/scene/tool_spec.h"
#include "engine/schema/alternatives.h"
#include "engine/schema/one_or_more.h"
#include "engine/solid/bodies/bodies.h"
#include "engine/solid/formulation.h"
#include "engine/solid/stabilisation_options.h"
#include "engine/solver/solver_options.h"

/// A scene as a value: what a YAML file says, with every default filled in. Lengths, stresses and times are
/// in the consistent units of the scene; vectors have as many entries as the scene has dimensions unless
/// stated otherwise.
namespace burnish::inline scene {

enum class BasisChoice { Nurbs, Lagrange };
enum class KinematicsChoice { PlaneStrain, Axisymmetric };

/// Heights on a face of the undeformed patch, along the outward normal: roughness, waves, by a formula or as measured.
struct ReliefSpec {
  std::string face;
  std::optional<FormulaText> height;  ///< of X, Y, Z on the face as it would be without
  std::string file;                   ///< of a measured profile; not read: places and heights take its place
  std::vector<double> places;         ///< along a measured profile, increasing
  std::vector<double> heights;        ///< one per place
  FormulaText along{"X"};             ///< place in the profile, of X, Y, Z on the face
};

/// A mesh of a box or a rectangle that suits all passes of a tool on a path.
struct ResolutionSpec {
  std::string along;       ///< name of the tool
  double halfWidth = 0.0;  ///< of its contact
  int spansPerWidth = 8;
  double growth = 1.3;  ///< of knot spans, from one to the next

  /// The inner breakpoints, in (0, 1), per direction. Not read: `resolveMeshes` finds them.
  std::vector<std::vector<double>> breaks{};
};

/// How a shape is divided into knot spans.
struct MeshSpec {
  /// Number of basis functions per direction; or `spans`: number of knot spans. Exactly one of the two for
  /// the named shapes, neither for a control net.
  std::vector<int> functions;
  std::vector<int> spans;
  std::vector<int> refine;           ///< parts of every knot span of a control net, per direction
  std::vector<FormulaText> grading;  ///< breakpoint of s in [0, 1], per direction; growing from 0 to 1
  /// Per direction the breakpoints, in [0, 1], across which the basis is continuous only.
  std::vector<std::vector<double>> creases;
  std::vector<ReliefSpec> relief;            ///< one after the other
  std::optional<ResolutionSpec> resolution;  ///< instead of functions, spans and grading
};

/// One of several patches.
struct PatchSpec {
  std::string name;
  BodyShape shape;
  MeshSpec mesh;
};

/// Patches that share the control points of the faces at which they meet.
struct PatchesSpec {
  static constexpr PartKind kind{"patches",
                                 "Several patches, joined at common faces; each has its own mesh."};

  std::vector<PatchSpec> patches;
};

struct GeometrySpec {
  Extended<BodyShape, PatchesSpec> shape;
  MeshSpec mesh;  ///< unused with several patches, which have their own
};

/// Components of a Cauchy stress as formulas in X, Y, Z; those left out are zero.
struct InitialStressSpec {
  std::optional<FormulaText> xx, yy, zz, xy, yz, zx;
};

/// What a body has been through before the run.
struct InitialSpec {
  std::optional<InitialStressSpec> stress;   ///< comes into equilibrium before the first step
  std::optional<FormulaText> plasticStrain;  ///< equivalent one, formula in X, Y, Z
};

/// What is a body's own.
struct BodySpec {
  std::string name;  ///< empty for the one body of a scene without `bodies`
  BasisChoice basis = BasisChoice::Nurbs;
  int degree = 2;  ///< control nets of lower degree are raised to it
  Formulation formulation = Formulation::Displacement;
  std::optional<int> quadraturePoints;  ///< per span and direction; degree + 1 when left out
  GeometrySpec geometry;
  MaterialParameters material;
  std::optional<InitialSpec> initial;
};

/// A face of a patch, or a part of it.
struct FaceSpec {
  std::string body{};            ///< name; may be left out in a scene of one body
  std::string patch{};           ///< name; may be left out for a body of one patch
  std::string face{};            ///< left, right, bottom, top, back, front
  std::vector<double> part{};    ///< begin and end in [0, 1] per direction of the face; all of it when empty
  std::vector<double> length{};  ///< instead of `part`: begin and end along the undeformed face (2D)
};

/// Displacement components as formulas.
struct PrescribedSpec {
  std::optional<FormulaText> x, y, z;
};

/// Exactly one of `fix`, `move`, `prescribe`, `symmetry`.
struct SupportSpec {
  std::string name;  ///< see `supportNames`
  FaceSpec place;
  std::vector<std::string> fix;             ///< components held: x, y, z
  std::optional<MotionSpec> move;           ///< prescribed components; those left out are free
  std::optional<PrescribedSpec> prescribe;  ///< components that follow formulas; those left out are free
  bool symmetry = false;  ///< holds the component normal to a face that is flat and aligned with an axis
  std::optional<double> until;       ///< lets go then; its force goes linearly to zero by
  std::optional<double> releasedBy;  ///< this time; by the end of the run when left out
};

/// Exactly one of `traction`, `pressure`, `shear`, each on a face, and `bodyForce`; scaled by the schedule (1
/// when left out).
struct LoadSpec {
  FaceSpec place;                       ///< for a body force at most the body and its patch
  std::vector<FormulaText> traction;    ///< dead: force per reference area
  std::optional<FormulaText> pressure;  ///< follows the face: force per current area against its normal
  std::optional<FormulaText> shear;     ///< follows the face: force per current area along it (2D)
  std::vector<FormulaText> bodyForce;   ///< dead: force per reference volume
  std::optional<Schedule> schedule;
};

/// What is done about faces that overlap at the start.
enum class Interference { Error, Resolve };

constexpr auto enumNames(std::type_identity<Interference>) {
  return std::array{std::pair{"error", Interference::Error}, std::pair{"resolve", Interference::Resolve}};
}

/// Contact of a face with either a tool or another face.
struct ContactSpec {
  std::string name;  ///< of a pair of faces; see `pairName`
  std::string tool;
  FaceSpec place;               ///< a whole face: that with the quadrature and the multipliers
  OneOrMore<FaceSpec> against;  ///< instead of `tool`: whole faces, of other bodies or of the same
  std::optional<double> reach;  ///< of a pair of faces: distance within which they see each other
  Interference interference = Interference::Error;  ///< of a pair of faces
  bool segments = false;  ///< of a pair of faces in the plane: quadrature knows the master's knots
  ContactOptions options{.method = Enforcement::IntegralAugmentedLagrangian};
};

/// Name of a pair of faces in results: its own, or those of its two bodies (faces, if these have none).
std::string pairName(const ContactSpec& pair);

/// Path of one of the faces that a pair's face may touch; path: of the pair.
std::string againstKey(const ContactSpec& pair, const std::string& path, std::size_t number);

/// Contact of one face with itself, or of several faces of a body, which are one surface, with themselves and
/// one another.
struct SelfContactSpec {
  FaceSpec place;                  ///< a whole face, or
  std::vector<std::string> faces;  ///< whole faces of that body and patch
  std::optional<double> reach;     ///< distance within which parts are partners
  ContactOptions options;          ///< method is the default

  /// The face, or all of the faces.
  std::vector<FaceSpec> places() const;
};

/// A phase of the run: `count` equal nominal steps from the end of the previous phase (or 0) to `until`.
struct PhaseSpec {
  double until = 0.0;
  int count = 0;
};

struct OutputSpec {
  std::vector<double> times;    ///< times at which a frame is written, beside the start and the end
  std::optional<double> every;  ///< a frame every so much time
  int subdivision = 4;          ///< cells per knot span and direction in VTU files and pictures
  bool vtu = true;
  int pieces = 1;          ///< VTU files of each body and frame
  bool reactions = false;  ///< columns of the history for the forces on supports
};

/// Displacement and projected fields at a material point: columns NAME.ux, NAME.stress_xx, ...
struct PointMeasureSpec {
  std::string body;
  std::string patch;
  std::vector<double> parameters;  ///< in [0, 1] per direction; or
  std::vector<double> position;    ///< reference coordinates
  std::vector<std::string> fields;
};

/// Mean displacement of a face, by reference area, and the force that the body is held or loaded with there:
/// columns NAME.ux, NAME.fx, ...
struct FaceMeasureSpec {
  FaceSpec place;
};

/// Relative errors against an exact displacement: columns NAME.L2, NAME.H1 (of the gradient).
struct ErrorMeasureSpec {
  std::string body;
  std::vector<FormulaText> displacement;
};

/// The ellipse p^2 = p_0^2 (1 - (s/a)^2) that fits the contact pressure best, s the distance from its
/// middle: columns NAME.peak, NAME.half_width, NAME.middle, NAME.deviation (largest, over the peak).
struct EllipseMeasureSpec {
  enum class Middle { Free, Begin, End } middle = Middle::Free;  ///< begin or end of the face, by symmetry
  std::string tool;
  FaceSpec place;
};

/// How far a face reaches: columns NAME.xmin, NAME.xmax, ...
struct ExtentMeasureSpec {
  FaceSpec place;
};

/// The value below which a field is in a share of the body's volume: column NAME.value.
struct PercentileMeasureSpec {
  std::string body;
  std::string field;
  double share = 0.999;
};

/// Columns of the history beside those that every run has.
struct SceneMeasureSpec {
  std::string name;
  std::variant<PointMeasureSpec, FaceMeasureSpec, ErrorMeasureSpec, EllipseMeasureSpec, ExtentMeasureSpec,
               PercentileMeasureSpec>
      kind;
};

struct UnitsSpec {
  std::string length, stress;  ///< labels only; empty: no unit is shown
};

/// A formula in columns of the history, and the key that it stands at.
struct WantedQuantity {
  std::string path;
  std::string formula;
};

/// What the document around a scene wants of its run, such as by pictures and checks. No keys of the scene.
struct Wanted {
  std::vector<double> frames;              ///< times at which a frame is written, beside those of the output
  std::vector<WantedQuantity> quantities;  ///< what they name must be columns of the history
  bool onlyWarns =
      false;  ///< of quantities that the history lacks: changed copies of the scene may have them
};

struct ScenePlaces;

struct Scene {
  std::string title;
  UnitsSpec units;
  KinematicsChoice kinematics = KinematicsChoice::PlaneStrain;  ///< of bodies of two dimensions
  std::vector<DefinitionSpec> definitions;

  /// The body of a scene without `bodies`; else what these take for basis, degree, formulation and quadrature
  /// points that they do not have.
  BodySpec body;
  std::vector<BodySpec> bodies;
  std::vector<SupportSpec> supports;
  std::vector<LoadSpec> loads;
  std::vector<ToolSpec> tools;
  std::vector<ContactSpec> contact;
  std::vector<SelfContactSpec> selfContact;
  std::vector<PhaseSpec> steps;
  SolverOptions solver;
  std::optional<RezoningOptions> rezoning;
  std::optional<StabilisationOptions> stabilise;
  OutputSpec output;
  std::vector<SceneMeasureSpec> measures;

  Wanted wanted;
  std::string source;  ///< file the scene was read from, for messages
  std::string
      resolvedYaml;  ///< the whole scene with every default, as YAML that reads back to the same scene
  std::shared_ptr<const ScenePlaces> places;  ///< of the keys in the source; none for a scene made in code

  /// 2 or 3, from the geometry of the first body.
  int dim() const;

  /// All bodies, those of `bodies` or the one without a name.
  std::span<const BodySpec> allBodies() const;

  /// Place of a body in the list of all by its name; the first one for an empty or unknown name.
  std::size_t bodyNumber(const std::string& name) const;

  /// Number of the body that is meshed anew, in a scene with rezoning.
  std::size_t rezonedBody() const { return bodyNumber(rezoning->body); }

  /// Path of a key of a body: "geometry", or "bodies[1].geometry".
  std::string bodyKey(std::size_t body, const std::string& key) const;
};

}  // namespace burnish::inline scene
