#pragma once
#include <string>

namespace burnish {

/// How an array is called, and in what it is measured.
struct ArrayName {
  std::string name, unit;  ///< the unit may be empty
};

/// `stress [MPa]` as name and unit.
ArrayName arrayNameOf(const std::string& text);

/// A name of a file as one can give it: a line of letters, without the commas that part the names of a list.
std::string typedName(const std::string& text);

}  // namespace burnish
