#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/analysis/run.h"
#include "engine/core/error.h"
#include "engine/results/history.h"
#include "engine/results/result_reader.h"
#include "engine/scene/reader.h"
#include "engine/solid/span_quadrature.h"
#include "postproc/export/vtu_series_writer.h"
#include "postproc/mesh/frame_parts.h"
#include "postproc/mesh/patch_geometry.h"
#include "tests/engine/analysis/model_samples.h"
#include "tests/postproc/export/vtu_files.h"

namespace burnish {
namespace {

using namespace samples;
using VtuParts = test::VtuFiles;
using testing::DoubleNear;
using testing::Each;
using testing::ElementsAre;

std::vector<double> component(vtkPolyData& data, const char* name, int c = 0) {
  vtkDataArray* array = data.GetPointData()->GetArray(name);
  if (array == nullptr) throw Error(std::string("there is no array ") + name);
  std::vector<double> values;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) values.push_back(array->GetComponent(i, c));
  return values;
}

double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

/// Contact of a face with `points` quadrature points per knot span and direction; pressure where the tool
/// overlaps.
template <int Dim>
ContactRecord contactOn(const ModelRecord& model, const char* faceName, const FrameRecord& frame,
                        int points) {
  const Patch<Dim> patch = patchGeometry<Dim>(model.mesh.patches[0], frame.displacement);
  const FaceId face = faceFromName<Dim>(faceName);
  const auto trace = tracePatch(patch, face);
  ContactRecord contact;
  contact.tool = model.tools[0].name;
  contact.face = faceName;
  contact.nodes = faceFunctions(patch.basis(), face);
  const auto n = static_cast<Eigen::Index>(contact.nodes.size());
  contact.pressure = Eigen::VectorXd::Zero(n);
  contact.averageGap = Eigen::VectorXd::Zero(n);
  contact.active.assign(contact.nodes.size(), 0);
  contact.active[2] = 1;
  std::vector<double> coordinates;
  for (int span = 0; span < trace.basis().numSpans(); ++span)
    for (const auto& xi : spanRule(trace.basis(), span, points).points) {
      const auto x = trace.position(xi);
      coordinates.insert(coordinates.end(), x.begin(), x.end());
    }
  contact.quadraturePoints = Eigen::Map<const Eigen::MatrixXd>(
      coordinates.data(), Dim, static_cast<Eigen::Index>(coordinates.size()) / Dim);
  contact.quadratureGap.resize(contact.quadraturePoints.cols());
  contact.quadratureNormal.resize(Dim, contact.quadraturePoints.cols());
  for (Eigen::Index q = 0; q < contact.quadratureGap.size(); ++q) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    x.head<Dim>() = contact.quadraturePoints.col(q) - frame.toolDisplacement.col(0);
    const RecordedShape& shape = model.tools[0].shape;
    const auto* plane = std::get_if<Plane>(&shape);
    const GapQuery query = plane ? plane->query(x) : std::get<Sphere>(shape).query(x);
    contact.quadratureGap(q) = query.gap;
    contact.quadratureNormal.col(q) = query.normal.head<Dim>();
  }
  contact.quadraturePressure = (-100.0 * contact.quadratureGap).cwiseMax(0.0);
  return contact;
}

/// A ring whose outer arc a plane cuts 0.5 deep.
std::pair<ModelRecord, FrameRecord> pressedRing() {
  ModelRecord model = modelOf(quarterRing());
  model.lengthUnit = "mm";
  model.stressUnit = "MPa";
  model.tools = {{"plate", Plane{{0.0, 3.0, 0.0}, {0.0, -1.0, 0.0}}}};
  FrameRecord frame = frameOf(model, 0, 0.0);
  frame.displacement.setZero();
  frame.toolDisplacement = Eigen::Vector2d(0.0, -1.0);
  frame.contact = {contactOn<2>(model, "right", frame, 3)};
  return {model, frame};
}

/// The pressed ring after it was meshed anew with so many spans across and around.
FrameRecord onNewMesh(const ModelRecord& model, const std::array<int, 2>& spans, int index) {
  ModelRecord other = model;
  other.mesh = modelOf(ringOf(spans)).mesh;
  FrameRecord frame = frameOf(other, index, index);
  frame.mesh = other.mesh;
  frame.toolDisplacement = Eigen::Vector2d(0.0, -1.0);
  frame.contact = {contactOn<2>(other, "right", frame, 3)};
  return frame;
}

TEST_F(VtuParts, BelongToTheMeshOfTheirFrame) {
  const auto [model, first] = pressedRing();
  for (const CellKind cells : {CellKind::Linear, CellKind::Bezier}) {
    VtuSeriesWriter writer(
        directory_, model,
        {.cells = cells, .parts = {ExportPart::Body, ExportPart::Contact, ExportPart::Net}});
    writer.write(first);
    writer.write(onNewMesh(model, {5, 7}, 1));
    writer.write(onNewMesh(model, {2, 3}, 2));
    FrameRecord last = first;
    last.index = 3;
    writer.write(last);
    const std::vector<std::array<int, 2>> spans{{3, 4}, {5, 7}, {2, 3}, {3, 4}};
    for (std::size_t k = 0; k < spans.size(); ++k) {
      const auto [across, around] = spans[k];
      const auto name = [&](const char* format) { return fmt::format(fmt::runtime(format), k); };
      const int perSpan = cells == CellKind::Linear ? model.subdivision * model.subdivision : 1;
      EXPECT_EQ(readGrid(name("body_{:06}.vtu"))->GetNumberOfCells(), perSpan * across * around);
      EXPECT_EQ(readPolyData(name("contact_plate_{:06}.vtp"))->GetNumberOfPoints(), 3 * around);
      const auto net = readPolyData(name("net_{:06}.vtp"));
      EXPECT_EQ(net->GetNumberOfPoints(), (across + 2) * (around + 2));
      EXPECT_EQ(largest(component(*net, "in_contact")), 1.0);
    }
    EXPECT_EQ(readCollection().size(), 4U * 3U);
  }
}

TEST_F(VtuParts, ContactOfASurfaceIsALineAlongItsFace) {
  const auto [model, frame] = pressedRing();
  VtuSeriesWriter(directory_, model).write(frame);
  const auto line = readPolyData("contact_plate_000000.vtp");
  ASSERT_EQ(line->GetNumberOfPoints(), 4 * 3);
  ASSERT_EQ(line->GetNumberOfCells(), 1);
  vtkNew<vtkIdList> ids;
  line->GetCellPoints(0, ids);
  double angle = 0.0;
  for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i) {
    const Eigen::Vector3d x = Eigen::Map<const Eigen::Vector3d>(line->GetPoint(ids->GetId(i)));
    EXPECT_NEAR(x.norm(), kOuterRadius, 1e-13);
    EXPECT_GT(std::atan2(x.y(), x.x()), angle) << "the line goes on and on";
    angle = std::atan2(x.y(), x.x());
  }
  const auto pressure = component(*line, "contact_pressure [MPa]");
  const auto gap = component(*line, "gap [mm]"), status = component(*line, "status");
  const auto tractionX = component(*line, "traction [MPa]", 0),
             traction = component(*line, "traction [MPa]", 1);
  EXPECT_THAT(status, testing::Contains(0.0));
  EXPECT_THAT(status, testing::Contains(1.0));
  EXPECT_THAT(tractionX, Each(DoubleNear(0.0, 1e-14)));
  for (std::size_t i = 0; i < gap.size(); ++i) {
    EXPECT_NEAR(gap[i], 2.0 - line->GetPoint(static_cast<vtkIdType>(i))[1], 1e-13);
    EXPECT_EQ(pressure[i], std::max(0.0, -100.0 * gap[i]));
    EXPECT_EQ(status[i], gap[i] < 0.0 ? 1.0 : 0.0);
    EXPECT_EQ(traction[i], -pressure[i]) << "the plate presses down";
  }
}

TEST_F(VtuParts, ContactOfABlockIsASurface) {
  ModelRecord model =
      modelOf(refined(box({0.0, 0.0, 0.0}, {2.0, 1.0, 3.0}),
                      {KnotVector::uniform(1, 2), KnotVector::uniform(2, 1), KnotVector::uniform(2, 3)}));
  model.tools = {{"ball", Sphere{{1.0, 1.2, 1.5}, 0.5}}};
  FrameRecord frame = frameOf(model, 0, 0.0);
  frame.displacement.setZero();
  frame.contact = {contactOn<3>(model, "top", frame, 4)};
  VtuSeriesWriter(directory_, model).write(frame);
  const auto surface = readPolyData("contact_ball_000000.vtp");
  const auto& points = frame.contact[0].quadraturePoints;
  ASSERT_EQ(surface->GetNumberOfPoints(), points.cols());
  ASSERT_EQ(surface->GetNumberOfCells(), (2 * 4 - 1) * (3 * 4 - 1));
  double area = 0.0;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell) {
    surface->GetCellPoints(cell, ids);
    const auto corner = [&](int c) { return Eigen::Vector3d(points.col(ids->GetId(c))); };
    const double twice = (corner(2) - corner(0)).cross(corner(1) - corner(3)).y();
    EXPECT_GT(twice, 0.0) << "quadrilateral " << cell << " is twisted";
    area += std::abs(twice) / 2.0;
  }
  const Eigen::Vector3d size = points.rowwise().maxCoeff() - points.rowwise().minCoeff();
  EXPECT_NEAR(area, size.x() * size.z(), 1e-12);
  EXPECT_EQ(largest(component(*surface, "contact_pressure")), frame.contact[0].quadraturePressure.maxCoeff());
}

TEST_F(VtuParts, ToolsWithoutContactHaveNone) {
  auto [model, frame] = pressedRing();
  model.tools.push_back({"idle", Plane{{0.0, -5.0, 0.0}, Eigen::Vector3d::UnitY()}});
  frame.toolDisplacement = Eigen::MatrixXd::Zero(2, 2);
  VtuSeriesWriter(directory_, model).write(frame);
  EXPECT_THAT(filesIn(directory_ / "frames"), ElementsAre("body_000000.vtu", "contact_plate_000000.vtp",
                                                          "tool_idle_000000.vtp", "tool_plate_000000.vtp"));
}

TEST_F(VtuParts, FacesThatTouchThemselvesHaveTheirOwnFile) {
  auto [model, frame] = pressedRing();
  VtuSeriesWriter writer(directory_, model, {.parts = {ExportPart::Contact}});
  writer.write(frame);
  frame.index = 1;
  frame.contact.push_back(frame.contact.front());
  frame.contact.back().tool.clear();
  frame.contact.back().quadraturePressure *= 2.0;
  writer.write(frame);
  EXPECT_THAT(filesIn(directory_ / "frames"),
              ElementsAre("contact_plate_000000.vtp", "contact_plate_000001.vtp", "self_contact_000001.vtp"));
  const auto pressure = [&](const char* file) {
    return largest(component(*readPolyData(file), "contact_pressure [MPa]"));
  };
  EXPECT_EQ(pressure("self_contact_000001.vtp"), 2.0 * pressure("contact_plate_000001.vtp"));
  VtuSeriesWriter(directory_, model, {.parts = {ExportPart::Body}}).write(frame);
  EXPECT_THAT(filesIn(directory_ / "frames"), ElementsAre("body_000001.vtu"))
      << "the series before is removed";
}

TEST_F(VtuParts, ContactThatDoesNotFitItsFaceIsRefused) {
  auto [model, frame] = pressedRing();
  ContactRecord& contact = frame.contact[0];
  contact.quadraturePoints.conservativeResize(2, 11);
  contact.quadratureGap.conservativeResize(11);
  contact.quadraturePressure.conservativeResize(11);
  contact.quadratureNormal.conservativeResize(2, 11);
  VtuSeriesWriter writer(directory_, model);
  EXPECT_THROW(writer.write(frame), Error);
  EXPECT_FALSE(std::filesystem::exists(directory_ / "frames.pvd"));
}

TEST_F(VtuParts, NetHoldsTheControlPoints) {
  const auto [model, frame] = pressedRing();
  VtuSeriesWriter(directory_, model, {.parts = {ExportPart::Net}}).write(frame);
  const auto net = readPolyData("net_000000.vtp");
  const Eigen::MatrixXd& points = model.mesh.patches[0].points;
  ASSERT_EQ(net->GetNumberOfPoints(), points.cols());
  EXPECT_EQ(net->GetNumberOfLines(), 5 + 6);
  for (Eigen::Index a = 0; a < points.cols(); ++a)
    for (Eigen::Index d = 0; d < 2; ++d) EXPECT_EQ(net->GetPoint(a)[d], points(d, a));
  const Eigen::VectorXd& weights = model.mesh.patches[0].weights;
  EXPECT_EQ(component(*net, "weight"), std::vector<double>(weights.begin(), weights.end()));
  std::vector<double> active(static_cast<std::size_t>(points.cols()), 0.0);
  active[static_cast<std::size_t>(frame.contact[0].nodes[2])] = 1.0;
  EXPECT_EQ(component(*net, "in_contact"), active);
}

/// A run with a plastic body under a disc (2D) or a ball (3D), exported with all parts.
class ExportedRun : public VtuParts, public testing::WithParamInterface<const char*> {
 protected:
  ExportedRun() {
    RunObserver silent;
    runScene(parseScene(GetParam(), "press.yaml"), directory_ / "run", {.threads = 1}, silent);
    const ResultReader reader(directory_ / "run");
    model_ = reader.model();
    VtuSeriesWriter writer(directory_, model_,
                           {.parts = {ExportPart::Body, ExportPart::Tools, ExportPart::Contact,
                                      ExportPart::Points, ExportPart::Net}});
    for (int i = 0; i < reader.numFrames(); ++i) writer.write(frame_ = reader.frame(i));
  }

  std::string file(const char* stem, const char* extension = "vtp") const {
    return fmt::format("{}_{:06}.{}", stem, frame_.index, extension);
  }

  ModelRecord model_;
  FrameRecord frame_;  ///< the last one
};

TEST_P(ExportedRun, HasTheRangesOfTheResult) {
  const auto points = readPolyData(file("points"));
  ASSERT_EQ(points->GetNumberOfPoints(), frame_.quadrature.positions.cols());
  ASSERT_EQ(points->GetNumberOfVerts(), points->GetNumberOfPoints());
  for (const auto& [name, field] : frame_.quadrature.fields) {
    const std::string unit = field.unit.empty() ? "" : " [" + field.unit + "]";
    for (Eigen::Index c = 0; c < field.values.rows(); ++c)
      EXPECT_EQ(largest(component(*points, (name + unit).c_str(), static_cast<int>(c))),
                field.values.row(c).maxCoeff())
          << name;
  }
  EXPECT_GT(largest(component(*points, "plastic_strain")), 1e-3);

  const auto contact = readPolyData(file("contact_press"));
  const ContactRecord& record = frame_.contact.at(0);
  EXPECT_EQ(largest(component(*contact, "contact_pressure [MPa]")), record.quadraturePressure.maxCoeff());
  EXPECT_GT(largest(component(*contact, "contact_pressure [MPa]")), 0.0);
  EXPECT_EQ(largest(component(*contact, "gap [mm]")), record.quadratureGap.maxCoeff());

  const auto body = readGrid(file("body", "vtu"));
  double mises[2];
  body->GetPointData()->GetArray("von_mises [MPa]")->GetRange(mises);
  const auto& coefficients = frame_.fields.at("von_mises").values;
  EXPECT_LE(mises[1], coefficients.maxCoeff());
  EXPECT_GT(mises[1], 0.7 * coefficients.maxCoeff());
  double displacement[2];
  body->GetPointData()->GetArray("displacement [mm]")->GetRange(displacement, -1);
  EXPECT_GT(displacement[1], 0.0);
}

TEST_P(ExportedRun, PressureOnTheSurfaceIsTheForceOnTheTool) {
  const auto contact = readPolyData(file("contact_press"));
  vtkNew<vtkIdList> ids;
  double force = 0.0;
  const auto traction = component(*contact, "traction [MPa]", model_.dim - 1);
  for (vtkIdType cell = 0; cell < contact->GetNumberOfCells(); ++cell) {
    contact->GetCellPoints(cell, ids);
    const auto x = [&](vtkIdType k) {
      return Eigen::Map<const Eigen::Vector3d>(contact->GetPoint(ids->GetId(k)));
    };
    const auto t = [&](vtkIdType k) { return traction[static_cast<std::size_t>(ids->GetId(k))]; };
    if (model_.dim == 2)
      for (vtkIdType k = 0; k + 1 < ids->GetNumberOfIds(); ++k)
        force +=
            0.5 * (t(k) + t(k + 1)) * std::abs(Eigen::Vector3d(x(k + 1)).x() - Eigen::Vector3d(x(k)).x());
    else
      force += 0.25 * (t(0) + t(1) + t(2) + t(3)) *
               std::abs((Eigen::Vector3d(x(2)) - Eigen::Vector3d(x(0))).x()) *
               std::abs((Eigen::Vector3d(x(2)) - Eigen::Vector3d(x(0))).y());
  }
  const auto history = readHistory(directory_ / "run" / "history.csv");
  const double exact = -history.column(model_.dim == 2 ? "press.fy" : "press.fz").back();
  EXPECT_NEAR(force, exact, 0.05 * std::abs(exact));
}

TEST_P(ExportedRun, ShowsAllPartsAtEveryTime) {
  const auto entries = readCollection();
  std::vector<std::string> names;
  for (const Entry& entry : entries)
    if (entry.time == frame_.time) names.push_back(entry.name);
  EXPECT_THAT(names, ElementsAre("body", "tool_press", "contact_press", "points", "net"));
  EXPECT_EQ(entries.size(), 5u * static_cast<std::size_t>(frame_.index + 1));
}

constexpr const char* kDisc = R"(
units: {length: mm, stress: MPa}
degree: 2
geometry: {shape: rectangle, size: [2, 1], spans: [16, 6]}
material: {law: j2, E: 100, nu: 0.3, hardening: {law: linear, sigma0: 1, modulus: 5}}
supports: [{face: bottom, fix: [x, y]}]
tools: [{name: press, shape: cylinder, center: [1, 1.5], radius: 0.5, motion: {times: [0, 1], y: [0, -0.05]}}]
contact: [{tool: press, face: top, method: augmented-lagrangian}]
steps: [{until: 1, count: 5}]
output: {every: 0.5, vtu: false}
)";

constexpr const char* kBall = R"(
units: {length: mm, stress: MPa}
degree: 2
geometry: {shape: box, size: [1, 1, 0.5], spans: [5, 5, 2]}
material: {law: j2, E: 100, nu: 0.3, hardening: {law: linear, sigma0: 1, modulus: 5}}
supports: [{face: back, fix: [x, y, z]}]
tools: [{name: press, shape: sphere, center: [0.5, 0.5, 1.0], radius: 0.5, motion: {times: [0, 1], z: [0, -0.04]}}]
contact: [{tool: press, face: front, method: augmented-lagrangian}]
steps: [{until: 1, count: 5}]
output: {every: 0.5, vtu: false}
)";

INSTANTIATE_TEST_SUITE_P(Dimensions, ExportedRun, testing::Values(kDisc, kBall),
                         [](const auto& scene) { return scene.index == 0 ? "Disc" : "Ball"; });

}  // namespace
}  // namespace burnish
