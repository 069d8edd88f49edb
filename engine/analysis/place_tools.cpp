#include "engine/analysis/place_tools.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "engine/analysis/followed_surface.h"
#include "engine/analysis/free_tools.h"
#include "engine/analysis/nearest_point.h"
#include "engine/core/input_error.h"
#include "engine/scene/path_of_tool.h"

namespace burnish::inline analysis {
namespace {

template <int Dim>
using Pairs = std::vector<FaceContact<Dim>*>;

template <int Dim>
Pairs<Dim> pairsOf(const Model<Dim>& model, std::size_t tool) {
  Pairs<Dim> pairs;
  for (const auto& pair : model.contacts())
    if (pair.tool == tool) pairs.push_back(pair.term.get());
  return pairs;
}

/// An averaged gap of this share of the body's size is no touch.
constexpr double kNearlyTouching = 1e-6;

/// Smallest gap of undeformed faces, as the method of each pair takes it.
template <int Dim>
double smallestGap(const Pairs<Dim>& pairs, const Tool& tool, const ToolPose& pose) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto* pair : pairs) smallest = std::min(smallest, pair->smallestReferenceGap(gapTo(tool, pose)));
  return smallest;
}

/// How far a tool has to be lifted at the start so that no averaged gap of the undeformed face is negative.
/// Functions of a Lagrange basis have negative lobes: their averaged gap can be negative although nothing
/// touches, and the first step would start with a jump. Zero when no gap is negative by more than rounding
/// explains. Throws `InputError` at `place` if no lift up to the body's size separates them.
template <int Dim>
Eigen::Vector3d liftToSeparate(const Pairs<Dim>& pairs, const Tool& tool, double bodySize,
                               const std::string& place) {
  double worst = -kTouching * bodySize;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  ToolPose pose = tool.pose(0.0);
  for (const auto* pair : pairs) {
    const Eigen::VectorXd gaps = pair->referenceGaps(gapTo(tool, pose));
    Eigen::Index A = 0;
    if (gaps.minCoeff(&A) >= worst) continue;
    worst = gaps(A);
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    x.template head<Dim>() = pair->face().points().col(A);
    direction = -tool.query(pose, x).normal;
  }
  if (direction.isZero(0.0)) return direction;

  constexpr double kMargin = 1.05;
  const Eigen::Vector3d start = pose.displacement;
  double height = -kMargin * worst;
  while (height < bodySize) {
    pose.displacement = start + height * direction;
    if (smallestGap(pairs, tool, pose) > 0.0) return height * direction;
    height *= kMargin;
  }
  throw InputError(place, fmt::format("tool '{}' cannot be lifted off the face that it touches, averaged "
                                      "gaps stay negative; start it farther away",
                                      tool.name));
}

/// Lifts tools whose motion is prescribed; they come down before t = 0. Returns the time at which the run
/// starts.
template <int Dim>
double liftTools(const Scene& scene, Model<Dim>& model) {
  constexpr int kApproachSteps = 4;
  const double approachTime = kApproachSteps * scene.steps.front().until / scene.steps.front().count;
  double startTime = 0.0;
  for (std::size_t k = 0; k < model.tools().size(); ++k) {
    Tool& tool = *model.tools()[k];
    if (!tool.freeUnknowns().empty()) continue;  // finds its own height
    Pairs<Dim> pairs = pairsOf(model, k);
    std::erase_if(pairs, [](const FaceContact<Dim>* pair) { return !averagesGaps(pair->options().method); });
    if (pairs.empty()) continue;
    tool.lift = liftToSeparate<Dim>(pairs, tool, model.body().size(), fmt::format("tools[{}]", k));
    if (tool.lift.isZero(0.0)) continue;
    tool.approachTime = approachTime;
    startTime = -approachTime;
  }
  return startTime;
}

/// Scattered points around a tool, at distances of about the body's size.
std::vector<Eigen::Vector3d> pointsAround(const Eigen::Vector3d& middle, int dim, double bodySize) {
  constexpr int kPerDirection = 4;
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k < (dim == 2 ? 1 : kPerDirection) * kPerDirection * kPerDirection; ++k) {
    // Shares that differ from one direction to the next, so that no symmetry of a shape hides a degree of
    // freedom.
    const Eigen::Vector3i place(k % kPerDirection, k / kPerDirection % kPerDirection,
                                k / (kPerDirection * kPerDirection));
    const Eigen::Vector3d grid = place.cast<double>();
    Eigen::Vector3d x = middle;
    for (int d = 0; d < dim; ++d) x(d) += bodySize * (0.71 * grid(d) - 1.03 - 0.11 * d);
    points.push_back(x);
  }
  return points;
}

/// By how much gaps of points around a tool change with its free degrees of freedom, points x `dofs`.
Eigen::MatrixXd slopesOfGaps(const Tool& tool, const std::vector<std::size_t>& dofs, int dim,
                             double bodySize) {
  const ToolPose pose = tool.pose(0.0);
  const auto points = pointsAround(tool.shape.middle(), dim, bodySize);
  Eigen::MatrixXd slopes(points.size(), dofs.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    slopes.row(static_cast<Eigen::Index>(k)) = tool.queryWithDofs(pose, points[k]).dDofs(dofs).transpose();
  return slopes;
}

/// Slopes of gaps below this share of the number of points are none.
constexpr double kNoSlope = 1e-8;

/// Whether the shape of a tool moves in itself when it turns about its axis, as that of a roller or a ball.
bool turnsInItself(const Tool& tool, int dim, double bodySize) {
  const Eigen::MatrixXd slopes = slopesOfGaps(tool, {kTurn}, dim, bodySize);
  return slopes.norm() <= kNoSlope * static_cast<double>(slopes.rows());
}

/// Throws `InputError` at `place` unless a tool is a ball about its pivot, and rubs.
void requireBall(Tool tool, double bodySize, bool rubs, const std::string& place) {
  for (int d = 0; d < 3; ++d) {
    tool.axis = Eigen::Vector3d::Unit(d);
    if (!turnsInItself(tool, 3, bodySize))
      throw InputError(
          place,
          fmt::format("tool '{}' is no ball about its pivot; spin is for spheres that turn about their "
                      "middle. Give other tools a moment about their pivot_axis",
                      tool.name));
  }
  if (!rubs)
    throw InputError(
        place, fmt::format("nothing turns tool '{}', as no contact of it has friction; leave spin out, or "
                           "give its contact friction",
                           tool.name));
}

/// Throws `InputError` at `place` if the force that a tool carries in its holder ever pulls it off the body.
void requirePressed(const ToolLoad& load, const ToolLoad::Holder& holder, double end,
                    const std::string& place) {
  constexpr int kSamples = 1000;
  for (int k = 0; k <= kSamples; ++k) {
    const double t = end * k / kSamples, force = load.forceAlong(holder.dof, t);
    if (holder.sign * force < 0.0)
      throw InputError(place,
                       fmt::format("found {:.4g} at t = {:.4g}, a force along clearance that lifts the tool; "
                                   "allowed: forces that press it on the body",
                                   force, t));
  }
}

/// Throws `InputError` at a key of `place` (`tools[0]`) if the clearance of a path does not lead away from the face that
/// its tool follows, where a pass begins or ends.
void requireLifted(const ToolSpec& spec, const Tool& tool, const std::string& place) {
  const ToolPath path = pathOf(spec);
  for (const ToolPath::Pass& touch : path.touches())
    for (const double t : {touch.begin, touch.end})
      if (!(path.clearance(t).dot(tool.normal(t)) > 0.0))
        throw InputError(
            place + ".path.clearance",
            fmt::format(
                "found one that does not lead away from the face at t = {:.4g}, where the tool is to be {}; "
                "allowed: a direction that lifts it off there",
                t, t == touch.begin ? "taken down" : "lifted"));
}

/// Throws `InputError` that names the keys at `place` (`tools[0].carry`) of the free degrees of freedom in
/// which the shape of a tool moves in itself, for instance a disc that turns about its middle: no contact
/// resists it there. turns: friction determines its turn.
void requireDetermined(const Tool& tool, const std::string& place, int dim, double bodySize, bool turns) {
  std::vector<std::size_t> dofs;
  for (std::size_t dof = 0; dof < kToolDofs; ++dof)
    if (tool.isFree(dof) && !(turns && dof == kTurn)) dofs.push_back(dof);
  if (dofs.empty()) return;
  const Eigen::MatrixXd slopes = slopesOfGaps(tool, dofs, dim, bodySize);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(slopes, Eigen::ComputeThinV);
  if (svd.singularValues().tail<1>()(0) > kNoSlope * static_cast<double>(slopes.rows())) return;
  std::vector<std::string> keys;
  for (std::size_t k = 0; k < dofs.size(); ++k)
    if (std::abs(svd.matrixV().rightCols<1>()(static_cast<Eigen::Index>(k))) > kNoSlope)
      keys.push_back(fmt::format("{}.{}", place, carryKey(tool, dofs[k])));
  const std::string others =
      keys.size() == 1 ? ""
                       : fmt::format(", together with {},", fmt::join(keys.begin() + 1, keys.end(), " and "));
  throw InputError(keys.front(),
                   fmt::format("tool '{}' moves in itself in this way{} so that no contact force resists it; "
                               "leave it out of carry, then it is held, or prescribe it",
                               tool.name, others));
}

/// Direction at t = 0 of the first force, of all times up to `end`, that a tool carries; zero if there is none.
Eigen::Vector3d firstDirection(const ToolLoad& load, double end) {
  constexpr int kSamples = 1000;
  const Tool& tool = load.tool();
  const ToolPose start = tool.pose(0.0);
  for (int k = 0; k <= kSamples; ++k) {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    for (std::size_t dof = 0; dof < kTurn; ++dof)
      if (tool.isFree(dof)) force += load.forceAlong(dof, end * k / kSamples) * tool.direction(dof, start);
    if (!force.isZero(0.0)) return force.normalized();
  }
  return Eigen::Vector3d::Zero();
}

/// Displacement along a direction that brings a tool from its place at t = 0 to the undeformed body, so that
/// its smallest averaged gap vanishes. Throws `InputError` at `place` if the tool does not meet the body on
/// this way.
template <int Dim>
Eigen::Vector3d shiftToTouch(const Pairs<Dim>& pairs, const Tool& tool, const Eigen::Vector3d& direction,
                             double bodySize, const std::string& place) {
  constexpr int kMostSteps = 1000;
  ToolPose pose = tool.pose(0.0);
  const Eigen::Vector3d start = pose.displacement;
  double way = 0.0;
  for (int k = 0; k < kMostSteps; ++k) {
    pose.displacement = start + way * direction;
    const double gap = smallestGap(pairs, tool, pose);
    if (std::abs(gap) < kTouching * bodySize) return way * direction;
    if (gap > 1e3 * bodySize) break;
    way += gap;  // gaps fall by no more than the way, so that this does not go too far
  }
  throw InputError(place, fmt::format("tool '{}' does not meet its face when it moves along the force that "
                                      "it carries; place it so that the force presses it on the body",
                                      tool.name));
}

/// Throws `InputError` at `place` if no gap between the undeformed faces and a tool at t = 0 vanishes.
template <int Dim>
void requireTouch(const Pairs<Dim>& pairs, const Tool& tool, double bodySize, const std::string& place) {
  if (smallestGap(pairs, tool, tool.pose(0.0)) > kNearlyTouching * bodySize)
    throw InputError(place, fmt::format("tool '{}' is free to turn, but does not touch its face at the "
                                        "start; place it on the face, or let it carry a force too",
                                        tool.name));
}

/// Makes a tool that carries a force touch gently.
template <int Dim>
void touchGently(Model<Dim>& model, const CarriedLoad& load) {
  const Tool& tool = *model.tools()[load.tool];
  const Body<Dim>& body = model.body();
  const bool isPlane = Dim == 2 && !body.axisymmetric;
  double E = std::numeric_limits<double>::infinity();
  for (const auto& one : model.bodies()) E = std::min(E, youngsModulus(one.bulk->material()));
  const auto cover = [pairs = pairsOf(model, load.tool), &tool](const ToolPose& pose,
                                                                const Eigen::VectorXd& x) {
    typename FaceContact<Dim>::Cover all{0.0, std::numeric_limits<double>::infinity()};
    for (const auto* pair : pairs) {
      const auto one = pair->coverAt(x, gapTo(tool, pose));
      all.area += one.area;
      all.smallestGap = std::min(all.smallestGap, one.smallestGap);
    }
    return all;
  };
  // A rough estimate on the low side: the depth w with which a tool covers an area A of the face is resisted with
  // E √A w, in the plane with E w.
  const auto depthUnder = [=, &body](double force, const Eigen::Vector3d& direction, ToolPose pose,
                                     const Eigen::VectorXd& x) {
    constexpr int kBisections = 40;
    const Eigen::Vector3d begin = pose.displacement;
    const double inAir = std::max(0.0, cover(pose, x).smallestGap);
    double low = inAir, high = inAir + body.size();
    for (int k = 0; k < kBisections; ++k) {
      const double middle = 0.5 * (low + high);
      pose.displacement = begin + middle * direction;
      const double resistance = E * (middle - inAir) * (isPlane ? 1.0 : std::sqrt(cover(pose, x).area));
      (resistance < force ? low : high) = middle;
    }
    return high;
  };
  load.term->setFirstTouch({
      .depthUnder = depthUnder,
      .smallestGap = [cover](const ToolPose& pose,
                             const Eigen::VectorXd& x) { return cover(pose, x).smallestGap; },
      .reaction =
          [pairs = pairsOf(model, load.tool)] {
            Eigen::Vector3d sum = Eigen::Vector3d::Zero();
            for (const auto* pair : pairs) sum += pair->state().reaction;
            return sum;
          },
      .stiffness = model.forceFloor() / body.size() / kForceFloor,
  });
}

bool slides(const Tool& tool) {
  return tool.isFree(0) || tool.isFree(1) || tool.isFree(2);
}

/// Whether all that is free of a tool are turns in which it moves in itself: it touches where its motion takes it, and
/// keeps its turn elsewhere.
template <int Dim>
bool turnsAlone(const Model<Dim>& model, const Tool& tool) {
  return !slides(tool) &&
         (tool.spins() || (tool.isFree(kTurn) && turnsInItself(tool, Dim, model.body().size())));
}

/// Tells a tool with free degrees of freedom of the faces that it touches, and of the stiffness of the body.
template <int Dim>
void prepareFreeTool(const Scene& scene, Model<Dim>& model, const CarriedLoad& load) {
  const Tool& tool = *model.tools()[load.tool];
  const double bodySize = model.body().size();
  const Pairs<Dim> pairs = pairsOf(model, load.tool);
  const std::string place = fmt::format("tools[{}].carry", load.tool);
  if (pairs.empty())
    throw InputError(
        place,
        fmt::format("tool '{}' is free to move, but touches no face; name it under contact", tool.name));
  const bool rubs =
      std::ranges::any_of(pairs, [](const auto* pair) { return pair->options().hasFriction(); });
  const double steadiness = model.forceFloor() / bodySize;
  if (tool.spins()) requireBall(tool, bodySize, rubs, place + ".spin");
  const bool turns = rubs && tool.isFree(kTurn) && turnsInItself(tool, Dim, bodySize);
  if (turns || tool.spins()) load.term->steadyTurns(steadiness);
  requireDetermined(tool, place, Dim, bodySize, turns);
  if (auto& holder = load.term->holder()) {
    requirePressed(*load.term, *holder, scene.steps.back().until,
                   fmt::format("{}.{}", place, carryKey(tool, holder->dof)));
    if (tool.followsSurface())
      requireLifted(scene.tools[load.tool], tool, fmt::format("tools[{}]", load.tool));
    holder->stiffness = steadiness / kForceFloor;  // that of the body
    holder->steadiness = steadiness;
  } else if (!turnsAlone(model, tool)) {
    pairs.back()->keepInTouch({pairs.begin(), pairs.end() - 1});
  }
  if (load.term->holder() || slides(tool)) touchGently(model, load);
}

/// Brings a prepared tool into touch with the body, unless its path does or it turns alone. x: unknowns of the start, in
/// which its displacement is written.
template <int Dim>
void placeFreeTool(const Scene& scene, Model<Dim>& model, const CarriedLoad& load, Eigen::VectorXd& x) {
  const Tool& tool = *model.tools()[load.tool];
  const double bodySize = model.body().size();
  const Pairs<Dim> pairs = pairsOf(model, load.tool);
  const std::string place = fmt::format("tools[{}].carry", load.tool);
  if (const auto& holder = load.term->holder()) {
    if (!tool.followsSurface())
      x(tool.unknowns[holder->dof]) = tool.pose(0.0).displacement(static_cast<Eigen::Index>(holder->dof));
    return;  // its path takes it to the body
  }
  if (turnsAlone(model, tool)) return;
  if (!slides(tool)) {
    requireTouch<Dim>(pairs, tool, bodySize, place);
    return;
  }
  const Eigen::Vector3d direction = firstDirection(*load.term, scene.steps.back().until);
  if (direction.isZero(0.0))
    throw InputError(
        place, fmt::format("tool '{}' carries no force at any time; give it one, or prescribe its motion",
                           tool.name));
  const ToolPose start = tool.pose(0.0);
  const Eigen::Vector3d shift = shiftToTouch<Dim>(pairs, tool, direction, bodySize, place);
  if (tool.followsSurface())
    x(tool.unknowns[kNormal]) = shift.dot(start.normal);
  else
    for (std::size_t dof = 0; dof < kTurn; ++dof)
      if (tool.isFree(dof))
        x(tool.unknowns[dof]) = (start.displacement + shift)(static_cast<Eigen::Index>(dof));
}

/// Tells a tool that carries a force along the normal which faces it follows. Throws `InputError` at `place` where these
/// have none.
template <int Dim>
void followFaces(const Scene& scene, Model<Dim>& model, std::size_t number, const std::string& place) {
  constexpr int kSamples = 1000;
  std::vector<FacePlace> faces;
  for (const auto& pair : model.contacts())
    if (pair.tool == number && std::ranges::find(faces, pair.place) == faces.end())
      faces.push_back(pair.place);
  if (faces.empty()) return;  // said where tools are placed
  Tool& tool = *model.tools()[number];
  placed(place, [&] {
    const auto surface = std::make_shared<const FollowedSurface<Dim>>(model.body(), faces);
    tool.normal = [surface, guide = tool](double t) {
      const ToolPose pose = guide.pose(t);
      const Eigen::Vector3d arm = guide.shape.middle() - guide.pivot;
      return surface->normalNextTo(Eigen::AngleAxisd(pose.angle, guide.axis) * arm + guide.pivot +
                                   pose.displacement);
    };
    for (int k = 0; k <= kSamples; ++k) tool.normal(scene.steps.back().until * k / kSamples);
  });
}

}  // namespace

template <int Dim>
SteppingState placeTools(const Scene& scene, Model<Dim>& model) {
  SteppingState start;
  start.x = Eigen::VectorXd::Zero(model.numUnknowns());
  for (std::size_t k = 0; k < scene.tools.size(); ++k)
    if (scene.tools[k].carry && scene.tools[k].carry->normal)
      followFaces(scene, model, k, fmt::format("tools[{}].carry.normal", k));
  start.time = liftTools(scene, model);
  InputProblems problems;
  for (const CarriedLoad& load : model.toolLoads())
    problems.gather([&] {
      prepareFreeTool(scene, model, load);
      placeFreeTool(scene, model, load, start.x);
    });
  problems.throwIfAny();
  return start;
}

template <int Dim>
void prepareTools(const Scene& scene, Model<Dim>& model) {
  for (const CarriedLoad& load : model.toolLoads()) prepareFreeTool(scene, model, load);
}

template void prepareTools(const Scene&, Model<2>&);
template void prepareTools(const Scene&, Model<3>&);
template SteppingState placeTools(const Scene&, Model<2>&);
template SteppingState placeTools(const Scene&, Model<3>&);

}  // namespace burnish::inline analysis
