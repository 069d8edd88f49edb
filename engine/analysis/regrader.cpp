#include "engine/analysis/regrader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/analysis/frames.h"
#include "engine/analysis/release_end.h"
#include "engine/nurbs/collocation.h"
#include "engine/rezoning/state_transfer.h"
#include "engine/solid/deformation_gradients.h"

namespace burnish::inline analysis {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Steps land on the times of meshes, but for rounding.
bool isReached(double time, double now) {
  constexpr double kRounding = 1e-9;
  return now >= time - kRounding * std::abs(time);
}

/// A body of one patch on another mesh over the same parameters.
class GradedAnew {
 public:
  /// before: in the state to go on from; must outlive the object.
  GradedAnew(const Simulation<3>& before, std::size_t number, NamedBody<3> next, int quadraturePoints)
      : before_(before),
        old_(before.model->bodies()[number].body.patches.front().basis()),
        new_(next.body.patches.front().basis()) {
    const SteppingState& state = before.stepping.state();
    const ModelBody<3>& body = before.model->bodies()[number];
    body_.named = std::move(next);
    body_.displacement = interpolatedOn(new_, old_, ownOf(state.x));
    body_.plasticWork = body.bulk->plasticWork();
    body_.time = state.time;
    body_.others.resize(3, 0);
    const SpanQuadrature<3> quadrature(body_.named.body, quadraturePoints);
    const auto gradients = deformationGradients<3>(quadrature, body_.displacement.reshaped());
    body_.states = regraded(*body.quadrature, old_, body.bulk->carried(state.x), quadrature, gradients);
    double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;
    for (const Eigen::Matrix3d& F : gradients) {
      smallest = std::min(smallest, F.determinant());
      largest = std::max(largest, F.determinant());
    }
    quality_ = smallest / largest;
  }

  const RezonedBody<3>& body() const { return body_; }

  /// Smallest over largest J at the new quadrature points.
  double quality() const { return quality_; }

  /// Largest distance by which a face has moved at the anchors of the old mesh.
  double boundaryError(FaceId face) const {
    const Eigen::MatrixXd way = valuesAtAnchors(new_, body_.displacement, old_) -
                                valuesAtAnchors(old_, ownOf(before_.stepping.state().x), old_);
    return way(Eigen::all, faceFunctions(old_, face)).colwise().norm().maxCoeff();
  }

  /// Where a simulation on the new mesh begins, see `MeshRenewal::continuedOn`.
  SteppingState startOf(const Model<3>& next) const {
    const Model<3>& model = *before_.model;
    const SteppingState& before = before_.stepping.state();
    SteppingState start = continuedSteps(before_, next);
    for (std::size_t k = 0; k < next.loads().size(); ++k) copyHistory(*model.loads()[k], *next.loads()[k]);
    for (std::size_t k = 0; k < next.contacts().size(); ++k)
      carryContact(*model.contacts()[k].term, *next.contacts()[k].term, start.x);
    if (before.lastIncrement.size() == 0) return start;
    start.lastIncrement = Eigen::VectorXd::Zero(next.numUnknowns());
    start.lastIncrement.head(next.numDisplacements()) =
        interpolatedOn(new_, old_, ownOf(before.lastIncrement)).reshaped();
    toolUnknowns(next, start.lastIncrement) = toolUnknowns(model, before.lastIncrement);
    return start;
  }

 private:
  /// Of all unknowns those of the displacements, 3 x nodes.
  Eigen::MatrixXd ownOf(const Eigen::VectorXd& x) const {
    const Model<3>& model = *before_.model;
    return x.head(model.numDisplacements()).reshaped(3, model.numDisplacements() / 3);
  }

  /// Multipliers of a contact of a face on the new mesh, in x, read at the anchors of the new functions; with friction
  /// the ways slipped and its work, too.
  void carryContact(const FaceContact<3>& from, FaceContact<3>& to, Eigen::VectorXd& x) const {
    const TensorBasis<2> old = from.face().trace().basis(), next = to.face().trace().basis();
    const auto carried = [&](const Eigen::MatrixXd& coefficients) {
      return valuesAtAnchors(old, coefficients, next);
    };
    to.setMultipliers(0, carried(from.state().lambdaHat.transpose()).cwiseMin(0.0).transpose(), x);
    if (!to.options().hasFriction()) return;
    for (const int component : {1, 2}) {
      const Eigen::VectorXd tractions = from.multipliers(component, before_.stepping.state().x);
      to.setMultipliers(component, carried(tractions.transpose()).transpose(), x);
    }
    to.continueFriction(from.state().frictionWork, carried(from.slipped().transpose()).transpose());
  }

  const Simulation<3>& before_;
  TensorBasis<3> old_, new_;
  RezonedBody<3> body_;
  double quality_ = 0.0;
};

/// Length of the smallest knot span in the directions of a face of a box.
double smallestSpanOn(const Patch<3>& box, FaceId face) {
  const Eigen::Vector3d size = box.points().rowwise().maxCoeff() - box.points().rowwise().minCoeff();
  double smallest = std::numeric_limits<double>::infinity();
  for (int d = 0; d < 3; ++d) {
    if (d == face / 2) continue;
    const UnivariateBasis& direction = box.basis().direction(d);
    for (int span = 0; span < direction.numSpans(); ++span)
      smallest = std::min(smallest, size(d) * (direction.shareOf(direction.spanEnd(span)) -
                                               direction.shareOf(direction.spanBegin(span))));
  }
  return smallest;
}

}  // namespace

Regrader::Regrader(const Scene& scene, const Simulation<3>& initial, const Team& team)
    : MeshRenewal<3>(scene, scene.rezonedBody(), initial, team),
      meshes_(followingMeshes(scene, scene.rezonedBody())),
      due_(meshes_.size() > 1 ? meshes_[1].from : kNever) {}

bool Regrader::isDue(const Simulation<3>& simulation) const {
  const double time = simulation.stepping.state().time;
  return isReached(due_, time) && !isReleasing(scene(), time);
}

std::size_t Regrader::meshAt(double time) const {
  std::size_t mesh = 0;
  while (mesh + 1 < meshes_.size() && isReached(meshes_[mesh + 1].from, time)) ++mesh;
  return mesh;
}

std::unique_ptr<Simulation<3>> Regrader::rezone(Simulation<3>& simulation) {
  constexpr double kShareToNextAttempt = 0.25;
  auto next = tried(simulation, [&] { return attempt(simulation); });
  const double time = simulation.stepping.state().time;
  const std::size_t mesh = meshAt(time);
  const bool isLast = mesh + 1 == meshes_.size();
  due_ = isLast ? kNever : meshes_[mesh + 1].from;
  if (next == nullptr) {
    const double end = isLast ? scene().steps.back().until : due_;
    due_ = std::min(due_, time + kShareToNextAttempt * (end - meshes_[mesh].from));
  }
  return next;
}

std::unique_ptr<Simulation<3>> Regrader::attempt(const Simulation<3>& simulation) {
  const std::size_t mesh = meshAt(simulation.stepping.state().time);
  const GradedAnew carried(simulation, number(),
                           makeBody<3>(withBreaks(scene(), number(), meshes_[mesh].breaks), number()),
                           scene().allBodies()[number()].quadraturePoints.value_or(0));
  double boundaryError = 0.0, smallestSpan = std::numeric_limits<double>::infinity();
  for (const ContactPair<3>& pair : simulation.model->contacts()) {
    boundaryError = std::max(boundaryError, carried.boundaryError(pair.place.face));
    smallestSpan =
        std::min(smallestSpan, smallestSpanOn(carried.body().named.body.patches.front(), pair.place.face));
  }
  return continuedOn(simulation, carried.body(),
                     [&](const Model<3>& model) { return carried.startOf(model); },
                     {boundaryError, carried.quality(), smallestSpan});
}

std::optional<MeshRecord> Regrader::frameMesh(const Simulation<3>& simulation,
                                              Eigen::MatrixXd& /*displacement*/) const {
  if (records().empty()) return std::nullopt;
  return meshRecord(*simulation.model);
}

void Regrader::archive(StateArchive& archive) {
  archive.field("due", due_);
  MeshRenewal<3>::archive(archive);
}

}  // namespace burnish::inline analysis
