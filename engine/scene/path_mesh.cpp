#include "engine/scene/path_mesh.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <variant>

#include "engine/core/input_error.h"
#include "engine/core/quoted.h"
#include "engine/nurbs/patch.h"
#include "engine/scene/path_of_tool.h"

namespace burnish {
namespace {

/// How far beyond the passes spans are fine, over the half width of the contact.
constexpr double kFineBeyond = 2.0;

constexpr int kMostSpans = 10'000;  ///< in a direction, as of `spans`

using Breaks = std::vector<double>;

/// A box or a rectangle.
struct Block {
  int dim = 0;
  Eigen::Vector3d origin, size;
};

std::optional<Block> blockOf(const BodySpec& body) {
  if (const auto* box = std::get_if<BoxBody>(&body.geometry.shape)) return Block{3, box->origin, box->size};
  if (const auto* rectangle = std::get_if<RectangleBody>(&body.geometry.shape))
    return Block{2, rectangle->origin, rectangle->size};
  return std::nullopt;
}

/// Where the passes of a tool lead over a block.
struct Passage {
  Block block;
  FaceId face;
  Eigen::AlignedBox3d passes;  ///< of the middle of the tool

  int depth() const { return face / 2; }
};

const ToolSpec& toolOf(const Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.tools, name, &ToolSpec::name);
  if (found == scene.tools.end())
    throw InputError(
        "along",
        fmt::format("found {}, which is no tool; allowed: the name of a tool with a path.", quoted(name)));
  if (!found->path)
    throw InputError(
        "along",
        fmt::format("found {}, a tool without a path; allowed: the name of a tool with one.", quoted(name)));
  if (std::holds_alternative<HelixPath>(found->path->course))
    throw InputError(
        "along", fmt::format("found {}, whose path is a helix; allowed: polyline, raster.", quoted(name)));
  if (const auto* line = std::get_if<PolylinePath>(&found->path->course);
      line != nullptr && line->points.empty())
    throw InputError("along", fmt::format("found {}, whose path has no points.", quoted(name)));
  return *found;
}

FaceId faceUnder(const Scene& scene, const BodySpec& body, const std::string& tool, int dim) {
  const auto isMeant = [&](const ContactSpec& contact) {
    return contact.tool == tool && contact.place.body == body.name;
  };
  const auto found = std::ranges::find_if(scene.contact, isMeant);
  if (found == scene.contact.end())
    throw InputError(
        "along", fmt::format("found {}, which no face of the body has a contact with; allowed: the tool of "
                             "one of its contacts.",
                             quoted(tool)));
  return dim == 2 ? faceFromName<2>(found->place.face) : faceFromName<3>(found->place.face);
}

Eigen::AlignedBox3d passesOf(const ToolSpec& tool) {
  const ToolPath path = pathOf(tool);
  const Eigen::Vector3d middle = makeShape(tool.shape, tool.inside).middle();
  std::vector<double> times = path.corners();
  Eigen::AlignedBox3d box;
  for (const ToolPath::Pass& pass : path.passes()) {
    for (const double t : {pass.begin, pass.end}) box.extend(middle + path.displacement(t));
    for (const double t : times)
      if (t > pass.begin && t < pass.end) box.extend(middle + path.displacement(t));
  }
  return box;
}

Passage passageOf(const Scene& scene, const BodySpec& body) {
  const ResolutionSpec& resolution = *body.geometry.mesh.resolution;
  const std::optional<Block> block = blockOf(body);
  if (!block) throw InputError("", "found for a shape that is no box; allowed: for box, rectangle.");
  const ToolSpec& tool = toolOf(scene, resolution.along);
  return {*block, faceUnder(scene, body, tool.name, block->dim), passesOf(tool)};
}

/// Sizes of spans that grow from one to the next and together are so long, at least one.
std::vector<double> growing(double length, double first, double growth) {
  std::vector<double> sizes;
  double sum = 0.0;
  for (double size = first; sizes.empty() || sum < length; size *= growth) {
    if (std::ssize(sizes) > kMostSpans)
      throw InputError("half_width",
                       fmt::format("found one that asks for more than {} knot spans in a direction; "
                                   "allowed: a larger one, or fewer spans_per_width.",
                                   kMostSpans));
    sizes.push_back(size);
    sum += size;
  }
  for (double& size : sizes) size *= length / sum;
  return sizes;
}

/// The inner breakpoints of spans one after the other that fill [0, 1].
Breaks breaksOf(const std::vector<double>& sizes) {
  double sum = 0.0;
  for (const double size : sizes) sum += size;
  Breaks breaks;
  double place = 0.0;
  for (std::size_t k = 0; k + 1 < sizes.size(); ++k) breaks.push_back((place += sizes[k]) / sum);
  return breaks;
}

Breaks alongFace(const Passage& passage, int direction, const ResolutionSpec& resolution) {
  const double low = passage.block.origin(direction), high = low + passage.block.size(direction);
  const double margin = kFineBeyond * resolution.halfWidth,
               h = 2.0 * resolution.halfWidth / resolution.spansPerWidth;
  const double begin = std::clamp(passage.passes.min()(direction) - margin, low, high);
  const double end = std::clamp(passage.passes.max()(direction) + margin, low, high);
  if (!(end > begin))
    throw InputError("along",
                     fmt::format("found {}, whose passes lead beside the box; allowed: a path over it.",
                                 quoted(resolution.along)));
  const double rounding = 1e-9 * (high - low);
  std::vector<double> sizes;
  if (begin > low + rounding) {
    sizes = growing(begin - low, resolution.growth * h, resolution.growth);
    std::ranges::reverse(sizes);
  }
  const double fine = end - begin;
  if (fine / h > kMostSpans) static_cast<void>(growing(fine, h, 1.0));  // says what is wrong
  const auto count = static_cast<std::size_t>(std::ceil(fine / h - 1e-9));
  sizes.insert(sizes.end(), count, fine / static_cast<double>(count));
  if (end < high - rounding) {
    const auto behind = growing(high - end, resolution.growth * h, resolution.growth);
    sizes.insert(sizes.end(), behind.begin(), behind.end());
  }
  return breaksOf(sizes);
}

Breaks intoDepth(const Passage& passage, const ResolutionSpec& resolution) {
  const double h = 2.0 * resolution.halfWidth / resolution.spansPerWidth;
  std::vector<double> sizes = growing(passage.block.size(passage.depth()), 0.5 * h, resolution.growth);
  if (passage.face % 2 == 1) std::ranges::reverse(sizes);
  return breaksOf(sizes);
}

std::vector<Breaks> pathBreaks(const Scene& scene, const BodySpec& body) {
  const ResolutionSpec& resolution = *body.geometry.mesh.resolution;
  const Passage passage = passageOf(scene, body);
  if (!(resolution.halfWidth > 0.0) || !(passage.block.size.head(passage.block.dim).minCoeff() > 0.0))
    throw InputError("half_width", "found nothing to make spans of; allowed: lengths above 0.");
  std::vector<Breaks> breaks;
  for (int d = 0; d < passage.block.dim; ++d)
    breaks.push_back(d == passage.depth() ? intoDepth(passage, resolution)
                                          : alongFace(passage, d, resolution));
  return breaks;
}

void resolve(Scene& scene, BodySpec& body) {
  if (!body.geometry.mesh.resolution) return;
  try {
    body.geometry.mesh.resolution->breaks = pathBreaks(scene, body);
  } catch (const Error&) {
    // The check of the geometry says what is wrong, or that of the tool.
  }
}

}  // namespace

void resolveMeshes(Scene& scene) {
  resolve(scene, scene.body);
  for (BodySpec& body : scene.bodies) resolve(scene, body);
}

void requirePathMesh(const Scene& scene, std::size_t body) {
  static_cast<void>(pathBreaks(scene, scene.allBodies()[body]));
}

PathRoom pathRoom(const Scene& scene, std::size_t number) {
  const BodySpec& body = scene.allBodies()[number];
  const Passage passage = passageOf(scene, body);
  const double a = body.geometry.mesh.resolution->halfWidth;
  PathRoom room{std::numeric_limits<double>::infinity(), passage.block.size(passage.depth()) / a};
  for (int d = 0; d < passage.block.dim; ++d) {
    if (d == passage.depth()) continue;
    const double low = passage.block.origin(d), high = low + passage.block.size(d);
    room.beside =
        std::min({room.beside, (passage.passes.min()(d) - low) / a, (high - passage.passes.max()(d)) / a});
  }
  return room;
}

}  // namespace burnish
