#include "engine/results/doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace burnish {
namespace {

std::string sentenceOf(Condition condition, bool rezones, bool touchesItself) {
  switch (condition) {
    case Condition::Penetration:
      return "point-wise penetration above a tenth of a knot span or 1 % of the tool's radius";
    case Condition::SmallJ:
      return "smallest J below 0.05";
    case Condition::LostContact:
      return rezones ? "fewer than three control points carry a contact for which no new mesh was found, or "
                       "whose face penetrates by more than a tenth of a knot span: the mesh does not resolve "
                       "it any more; give new meshes more spans (rezoning.spans)"
                     : "fewer than three control points carry a contact whose face penetrates by more than a "
                       "tenth of a knot span: the mesh does not resolve it any more; `rezoning: {}` in the "
                       "scene of a plane body meshes it anew under way";
    case Condition::CrossesItself:
      return touchesItself ? "a contact face crosses itself: name it under self_contact or, if it is there, "
                             "give it a larger reach, finer steps or more knot spans"
                           : "a contact face crosses itself, as contact of the body with itself is not "
                             "computed; self_contact computes it for plane and axisymmetric bodies";
    case Condition::NewBoundary:
      return "the boundary of a new mesh is farther than 0.5 % of the body's size from the old one; give new "
             "meshes more spans (rezoning.spans)";
    case Condition::InsideTheBody:
      return "a tool presses on a contact face from inside the body: it has come through, or the face has "
             "turned over; take finer steps or more knot spans";
    case Condition::Balance:
      return fmt::format("work and energies differ by more than {:.0f} % of the work",
                         100.0 * kDoubtfulBalance);
    case Condition::Unstable:
      return "the equilibrium is unstable: the body would leave it by itself, by buckling, a jump or rolling "
             "away";
    case Condition::Stabilisation:
      return fmt::format("the stabilisation carries more than {:.0f} % of the largest force",
                         100.0 * kDoubtfulStabilisation);
    case Condition::Count:
      break;
  }
  return {};
}

}  // namespace

void Doubt::note(double time, double value) {
  if (steps == 0) firstTime = time;
  ++steps;
  lastTime = time;
  if (steps > 1 && value <= worst) return;
  worst = value;
  worstTime = time;
}

void archiveDoubts(StateArchive& archive, const char* name, std::vector<Doubt>& doubts) {
  // One field for all: a field of its own costs a file more than its values.
  constexpr std::array kNumbers{&Doubt::firstTime, &Doubt::worst, &Doubt::worstTime, &Doubt::lastTime};
  std::vector<double> values;
  for (const Doubt& doubt : doubts) {
    values.push_back(doubt.steps);
    for (const auto number : kNumbers) values.push_back(doubt.*number);
  }
  archive.fixedField(name, values);
  auto value = values.begin();
  for (Doubt& doubt : doubts) {
    doubt.steps = static_cast<int>(*value++);
    for (const auto number : kNumbers) doubt.*number = *value++;
  }
}

std::vector<Doubt> commonDoubts(bool rezones, bool touchesItself) {
  std::vector<Doubt> doubts;
  for (std::size_t k = 0; k < static_cast<std::size_t>(Condition::Count); ++k)
    doubts.push_back({sentenceOf(static_cast<Condition>(k), rezones, touchesItself)});
  return doubts;
}

std::string detailOf(Condition condition, const Doubt& doubt) {
  const double time = doubt.worstTime;
  switch (condition) {
    case Condition::Penetration:
      return fmt::format(
          "{:.2g} times as many knot spans along the contact face would do for the worst (at t = {:.5g})",
          std::ceil(10.0 * doubt.worst) / 10.0, time);
    case Condition::SmallJ:
      return fmt::format(
          "at worst {:.3g} (at t = {:.5g}); more knot spans where the body is squeezed, or finer steps, help",
          1.0 / doubt.worst, time);
    case Condition::Balance:
      return fmt::format(
          "at worst {:.3g} % (at t = {:.5g}); steps of half the size tell whether the sums of work are "
          "coarse or the body has jumped",
          100.0 * doubt.worst, time);
    case Condition::Unstable:
      return fmt::format(
          "in up to {} direction{} (at t = {:.5g}); a small imperfection or side load lets it take the "
          "stable way",
          doubt.worst, doubt.worst == 1.0 ? "" : "s", time);
    case Condition::InsideTheBody:
      return fmt::format("at worst {:.3g} % of its force (at t = {:.5g})", 100.0 * doubt.worst, time);
    case Condition::Stabilisation:
      return fmt::format("at worst {:.3g} % (at t = {:.5g}), for the last time at t = {:.5g}",
                         100.0 * doubt.worst, time, doubt.lastTime);
    case Condition::LostContact:
    case Condition::CrossesItself:
    case Condition::NewBoundary:
    case Condition::Count:
      break;
  }
  return {};
}

double imbalanceOf(double found, double done, double largestEnergy) {
  const double scale = std::max({std::abs(found), std::abs(done), 0.01 * largestEnergy});
  return scale > 0.0 ? std::abs(done - found) / scale : 0.0;
}

}  // namespace burnish
