#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "postproc/draw/foreign/foreign_picture.h"
#include "tests/engine/analysis/run_scene.h"
#include "tests/message_of.h"
#include "tests/postproc/picture.h"

/// Arrows, streamlines and crosses of other programs' vectors and tensors.
namespace burnish {
namespace {

using testing::HasSubstr;

/// Vectors and a tensor over a block that begins at some x and ends at x = 1; flat, a sheet.
struct VectorFile {
  VectorFile(const std::string& name, double begin, bool isFlat, const std::string& vector = "flow")
      : directory(name), file(directory.path() / "vectors.vtk") {
    const int cells = begin < 0.0 ? 16 : 8, layers = isFlat ? 0 : 3;
    std::filesystem::create_directories(directory.path());
    std::ofstream out(file);
    out << "# vtk DataFile Version 3.0\nvectors\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS " << cells + 1
        << " 9 " << layers + 1 << "\nPOINTS " << (cells + 1) * 9 * (layers + 1) << " double\n";
    const auto write = [&](const std::function<void(double, double)>& one) {
      for (int k = 0; k <= layers; ++k)
        for (int j = 0; j <= 8; ++j)
          for (int i = 0; i <= cells; ++i) {
            z = 0.1 * k;
            one(begin + i / 8.0, j / 8.0);
          }
    };
    write([&](double x, double y) { out << x << ' ' << y << ' ' << z << '\n'; });
    out << "POINT_DATA " << (cells + 1) * 9 * (layers + 1) << "\nVECTORS " << vector << " double\n";
    write([&](double x, double y) { out << x * (1.0 + y) << ' ' << 0.4 + x * x << " 0\n"; });
    out << "VECTORS even double\n";
    write([&](double, double) { out << "1 0.5 0\n"; });
    out << "SCALARS height double 1\nLOOKUP_TABLE default\n";
    write([&](double, double y) { out << y << '\n'; });
    out << "TENSORS sigma double\n";
    write([&](double x, double y) {
      const double xy = x * (0.5 + y);
      out << 1.0 << ' ' << xy << " 0 " << xy << ' ' << -y << " 0 0 0 0.3\n";
    });
    const int numCells = cells * 8 * std::max(1, layers);
    out << "CELL_DATA " << numCells << "\nVECTORS steady double\n";
    for (int k = 0; k < numCells; ++k) out << "1 0.5 0\n";
  }

  Picture drawn(const ForeignOptions& options) const {
    const std::filesystem::path picture = directory.path() / "picture.png";
    drawForeign(ForeignFile(file), {0}, options, {picture});
    return readPicture(picture);
  }

  test::ScratchDirectory directory;
  std::filesystem::path file;
  double z = 0.0;
};

ForeignOptions optionsOf(const std::string& field, ArrowField arrows) {
  ForeignOptions options;
  options.field = field;
  options.arrows = arrows;
  options.size = {480, 300};
  options.view.name = "xy";
  options.knots = options.colorScale = options.occlusion = false;
  options.title = "";
  return options;
}

/// Pixels that differ by more than the rounding of edges.
int differing(const Picture& a, const Picture& b) {
  constexpr int kRounding = 24;
  EXPECT_EQ(a.pixels.size(), b.pixels.size());
  int count = 0;
  for (std::size_t k = 0; k < std::min(a.pixels.size(), b.pixels.size()); ++k)
    count += difference(a.pixels[k], b.pixels[k]) > kRounding ? 1 : 0;
  return count;
}

/// x (1 + y), 0.4 + x² is its own image in x = 0, and so is a tensor whose shear stress is odd in x.
TEST(ForeignArrows, OfAHalfAndItsImageAreThoseOfTheWhole) {
  for (const bool isFlat : {true, false}) {
    const VectorFile whole("foreign_arrows_whole", -1.0, isFlat), half("foreign_arrows_half", 0.0, isFlat);
    for (const auto& [field, arrows] :
         {std::pair{"flow", ArrowField::Field}, std::pair{"sigma.xx", ArrowField::Principal}}) {
      ForeignOptions options = optionsOf(field, arrows);
      const Picture all = whole.drawn(options);
      ForeignOptions bare = options;
      bare.arrows = ArrowField::None;
      EXPECT_GT(differing(all, whole.drawn(bare)), 2000) << field;
      options.mirror = {MirrorPlane{0, 0.0}};
      EXPECT_LT(differing(all, half.drawn(options)), 40) << field;
    }
  }
}

/// A sheet in space has no outside: from either side it is seen with its arrows, which are each other's mirror images.
TEST(ForeignArrows, OfASheetAreSeenFromBothSides) {
  const test::ScratchDirectory directory("foreign_arrows_sheet");
  std::filesystem::create_directories(directory.path());
  const std::filesystem::path file = directory.path() / "sheet.vtk", name = directory.path() / "sheet.png";
  std::ofstream out(file);
  out << "# vtk DataFile Version 3.0\nsheet\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS 9 9 1\nPOINTS 81 double\n";
  for (int k = 0; k < 81; ++k) out << k % 9 / 8.0 << ' ' << k / 9 / 8.0 << ' ' << 1e-3 * (k % 9) << '\n';
  out << "POINT_DATA 81\nVECTORS flow double\n";
  for (int k = 0; k < 81; ++k) out << "0.2 1 0\n";
  out.close();
  for (const char* view : {"0,0,1", "0,0,-1"}) {
    ForeignOptions options = optionsOf("flow", ArrowField::Field);
    options.view.name = view;
    drawForeign(ForeignFile(file), {0}, options, {name});
    const Picture with = readPicture(name);
    options.arrows = ArrowField::None;
    drawForeign(ForeignFile(file), {0}, options, {name});
    EXPECT_GT(differing(with, readPicture(name)), 2000) << view;
  }
}

TEST(ForeignArrows, GoAlongTheDrawnVectorOrTheDisplacement) {
  const VectorFile flow("foreign_arrows_flow", -1.0, true),
      moved("foreign_arrows_moved", -1.0, true, "displacement");
  const auto pixels = [](const VectorFile& file, const char* field, ArrowField arrows) {
    return file.drawn(optionsOf(field, arrows));
  };
  EXPECT_LT(differing(pixels(flow, "flow.y", ArrowField::Field),
                      pixels(moved, "displacement.y", ArrowField::Displacement)),
            800)
      << "they differ in words alone";
  EXPECT_LT(differing(pixels(flow, "even", ArrowField::Field), pixels(flow, "steady", ArrowField::Field)),
            800)
      << "of points and of cells";
  EXPECT_GT(
      differing(pixels(flow, "flow.y", ArrowField::Field), pixels(flow, "flow.y", ArrowField::Streamlines)),
      2000);
  const auto refused = [&](const VectorFile& file, const char* field, ArrowField arrows, const char* why) {
    EXPECT_THAT(messageOf([&] { file.drawn(optionsOf(field, arrows)); }), HasSubstr(why));
  };
  refused(flow, "height", ArrowField::Field, "vectors: found field, and height is no vector of ");
  refused(flow, "flow", ArrowField::Displacement, "has no vector called displacement");
  refused(flow, "height", ArrowField::Streamlines, "streamlines go along the vector that is drawn");
  refused(flow, "flow", ArrowField::Traction, "vectors: only runs of burnish have contact tractions");
  const VectorFile block("foreign_arrows_block", -1.0, false);
  refused(block, "flow", ArrowField::Streamlines, "is a body in space: add slice");
  EXPECT_NO_THROW(moved.drawn(optionsOf("height", ArrowField::Streamlines)));
  EXPECT_NO_THROW(flow.drawn(optionsOf("height", ArrowField::Principal))) << "sigma";
}

}  // namespace
}  // namespace burnish
