#include <fmt/format.h>
#include <vtkImageData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/shown_text.h"
#include "postproc/draw/page/picture_look.h"
#include "postproc/draw/page/png_file.h"
#include "postproc/draw/page/print_file.h"
#include "postproc/text/page.h"

namespace burnish {
namespace {

/// A length in pixels or points, of which a thousandth is less than any printer has.
std::string length(double value) {
  return fmt::format("{}", std::round(1000.0 * value) / 1000.0 + 0.0);
}

/// Writes a sketch as elements of SVG, whose y goes down.
class SvgPainter {
 public:
  explicit SvgPainter(double height) : height_(height) {}

  const std::string& text() const { return text_; }

  /// The letters of the texts in their fonts, so that a page looks the same where these are not installed.
  std::string fonts() const {
    std::string rules;
    for (const auto& [file, used] : fonts_) {
      const std::string font = fontOfLetters(used.letters, file);
      if (!font.empty())
        rules += fmt::format("@font-face{{font-family:'{}';src:url(data:font/{};base64,{})}}\n",
                             escaped(used.family), font.starts_with("OTTO") ? "otf" : "ttf", base64(font));
    }
    return rules.empty() ? "" : fmt::format("<style>\n{}</style>\n", rules);
  }

  void operator()(const PageLines& lines) {
    std::string path;
    for (const PagePoints& line : lines.lines) path += pathOf(line);
    open(lines.within);
    text_ += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"", path,
                         Spelling<Color>::write(lines.color), length(lines.width));
    if (lines.opacity < 1.0) text_ += fmt::format(" stroke-opacity=\"{}\"", lines.opacity);
    if (lines.round) text_ += " stroke-linecap=\"round\" stroke-linejoin=\"round\"";
    text_ += "/>\n";
    close(lines.within);
  }

  void operator()(const PageArea& area) {
    open(area.within);
    text_ += fmt::format("<path d=\"{}Z\" fill=\"{}\"/>\n", pathOf(area.corners),
                         Spelling<Color>::write(area.color));
    close(area.within);
  }

  void operator()(const PageRegion& region) {
    std::string path;
    for (const PagePoints& loop : region.loops) path += pathOf(loop) + "Z";
    open(region.within);
    text_ += fmt::format("<path d=\"{}\" fill=\"{}\" fill-rule=\"evenodd\"/>\n", path,
                         Spelling<Color>::write(region.color));
    close(region.within);
  }

  void operator()(const PageStripes& stripes) {
    for (const auto& [rect, color] : overlapping(stripes))
      text_ += fmt::format("<rect {} fill=\"{}\"/>\n", rectText(rect), Spelling<Color>::write(color));
  }

  void operator()(const PageText& text) {
    constexpr std::array anchors{"start", "middle", "end"};
    const std::string at = fmt::format("{},{}", length(text.at.x()), length(height_ - text.at.y()));
    const std::vector<TextPiece> pieces = textPieces(text.text, text.style);
    text_ += fmt::format(
        "<text transform=\"translate({}){}\" text-anchor=\"{}\" font-family=\"{}\" font-size=\"{}\" "
        "fill=\"{}\" xml:space=\"preserve\">",
        at, text.direction == TextDirection::Up ? " rotate(-90)" : "",
        anchors[static_cast<std::size_t>(text.anchor)], families(text.style.font, pieces),
        length(text.style.size), Spelling<Color>::write(text.style.color));
    addLetters(fontNamed(text.style.font), pieces);
    for (const TextPiece& piece : pieces) addLetters(*piece.piece.font, pieces);
    double lift = 0.0;
    for (const TextPiece& piece : pieces) {
      const std::string letters = escaped(piece.piece.letters);
      if (piece.lift == lift && piece.size == text.style.size)
        text_ += letters;
      else
        text_ += fmt::format("<tspan dy=\"{}\" font-size=\"{}\">{}</tspan>", length(lift - piece.lift),
                             length(piece.size), letters);
      lift = piece.lift;
    }
    text_ += "</text>\n";
  }

  void operator()(const PageImage& image) {
    text_ += fmt::format(
        "<image {} preserveAspectRatio=\"none\" style=\"image-rendering:optimizeSpeed;image-rendering:"
        "pixelated\" xlink:href=\"{}\"/>\n",
        rectText(image.rect), pngUri(pngBytes(*image.pixels)));
  }

 private:
  /// Letters that are drawn in a font.
  struct UsedFont {
    std::string family;
    std::set<char32_t> letters;
  };

  /// All of a text: those of scripts from right to left are no longer in the pieces which have them.
  void addLetters(const Font& font, const std::vector<TextPiece>& pieces) {
    if (font.family.empty()) return;
    UsedFont& used = fonts_.try_emplace(font.file, UsedFont{font.family, {}}).first->second;
    for (const TextPiece& piece : pieces)
      for (std::size_t at = 0; at < piece.piece.letters.size();) {
        const auto [letter, length] = letterAt(piece.piece.letters, at);
        used.letters.insert(letter);
        at += std::max<std::size_t>(1, length);
      }
  }

  /// The font, those which have the letters it lacks, and any.
  static std::string families(const std::string& font, const std::vector<TextPiece>& pieces) {
    std::vector<std::string> families{fontNamed(font).family, kDefaultFont};
    for (const TextPiece& piece : pieces) families.push_back(piece.piece.font->family);
    std::string names;
    std::set<std::string> known;
    for (const std::string& family : families)
      if (!family.empty() && known.insert(family).second) names += "'" + family + "', ";
    return escaped(names + "sans-serif");
  }

  std::string rectText(const PixelRect& rect) const {
    return fmt::format("x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"", length(rect.x),
                       length(height_ - rect.top()), length(rect.width), length(rect.height));
  }

  std::string pathOf(const PagePoints& points) const {
    std::string path;
    for (const Eigen::Vector2d& p : points)
      path += fmt::format("{}{},{}", path.empty() ? 'M' : 'L', length(p.x()), length(height_ - p.y()));
    if (points.size() > 2 && points.front() == points.back()) path += 'Z';
    return path;
  }

  void open(const std::optional<PixelRect>& within) {
    if (!within) return;
    const auto known = std::find(clips_.begin(), clips_.end(), *within);
    const auto number = std::distance(clips_.begin(), known);
    if (known == clips_.end()) {
      text_ += fmt::format("<clipPath id=\"within{}\"><rect {}/></clipPath>\n", number, rectText(*within));
      clips_.push_back(*within);
    }
    text_ += fmt::format("<g clip-path=\"url(#within{})\">\n", number);
  }

  void close(const std::optional<PixelRect>& within) {
    if (within) text_ += "</g>\n";
  }

  double height_;
  std::string text_;
  std::vector<PixelRect> clips_;
  std::map<std::string, UsedFont> fonts_;  ///< by file
};

}  // namespace

std::string svgText(const PrintPage& page) {
  SvgPainter painter(page.size[1]);
  for (const PageSketch::Shape& shape : page.sketch.shapes) std::visit(painter, shape);
  const auto paper = [&](double side) { return length(page.pointsPerPixel * side); };
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
      "xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{}pt\" height=\"{}pt\" "
      "viewBox=\"0 0 {} {}\">\n<title>{}</title>\n{}<g>\n{}</g>\n</svg>\n",
      paper(page.size[0]), paper(page.size[1]), length(page.size[0]), length(page.size[1]),
      escaped(page.title), painter.fonts(), painter.text());
}

}  // namespace burnish
