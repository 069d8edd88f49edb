#include "postproc/draw/page/sheet.h"

#include <fmt/format.h>
#include <vtkImageBlend.h>
#include <vtkImageData.h>
#include <vtkImageResize.h>
#include <vtkImageTranslateExtent.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>

#include "engine/core/error.h"
#include "postproc/draw/page/overlay.h"
#include "postproc/draw/page/painted_sketch.h"
#include "postproc/draw/page/png_file.h"
#include "postproc/offscreen/offscreen_canvas.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

constexpr int kNarrowestPanel = 100, kLargestSheetSide = 20000;

constexpr double kPointsPerInch = 72.0, kMillimetresPerInch = 25.4;
constexpr double kPrintedColumn = 80.0;  // mm

// Measures as parts of the text size.
constexpr double kGutter = 0.6;
constexpr double kAboveCaption = 0.45;
constexpr double kLine = 1.25;
constexpr double kDescent = 0.25;

vtkSmartPointer<vtkImageData> readPicture(const fs::path& file) {
  const auto picture = vtkSmartPointer<vtkImageData>::New();
  readPng(file, true, [&](const PngSize& size) {
    picture->SetDimensions(size.width, size.height, 1);
    picture->AllocateScalars(VTK_UNSIGNED_CHAR, size.hasAlpha ? 4 : 3);
    return static_cast<std::byte*>(picture->GetScalarPointer());
  });
  return picture;
}

/// The height of a picture of these proportions in a width of pixels. name: of a file, for the error; may be empty.
int heightIn(int width, const std::array<double, 2>& size, const std::string& name) {
  const double height = size[1] * width / size[0];
  if (height > kLargestSheetSide)
    throw Error(fmt::format("{}: {} x {} pixels would be {:.0f} pixels high on the sheet; expected up to {}",
                            name, size[0], size[1], height, kLargestSheetSide));
  return std::max(1, static_cast<int>(std::lround(height)));
}

/// A picture in a width of pixels.
vtkSmartPointer<vtkImageData> panelPicture(const std::variant<fs::path, vtkSmartPointer<vtkImageData>>& panel,
                                           int width) {
  const auto* file = std::get_if<fs::path>(&panel);
  const auto picture = file != nullptr ? readPicture(*file) : std::get<1>(panel);
  const int* size = picture->GetDimensions();
  if (size[0] == width) return picture;
  vtkNew<vtkImageResize> resize;
  resize->SetInputData(picture);
  resize->SetResizeMethodToOutputDimensions();
  resize->SetOutputDimensions(width,
                              heightIn(width, {static_cast<double>(size[0]), static_cast<double>(size[1])},
                                       file != nullptr ? file->string() : "a panel"),
                              1);
  resize->BorderOn();  // pixels are areas, not points
  resize->Update();
  return resize->GetOutput();
}

/// The text in lines that are not longer than `width`, broken at blanks.
std::vector<std::string> wrapped(const std::string& text, const TextStyle& style, double width) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    begin = end + 1;
    if (word.empty()) continue;
    if (!lines.empty() && textWidth({{lines.back() + " " + word}}, style) <= width)
      lines.back() += " " + word;
    else
      lines.push_back(word);
  }
  return lines;
}

/// A panel that is ready to be placed.
struct Tile {
  int height = 0;  ///< of the picture, in pixels
  std::vector<std::string> caption;
  int left = 0, bottom = 0;  ///< of the picture, in pixels from the lower left corner of the sheet
};

struct Sheet {
  int width = 0, height = 0, panelWidth = 0;
  TextStyle style;
  std::vector<Tile> tiles;
};

int captionHeight(const std::vector<Tile>& tiles, std::size_t first, std::size_t last,
                  const TextStyle& style) {
  std::size_t lines = 0;
  for (std::size_t k = first; k < last; ++k) lines = std::max(lines, tiles[k].caption.size());
  if (lines == 0) return 0;
  return static_cast<int>(
      std::ceil((kAboveCaption + kLine * static_cast<double>(lines - 1) + kDescent) * style.size +
                capitalHeight(style)));
}

/// Places the tiles from the top down; the pictures of a row stand on one line. A last tile may be a picture
/// below all of them.
void place(Sheet& sheet, int columns, bool hasBelow) {
  const int gutter = sheet.width / columns - sheet.panelWidth;
  const std::size_t numPanels = sheet.tiles.size() - (hasBelow ? 1 : 0);
  int top = -gutter / 2;  // from the upper edge, downwards negative, until the height is known
  for (std::size_t first = 0; first < numPanels; first += static_cast<std::size_t>(columns)) {
    const std::size_t last = std::min(first + static_cast<std::size_t>(columns), numPanels);
    int height = 0;
    for (std::size_t k = first; k < last; ++k) height = std::max(height, sheet.tiles[k].height);
    for (std::size_t k = first; k < last; ++k) {
      sheet.tiles[k].left = static_cast<int>(k - first) * (sheet.width / columns) + gutter / 2;
      sheet.tiles[k].bottom = top - height;
    }
    top -= height + captionHeight(sheet.tiles, first, last, sheet.style) + gutter;
  }
  if (hasBelow) {
    Tile& below = sheet.tiles.back();
    below.left = gutter / 2;
    below.bottom = top - below.height;
    top = below.bottom - gutter;
  }
  sheet.height = -top - gutter + gutter / 2;
  for (Tile& tile : sheet.tiles) tile.bottom += sheet.height;
}

/// heights: of the panels, and then of what stands below all of them, if there is more than there are captions.
Sheet makeSheet(const std::vector<int>& heights, const std::vector<std::string>& captions, int columns,
                int width, const Theme& theme) {
  Sheet sheet;
  sheet.width = width;
  sheet.panelWidth = sheetPanelWidth(columns, width);
  sheet.style = {theme.textSize * sheetTextSize(sheet.panelWidth), theme.ink, theme.font};
  for (std::size_t k = 0; k < heights.size(); ++k)
    sheet.tiles.push_back({heights[k], k < captions.size()
                                           ? wrapped(captions[k], sheet.style, sheet.panelWidth)
                                           : std::vector<std::string>()});
  place(sheet, columns, heights.size() > captions.size());
  if (sheet.height > kLargestSheetSide)
    throw Error(
        fmt::format("sheet: it would be {} pixels high; expected up to {}: take more columns or fewer panels",
                    sheet.height, kLargestSheetSide));
  return sheet;
}

PageSketch captionsOf(const Sheet& sheet) {
  PageSketch sketch;
  Overlay overlay(sketch);
  const double size = sheet.style.size;
  for (const Tile& tile : sheet.tiles) {
    double baseline = tile.bottom - kAboveCaption * size - capitalHeight(sheet.style);
    for (const std::string& line : tile.caption) {
      const FittedText fitted = fitText({{line}}, sheet.style, sheet.panelWidth, 0.7 * size);
      overlay.addText(fitted.text, {tile.left + sheet.panelWidth / 2.0, baseline}, fitted.style,
                      Overlay::Anchor::Middle);
      baseline -= kLine * size;
    }
  }
  return sketch;
}

/// Paper with the captions.
vtkSmartPointer<vtkImageData> drawCaptions(const Sheet& sheet, const Color& ground) {
  OffscreenCanvas canvas(sheet.width, sheet.height);
  vtkNew<vtkRenderer> paper;
  canvas.window().AddRenderer(paper);
  paper->SetBackground(ground[0] / 255.0, ground[1] / 255.0, ground[2] / 255.0);
  paint(captionsOf(sheet), *paper, canvas.supersampling());
  return canvas.capture();
}

template <class Panel>
std::vector<std::string> captionTexts(const std::vector<Panel>& panels) {
  if (panels.empty()) throw Error("sheet: found no panel; expected at least one");
  std::vector<std::string> texts;
  for (const Panel& panel : panels) texts.push_back(panel.caption);
  return texts;
}

}  // namespace

int sheetPanelWidth(int columns, int width) {
  if (columns < 1) throw Error(fmt::format("columns: found {}; expected at least 1", columns));
  const int column = width / columns;
  const int panel = static_cast<int>(column / (1.0 + kGutter * sheetTextSize(1000) / 1000.0));
  if (panel < kNarrowestPanel || width > kLargestSheetSide)
    throw Error(
        fmt::format("width: found {} pixels for {} columns; expected up to {}, and columns of {} or more",
                    width, columns, kLargestSheetSide, kNarrowestPanel + kNarrowestPanel / 20));
  return panel;
}

int sheetInnerWidth(int columns, int width) {
  return width - (width / columns - sheetPanelWidth(columns, width));
}

double sheetTextSize(int panelWidth, double points) {
  return std::round(panelWidth * points * kMillimetresPerInch / kPointsPerInch / kPrintedColumn);
}

double sheetPointsPerPixel(int panelWidth) {
  return kPrintedColumn * kPointsPerInch / kMillimetresPerInch / panelWidth;
}

PrintPage pageOfPicture(const fs::path& png) {
  const auto picture = readPicture(png);
  const int* size = picture->GetDimensions();
  PrintPage page{{static_cast<double>(size[0]), static_cast<double>(size[1])}, "", {}};
  page.sketch.shapes.emplace_back(PageImage{{0.0, 0.0, page.size[0], page.size[1]}, picture});
  return page;
}

void drawSheet(const std::vector<SheetPanel>& panels, int columns, int width, const fs::path& png,
               const Theme& theme, const fs::path& below) {
  const std::vector<std::string> captions = captionTexts(panels);
  std::vector<vtkSmartPointer<vtkImageData>> pictures;
  std::vector<int> heights;
  for (const SheetPanel& panel : panels)
    pictures.push_back(panelPicture(panel.picture, sheetPanelWidth(columns, width)));
  if (!below.empty()) pictures.push_back(panelPicture(below, sheetInnerWidth(columns, width)));
  for (const auto& picture : pictures) heights.push_back(picture->GetDimensions()[1]);
  const Sheet sheet = makeSheet(heights, captions, columns, width, theme);
  vtkNew<vtkImageBlend> blend;
  blend->AddInputData(drawCaptions(sheet, theme.paper));
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    vtkNew<vtkImageTranslateExtent> shift;
    shift->SetInputData(pictures[k]);
    shift->SetTranslation(sheet.tiles[k].left, sheet.tiles[k].bottom, 0);
    shift->Update();
    blend->AddInputData(shift->GetOutput());
  }
  blend->Update();
  writePng(*blend->GetOutput(), png);
}

PrintPage printSheet(const std::vector<PrintPanel>& panels, int columns, int width, const Theme& theme,
                     const PrintPage* below) {
  const std::vector<std::string> captions = captionTexts(panels);
  const int panelWidth = sheetPanelWidth(columns, width), innerWidth = sheetInnerWidth(columns, width);
  std::vector<int> heights;
  for (const PrintPanel& panel : panels) heights.push_back(heightIn(panelWidth, panel.page.size, "a panel"));
  if (below != nullptr) heights.push_back(heightIn(innerWidth, below->size, "the picture below"));
  const Sheet sheet = makeSheet(heights, captions, columns, width, theme);
  PrintPage page{{static_cast<double>(sheet.width), static_cast<double>(sheet.height)},
                 "",
                 {},
                 sheetPointsPerPixel(panelWidth)};
  std::vector<PageSketch::Shape>& shapes = page.sketch.shapes;
  if (theme.paper != Color{255, 255, 255}) shapes.emplace_back(wholePage(page.size, theme.paper));
  const auto add = [&](PageSketch sketch) {
    std::move(sketch.shapes.begin(), sketch.shapes.end(), std::back_inserter(shapes));
  };
  const auto addTile = [&](const PrintPage& part, const Tile& tile, int tileWidth) {
    add(placed(part.sketch, tileWidth / part.size[0], {tile.left, tile.bottom}));
  };
  for (std::size_t k = 0; k < panels.size(); ++k) addTile(panels[k].page, sheet.tiles[k], panelWidth);
  if (below != nullptr) addTile(*below, sheet.tiles.back(), innerWidth);
  add(captionsOf(sheet));
  return page;
}

}  // namespace burnish
