#pragma once
#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

#include "postproc/draw/contour/field_choice.h"

namespace burnish {

/// The axes of a surface as columns: out of the body, along the face in its (in space first) direction, and across both to the
/// side of its second direction, in the plane out of it.
using SurfaceAxes = Eigen::Matrix3d;

/// Cauchy stress in the axes of a surface: stress.along, stress.across and stress.normal, and the shear stresses on planes
/// parallel to the face, stress.shear_along and stress.shear_across: what the traction on the face, with its normal out of the
/// body, has in these directions. Paths from a face and along one have such axes.
std::vector<std::string> surfaceFieldNames();
bool isSurfaceField(const std::string& name);

/// Scalars of a frame that a probe asks for, each by a name of `fieldNames` or of `surfaceFieldNames`.
class ProbedFields {
 public:
  /// Throws `Error` for names that the frame does not have, and for contact fields, which no place inside a
  /// body has.
  ProbedFields(const ModelRecord& model, const FrameRecord& frame, const std::vector<std::string>& names);

  const std::vector<FieldChoice>& choices() const { return choices_; }

  /// Whether one of them is told in the axes of a surface.
  bool needsAxes() const;

  /// One value per field in a body: Σ R_a q_a over these nodes, not bounded as pictures bound it; `kNone` of
  /// fields that the body does not have, and of stresses in the axes of a surface without these.
  Eigen::VectorXd values(int body, const std::vector<int>& nodes, const Eigen::VectorXd& R,
                         const std::optional<SurfaceAxes>& axes) const;

 private:
  /// σ(row, column) in the axes of a surface.
  struct InAxes {
    int row = 0, column = 0;
    std::vector<std::string> components;  ///< that the coefficients have: xx, ...
  };

  std::vector<FieldChoice> choices_;
  std::vector<std::optional<InAxes>> inAxes_;  ///< per field; nothing for those by a name of `fieldNames`
  std::vector<std::vector<bool>> has_;         ///< per field and number of the body; empty: all have it
};

}  // namespace burnish
