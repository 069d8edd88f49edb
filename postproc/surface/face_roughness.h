#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/input_error.h"
#include "engine/results/result.h"
#include "engine/schema/leaf.h"
#include "postproc/mesh/model_frame.h"
#include "postproc/surface/roughness.h"

namespace burnish {

/// Of which face the roughness is wanted, as options spell it. Empty texts: not given.
struct RoughnessSpec {
  std::string face, patch;
  std::vector<std::string> bodies;  ///< the one of the face, where there are several
  std::string within;               ///< X0,Y0:X1,Y1: material that was in this box of the undeformed body
  std::string
      line;  ///< X0,Y0,Z0:X1,Y1,Z1: way of a stylus over a face in space, of which there is a profile then
  std::optional<double> cutoff;
};

template <class Visitor>
void describe(Visitor& v, RoughnessSpec& s) {
  v.field("face", s.face, {.required = true}, "Face: left, right, bottom, top, and in space back or front.");
  v.field("patch", s.patch, {}, "Patch of the face, in a body of several.");
  v.field("body", s.bodies, {}, "The body of the face, of several.");
  v.field("within", s.within, {},
          "X0,Y0:X1,Y1, in space with Z: only what lay in this box of the undeformed body, so that the same "
          "material is looked at before and after.");
  v.field(
      "line", s.line, {},
      "X0,Y0,Z0:X1,Y1,Z1: the way of a stylus over a face in space, whose profile is looked at instead of the area.");
  v.field(
      "cutoff", s.cutoff, {.above = 0, .unit = "length"},
      "Wavelength above which waves are form and not roughness (Gaussian filter), of profiles; without it all but the "
      "least-squares line counts.");
}

/// Whether there is a profile of the face, and no area.
inline bool hasProfile(const ModelRecord& model, const RoughnessSpec& spec) {
  return model.dim == 2 || !spec.line.empty();
}

/// What keys say that cannot be together, by the key.
std::vector<InputProblem> conflictsIn(const RoughnessSpec& spec);

/// The same, and what is no two points, neither of a plane nor in space: all that can be told without a body.
std::vector<InputProblem> mistakesIn(const RoughnessSpec& spec);

/// The face of a plane body in a frame, along its chord, or one in space along a line: its profile, levelled and, with a
/// cut-off, filtered, and the numbers of it.
struct FaceProfile {
  Profile profile;
  ProfileRoughness roughness;
};

/// A height in space is that over the line along the mean of the normals of the face at its ends. Throws `Error` that begins with a key of the
/// spec for a face or box that the body does not have, a line that leaves the face, or a cut-off that is too long; and for
/// a body in space without a line and a plane one with it.
FaceProfile faceProfile(const ModelRecord& model, const FrameRecord& frame, const RoughnessSpec& spec);

/// The face of a body in space, and where its points are.
struct FaceArea {
  AreaRoughness roughness;
  Eigen::Matrix3Xd places;                        ///< 3 x points, as many as heights
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();  ///< mean normal, out of the material
  std::array<int, 2>
      grid{};  ///< points along the parameters of the face, first fastest; 0 where `within` leaves no grid
};

/// Throws `Error` as above, for a plane body and for a cut-off.
FaceArea faceArea(const ModelRecord& model, const FrameRecord& frame, const RoughnessSpec& spec);

/// The heights of an area as seen from outside, as a plane body that has them as the field `kHeightField`: its first
/// direction to the right. Throws `Error` that begins with `within` for an area without a grid.
inline constexpr const char* kHeightField = "surface_height";
ModelFrame heightMap(const ModelRecord& model, const FrameRecord& frame, const FaceArea& area);

}  // namespace burnish
