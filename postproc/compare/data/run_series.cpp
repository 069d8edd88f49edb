#include "postproc/compare/data/run_series.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <system_error>
#include <utility>

#include "engine/core/error.h"
#include "engine/results/history.h"
#include "engine/results/result_reader.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

Eigen::MatrixXd asRow(const Eigen::VectorXd& values) {
  return values.transpose();
}

Eigen::MatrixXd asRow(const std::vector<int>& values) {
  Eigen::MatrixXd row(1, std::ssize(values));
  for (std::size_t k = 0; k < values.size(); ++k) row(0, static_cast<Eigen::Index>(k)) = values[k];
  return row;
}

std::vector<std::string> axisNames(int dim) {
  static const std::vector<std::string> axes{"x", "y", "z"};
  return {axes.begin(), axes.begin() + dim};
}

int numFunctions(const DirectionRecord& direction) {
  const int knots = static_cast<int>(direction.knots.size());
  return direction.family == BasisFamily::BSpline ? knots - direction.degree - 1
                                                  : direction.degree * (knots - 1) + 1;
}

std::string bodyName(const ModelRecord& model, int body) {
  return model.bodies.empty() ? "" : "body " + model.bodies[static_cast<std::size_t>(body)];
}

/// "body block: 14 x 8 B-splines of degree 2 x 2".
std::string patchInWords(const ModelRecord& model, const PatchRecord& patch) {
  std::vector<int> functions, degrees;
  for (const DirectionRecord& direction : patch.directions) {
    functions.push_back(numFunctions(direction));
    degrees.push_back(direction.degree);
  }
  const std::string body = bodyName(model, patch.body);
  return fmt::format(
      "{}{}{} {} of degree {}", body, body.empty() ? "" : ": ", fmt::join(functions, " x "),
      patch.directions.front().family == BasisFamily::BSpline ? "B-splines" : "Lagrange functions",
      fmt::join(degrees, " x "));
}

/// All patches, equal ones one after the other as one: "2 patches of ...".
std::string meshInWords(const ModelRecord& model, const MeshRecord& mesh) {
  std::vector<std::pair<std::string, int>> kinds;
  for (const PatchRecord& patch : mesh.patches) {
    const std::string words = patchInWords(model, patch);
    if (kinds.empty() || kinds.back().first != words) kinds.emplace_back(words, 0);
    ++kinds.back().second;
  }
  std::vector<std::string> texts;
  for (const auto& [words, count] : kinds)
    texts.push_back(count == 1 ? words : fmt::format("{} patches of {}", count, words));
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// Arrays at the control points, of which every node has one place.
DataPart meshPart(const ModelRecord& model, const FrameRecord& frame) {
  const MeshRecord& mesh = meshOf(model, frame);
  DataPart part{.name = "mesh",
                .place = "control point",
                .structure = meshInWords(model, mesh),
                .numPlaces = mesh.numNodes};
  Eigen::MatrixXd points = Eigen::MatrixXd::Zero(model.dim, mesh.numNodes);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(mesh.numNodes);
  part.ownerOf.assign(static_cast<std::size_t>(mesh.numNodes), 0);
  for (std::size_t p = mesh.patches.size(); p-- > 0;) {  // a shared node is the first patch's
    const PatchRecord& patch = mesh.patches[p];
    for (std::size_t a = 0; a < patch.nodes.size(); ++a) {
      points.col(patch.nodes[a]) = patch.points.col(static_cast<Eigen::Index>(a));
      weights(patch.nodes[a]) = patch.weights(static_cast<Eigen::Index>(a));
      part.ownerOf[static_cast<std::size_t>(patch.nodes[a])] = static_cast<int>(p);
    }
  }
  for (std::size_t p = 0; p < mesh.patches.size(); ++p) {
    const std::string body = bodyName(model, mesh.patches[p].body);
    const bool isOnly = mesh.patches.size() <= std::max<std::size_t>(model.bodies.size(), 1);
    part.owners.push_back(isOnly ? body : fmt::format("patch {}{}{}", p, body.empty() ? "" : " of ", body));
  }
  part.positions = points + frame.displacement;
  part.arrays = {{"mesh.control_points", model.lengthUnit, axisNames(model.dim), std::move(points)},
                 {"mesh.weights", "", {}, asRow(weights)},
                 {"displacement", model.lengthUnit, axisNames(model.dim), frame.displacement}};
  for (const auto& [name, field] : frame.fields)
    part.arrays.push_back({name, field.unit, field.components, field.values});
  return part;
}

DataPart knotPart(const ModelRecord& model, const MeshRecord& mesh) {
  DataPart part{.name = "mesh.knots", .place = "knot", .structure = meshInWords(model, mesh)};
  std::vector<double> knots;
  for (const PatchRecord& patch : mesh.patches)
    for (const DirectionRecord& direction : patch.directions)
      knots.insert(knots.end(), direction.knots.begin(), direction.knots.end());
  part.numPlaces = std::ssize(knots);
  part.arrays = {{"mesh.knots", "", {}, Eigen::Map<Eigen::RowVectorXd>(knots.data(), std::ssize(knots))}};
  return part;
}

std::string contactInWords(const ModelRecord& model, const ContactRecord& contact) {
  const std::string& other = contact.tool.empty() ? contact.pair : contact.tool;
  const std::string patch = model.mesh.patches.size() > 1 ? fmt::format(" of patch {}", contact.patch) : "";
  return fmt::format("{} on {}{}", other.empty() ? "itself" : other, contact.face, patch);
}

/// At the control points of the face.
DataPart contactPart(const ModelRecord& model, const ContactRecord& contact, const DataPart& mesh) {
  DataPart part{.name = "contact", .place = "control point", .numPlaces = std::ssize(contact.nodes)};
  part.positions = mesh.positions(Eigen::all, contact.nodes);
  part.arrays = {{"contact.pressure", model.stressUnit, {}, asRow(contact.pressure)},
                 {"contact.average_gap", model.lengthUnit, {}, asRow(contact.averageGap)},
                 {"contact.active", "", {}, asRow(contact.active)}};
  return part;
}

DataPart contactPointPart(const ModelRecord& model, const ContactRecord& contact) {
  const std::vector<std::string> axes = axisNames(model.dim);
  DataPart part{.name = "contact.points",
                .place = "quadrature point",
                .numPlaces = contact.quadraturePoints.cols(),
                .positions = contact.quadraturePoints};
  part.arrays = {{"contact.quadrature_pressure", model.stressUnit, {}, asRow(contact.quadraturePressure)},
                 {"contact.quadrature_gap", model.lengthUnit, {}, asRow(contact.quadratureGap)},
                 {"contact.quadrature_normal", "", axes, contact.quadratureNormal}};
  if (contact.quadratureSliding.empty()) return part;
  part.arrays.push_back({"contact.quadrature_friction", model.stressUnit, axes, contact.quadratureFriction});
  part.arrays.push_back({"contact.quadrature_slip", model.lengthUnit, axes, contact.quadratureSlip});
  part.arrays.push_back({"contact.quadrature_sliding", "", {}, asRow(contact.quadratureSliding)});
  if (contact.quadratureSlipped.size() > 0)
    part.arrays.push_back(
        {"contact.quadrature_slipped", model.lengthUnit, {}, asRow(contact.quadratureSlipped)});
  return part;
}

void addContact(DataFrame& data, const ModelRecord& model, const FrameRecord& frame) {
  const DataPart mesh = data.front();
  std::vector<std::string> taken;
  for (const ContactRecord& contact : frame.contact) {
    const std::string words = contactInWords(model, contact);
    const auto before = std::ranges::count(taken, words);
    taken.push_back(words);
    for (DataPart part : {contactPart(model, contact, mesh), contactPointPart(model, contact)}) {
      part.detail = before == 0 ? words : fmt::format("{}, {}", words, before + 1);
      part.structure = mesh.structure;
      data.push_back(std::move(part));
    }
  }
}

void addTools(DataFrame& data, const ModelRecord& model, const FrameRecord& frame) {
  for (std::size_t k = 0; k < model.tools.size(); ++k) {
    const auto tool = static_cast<Eigen::Index>(k);
    const double angle = frame.toolAngle.size() == 0 ? 0.0 : frame.toolAngle(tool);
    DataPart part{.name = "tool", .detail = model.tools[k].name, .numPlaces = 1};
    part.arrays = {
        {"tool.displacement", model.lengthUnit, axisNames(model.dim), frame.toolDisplacement.col(tool)},
        {"tool.angle", "", {}, Eigen::MatrixXd::Constant(1, 1, angle)}};
    data.push_back(std::move(part));
  }
}

DataPart quadraturePart(const ModelRecord& model, const FrameRecord& frame) {
  const QuadratureRecord& quadrature = frame.quadrature;
  DataPart part{.name = "quadrature",
                .place = "quadrature point",
                .structure = meshInWords(model, meshOf(model, frame)),
                .numPlaces = quadrature.positions.cols(),
                .positions = quadrature.positions};
  for (std::size_t body = 0; body < quadrature.numPoints.size(); ++body) {
    part.owners.push_back(bodyName(model, static_cast<int>(body)));
    part.ownerOf.insert(part.ownerOf.end(), static_cast<std::size_t>(quadrature.numPoints[body]),
                        static_cast<int>(body));
  }
  for (const auto& [name, field] : quadrature.fields)
    part.arrays.push_back({"quadrature." + name, field.unit, field.components, field.values});
  return part;
}

DataFrame dataOf(const ModelRecord& model, const FrameRecord& frame) {
  DataFrame data{meshPart(model, frame)};
  addContact(data, model, frame);
  addTools(data, model, frame);
  data.push_back(quadraturePart(model, frame));
  data.push_back(knotPart(model, meshOf(model, frame)));
  return data;
}

DataFrame rowOf(const HistoryTable& table, std::size_t row) {
  DataPart part{.name = "history", .numPlaces = 1};
  for (std::size_t column = 0; column < table.columns.size(); ++column)
    part.arrays.push_back({"history." + table.columns[column],
                           "",
                           {},
                           Eigen::MatrixXd::Constant(1, 1, table.values[column][row])});
  return {part};
}

}  // namespace

DataSeries frameSeries(const fs::path& path) {
  const auto reader = std::make_shared<ResultReader>(path);
  if (reader->numFrames() == 0) throw Error(fmt::format("{} has no frames yet", reader->file().string()));
  return {.name = "frames", .times = reader->times(), .frame = [reader](std::size_t index) {
            return dataOf(reader->model(), reader->frame(static_cast<int>(index)));
          }};
}

DataSeries historySeries(const fs::path& path) {
  std::error_code status;
  const fs::path directory = fs::is_directory(path, status) ? path : path.parent_path();
  const fs::path file = directory / "history.csv";
  const bool isOfRun = directory == path || path.filename() == "result.h5";
  if (!isOfRun || !fs::exists(file, status)) return {.name = "history", .times = {}, .frame = {}};
  const auto table = std::make_shared<HistoryTable>(readHistory(file));
  return {.name = "history", .times = table->column("time"), .frame = [table](std::size_t row) {
            return rowOf(*table, row);
          }};
}

}  // namespace burnish
