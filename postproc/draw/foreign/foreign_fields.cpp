#include "postproc/draw/foreign/foreign_fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/lower_case.h"
#include "engine/core/nearest.h"
#include "engine/core/quoted.h"
#include "engine/core/shown_text.h"
#include "postproc/foreign/array_names.h"

namespace burnish {
namespace {

/// Whether a name without a component means something.
bool hasOwn(const ForeignField& field) {
  return field.components.empty() || field.isVector();
}

std::string componentName(const ForeignField& field, std::size_t component) {
  return field.name + "." + field.components[component];
}

/// By what a field and its components are called.
std::vector<std::string> namesOf(const ForeignField& field) {
  std::vector<std::string> names;
  if (hasOwn(field)) names.push_back(field.name);
  for (std::size_t k = 0; k < field.components.size(); ++k) names.push_back(componentName(field, k));
  return names;
}

std::string numberedName(const ForeignField& field, std::size_t component) {
  return fmt::format("{}.{}", field.name, component);
}

/// Which component of a field a name means, -1 for the field itself.
std::optional<int> componentCalled(const ForeignField& field, const std::string& name) {
  if (hasOwn(field) && (name == field.name || name == field.array)) return -1;
  for (const auto called : {componentName, numberedName})
    for (std::size_t k = 0; k < field.components.size(); ++k)
      if (name == called(field, k)) return static_cast<int>(k);
  return std::nullopt;
}

/// Gives a field a name that none before it has, and by which none of these is found. taken: their names.
void nameApart(ForeignField& field, std::set<std::string>& taken) {
  const auto isTaken = [&] {
    return taken.contains(field.name) ||
           std::ranges::any_of(namesOf(field), [&](const std::string& name) { return taken.contains(name); });
  };
  if (isTaken()) field.name = (field.ofCells ? "cells." : "points.") + field.name;
  const std::string first = field.name;
  for (int k = 2; isTaken(); ++k) field.name = fmt::format("{}_{}", first, k);
  std::ranges::copy(namesOf(field), std::inserter(taken, taken.end()));
  for (std::size_t k = 0; k < field.components.size(); ++k) taken.insert(numberedName(field, k));
  taken.insert(field.name);
  if (hasOwn(field)) taken.insert(field.array);
}

void addFieldsOf(std::vector<ForeignField>& fields, std::set<std::string>& taken, vtkDataSetAttributes& data,
                 bool ofCells) {
  for (int k = 0; k < data.GetNumberOfArrays(); ++k) {
    vtkDataArray& array = *data.GetArray(k);
    const std::string own = array.GetName();
    const auto isSame = [&](const ForeignField& field) {
      return field.array == own && field.ofCells == ofCells;
    };
    // What belongs to the cells themselves.
    const bool isOfVtk = own == "vtkGhostType" || own.starts_with("vtkOriginal") ||
                         own == "RationalWeights" || own == "HigherOrderDegrees";
    if (isOfVtk || std::ranges::any_of(fields, isSame)) continue;
    const auto [name, unit] = arrayNameOf(own);
    ForeignField field{own, typedName(name), forMessage(unit, kLongestName), ofCells, componentsOf(array)};
    nameApart(field, taken);
    fields.push_back(std::move(field));
  }
}

vtkDataArray* arrayIn(const ForeignBlock& block, const ForeignField& field) {
  vtkDataSetAttributes* data = block.grid->GetPointData();
  if (field.ofCells) data = block.grid->GetCellData();
  vtkDataArray* array = data->GetArray(field.array.c_str());
  const auto count = std::max<std::size_t>(1, field.components.size());
  return array && static_cast<std::size_t>(array->GetNumberOfComponents()) == count ? array : nullptr;
}

/// Of each point the mean of what the cells about it have (rows x cells), as far as that is finite; zero else.
Eigen::MatrixXd meansAtPoints(vtkUnstructuredGrid& grid, const Eigen::MatrixXd& ofCells) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(ofCells.rows(), grid.GetNumberOfPoints());
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(sums.cols());
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell) {
    if (!ofCells.col(cell).allFinite()) continue;
    grid.GetCellPoints(cell, points);
    for (const vtkIdType point : *points) {
      sums.col(point) += ofCells.col(cell);
      counts(point) += 1.0;
    }
  }
  return sums * counts.cwiseMax(1.0).cwiseInverse().asDiagonal();
}

/// Rows of the components of an array at points, the means of those with the same row; zero where one of them is not finite.
/// rowOf: of a component, if it has one.
Eigen::MatrixXd componentsAt(const ForeignBlock& block, const ForeignField& field, Eigen::Index rows,
                             const std::function<std::optional<std::size_t>(std::size_t)>& rowOf) {
  vtkDataArray* array = arrayIn(block, field);
  if (!array) return Eigen::MatrixXd::Zero(rows, block.grid->GetNumberOfPoints());
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(rows, array->GetNumberOfTuples());
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(rows);
  for (std::size_t component = 0; component < field.components.size(); ++component) {
    const auto row = rowOf(component);
    if (!row) continue;
    const auto at = static_cast<Eigen::Index>(*row);
    counts(at) += 1.0;
    for (Eigen::Index k = 0; k < values.cols(); ++k)
      values(at, k) += array->GetComponent(k, static_cast<int>(component));
  }
  values = (counts.cwiseMax(1.0).cwiseInverse().asDiagonal() * values).eval();
  if (field.ofCells) return meansAtPoints(*block.grid, values);
  for (auto value : values.colwise())
    if (!value.allFinite()) value.setZero();
  return values;
}

}  // namespace

bool ForeignField::isTensor() const {
  return std::ranges::count(components, "xx") == 1 && std::ranges::count(components, "yy") == 1;
}

std::vector<ForeignField> foreignFieldsOf(const std::vector<ForeignBlock>& blocks) {
  std::vector<ForeignField> fields;
  std::set<std::string> taken;
  for (const ForeignBlock& block : blocks) addFieldsOf(fields, taken, *block.grid->GetPointData(), false);
  for (const ForeignBlock& block : blocks) addFieldsOf(fields, taken, *block.grid->GetCellData(), true);
  return fields;
}

std::vector<std::string> foreignFieldNames(const std::vector<ForeignField>& fields) {
  std::vector<std::string> names;
  for (const ForeignField& field : fields) std::ranges::copy(namesOf(field), std::back_inserter(names));
  return names;
}

Eigen::VectorXd ForeignChoice::valuesOf(const ForeignBlock& block) const {
  const Eigen::MatrixXd parts = partsOf(block);
  if (parts.rows() == 1) return parts.row(0).transpose();
  return parts.colwise().norm().transpose();
}

Eigen::MatrixXd ForeignChoice::partsOf(const ForeignBlock& block) const {
  vtkDataArray* array = arrayIn(block, field);
  if (!array) return {};
  Eigen::MatrixXd parts(component >= 0 ? 1 : array->GetNumberOfComponents(), array->GetNumberOfTuples());
  for (Eigen::Index k = 0; k < parts.cols(); ++k)
    for (Eigen::Index row = 0; row < parts.rows(); ++row)
      parts(row, k) = array->GetComponent(k, component >= 0 ? component : static_cast<int>(row));
  return parts;
}

double ForeignChoice::signInMirror(int axis) const {
  if (component < 0) return 1.0;
  const std::string& name = field.components[static_cast<std::size_t>(component)];
  const bool isOfAxes = name.size() <= 2 && name.find_first_not_of("xyz") == std::string::npos;
  return isOfAxes && std::ranges::count(name, "xyz"[axis]) % 2 == 1 ? -1.0 : 1.0;
}

std::optional<ForeignChoice> findForeignField(const std::vector<ForeignField>& fields,
                                              const std::string& name) {
  for (const std::string& word : {name, typedName(name)})
    for (const ForeignField& field : fields)
      if (const auto component = componentCalled(field, word)) return ForeignChoice{field, *component};
  return std::nullopt;
}

ForeignChoice chooseForeignField(const std::vector<ForeignField>& fields, const std::string& name,
                                 const std::string& where) {
  if (const auto found = findForeignField(fields, name)) return *found;
  const std::vector<std::string> names = foreignFieldNames(fields);
  throw Error(fmt::format("field: found {}; {} has {}.{}", quoted(name), where,
                          names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")),
                          didYouMean(name, names)));
}

FieldChoice wordsOf(const ForeignChoice& choice) {
  const ForeignField& field = choice.field;
  const std::string component =
      choice.component < 0 ? "" : field.components[static_cast<std::size_t>(choice.component)];
  return fieldInWords(field.name, component, choice.component < 0 && field.isVector(), field.unit);
}

std::vector<ForeignBlock> chosenBlocks(std::vector<ForeignBlock> blocks,
                                       const std::vector<std::string>& names) {
  if (names.empty()) return blocks;
  std::vector<std::string> all;
  for (const ForeignBlock& block : blocks) all.push_back(block.name);
  for (const std::string& name : names)
    if (std::ranges::count(all, name) == 0)
      throw Error(fmt::format("body: found {}; the file has {}.{}", quoted(name), fmt::join(all, ", "),
                              didYouMean(name, all)));
  std::erase_if(blocks, [&](const auto& block) { return std::ranges::count(names, block.name) == 0; });
  return blocks;
}

namespace {

/// What programs write for the sake of light and textures.
bool isOfShape(const ForeignField& field) {
  const std::string name = inLowerCase(field.name);
  return name == "normal" || name == "normals" || name == "tcoords" || name.starts_with("texcoord") ||
         name.starts_with("texture");
}

}  // namespace

std::string foreignFieldToShow(const std::vector<ForeignField>& fields) {
  for (const char* usual : {"plastic_strain", "peeq", "von_mises", "mises", "s_mises", "displacement", "u"})
    for (const ForeignField& field : fields)
      if (inLowerCase(field.name) == usual && (field.components.empty() || field.isVector()))
        return field.name;
  const auto first = std::ranges::find_if_not(fields, isOfShape);
  if (first == fields.end()) return "";
  return first->components.empty() || first->isVector() ? first->name
                                                        : first->name + "." + first->components.front();
}

const ForeignField* displacementAmong(const std::vector<ForeignField>& fields) {
  for (const char* usual : {"displacement", "displacements", "disp", "displ", "disp_", "u"})
    for (const ForeignField& field : fields)
      if (!field.ofCells && field.isVector() && inLowerCase(field.name) == usual) return &field;
  return nullptr;
}

const ForeignField* stressAmong(const std::vector<ForeignField>& fields) {
  for (const char* usual : {"stress", "cauchy_stress", "stresses", "s", "sigma"})
    for (const ForeignField& field : fields)
      if (field.isTensor() && inLowerCase(field.name) == usual) return &field;
  return nullptr;
}

Eigen::MatrixXd vectorsAt(const ForeignBlock& block, const ForeignField& field) {
  return componentsAt(block, field, 3, [](std::size_t component) { return std::optional(component); });
}

Eigen::MatrixXd tensorsAt(const ForeignBlock& block, const ForeignField& field) {
  constexpr std::array<std::array<const char*, 2>, 6> kNames{
      {{"xx", "xx"}, {"yy", "yy"}, {"zz", "zz"}, {"xy", "yx"}, {"yz", "zy"}, {"zx", "xz"}}};
  const auto rowOf = [&](std::size_t component) -> std::optional<std::size_t> {
    for (std::size_t row = 0; row < kNames.size(); ++row)
      if (std::ranges::count(kNames[row], field.components[component]) > 0) return row;
    return std::nullopt;
  };
  return componentsAt(block, field, std::ssize(kNames), rowOf);
}

}  // namespace burnish
