#include "postproc/foreign/array_names.h"

#include <vtkDataArray.h>

#include <cstddef>
#include <set>

#include "engine/core/lower_case.h"
#include "engine/core/shown_text.h"

namespace burnish {

ArrayName arrayNameOf(const std::string& text) {
  const std::size_t bracket = text.rfind(" [");
  if (bracket == std::string::npos || !text.ends_with("]")) return {text, ""};
  return {text.substr(0, bracket), text.substr(bracket + 2, text.size() - bracket - 3)};
}

std::string typedName(const std::string& text) {
  std::string name;
  for (char letter : forMessage(text, kLongestName)) {
    if (letter == ',') letter = ' ';
    if (letter != ' ' || (!name.empty() && name.back() != ' ')) name += letter;
  }
  if (name.ends_with(' ')) name.pop_back();
  return name.empty() ? "unnamed" : name;
}

std::vector<std::string> componentsOf(vtkDataArray& array) {
  const int count = array.GetNumberOfComponents();
  if (count == 1) return {};
  std::vector<std::string> names;
  for (int k = 0; k < count && array.GetComponentName(k); ++k)
    names.push_back(inLowerCase(typedName(array.GetComponentName(k))));
  if (static_cast<int>(std::set(names.begin(), names.end()).size()) == count) return names;
  if (count == 2) return {"x", "y"};
  if (count == 3) return {"x", "y", "z"};
  if (count == 6) return {"xx", "yy", "zz", "xy", "yz", "xz"};
  if (count == 9) return {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"};
  names.clear();
  for (int k = 0; k < count; ++k) names.push_back(std::to_string(k));
  return names;
}

}  // namespace burnish
