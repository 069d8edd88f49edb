#include "postproc/probe/probe_spec.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "engine/core/error.h"
#include "engine/core/formula.h"
#include "postproc/mesh/contact_field.h"
#include "postproc/probe/probed_fields.h"

namespace burnish {

std::vector<std::string> profileFieldNames() {
  std::vector<std::string> names = bodyFields();
  for (std::string& name : surfaceFieldNames()) names.push_back(std::move(name));
  return names;
}

std::vector<std::string> probedFieldNames() {
  std::vector<std::string> names = profileFieldNames();
  for (std::string& name : contactFieldNames()) names.push_back(std::move(name));
  return names;
}

std::vector<std::string> formulaVariables(const std::vector<std::string>& fields) {
  std::vector<std::string> names = fields;
  const auto isOdd = [](unsigned char letter) { return std::isalnum(letter) == 0; };
  for (std::string& name : names) {
    std::ranges::replace_if(name, isOdd, '_');
    if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0) name.insert(0, "_");
  }
  return names;
}

std::vector<InputProblem> conflictsIn(const ProbeSpec& spec) {
  std::vector<std::string> places;
  for (const auto& [key, text] : {std::pair{"line", &spec.line}, std::pair{"face", &spec.face},
                                  std::pair{"depth", &spec.depth}, std::pair{"point", &spec.point}})
    if (!text->empty()) places.emplace_back(key);
  std::vector<InputProblem> problems;
  const bool isLaid = places == std::vector<std::string>{"line", "face"};
  if (places.size() != 1 && !isLaid)
    problems.push_back(
        {places.empty() ? "line" : places.front(),
         fmt::format("found {}; expected one of line, face, depth and point, or a line on a face in space",
                     places.empty() ? "no place" : fmt::format("{}", fmt::join(places, " and ")))});
  const auto require = [&](bool holds, const char* key, const char* text) {
    if (!holds) problems.push_back({key, text});
  };
  require(!spec.length || !spec.depth.empty(), "length",
          "says how deep depth goes; expected depth beside it");
  require(!spec.spot || !spec.depth.empty(), "spot",
          "is a length along the face of a depth; expected depth beside it");
  require(spec.patch.empty() || !spec.face.empty() || !spec.depth.empty(), "patch",
          "names the patch of a face; expected face or depth beside it");
  require(!spec.reference || spec.point.empty(), "reference",
          "says where a path lies; the place of a point is always in the undeformed body");
  require(!spec.window || !spec.mean, "window",
          "says what values along a path or at a point are means of; expected no mean beside it");
  require(!spec.penetration || (!spec.depth.empty() && !spec.mean), "penetration",
          "says how deep X-rays see; expected depth beside it, and no mean");
  require(!spec.penetration || !spec.window, "penetration", "found beside window; expected one of the two");
  const auto ofContact = std::ranges::count_if(spec.fields, isContactField);
  require(ofContact == 0 || ofContact == std::ssize(spec.fields), "field",
          "found fields of contact and others; expected a chart for each");
  require(ofContact == 0 || !spec.face.empty(), "field",
          "found a field of contact, which faces alone have; expected face as place");
  require(ofContact == 0 || !spec.reference, "reference",
          "contact fields are measured along the deformed face; expected a probe without it");
  const bool ofSurface = std::ranges::any_of(spec.fields, isSurfaceField);
  require(!ofSurface || !spec.depth.empty() || !spec.face.empty(), "field",
          "found a stress in the axes of a surface; expected depth or face as place");
  require(!ofSurface || !spec.reference, "reference",
          "the axes of a surface are those of the deformed face; expected a probe without it");
  const bool isState = std::ranges::count(spec.fields, "sliding") > 0;
  require(!isState || (!spec.window && !spec.penetration && !spec.mean), "field",
          "found sliding, which is a state and has no mean; expected it without window and mean");
  require(spec.formula.empty() || !spec.fields.empty(), "formula",
          "is one in fields; expected field beside it");
  if (!spec.formula.empty() && !spec.fields.empty()) try {
      const Formula formula({spec.formula}, {}, formulaVariables(spec.fields));
    } catch (const Error& error) {
      problems.push_back({"formula", error.what()});
    }
  require(!spec.mean || spec.point.empty(), "mean", "is that of a path; expected no point beside it");
  return problems;
}

}  // namespace burnish
