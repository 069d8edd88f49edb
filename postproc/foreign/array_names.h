#pragma once
#include <string>

namespace burnish {

/// How an array is called, and in what it is measured.
struct ArrayName {
  std::string name, unit;  ///< the unit may be empty
};

/// `stress [MPa]` as name and unit.
ArrayName arrayNameOf(const std::string& text);

}  // namespace burnish
