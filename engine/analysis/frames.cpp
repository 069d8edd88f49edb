#include "engine/analysis/frames.h"

#include <string>
#include <utility>

#include "engine/core/version.h"
#include "engine/fields/body_fields.h"

namespace burnish::inline analysis {
namespace {

/// Half the length that is drawn of an infinite tool, in sizes of the body.
constexpr double kDrawnSizes = 3.0;

using Fields = std::map<std::string, FieldRecord>;

/// Adds the fields of a body, whose values have a column for every node or point of all bodies.
void addFields(Fields& all, const Fields& ofBody, const std::string& body, std::ptrdiff_t numBodies) {
  for (const auto& [name, field] : ofBody) {
    const auto [known, isNew] = all.try_emplace(name, field);
    FieldRecord& record = known->second;
    if (!isNew) record.values += field.values;
    record.bodies.push_back(body);
    if (std::ssize(record.bodies) == numBodies) record.bodies.clear();
  }
}

/// Values at the points of one body among those of all.
Fields padded(Fields fields, Eigen::Index firstPoint, Eigen::Index numPoints) {
  for (auto& [name, field] : fields) {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(field.values.rows(), numPoints);
    all.middleCols(firstPoint, field.values.cols()) = field.values;
    field.values = std::move(all);
  }
  return fields;
}

/// Fields of all bodies, projected and at the quadrature points; of several ranks the first one has them.
template <int Dim>
void addAllFields(FrameRecord& frame, const Scene& scene, const Model<Dim>& model,
                  const std::vector<Projection<Dim>>& projections) {
  const std::ptrdiff_t numBodies = std::ssize(model.bodies());
  Eigen::Index numPoints = 0, firstPoint = 0;
  for (const auto& body : model.bodies()) numPoints += body.quadrature->numPoints();
  for (std::size_t k = 0; k < model.bodies().size(); ++k) {
    const ModelBody<Dim>& body = model.bodies()[k];
    const BulkTerm<Dim>& bulk = *body.bulk;
    Fields fields = quadratureFields(bulk, scene.units.stress);
    const auto& J = bulk.jacobians();
    fields["J"] = {{}, "", Eigen::Map<const Eigen::RowVectorXd>(J.data(), std::ssize(J)), {}};
    fields = whole(bulk.portion(), std::move(fields), Receivers::First);
    auto kept = fields.extract("J");  // at the quadrature points alone
    addFields(frame.fields, projected(projections[k], fields), body.name, numBodies);
    fields.insert(std::move(kept));
    addFields(frame.quadrature.fields, padded(std::move(fields), firstPoint, numPoints), body.name,
              numBodies);
    firstPoint += body.quadrature->numPoints();
  }
}

/// Current positions of the quadrature points, body after body.
template <int Dim>
void addQuadraturePoints(QuadratureRecord& record, const Model<Dim>& model,
                         const Eigen::MatrixXd& currentNodes) {
  Eigen::Index numPoints = 0, firstPoint = 0;
  for (const auto& body : model.bodies()) numPoints += body.quadrature->numPoints();
  record.positions.resize(Dim, numPoints);
  for (const auto& body : model.bodies()) {
    Eigen::MatrixXd buffer;
    for (const auto& span : body.quadrature->spans())
      record.positions.middleCols(firstPoint + span.firstPoint, span.weights.size()) =
          currentNodes(Eigen::all, span.nodes) * span.values(buffer);
    firstPoint += body.quadrature->numPoints();
    if (model.bodies().size() > 1) record.numPoints.push_back(body.quadrature->numPoints());
  }
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

/// Normals at the quadrature points, and friction.
template <int Dim>
void addDirections(ContactRecord& record, const ContactState& state) {
  record.quadratureNormal = state.normal.template topRows<Dim>();
  record.quadratureFriction = -state.traction.template topRows<Dim>();
  record.quadratureSlip = state.slip.template topRows<Dim>();
  record.quadratureSliding = state.sliding;
  record.quadratureSlipped = state.slipped;
}

/// Without a partner a gap is infinite.
void limitGaps(ContactRecord& record, double most) {
  record.averageGap = record.averageGap.cwiseMin(most);
  record.quadratureGap = record.quadratureGap.cwiseMin(most);
}

template <int Dim>
ContactRecord contactRecord(const Model<Dim>& model, const ContactPair<Dim>& pair, const Eigen::VectorXd& x) {
  ContactRecord record = faceRecord(pair.term->face(), pair.term->state(), x);
  record.tool = model.tools()[pair.tool]->name;
  record.face = faceName(pair.place.face);
  record.patch = pair.place.patch;
  addDirections<Dim>(record, pair.term->state());
  if (pair.term->hasLostTouch()) limitGaps(record, model.body().size());
  return record;
}

template <int Dim>
ContactRecord contactRecord(const FacePair<Dim>& pair, const Eigen::VectorXd& x, double size) {
  ContactRecord record = faceRecord(pair.term->face(), pair.term->state(), x);
  record.pair = pair.name;
  record.face = faceName(pair.place.face);
  record.patch = pair.place.patch;
  addDirections<Dim>(record, pair.term->state());
  limitGaps(record, size);
  return record;
}

template <int Dim>
ContactRecord contactRecord(const SelfContact<Dim>& contact, const Eigen::VectorXd& x) {
  ContactRecord record = faceRecord(contact.term->face(), contact.term->state(), x);
  record.face = faceName(contact.place.face);
  record.patch = contact.place.patch;
  addDirections<Dim>(record, contact.term->state());
  limitGaps(record, contact.reach);
  return record;
}

}  // namespace

template <int Dim>
MeshRecord meshRecord(const Model<Dim>& model) {
  const Body<Dim>& body = model.body();
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
  for (std::size_t k = 1; k < model.bodies().size(); ++k)
    for (std::size_t p = 0; p < model.bodies()[k].body.patches.size(); ++p)
      record.patches[static_cast<std::size_t>(model.bodies()[k].firstPatch) + p].body = static_cast<int>(k);
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
  record.mesh = meshRecord(model);
  for (const BodySpec& body : scene.bodies) record.bodies.push_back(body.name);
  for (const auto& tool : model.tools())
    record.tools.push_back({tool->name, tool->shape.recorded(Dim, kDrawnSizes * model.body().size()),
                            tool->pivot, tool->axis, tool->shape.halfThickness()});
  for (const auto& leaving : model.leavingTools()) record.tools[leaving.tool].until = leaving.until;
  return record;
}

template <int Dim>
FrameRecord makeFrame(const Scene& scene, const Model<Dim>& model,
                      const std::vector<Projection<Dim>>& projections, int index, int step, double t,
                      const Eigen::VectorXd& x, const Team& team) {
  FrameRecord frame;
  frame.index = index;
  frame.step = step;
  frame.time = t;
  addAllFields(frame, scene, model, projections);
  if (!team.isFirst()) return frame;

  frame.displacement = Eigen::Map<const Eigen::MatrixXd>(x.data(), Dim, model.body().numNodes);
  const auto tools = static_cast<Eigen::Index>(model.tools().size());
  frame.toolDisplacement.resize(Dim, tools);
  frame.toolAngle.resize(tools);
  for (Eigen::Index k = 0; k < tools; ++k) {
    const ToolPose pose = model.tools()[static_cast<std::size_t>(k)]->pose(t, x);
    frame.toolDisplacement.col(k) = pose.displacement.template head<Dim>();
    frame.toolAngle(k) = pose.angle;
  }
  for (const auto& pair : model.contacts()) frame.contact.push_back(contactRecord(model, pair, x));
  for (const auto& pair : model.pairs()) frame.contact.push_back(contactRecord(pair, x, model.body().size()));
  for (const auto& contact : model.selfContacts()) frame.contact.push_back(contactRecord(contact, x));

  Eigen::MatrixXd current = frame.displacement;
  for (std::size_t p = 0; p < model.body().patches.size(); ++p) {
    // A node that patches share has the same reference position in all of them.
    const auto& nodes = model.body().nodes[p];
    for (std::size_t a = 0; a < nodes.size(); ++a)
      current.col(nodes[a]) = frame.displacement.col(nodes[a]) +
                              model.body().patches[p].points().col(static_cast<Eigen::Index>(a));
  }
  addQuadraturePoints(frame.quadrature, model, current);
  return frame;
}

template MeshRecord meshRecord(const Model<2>&);
template MeshRecord meshRecord(const Model<3>&);
template ModelRecord makeModelRecord(const Scene&, const Model<2>&);
template ModelRecord makeModelRecord(const Scene&, const Model<3>&);
template FrameRecord makeFrame(const Scene&, const Model<2>&, const std::vector<Projection<2>>&, int, int,
                               double, const Eigen::VectorXd&, const Team&);
template FrameRecord makeFrame(const Scene&, const Model<3>&, const std::vector<Projection<3>>&, int, int,
                               double, const Eigen::VectorXd&, const Team&);

}  // namespace burnish::inline analysis
