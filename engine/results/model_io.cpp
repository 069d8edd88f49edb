#include "engine/results/model_io.h"

#include <fmt/format.h>

#include "engine/core/error.h"
#include "engine/results/check_records.h"
#include "engine/results/file_header.h"

namespace burnish {
namespace {

using hdf5::InputDataset;
using hdf5::InputGroup;
using hdf5::OutputGroup;
using hdf5::OutputObject;

const char* const kFamilyNames[] = {"bspline", "lagrange"};  // in the order of BasisFamily

void writePatch(const OutputGroup& group, const PatchRecord& patch) {
  group.dataset("points", patch.points);
  group.dataset("weights", patch.weights);
  group.dataset("nodes", patch.nodes);
  for (std::size_t d = 0; d < patch.directions.size(); ++d) {
    const DirectionRecord& direction = patch.directions[d];
    const OutputObject knots = group.dataset(fmt::format("knots_{}", d), direction.knots);
    knots.attribute("family", std::string(kFamilyNames[static_cast<int>(direction.family)]));
    knots.attribute("degree", direction.degree);
  }
}

DirectionRecord readDirection(const InputDataset& dataset) {
  const std::string family = dataset.text("family");
  if (family != kFamilyNames[0] && family != kFamilyNames[1])
    throw Error(fmt::format("{}: family \"{}\" is neither {} nor {}", dataset.place(), family,
                            kFamilyNames[0], kFamilyNames[1]));
  const Eigen::VectorXd knots = dataset.vector();
  return {.family = family == kFamilyNames[0] ? BasisFamily::BSpline : BasisFamily::Lagrange,
          .degree = dataset.integer("degree"),
          .knots = {knots.begin(), knots.end()}};
}

PatchRecord readPatch(const InputGroup& group, int dim) {
  PatchRecord patch;
  patch.points = group.dataset("points").matrix();
  patch.weights = group.dataset("weights").vector();
  patch.nodes = group.dataset("nodes").integers();
  for (int d = 0; d < dim; ++d)
    patch.directions.push_back(readDirection(group.dataset(fmt::format("knots_{}", d))));
  return patch;
}

struct ShapeWriter {
  const OutputGroup& group;

  void operator()(const Plane& plane) const {
    group.attribute("shape", std::string("plane"));
    group.attribute("origin", plane.origin);
    group.attribute("normal", plane.normal);
  }
  void operator()(const Cylinder& cylinder) const {
    group.attribute("shape", std::string("cylinder"));
    group.attribute("center", cylinder.center);
    group.attribute("axis", cylinder.axis);
    group.attribute("radius", cylinder.radius);
  }
  void operator()(const Sphere& sphere) const {
    group.attribute("shape", std::string("sphere"));
    group.attribute("center", sphere.center);
    group.attribute("radius", sphere.radius);
  }
  void operator()(const SurfaceMesh& mesh) const {
    group.attribute("shape", std::string("mesh"));
    group.attribute("closed", mesh.closed ? 1 : 0);
    group.attribute("points_per_cell", static_cast<int>(mesh.cells.rows()));
    group.dataset("points", Eigen::MatrixXd(mesh.points));
    group.dataset("cells", std::vector<int>(mesh.cells.data(), mesh.cells.data() + mesh.cells.size()));
  }
};

/// A mesh whose list of cells is no whole number of cells, or refers to points that do not exist, is refused
/// later, with the other records.
SurfaceMesh readMesh(const InputGroup& group) {
  SurfaceMesh mesh;
  const Eigen::MatrixXd points = group.dataset("points").matrix();
  const std::vector<int> cells = group.dataset("cells").integers();
  const int rows = group.integer("points_per_cell");
  if (points.rows() != 3 || rows < 2 || rows > 3 || cells.size() % static_cast<std::size_t>(rows) != 0)
    throw Error(
        fmt::format("{}: the mesh of a tool has points of {} coordinates and {} numbers of points "
                    "for cells of {}",
                    group.place(), points.rows(), cells.size(), rows));
  mesh.points = points;
  mesh.cells =
      Eigen::Map<const Eigen::MatrixXi>(cells.data(), rows, static_cast<Eigen::Index>(cells.size()) / rows);
  mesh.closed = group.integer("closed") != 0;
  return mesh;
}

RecordedShape readShape(const InputGroup& group) {
  const std::string shape = group.text("shape");
  if (shape == "plane") return Plane{group.vector3("origin"), group.vector3("normal")};
  if (shape == "cylinder")
    return Cylinder{group.vector3("center"), group.vector3("axis"), group.real("radius")};
  if (shape == "sphere") return Sphere{group.vector3("center"), group.real("radius")};
  if (shape == "mesh") return readMesh(group);
  throw Error(fmt::format("{}: shape \"{}\" is none of plane, cylinder, sphere, mesh", group.place(), shape));
}

/// FNV-1a, 64 bits.
std::string fingerprint(const std::vector<std::byte>& bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const std::byte byte : bytes) hash = (hash ^ static_cast<std::uint64_t>(byte)) * 0x100000001b3u;
  return fmt::format("{:016x}", hash);
}

}  // namespace

std::string modelId(const ModelRecord& model) {
  return fingerprint(modelImage({.id = "", .record = model}));
}

std::vector<std::byte> modelImage(const StoredModel& model) {
  hdf5::OutputImage image;
  {
    const ModelRecord& record = model.record;
    const OutputGroup root = image.root();
    writeHeader(root, "model", model.id);
    root.attribute("program", record.program);
    root.attribute("title", record.title);
    root.attribute("dim", record.dim);
    root.attribute("length_unit", record.lengthUnit);
    root.attribute("stress_unit", record.stressUnit);
    root.attribute("num_nodes", record.numNodes);
    root.attribute("subdivision", record.subdivision);
    root.dataset("scene", record.sceneYaml);
    const OutputGroup patches = root.group("patches");
    for (std::size_t i = 0; i < record.patches.size(); ++i)
      writePatch(patches.group(std::to_string(i)), record.patches[i]);
    const OutputGroup tools = root.group("tools");
    for (std::size_t i = 0; i < record.tools.size(); ++i) {
      const OutputGroup tool = tools.group(std::to_string(i));
      tool.attribute("name", record.tools[i].name);
      tool.attribute("pivot", record.tools[i].pivot);
      tool.attribute("pivot_axis", record.tools[i].axis);
      tool.attribute("half_thickness", record.tools[i].halfThickness);
      std::visit(ShapeWriter{tool}, record.tools[i].shape);
    }
  }
  return image.finish();
}

StoredModel readModel(const std::filesystem::path& path) {
  const hdf5::InputFile file(path);
  const InputGroup root = file.root();
  StoredModel model{.id = readHeader(root, "model"), .record = {}};
  ModelRecord& record = model.record;
  record.program = root.text("program");
  record.title = root.text("title");
  record.dim = root.integer("dim");
  record.lengthUnit = root.text("length_unit");
  record.stressUnit = root.text("stress_unit");
  record.numNodes = root.integer("num_nodes");
  record.subdivision = root.integer("subdivision");
  record.sceneYaml = root.dataset("scene").string();
  const InputGroup patches = root.group("patches");
  for (std::size_t i = 0; i < patches.names().size(); ++i)
    record.patches.push_back(readPatch(patches.group(std::to_string(i)), record.dim));
  const InputGroup tools = root.group("tools");
  for (std::size_t i = 0; i < tools.names().size(); ++i) {
    const InputGroup tool = tools.group(std::to_string(i));
    record.tools.push_back({.name = tool.text("name"),
                            .shape = readShape(tool),
                            .pivot = tool.vector3("pivot"),
                            .axis = tool.vector3("pivot_axis"),
                            .halfThickness = tool.real("half_thickness")});
  }
  checkModel(record, path.string());
  return model;
}

}  // namespace burnish
