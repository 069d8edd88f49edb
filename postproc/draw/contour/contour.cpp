#include "postproc/draw/contour/contour.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkActor.h>
#include <vtkContourFilter.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/schema/rule_check.h"
#include "postproc/draw/contour/axes_triad.h"
#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/contour_layout.h"
#include "postproc/draw/contour/contour_parts.h"
#include "postproc/draw/contour/contour_subject.h"
#include "postproc/draw/contour/contour_transparency.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/draw/contour/field_colors.h"
#include "postproc/draw/contour/gaps.h"
#include "postproc/draw/contour/hatch.h"
#include "postproc/draw/contour/length_axes.h"
#include "postproc/draw/contour/occlusion.h"
#include "postproc/draw/contour/page_lines.h"
#include "postproc/draw/contour/peeling_renderer.h"
#include "postproc/draw/contour/place_marks.h"
#include "postproc/draw/contour/scalar_bar.h"
#include "postproc/draw/contour/scale_bar.h"
#include "postproc/draw/contour/seen_lines.h"
#include "postproc/draw/contour/shape_lines.h"
#include "postproc/draw/contour/shown_model.h"
#include "postproc/draw/contour/space_actors.h"
#include "postproc/draw/contour/tool_drawing.h"
#include "postproc/draw/contour/value_parts.h"
#include "postproc/draw/page/flat_shapes.h"
#include "postproc/draw/page/overlay.h"
#include "postproc/draw/page/painted_sketch.h"
#include "postproc/draw/page/picture_warnings.h"
#include "postproc/draw/page/png_file.h"
#include "postproc/draw/page/print_file.h"
#include "postproc/mesh/poly_builder.h"
#include "postproc/offscreen/offscreen_canvas.h"
#include "postproc/text/ticks.h"

namespace burnish {
namespace {

/// Width of contact faces in the plane, over that of outlines.
constexpr double kFaceWidth = 6.0;

/// Width of the edges of arrows, over that of outlines.
constexpr double kArrowEdge = 0.5;

constexpr double kToolLine = 1.2;  // width of the lines of tools, over that of outlines

constexpr double kBreakWidth = 0.7;  // of a line where a tool is cut off, over that of outlines

constexpr double kHalo = 3.0;  // width of what is white below a line, over its own

constexpr double kPaleMark = 0.4;  // opacity of a mark behind something

constexpr double kGhost = 0.1;  // opacity of a body of which a part alone is drawn

constexpr Color kWhite{255, 255, 255}, kBlack{0, 0, 0};

/// Order in which things lie over each other in a flat picture; in space where they lie at the same place.
enum Layer {
  kToolFill,
  kPlainBody,
  kBody,
  kIsolines,
  kKnots,
  kNet,
  kUndeformed,
  kBodyOutline,
  kToolLines,
  kContactFaces,
  kArrows
};

/// Throws `Error` for the first thing that is wrong.
void throwFirst(const std::vector<InputProblem>& problems) {
  if (!problems.empty()) throw Error(fmt::format("{}: {}", problems.front().path, problems.front().text));
}

void check(const PictureOptions& options, int dim) {
  throwFirst(conflictsIn(options, dim));
  throwFirst(ruleProblems(options));
  throwFirst(ruleProblems<PrintOptions>(options));
}

/// The notes that there are, in one line.
std::string joined(const std::vector<std::string>& notes) {
  std::string line;
  for (const std::string& note : notes)
    if (!note.empty()) line += (line.empty() ? "" : "; ") + note;
  return line;
}

/// Of ordinary text, in pixels of what is drawn.
double textSizeOf(const ContourOptions& options, const Theme& theme) {
  return options.scale * options.textSize.value_or(theme.textSize * textSizeFor(options.size));
}

/// ownRange: whether the colours are laid round the values of this picture alone.
/// gaps: the colour of what has no value, if there is such a place.
ScalarBar scalarBarOf(const FieldChoice& field, const ColorScale& scale, const std::array<double, 2>& values,
                      double textSize, const Theme& theme, int bands, const std::optional<SharedRoom>& room,
                      bool marked, bool ownRange, const std::optional<Color>& gaps) {
  const bool isConstant = isOneValue(values) && scale.range()[1] == widened(values)[1] && ownRange;
  return {scale,
          {field.title, field.unit, values[0], values[1], field.states,
           room ? room->extremes : std::vector<std::array<double, 2>>(), room && room->otherRanges,
           room ? room->arrows : std::array<bool, 2>(), marked, bands, isConstant, gaps, room && room->gaps},
          textSize,
          theme};
}

/// A contour picture for print.
struct ContourPage {
  PrintPage page;
  View view;
};

/// Makes one picture, part by part.
class ContourPicture {
 public:
  ContourPicture(const ContourSubject& subject, const ContourOptions& options)
      : subject_(subject),
        options_(options),
        theme_(themeOf(options)),
        size_(drawnSize(options)),
        textSize_(textSizeOf(options, theme_)),
        field_(subject.field),
        parts_(subject.parts),
        cutsBody_(options.window && !options.window->contains(bodiesBox(parts_))),
        hasGaps_(hasGaps(parts_)) {}

  ContourImage draw() {
    const Plan plan = makePlan(1.0);
    const View& view = plan.layout.view;
    prepare(plan, view);
    return {onPaper([&](const Color& paper) { return capture(paper, plan); }), view};
  }

  /// The same for print: surfaces as an image, what is drawn over them as vectors.
  ContourPage page() {
    const Plan plan = makePlan(dotsPerPixel());
    const View& view = plan.layout.view;
    View fine = view;
    fine.pixelsPerLength *= dotsPerPoint(options_);
    fine.area.width *= dotsPerPoint(options_);
    fine.area.height *= dotsPerPoint(options_);
    prepare(plan, fine);
    const PixelRect area = shadow_ && !cutsBody_ ? wholePicture(view, size_).area : view.area;
    const std::array<int, 2> pixels = pixelsFor(area);
    const double scale = pixels[0] / area.width, scaleUp = pixels[1] / area.height;
    View printed = view;
    printed.area = {scale * (view.area.x - area.x), scaleUp * (view.area.y - area.y), scale * view.area.width,
                    scaleUp * view.area.height};
    printed.pixelsPerLength *= scale;

    PrintPage page{
        {static_cast<double>(size_[0]), static_cast<double>(size_[1])}, title(), {}, options_.pointsPerPixel};
    std::vector<PageSketch::Shape>& shapes = page.sketch.shapes;
    if (!options_.transparent && theme_.paper != kWhite)
      shapes.emplace_back(wholePage(page.size, theme_.paper));
    if (options_.printField == PrintField::Vector)
      addRegions(page.sketch, plan);
    else
      shapes.emplace_back(PageImage{
          area, onPaper([&](const Color& paper) { return captureSpace(paper, printed, pixels, plan); })});
    for (const PageSketch& over : {spaceLines(plan), texts(plan)})
      shapes.insert(shapes.end(), over.shapes.begin(), over.shapes.end());
    return {std::move(page), view};
  }

 private:
  /// What a picture shows where.
  struct Plan {
    ColorScale scale;
    ScalarBar bar;
    ContourLayout layout;
    std::vector<ToolDrawing> tools{};
  };

  /// Makes the parts exact in a view, and leaves of them what is chosen.
  void prepare(const Plan& plan, const View& view) {
    if (subject_.refine) subject_.refine(parts_, view, plan.scale.range());
    if (subject_.choose) subject_.choose(parts_, plan.scale.range());
    if (subject_.chosenRange && parts_.body->GetNumberOfPolys() == 0 &&
        !(parts_.section && parts_.section->GetNumberOfPolys() > 0))
      noteWarning(nothingChosen(options_, field_, subject_.time, subject_.chosenRange()));
    light(plan);
    body_ = partsByValue(*parts_.body);
    if (parts_.section) section_ = partsByValue(*parts_.section);
  }

  /// Throws `Error` for a window in which nothing lies.
  void requireSomethingSeen(const Eigen::AlignedBox2d& content) const {
    if (!options_.window || options_.window->intersects(content)) return;
    const auto words = [](const Eigen::AlignedBox2d& box) {
      return fmt::format("{:.6g},{:.6g}", fmt::join(box.min(), ","), fmt::join(box.max(), ","));
    };
    throw Error(
        fmt::format("zoom: found {}, where there is nothing to be seen; bodies and tools lie within {}",
                    words(*options_.window), words(content)));
  }

  /// dots: of what is drawn per pixel of the picture, to which tools are exact.
  Plan makePlan(double dots) const {
    const Eigen::AlignedBox2d content = contentOf(parts_, subject_.dim);
    requireSomethingSeen(content);
    Plan plan = layOut(content, textSize_);
    if (options_.textSize && !plan.layout.hasRoom) requireSmallerTexts(content);
    plan.layout.view.eye = parts_.eye;
    for (const ShownTool& tool : parts_.tools) plan.tools.push_back(drawTool(tool, plan.layout.view, dots));
    return plan;
  }

  /// With texts of a size, in pixels of what is drawn; without tools.
  Plan layOut(const Eigen::AlignedBox2d& content, double textSize) const {
    const std::array<double, 2>& whole = subject_.ranges.whole;
    const std::array<double, 2> shown = options_.range.value_or(subject_.ranges.shown);
    const ColorScale scale = colorScaleOf(field_, options_, shown);
    const ScalarBar bar =
        scalarBarOf(field_, scale, whole, textSize, theme_, options_.bands, options_.room, marksExtremes(),
                    !sharesRange(), hasGaps_ ? std::optional(plainColor()) : std::nullopt);
    return {scale, bar,
            layOutContour(size_, textSize, options_.window.value_or(content), parts_.axes,
                          caption(scale, options_.clip && shown != whole),
                          options_.colorScale ? &bar : nullptr, theme_)};
  }

  /// Whether the range of colours is that of pictures with other values.
  bool sharesRange() const {
    return options_.range && options_.room &&
           std::ranges::any_of(options_.room->extremes,
                               [&](const std::array<double, 2>& of) { return of != subject_.ranges.whole; });
  }

  /// Throws `Error` with the largest size of texts that leaves room, if there is one.
  void requireSmallerTexts(const Eigen::AlignedBox2d& content) const {
    for (double size = std::ceil(*options_.textSize) - 1.0; size >= kSmallestTextSize; --size)
      if (layOut(content, options_.scale * size).layout.hasRoom)
        throw Error(fmt::format(
            "text_size: found {:.6g}, of which a picture of {} x {} has no room for the body and the "
            "numbers of its scale; the largest that fits is {:.6g}",
            *options_.textSize, options_.size[0], options_.size[1], size));
  }

  /// What light falls on bodies in space.
  void light(const Plan& plan) {
    if (!options_.occlusion || isFlat()) return;
    Occlusion occlusion(parts_, plan.tools, options_.toolOpacity);
    // Surfaces of equal value lie within one another, where little of the sky is seen: all would be dark.
    occlusion.setSky(!options_.isosurfaces);
    shadow_ = occlusion.groundShadow();
    if (shadow_ && !cutsBody_) fadeAtBorder(*shadow_, wholePicture(plan.layout.view, size_));
  }

  /// What `draw` draws on a paper, or without paper.
  template <class Draw>
  vtkSmartPointer<vtkImageData> onPaper(const Draw& draw) const {
    return options_.transparent ? withoutPaper(*draw(kWhite), *draw(kBlack)) : draw(theme_.paper);
  }

  /// Of a page for print per pixel of the picture: of its image, or of vectors, which are exact to these.
  double dotsPerPixel() const {
    constexpr double kOfVectors = 4.0;  // per point
    return options_.pointsPerPixel *
           (options_.printField == PrintField::Vector ? kOfVectors : dotsPerPoint(options_));
  }

  /// Of the image in a part of a page.
  std::array<int, 2> pixelsFor(const PixelRect& area) const {
    const auto count = [&](double length) {
      return std::max(1, static_cast<int>(std::lround(dotsPerPixel() * length)));
    };
    return {count(area.width), count(area.height)};
  }

  std::string title() const { return options_.title.value_or(subject_.title); }

  ContourCaption caption(const ColorScale& scale, bool clipped) const {
    return {title(),
            options_.time && subject_.time ? fmt::format("t = {:.6g}", *subject_.time) : "",
            joined({options_.warp == 1.0 ? "" : fmt::format("displacements × {:.6g}", options_.warp),
                    parts_.arrows.note, sectionNote(), extremesNote(), plainNote(), gapsNote(), subject_.note,
                    subject_.choiceNote ? subject_.choiceNote(scale.range()) : "", options_.note,
                    clipped ? clipNote(*options_.clip,
                                       options_.ofOthers ? std::nullopt : std::optional(subject_.dim))
                            : ""}),
            options_.doubt,
            subject_.dim == 3,
            options_.scaleBar,
            options_.room && options_.room->note,
            options_.room && options_.room->doubt,
            options_.lengthAxes ? lengthAxesRoom(textSize_, theme_) : Eigen::Vector2d(0.0, 0.0)};
  }

  /// Whether the values at the ends of the scale have signs. What is the same everywhere has a note instead of places,
  /// so that a picture of it is laid out as others of its series.
  bool marksExtremes() const { return options_.markExtremes && field_.states.empty(); }

  std::string extremesNote() const {
    if (!marksExtremes()) return "";
    if (!parts_.extremes) return "the same value everywhere";
    return extremeNote(
        *parts_.extremes, [&](const Eigen::Vector3d& place) { return isSeen(parts_, options_, place); },
        subject_.dim, lengthOf(parts_));
  }

  /// Of bodies that do not have the field.
  std::string plainNote() const {
    return subject_.without.empty() ? ""
                                    : fmt::format("{} without values", fmt::join(subject_.without, ", "));
  }

  /// Where no colour scale says it.
  std::string gapsNote() const { return hasGaps_ && !options_.colorScale ? "grey: no value" : ""; }

  /// Between tools and paper, so that a body without colours is not taken for a tool.
  Color plainColor() const {
    Color color = theme_.tool;
    for (std::size_t k = 0; k < color.size(); ++k) color[k] = std::midpoint(color[k], theme_.paper[k]);
    return color;
  }

  /// Where the section of a slice lies; a cut is seen to be one.
  std::string sectionNote() const {
    if (!options_.slice) return "";
    const Eigen::Vector3d normal = options_.slice->normal.normalized(), &point = options_.slice->point;
    for (Eigen::Index d = 0; d < 3; ++d)
      if (std::abs(normal(d)) > 1.0 - 1e-12)
        return fmt::format("section {} = {}", "xyz"[d], numberText(point(d), 6));
    return fmt::format("section through ({:.6g}) across ({:.3g})", fmt::join(point, ", "),
                       fmt::join(normal, ", "));
  }

  vtkSmartPointer<vtkImageData> capture(const Color& background, const Plan& plan) const {
    const ContourLayout& layout = plan.layout;
    OffscreenCanvas canvas(size_[0], size_[1]);
    vtkNew<PeelingRenderer> paper, space;
    addLayers(canvas, background, *paper, *space, layout.view, size_);
    paint(texts(plan), *paper, canvas.supersampling());
    drawSpace(*space, canvas.supersampling(), plan, Shown::Everything);
    aim(*space, layout.view, size_, eyeDistance());
    return canvas.capture();
  }

  /// The paper below and space above it; the shadow on the ground fades out beside the body, where space ends, unless
  /// the picture is of a part of the body.
  void addLayers(OffscreenCanvas& canvas, const Color& background, PeelingRenderer& paper,
                 PeelingRenderer& space, const View& view, const std::array<int, 2>& pixels) const {
    paper.blendInOrder();
    if (isFlat()) space.blendInOrder();
    canvas.window().SetNumberOfLayers(2);
    canvas.window().AddRenderer(&paper);
    canvas.window().AddRenderer(&space);
    space.SetLayer(1);
    paper.SetBackground(background[0] / 255.0, background[1] / 255.0, background[2] / 255.0);
    if (!shadow_) return;
    (cutsBody_ ? space : paper).AddActor(shadowActor(*shadow_));
    if (!cutsBody_) aim(paper, wholePicture(view, pixels), pixels, eyeDistance());
  }

  /// The same projection, to the edges of a picture of this size.
  static View wholePicture(View view, const std::array<int, 2>& size) {
    const PixelRect all{0.0, 0.0, static_cast<double>(size[0]), static_cast<double>(size[1])};
    view.center += (all.center() - view.area.center()) / view.pixelsPerLength;
    view.area = all;
    return view;
  }

  /// The image of space alone, in the pixels of print.
  vtkSmartPointer<vtkImageData> captureSpace(const Color& background, const View& printed,
                                             const std::array<int, 2>& pixels, const Plan& plan) const {
    OffscreenCanvas canvas(pixels[0], pixels[1]);
    vtkNew<PeelingRenderer> paper, space;
    addLayers(canvas, background, *paper, *space, printed, pixels);
    drawSpace(*space, canvas.supersampling() * dotsPerPixel(), plan, Shown::Areas);
    aim(*space, printed, pixels, eyeDistance());
    return canvas.capture();
  }

  /// See `aim`.
  double eyeDistance() const { return 10.0 * lengthOf(parts_); }

  /// What lies over the surfaces, as vectors.
  PageSketch spaceLines(const Plan& plan) const {
    PageSketch sketch;
    const auto add = [&](auto&& shapes) {
      for (auto& shape : shapes) sketch.shapes.emplace_back(std::move(shape));
    };
    const View& view = plan.layout.view;
    std::unique_ptr<SeenLines> seen;
    if (!isFlat()) seen = seenLines(plan);
    if (seen && options_.hiddenLines == HiddenLines::Dashed)
      for (const HiddenLine& line : hiddenLines(plan, *seen))
        for (const DashLook& look : dashLooks(line.width))
          sketch.shapes.emplace_back(pageDashes(*line.lines, view, look.color, look.width, look.dashes));
    for (const SpaceLines& part : allLines(plan)) {
      if (!seen)
        sketch.shapes.emplace_back(part.isDots
                                       ? pageDots(*part.lines, view, part.color, part.width)
                                       : pageLines(*part.lines, view, part.color, part.width, part.opacity));
      else if (part.isDots)
        add(pageDots(*part.lines, view, part.color, part.width, *seen, liftOf(part, view)));
      else
        add(pageLines(*part.lines, view, part.color, part.width, part.opacity, *seen, liftOf(part, view)));
    }
    if (isOfContact() && isFlat())
      add(coloredPageLines(*body_.with, view, plan.scale, kFaceWidth * lineWidth()));
    if (parts_.arrows.areas)
      addPageAreas(sketch, *parts_.arrows.edges, view, kWhite, kBlack, kArrowEdge * lineWidth());
    if (parts_.arrows.darkAreas)
      addPageAreas(sketch, *parts_.arrows.darkEdges, view, kBlack, kWhite, kArrowEdge * lineWidth());
    addPageMarks(sketch, view, seen.get());
    return sketch;
  }

  /// The marks of `drawMarks` as vectors; seen: null in a flat picture.
  void addPageMarks(PageSketch& sketch, const View& view, const SeenLines* seen) const {
    const double line = lineWidth(), above = markSize() / view.pixelsPerLength;
    const auto addPale = [&](vtkPolyData& edges) {
      if (seen == nullptr) return;
      sketch.shapes.emplace_back(pageLines(edges, view, kWhite, kHalo * line, kPaleMark));
      sketch.shapes.emplace_back(pageLines(edges, view, kBlack, line, kPaleMark));
    };
    if (parts_.extremes) {
      const ExtremeMarks marks = extremesIn(view);
      addPale(*marks.edges);
      addPageAreas(sketch, seen != nullptr ? *seenLoops(*marks.edges, *seen, above) : *marks.edges, view,
                   kWhite, kBlack, line);
    }
    if (!parts_.mark) return;
    const auto ring = ringIn(view);
    addPale(*ring);
    for (const auto& [color, width] : {std::pair(kWhite, kHalo * line), std::pair(kBlack, line)}) {
      if (seen == nullptr) {
        sketch.shapes.emplace_back(pageLines(*ring, view, color, width, 1.0));
        continue;
      }
      for (PageLines& part : pageLines(*ring, view, color, width, 1.0, *seen, above))
        sketch.shapes.emplace_back(std::move(part));
    }
  }

  /// The areas of a plane picture as vectors.
  void addRegions(PageSketch& sketch, const Plan& plan) const {
    const View& view = plan.layout.view;
    const auto add = [&](PageRegion region) { sketch.shapes.emplace_back(std::move(region)); };
    for (const ToolDrawing& tool : plan.tools)
      if (tool.area) add(pageRegion(*tool.area, view, theme_.tool));
    if (!isOfContact())
      for (PageRegion& band : coloredPageRegions(*body_.with, view, plan.scale,
                                                 options_.bands > 0 ? options_.bands : kVectorBands))
        add(std::move(band));
    for (const auto& part : {isOfContact() ? nullptr : body_.without, parts_.plain})
      if (part) add(pageRegion(*part, view, plainColor()));
  }

  /// All that is no picture of space: texts, the colour scale, the frame, the axes.
  PageSketch texts(const Plan& plan) const {
    const ContourLayout& layout = plan.layout;
    const ScalarBar& bar = plan.bar;
    PageSketch sketch;
    Overlay overlay(sketch);
    if (!layout.title.text.empty()) overlay.addText(layout.title.text, layout.titleAt, layout.title.style);
    if (!layout.time.text.empty()) overlay.addText(layout.time.text, layout.timeAt, layout.time.style);
    Eigen::Vector2d noteAt = layout.noteAt;
    for (const FittedText& line : layout.note) {
      overlay.addText(
          line.text, noteAt, line.style,
          layout.barDirection == Overlay::Direction::Up ? Overlay::Anchor::End : Overlay::Anchor::Middle);
      noteAt.y() -= layout.noteLine;
    }
    if (!layout.doubt.text.empty()) overlay.addText(layout.doubt.text, layout.doubtAt, layout.doubt.style);
    FlatShapes shapes(sketch);
    if (options_.colorScale) bar.draw(overlay, shapes, layout.bar, layout.barDirection);
    if (cutsBody_) drawFrame(shapes, layout.view.area);
    for (const std::vector<Eigen::Vector2d>& line : toolBreaks(plan))
      shapes.addPolyline(line, kBreakWidth * lineWidth(), theme_.outline);
    if (options_.scaleBar)
      drawScaleBar(shapes, overlay, layout.view, layout.scaleBarAt, subject_.lengthUnit, textSize_, theme_);
    if (options_.lengthAxes)
      drawLengthAxes(shapes, overlay, layout.view, bodiesBox(parts_), subject_.lengthUnit, textSize_, theme_);
    if (subject_.dim == 3) drawAxesTriad(shapes, overlay, parts_.axes, layout.triadAt, textSize_, theme_);
    return sketch;
  }

  /// Round a part of the body, whose edges are not those of the body.
  void drawFrame(FlatShapes& shapes, const PixelRect& area) const {
    const double left = area.x - 0.5, right = area.right() + 0.5, low = area.y - 0.5, top = area.top() + 0.5;
    shapes.addPolyline({{left, low}, {right, low}, {right, top}, {left, top}, {left, low}},
                       std::max(1.0, textSize_ / 24.0), theme_.softInk);
  }

  /// Whether what is drawn lies in a plane.
  bool isFlat() const { return subject_.dim == 2 || options_.slice; }

  bool isOfContact() const { return field_.faces != nullptr; }

  /// Of outlines, in pixels of the picture.
  double lineWidth() const { return std::max(0.8, textSize_ / 16.0); }

  /// Lines of one look.
  struct SpaceLines {
    vtkSmartPointer<vtkPolyData> lines;
    Color color;
    double width;  ///< in pixels of the picture
    Layer layer;
    double opacity = 1.0;
    bool isDots = false;  ///< its points alone, as wide as this
    double lift = 0.0;    ///< towards the eye beside that of the layer, in lengths of the bodies
  };

  /// From the back to the front, without tools.
  std::vector<SpaceLines> bodyLines(const Plan& plan) const {
    constexpr double kGhostOpacity = 0.3, kHatch = 0.5;  // the distance of hatches, in heights of the text
    const double line = lineWidth();
    const View& view = plan.layout.view;
    std::vector<SpaceLines> all;
    for (const auto& section : {hatchesSection() ? parts_.section : nullptr, parts_.plainSection})
      if (section)
        all.push_back({hatchOf(*section, view, kHatch * textSize_), theme_.outline, 0.5 * line, kIsolines});
    if (parts_.ghostOutline)
      all.push_back({parts_.ghostOutline, theme_.outline, line, kUndeformed, kGhostOpacity});
    if (parts_.ghost && !isFlat())
      all.push_back({silhouetteOf(*parts_.ghost, view), theme_.outline, line, kUndeformed, kGhostOpacity});
    for (const auto& part : {body_.with, hatchesSection() ? nullptr : section_.with})
      if (part && !drawsOwnIsosurfaces(options_))
        for (const Color& color : {theme_.outline, theme_.paper})
          if (const std::vector<double> values = isolineValues(plan.scale, color); !values.empty())
            all.push_back({isolines(*part, values), color, 0.7 * line, kIsolines});
    if (parts_.knots) all.push_back({parts_.knots, theme_.knots, 0.5 * line, kKnots, 0.5});
    if (parts_.net) {
      all.push_back({parts_.net, theme_.controlNet, 0.6 * line, kNet});
      all.push_back({parts_.net, theme_.controlNet, 4.0 * line, kNet, 1.0, true});
    }
    if (parts_.undeformed) all.push_back(undeformedLines(plan));
    all.push_back({parts_.outline, theme_.outline, line, kBodyOutline});
    for (const auto& part : {parts_.body, parts_.plain})
      if (part && !isFlat() && !(isOfContact() && part == parts_.body))
        all.push_back({silhouetteOf(*part, view), theme_.outline, line, kBodyOutline});
    return all;
  }

  /// In space lines are hidden by those that lie before them: of one that has hardly moved only the other one is drawn, and
  /// one that has moved lies over faces that have bulged a little since, which would leave fragments of it. It does not lie over
  /// sections of tools, which nothing stands before.
  SpaceLines undeformedLines(const Plan& plan) const {
    const View& view = plan.layout.view;
    constexpr double kOverFaces = 0.016;
    const double line = lineWidth();
    SpaceLines lines{parts_.undeformed, theme_.undeformed, 0.8 * line, kUndeformed};
    if (isFlat() || !hasMotion(*parts_.undeformed)) return lines;
    lines.lines = movedLines(*parts_.undeformed, view, 1.5 * line);
    lines.lift = kOverFaces;
    std::vector<vtkSmartPointer<vtkPolyData>> sections;
    for (const ToolDrawing& tool : plan.tools)
      if (tool.area) sections.push_back(tool.area);
    if (!sections.empty()) lines.lines = besideSurfaces(*lines.lines, sections, view);
    return lines;
  }

  /// Later ones over earlier ones at the same place.
  std::vector<SpaceLines> allLines(const Plan& plan) const {
    std::vector<SpaceLines> all = bodyLines(plan);
    for (const ToolDrawing& tool : plan.tools)
      if (tool.lines) all.push_back({tool.lines, theme_.outline, kToolLine * lineWidth(), kToolLines});
    std::ranges::stable_sort(all, {}, [&](const SpaceLines& part) { return liftOf(part, plan.layout.view); });
    return all;
  }

  /// What of lines in space is seen behind the surfaces.
  std::unique_ptr<SeenLines> seenLines(const Plan& plan) const {
    const View& view = plan.layout.view;
    std::vector<HidingSurface> hiding;
    for (const SpaceSurface& surface : surfaces(plan))
      hiding.push_back({surface.shape, liftOf(surface.layer, view), surface.opacity});
    return std::make_unique<SeenLines>(hiding, view);
  }

  /// With `kWayAlong`, where edges are hidden.
  struct HiddenLine {
    vtkSmartPointer<vtkPolyData> lines;
    double width;  ///< in pixels of the picture
  };

  std::vector<HiddenLine> hiddenLines(const Plan& plan, const SeenLines& seen) const {
    const View& view = plan.layout.view;
    std::vector<HiddenLine> all;
    for (const SpaceLines& part : allLines(plan)) {
      if (part.lines != parts_.outline && part.layer != kToolLines) continue;
      const auto hidden = seen.hiddenOf(*inFewPieces(*part.lines), liftOf(part, view), part.width);
      if (hidden->GetNumberOfLines() > 0) all.push_back({withWayAlong(*hidden, view), part.width});
    }
    return all;
  }

  /// One over the other: light beside the dark, which is seen on every colour.
  struct DashLook {
    Color color;
    double width;  ///< in pixels of the picture
    Dashes dashes;
  };
  std::array<DashLook, 2> dashLooks(double width) const {
    const double length = 0.5 * textSize_, share = 0.55;
    return {DashLook{theme_.paper, 1.9 * width, {length, share, 0.5, 0}},
            DashLook{theme_.outline, width, {length, share, 0.6, 1}}};
  }

  /// Where a plane picture ends within a tool, in pixels; none where a frame says it.
  std::vector<std::vector<Eigen::Vector2d>> toolBreaks(const Plan& plan) const {
    constexpr double kZigzag = 1.0;  // of the text
    if (!isFlat() || cutsBody_) return {};
    return breakLines(plan.tools, plan.layout.view, kZigzag * textSize_);
  }

  /// Their halves over the areas of the tools.
  void drawToolBreaks(vtkRenderer& renderer, double scale, const Plan& plan) const {
    const View& view = plan.layout.view;
    const double depth = view.towardsEye().dot(parts_.box.center());
    PolyBuilder builder;
    for (const std::vector<Eigen::Vector2d>& line : toolBreaks(plan)) {
      Eigen::Matrix3Xd points(3, std::ssize(line));
      for (std::size_t k = 0; k < line.size(); ++k)
        points.col(static_cast<Eigen::Index>(k)) =
            view.axes.transpose() * (view.center + (line[k] - view.area.center()) / view.pixelsPerLength) +
            depth * view.towardsEye();
      builder.addLine(builder.addPoints(points));
    }
    addLifted(renderer, lineActor(*builder.finish(), theme_.outline, kBreakWidth * scale * lineWidth(), 1.0),
              view, liftOf(kToolLines, view));
  }

  /// A surface as it is drawn.
  struct SpaceSurface {
    vtkSmartPointer<vtkPolyData> shape;
    vtkSmartPointer<vtkActor> actor;
    Layer layer;
    double opacity = 1.0;  ///< to lines behind it
  };

  std::vector<SpaceSurface> surfaces(const Plan& plan) const {
    std::vector<SpaceSurface> all;
    const auto addPlain = [&](const vtkSmartPointer<vtkPolyData>& shape, const Color& color, bool shaded,
                              Layer layer, double opacity = 1.0) {
      if (shape) all.push_back({shape, plainActor(*shape, color, shaded, opacity), layer, opacity});
    };
    if (!isOfContact() || !isFlat())
      all.push_back({body_.with, contourActor(*body_.with, plan.scale, !isFlat()),
                     isOfContact() ? kContactFaces : kBody});
    if (hatchesSection())
      addPlain(parts_.section, theme_.paper, false, kBody);
    else if (parts_.section)
      all.push_back({section_.with, contourActor(*section_.with, plan.scale, false), kBody});
    if (!isOfContact()) addPlain(body_.without, plainColor(), !isFlat(), kBody);
    if (!hatchesSection()) addPlain(section_.without, plainColor(), false, kBody);
    if (parts_.ghost && !isFlat()) {
      const auto ghost = plainActor(*parts_.ghost, theme_.tool, true, kGhost);
      ghost->GetProperty()->FrontfaceCullingOn();  // so that nothing lies over the colours of what is left
      all.push_back({parts_.ghost, ghost, kBody, 0.0});
    }
    addPlain(parts_.plain, plainColor(), !isFlat(), kPlainBody);
    addPlain(parts_.plainSection, plainColor(), false, kPlainBody);
    for (const ToolDrawing& drawing : plan.tools) {
      addPlain(drawing.area, theme_.tool, false, kToolFill);
      addPlain(drawing.surface, theme_.tool, true, kToolFill, options_.toolOpacity);
    }
    return all;
  }

  /// What of space is drawn: for print its surfaces alone, where lines become vectors.
  enum class Shown { Everything, Areas };

  /// scale: pixels of the drawing per pixel of the picture.
  void drawSpace(vtkRenderer& renderer, double scale, const Plan& plan, Shown what) const {
    const View& view = plan.layout.view;
    const auto add = [&](const vtkSmartPointer<vtkActor>& actor, Layer layer) {
      addLifted(renderer, actor, view, liftOf(layer, view));
    };
    for (const SpaceSurface& surface : surfaces(plan)) add(surface.actor, surface.layer);
    if (isOfContact() && isFlat() && what == Shown::Everything)
      add(contourLineActor(*body_.with, plan.scale, kFaceWidth * scale * lineWidth()), kContactFaces);
    peelTools(renderer, plan);
    if (what == Shown::Areas) return;
    for (const SpaceLines& part : allLines(plan)) {
      const double width = scale * part.width;
      addLifted(renderer,
                part.isDots ? pointActor(*part.lines, part.color, width)
                            : lineActor(*part.lines, part.color, width, part.opacity),
                view, liftOf(part, view));
    }
    if (isFlat()) drawToolBreaks(renderer, scale, plan);
    if (options_.hiddenLines == HiddenLines::Dashed && !isFlat())
      for (const HiddenLine& line : hiddenLines(plan, *seenLines(plan)))
        for (const DashLook& look : dashLooks(line.width))
          renderer.AddActor(dashedActor(*line.lines, look.color, scale * look.width, look.dashes));
    const ContourArrows& arrows = parts_.arrows;
    if (arrows.areas) drawArrows(renderer, *arrows.areas, *arrows.edges, kWhite, scale * lineWidth(), view);
    if (arrows.darkAreas)
      drawArrows(renderer, *arrows.darkAreas, *arrows.darkEdges, kBlack, scale * lineWidth(), view);
    drawMarks(renderer, scale * lineWidth(), view);
  }

  /// Lets the two sides of every translucent tool be blended in their order.
  void peelTools(vtkRenderer& renderer, const Plan& plan) const {
    if (options_.toolOpacity == 1.0) return;
    const auto tools =
        std::ranges::count_if(plan.tools, [](const ToolDrawing& tool) { return tool.surface != nullptr; });
    renderer.SetUseDepthPeeling(tools > 0);
    renderer.SetMaximumNumberOfPeels(1 + static_cast<int>(tools));
  }

  void addLifted(vtkRenderer& renderer, const vtkSmartPointer<vtkActor>& actor, const View& view,
                 double length) const {
    lift(*actor, view, length, eyeDistance());
    renderer.AddActor(actor);
  }

  bool hatchesSection() const { return options_.cutFace == CutFace::Hatch && parts_.section; }

  /// Of signs at places, in pixels.
  double markSize() const { return 0.9 * textSize_; }

  ExtremeMarks extremesIn(const View& view) const {
    return extremeMarks(
        *parts_.extremes, [&](const Eigen::Vector3d& place) { return isSeen(parts_, options_, place); }, view,
        markSize());
  }

  vtkSmartPointer<vtkPolyData> ringIn(const View& view) const {
    return ringMark(*parts_.mark, view, 1.4 * markSize());
  }

  /// In front of everything; in space those that are behind something are pale.
  void drawMarks(vtkRenderer& renderer, double line, const View& view) const {
    constexpr double kInFront = 2.1;
    const double side = markSize() / view.pixelsPerLength;
    const double front = kInFront * lengthOf(parts_), above = isFlat() ? front : side;
    const auto add = [&](const vtkSmartPointer<vtkActor>& actor, double nearness) {
      addLifted(renderer, actor, view, nearness);
    };
    const auto addEdges = [&](vtkPolyData& edges) {
      add(lineActor(edges, kBlack, line, 1.0), above + 0.1 * side);
      if (isFlat()) return;
      add(lineActor(edges, kWhite, kHalo * line, kPaleMark), front);
      add(lineActor(edges, kBlack, line, kPaleMark), front + 0.1 * side);
    };
    if (parts_.extremes) {
      const ExtremeMarks marks = extremesIn(view);
      add(plainActor(*marks.areas, kWhite, false, 1.0), above);
      addEdges(*marks.edges);
    }
    if (parts_.mark) {
      const auto ring = ringIn(view);
      add(lineActor(*ring, kWhite, kHalo * line, 1.0), above);
      addEdges(*ring);
    }
  }

  /// How far towards the eye a layer is moved. In space lines come out of the facets on which they lie, but not
  /// through what is before them, and tools and faces in contact lie over the bodies in whose surface they are.
  double liftOf(Layer layer, const View& view) const {
    constexpr double kPixelsPerLayer = 0.5, kLiftOfTool = 0.01, kLiftOfFaces = 0.014;
    const auto order = static_cast<double>(layer);
    if (isFlat()) return order * lengthOf(parts_) / 100.0;
    double part = 0.0;
    if (layer == kToolFill || layer == kToolLines) part = kLiftOfTool;
    if (layer == kContactFaces) part = kLiftOfFaces;
    const double layers = layer == kToolFill ? 0.0 : order - static_cast<double>(kBody);
    return part * lengthOf(parts_) + kPixelsPerLayer * layers / view.pixelsPerLength;
  }

  double liftOf(const SpaceLines& part, const View& view) const {
    return liftOf(part.layer, view) + part.lift * lengthOf(parts_);
  }

  ToolDrawing drawTool(const ShownTool& tool, const View& view, double dots) const {
    const Eigen::AlignedBox3d visible = visibleBox(view);
    const double stroke = textSize_ * 0.6 / view.pixelsPerLength;
    const double error = 0.25 / (dots * view.pixelsPerLength);
    if (subject_.dim == 2) return drawPlaneTool(tool.record, visible, stroke, tool.turn, error);
    if (options_.slice) return drawToolSection(tool.record, visible, *parts_.plane, stroke, error);
    return drawSpaceTool(tool.record, visible, view, error, parts_.plane);
  }

  /// In front of everything: white with a dark edge or the other way round, which is seen on every colour.
  void drawArrows(vtkRenderer& renderer, vtkPolyData& arrows, vtkPolyData& around, const Color& color,
                  double line, const View& view) const {
    const auto areas = plainActor(arrows, color, false, 1.0);
    const auto edges = lineActor(around, color == kWhite ? kBlack : kWhite, kArrowEdge * line, 1.0);
    double nearness = isFlat() ? static_cast<double>(kArrows) / 100.0 : 2.0;
    for (const auto& actor : {areas, edges}) {
      addLifted(renderer, actor, view, nearness * lengthOf(parts_));
      nearness += 0.005;
    }
  }

  /// Of the isolines in this colour: that of outlines, or of the paper where those would hardly be seen.
  std::vector<double> isolineValues(const ColorScale& scale, const Color& color) const {
    constexpr double kSeen = 1.3;
    const auto [low, high] = scale.range();
    std::vector<double> values;
    if (isOneValue(subject_.ranges.whole)) return values;  // lines would be those of rounding
    for (int k = 0; k < options_.isolines; ++k) {
      const double value = std::lerp(low, high, (k + 1.0) / (options_.isolines + 1.0));
      const bool isSeen = contrastOf(theme_.outline, scale.color(value)) >= kSeen;
      if (color == (isSeen ? theme_.outline : theme_.paper)) values.push_back(value);
    }
    return values;
  }

  static vtkSmartPointer<vtkPolyData> isolines(vtkPolyData& part, const std::vector<double>& values) {
    vtkNew<vtkContourFilter> filter;
    filter->SetInputData(&part);
    for (std::size_t k = 0; k < values.size(); ++k) filter->SetValue(static_cast<int>(k), values[k]);
    filter->Update();
    return filter->GetOutput();
  }

  /// A box that covers all that is seen of the body.
  Eigen::AlignedBox3d visibleBox(const View& view) const {
    if (subject_.dim == 3) return parts_.box;
    const Eigen::Vector2d half =
        Eigen::Vector2d(view.area.width, view.area.height) / (2.0 * view.pixelsPerLength);
    Eigen::Vector3d low(0, 0, 0), high(0, 0, 0);
    low.head<2>() = view.center - half;
    high.head<2>() = view.center + half;
    return {low, high};
  }

  const ContourSubject& subject_;
  const ContourOptions& options_;
  Theme theme_;
  std::array<int, 2> size_;
  double textSize_;
  const FieldChoice& field_;
  ContourParts parts_;
  vtkSmartPointer<vtkPolyData> shadow_;  ///< on the ground; null without
  bool cutsBody_;                        ///< only a part of the body is seen
  bool hasGaps_;                         ///< the field has no value somewhere
  PartsByValue body_, section_;          ///< of the parts, once these are exact; null without one
};

ContourPage checkedPage(const ContourSubject& subject, const ContourOptions& options) {
  check(options, subject.dim);
  throwFirst(printConflictsIn(options, options.pointsPerPixel));
  return ContourPicture(subject, options).page();
}

/// Makes something of what a picture of a frame is of.
template <class Make>
auto ofSubject(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options,
               const Make& make) {
  check(options, model.dim);
  return withShownModel(model, frame, options, [&](const ModelRecord& shown, const FrameRecord& its) {
    FieldChoice field = chooseField(shown, its, options.field);
    dropRounding(field, options.largest);
    const ContourParts parts = contourParts(shown, its, field, options);
    const FieldRange ranges = fieldRanges(shown, its, field, subdivisionOf(shown, options), options.clip);
    ContourSubject subject{
        shown.dim, shown.title, its.time, field, ranges, parts, bodiesWithout(shown, its, options.field),
        "",        {}};
    subject.refine = [&](ContourParts& coarse, const View& view, const std::array<double, 2>& range) {
      refineForView(coarse, shown, its, field, options, view, range);
    };
    subject.lengthUnit = shown.lengthUnit;
    if (options.threshold || options.isosurfaces) {
      subject.choiceNote = [&](const std::array<double, 2>& range) {
        return choiceNote(options, choosingField(shown, its, field, options),
                          isOneValue(ranges.whole) ? std::nullopt : std::optional(range));
      };
      subject.chosenRange = [&] {
        const FieldChoice choosing = choosingField(shown, its, field, options);
        return fieldRanges(shown, its, choosing, subdivisionOf(shown, options), {}).whole;
      };
      if (shown.dim == 3)
        subject.choose = [&](ContourParts& whole, const std::array<double, 2>& range) {
          chooseInSpace(whole, shown, its, field, options,
                        isOneValue(ranges.whole) ? std::nullopt : std::optional(range));
        };
    }
    return make(subject);
  });
}

}  // namespace

ContourImage contourImage(const ContourSubject& subject, const ContourOptions& options) {
  check(options, subject.dim);
  return ContourPicture(subject, options).draw();
}

View drawContour(const ContourSubject& subject, const ContourOptions& options,
                 const std::filesystem::path& file) {
  if (!isPrintFile(file)) {
    const ContourImage image = contourImage(subject, options);
    writePng(*image.picture, file);
    return image.view;
  }
  const ContourPage printed = checkedPage(subject, options);
  writePrint(printed.page, file);
  return printed.view;
}

PrintPage contourPage(const ContourSubject& subject, const ContourOptions& options) {
  return checkedPage(subject, options).page;
}

ContourImage contourImage(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options) {
  return ofSubject(model, frame, options,
                   [&](const ContourSubject& subject) { return contourImage(subject, options); });
}

View drawContour(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options,
                 const std::filesystem::path& file) {
  return ofSubject(model, frame, options,
                   [&](const ContourSubject& subject) { return drawContour(subject, options, file); });
}

PrintPage contourPage(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options) {
  return ofSubject(model, frame, options,
                   [&](const ContourSubject& subject) { return contourPage(subject, options); });
}

void drawColorScale(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options,
                    const std::array<double, 2>& values, const std::filesystem::path& png) {
  const Theme theme = themeOf(options);
  const PrintPage page = colorScalePage(model, frame, options, values);
  OffscreenCanvas canvas(static_cast<int>(page.size[0]), static_cast<int>(page.size[1]));
  vtkNew<vtkRenderer> paper;
  canvas.window().AddRenderer(paper);
  paper->SetBackground(theme.paper[0] / 255.0, theme.paper[1] / 255.0, theme.paper[2] / 255.0);
  paint(page.sketch, *paper, canvas.supersampling());
  writePng(*canvas.capture(), png);
}

PrintPage colorScalePage(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options,
                         const std::array<double, 2>& values) {
  constexpr double kLength = 0.5;  // of the picture's width
  const Theme theme = themeOf(options);
  const FieldChoice field = chooseField(model, frame, options.field);
  const ScalarBar bar =
      scalarBarOf(field, colorScaleOf(field, options, options.range.value_or(values)), values,
                  textSizeOf(options, theme), theme, options.bands, {}, false, true, {});
  const double width = drawnSize(options)[0], length = kLength * width,
               depth = bar.depth(Overlay::Direction::Right, length);
  PrintPage page{{width, std::ceil(depth)}, "", {}, options.pointsPerPixel};
  Overlay overlay(page.sketch);
  FlatShapes shapes(page.sketch);
  bar.draw(overlay, shapes, {(width - length) / 2.0, 0.0, length, depth}, Overlay::Direction::Right);
  return page;
}

Eigen::AlignedBox2d contentOf(const ModelRecord& model, const FrameRecord& frame,
                              const ContourOptions& options) {
  return withShownModel(model, frame, options, [&](const ModelRecord& shown, const FrameRecord& its) {
    return contentOf(contourParts(shown, its, chooseField(shown, its, options.field), options), shown.dim);
  });
}

}  // namespace burnish
