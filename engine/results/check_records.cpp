#include "engine/results/check_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/core/error.h"

namespace burnish::inline results {
namespace {

constexpr int kHighestDegree = 30;

template <class... Arguments>
void require(bool holds, const std::string& place, fmt::format_string<Arguments...> what,
             Arguments&&... arguments) {
  if (!holds)
    throw Error(fmt::format("{}: {}", place, fmt::format(what, std::forward<Arguments>(arguments)...)));
}

std::size_t count(Eigen::Index n) {
  return static_cast<std::size_t>(n);
}

bool nodesInRange(const std::vector<int>& nodes, int numNodes) {
  return std::all_of(nodes.begin(), nodes.end(), [=](int node) { return node >= 0 && node < numNodes; });
}

/// Number of basis functions of a direction; its knots are checked by the basis itself.
std::size_t numFunctions(const DirectionRecord& direction, const std::string& place) {
  require(direction.degree >= 1 && direction.degree <= kHighestDegree, place,
          "degree {} is not between 1 and {}", direction.degree, kHighestDegree);
  try {
    const UnivariateBasis basis =
        direction.family == BasisFamily::BSpline
            ? UnivariateBasis::bspline(KnotVector(direction.degree, direction.knots))
            : UnivariateBasis::lagrange(direction.degree, direction.knots);
    return static_cast<std::size_t>(basis.numFunctions());
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", place, error.what()));
  }
}

void checkPatch(const PatchRecord& patch, int dim, int numNodes, const std::string& place) {
  require(patch.directions.size() == static_cast<std::size_t>(dim), place,
          "{} parametric directions in {} dimensions", patch.directions.size(), dim);
  std::size_t functions = 1;
  for (std::size_t d = 0; d < patch.directions.size(); ++d)
    functions *= numFunctions(patch.directions[d], fmt::format("{}, direction {}", place, d));
  require(patch.points.rows() == dim, place, "control points with {} coordinates in {} dimensions",
          patch.points.rows(), dim);
  require(count(patch.points.cols()) == functions && count(patch.weights.size()) == functions &&
              patch.nodes.size() == functions,
          place, "{} basis functions, but {} control points, {} weights and {} nodes", functions,
          patch.points.cols(), patch.weights.size(), patch.nodes.size());
  require(patch.points.allFinite(), place, "a control point is not finite");
  require(patch.weights.allFinite() && (patch.weights.array() > 0.0).all(), place,
          "a weight is not positive");
  require(nodesInRange(patch.nodes, numNodes), place, "a node is not between 0 and {}", numNodes - 1);
}

bool isDirection(const Eigen::Vector3d& n) {
  return std::abs(n.norm() - 1.0) < 1e-9;
}

template <class Shape>
bool isSound(const Shape& shape) {
  return shape.isSound();
}
bool isSound(const SurfaceMesh& mesh) {
  return mesh.points.allFinite() && (mesh.cells.rows() == 2 || mesh.cells.rows() == 3) &&
         (mesh.cells.size() == 0 ||
          (mesh.cells.minCoeff() >= 0 && mesh.cells.maxCoeff() < mesh.points.cols()));
}

/// Names become the names of links in the file.
bool isFieldName(const std::string& name) {
  return !name.empty() && name != "." && name.find('/') == std::string::npos &&
         name.find('\0') == std::string::npos;
}

/// `columns`: what the field must have one value of (nodes or points), `what` its name.
/// `bodies`: names of all bodies.
void checkFields(const std::map<std::string, FieldRecord>& fields, Eigen::Index columns, const char* what,
                 const std::vector<std::string>& bodies, const std::string& place) {
  for (const auto& [name, field] : fields) {
    require(isFieldName(name), place, "\"{}\" cannot be the name of a field", name);
    require(field.values.cols() == columns, place, "field {} has {} values for {} {}", name,
            field.values.cols(), columns, what);
    const std::size_t components = std::max<std::size_t>(field.components.size(), 1);
    require(count(field.values.rows()) == components, place, "field {} has {} rows for {} component{}", name,
            field.values.rows(), components, components == 1 ? "" : "s");
    require(field.values.allFinite(), place, "field {} has a value that is not finite", name);
    for (const std::string& body : field.bodies)
      require(std::find(bodies.begin(), bodies.end(), body) != bodies.end(), place,
              "field {} is of the body \"{}\", which is none of the model's", name, body);
  }
}

/// An empty list of points may have any number of coordinates.
bool arePoints(const Eigen::MatrixXd& points, int dim) {
  return (points.rows() == dim || points.cols() == 0) && points.allFinite();
}

void checkContact(const ContactRecord& contact, const ModelRecord& model, const MeshRecord& mesh,
                  const std::string& place) {
  const bool known =
      contact.tool.empty() || std::any_of(model.tools.begin(), model.tools.end(),
                                          [&](const ToolRecord& tool) { return tool.name == contact.tool; });
  require(known, place, "the tool \"{}\" is none of the model's", contact.tool);
  require(contact.patch >= 0 && static_cast<std::size_t>(contact.patch) < mesh.patches.size(), place,
          "patch {} of {}", contact.patch, mesh.patches.size());
  require(nodesInRange(contact.nodes, mesh.numNodes), place, "a node is not between 0 and {}",
          mesh.numNodes - 1);
  const std::size_t nodes = contact.nodes.size();
  require(count(contact.pressure.size()) == nodes && count(contact.averageGap.size()) == nodes &&
              contact.active.size() == nodes,
          place, "{} nodes, but {} pressures, {} average gaps and {} states", nodes, contact.pressure.size(),
          contact.averageGap.size(), contact.active.size());
  require(nodesInRange(contact.active, 2), place, "a contact state is neither 0 nor 1");
  require(contact.pressure.allFinite() && contact.averageGap.allFinite() &&
              contact.quadraturePressure.allFinite() && contact.quadratureGap.allFinite(),
          place, "a pressure or gap is not finite");
  const Eigen::Index points = contact.quadraturePoints.cols();
  require(arePoints(contact.quadraturePoints, model.dim), place,
          "its quadrature points are not points in {} dimensions", model.dim);
  require(contact.quadraturePressure.size() == points && contact.quadratureGap.size() == points &&
              contact.quadratureNormal.cols() == points && arePoints(contact.quadratureNormal, model.dim),
          place, "{} quadrature points, but {} pressures, {} gaps and {} normals", points,
          contact.quadraturePressure.size(), contact.quadratureGap.size(), contact.quadratureNormal.cols());
  if (contact.quadratureSliding.empty()) return;
  require(std::ssize(contact.quadratureSliding) == points && contact.quadratureFriction.cols() == points &&
              arePoints(contact.quadratureFriction, model.dim) && contact.quadratureSlip.cols() == points &&
              arePoints(contact.quadratureSlip, model.dim) && nodesInRange(contact.quadratureSliding, 3),
          place, "{} quadrature points, but {} frictional tractions, {} slips and {} states of sliding",
          points, contact.quadratureFriction.cols(), contact.quadratureSlip.cols(),
          contact.quadratureSliding.size());
  const Eigen::VectorXd& slipped = contact.quadratureSlipped;
  require(slipped.size() == 0 || (slipped.size() == points && slipped.allFinite()), place,
          "{} quadrature points, but {} ways slipped, or one that is not finite", points, slipped.size());
}

}  // namespace

void checkMesh(const MeshRecord& mesh, int dim, const std::string& place) {
  require(!mesh.patches.empty(), place, "a mesh without patches");
  require(dim == 2 || dim == 3, place, "{} dimensions instead of 2 or 3", dim);
  require(mesh.numNodes >= 1, place, "{} nodes", mesh.numNodes);
  for (std::size_t i = 0; i < mesh.patches.size(); ++i)
    checkPatch(mesh.patches[i], dim, mesh.numNodes, fmt::format("{}, patch {}", place, i));
}

void checkModel(const ModelRecord& model, const std::string& place) {
  checkMesh(model.mesh, model.dim, place);
  for (const PatchRecord& patch : model.mesh.patches)
    require(patch.body >= 0 && count(patch.body) < std::max<std::size_t>(model.bodies.size(), 1), place,
            "a patch of body {}, which is none of the model's", patch.body);
  for (std::size_t k = 0; k < model.bodies.size(); ++k)
    require(std::any_of(model.mesh.patches.begin(), model.mesh.patches.end(),
                        [&](const PatchRecord& patch) { return patch.body == static_cast<int>(k); }),
            place, "the body \"{}\" has no patch", model.bodies[k]);
  require(model.subdivision >= 1, place, "a subdivision of {} instead of at least 1", model.subdivision);
  for (const ToolRecord& tool : model.tools) {
    require(std::visit([](const auto& shape) { return isSound(shape); }, tool.shape), place,
            "the shape of the tool \"{}\" has a radius that is not positive, a direction that is not of "
            "length 1, a coordinate that is not finite, or a cell without its points",
            tool.name);
    require(tool.pivot.allFinite() && isDirection(tool.axis) && tool.halfThickness > 0.0, place,
            "the tool \"{}\" has a pivot that is not finite, an axis that is not of length 1, or a thickness "
            "that is not positive",
            tool.name);
    require(!tool.until || std::isfinite(*tool.until), place,
            "a time at which the tool \"{}\" is taken away that is not finite", tool.name);
  }
}

void checkFrame(const FrameRecord& frame, const ModelRecord& model, const std::string& place) {
  require(frame.index >= 0 && frame.step >= 0 && std::isfinite(frame.time), place,
          "frame {}, step {}, time {}", frame.index, frame.step, frame.time);
  if (frame.mesh) checkMesh(*frame.mesh, model.dim, place + ", mesh");
  const MeshRecord& mesh = meshOf(model, frame);
  require(frame.displacement.rows() == model.dim && frame.displacement.cols() == mesh.numNodes, place,
          "displacements of {} components at {} nodes; its mesh has {} dimensions and {} nodes",
          frame.displacement.rows(), frame.displacement.cols(), model.dim, mesh.numNodes);
  require(frame.displacement.allFinite(), place, "a displacement is not finite");
  require(count(frame.toolDisplacement.cols()) == model.tools.size() &&
              arePoints(frame.toolDisplacement, model.dim),
          place, "{} displacements of tools with {} components for {} tools in {} dimensions",
          frame.toolDisplacement.cols(), frame.toolDisplacement.rows(), model.tools.size(), model.dim);
  require((frame.toolAngle.size() == 0 || count(frame.toolAngle.size()) == model.tools.size()) &&
              frame.toolAngle.allFinite(),
          place, "{} angles for {} tools, or one that is not finite", frame.toolAngle.size(),
          model.tools.size());
  checkFields(frame.fields, mesh.numNodes, "nodes", model.bodies, place);
  for (std::size_t i = 0; i < frame.contact.size(); ++i)
    checkContact(frame.contact[i], model, mesh, fmt::format("{}, contact {}", place, i));
  require(arePoints(frame.quadrature.positions, model.dim), place,
          "its quadrature points are not points in {} dimensions", model.dim);
  const auto& numPoints = frame.quadrature.numPoints;
  require(numPoints.empty() || (numPoints.size() == model.bodies.size() &&
                                std::accumulate(numPoints.begin(), numPoints.end(), Eigen::Index{0}) ==
                                    frame.quadrature.positions.cols()),
          place, "{} quadrature points, which are not those of {} bodies", frame.quadrature.positions.cols(),
          model.bodies.size());
  checkFields(frame.quadrature.fields, frame.quadrature.positions.cols(), "quadrature points", model.bodies,
              place);
}

}  // namespace burnish::inline results
