#include "postproc/draw/contour/picture_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/core/drawable_range.h"
#include "engine/core/nearest.h"
#include "postproc/draw/contour/contour_arrows.h"
#include "postproc/draw/contour/contour_view.h"

namespace burnish {
namespace {

constexpr double kPointsPerInch = 72.0;

/// So many finite numbers with commas between them, or nothing.
template <int Count>
std::optional<Eigen::Vector<double, Count>> numbersFrom(std::string_view text) {
  Eigen::Vector<double, Count> numbers;
  for (Eigen::Index k = 0; k < Count; ++k) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), numbers(k));
    const bool last = k + 1 == Count, atEnd = end == text.data() + text.size();
    if (error != std::errc() || !std::isfinite(numbers(k)) || atEnd != last || (!last && *end != ','))
      return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()) + (last ? 0 : 1));
  }
  return numbers;
}

std::string textOf(const MirrorPlane& plane) {
  const char axis = "xyz"[plane.axis];
  return plane.at == 0.0 ? std::string(1, axis) : fmt::format("{}={}", axis, plane.at);
}

std::string sizeText(const std::array<int, 2>& size) {
  return fmt::format("{} x {} pixels; expected {}", size[0], size[1], pictureSizeWords());
}

void checkSize(const PictureOptions& options, std::vector<InputProblem>& problems) {
  const std::array<int, 2> drawn = drawnSize(options);
  if (!isPictureSize(options.size))
    problems.push_back({"size", fmt::format("found {}", sizeText(options.size))});
  else if (!isPictureSize(drawn))
    problems.push_back({"scale", fmt::format("found {}, which makes {}", options.scale, sizeText(drawn))});
}

void checkColors(const PictureOptions& options, std::vector<InputProblem>& problems) {
  if (options.range && !isDrawableRange(*options.range))
    problems.push_back({"range", fmt::format("found {}, {}; allowed: {}.", (*options.range)[0],
                                             (*options.range)[1], kDrawableRangeWords)});
  if (options.range && options.clip)
    problems.push_back({"clip", "found beside range; both say where the colours end: give one of them."});
  if (options.background && options.transparent)
    problems.push_back({"background", "found beside transparent; the two exclude each other."});
}

/// What does not belong to a part of the body.
void checkPlanes(const PictureOptions& options, std::optional<int> dim, std::vector<InputProblem>& problems) {
  if (!options.cut && !options.slice) return;
  const std::string key = options.cut ? "cut" : "slice";
  const CutPlane& plane = options.cut ? *options.cut : *options.slice;
  if (options.cut && options.slice)
    problems.push_back({"slice", "found beside cut; the two exclude each other: give one of them."});
  if (dim == 2)
    problems.push_back(
        {key, "found a plane through a plane body; allowed: in three-dimensional scenes alone."});
  if (!plane.point.allFinite() || !plane.normal.allFinite() || plane.normal.norm() == 0.0)
    problems.push_back({key, "expected a point and a normal that is not 0,0,0."});
  if (options.controlNet)
    problems.push_back({key, "the control net belongs to the whole body; draw it without."});
  if (options.arrows == ArrowField::Traction)
    problems.push_back({key, "contact tractions act on the whole body; draw them without."});
}

/// Fields that no body can have.
void checkChoice(const PictureOptions& options, std::optional<int> dim, std::vector<InputProblem>& problems) {
  const auto checkField = [&](const char* key, const std::string& field) {
    const std::vector<std::string> names = bodyFields();
    if (!field.empty() && !options.ofOthers && std::find(names.begin(), names.end(), field) == names.end())
      problems.push_back(
          {key, fmt::format("found the field \"{}\"; allowed: a field of bodies, such as von_mises.{}", field,
                            didYouMean(field, names))});
  };
  const bool chooses = options.threshold || options.isosurfaces;
  if (options.threshold) checkField("threshold", options.threshold->field);
  if (options.isosurfaces) {
    checkField("isosurfaces", options.isosurfaces->field);
    if (options.threshold)
      problems.push_back(
          {"isosurfaces", "found beside threshold; the two exclude each other: give one of them."});
    if (options.slice)
      problems.push_back({"isosurfaces", "found beside slice, on which they are lines: take isolines."});
    if (dim == 2)
      problems.push_back(
          {"isosurfaces",
           "found in a plane body; allowed: in three-dimensional scenes alone; take isolines."});
    if (options.isolines > 0 && drawsOwnIsosurfaces(options))
      problems.push_back(
          {"isolines",
           "found beside isosurfaces of the same field, on which it has one value each: give one of "
           "them, or isosurfaces of another field."});
    if (options.cutFace == CutFace::Hatch)
      problems.push_back(
          {"cut_face",
           "found hatch beside isosurfaces, which have no section to be hatched: give one of them."});
  }
  if (chooses && options.arrows != ArrowField::None)
    problems.push_back({"vectors", "arrows belong to the whole body; draw it without."});
}

void checkView(const PictureOptions& options, std::optional<int> dim, std::vector<InputProblem>& problems) {
  const auto isZ = [](const MirrorPlane& plane) { return plane.axis == 2; };
  if (dim == 2 && std::any_of(options.mirror.begin(), options.mirror.end(), isZ))
    problems.push_back({"mirror", fmt::format("found \"{}\"; allowed in two dimensions: planes of x and y.",
                                              Spelling<std::vector<MirrorPlane>>::write(options.mirror))});
  if (dim == 2 && options.view.name != "auto" && options.view.name != "xy")
    problems.push_back(
        {"view", fmt::format("found \"{}\"; a plane body is only seen in its plane: auto or xy.",
                             options.view.name)});
  if (options.printField == PrintField::Vector && dim == 3 && !options.slice)
    problems.push_back(
        {"print_field",
         "found vector; a body in space is an image, in which what stands before hides what is behind: "
         "take image, or a slice."});
  if (options.perspective && dim == 2)
    problems.push_back({"perspective", "a plane body is seen as it is; draw it without."});
  if (options.perspective && options.slice)
    problems.push_back({"perspective", "found beside slice, which is seen as it is: draw it without."});
  if (options.perspective && options.scaleBar)
    problems.push_back(
        {"scale_bar", "found beside perspective, where equal lengths are not seen equal: give one of them."});
  if (options.cutFace == CutFace::Hatch && !options.cut)
    problems.push_back(
        {"cut_face", "found hatch, but there is no section beside the body that has the field: add cut."});
  if (options.hiddenLines != HiddenLines::Off && dim == 2)
    problems.push_back({"hidden_lines", "a plane body hides none of its lines; draw it without."});
  if (options.arrows == ArrowField::Field && !options.ofOthers && !options.field.empty())
    if (const auto problem = directionProblem(options.field)) problems.push_back({"vectors", *problem});
  if (options.arrows == ArrowField::Streamlines && dim == 3 && !options.slice)
    problems.push_back({"vectors", "found streamlines, which are drawn in a plane: add slice."});
  if (options.arrows == ArrowField::Traction && options.warp != 1.0 && !options.ofOthers)
    problems.push_back(
        {"warp", "contact tractions belong to the true displacements; draw them without a warp."});
}

/// Faces in contact are recorded where they are, as surfaces, with their own values alone.
void checkContactField(const PictureOptions& options, std::vector<InputProblem>& problems) {
  if (options.ofOthers || !isContactField(options.field)) return;
  const auto refuse = [&](bool isGiven, const char* key) {
    if (isGiven)
      problems.push_back(
          {key, fmt::format("{} belongs to the faces in contact; draw it without.", options.field)});
  };
  refuse(options.warp != 1.0, "warp");
  refuse(options.clip.has_value(), "clip");
  refuse(options.cut.has_value(), "cut");
  refuse(options.slice.has_value(), "slice");
  refuse(options.threshold.has_value(), "threshold");
  refuse(options.isosurfaces.has_value(), "isosurfaces");
  if (options.range && !statesOfContactField(options.field).empty())
    problems.push_back({"range", fmt::format("the states of {} have colours of their own; draw it without.",
                                             options.field)});
  refuse(options.arrows != ArrowField::None && options.arrows != ArrowField::Traction, "vectors");
}

}  // namespace

std::optional<ViewName> Spelling<ViewName>::read(const std::string& text) {
  const auto& names = viewNames();
  const bool isName = std::find(names.begin(), names.end(), text) != names.end();
  const auto direction = numbersFrom<3>(text);
  if (!isName && !(direction && direction->norm() > 0.0)) return std::nullopt;
  return ViewName{text};
}

std::string Spelling<ViewName>::words() {
  return fmt::format("{}, or a direction X,Y,Z towards the eye that is not 0,0,0",
                     fmt::join(viewNames(), ", "));
}

const std::vector<std::string>& Spelling<ViewName>::candidates() {
  return viewNames();
}

ViewAxes viewAxes(const ViewName& view, int dim) {
  if (dim == 3)
    if (const auto direction = numbersFrom<3>(view.name)) return viewFrom(*direction);
  return viewNamed(view.name, dim);
}

std::optional<Eigen::AlignedBox2d> Spelling<Eigen::AlignedBox2d>::read(const std::string& text) {
  const auto corners = numbersFrom<4>(text);
  if (!corners) return std::nullopt;
  Eigen::AlignedBox2d window;
  window.extend(Eigen::Vector2d(corners->head<2>())).extend(Eigen::Vector2d(corners->tail<2>()));
  if (!(window.sizes().minCoeff() > 0.0) || !window.sizes().allFinite()) return std::nullopt;
  return window;
}

std::string Spelling<Eigen::AlignedBox2d>::write(const Eigen::AlignedBox2d& window) {
  return fmt::format("{},{}", fmt::join(window.min(), ","), fmt::join(window.max(), ","));
}

std::string Spelling<CutPlane>::write(const CutPlane& plane) {
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d normal = Eigen::Vector3d::Unit(axis);
    if (plane.normal == normal && plane.point == plane.point(axis) * normal)
      return fmt::format("{}={}", "xyz"[axis], plane.point(axis));
  }
  return fmt::format("{},{}", fmt::join(plane.point, ","), fmt::join(plane.normal, ","));
}

std::string Spelling<std::vector<MirrorPlane>>::write(const std::vector<MirrorPlane>& planes) {
  std::string text;
  for (const MirrorPlane& plane : planes) text += (text.empty() ? "" : ",") + textOf(plane);
  return text;
}

Theme themeOf(const PictureOptions& options) {
  Theme theme = themeOf(static_cast<const PageLook&>(options));
  if (options.background) theme.paper = *options.background;
  return theme;
}

bool drawsOwnIsosurfaces(const PictureOptions& options) {
  return options.isosurfaces &&
         (options.isosurfaces->field.empty() || options.isosurfaces->field == options.field);
}

std::array<int, 2> drawnSize(const PictureOptions& options) {
  const auto scaled = [&](int side) { return static_cast<int>(std::lround(options.scale * side)); };
  return {scaled(options.size[0]), scaled(options.size[1])};
}

std::vector<InputProblem> printOptionsOfPixels(const PrintOptions& options) {
  constexpr const char* kRemedy = "leave it out, or take pdf or svg.";
  std::vector<InputProblem> problems;
  if (options.dpi)
    problems.push_back(
        {"dpi", fmt::format("found beside a PNG, which has pixels and no inches; {}", kRemedy)});
  if (options.printField != PrintField::Image)
    problems.push_back(
        {"print_field", fmt::format("found beside a PNG, which is made of pixels; {}", kRemedy)});
  return problems;
}

double dotsPerPoint(const PrintOptions& options) {
  return options.dpi.value_or(kPrintDpi) / kPointsPerInch;
}

std::vector<InputProblem> printConflictsIn(const PictureOptions& options, double pointsPerPixel) {
  const auto [pixelsRight, pixelsUp] = drawnSize(options);
  const double width = pointsPerPixel * pixelsRight, height = pointsPerPixel * pixelsUp;
  const double dots = dotsPerPoint(options), largest = std::max(width, height);
  if (dots * largest <= kLargestSide) return {};
  return {{"dpi",
           fmt::format("found {}, which makes {:.0f} x {:.0f} pixels of {:.0f} x {:.0f} points; expected up "
                       "to {} x {}: dpi up to {:.0f}, or a smaller size",
                       options.dpi.value_or(kPrintDpi), dots * width, dots * height, width, height,
                       kLargestSide, kLargestSide, std::floor(kPointsPerInch * kLargestSide / largest))}};
}

std::vector<InputProblem> conflictsIn(const PictureOptions& options, std::optional<int> dim) {
  std::vector<InputProblem> problems;
  checkSize(options, problems);
  checkColors(options, problems);
  checkPlanes(options, dim, problems);
  checkView(options, dim, problems);
  checkChoice(options, dim, problems);
  checkContactField(options, problems);
  return problems;
}

}  // namespace burnish
