#include "postproc/draw/page/text_layout.h"

#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "engine/core/shown_text.h"
#include "postproc/offscreen/offscreen_canvas.h"

namespace burnish {
namespace {

// Parts of the font size.
constexpr double kScriptSize = 0.7;
constexpr double kSubDrop = 0.16;
constexpr double kSuperRise = 0.36;

/// Width in pixels of the drawing; laying out a picture asks for the same texts again and again, and
/// measuring loads every glyph.
int boxWidth(const std::string& text, int fontSize, const Font& font) {
  thread_local std::map<std::tuple<std::string, int, const Font*>, int> known;
  const auto [entry, isNew] = known.try_emplace({text, fontSize, &font}, 0);
  if (isNew) {
    vtkNew<vtkTextProperty> property;
    property->SetFontFamily(VTK_FONT_FILE);
    property->SetFontFile(font.file.c_str());
    property->SetFontSize(fontSize);
    std::array<int, 4> box{};
    vtkTextRenderer::GetInstance()->GetBoundingBox(property, vtkStdString(text), box.data(), 72);
    entry->second = box[1] - box[0] + 1;
  }
  return entry->second;
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

Eigen::Vector2d unitAlong(TextDirection direction) {
  return direction == TextDirection::Right ? Eigen::Vector2d::UnitX() : Eigen::Vector2d::UnitY();
}

double shareBefore(TextAnchor anchor) {
  return anchor == TextAnchor::Start ? 0.0 : anchor == TextAnchor::Middle ? 0.5 : 1.0;
}

std::vector<TextPiece> textPieces(const RichText& text, const TextStyle& style) {
  std::vector<TextPiece> pieces;
  for (const TextRun& run : text) {
    const double size = run.script == Script::Normal ? style.size : kScriptSize * style.size;
    const double lift = run.script == Script::Normal ? 0.0
                        : run.script == Script::Sub  ? -kSubDrop
                                                     : kSuperRise;
    for (FontPiece& piece : fontPieces(run.text, style.font))
      pieces.push_back({std::move(piece), size, lift * style.size});
  }
  return pieces;
}

int fontSize(double size, double scale) {
  return std::max(1, static_cast<int>(std::lround(size * scale)));
}

double advance(const TextPiece& piece) {
  // As large as it is drawn: letters are set at whole pixels, so their distances are not proportional to the
  // size.
  constexpr int scale = OffscreenCanvas::kSupersampling;
  const int size = fontSize(piece.size, scale);
  if (isShaped(piece.piece)) return size * piece.piece.shaped.length / scale;
  const Font& font = *piece.piece.font;
  return static_cast<double>(boxWidth("|" + piece.piece.text + "|", size, font) -
                             boxWidth("||", size, font)) /
         scale;
}

double textWidth(const RichText& text, const TextStyle& style) {
  double width = 0.0;
  for (const TextPiece& piece : textPieces(text, style)) width += advance(piece);
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

FittedText fitName(const RichText& name, const RichText& unit, const TextStyle& style, double width,
                   double smallest) {
  RichText whole = name;
  whole.insert(whole.end(), unit.begin(), unit.end());
  FittedText fitted = fitText(whole, style, width, smallest);
  const double taken = textWidth(unit, fitted.style);
  if (unit.empty() || textWidth(whole, fitted.style) <= width || taken >= width) return fitted;
  fitted = fitText(name, fitted.style, width - taken, smallest);
  fitted.text.insert(fitted.text.end(), unit.begin(), unit.end());
  return fitted;
}

double capitalHeight(const TextStyle& style) {
  return fontNamed(style.font).capitals * style.size;
}

double capitalHeight(double size) {
  return capitalHeight(TextStyle{.size = size});
}

}  // namespace burnish
