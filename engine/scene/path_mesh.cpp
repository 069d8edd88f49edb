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

namespace burnish::inline scene {
namespace {

/// How far beyond the passes spans are fine, over the half width of the contact.
constexpr double kFineBeyond = 2.0;

/// How long the part of the passes is that a mesh which follows the tool is fine around, over the half width.
constexpr double kTravel = 4.0;

/// Pieces of that length by which the way of the tool is followed.
constexpr double kPieces = 32.0;

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

std::vector<Breaks> pathBreaks(const Passage& passage, const ResolutionSpec& resolution) {
  if (!(resolution.halfWidth > 0.0) || !(passage.block.size.head(passage.block.dim).minCoeff() > 0.0))
    throw InputError("half_width", "found nothing to make spans of; allowed: lengths above 0.");
  std::vector<Breaks> breaks;
  for (int d = 0; d < passage.block.dim; ++d)
    breaks.push_back(d == passage.depth() ? intoDepth(passage, resolution)
                                          : alongFace(passage, d, resolution));
  return breaks;
}

/// Times at which the way of a pass is looked at: its corners, and so many between them that pieces of the way are no
/// longer than `longest`.
std::vector<double> timesIn(const ToolPath& path, const ToolPath::Pass& pass, double longest) {
  std::vector<double> corners{pass.begin};
  for (const double t : path.corners())
    if (t > pass.begin && t < pass.end) corners.push_back(t);
  std::ranges::sort(corners);
  corners.push_back(pass.end);
  std::vector<double> times{pass.begin};
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const double length = corners[k] - corners[k - 1];
    const auto pieces = std::max(1L, std::lround(std::ceil(path.speed() * length / longest - 1e-9)));
    for (long piece = 1; piece < pieces; ++piece)
      times.push_back(corners[k - 1] + length * static_cast<double>(piece) / static_cast<double>(pieces));
    times.push_back(corners[k]);
  }
  return times;
}

/// A part of the passes, and the time at which the tool begins with it.
struct PassagePart {
  double from = 0.0;
  Eigen::AlignedBox3d places;
};

/// Parts one after the other, each as long as can be without being longer than `travel` in a direction of the face.
std::vector<PassagePart> partsOf(const Passage& passage, const ToolSpec& tool, double travel) {
  const ToolPath path = pathOf(tool);
  const Eigen::Vector3d middle = makeShape(tool.shape, tool.inside).middle();
  const auto extent = [&](const Eigen::AlignedBox3d& box) {
    Eigen::Vector3d sizes = box.sizes();
    sizes(passage.depth()) = 0.0;
    return sizes.maxCoeff();
  };
  std::vector<PassagePart> parts(1);
  std::optional<double> lifted;  // at the end of the pass before
  for (const ToolPath::Pass& pass : path.passes()) {
    std::optional<double> before;
    for (const double t : timesIn(path, pass, travel / kPieces)) {
      const Eigen::Vector3d place = middle + path.displacement(t);
      Eigen::AlignedBox3d longer = parts.back().places;
      longer.extend(place);
      if (!parts.back().places.isEmpty() && extent(longer) > travel * (1.0 + 1e-9)) {
        parts.push_back({before.value_or(0.5 * (lifted.value_or(t) + t)), {}});
        if (before) parts.back().places.extend(middle + path.displacement(*before));
      }
      parts.back().places.extend(place);
      before = t;
    }
    lifted = pass.end;
  }
  return parts;
}

bool follows(const Scene& scene, const BodySpec& body) {
  const auto& resolution = body.geometry.mesh.resolution;
  const std::optional<Block> block = blockOf(body);
  return scene.rezoning && resolution && block && block->dim == 3 &&
         (body.name.empty() || scene.rezoning->body.empty() || scene.rezoning->body == body.name);
}

/// All meshes of a body with a resolution.
std::vector<FollowingMesh> meshesOf(const Scene& scene, const BodySpec& body) {
  const ResolutionSpec& resolution = *body.geometry.mesh.resolution;
  Passage passage = passageOf(scene, body);
  if (!follows(scene, body)) return {{0.0, pathBreaks(passage, resolution)}};
  const double travel = scene.rezoning->travel.value_or(kTravel * resolution.halfWidth);
  std::vector<FollowingMesh> meshes;
  for (const PassagePart& part : partsOf(passage, toolOf(scene, resolution.along), travel)) {
    passage.passes = part.places;
    meshes.push_back({part.from, pathBreaks(passage, resolution)});
  }
  return meshes;
}

void resolve(Scene& scene, BodySpec& body) {
  if (!body.geometry.mesh.resolution) return;
  try {
    body.geometry.mesh.resolution->breaks = meshesOf(scene, body).front().breaks;
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
  static_cast<void>(meshesOf(scene, scene.allBodies()[body]));
}

bool hasFollowingMeshes(const Scene& scene, std::size_t body) {
  return follows(scene, scene.allBodies()[body]);
}

std::vector<FollowingMesh> followingMeshes(const Scene& scene, std::size_t body) {
  return meshesOf(scene, scene.allBodies()[body]);
}

Scene withBreaks(Scene scene, std::size_t body, const std::vector<std::vector<double>>& breaks) {
  BodySpec& changed = scene.bodies.empty() ? scene.body : scene.bodies[body];
  changed.geometry.mesh.resolution->breaks = breaks;
  return scene;
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

}  // namespace burnish::inline scene
