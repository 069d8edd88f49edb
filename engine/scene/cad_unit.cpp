#include "engine/scene/cad_unit.h"

#include <fmt/format.h>

#include "engine/core/quoted.h"
#include "engine/core/unit_label.h"

namespace burnish::inline scene {

std::optional<std::string> cadUnitOf(const YamlNode& root, const std::string& path, Diagnostics& errors) {
  const YamlNode* units = root.find("units");
  const YamlNode* length = units != nullptr ? units->find("length") : nullptr;
  if (length == nullptr || length->kind != YamlNode::Kind::Scalar || length->text.empty())
    return labelOf(LengthUnit::Millimetre);
  if (const auto unit = lengthUnitOf(length->text)) return labelOf(*unit);
  if (errors.clean("units.length"))
    errors.add(
        length->place, "units.length",
        fmt::format("found {}, into which the lengths of the CAD file of {} cannot be converted; allowed: "
                    "{}, or unit beside the file.",
                    quoted(length->text), path, kLengthLabels));
  return std::nullopt;
}

}  // namespace burnish::inline scene
