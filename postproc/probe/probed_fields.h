#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "postproc/draw/contour/field_choice.h"

namespace burnish {

/// Scalars of a frame that a probe asks for, each by a name of `fieldNames`.
class ProbedFields {
 public:
  /// Throws `Error` for names that the frame does not have, and for contact fields, which no place inside a
  /// body has.
  ProbedFields(const ModelRecord& model, const FrameRecord& frame, const std::vector<std::string>& names);

  const std::vector<FieldChoice>& choices() const { return choices_; }

  /// One value per field in a body: Σ R_a q_a over these nodes, not bounded as pictures bound it; `kNone` of
  /// fields that the body does not have.
  Eigen::VectorXd values(int body, const std::vector<int>& nodes, const Eigen::VectorXd& R) const;

 private:
  std::vector<FieldChoice> choices_;
  std::vector<std::vector<bool>> has_;  ///< per field and number of the body; empty: all have it
};

}  // namespace burnish
