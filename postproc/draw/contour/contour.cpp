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
#include "postproc/draw/contour/page_lines.h"
#include "postproc/draw/contour/scalar_bar.h"
#include "postproc/draw/contour/shape_lines.h"
#include "postproc/draw/contour/shown_model.h"
#include "postproc/draw/contour/space_actors.h"
#include "postproc/draw/contour/tool_drawing.h"
#include "postproc/draw/page/flat_shapes.h"
#include "postproc/draw/page/overlay.h"
#include "postproc/draw/page/painted_sketch.h"
#include "postproc/draw/page/png_file.h"
#include "postproc/draw/page/print_file.h"
#include "postproc/offscreen/offscreen_canvas.h"

namespace burnish {
namespace {

/// Width of contact faces in the plane, over that of outlines.
constexpr double kFaceWidth = 6.0;

/// Width of the edges of arrows, over that of outlines.
constexpr double kArrowEdge = 0.5;

constexpr Color kWhite{255, 255, 255}, kBlack{0, 0, 0};

/// Order in which things lie over each other in a 2D picture.
enum Layer {
  kBehindBody = -1,
  kToolFill,
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

/// The part of the range that values on either side of zero take at least where colours tell their sign.
constexpr double kEitherSign = 0.05;

ColorScale colorScaleOf(const FieldChoice& field, const ContourOptions& options,
                        const std::array<double, 2>& shown) {
  const int bands = field.states.empty() ? options.bands : static_cast<int>(field.states.size());
  std::array<double, 2> range = options.range ? shown : widened(shown);
  // Before anything is loaded colours are those of later on.
  if (field.isAboutZero && !options.range && shown[0] == 0.0 && shown[1] == 0.0) range[0] = -range[1];
  const double least = kEitherSign * (range[1] - range[0]);
  const bool bothSigns = field.isAboutZero && std::min(-range[0], range[1]) > least;
  std::string colormap = options.colormap;
  if (colormap == kAutomaticColormap) colormap = bothSigns ? "coolwarm" : "viridis";
  return {colormap, range, bands, bothSigns && isDiverging(colormap) ? std::optional(0.0) : std::nullopt};
}

ScalarBar scalarBarOf(const FieldChoice& field, const ColorScale& scale, const std::array<double, 2>& values,
                      double textSize, const Theme& theme, bool even) {
  return {scale, {field.title, field.unit, values[0], values[1], field.states, even}, textSize, theme};
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
        cutsBody_(options.window && !options.window->contains(bodiesBox(parts_))) {}

  ContourImage draw() {
    const Plan plan = makePlan();
    const View& view = plan.layout.view;
    if (subject_.refine) subject_.refine(parts_, view, plan.scale.range());
    return {onPaper([&](const Color& paper) { return capture(paper, plan); }), view};
  }

  /// The same for print: the field as an image, what is drawn over it as vectors.
  ContourPage page() {
    const Plan plan = makePlan();
    const View& view = plan.layout.view;
    const std::array<int, 2> pixels = pixelsFor(view.area);
    View printed = view;
    printed.area = {0.0, 0.0, static_cast<double>(pixels[0]), static_cast<double>(pixels[1])};
    printed.pixelsPerLength *= pixels[0] / view.area.width;
    if (subject_.refine) subject_.refine(parts_, printed, plan.scale.range());

    PrintPage page{{static_cast<double>(size_[0]), static_cast<double>(size_[1])}, title(), {}};
    std::vector<PageSketch::Shape>& shapes = page.sketch.shapes;
    if (!options_.transparent && theme_.paper != kWhite) shapes.emplace_back(wholePage());
    shapes.emplace_back(PageImage{
        view.area, onPaper([&](const Color& paper) { return captureSpace(paper, printed, plan); })});
    for (const PageSketch& over : {spaceLines(plan), texts(plan.layout, plan.bar)})
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

  Plan makePlan() const {
    const auto& [whole, unclipped] = subject_.ranges;
    const std::array<double, 2> shown = options_.range.value_or(unclipped);
    const ColorScale scale = colorScaleOf(field_, options_, shown);
    const ScalarBar bar = scalarBarOf(field_, scale, whole, textSize_, theme_, options_.evenScales);
    Plan plan{
        scale, bar,
        layOutContour(size_, textSize_, options_.window ? *options_.window : contentOf(parts_, subject_.dim),
                      parts_.axes, caption(options_.clip && shown != whole),
                      options_.colorScale ? &bar : nullptr, theme_)};
    for (const ShownTool& tool : parts_.tools) plan.tools.push_back(drawTool(tool, plan.layout.view));
    return plan;
  }

  /// What `draw` draws on a paper, or without paper.
  template <class Draw>
  vtkSmartPointer<vtkImageData> onPaper(const Draw& draw) const {
    return options_.transparent ? withoutPaper(*draw(kWhite), *draw(kBlack)) : draw(theme_.paper);
  }

  /// Of the image in a part of a page.
  std::array<int, 2> pixelsFor(const PixelRect& area) const {
    const auto count = [&](double length) {
      return std::max(1, static_cast<int>(std::lround(dotsPerPoint(options_) * length)));
    };
    return {count(area.width), count(area.height)};
  }

  PageArea wholePage() const {
    const double width = size_[0], height = size_[1];
    return {{{0.0, 0.0}, {width, 0.0}, {width, height}, {0.0, height}}, theme_.paper};
  }

  std::string title() const { return options_.title.value_or(subject_.title); }

  ContourCaption caption(bool clipped) const {
    return {title(), options_.time && subject_.time ? fmt::format("t = {:.6g}", *subject_.time) : "",
            joined({options_.warp == 1.0 ? "" : fmt::format("displacements × {:.6g}", options_.warp),
                    parts_.arrows.note, sectionNote(), plainNote(), subject_.note, options_.note,
                    clipped ? clipNote(*options_.clip, subject_.dim) : ""}),
            options_.doubt, subject_.dim == 3};
  }

  /// Of bodies that do not have the field.
  std::string plainNote() const {
    return subject_.without.empty() ? ""
                                    : fmt::format("{} without values", fmt::join(subject_.without, ", "));
  }

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
      if (std::abs(normal(d)) > 1.0 - 1e-12) return fmt::format("section {} = {:.6g}", "xyz"[d], point(d));
    return fmt::format("section through ({:.6g}) across ({:.3g})", fmt::join(point, ", "),
                       fmt::join(normal, ", "));
  }

  vtkSmartPointer<vtkImageData> capture(const Color& background, const Plan& plan) const {
    const ContourLayout& layout = plan.layout;
    OffscreenCanvas canvas(size_[0], size_[1]);
    vtkNew<vtkRenderer> paper, space;
    canvas.window().SetNumberOfLayers(2);
    canvas.window().AddRenderer(paper);
    canvas.window().AddRenderer(space);
    paper->SetBackground(background[0] / 255.0, background[1] / 255.0, background[2] / 255.0);
    paint(texts(layout, plan.bar), *paper, canvas.supersampling());
    space->SetLayer(1);
    drawSpace(*space, canvas.supersampling(), plan, Shown::Everything);
    aim(*space, layout.view, size_, 10.0 * lengthOf(parts_));
    return canvas.capture();
  }

  /// The image of space alone, in the pixels of print.
  vtkSmartPointer<vtkImageData> captureSpace(const Color& background, const View& printed,
                                             const Plan& plan) const {
    const std::array<int, 2> pixels{static_cast<int>(printed.area.width),
                                    static_cast<int>(printed.area.height)};
    OffscreenCanvas canvas(pixels[0], pixels[1]);
    vtkNew<vtkRenderer> space;
    canvas.window().AddRenderer(space);
    space->SetBackground(background[0] / 255.0, background[1] / 255.0, background[2] / 255.0);
    drawSpace(*space, canvas.supersampling() * dotsPerPoint(options_), plan,
              isFlat() ? Shown::Areas : Shown::Everything);
    aim(*space, printed, pixels, 10.0 * lengthOf(parts_));
    return canvas.capture();
  }

  /// What lies over the areas of a plane picture. In space lines are hidden by what stands before them, so that
  /// they belong to the image.
  PageSketch spaceLines(const Plan& plan) const {
    PageSketch sketch;
    if (!isFlat()) return sketch;
    const View& view = plan.layout.view;
    std::vector<SpaceLines> all = bodyLines(plan);
    for (const ToolDrawing& tool : plan.tools)
      if (tool.lines) all.push_back(toolLines(tool));
    for (const SpaceLines& part : all)
      sketch.shapes.emplace_back(part.isDots
                                     ? pageDots(*part.lines, view, part.color, part.width)
                                     : pageLines(*part.lines, view, part.color, part.width, part.opacity));
    if (isOfContact())
      for (PageLines& piece : coloredPageLines(*parts_.body, view, plan.scale, kFaceWidth * lineWidth()))
        sketch.shapes.emplace_back(std::move(piece));
    if (parts_.arrows.areas)
      addPageArrows(sketch, *parts_.arrows.edges, view, kWhite, kBlack, kArrowEdge * lineWidth());
    return sketch;
  }

  /// All that is no picture of space: texts, the colour scale, the frame, the axes.
  PageSketch texts(const ContourLayout& layout, const ScalarBar& bar) const {
    PageSketch sketch;
    Overlay overlay(sketch);
    if (!layout.title.text.empty()) overlay.addText(layout.title.text, layout.titleAt, layout.title.style);
    if (!layout.time.text.empty()) overlay.addText(layout.time.text, layout.timeAt, layout.time.style);
    if (!layout.note.text.empty())
      overlay.addText(
          layout.note.text, layout.noteAt, layout.note.style,
          layout.barDirection == Overlay::Direction::Up ? Overlay::Anchor::End : Overlay::Anchor::Middle);
    if (!layout.doubt.text.empty()) overlay.addText(layout.doubt.text, layout.doubtAt, layout.doubt.style);
    FlatShapes shapes(sketch);
    if (options_.colorScale) bar.draw(overlay, shapes, layout.bar, layout.barDirection);
    if (cutsBody_) drawFrame(shapes, layout.view.area);
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
  };

  /// From the back to the front, without tools.
  std::vector<SpaceLines> bodyLines(const Plan& plan) const {
    const double line = lineWidth();
    std::vector<SpaceLines> all;
    for (const auto& part : {parts_.body, parts_.section})
      if (part && options_.isolines > 0)
        all.push_back({isolines(*part, plan.scale.range()), theme_.outline, 0.7 * line, kIsolines});
    if (parts_.knots) all.push_back({parts_.knots, theme_.knots, 0.5 * line, kKnots, 0.5});
    if (parts_.net) {
      all.push_back({parts_.net, theme_.controlNet, 0.6 * line, kNet});
      all.push_back({parts_.net, theme_.controlNet, 4.0 * line, kNet, 1.0, true});
    }
    if (parts_.undeformed)
      all.push_back({parts_.undeformed, theme_.undeformed, 0.8 * line, isFlat() ? kUndeformed : kBehindBody});
    all.push_back({parts_.outline, theme_.outline, line, kBodyOutline});
    for (const auto& part : {parts_.body, parts_.plain})
      if (part && !isFlat() && !(isOfContact() && part == parts_.body))
        all.push_back(
            {silhouetteOf(*part, plan.layout.view.towardsEye()), theme_.outline, line, kBodyOutline});
    return all;
  }

  SpaceLines toolLines(const ToolDrawing& drawing) const {
    return {drawing.lines, theme_.outline, 1.2 * lineWidth(), kToolLines};
  }

  /// What of space is drawn: of a plane picture its areas alone, where lines become vectors.
  enum class Shown { Everything, Areas };

  /// scale: pixels of the drawing per pixel of the picture.
  void drawSpace(vtkRenderer& renderer, double scale, const Plan& plan, Shown what) const {
    const double depth = lengthOf(parts_) / (isFlat() ? 100.0 : 1000.0);
    const Eigen::Vector3d eye = plan.layout.view.towardsEye();
    const auto add = [&](const vtkSmartPointer<vtkActor>& actor, Layer layer) {
      const Eigen::Vector3d shift = static_cast<double>(layer) * depth * eye;
      actor->SetPosition(shift.x(), shift.y(), shift.z());
      renderer.AddActor(actor);
    };
    const auto addLines = [&](const SpaceLines& part) {
      if (what == Shown::Areas) return;
      const double width = scale * part.width;
      add(part.isDots ? pointActor(*part.lines, part.color, width)
                      : lineActor(*part.lines, part.color, width, part.opacity),
          part.layer);
    };
    if (!isOfContact() || !isFlat() || what == Shown::Everything) {
      const auto colored = contourActor(*parts_.body, plan.scale, !isFlat());
      if (isOfContact())
        colored->GetProperty()->SetLineWidth(static_cast<float>(kFaceWidth * scale * lineWidth()));
      add(colored, !isOfContact() ? kBody : isFlat() ? kContactFaces : kIsolines);
    }
    if (parts_.section) add(contourActor(*parts_.section, plan.scale, false), kBody);
    if (parts_.plain) add(plainActor(*parts_.plain, plainColor(), !isFlat(), 1.0), kBody);
    if (parts_.plainSection) add(plainActor(*parts_.plainSection, plainColor(), false, 1.0), kBody);
    for (const SpaceLines& part : bodyLines(plan)) addLines(part);
    for (const ToolDrawing& drawing : plan.tools) {
      if (drawing.area) add(plainActor(*drawing.area, theme_.tool, false, 1.0), kToolFill);
      if (drawing.surface)
        add(plainActor(*drawing.surface, theme_.tool, true, options_.toolOpacity), kToolFill);
      if (drawing.lines) addLines(toolLines(drawing));
    }
    if (parts_.arrows.areas && what == Shown::Everything) drawArrows(renderer, scale * lineWidth(), eye);
  }

  ToolDrawing drawTool(const ShownTool& tool, const View& view) const {
    const Eigen::AlignedBox3d visible = visibleBox(view);
    const double stroke = textSize_ * 0.6 / view.pixelsPerLength;
    if (subject_.dim == 2) return drawPlaneTool(tool.record, visible, stroke, tool.turn);
    if (options_.slice) return drawToolSection(tool.record, visible, *parts_.plane, stroke);
    return drawSpaceTool(tool.record, visible, view.towardsEye(), parts_.plane);
  }

  /// In front of everything: white with a dark edge, which is seen on every colour.
  void drawArrows(vtkRenderer& renderer, double line, const Eigen::Vector3d& eye) const {
    const auto areas = plainActor(*parts_.arrows.areas, kWhite, false, 1.0);
    const auto edges = lineActor(*parts_.arrows.edges, kBlack, kArrowEdge * line, 1.0);
    double nearness = isFlat() ? static_cast<double>(kArrows) / 100.0 : 2.0;
    for (const auto& actor : {areas, edges}) {
      const Eigen::Vector3d shift = nearness * lengthOf(parts_) * eye;
      actor->SetPosition(shift.x(), shift.y(), shift.z());
      renderer.AddActor(actor);
      nearness += 0.005;
    }
  }

  vtkSmartPointer<vtkPolyData> isolines(vtkPolyData& part, const std::array<double, 2>& range) const {
    vtkNew<vtkContourFilter> filter;
    filter->SetInputData(&part);
    for (int k = 0; k < options_.isolines; ++k)
      filter->SetValue(k, std::lerp(range[0], range[1], (k + 1.0) / (options_.isolines + 1.0)));
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
  bool cutsBody_;  ///< only a part of the body is seen
};

/// Makes something of what a picture of a frame is of.
template <class Make>
auto ofSubject(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options,
               const Make& make) {
  check(options, model.dim);
  return withShownModel(model, frame, options, [&](const ModelRecord& shown, const FrameRecord& its) {
    const FieldChoice field = chooseField(shown, its, options.field);
    const ContourParts parts = contourParts(shown, its, field, options);
    const FieldRange ranges = fieldRanges(shown, its, field, subdivisionOf(shown, options), options.clip);
    ContourSubject subject{
        shown.dim, shown.title, its.time, field, ranges, parts, bodiesWithout(shown, its, options.field),
        "",        {}};
    if (shown.dim == 2)
      subject.refine = [&](ContourParts& coarse, const View& view, const std::array<double, 2>& range) {
        refineForView(coarse, shown, its, field, options, view, range);
      };
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
  check(options, subject.dim);
  throwFirst(printConflictsIn(options));
  const ContourPage printed = ContourPicture(subject, options).page();
  writePrint(printed.page, file);
  return printed.view;
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

void drawColorScale(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options,
                    const std::array<double, 2>& values, const std::filesystem::path& png) {
  constexpr double kLength = 0.5;  // of the picture's width
  const Theme theme = themeOf(options);
  const double textSize = textSizeOf(options, theme);
  const FieldChoice field = chooseField(model, frame, options.field);
  const ScalarBar bar = scalarBarOf(field, colorScaleOf(field, options, options.range.value_or(values)),
                                    values, textSize, theme, false);
  const int width = drawnSize(options)[0];
  const double length = kLength * width, depth = bar.depth(Overlay::Direction::Right, length);
  OffscreenCanvas canvas(width, static_cast<int>(std::ceil(depth)));
  vtkNew<vtkRenderer> paper;
  canvas.window().AddRenderer(paper);
  paper->SetBackground(theme.paper[0] / 255.0, theme.paper[1] / 255.0, theme.paper[2] / 255.0);
  PageSketch sketch;
  Overlay overlay(sketch);
  FlatShapes shapes(sketch);
  bar.draw(overlay, shapes, {(width - length) / 2.0, 0.0, length, depth}, Overlay::Direction::Right);
  paint(sketch, *paper, canvas.supersampling());
  writePng(*canvas.capture(), png);
}

Eigen::AlignedBox2d contentOf(const ModelRecord& model, const FrameRecord& frame,
                              const ContourOptions& options) {
  return withShownModel(model, frame, options, [&](const ModelRecord& shown, const FrameRecord& its) {
    return contentOf(contourParts(shown, its, chooseField(shown, its, options.field), options), shown.dim);
  });
}

}  // namespace burnish
