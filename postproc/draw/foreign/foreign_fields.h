#pragma once
#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

#include "postproc/draw/contour/field_choice.h"
#include "postproc/foreign/foreign_source.h"

namespace burnish {

/// An array of numbers that one or several blocks have at their points, or in their cells.
struct ForeignField {
  std::string array;  ///< its name in the file
  std::string
      name;  ///< without unit, commas and what no line shows; `cells.NAME` or `points.NAME_2` if it is taken
  std::string unit;
  bool ofCells = false;
  std::vector<std::string> components;  ///< x, xx, 0, ...; none of a scalar

  /// Whether its length is meant by its name alone.
  bool isVector() const { return (components.size() == 2 || components.size() == 3) && !isTensor(); }
  /// Whether its components are called xx, yy, ...
  bool isTensor() const;
};

/// All fields, those of points first.
std::vector<ForeignField> foreignFieldsOf(const std::vector<ForeignBlock>& blocks);

/// All names by which these can be chosen.
std::vector<std::string> foreignFieldNames(const std::vector<ForeignField>& fields);

/// A field of which one component, or the length of a vector, is drawn.
struct ForeignChoice {
  ForeignField field;
  int component = -1;  ///< negative: a scalar itself, or the length

  /// Values at the points or in the cells of a block; empty if it does not have the field.
  Eigen::VectorXd valuesOf(const ForeignBlock& block) const;

  /// The same as one row or, of a length, the components of the vector, of which between points the value is the length.
  Eigen::MatrixXd partsOf(const ForeignBlock& block) const;

  /// What a mirror across an axis makes of a value: 1 or -1.
  double signInMirror(int axis) const;
};

/// The field of a name: NAME, NAME.x, NAME.xx, NAME.0; nothing if there is none.
std::optional<ForeignChoice> findForeignField(const std::vector<ForeignField>& fields,
                                              const std::string& name);

/// The same. Throws `Error` that lists them and tells the nearest. where:
/// what has these fields.
ForeignChoice chooseForeignField(const std::vector<ForeignField>& fields, const std::string& name,
                                 const std::string& where = "the file");

/// The choice as pictures and charts call it, without values.
FieldChoice wordsOf(const ForeignChoice& choice);

/// The blocks of these names; all where none is given. Throws `Error` that lists them and tells the nearest.
std::vector<ForeignBlock> chosenBlocks(std::vector<ForeignBlock> blocks,
                                       const std::vector<std::string>& names);

/// Where one looks first: plastic strain, von Mises stress, displacement, else the first field but normals and texture
/// coordinates; empty without any.
std::string foreignFieldToShow(const std::vector<ForeignField>& fields);

/// The vector of displacements by its usual names, at points, or null.
const ForeignField* displacementAmong(const std::vector<ForeignField>& fields);

/// The stress by its usual names, a tensor, or null.
const ForeignField* stressAmong(const std::vector<ForeignField>& fields);

/// A vector at the points of a block, 3 x points: zero where it is not finite, or the block does not have it; of cells the means of
/// those about the points.
Eigen::MatrixXd vectorsAt(const ForeignBlock& block, const ForeignField& field);

/// The same of the symmetric part of a tensor, 6 x points: xx, yy, zz, xy, yz, zx.
Eigen::MatrixXd tensorsAt(const ForeignBlock& block, const ForeignField& field);

}  // namespace burnish
