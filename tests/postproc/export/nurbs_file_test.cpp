#include "postproc/export/nurbs_file.h"

#include <gtest/gtest.h>
#include <json/json.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "engine/nurbs/patch.h"
#include "postproc/mesh/patch_geometry.h"
#include "tests/postproc/sample_records.h"

namespace burnish {
namespace {

PatchRecord numbered(PatchRecord record) {
  record.nodes.resize(static_cast<std::size_t>(record.points.cols()));
  for (std::size_t a = 0; a < record.nodes.size(); ++a) record.nodes[a] = static_cast<int>(a);
  return record;
}

std::vector<PatchRecord> readG2(const std::string& text) {
  std::istringstream in(text);
  std::vector<PatchRecord> patches;
  for (int kind = 0, skipped = 0; in >> kind >> skipped >> skipped >> skipped;) {
    PatchRecord patch;
    int dim = 0, rational = 0, functions = 1;
    in >> dim >> rational;
    for (int d = 0; d < (kind == 200 ? 2 : 3); ++d) {
      int count = 0, order = 0;
      in >> count >> order;
      functions *= count;
      patch.directions.push_back({BasisFamily::BSpline, order - 1, {}});
      patch.directions.back().knots.resize(static_cast<std::size_t>(count + order));
      for (double& knot : patch.directions.back().knots) in >> knot;
    }
    patch.points.resize(dim, functions);
    patch.weights.setOnes(functions);
    for (int a = 0; a < functions; ++a) {
      for (int c = 0; c < dim; ++c) in >> patch.points(c, a);
      if (rational == 1) in >> patch.weights(a);
      patch.points.col(a) /= patch.weights(a);
    }
    patches.push_back(numbered(std::move(patch)));
  }
  return patches;
}

std::vector<PatchRecord> readJson(const std::string& text) {
  Json::Value root;
  std::istringstream(text) >> root;
  std::vector<PatchRecord> patches;
  const bool isVolume = root["shape"]["type"].asString() == "volume";
  EXPECT_EQ(root["shape"]["count"].asUInt(), root["shape"]["data"].size());
  for (const Json::Value& shape : root["shape"]["data"]) {
    PatchRecord patch;
    int size[3] = {1, 1, 1};
    for (int d = 0; d < (isVolume ? 3 : 2); ++d) {
      const std::string axis(1, "uvw"[d]);
      size[d] = shape["size_" + axis].asInt();
      patch.directions.push_back({BasisFamily::BSpline, shape["degree_" + axis].asInt(), {}});
      for (const Json::Value& knot : shape["knotvector_" + axis])
        patch.directions.back().knots.push_back(knot.asDouble());
    }
    const int dim = shape["dimension"].asInt(), functions = size[0] * size[1] * size[2];
    patch.points.resize(dim, functions);
    patch.weights.resize(functions);
    for (int w = 0; w < size[2]; ++w)
      for (int u = 0; u < size[0]; ++u)
        for (int v = 0; v < size[1]; ++v) {
          const auto theirs = static_cast<Json::ArrayIndex>(v + size[1] * (u + size[0] * w));
          const int ours = u + size[0] * (v + size[1] * w);
          for (int c = 0; c < dim; ++c)
            patch.points(c, ours) =
                shape["control_points"]["points"][theirs][static_cast<Json::ArrayIndex>(c)].asDouble();
          patch.weights(ours) = shape["control_points"]["weights"][theirs].asDouble();
        }
    patches.push_back(numbered(std::move(patch)));
  }
  return patches;
}

/// The largest distance of what was read from the deformed body, at some places of every span.
template <int Dim>
double distance(const samples::Sample& sample, const std::vector<PatchRecord>& read) {
  const MeshRecord& mesh = meshOf(sample.model, sample.frame);
  EXPECT_EQ(read.size(), mesh.patches.size());
  double largest = 0.0;
  for (std::size_t k = 0; k < read.size(); ++k) {
    const Patch<Dim> ours = patchGeometry<Dim>(mesh.patches[k], sample.frame.displacement);
    const Patch<Dim> theirs = patchGeometry<Dim>(read[k]);
    for (int span = 0; span < ours.basis().numSpans(); ++span)
      for (const double share : {0.0, 0.3, 0.8, 1.0}) {
        Eigen::Matrix<double, Dim, 1> xi;
        for (int d = 0; d < Dim; ++d) {
          const UnivariateBasis& basis = ours.basis().direction(d);
          const int e = ours.basis().spanIndex(span)[static_cast<std::size_t>(d)];
          xi(d) = std::lerp(basis.spanBegin(e), basis.spanEnd(e), share + 0.01 * d * (0.5 - share));
        }
        largest = std::max(largest, (ours.position(xi) - theirs.position(xi)).norm());
      }
  }
  return largest;
}

TEST(NurbsFile, HoldsTheDeformedBodyExactly) {
  for (const samples::Sample& sample :
       {samples::slab(), samples::ring(), samples::square(), samples::twoBodies()}) {
    EXPECT_LT(distance<2>(sample, readG2(nurbsText(sample.model, sample.frame, NurbsFormat::G2))), 2e-15);
    EXPECT_LT(distance<2>(sample, readJson(nurbsText(sample.model, sample.frame, NurbsFormat::Json))), 2e-15);
  }
  const samples::Sample cube = samples::cube();
  EXPECT_LT(distance<3>(cube, readG2(nurbsText(cube.model, cube.frame, NurbsFormat::G2))), 2e-15);
  EXPECT_LT(distance<3>(cube, readJson(nurbsText(cube.model, cube.frame, NurbsFormat::Json))), 2e-15);
}

}  // namespace
}  // namespace burnish
