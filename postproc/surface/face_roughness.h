#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/core/input_error.h"
#include "engine/results/result.h"
#include "engine/schema/leaf.h"
#include "postproc/surface/roughness.h"

namespace burnish {

/// Of which face the roughness is wanted, as options spell it. Empty texts: not given.
struct RoughnessSpec {
  std::string face, patch;
  std::vector<std::string> bodies;  ///< the one of the face, where there are several
  std::string within;               ///< X0,Y0:X1,Y1: material that was in this box of the undeformed body
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
      "cutoff", s.cutoff, {.above = 0, .unit = "length"},
      "Wavelength above which waves are form and not roughness (Gaussian filter), of plane bodies; without it "
      "all but the least-squares line counts.");
}

/// The face of a plane body in a frame: its profile along its chord, levelled and, with a cut-off, filtered, and the
/// numbers of it.
struct FaceProfile {
  Profile profile;
  ProfileRoughness roughness;
};

/// Throws `Error` that begins with a key of the spec for a face or box that the body does not have, or a cut-off that is
/// too long; and for a body in space.
FaceProfile faceProfile(const ModelRecord& model, const FrameRecord& frame, const RoughnessSpec& spec);

/// The face of a body in space, and where its points are.
struct FaceArea {
  AreaRoughness roughness;
  Eigen::Matrix3Xd places;  ///< 3 x points, as many as heights
};

/// Throws `Error` as above, for a plane body and for a cut-off.
FaceArea faceArea(const ModelRecord& model, const FrameRecord& frame, const RoughnessSpec& spec);

}  // namespace burnish
