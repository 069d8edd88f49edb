#include "postproc/export/nurbs_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <json/json.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "engine/nurbs/patch.h"
#include "engine/scene/reader.h"
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

/// The body of a scene that takes a file.
Net netOf(const std::string& text, const char* name, int entry) {
  const auto directory =
      std::filesystem::path(testing::TempDir()) / ("nurbs_file_" + std::to_string(::getpid()));
  std::filesystem::create_directories(directory);
  std::ofstream(directory / name) << text;
  const Scene scene = parseScene(
      fmt::format(
          "geometry: {{shape: control-net, file: {}, entry: {}}}\nmaterial: {{law: neo-hookean, E: 1, nu: 0.3}}\n"
          "steps: [{{until: 1, count: 1}}]\n",
          name, entry),
      (directory / "scene.yaml").string());
  std::filesystem::remove_all(directory);
  return std::get<ControlNetBody>(scene.body.geometry.shape);
}

/// The largest difference of a point of a net from those of a patch on current positions; infinite if knots or weights are not the
/// same bits.
double off(const Net& net, const PatchRecord& patch, const Eigen::MatrixXd& displacement) {
  for (std::size_t d = 0; d < patch.directions.size(); ++d)
    if (net.degrees.at(d) != patch.directions[d].degree || net.knots.at(d) != patch.directions[d].knots)
      return INFINITY;
  double largest = 0.0;
  for (Eigen::Index a = 0; a < patch.points.cols(); ++a) {
    const auto k = static_cast<std::size_t>(a);
    if ((net.weights.empty() ? 1.0 : net.weights.at(k)) != patch.weights(a)) return INFINITY;
    for (Eigen::Index c = 0; c < patch.points.rows(); ++c)
      largest = std::max(largest, std::abs(net.points.at(k).at(static_cast<std::size_t>(c)) -
                                           (patch.points(c, a) + displacement(c, patch.nodes[k]))));
  }
  return largest;
}

TEST(NurbsFile, IsReadBackByScenesToTheLastBit) {
  int rational = 0;
  for (const samples::Sample& sample :
       {samples::slab(), samples::ring(), samples::square(), samples::twoBodies(), samples::cube()}) {
    const auto& patches = meshOf(sample.model, sample.frame).patches;
    const std::string g2 = nurbsText(sample.model, sample.frame, NurbsFormat::G2);
    const std::string json = nurbsText(sample.model, sample.frame, NurbsFormat::Json);
    for (std::size_t k = 0; k < patches.size(); ++k) {
      if (patches[k].directions[0].family != BasisFamily::BSpline) continue;
      const bool isRational = (patches[k].weights.array() != patches[k].weights(0)).any();
      rational += isRational;
      EXPECT_EQ(off(netOf(json, "body.json", static_cast<int>(k)), patches[k], sample.frame.displacement),
                0.0);
      EXPECT_LE(off(netOf(g2, "body.g2", static_cast<int>(k)), patches[k], sample.frame.displacement),
                isRational ? 1e-15 : 0.0);
    }
  }
  EXPECT_GT(rational, 0);
}

TEST(NurbsFile, FacesForCadAreThoseOfTheBodyWithTheBodyBehindThem) {
  const samples::Sample cube = samples::cube();
  const auto bodies = nurbsBodies(cube.model, cube.frame);
  ASSERT_EQ(bodies.size(), 1U);
  const std::vector<CadFace>& faces = bodies.front().faces;
  ASSERT_EQ(faces.size(), 6U);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const CadFace& face : faces) middle += face.points.rowwise().mean() / 6.0;
  for (const CadFace& face : faces) {
    const Patch<2, 3> surface(
        TensorBasis<2>({UnivariateBasis::bspline(KnotVector(face.degrees[0], face.knots[0])),
                        UnivariateBasis::bspline(KnotVector(face.degrees[1], face.knots[1]))}),
        face.points, face.weights);
    const Eigen::Vector2d at(surface.basis().direction(0).parameterAt(0.4),
                             surface.basis().direction(1).parameterAt(0.6));
    const auto J = surface.jacobian(at);
    const Eigen::Vector3d normal = (face.reversed ? -1.0 : 1.0) * J.col(0).cross(J.col(1));
    EXPECT_GT(normal.dot(surface.position(at) - middle), 0.0) << face.name;
  }
  EXPECT_EQ(faces.back().name.substr(faces.back().name.find('.')), ".1.front");
  EXPECT_EQ(faces.back().name.substr(0, faces.back().name.find('.')), bodies.front().name);
  EXPECT_EQ(nurbsBodies(samples::slab().model, samples::slab().frame).front().faces.size(), 1U);
}

}  // namespace
}  // namespace burnish
