#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "postproc/export/vtu_series_writer.h"
#include "tests/cli/shell.h"
#include "tests/postproc/export/vtu_files.h"
#include "tests/postproc/sample_records.h"

namespace burnish {
namespace {

using testing::HasSubstr;

/// Files as another program reads them.
class Meshio : public test::VtuFiles {
 protected:
  std::string cellsAndPoints(const samples::Sample& sample, CellKind cells) {
    VtuSeriesWriter(directory_, sample.model, {.cells = cells, .parts = {ExportPart::Body}})
        .write(sample.frame);
    const Outcome outcome =
        shell(directory_, std::string(BURNISH_PYTHON) +
                              " -c \"import meshio; m = meshio.read('frames/body_000000.vtu'); "
                              "print(*[(b.type, *b.data.shape) for b in m.cells], m.points.shape, "
                              "round(float(abs(m.point_data['von_mises [MPa]']).max()), 9))\"");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.out;
  }
};

TEST_F(Meshio, ReadsLinearAndLagrangeCells) {
  const samples::Sample ring = samples::ring({4, 6});
  EXPECT_THAT(cellsAndPoints(ring, CellKind::Linear), HasSubstr("('quad', 384, 4) (425, 3) 100.0\n"));
  EXPECT_THAT(cellsAndPoints(ring, CellKind::Lagrange),
              HasSubstr("('VTK_LAGRANGE_QUADRILATERAL', 24, 9) (117, 3) 100.0\n"));
}

TEST_F(Meshio, OnlyCurvedVolumesAreOfALaterVersion) {
  const auto versionOf = [&](const samples::Sample& sample, CellKind cells) {
    VtuSeriesWriter(directory_, sample.model, {.cells = cells}).write(sample.frame);
    const std::string xml = bytes(directory_ / "frames/body_000000.vtu");
    const std::size_t at = xml.find(" version=\"", xml.find("<VTKFile"));
    return xml.substr(at + 10, 3);
  };
  EXPECT_EQ(versionOf(samples::ring(), CellKind::Linear), "0.1");
  EXPECT_EQ(versionOf(samples::ring(), CellKind::Lagrange), "1.0");
  EXPECT_EQ(versionOf(samples::ring(), CellKind::Bezier), "1.0");
  EXPECT_EQ(versionOf(samples::cube(), CellKind::Bezier), "2.2");
}

}  // namespace
}  // namespace burnish
