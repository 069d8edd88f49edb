#pragma once
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "engine/results/result.h"
#include "postproc/draw/page/rich_text.h"

namespace burnish {

/// Names of everything that can be drawn of a frame: `displacement`, `displacement.x`, …, then the frame's
/// fields; a vector alone stands for its magnitude, a tensor only has components; then its contact fields.
std::vector<std::string> fieldNames(const FrameRecord& frame);

/// What one most probably wants to see: plastic strain where there is any law for it, else the von Mises
/// stress.
std::string fieldToShow(const FrameRecord& frame);

/// A scalar that is to be drawn.
struct FieldChoice {
  std::string name;              ///< by which it was chosen
  RichText title;                ///< readable name with symbol, without unit
  std::string unit;              ///< may be empty
  Eigen::MatrixXd coefficients;  ///< one row, or the components of a vector whose magnitude is meant; of a
                                 ///< contact field none
  bool isNonNegative = false;    ///< in truth; a projection may fall below 0
  bool isAboutZero = false;      ///< its sign means something: tension and compression
  std::vector<std::string> states{};             ///< what the values 0, 1, … mean; empty for quantities
  vtkSmartPointer<vtkPolyData> faces = nullptr;  ///< of a contact field: `contactFieldFaces`

  std::string words{};  ///< the title without its symbol, the component behind it: "Cauchy stress xx"

  /// The scalars of values (components x points): a scalar itself, or the magnitude of a vector.
  Eigen::VectorXd scalars(const Eigen::MatrixXd& values) const;

  /// Those that are drawn: not below 0 if they cannot be.
  Eigen::VectorXd drawnScalars(const Eigen::MatrixXd& values) const;
};

/// The largest magnitude of the coefficients, which that of the field does not exceed; 0 of a field of contact.
double magnitudeOf(const FieldChoice& field);

/// Makes a field zero that is rounding beside a magnitude that it has elsewhere: its noise would fill a scale.
void dropRounding(FieldChoice& field, double magnitude);

/// Below this share of the largest magnitude of a field in a run values are rounding.
inline constexpr double kRounding = 1e-12;

/// A field as pictures call it, without values. component: empty for a scalar, or for the magnitude of a vector.
FieldChoice fieldInWords(const std::string& name, const std::string& component, bool isMagnitude,
                         const std::string& unit);

/// The field of a name of `fieldNames`. Throws `Error` that begins with the key that has the name, lists them and tells
/// the nearest.
FieldChoice chooseField(const ModelRecord& model, const FrameRecord& frame, const std::string& name,
                        const char* key = "field");

}  // namespace burnish
