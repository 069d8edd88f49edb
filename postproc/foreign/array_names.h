#pragma once
#include <string>
#include <vector>

class vtkDataArray;

namespace burnish {

/// How an array is called, and in what it is measured.
struct ArrayName {
  std::string name, unit;  ///< the unit may be empty
};

/// `stress [MPa]` as name and unit.
ArrayName arrayNameOf(const std::string& text);

/// A name of a file as one can give it: a line of letters, without the commas that part the names of a list.
std::string typedName(const std::string& text);

/// Names of the components of an array: as the file has them, where they differ, else as VTK orders vectors and tensors.
/// None of a scalar.
std::vector<std::string> componentsOf(vtkDataArray& array);

}  // namespace burnish
