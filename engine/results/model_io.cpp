#include "engine/results/model_io.h"

#include <fmt/format.h>

#include "engine/core/error.h"
#include "engine/core/fingerprint.h"
#include "engine/results/check_records.h"
#include "engine/results/file_header.h"
#include "engine/results/mesh_io.h"

namespace burnish {
namespace {

using hdf5::InputGroup;
using hdf5::OutputGroup;

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
SurfaceMesh readSurface(const InputGroup& group) {
  SurfaceMesh mesh;
  const Eigen::MatrixXd points = group.dataset("points").matrix();
  const std::vector<int> cells = group.dataset("cells").integers();
  const int rows = group.integer("points_per_cell");
  if (points.rows() != 3 || rows < 2 || rows > 3 || cells.size() % static_cast<std::size_t>(rows) != 0)
    throw Error(fmt::format(
        "{}: the mesh of a tool has points of {} coordinates and {} numbers of points for cells of {}",
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
  if (shape == "mesh") return readSurface(group);
  throw Error(fmt::format("{}: shape \"{}\" is none of plane, cylinder, sphere, mesh", group.place(), shape));
}

}  // namespace

std::string modelId(const ModelRecord& model) {
  Fingerprint fingerprint;
  fingerprint.add(modelImage({.id = "", .record = model}));
  return fingerprint.text();
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
    root.attribute("num_nodes", record.mesh.numNodes);
    root.attribute("subdivision", record.subdivision);
    root.dataset("scene", record.sceneYaml);
    writePatches(root, record.mesh.patches);
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
  record.mesh.numNodes = root.integer("num_nodes");
  record.subdivision = root.integer("subdivision");
  record.sceneYaml = root.dataset("scene").string();
  record.mesh.patches = readPatches(root, record.dim);
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
