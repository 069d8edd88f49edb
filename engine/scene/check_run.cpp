#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/core/drawable_range.h"
#include "engine/scene/check_context.h"
#include "engine/scene/picture_planes.h"

namespace burnish {
namespace {

void checkSteps(const CheckContext& c) {
  const auto& steps = c.scene.steps;
  for (std::size_t i = 1; i < steps.size(); ++i)
    if (c.clean("steps") && steps[i].until <= steps[i - 1].until)
      return c.report(fmt::format("steps[{}].until", i),
                      fmt::format("found {} after {}; allowed: a time after the end of the phase before.",
                                  steps[i].until, steps[i - 1].until));
}

void checkTimes(const CheckContext& c, const std::string& path, const std::vector<double>& times) {
  const double end = c.scene.steps.back().until;
  for (std::size_t i = 0; i < times.size(); ++i)
    if (c.clean(path) && times[i] > end)
      c.report(fmt::format("{}[{}]", path, i),
               fmt::format("found {}; allowed: a time up to the end of the run at {}.", times[i], end));
}

void checkOutput(const CheckContext& c) {
  constexpr double mostFrames = 100'000;
  const double end = c.scene.steps.back().until;
  checkTimes(c, "output.times", c.scene.output.times);
  if (c.scene.output.every && c.clean("output.every") && end / *c.scene.output.every > mostFrames)
    c.report("output.every", fmt::format("found {}, which makes more than {} frames; allowed: at least {}.",
                                         *c.scene.output.every, mostFrames, end / mostFrames));
}

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

void checkPlanes(const CheckContext& c, const std::string& path, const PictureSpec& picture) {
  checkCut(c, path + ".cut", picture.cut);
  checkCut(c, path + ".slice", picture.slice);
  checkMirror(c, path + ".mirror", picture.mirror);
  if (picture.cut && picture.slice && c.clean(path + ".slice"))
    c.report(path + ".slice", "found beside cut; allowed: one of cut and slice.");
}

void checkPictures(const CheckContext& c) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < c.scene.pictures.size(); ++i) {
    const PictureSpec& picture = c.scene.pictures[i];
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

}  // namespace

void checkRun(const CheckContext& c) {
  checkSteps(c);
  if (c.clean("steps")) checkOutput(c);
  checkPictures(c);
}

}  // namespace burnish
