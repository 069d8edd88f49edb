#include "postproc/draw/page/overlay.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkRenderer.h>
#include <vtkStdString.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "engine/core/shown_text.h"
#include "postproc/draw/page/flat_shapes.h"
#include "postproc/offscreen/offscreen_canvas.h"

namespace burnish {
namespace {

// Parts of the font size.
constexpr double kScriptSize = 0.7;
constexpr double kSubDrop = 0.16;
constexpr double kSuperRise = 0.36;

TextStyle runStyle(TextStyle style, Script script) {
  if (script != Script::Normal) style.size *= kScriptSize;
  return style;
}

/// Fonts have whole sizes; text is measured and drawn with the same.
int fontSize(const TextStyle& style, double scale) {
  return std::max(1, static_cast<int>(std::lround(style.size * scale)));
}

void apply(const Font& font, int size, vtkTextProperty& property) {
  property.SetFontFamily(VTK_FONT_FILE);
  property.SetFontFile(font.file.c_str());
  property.SetFontSize(size);
}

/// Width in pixels of the drawing; laying out a picture asks for the same texts again and again, and
/// measuring loads every glyph.
int boxWidth(const std::string& text, int fontSize, const Font& font) {
  thread_local std::map<std::tuple<std::string, int, const Font*>, int> known;
  const auto [entry, isNew] = known.try_emplace({text, fontSize, &font}, 0);
  if (isNew) {
    vtkNew<vtkTextProperty> property;
    apply(font, fontSize, *property);
    std::array<int, 4> box{};
    vtkTextRenderer::GetInstance()->GetBoundingBox(property, vtkStdString(text), box.data(), 72);
    entry->second = box[1] - box[0] + 1;
  }
  return entry->second;
}

/// Distance from the start of a text to the start of what follows it, blanks at its ends included.
double advance(const FontPiece& piece, const TextStyle& style) {
  // As large as it is drawn: letters are set at whole pixels, so their distances are not proportional to the
  // size.
  constexpr int scale = OffscreenCanvas::kSupersampling;
  const int size = fontSize(style, scale);
  const int both = boxWidth("|" + piece.text + "|", size, *piece.font);
  return static_cast<double>(both - boxWidth("||", size, *piece.font)) / scale;
}

/// The beginning of a text with so many letters.
RichText beginning(const RichText& text, std::size_t letters) {
  RichText kept;
  for (const TextRun& run : text) {
    if (letters == 0) break;
    kept.push_back({std::string(firstLetters(run.text, letters)), run.script});
    letters -= std::min(letters, letterCount(run.text));
  }
  return kept;
}

}  // namespace

double textWidth(const RichText& text, const TextStyle& style) {
  double width = 0.0;
  for (const TextRun& run : text)
    for (const FontPiece& piece : fontPieces(run.text, style.font))
      width += advance(piece, runStyle(style, run.script));
  return width;
}

FittedText fitText(RichText text, TextStyle style, double width, double smallest) {
  const double full = textWidth(text, style);
  if (full > width)
    style.size = std::max(std::min(smallest, style.size), std::floor(style.size * width / full));
  // Letters are set at whole pixels, so a text may still be a little longer than in proportion.
  while (style.size > smallest && textWidth(text, style) > width)
    style.size = std::max(smallest, style.size - 1.0);
  if (textWidth(text, style) <= width) return {std::move(text), style};
  const TextRun dots{"…"};
  const double dotted = textWidth({dots}, style);
  std::size_t fitting = 0, all = 0;  // letters
  for (const TextRun& run : text) all += letterCount(run.text);
  for (std::size_t tooMany = all; tooMany - fitting > 1;) {
    const std::size_t middle = (fitting + tooMany) / 2;
    (textWidth(beginning(text, middle), style) + dotted > width ? tooMany : fitting) = middle;
  }
  text = beginning(text, fitting);
  text.push_back(dots);
  return {std::move(text), style};
}

double capitalHeight(const TextStyle& style) {
  return fontNamed(style.font).capitals * style.size;
}

double capitalHeight(double size) {
  return capitalHeight(TextStyle{.size = size});
}

void Overlay::addText(const RichText& text, const Eigen::Vector2d& at, const TextStyle& style, Anchor anchor,
                      Direction direction) {
  const Eigen::Vector2d along =
      direction == Direction::Right ? Eigen::Vector2d::UnitX() : Eigen::Vector2d::UnitY();
  const Eigen::Vector2d upwards(-along.y(), along.x());
  const double share = anchor == Anchor::Start ? 0.0 : anchor == Anchor::Middle ? 0.5 : 1.0;
  Eigen::Vector2d pen = at - share * textWidth(text, style) * along;
  for (const TextRun& run : text) {
    const TextStyle own = runStyle(style, run.script);
    const double lift = run.script == Script::Normal ? 0.0
                        : run.script == Script::Sub  ? -kSubDrop
                                                     : kSuperRise;
    noteDrawnText(run.text, style.font);
    for (const FontPiece& piece : fontPieces(run.text, style.font)) {
      addPiece(piece, pen + lift * style.size * upwards, own, direction);
      pen += advance(piece, own) * along;
    }
  }
}

void Overlay::addPiece(const FontPiece& piece, const Eigen::Vector2d& baseline, const TextStyle& style,
                       Direction direction) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(piece.text.c_str());
  apply(*piece.font, fontSize(style, scale_), *actor->GetTextProperty());
  actor->GetTextProperty()->SetColor(style.color[0] / 255.0, style.color[1] / 255.0, style.color[2] / 255.0);
  actor->GetTextProperty()->SetJustificationToLeft();
  actor->GetTextProperty()->SetVerticalJustificationToBottom();
  const double descent = piece.font->descent * style.size;
  const bool up = direction == Direction::Up;
  if (up) actor->GetTextProperty()->SetOrientation(90.0);
  actor->SetPosition(std::round(scale_ * (baseline.x() + (up ? descent : 0.0))),
                     std::round(scale_ * (baseline.y() - (up ? 0.0 : descent))));
  renderer_.AddActor2D(actor);
}

void Overlay::addSegments(const std::vector<Eigen::Vector2d>& points, double width, const Color& color) {
  FlatShapes(renderer_, scale_).addSegments(points, width, color);
}

void Overlay::addStripes(const PixelRect& rect, const std::vector<Color>& colors, Direction direction) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> cellColors;
  cellColors->SetNumberOfComponents(3);
  const auto count = static_cast<vtkIdType>(colors.size());
  for (vtkIdType k = 0; k <= count; ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(count);
    const bool right = direction == Direction::Right;
    const double x = scale_ * (rect.x + (right ? part * rect.width : 0.0));
    const double y = scale_ * (rect.y + (right ? 0.0 : part * rect.height));
    points->InsertNextPoint(x, y, 0.0);
    points->InsertNextPoint(right ? x : scale_ * rect.right(), right ? scale_ * rect.top() : y, 0.0);
  }
  for (vtkIdType k = 0; k < count; ++k) {
    cells->InsertNextCell({2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2});
    cellColors->InsertNextTypedTuple(colors[static_cast<std::size_t>(k)].data());
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetCellData()->SetScalars(cellColors);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  mapper->SetScalarModeToUseCellData();
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  renderer_.AddActor2D(actor);
}

}  // namespace burnish
