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
#include "postproc/draw/contour/occlusion.h"
#include "postproc/draw/contour/scalar_bar.h"
#include "postproc/draw/contour/shape_lines.h"
#include "postproc/draw/contour/shown_model.h"
#include "postproc/draw/contour/space_actors.h"
#include "postproc/draw/contour/tool_drawing.h"
#include "postproc/draw/page/flat_shapes.h"
#include "postproc/draw/page/overlay.h"
#include "postproc/draw/page/png_file.h"
#include "postproc/offscreen/offscreen_canvas.h"

namespace burnish {
namespace {

/// Width of contact faces in the plane, over that of outlines.
constexpr double kFaceWidth = 6.0;

/// Length of a dash with its gap, in heights of the text.
constexpr double kDash = 0.5;

constexpr Color kWhite{255, 255, 255}, kBlack{0, 0, 0};

/// Order in which things lie over each other in a flat picture; in space where they lie at the same place.
enum Layer {
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
void check(const PictureOptions& options, int dim) {
  std::vector<InputProblem> problems = conflictsIn(options, dim);
  if (problems.empty()) problems = ruleProblems(options);
  if (!problems.empty()) throw Error(fmt::format("{}: {}", problems.front().path, problems.front().text));
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
    const auto& [whole, unclipped] = subject_.ranges;
    const std::array<double, 2> shown = options_.range.value_or(unclipped);
    const ColorScale scale = colorScaleOf(field_, options_, shown);
    const ScalarBar bar = scalarBarOf(field_, scale, whole, textSize_, theme_, options_.evenScales);
    const ContourLayout layout = layOutContour(
        size_, textSize_, options_.window ? *options_.window : contentOf(parts_, subject_.dim), parts_.axes,
        caption(options_.clip && shown != whole), options_.colorScale ? &bar : nullptr, theme_);
    if (subject_.refine) subject_.refine(parts_, layout.view, scale.range());
    for (const ShownTool& tool : parts_.tools) tools_.push_back(drawTool(tool, layout.view));
    if (options_.occlusion && !isFlat()) {
      const Occlusion occlusion(parts_, tools_, options_.toolOpacity);
      occlusion.setSky();
      shadow_ = occlusion.groundShadow();
    }
    if (!options_.transparent) return {capture(theme_.paper, layout, bar, scale), layout.view};
    return {withoutPaper(*capture(kWhite, layout, bar, scale), *capture(kBlack, layout, bar, scale)),
            layout.view};
  }

 private:
  ContourCaption caption(bool clipped) const {
    return {options_.title.value_or(subject_.title),
            options_.time && subject_.time ? fmt::format("t = {:.6g}", *subject_.time) : "",
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

  vtkSmartPointer<vtkImageData> capture(const Color& background, const ContourLayout& layout,
                                        const ScalarBar& bar, const ColorScale& scale) const {
    OffscreenCanvas canvas(size_[0], size_[1]);
    vtkNew<vtkRenderer> paper, space;
    canvas.window().SetNumberOfLayers(2);
    canvas.window().AddRenderer(paper);
    canvas.window().AddRenderer(space);
    paper->SetBackground(background[0] / 255.0, background[1] / 255.0, background[2] / 255.0);
    if (shadow_ && !cutsBody_) {
      paper->AddActor(shadowActor(*shadow_));
      aim(*paper, wholePicture(layout.view), size_, 10.0 * lengthOf(parts_));
    }
    drawTexts(*paper, canvas.supersampling(), layout, bar);
    space->SetLayer(1);
    drawSpace(*space, canvas.supersampling(), layout.view, scale);
    return canvas.capture();
  }

  /// The same projection, to the edges of the picture: a shadow fades out beside the body.
  View wholePicture(View view) const {
    const PixelRect all{0.0, 0.0, static_cast<double>(size_[0]), static_cast<double>(size_[1])};
    view.center += (all.center() - view.area.center()) / view.pixelsPerLength;
    view.area = all;
    return view;
  }

  void drawTexts(vtkRenderer& renderer, int scale, const ContourLayout& layout, const ScalarBar& bar) const {
    Overlay overlay(renderer, scale);
    if (!layout.title.text.empty()) overlay.addText(layout.title.text, layout.titleAt, layout.title.style);
    if (!layout.time.text.empty()) overlay.addText(layout.time.text, layout.timeAt, layout.time.style);
    if (!layout.note.text.empty())
      overlay.addText(
          layout.note.text, layout.noteAt, layout.note.style,
          layout.barDirection == Overlay::Direction::Up ? Overlay::Anchor::End : Overlay::Anchor::Middle);
    if (!layout.doubt.text.empty()) overlay.addText(layout.doubt.text, layout.doubtAt, layout.doubt.style);
    FlatShapes shapes(renderer, scale);
    if (options_.colorScale) bar.draw(overlay, shapes, layout.bar, layout.barDirection);
    if (cutsBody_) drawFrame(shapes, layout.view.area);
    if (subject_.dim == 3) drawAxesTriad(shapes, overlay, parts_.axes, layout.triadAt, textSize_, theme_);
  }

  /// Round a part of the body, whose edges are not those of the body.
  void drawFrame(FlatShapes& shapes, const PixelRect& area) const {
    const double left = area.x - 0.5, right = area.right() + 0.5, low = area.y - 0.5, top = area.top() + 0.5;
    shapes.addPolyline({{left, low}, {right, low}, {right, top}, {left, top}, {left, low}},
                       std::max(1.0, textSize_ / 24.0), theme_.softInk);
  }

  /// Whether what is drawn lies in a plane.
  bool isFlat() const { return subject_.dim == 2 || options_.slice; }

  void drawSpace(vtkRenderer& renderer, int scale, const View& view, const ColorScale& colors) const {
    const double line = scale * std::max(0.8, textSize_ / 16.0);
    const Eigen::Vector3d eye = view.towardsEye();
    const auto add = [&](const vtkSmartPointer<vtkActor>& actor, Layer layer) {
      const Eigen::Vector3d shift = liftOf(layer, view) * eye;
      actor->SetPosition(shift.x(), shift.y(), shift.z());
      renderer.AddActor(actor);
    };
    const auto colored = contourActor(*parts_.body, colors, !isFlat());
    const bool ofContact = field_.faces != nullptr;
    if (ofContact) colored->GetProperty()->SetLineWidth(static_cast<float>(kFaceWidth * line));
    add(colored, !ofContact ? kBody : isFlat() ? kContactFaces : kIsolines);
    if (parts_.section) add(contourActor(*parts_.section, colors, false), kBody);
    if (parts_.plain) add(plainActor(*parts_.plain, plainColor(), !isFlat(), 1.0), kBody);
    if (parts_.plainSection) add(plainActor(*parts_.plainSection, plainColor(), false, 1.0), kBody);
    for (const auto& part : {parts_.body, parts_.section})
      if (part && options_.isolines > 0)
        add(lineActor(*isolines(*part, colors.range()), theme_.outline, 0.7 * line, 1.0), kIsolines);
    if (parts_.knots) add(lineActor(*parts_.knots, theme_.knots, 0.5 * line, 0.5), kKnots);
    if (parts_.net) {
      add(lineActor(*parts_.net, theme_.controlNet, 0.6 * line, 1.0), kNet);
      add(pointActor(*parts_.net, theme_.controlNet, 4.0 * line), kNet);
    }
    if (parts_.undeformed)
      add(lineActor(*parts_.undeformed, theme_.undeformed, 0.8 * line, 1.0), kUndeformed);
    add(lineActor(*parts_.outline, theme_.outline, line, 1.0), kBodyOutline);
    for (const auto& part : {parts_.body, parts_.plain})
      if (part && !isFlat() && !(ofContact && part == parts_.body))
        add(lineActor(*silhouetteOf(*part, eye), theme_.outline, line, 1.0), kBodyOutline);
    for (const ToolDrawing& drawing : tools_) {
      if (drawing.area) add(plainActor(*drawing.area, theme_.tool, false, 1.0), kToolFill);
      if (drawing.surface)
        add(plainActor(*drawing.surface, theme_.tool, true, options_.toolOpacity), kToolFill);
      if (drawing.lines) add(lineActor(*drawing.lines, theme_.outline, 1.2 * line, 1.0), kToolLines);
    }
    if (options_.hiddenLines == HiddenLines::Dashed && !isFlat()) {
      const double dash = kDash * textSize_;
      const auto addHidden = [&](vtkPolyData& lines, double width) {
        if (lines.GetNumberOfLines() > 0)
          renderer.AddActor(dashedActor(*withWayAlong(lines, view), theme_.outline, width, dash));
      };
      addHidden(*parts_.outline, line);
      for (const ToolDrawing& drawing : tools_)
        if (drawing.lines) addHidden(*drawing.lines, 1.2 * line);
    }
    if (parts_.arrows.areas) drawArrows(renderer, line, eye);
    if (shadow_ && cutsBody_) renderer.AddActor(shadowActor(*shadow_));
    if (!isFlat()) peel(renderer);
    aim(renderer, view, size_, 10.0 * lengthOf(parts_));
  }

  /// How far towards the eye a layer is moved. In space lines come out of the facets on which they lie, but not
  /// through what is before them.
  double liftOf(Layer layer, const View& view) const {
    constexpr double kPixelsPerLayer = 0.5;
    const auto order = static_cast<double>(layer);
    if (isFlat()) return order * lengthOf(parts_) / 100.0;
    return kPixelsPerLayer * std::max(0.0, order - static_cast<double>(kBody)) / view.pixelsPerLength;
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
    const auto edges = lineActor(*parts_.arrows.edges, kBlack, 0.5 * line, 1.0);
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
  std::vector<ToolDrawing> tools_;
  vtkSmartPointer<vtkPolyData> shadow_;  ///< on the ground; null without
  bool cutsBody_;                        ///< only a part of the body is seen
};

}  // namespace

ContourImage contourImage(const ContourSubject& subject, const ContourOptions& options) {
  check(options, subject.dim);
  return ContourPicture(subject, options).draw();
}

ContourImage contourImage(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options) {
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
    return contourImage(subject, options);
  });
}

View drawContour(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options,
                 const std::filesystem::path& png) {
  const ContourImage image = contourImage(model, frame, options);
  writePng(*image.picture, png);
  return image.view;
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
  Overlay overlay(*paper, canvas.supersampling());
  FlatShapes shapes(*paper, canvas.supersampling());
  bar.draw(overlay, shapes, {(width - length) / 2.0, 0.0, length, depth}, Overlay::Direction::Right);
  writePng(*canvas.capture(), png);
}

Eigen::AlignedBox2d contentOf(const ModelRecord& model, const FrameRecord& frame,
                              const ContourOptions& options) {
  return withShownModel(model, frame, options, [&](const ModelRecord& shown, const FrameRecord& its) {
    return contentOf(contourParts(shown, its, chooseField(shown, its, options.field), options), shown.dim);
  });
}

}  // namespace burnish
