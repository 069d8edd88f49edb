#include <fmt/format.h>

#include <optional>
#include <set>

#include "postproc/scene/document_context.h"

namespace burnish {
namespace {

/// Fields that this body and material have not.
void checkField(const CheckContext& c, const std::string& path, const std::string& field) {
  if (!c.clean(path)) return;
  const bool threeD = field == "displacement.z" || field == "stress.yz" || field == "stress.zx";
  if (threeD && c.dimensionIsKnown() && c.scene.dim() == 2)
    c.report(path, fmt::format("found {}, a component of three-dimensional scenes; allowed here: the "
                               "components in x and y, and stress.zz.",
                               field));
  if (const std::string why = whyWithout(c.scene.material, field); !why.empty() && c.clean("material"))
    c.report(path,
             fmt::format("found {}, but {}; allowed here: another field, such as von_mises.", field, why));
}

/// What options say that cannot be.
void checkOptions(const CheckContext& c, const std::string& path, const PictureOptions& picture) {
  const auto dim = c.dimensionIsKnown() ? std::optional(c.scene.dim()) : std::nullopt;
  for (const InputProblem& problem : conflictsIn(picture, dim))
    if (const std::string key = path + "." + problem.path; c.clean(key)) c.report(key, problem.text);
}

}  // namespace

void checkPictures(const DocumentContext& c) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < c.document.pictures.size(); ++i) {
    const ScenePicture& picture = c.document.pictures[i];
    const std::string path = fmt::format("pictures[{}]", i);
    checkField(c, path + ".field", picture.field);
    if (c.clean("steps")) checkTimes(c, path + ".times", picture.times);
    checkOptions(c, path, picture);
    if (!c.clean(path)) continue;
    const std::string name = picture.name.value_or(picture.field);
    if (!names.insert(name).second)
      c.report(
          path,
          fmt::format(
              "found the file name {} a second time; allowed: a name of its own for each entry (name: ...).",
              name));
  }
}

}  // namespace burnish
