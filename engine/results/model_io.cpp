#include "engine/results/model_io.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <array>
#include <optional>
#include <utility>
#include <variant>

#include "engine/core/error.h"
#include "engine/core/fingerprint.h"
#include "engine/results/check_records.h"
#include "engine/results/file_header.h"
#include "engine/results/mesh_io.h"

namespace burnish::inline results {
namespace {

using hdf5::InputGroup;
using hdf5::OutputGroup;

/// Writes a shape that is kept as it is, and reads one.
struct AttributeWriter {
  const OutputGroup& group;

  template <class T>
  void operator()(const char* name, const T& value) const {
    group.attribute(name, value);
  }
};
struct AttributeReader {
  const InputGroup& group;

  void operator()(const char* name, double& value) const { value = group.real(name); }
  void operator()(const char* name, Eigen::Vector3d& value) const { value = group.vector3(name); }
};

/// What a kind of shape is called in a file.
template <class Shape>
constexpr const char* kShapeName = Shape::kind.key;
template <>
constexpr const char* kShapeName<SurfaceMesh> = "mesh";

template <class Shape>
void writeKeys(const OutputGroup& group, Shape shape) {
  AttributeWriter writer{group};
  archive(writer, shape);
}

void writeKeys(const OutputGroup& group, const SurfaceMesh& mesh) {
  group.attribute("closed", mesh.closed ? 1 : 0);
  group.attribute("points_per_cell", static_cast<int>(mesh.cells.rows()));
  group.dataset("points", Eigen::MatrixXd(mesh.points));
  group.dataset("cells", std::vector<int>(mesh.cells.data(), mesh.cells.data() + mesh.cells.size()));
}

void writeShape(const OutputGroup& group, const RecordedShape& shape) {
  std::visit(
      [&]<class Shape>(const Shape& one) {
        group.attribute("shape", std::string(kShapeName<Shape>));
        writeKeys(group, one);
      },
      shape);
}

template <class Shape>
void readKeys(const InputGroup& group, Shape& shape) {
  AttributeReader reader{group};
  archive(reader, shape);
}

/// A mesh whose list of cells is no whole number of cells, or refers to points that do not exist, is refused
/// later, with the other records.
void readKeys(const InputGroup& group, SurfaceMesh& mesh) {
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
}

/// kinds: any shape.
template <class... Kinds>
RecordedShape readShape(const InputGroup& group, const std::variant<Kinds...>& /*kinds*/) {
  const std::string name = group.text("shape");
  std::optional<RecordedShape> found;
  const auto readIf = [&]<class Shape>(Shape shape) {
    if (name != kShapeName<Shape>) return;
    readKeys(group, shape);
    found = std::move(shape);
  };
  (readIf(Kinds()), ...);
  if (found) return *found;
  throw Error(fmt::format("{}: shape \"{}\" is none of {}", group.place(), name,
                          fmt::join(std::array{kShapeName<Kinds>...}, ", ")));
}

/// Names of the bodies, and the numbers of their patches.
void writeBodies(const OutputGroup& bodies, const ModelRecord& record) {
  for (std::size_t k = 0; k < record.bodies.size(); ++k) {
    std::vector<int> patches;
    for (std::size_t p = 0; p < record.mesh.patches.size(); ++p)
      if (record.mesh.patches[p].body == static_cast<int>(k)) patches.push_back(static_cast<int>(p));
    const OutputGroup body = bodies.group(std::to_string(k));
    body.attribute("name", record.bodies[k]);
    body.dataset("patches", patches);
  }
}

void readBodies(const InputGroup& bodies, ModelRecord& record) {
  for (std::size_t k = 0; k < bodies.names().size(); ++k) {
    const InputGroup body = bodies.group(std::to_string(k));
    record.bodies.push_back(body.text("name"));
    for (const int patch : body.dataset("patches").integers()) {
      if (patch < 0 || patch >= std::ssize(record.mesh.patches))
        throw Error(fmt::format("{}: patch {} of {}", body.place(), patch, record.mesh.patches.size()));
      record.mesh.patches[static_cast<std::size_t>(patch)].body = static_cast<int>(k);
    }
  }
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
    if (!record.bodies.empty()) writeBodies(root.group("bodies"), record);
    const OutputGroup tools = root.group("tools");
    for (std::size_t i = 0; i < record.tools.size(); ++i) {
      const OutputGroup tool = tools.group(std::to_string(i));
      tool.attribute("name", record.tools[i].name);
      tool.attribute("pivot", record.tools[i].pivot);
      tool.attribute("pivot_axis", record.tools[i].axis);
      tool.attribute("half_thickness", record.tools[i].halfThickness);
      if (record.tools[i].until) tool.attribute("until", *record.tools[i].until);
      writeShape(tool, record.tools[i].shape);
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
  if (root.contains("bodies")) readBodies(root.group("bodies"), record);
  const InputGroup tools = root.group("tools");
  for (std::size_t i = 0; i < tools.names().size(); ++i) {
    const InputGroup tool = tools.group(std::to_string(i));
    record.tools.push_back(
        {.name = tool.text("name"),
         .shape = readShape(tool, RecordedShape()),
         .pivot = tool.vector3("pivot"),
         .axis = tool.vector3("pivot_axis"),
         .halfThickness = tool.real("half_thickness"),
         .until = tool.hasAttribute("until") ? std::optional(tool.real("until")) : std::nullopt});
  }
  checkModel(record, path.string());
  return model;
}

bool isAxisymmetric(const ModelRecord& model) {
  try {
    return YAML::Load(model.sceneYaml)["kinematics"].as<std::string>("") == "axisymmetric";
  } catch (const YAML::Exception&) {
    return false;  // a model without a scene that can be read
  }
}

}  // namespace burnish::inline results
