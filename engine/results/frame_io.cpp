#include "engine/results/frame_io.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/error.h"
#include "engine/results/check_records.h"
#include "engine/results/file_header.h"
#include "engine/results/mesh_io.h"

namespace burnish::inline results {
namespace {

using hdf5::InputDataset;
using hdf5::InputGroup;
using hdf5::OutputGroup;
using hdf5::OutputObject;

void writeFields(const OutputGroup& group, const std::map<std::string, FieldRecord>& fields) {
  for (const auto& [name, field] : fields) {
    const OutputObject dataset = group.dataset(name, field.values);
    dataset.attribute("components", field.components);
    dataset.attribute("unit", field.unit);
    if (!field.bodies.empty()) dataset.attribute("bodies", field.bodies);
  }
}

std::map<std::string, FieldRecord> readFields(const InputGroup& group) {
  std::map<std::string, FieldRecord> fields;
  for (const std::string& name : group.names()) {
    const InputDataset dataset = group.dataset(name);
    fields[name] = {
        .components = dataset.texts("components"),
        .unit = dataset.text("unit"),
        .values = dataset.matrix(),
        .bodies = dataset.hasAttribute("bodies") ? dataset.texts("bodies") : std::vector<std::string>()};
  }
  return fields;
}

void writeContact(const OutputGroup& group, const ContactRecord& contact) {
  group.attribute("tool", contact.tool);
  if (!contact.pair.empty()) group.attribute("pair", contact.pair);
  group.attribute("face", contact.face);
  group.attribute("patch", contact.patch);
  group.dataset("nodes", contact.nodes);
  group.dataset("pressure", contact.pressure);
  group.dataset("average_gap", contact.averageGap);
  group.dataset("active", contact.active);
  group.dataset("quadrature_points", contact.quadraturePoints);
  group.dataset("quadrature_pressure", contact.quadraturePressure);
  group.dataset("quadrature_gap", contact.quadratureGap);
  group.dataset("quadrature_normal", contact.quadratureNormal);
  if (contact.quadratureSliding.empty()) return;
  group.dataset("quadrature_friction", contact.quadratureFriction);
  group.dataset("quadrature_slip", contact.quadratureSlip);
  group.dataset("quadrature_sliding", contact.quadratureSliding);
  group.dataset("quadrature_slipped", contact.quadratureSlipped);
}

ContactRecord readContact(const InputGroup& group) {
  ContactRecord contact{.tool = group.text("tool"),
                        .pair = group.hasAttribute("pair") ? group.text("pair") : "",
                        .face = group.text("face"),
                        .patch = group.integer("patch"),
                        .nodes = group.dataset("nodes").integers(),
                        .pressure = group.dataset("pressure").vector(),
                        .averageGap = group.dataset("average_gap").vector(),
                        .active = group.dataset("active").integers(),
                        .quadraturePoints = group.dataset("quadrature_points").matrix(),
                        .quadraturePressure = group.dataset("quadrature_pressure").vector(),
                        .quadratureGap = group.dataset("quadrature_gap").vector(),
                        .quadratureNormal = group.dataset("quadrature_normal").matrix()};
  if (!group.contains("quadrature_sliding")) return contact;
  contact.quadratureFriction = group.dataset("quadrature_friction").matrix();
  contact.quadratureSlip = group.dataset("quadrature_slip").matrix();
  contact.quadratureSliding = group.dataset("quadrature_sliding").integers();
  if (group.contains("quadrature_slipped"))
    contact.quadratureSlipped = group.dataset("quadrature_slipped").vector();
  return contact;
}

InputGroup rootOfFrame(const hdf5::InputFile& file, const StoredModel& model) {
  InputGroup root = file.root();
  if (readHeader(root, "frame") != model.id)
    throw Error(fmt::format("{} belongs to another run than the result file beside it; run the scene again",
                            root.place()));
  return root;
}

}  // namespace

std::vector<std::byte> frameImage(const FrameRecord& frame, const std::string& modelId) {
  hdf5::OutputImage image;
  {
    const OutputGroup root = image.root();
    writeHeader(root, "frame", modelId);
    root.attribute("index", frame.index);
    root.attribute("step", frame.step);
    root.attribute("time", frame.time);
    if (frame.mesh) writeMesh(root.group("mesh"), *frame.mesh);
    root.dataset("displacement", frame.displacement);
    root.dataset("tool_displacement", frame.toolDisplacement);
    root.dataset("tool_angle", frame.toolAngle);
    writeFields(root.group("fields"), frame.fields);
    const OutputGroup contacts = root.group("contact");
    for (std::size_t i = 0; i < frame.contact.size(); ++i)
      writeContact(contacts.group(std::to_string(i)), frame.contact[i]);
    const OutputGroup quadrature = root.group("quadrature");
    quadrature.dataset("positions", frame.quadrature.positions);
    if (!frame.quadrature.numPoints.empty()) quadrature.dataset("num_points", frame.quadrature.numPoints);
    writeFields(quadrature.group("fields"), frame.quadrature.fields);
  }
  return image.finish();
}

FrameRecord readFrame(const std::filesystem::path& path, const StoredModel& model) {
  const hdf5::InputFile file(path);
  const InputGroup root = rootOfFrame(file, model);
  FrameRecord frame;
  frame.index = root.integer("index");
  frame.step = root.integer("step");
  frame.time = root.real("time");
  if (root.contains("mesh")) {
    frame.mesh = readMesh(root.group("mesh"), model.record.dim);
    // Patches are those of the model, whose bodies they belong to.
    for (std::size_t p = 0; p < std::min(frame.mesh->patches.size(), model.record.mesh.patches.size()); ++p)
      frame.mesh->patches[p].body = model.record.mesh.patches[p].body;
  }
  frame.displacement = root.dataset("displacement").matrix();
  frame.toolDisplacement = root.dataset("tool_displacement").matrix();
  frame.toolAngle = root.dataset("tool_angle").vector();
  frame.fields = readFields(root.group("fields"));
  const InputGroup contacts = root.group("contact");
  for (std::size_t i = 0; i < contacts.names().size(); ++i)
    frame.contact.push_back(readContact(contacts.group(std::to_string(i))));
  const InputGroup quadrature = root.group("quadrature");
  frame.quadrature = {.positions = quadrature.dataset("positions").matrix(),
                      .numPoints = quadrature.contains("num_points")
                                       ? quadrature.dataset("num_points").integers()
                                       : std::vector<int>(),
                      .fields = readFields(quadrature.group("fields"))};
  checkFrame(frame, model.record, path.string());
  return frame;
}

double readFrameTime(const std::filesystem::path& path, const StoredModel& model) {
  const hdf5::InputFile file(path);
  return rootOfFrame(file, model).real("time");
}

}  // namespace burnish::inline results
