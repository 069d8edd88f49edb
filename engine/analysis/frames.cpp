#include "engine/analysis/frames.h"

#include <string>

#include "engine/core/version.h"
#include "engine/fields/body_fields.h"

namespace burnish {
namespace {

/// Half the length that is drawn of an infinite tool, in sizes of the body.
constexpr double kDrawnSizes = 3.0;

template <int Dim>
QuadratureRecord quadratureRecord(const Model<Dim>& model, const Eigen::MatrixXd& currentNodes,
                                  const std::map<std::string, FieldRecord>& fields) {
  QuadratureRecord record;
  record.positions.resize(Dim, model.quadrature().numPoints());
  for (const auto& span : model.quadrature().spans())
    record.positions.middleCols(span.firstPoint, span.R.cols()) =
        currentNodes(Eigen::all, span.nodes) * span.R;
  record.fields = fields;
  const auto& J = model.bulk().jacobians();
  record.fields["J"] = {
      {}, "", Eigen::Map<const Eigen::RowVectorXd>(J.data(), static_cast<Eigen::Index>(J.size()))};
  return record;
}

template <int Dim>
ContactRecord faceRecord(const FaceQuadrature<Dim>& face, const FaceContactState& state,
                         const Eigen::VectorXd& x) {
  ContactRecord record;
  record.nodes = face.nodes();
  record.pressure = -state.lambdaHat;
  record.averageGap = state.averageGap;
  record.active.assign(record.nodes.size(), 0);
  for (std::size_t a = 0; a < state.active.size(); ++a) record.active[a] = state.active[a] ? 1 : 0;
  record.quadraturePoints = face.positions(x);
  record.quadraturePressure = state.pressure;
  record.quadratureGap = state.gap;
  return record;
}

template <int Dim>
ContactRecord contactRecord(const Model<Dim>& model, const ContactPair<Dim>& pair, const Eigen::VectorXd& x) {
  ContactRecord record = faceRecord(pair.term->face(), pair.term->state(), x);
  record.tool = model.tools()[pair.tool]->name;
  record.face = faceName(pair.place.face);
  record.patch = pair.place.patch;
  const ContactState& state = pair.term->state();
  record.quadratureNormal = state.normal.template topRows<Dim>();
  record.quadratureFriction = -state.traction.template topRows<Dim>();
  record.quadratureSlip = state.slip.template topRows<Dim>();
  record.quadratureSliding = state.sliding;
  return record;
}

ContactRecord contactRecord(const SelfContact& contact, const Eigen::VectorXd& x) {
  ContactRecord record = faceRecord(contact.term->face(), contact.term->state(), x);
  record.face = faceName(contact.place.face);
  record.patch = contact.place.patch;
  record.quadratureNormal = contact.term->state().normal;
  const double reach = contact.term->reach();
  record.averageGap = record.averageGap.cwiseMin(reach);
  record.quadratureGap = record.quadratureGap.cwiseMin(reach);
  return record;
}

}  // namespace

template <int Dim>
MeshRecord meshRecord(const Body<Dim>& body) {
  MeshRecord record{body.numNodes, {}};
  for (std::size_t p = 0; p < body.patches.size(); ++p) {
    const auto& patch = body.patches[p];
    PatchRecord stored;
    for (int d = 0; d < Dim; ++d) {
      const auto& basis = patch.basis().direction(d);
      stored.directions.push_back({basis.family(), basis.degree(), basis.knots()});
    }
    stored.points = patch.points();
    stored.weights = patch.weights();
    stored.nodes = body.nodes[p];
    record.patches.push_back(std::move(stored));
  }
  return record;
}

template <int Dim>
ModelRecord makeModelRecord(const Scene& scene, const Model<Dim>& model) {
  ModelRecord record;
  record.program = programName();
  record.title = scene.title;
  record.sceneYaml = scene.resolvedYaml;
  record.dim = Dim;
  record.lengthUnit = scene.units.length;
  record.stressUnit = scene.units.stress;
  record.subdivision = scene.output.subdivision;
  record.mesh = meshRecord(model.body());
  for (const auto& tool : model.tools())
    record.tools.push_back({tool->name, tool->shape.recorded(Dim, kDrawnSizes * model.body().size()),
                            tool->pivot, tool->axis, tool->shape.halfThickness()});
  return record;
}

template <int Dim>
FrameRecord makeFrame(const Scene& scene, const Model<Dim>& model, const Projection<Dim>& projection,
                      int index, int step, double t, const Eigen::VectorXd& x) {
  FrameRecord frame;
  frame.index = index;
  frame.step = step;
  frame.time = t;
  frame.displacement = Eigen::Map<const Eigen::MatrixXd>(x.data(), Dim, model.body().numNodes);
  const auto raw = quadratureFields(model.bulk(), scene.units.stress);
  frame.fields = projected(projection, raw);

  const auto tools = static_cast<Eigen::Index>(model.tools().size());
  frame.toolDisplacement.resize(Dim, tools);
  frame.toolAngle.resize(tools);
  for (Eigen::Index k = 0; k < tools; ++k) {
    const ToolPose pose = model.tools()[static_cast<std::size_t>(k)]->pose(t, x);
    frame.toolDisplacement.col(k) = pose.displacement.template head<Dim>();
    frame.toolAngle(k) = pose.angle;
  }
  for (const auto& pair : model.contacts()) frame.contact.push_back(contactRecord(model, pair, x));
  for (const auto& contact : model.selfContacts()) frame.contact.push_back(contactRecord(contact, x));

  Eigen::MatrixXd current = frame.displacement;
  for (std::size_t p = 0; p < model.body().patches.size(); ++p) {
    // A node that patches share has the same reference position in all of them.
    const auto& nodes = model.body().nodes[p];
    for (std::size_t a = 0; a < nodes.size(); ++a)
      current.col(nodes[a]) = frame.displacement.col(nodes[a]) +
                              model.body().patches[p].points().col(static_cast<Eigen::Index>(a));
  }
  frame.quadrature = quadratureRecord(model, current, raw);
  return frame;
}

template MeshRecord meshRecord(const Body<2>&);
template MeshRecord meshRecord(const Body<3>&);
template ModelRecord makeModelRecord(const Scene&, const Model<2>&);
template ModelRecord makeModelRecord(const Scene&, const Model<3>&);
template FrameRecord makeFrame(const Scene&, const Model<2>&, const Projection<2>&, int, int, double,
                               const Eigen::VectorXd&);
template FrameRecord makeFrame(const Scene&, const Model<3>&, const Projection<3>&, int, int, double,
                               const Eigen::VectorXd&);

}  // namespace burnish
