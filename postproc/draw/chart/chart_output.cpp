#include "postproc/draw/chart/chart_output.h"

#include <fmt/format.h>
#include <vtkActor2D.h>
#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextDevice2D.h>
#include <vtkContextScene.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSVGContextDevice2D.h>
#include <vtkSVGExporter.h>
#include <vtkSmartPointer.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/core/module_function.h"
#include "engine/core/output_file.h"
#include "postproc/draw/chart/chart_scene.h"
#include "postproc/draw/page/font.h"
#include "postproc/draw/page/glyph_picture.h"
#include "postproc/draw/page/png_file.h"
#include "postproc/draw/page/print_file.h"
#include "postproc/offscreen/offscreen_canvas.h"

namespace burnish {
namespace {

constexpr double kPointsPerPixel = 0.75;  ///< of SVG

/// Paints a sketch, `scale` times larger.
class SketchPainter {
 public:
  SketchPainter(const ChartSketch& sketch, double scale) : sketch_(sketch), scale_(scale) {}

  /// shift: of all, upwards.
  void paint(vtkContext2D& painter, double shift) const {
    for (const auto& shape : sketch_.shapes)
      std::visit([&](const auto& drawn) { paint(painter, drawn, shift); }, shape);
  }

 private:
  /// Coordinates as VTK takes them: x, y, x, y, …
  std::vector<float> scaled(const Polyline& points, double shift) const {
    std::vector<float> result;
    for (const Eigen::Vector2d& p : points) {
      result.push_back(static_cast<float>(scale_ * p.x()));
      result.push_back(static_cast<float>(scale_ * p.y() + shift));
    }
    return result;
  }

  void paint(vtkContext2D& painter, const SketchLine& line, double shift) const {
    if (line.points.size() < 2) return;
    std::vector<float> points = scaled(line.points, shift);
    painter.GetPen()->SetLineType(vtkPen::SOLID_LINE);
    painter.GetPen()->SetColor(line.color[0], line.color[1], line.color[2]);
    painter.GetPen()->SetWidth(static_cast<float>(scale_ * line.width));
    painter.DrawPoly(points.data(), static_cast<int>(line.points.size()));
  }

  void paint(vtkContext2D& painter, const SketchArea& area, double shift) const {
    std::vector<float> points = scaled(area.corners, shift);
    painter.GetBrush()->SetColor(area.color[0], area.color[1], area.color[2]);
    // The context would draw the outline too.
    painter.GetDevice()->DrawPolygon(points.data(), static_cast<int>(area.corners.size()));
  }

  /// In one piece, or in pieces from the start on if parts of the text need another font.
  void paint(vtkContext2D& painter, const SketchText& text, double shift) const {
    noteDrawnText(text.text, text.style.font);
    const std::vector<FontPiece> pieces = fontPieces(text.text, text.style.font);
    if (pieces.size() == 1 && !isShaped(pieces.front())) {
      SketchText whole = text;
      whole.text = pieces.front().text;
      return paintPiece(painter, whole, *pieces.front().font, VTK_TEXT_CENTERED, shift);
    }
    const bool up = text.direction == Overlay::Direction::Up;
    const Eigen::Vector2d along(up ? 0.0 : 1.0, up ? 1.0 : 0.0), upwards(-along.y(), along.x());
    const double before = text.anchor == Overlay::Anchor::Start    ? 0.0
                          : text.anchor == Overlay::Anchor::Middle ? 0.5
                                                                   : 1.0;
    Eigen::Vector2d pen = text.at - before * textWidth({{text.text}}, text.style) * along -
                          capitalHeight(text.style) / 2 * upwards;
    SketchText part = text;
    part.anchor = Overlay::Anchor::Start;
    for (const FontPiece& piece : pieces) {
      part.text = piece.text;
      part.at = pen;
      if (isShaped(piece)) {
        paintGlyphs(painter, part, piece, shift);
      } else {
        part.at -= piece.font->descent * text.style.size * upwards;
        paintPiece(painter, part, *piece.font, VTK_TEXT_BOTTOM, shift);
      }
      pen += advance({piece, text.style.size, 0.0}) * along;
    }
  }

  void paintGlyphs(vtkContext2D& painter, const SketchText& text, const FontPiece& piece,
                   double shift) const {
    const auto [pixels, fromStart] =
        glyphPicture(piece.shaped, piece.font->file, fontSize(text.style.size, scale_), text.style.color,
                     text.direction == Overlay::Direction::Up);
    // Whole pixels before the shift, which is one too: in strips of the picture as in the whole.
    const Eigen::Vector2d corner = (scale_ * text.at).array().round() + fromStart.array();
    painter.DrawImage(static_cast<float>(corner.x()), static_cast<float>(corner.y() + shift), pixels);
  }

  void paintPiece(vtkContext2D& painter, const SketchText& text, const Font& font, int vertical,
                  double shift) const {
    const auto& [size, color, name] = text.style;
    vtkNew<vtkTextProperty> property;
    property->SetFontFamily(VTK_FONT_FILE);
    property->SetFontFile(font.file.c_str());
    property->SetFontSize(static_cast<int>(std::lround(scale_ * size)));
    property->SetColor(color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
    property->SetJustification(text.anchor == Overlay::Anchor::Start    ? VTK_TEXT_LEFT
                               : text.anchor == Overlay::Anchor::Middle ? VTK_TEXT_CENTERED
                                                                        : VTK_TEXT_RIGHT);
    property->SetVerticalJustification(vertical);
    if (text.direction == Overlay::Direction::Up) property->SetOrientation(90.0);
    const std::vector<float> at = scaled({text.at}, shift);
    const auto draw = [&](const std::string& string) {
      painter.ApplyTextProp(property);
      painter.DrawString(at[0], at[1], string.c_str());
    };
    // A picture that looks the same everywhere has outlines of letters; text that can be selected lies over
    // them, unseen.
    if (auto* svg = vtkSVGContextDevice2D::SafeDownCast(painter.GetDevice())) {
      draw(text.text);
      property->SetOpacity(0.0);
      property->SetFontSize(static_cast<int>(std::lround(kPointsPerPixel * scale_ * size)));
      svg->SetTextAsPath(false);
      draw(text.text);
      svg->SetTextAsPath(true);
    } else {
      draw(text.text);
    }
  }

  const ChartSketch& sketch_;
  double scale_;
};

/// A renderer that shows the sketch, `scale` times larger, through an actor of the given type. The sketch must live as long.
template <class Actor>
vtkSmartPointer<vtkRenderer> rendererOf(const ChartSketch& sketch, double scale) {
  // The canvas draws a picture in strips and moves flat actors down by what lies under a strip; a scene does
  // not move, but this actor does.
  const vtkNew<vtkActor2D> movedByStrips;
  movedByStrips->VisibilityOff();
  const vtkNew<PaintedItem> item;
  item->paintWith([painter = SketchPainter(sketch, scale),
                   moved = vtkSmartPointer<vtkActor2D>(movedByStrips.Get())](vtkContext2D& context) {
    painter.paint(context, moved->GetPosition()[1]);
  });
  const vtkNew<Actor> actor;
  actor->GetScene()->AddItem(item);
  const auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetBackground(sketch.paper[0] / 255.0, sketch.paper[1] / 255.0, sketch.paper[2] / 255.0);
  renderer->SetBackgroundAlpha(1.0);
  renderer->AddActor2D(movedByStrips);
  renderer->AddActor(actor);
  return renderer;
}

void writePicture(const ChartSketch& sketch, const std::filesystem::path& file) {
  OffscreenCanvas canvas(sketch.size[0], sketch.size[1]);
  canvas.window().AddRenderer(rendererOf<vtkContextActor>(sketch, canvas.supersampling()));
  writePng(*canvas.capture(), file);
}

std::string contentsOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

vtkSmartPointer<vtkSVGExporter> svgExporter() {
  using Maker = vtkSVGExporter*();
  static auto* const make =
      reinterpret_cast<Maker*>(moduleFunction({"burnish_svg.so"}, "burnishNewSvgExporter", "a chart as SVG"));
  return vtkSmartPointer<vtkSVGExporter>::Take(make());
}

/// Writes letters as outlines, one by one, with the exporter of VTK, which neither throws nor says whether it
/// failed: the file must have its end.
void writeSvg(const ChartSketch& sketch, const std::filesystem::path& file) {
  const auto exporter = svgExporter();
  const std::filesystem::path partial = partialName(file);
  OutputFile(partial).close();                  // throws with the reason if there can be no such file
  vtkNew<vtkGenericOpenGLRenderWindow> window;  // never rendered: it needs no context
  window->SetDPI(72);
  window->SetSize(sketch.size[0], sketch.size[1]);
  const auto renderer = rendererOf<ExportActor>(sketch, 1.0);
  window->AddRenderer(renderer);
  exporter->SetRenderWindow(window);
  exporter->SetTitle("chart");
  exporter->SetFileName(partial.c_str());
  exporter->Write();
  renderer->RemoveAllViewProps();  // the actor keeps the exporter's device
  const std::string contents = contentsOf(partial);
  std::error_code ignored;
  std::filesystem::remove(partial, ignored);
  if (!std::string_view(contents).substr(0, contents.find_last_not_of(" \r\n") + 1).ends_with("</svg>"))
    throw Error(fmt::format("cannot write {}: the disk may be full", file.string()));
  writeFileAtomically(file, std::as_bytes(std::span(contents)));
}

PageSketch::Shape onPage(const SketchLine& line) {
  return PageLines{{line.points}, line.width, line.color};
}

PageSketch::Shape onPage(const SketchArea& area) {
  return PageArea{area.corners, area.color};
}

PageSketch::Shape onPage(const SketchText& text) {
  noteDrawnText(text.text, text.style.font);
  const Eigen::Vector2d along = unitAlong(text.direction), upwards(-along.y(), along.x());
  return PageText{{{text.text}},
                  text.at - capitalHeight(text.style) / 2 * upwards,
                  text.style,
                  text.anchor,
                  text.direction};
}

/// By glyphs, or by other letters than those that were written.
bool hasTextSetOtherwise(const ChartSketch& sketch) {
  return std::ranges::any_of(sketch.shapes, [](const auto& shape) {
    const auto* text = std::get_if<SketchText>(&shape);
    return text != nullptr && (hasLettersFromRightToLeft(text->text) ||
                               std::ranges::any_of(fontPieces(text->text, text->style.font), isShaped));
  });
}

/// As large as those of VTK, and on paper.
PrintPage drawingOf(const ChartSketch& sketch) {
  PrintPage page = pageOf(sketch);
  page.pointsPerPixel = kPointsPerPixel;
  auto& shapes = page.sketch.shapes;
  shapes.insert(shapes.begin(), wholePage(page.size, sketch.paper));
  return page;
}

}  // namespace

PrintPage pageOf(const ChartSketch& sketch) {
  PrintPage page{{static_cast<double>(sketch.size[0]), static_cast<double>(sketch.size[1])}, "chart", {}};
  for (const auto& shape : sketch.shapes)
    page.sketch.shapes.push_back(std::visit([](const auto& drawn) { return onPage(drawn); }, shape));
  return page;
}

void writeSketch(const ChartSketch& sketch, const std::filesystem::path& file) {
  const auto ending = file.extension();
  if (ending == ".png") return writePicture(sketch, file);
  if (ending == ".svg" && !hasTextSetOtherwise(sketch)) return writeSvg(sketch, file);
  if (ending == ".svg") return writePrint(drawingOf(sketch), file);
  if (ending == ".pdf") return writePrint(pageOf(sketch), file);
  throw Error(
      fmt::format("\"{}\": expected the name of a chart that ends in .png, .svg or .pdf", file.string()));
}

}  // namespace burnish
