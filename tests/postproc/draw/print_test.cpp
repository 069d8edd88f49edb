#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "postproc/compare/metric.h"
#include "postproc/draw/page/sheet.h"
#include "postproc/text/text_file.h"
#include "tests/cli/shell.h"
#include "tests/message_of.h"
#include "tests/postproc/draw/contour_fixture.h"

/// Contour pictures for print, read by the programs that readers of PDF and SVG are made of.
namespace burnish {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::Each;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

class Print : public ContourPictures {
 protected:
  void SetUp() override {
    ContourPictures::SetUp();
    options = small("plastic_strain");
    options.dpi = 150;
  }

  std::string print(const samples::Sample& sample, const char* name) {
    view = drawContour(sample.model, sample.frame, options, dir / name);
    return readText(dir / name);
  }

  /// What a program prints of a file.
  std::string told(const std::string& line) const {
    const Outcome outcome = shell(dir, line);
    EXPECT_EQ(outcome.code, 0) << line << ": " << outcome.err;
    return outcome.out;
  }

  /// The text of the slab as PDF, as programs that search it read it.
  std::string textOf(const samples::Sample& sample) {
    print(sample, "a.pdf");
    return told("pdftotext -layout a.pdf -");
  }

  /// The page in one pixel for each of its points.
  Picture rasterised(const samples::Sample& sample) {
    print(sample, "a.pdf");
    told("pdftoppm -r 72 -png -singlefile a.pdf page");
    return readPicture(dir / "page.png");
  }

  ContourOptions options;
};

/// The lines of a text that begin with one of its letters or digits in a table of poppler's.
std::vector<std::string> rowsOf(const std::string& table) {
  std::vector<std::string> rows;
  std::size_t begin = table.find("---");
  begin = table.find('\n', begin) + 1;
  for (std::size_t end = table.find('\n', begin); end != std::string::npos; end = table.find('\n', begin)) {
    rows.push_back(table.substr(begin, end - begin));
    begin = end + 1;
  }
  return rows;
}

/// The colours of a picture in the mean over squares of `side` pixels.
std::vector<std::array<double, 3>> means(const Picture& picture, int side) {
  const int columns = picture.width / side, rows = picture.height / side;
  std::vector<std::array<double, 3>> sums(static_cast<std::size_t>(columns * rows));
  for (int j = 0; j < rows * side; ++j)
    for (int i = 0; i < columns * side; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        sums[static_cast<std::size_t>(j / side * columns + i / side)][c] +=
            picture.at({i + 0.5, j + 0.5})[c] / static_cast<double>(side * side);
  return sums;
}

/// Mean over the pictures of what their squares differ by in the channel where they differ most, of 255.
double meanDifference(const Picture& a, const Picture& b, int side) {
  const auto first = means(a, side), second = means(b, side);
  double sum = 0.0;
  for (std::size_t k = 0; k < first.size(); ++k) {
    double largest = 0.0;
    for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(first[k][c] - second[k][c]));
    sum += largest;
  }
  return sum / static_cast<double>(first.size());
}

TEST_F(Print, TextsAreFoundInAnyScript) {
  options.title = "Größe Ω, Напряжение σ₁₂";
  options.note = "measured & computed";
  options.size = {500, 300};
  EXPECT_THAT(
      textOf(samples::slab()),
      AllOf(HasSubstr("Größe Ω, Напряжение σ₁₂"), HasSubstr("measured & computed"), HasSubstr("t = 1.5"),
            HasSubstr("Equivalent plastic strain"), HasSubstr("ε̄"), HasSubstr("max 1"), HasSubstr("0.6")));
  EXPECT_THAT(told("pdfinfo a.pdf"), HasSubstr("Größe Ω, Напряжение σ₁₂"));
}

TEST_F(Print, AxesAreNamedInText) {
  options.field = "pressure";
  EXPECT_THAT(textOf(samples::cube()), AllOf(ContainsRegex("\\by\\b"), ContainsRegex("\\bz\\b")));
}

TEST_F(Print, FontsAreEmbedded) {
  options.title = "Ω и я";
  print(samples::slab(), "a.pdf");
  const std::vector<std::string> fonts = rowsOf(told("pdffonts a.pdf"));
  EXPECT_THAT(fonts, Each(ContainsRegex("DejaVuSans.* yes yes yes ")));
  EXPECT_FALSE(fonts.empty());
}

TEST_F(Print, HasOneImageOfTheWantedResolution) {
  for (const int dpi : {72, 150, 600}) {
    options.dpi = dpi;
    print(samples::slab(), "a.pdf");
    EXPECT_THAT(rowsOf(told("pdfimages -list a.pdf")),
                testing::ElementsAre(ContainsRegex(fmt::format(" {} +{} ", dpi, dpi))));
    EXPECT_THAT(told("pdfinfo a.pdf"), HasSubstr("400 x 300 pts"));
  }
}

TEST_F(Print, ImageOfAPictureWithoutPaperIsTransparent) {
  options.transparent = true;
  print(samples::slab(), "a.pdf");
  EXPECT_THAT(told("pdfimages -list a.pdf"), HasSubstr("smask"));
}

TEST_F(Print, SamePictureHasSameBytes) {
  for (const char* name : {"a.pdf", "a.svg"}) {
    const std::string first = print(samples::slab(), name);
    EXPECT_EQ(print(samples::slab(), name), first) << name;
    EXPECT_THAT(first, Not(ContainsRegex("[0-9]{4}-[0-9]{2}-[0-9]{2}|CreationDate"))) << name;
  }
}

/// Antialiasing is another, and letters stand between pixels: squares of some pixels are compared.
TEST_F(Print, ShowsWhatThePictureShows) {
  options.size = {800, 600};
  options.isolines = 5;
  options.arrows = ArrowField::Displacement;
  for (const bool inSpace : {false, true}) {
    const samples::Sample sample = inSpace ? samples::cube() : samples::slab();
    if (inSpace) {
      options.field = "pressure";
      options.knots = options.markExtremes = true;
      options.hiddenLines = HiddenLines::Dashed;
    }
    options.occlusion = false;
    const Picture page = rasterised(sample), picture = drawn(sample, options);
    ASSERT_EQ(page.width, picture.width);
    ASSERT_EQ(page.height, picture.height);
    EXPECT_LE(meanDifference(page, picture, 1), 4.0);
    EXPECT_LE(meanDifference(page, picture, 4), 1.5) << inSpace;
  }
}

TEST_F(Print, ShowsPressedFacesOverTheBody) {
  options.field = "contact_pressure";
  options.size = {800, 600};
  EXPECT_LE(meanDifference(rasterised(samples::rubbedSlab()), drawn(samples::rubbedSlab(), options), 4), 1.0);
}

TEST_F(Print, OutlinesAreVectorsWhereTheBodyIs) {
  const samples::Sample sample = samples::slab();
  const std::string svg = print(sample, "a.svg");
  for (const double x : {0.0, 3.0})
    for (const double y : {0.0, 1.0}) {  // the corners do not move
      const Eigen::Vector2d at = view.pixel(Eigen::Vector2d(x, y));
      const auto shown = [](double value) { return fmt::format("{}", std::round(1e3 * value) / 1e3); };
      EXPECT_THAT(svg, HasSubstr(shown(at.x()) + "," + shown(300.0 - at.y()))) << x << ", " << y;
    }
}

/// Places of the paths of an SVG.
std::vector<Eigen::Vector2d> placesIn(const std::string& svg) {
  const std::regex place(R"((-?[0-9.]+),(-?[0-9.]+))"), path("<path[^>]* d=\"([^\"]*)\"");
  std::vector<Eigen::Vector2d> places;
  for (std::sregex_iterator found(svg.begin(), svg.end(), path), end; found != end; ++found) {
    const std::string line = (*found)[1];
    for (std::sregex_iterator at(line.begin(), line.end(), place); at != end; ++at)
      places.emplace_back(std::stod((*at)[1]), std::stod((*at)[2]));
  }
  return places;
}

/// Of the corners of a cube all but the one behind it are seen.
TEST_F(Print, OutlinesInSpaceAreVectorsWhereTheyAreSeen) {
  options.field = "pressure";
  for (const std::optional<double>& perspective : {std::optional<double>(), std::optional(40.0)}) {
    options.perspective = perspective;
    const std::string svg = print(samples::cube(), "a.svg");
    const std::vector<Eigen::Vector2d> places = placesIn(svg);
    double nearest = HUGE_VAL;
    Eigen::Vector3d hidden;
    const auto cornerAt = [](int k) { return Eigen::Vector3d(k & 1, k >> 1 & 1, k >> 2 & 1); };
    for (int k = 0; k < 8; ++k)
      if (const double depth = view.towardsEye().dot(cornerAt(k)); depth < nearest) {
        nearest = depth;
        hidden = cornerAt(k);
      }
    for (int k = 0; k < 8; ++k) {
      const Eigen::Vector2d at = view.pixel(cornerAt(k)), onPage(at.x(), 300.0 - at.y());
      EXPECT_EQ(
          std::ranges::any_of(places, [&](const auto& place) { return (place - onPage).norm() < 0.02; }),
          cornerAt(k) != hidden)
          << cornerAt(k).transpose();
    }
  }
}

TEST_F(Print, SvgIsXmlWithTexts) {
  options.title = "a & \"b\" < Ω";
  options.knots = true;
  options.window = Eigen::AlignedBox2d(Eigen::Vector2d(0.5, 0.2), Eigen::Vector2d(2.0, 1.2));
  print(samples::slab(), "a.svg");
  const std::string parts = told(
      "python3 -c \"import xml.etree.ElementTree as E; r = E.parse('a.svg').getroot(); "
      "n = '{http://www.w3.org/2000/svg}'; "
      "print(*(''.join(t.itertext()) for t in r.iter(n + 'text')), sep='\\n'); "
      "print(len(list(r.iter(n + 'path'))), 'paths', len(list(r.iter(n + 'image'))), 'image')\"");
  EXPECT_THAT(parts, AllOf(HasSubstr("a & \"b\" < Ω\n"), HasSubstr("t = 1.5\n"), HasSubstr("0.4\n"),
                           HasSubstr("paths 1 image")));
  EXPECT_THAT(readText(dir / "a.svg"), HasSubstr("'DejaVu Sans', sans-serif"));
}

/// With the letters that are drawn, and no others.
TEST_F(Print, SvgHoldsTheFontOfItsTexts) {
  options.title = "Größe Ω я";
  print(samples::slab(), "a.svg");
  told(
      "python3 -c \"import base64, re; s = open('a.svg').read(); "
      "fonts = re.findall(r'font-family:.DejaVu Sans.;src:url.data:font/ttf;base64,([^)]*)', s); assert len(fonts) == 1; "
      "open('part.ttf', 'wb').write(base64.b64decode(fonts[0]))\"");
  const std::string part = dir / "part.ttf";
  const auto isThere = [&](const std::string& letters) {
    return std::ranges::all_of(fontPieces(letters, part), [&](const FontPiece& piece) {
      return piece.font->file == part && piece.font->family == kDefaultFont;
    });
  };
  EXPECT_TRUE(isThere("Größe Ω я t = 1.5 Equivalent plastic strain 0.4"));
  EXPECT_FALSE(isThere("Q"));
  EXPECT_LT(std::filesystem::file_size(part), 30'000);
}

/// Bands and smooth colours, of one body, of a ring of rational patches, of two bodies of which one is plain, and of a part.
TEST_F(Print, FieldsAsVectorsShowWhatThePictureShows) {
  options.size = {800, 600};
  options.printField = PrintField::Vector;
  const auto expectAlike = [&](const samples::Sample& sample, const std::string& what) {
    const Picture page = rasterised(sample), picture = drawn(sample, options);
    EXPECT_LE(meanDifference(page, picture, 1), 4.0) << what;
    EXPECT_LE(meanDifference(page, picture, 4), 1.2) << what;
    EXPECT_THAT(rowsOf(told("pdfimages -list a.pdf")), testing::IsEmpty()) << what;
  };
  for (const int bands : {0, 1, 12}) {
    options.bands = bands;
    options.field = "plastic_strain";
    expectAlike(samples::slab(), fmt::format("slab, {} bands", bands));
    options.range = {0.3, 0.6};
    expectAlike(samples::slab(), fmt::format("within the range, {} bands", bands));
    options.range.reset();
    options.field = "von_mises";
    expectAlike(samples::ring(), fmt::format("ring, {} bands", bands));
  }
  options.field = "plastic_strain";
  options.window = Eigen::AlignedBox2d(Eigen::Vector2d(0.5, 0.2), Eigen::Vector2d(2.0, 1.2));
  expectAlike(samples::twoBodies(), "a part");
  options.window.reset();
  expectAlike(samples::twoBodies(), "two bodies");
  EXPECT_THAT(print(samples::twoBodies(), "a.svg"), AllOf(HasSubstr("evenodd"), Not(HasSubstr("<image"))));
  options.field = "contact_pressure";
  expectAlike(samples::rubbedSlab(), "faces");
  options.field = "von_mises";
  options.threshold = ValueBand{"", {1e3, std::numeric_limits<double>::infinity()}};
  expectAlike(samples::ring(), "nothing is left");
}

TEST_F(Print, FieldsAsVectorsLieInAPlane) {
  options.printField = PrintField::Vector;
  options.field = "pressure";
  EXPECT_THAT(messageOf([&] { print(samples::cube(), "a.pdf"); }),
              HasSubstr("print_field: found vector; a body in space"));
  options.slice = CutPlane{{0.0, 0.0, 0.5}, {0.0, 0.0, 1.0}};
  print(samples::cube(), "a.pdf");
  EXPECT_THAT(rowsOf(told("pdfimages -list a.pdf")), testing::IsEmpty());
}

/// A sheet of a plane body, a body in space and a picture, both ways.
class PrintedSheet : public Print {
 protected:
  static constexpr int kWidth = 1000;

  ContourOptions panel(const char* field, const Theme& theme) const {
    ContourOptions panel = small(field);
    static_cast<Theme&>(panel.theme) = theme;
    panel.size = {sheetPanelWidth(2, kWidth), 260};
    panel.textSize = sheetTextSize(panel.size[0]);
    panel.title = "";
    panel.isolines = 3;
    panel.occlusion = false;
    panel.dpi = 300;
    panel.pointsPerPixel = sheetPointsPerPixel(panel.size[0]);
    return panel;
  }

  /// The sheet as PNG and as a page.
  PrintPage draw(const Theme& theme) {
    const samples::Sample slab = samples::slab(), cube = samples::cube();
    const ContourOptions plane = panel("plastic_strain", theme), space = panel("pressure", theme);
    drawContour(slab.model, slab.frame, plane, dir / "plane.png");
    drawContour(cube.model, cube.frame, space, dir / "space.png");
    const std::vector<std::string> captions{"a) in the plane, Größe Ω", "b) in space", ""};
    drawSheet({{dir / "plane.png", captions[0]}, {dir / "space.png", captions[1]}, {dir / "plane.png", ""}},
              2, kWidth, dir / "sheet.png", theme);
    return printSheet({{contourPage(slab.model, slab.frame, plane), captions[0]},
                       {contourPage(cube.model, cube.frame, space), captions[1]},
                       {pageOfPicture(dir / "plane.png"), captions[2]}},
                      2, kWidth, theme);
  }
};

TEST_F(PrintedSheet, ShowsWhatThePictureShows) {
  for (const char* theme : {"paper", "dark"}) {
    const PrintPage page = draw(themeNamed(theme));
    writePrint(page, dir / "sheet.pdf");
    told(fmt::format("pdftoppm -scale-to-x {} -scale-to-y {} -png -singlefile sheet.pdf page", page.size[0],
                     page.size[1]));
    const Picture printed = readPicture(dir / "page.png"), picture = readPicture(dir / "sheet.png");
    ASSERT_EQ(printed.width, picture.width);
    ASSERT_EQ(printed.height, picture.height);
    EXPECT_LE(meanDifference(printed, picture, 1), 3.0) << theme;
    EXPECT_LE(meanDifference(printed, picture, 4), 1.2) << theme;
  }
}

TEST_F(PrintedSheet, HasTextsOfEightPointsInPanelsOf80Millimetres) {
  const PrintPage page = draw({});
  EXPECT_NEAR(page.pointsPerPixel * sheetPanelWidth(2, kWidth), 80.0 / 25.4 * 72.0, 1e-9);
  writePrint(page, dir / "sheet.pdf");
  EXPECT_THAT(told("pdftotext -layout sheet.pdf -"),
              AllOf(HasSubstr("a) in the plane, Größe Ω"), HasSubstr("b) in space"), HasSubstr("t = 1.5"),
                    HasSubstr("Equivalent plastic strain"), HasSubstr("Pressure")));
  constexpr double lineHeight = 8.0 * (0.928 + 0.236);  // ascent and descent of DejaVu Sans
  const std::string words = told("pdftotext -bbox sheet.pdf -");
  std::smatch word;
  ASSERT_TRUE(std::regex_search(words, word,
                                std::regex("yMin=\"([0-9.]+)\" xMax=\"[0-9.]+\" yMax=\"([0-9.]+)\">space<")));
  EXPECT_NEAR(std::stod(word[2]) - std::stod(word[1]), lineHeight, 0.05 * lineHeight);
}

TEST_F(PrintedSheet, HasAnImageOfTheWantedResolutionForEachField) {
  writePrint(draw({}), dir / "sheet.pdf");
  const std::vector<std::string> images = rowsOf(told("pdfimages -list sheet.pdf"));
  ASSERT_THAT(images, SizeIs(3));
  EXPECT_THAT(images[0], ContainsRegex(" 30[01] +30[01] "));
  EXPECT_THAT(images[1], ContainsRegex(" 30[01] +30[01] "));
}

TEST_F(PrintedSheet, HasVectorsThatStayInTheirPanels) {
  writePrint(draw({}), dir / "sheet.svg");
  const std::string svg = readText(dir / "sheet.svg");
  EXPECT_THAT(svg, AllOf(HasSubstr("<path"), HasSubstr(fmt::format("viewBox=\"0 0 {} ", kWidth))));
  const std::string parts = told(
      "python3 -c \"import xml.etree.ElementTree as E; r = E.parse('sheet.svg').getroot(); "
      "n = '{http://www.w3.org/2000/svg}'; print(len(list(r.iter(n + 'image'))), 'images')\"");
  EXPECT_EQ(parts, "3 images\n");
}

TEST_F(Print, ImagesThatCannotBeDrawnAreRefused) {
  options.size = {8000, 4000};
  EXPECT_THAT(messageOf([&] { print(samples::slab(), "a.pdf"); }), HasSubstr("dpi: "));
  options.size = {400, 300};
  options.dpi = 2400;
  EXPECT_THAT(messageOf([&] { print(samples::slab(), "a.pdf"); }),
              HasSubstr("dpi: found 2400, which makes 13333 x 10000 pixels"));
  EXPECT_FALSE(std::filesystem::exists(dir / "a.pdf"));
}

TEST_F(Print, FileThatCannotBeWrittenIsNamed) {
  EXPECT_THAT(messageOf([&] { print(samples::slab(), "absent/a.pdf"); }), HasSubstr("absent/a.pdf"));
}

samples::Sample stressedSlab() {
  samples::Sample sample = samples::slab();
  Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(3, sample.model.mesh.numNodes);
  stress.row(0) = 10.0 * sample.model.mesh.patches.front().points.row(0);
  sample.frame.fields["stress"] = {{"xx", "yy", "xy"}, "MPa", stress, {}};
  return sample;
}

/// What stands beside it in a sheet has other ends, which none of its values can pass.
TEST_F(Print, AScaleOfItsOwnRangeHasNoRoomForArrowsOfOthers) {
  options.field = "plastic_strain";
  options.room.emplace().otherRanges = true;
  const std::string alone = print(samples::slab(), "a.svg");
  options.room->extremes = {{-5.0, 10.0}};
  EXPECT_EQ(print(samples::slab(), "a.svg"), alone);
}

/// Below one another in a sheet, however long the numbers at their arrows are.
TEST_F(Print, BarsWithArrowsStandAtOnePlaceInSheets) {
  options.field = "plastic_strain";
  options.room.emplace().otherRanges = true;
  const auto placeOfLimit = [&](double highest) {
    options.range = {{0.0, highest}};
    const std::string svg = print(samples::slab(), "a.svg");
    const std::regex limit("translate\\(([0-9.]+),[^>]*>≥ ");
    std::smatch found;
    EXPECT_TRUE(std::regex_search(svg, found, limit));
    return found[1].str();
  };
  EXPECT_EQ(placeOfLimit(0.5), placeOfLimit(0.4321));
}

/// A bar with room for one round number between ends that nothing else tells has numbers at its ends.
TEST_F(Print, ScalesOfAnySizeHaveTwoNumbers) {
  options.field = "stress.xx";
  options.range = {{-300.0, 300.0}};
  for (const std::array<int, 2>& size : {std::array{200, 150}, std::array{240, 170}, std::array{400, 225}}) {
    options.size = size;
    const std::string svg = print(stressedSlab(), "a.svg");
    EXPECT_THAT(svg, ContainsRegex(">−[23]00<")) << size[0];
    EXPECT_THAT(svg, ContainsRegex(">[23]00<")) << size[0];
  }
}

TEST_F(Print, TitlesOfScalesKeepTheirUnit) {
  options.field = "stress.xx";
  options.textSize = 12.0;
  options.size = {200, 150};
  const std::string svg = print(stressedSlab(), "a.svg");
  EXPECT_THAT(svg, AllOf(HasSubstr("…"), HasSubstr("[MPa]")));
}

}  // namespace
}  // namespace burnish
