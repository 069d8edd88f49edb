#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/core/drawable_range.h"
#include "postproc/mesh/picture_planes.h"
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

/// The plane of a cut or a slice.
void checkCut(const CheckContext& c, const std::string& path, const std::optional<std::string>& plane) {
  if (!plane || !c.clean(path)) return;
  if (!cutPlaneNamed(*plane))
    c.report(path, fmt::format("found \"{}\"; allowed: {}.", *plane, kCutPlaneWords));
  else if (c.dimensionIsKnown() && c.scene.dim() == 2)
    c.report(path, "found a plane through a plane body; allowed: in three-dimensional scenes alone.");
}

void checkMirror(const CheckContext& c, const std::string& path, const std::optional<std::string>& text) {
  if (!text || !c.clean(path)) return;
  const auto planes = mirrorPlanesNamed(*text);
  const auto isZ = [](const MirrorPlane& plane) { return plane.axis == 2; };
  if (!planes)
    c.report(path, fmt::format("found \"{}\"; allowed: {}.", *text, kMirrorPlaneWords));
  else if (c.dimensionIsKnown() && c.scene.dim() == 2 && std::any_of(planes->begin(), planes->end(), isZ))
    c.report(path, fmt::format("found \"{}\"; allowed in two dimensions: planes of x and y.", *text));
}

void checkColors(const CheckContext& c, const std::string& path,
                 const std::optional<std::array<double, 2>>& range) {
  if (range && c.clean(path) && !isDrawableRange(*range))
    c.report(path, fmt::format("found {}, {}; allowed: {}.", (*range)[0], (*range)[1], kDrawableRangeWords));
}

void checkPlanes(const DocumentContext& c, const std::string& path, const PictureSpec& picture) {
  checkCut(c, path + ".cut", picture.cut);
  checkCut(c, path + ".slice", picture.slice);
  checkMirror(c, path + ".mirror", picture.mirror);
  if (picture.cut && picture.slice && c.clean(path + ".slice"))
    c.report(path + ".slice", "found beside cut; allowed: one of cut and slice.");
}

}  // namespace

void checkPictures(const DocumentContext& c) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < c.document.pictures.size(); ++i) {
    const PictureSpec& picture = c.document.pictures[i];
    const std::string path = fmt::format("pictures[{}]", i);
    checkField(c, path + ".field", picture.field);
    if (c.clean("steps")) checkTimes(c, path + ".times", picture.times);
    checkPlanes(c, path, picture);
    checkColors(c, path + ".range", picture.range);
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
