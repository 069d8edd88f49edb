#pragma once
#include <string>
#include <vector>

namespace burnish {

/// Something that the program uses.
struct Finding {
  std::string name;
  std::string needed;  ///< for what, or empty: for everything
  bool isThere = false;
  std::string what;    ///< which one is there, or what is wrong
  std::string remedy;  ///< what to do; empty where it is there
};

/// Looks at this machine and at all that the program loads or starts; draws a picture of a few pixels. Never throws.
std::vector<Finding> examine();

}  // namespace burnish
