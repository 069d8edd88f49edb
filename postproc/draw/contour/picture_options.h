#pragma once
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/input_error.h"
#include "engine/material/material.h"
#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/value_choice.h"
#include "postproc/draw/page/picture_look.h"
#include "postproc/draw/page/picture_size.h"
#include "postproc/draw/page/view.h"
#include "postproc/mesh/contact_field.h"
#include "postproc/mesh/picture_planes.h"

/// What a contour picture shows and how it looks, declared once. A scene's `pictures`, a study's sheets and
/// animations, a theme's defaults and the options of `render`, `animate` and `report` are these options or a
/// part of them. A new option is a member, its line in one of the `describe…` below, its use, and a picture
/// that tests it.
namespace burnish {

/// What the arrows of a picture show: displacements on the body, the field that is drawn, what tools do to its contact
/// faces, or crosses of the principal stresses.
enum class ArrowField { None, Displacement, Field, Traction, Principal, Streamlines };

constexpr auto enumNames(std::type_identity<ArrowField>) {
  return std::array{
      std::pair{"none", ArrowField::None},           std::pair{"displacement", ArrowField::Displacement},
      std::pair{"field", ArrowField::Field},         std::pair{"traction", ArrowField::Traction},
      std::pair{"principal", ArrowField::Principal}, std::pair{"streamlines", ArrowField::Streamlines}};
}

/// What the faces show that a cut or a slice makes.
enum class CutFace { Field, Hatch };

constexpr auto enumNames(std::type_identity<CutFace>) {
  return std::array{std::pair{"field", CutFace::Field}, std::pair{"hatch", CutFace::Hatch}};
}

/// What is drawn of the edges behind surfaces.
enum class HiddenLines { Off, Dashed };

constexpr auto enumNames(std::type_identity<HiddenLines>) {
  return std::array{std::pair{"off", HiddenLines::Off}, std::pair{"dashed", HiddenLines::Dashed}};
}

/// A name of `viewNames`, or a direction "X,Y,Z" towards the eye.
struct ViewName {
  std::string name = "auto";
};

/// The view of a body of so many dimensions. Throws `Error` as `viewNamed` does.
ViewAxes viewAxes(const ViewName& view, int dim);

template <>
struct Spelling<ViewName> {
  static std::optional<ViewName> read(const std::string& text);
  static std::string write(const ViewName& view) { return view.name; }
  static std::string words();
  static const std::vector<std::string>& candidates();
};

/// Two opposite corners of a part of the view's plane.
template <>
struct Spelling<Eigen::AlignedBox2d> {
  static std::optional<Eigen::AlignedBox2d> read(const std::string& text);
  static std::string write(const Eigen::AlignedBox2d& window);
  static std::string words() { return "X0,Y0,X1,Y1: two corners of a window"; }
  static std::vector<std::string> candidates() { return {}; }
};

template <>
struct Spelling<CutPlane> {
  static std::optional<CutPlane> read(const std::string& text) { return cutPlaneNamed(text); }
  static std::string write(const CutPlane& plane);
  static std::string words() { return kCutPlaneWords; }
  static std::vector<std::string> candidates() { return {}; }
};

template <>
struct Spelling<std::vector<MirrorPlane>> {
  static std::optional<std::vector<MirrorPlane>> read(const std::string& text) {
    return mirrorPlanesNamed(text);
  }
  static std::string write(const std::vector<MirrorPlane>& planes);
  static std::string words() { return kMirrorPlaneWords; }
  static std::vector<std::string> candidates() { return {}; }
};

/// Of the images in files for print.
inline constexpr int kPrintDpi = 600;

/// The smallest `text_size`.
inline constexpr double kSmallestTextSize = 6.0;

/// Size in points of a picture for print: 170 mm wide.
inline constexpr std::array<int, 2> kPrintSize{482, 271};

/// What the colours of a field are in files for print.
enum class PrintField { Image, Vector };

constexpr auto enumNames(std::type_identity<PrintField>) {
  return std::array{std::pair{"image", PrintField::Image}, std::pair{"vector", PrintField::Vector}};
}

/// Of a smooth field that becomes vectors.
inline constexpr int kVectorBands = 64;

/// What a picture for print has beside the others.
struct PrintOptions {
  std::optional<int> dpi;  ///< dots per inch of what is no vector; `kPrintDpi` when left out
  PrintField printField = PrintField::Image;
};

template <class Visitor>
void describe(Visitor& v, PrintOptions& s) {
  v.field("dpi", s.dpi, {.atLeast = 72, .atMost = 2400},
          "Dots per inch of the image in a PDF or SVG, 600 when left out; texts and lines are vectors.");
  v.field(
      "print_field", s.printField, {},
      "Colours of a plane body or a slice in a PDF or SVG: an image, or vectors, which cut smooth ones into 64 bands.");
}

/// What is wrong with options for print beside a format of pixels. Paths are keys.
std::vector<InputProblem> printOptionsOfPixels(const PrintOptions& options);

/// Pixels of the image per point of the page.
double dotsPerPoint(const PrintOptions& options);

struct PictureOptions : PageLook, PictureDefaults, PrintOptions {
  std::string field;  ///< `plastic_strain`, `stress.xx`, …; a vector alone: magnitude
  std::optional<std::array<double, 2>> range;  ///< ends of the colour scale; smallest and largest value shown
  /// Instead of a range: the colours end at this percentile p and at the (100-p)th; see `fieldRange`.
  std::optional<double> clip;
  ArrowField arrows = ArrowField::None;
  bool markExtremes = false;                   ///< signs where the field is smallest and largest
  bool controlNet = false;                     ///< draw the control points and the lines between them
  bool scaleBar = false;                       ///< a line whose length in the body is told
  std::optional<ValueBand> threshold;          ///< all else of the body is left out
  std::optional<ChosenValues> isosurfaces;     ///< in space: these instead of the body
  double toolOpacity = 0.3;                    ///< of the tools in space, 1: hides what is behind
  HiddenLines hiddenLines = HiddenLines::Off;  ///< edges of body and tools that surfaces hide
  double warp = 1.0;                  ///< factor on the displacements of body and tools; values keep theirs
  std::optional<int> subdivision;     ///< cells per knot span and direction; see `refineForView`
  ViewName view;                      ///< auto of a slice: along its normal
  std::optional<double> perspective;  ///< in space: angle in degrees, see `eyeOf`; none: parallel
  std::optional<Eigen::AlignedBox2d> window;  ///< of the view's plane, that must be seen; see `contentOf`
  std::optional<CutPlane> cut;                ///< in space: what is on the eye's side of it is left out
  std::optional<CutPlane> slice;              ///< in space: only the section, seen against its normal
  CutFace cutFace = CutFace::Field;           ///< what the section shows
  std::vector<std::string> bodies;            ///< the ones that are drawn, by name; all when empty
  std::vector<MirrorPlane> mirror;            ///< planes of symmetry, beyond which the images are drawn too
  std::array<int, 2> size{1600, 900};         ///< pixels
  double scale = 1.0;                         ///< factor on the size with all texts and lines
  std::optional<double> textSize;             ///< in pixels; follows from the picture's size when left out
  std::optional<std::string> title;           ///< instead of the model's; empty: none
  std::optional<Color> background;            ///< instead of the theme's paper
  bool transparent = false;                   ///< no paper: the picture has an alpha channel
  bool ofOthers = false;                      ///< of another program's file, whose fields may have any name
};

/// Fresh options with a size of their own.
template <class Options = PictureOptions>
Options picturesOfSize(const std::array<int, 2>& size) {
  Options options;
  options.size = size;
  return options;
}

/// The theme with font and paper of the options.
Theme themeOf(const PictureOptions& options);

/// Whether a picture is of surfaces on which the drawn field itself has one value.
bool drawsOwnIsosurfaces(const PictureOptions& options);

/// Width and height in pixels of what is drawn: the size times the scale.
std::array<int, 2> drawnSize(const PictureOptions& options);

/// What is wrong with options for print: an image of more pixels than a picture may have. The path is the key.
/// pointsPerPixel: of the paper.
std::vector<InputProblem> printConflictsIn(const PictureOptions& options, double pointsPerPixel = 1.0);

/// What options say that cannot be, each alone or two together, in a body of `dim` dimensions where these are
/// known: paths are keys. What the rules of single values say is left out.
std::vector<InputProblem> conflictsIn(const PictureOptions& options, std::optional<int> dim);

/// Fields of bodies, and their components.
inline std::vector<std::string> bodyFields() {
  std::vector<std::string> names{"displacement", "displacement.x", "displacement.y", "displacement.z"};
  for (std::string& name : materialComponentNames()) names.push_back(std::move(name));
  for (const char* name : {"von_mises", "stress.xx", "stress.yy", "stress.zz", "stress.xy", "stress.yz",
                           "stress.zx", "pressure"})
    names.emplace_back(name);
  return names;
}

/// What contour pictures show.
inline std::vector<std::string> drawableFields() {
  std::vector<std::string> names = bodyFields();
  for (std::string& name : contactFieldNames()) names.push_back(std::move(name));
  return names;
}

/// The field, of a picture that is asked for before there is a result.
template <class Visitor>
void describeField(Visitor& v, PictureOptions& s) {
  v.field("field", s.field, {.required = true, .choices = drawableFields()},
          "What is drawn; displacement alone is its magnitude.");
}

/// Ends of the colour scale.
template <class Visitor>
void describeRange(Visitor& v, PictureOptions& s) {
  v.field("range", s.range, {.increasing = true},
          "Smallest and greatest value of the colours; automatic when left out.");
}

/// Which bodies are drawn, and where their colours end.
template <class Visitor>
void describeBodies(Visitor& v, PictureOptions& s) {
  v.field("body", s.bodies, {}, "Names of the bodies that are drawn; all when left out.");
  v.field("clip", s.clip, {.above = kLowestPercentile, .atMost = 100},
          "Percentile of the values at which the colours end; single peaks then do not hide the rest.");
}

/// How tools and displacements are drawn.
template <class Visitor>
void describeMotion(Visitor& v, PictureOptions& s) {
  v.field("tool_opacity", s.toolOpacity, {.above = 0, .atMost = 1},
          "Of the tools in space; 1 hides what is behind.");
  v.field("warp", s.warp, {}, "Factor on the displacements of body and tools; values keep theirs.");
}

/// What is drawn of the body and the tools.
template <class Visitor>
void describeParts(Visitor& v, PictureOptions& s) {
  describeBodies(v, s);
  v.field(
      "vectors", s.arrows, {},
      "Draw arrows: displacement, the field that is drawn if it is a vector, or traction, what tools do to the "
      "body where they touch it; or crosses of the principal stresses; or lines along the displacement.");
  v.field("mark_extremes", s.markExtremes, {}, "Mark where the field is smallest and where it is largest.");
  v.field("control_net", s.controlNet, {}, "Draw the control points and the lines between them.");
  v.field("scale_bar", s.scaleBar, {}, "Draw a line of a round length, which stands beside it.");
  v.field(
      "threshold", s.threshold, {},
      "LO,HI, or FIELD=LO,HI: only the part of the body where the field that is drawn, or this one, lies between; "
      "one of the two may be left out.");
  v.field("isosurfaces", s.isosurfaces, {},
          "Surfaces of equal value in a body in space, instead of it: their number, or FIELD=V,V,... (3D).");
  describeMotion(v, s);
  v.field("hidden_lines", s.hiddenLines, {},
          "Edges of body and tools that lie behind surfaces: off, or dashed (3D).");
  v.field("subdivision", s.subdivision, {.atLeast = 1, .atMost = 64},
          "Cells per knot span and direction, instead of what an exact picture takes.");
}

/// From where the body is seen, and how much of it.
template <class Visitor>
void describeEye(Visitor& v, PictureOptions& s) {
  v.field("view", s.view, {},
          "auto, iso, xy, xz or yz, or X,Y,Z: the direction towards the eye; auto shows a plane body in its "
          "plane.");
  v.field("zoom", s.window, {},
          "X0,Y0,X1,Y1: corners of what is seen, in the plane of the view: coordinates of a plane body; "
          "everything when left out.");
}

template <class Visitor>
void describeMirror(Visitor& v, PictureOptions& s) {
  v.field("mirror", s.mirror, {},
          "Planes of symmetry, x, or x,z=V where one is not at 0; the images of the body beyond them are "
          "drawn too. Of an axisymmetric body, x is the axis.");
}

/// The same with planes that cut and mirror.
template <class Visitor>
void describeView(Visitor& v, PictureOptions& s) {
  describeEye(v, s);
  v.field(
      "perspective", s.perspective, {.atLeast = 1, .atMost = 120},
      "Angle in degrees under which the longer side of the body is seen; a parallel projection when left out "
      "(3D).");
  v.field("cut", s.cut, {},
          "Plane, x=V, y=V or z=V, or X,Y,Z,NX,NY,NZ: a point and a normal; what is on the eye's side of it "
          "is left out (3D).");
  v.field("slice", s.slice, {}, "Plane, given like that of cut; only the section is drawn (3D).");
  v.field("cut_face", s.cutFace, {}, "What the section shows: the field, or a hatch (3D).");
  describeMirror(v, s);
}

/// How the picture looks. The theme is read first: what the picture does not state is the theme's.
template <class Visitor>
void describeLook(Visitor& v, PictureOptions& s) {
  describe(v, static_cast<PageLook&>(s));
  if constexpr (Fills<Visitor>) static_cast<PictureDefaults&>(s) = s.theme.picture;
  describe(v, static_cast<PictureDefaults&>(s));
  v.field("background", s.background, {},
          "Colour of the paper: #rrggbb in quotes, or a basic name of CSS; that of the theme when left out.");
  v.field("transparent", s.transparent, {}, "No paper: what is behind the picture shows through.");
}

/// The size, by the key that the door has for it.
template <class Visitor>
void describeSize(Visitor& v, PictureOptions& s, const char* key) {
  static_assert(kSmallestPicture == std::array{200, 150});
  v.field(key, s.size, {.above = 0, .atMost = kLargestSide},
          "Width and height in pixels, 200 x 150 or more.");
}

template <class Visitor>
void describeTextSize(Visitor& v, PictureOptions& s) {
  v.field("text_size", s.textSize, {.atLeast = kSmallestTextSize, .atMost = 200},
          "Height of the font in pixels; follows from the size when left out.");
}

/// All but field and range, for which the command has words of its own.
template <class Visitor>
void describe(Visitor& v, PictureOptions& s) {
  describeParts(v, s);
  describeView(v, s);
  describeLook(v, s);
  describeSize(v, s, "size");
  describeTextSize(v, s);
  v.field("scale", s.scale, {.atLeast = 0.25, .atMost = 10},
          "Factor on the size with all texts and lines: 2 for a screen of high density.");
  v.field("title", s.title, {.longest = kLongestShownText},
          "Title of the picture, empty for none; that of the scene when left out.");
}

/// The part of the options that a picture in a sheet or on a page has: it leaves size and texts to its place.
struct PanelOptions : PictureOptions {};

template <class Visitor>
void describe(Visitor& v, PanelOptions& s) {
  describeRange(v, s);
  describeParts(v, s);
  describeView(v, s);
  describeLook(v, s);
}

}  // namespace burnish
