#include "engine/results/doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace burnish::inline results {
namespace {

std::string countText(double count) {
  constexpr std::array words{"no", "one", "two", "three", "four"};
  return words.at(static_cast<std::size_t>(count));
}

/// Of a doubt with a value that is a share.
std::string worstShare(const Doubt& doubt) {
  return fmt::format("at worst {:.3g} %", 100.0 * doubt.worst);
}

std::string nothing(const Doubt& /*doubt*/) {
  return {};
}

struct Row {
  Condition condition;
  double limit;
  std::string (*sentence)(double limit, const SceneTraits& scene);
  std::string (*detail)(const Doubt& doubt);
};

constexpr std::array<Row, kConditions> kTable{{
    {Condition::Penetration, 0.1,
     [](double limit, const SceneTraits&) {
       return fmt::format("point-wise penetration above {} of a knot span or {} of the tool's radius",
                          shareText(limit), shareText(kDoubtfulRadiusShare));
     },
     [](const Doubt& doubt) {
       return fmt::format(
           "{:.2g} times as many knot spans along the contact face would do for the worst (at t = {:.5g})",
           std::ceil(10.0 * doubt.worst) / 10.0, doubt.worstTime);
     }},
    {Condition::SmallJ, 0.05,
     [](double limit, const SceneTraits&) { return fmt::format("smallest J below {}", limit); },
     [](const Doubt& doubt) {
       return fmt::format(
           "at worst {:.3g} (at t = {:.5g}); more knot spans where the body is squeezed, or finer steps, help",
           1.0 / doubt.worst, doubt.worstTime);
     }},
    {Condition::LostContact, 3,
     [](double, const SceneTraits& scene) {
       const std::string few = fewControlPoints() + " carry a contact";
       const std::string deep = fmt::format(
           "face penetrates by more than {} of a knot span: the mesh does not "
           "resolve it any more",
           shareText(limitOf(Condition::Penetration)));
       return scene.rezones ? fmt::format(
                                  "{} for which no new mesh was found, or whose {}; give new meshes more "
                                  "spans (rezoning.spans, in space spans_per_width)",
                                  few, deep)
                            : fmt::format(
                                  "{} whose {}; `rezoning: {{}}` in the scene of a plane body meshes it "
                                  "anew under way",
                                  few, deep);
     },
     nothing},
    {Condition::CrossesItself, 0,
     [](double, const SceneTraits& scene) -> std::string {
       return scene.touchesItself
                  ? "a contact face crosses itself: name it under self_contact or, if it is there, give it a "
                    "larger reach, finer steps or more knot spans"
                  : "a contact face crosses itself, as contact of the body with itself is not computed; "
                    "self_contact computes it for plane and axisymmetric bodies";
     },
     nothing},
    {Condition::NewBoundary, 0.005,
     [](double limit, const SceneTraits&) {
       return fmt::format(
           "the boundary of a new mesh is farther than {} of the body's size from the old one; "
           "give new meshes more spans (rezoning.spans, in space spans_per_width)",
           shareText(limit));
     },
     nothing},
    {Condition::InsideTheBody, 0.1,
     [](double, const SceneTraits&) -> std::string {
       return "a tool presses on a contact face from inside the body: it has come through, or the face has "
              "turned over; take finer steps or more knot spans";
     },
     [](const Doubt& doubt) {
       return fmt::format("{} of its force (at t = {:.5g})", worstShare(doubt), doubt.worstTime);
     }},
    {Condition::Balance, 0.1,
     [](double limit, const SceneTraits&) {
       return fmt::format("work and energies differ by more than {:g} % of the work", 100.0 * limit);
     },
     [](const Doubt& doubt) {
       return fmt::format(
           "{} (at t = {:.5g}); steps of half the size tell whether the sums of work are coarse or "
           "the body has jumped",
           worstShare(doubt), doubt.worstTime);
     }},
    {Condition::Unstable, 0,
     [](double, const SceneTraits&) -> std::string {
       return "the equilibrium is unstable: the body would leave it by itself, by buckling, a jump or rolling "
              "away";
     },
     [](const Doubt& doubt) {
       return fmt::format(
           "in up to {} direction{} (at t = {:.5g}); a small imperfection or side load lets it "
           "take the stable way",
           doubt.worst, doubt.worst == 1.0 ? "" : "s", doubt.worstTime);
     }},
    {Condition::Stabilisation, 0.01,
     [](double limit, const SceneTraits&) {
       return fmt::format("the stabilisation carries more than {:g} % of the largest force", 100.0 * limit);
     },
     [](const Doubt& doubt) {
       return fmt::format("{} (at t = {:.5g}), for the last time at t = {:.5g}", worstShare(doubt),
                          doubt.worstTime, doubt.lastTime);
     }},
    {Condition::CoarsePath, 4,
     [](double limit, const SceneTraits&) {
       return fmt::format(
           "fewer than {} knot spans over the width of the contact under a tool in a pass: what it leaves is "
           "coarse; `resolution` makes a mesh that suits a path",
           countText(limit));
     },
     [](const Doubt& doubt) {
       return fmt::format("at worst {:.2g} (at t = {:.5g})", 1.0 / doubt.worst, doubt.worstTime);
     }},
}};

constexpr bool isInOrder() {
  for (std::size_t k = 0; k < kConditions; ++k)
    if (static_cast<std::size_t>(kTable.at(k).condition) != k) return false;
  return true;
}
static_assert(isInOrder(), "rows stand in the order of the conditions");

const Row& rowOf(Condition condition) {
  return kTable.at(static_cast<std::size_t>(condition));
}

}  // namespace

std::string fewControlPoints() {
  return fmt::format("fewer than {} control points", countText(limitOf(Condition::LostContact)));
}

std::string shareText(double share) {
  return share == 0.1 ? "a tenth" : fmt::format("{:g} %", 100.0 * share);
}

void Doubt::note(double time, double value) {
  if (steps == 0) firstTime = time;
  ++steps;
  lastTime = time;
  if (steps > 1 && value <= worst) return;
  worst = value;
  worstTime = time;
}

void Doubt::archive(StateArchive& archive) {
  archive.together("held", steps, firstTime, worst, worstTime, lastTime);
}

double limitOf(Condition condition) {
  return rowOf(condition).limit;
}

std::string sentenceOf(Condition condition, const SceneTraits& scene) {
  const Row& row = rowOf(condition);
  return row.sentence(row.limit, scene);
}

std::string detailOf(Condition condition, const Doubt& doubt) {
  return rowOf(condition).detail(doubt);
}

double imbalanceOf(double found, double done, double largestEnergy) {
  const double scale = std::max({std::abs(found), std::abs(done), largestEnergy});
  return scale > 0.0 ? std::abs(done - found) / scale : 0.0;
}

}  // namespace burnish::inline results
