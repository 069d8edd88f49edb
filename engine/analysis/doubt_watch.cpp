#include "engine/analysis/doubt_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/analysis/contact_side.h"
#include "engine/analysis/pressed_part.h"
#include "engine/core/quoted.h"
#include "engine/scene/path_of_tool.h"

namespace burnish::inline analysis {
namespace {

/// So many states are needed before sums of work mean much; a run of fewer is judged by its end alone.
constexpr int kCoarseStates = 10;

/// Largest penetration over the size of a span.
template <class Contact>
double penetrationPerSpan(const Contact& term) {
  double largest = 0.0;
  for (const auto& span : term.face().spans())
    largest = std::max(
        largest, -term.state().gap.segment(span.firstPoint, span.weights.size()).minCoeff() / span.size);
  return largest;
}

/// Whether a face rubs on something. Friction holds what would leave its equilibrium without it, and the symmetric
/// part of its tangent says nothing about that.
template <int Dim>
bool anyContactRubs(const Model<Dim>& model) {
  const auto any = [](const auto& contacts) {
    return std::any_of(contacts.begin(), contacts.end(), [](const auto& contact) {
      return contact.term->options().hasFriction() && !contact.term->hasLostTouch();
    });
  };
  return any(model.contacts()) || any(model.pairs()) || any(model.selfContacts());
}

/// Saves or restores parts under numbered names.
template <class Parts>
void archiveAll(StateArchive& archive, const std::string& name, Parts& parts) {
  for (std::size_t k = 0; k < parts.size(); ++k) archive.part(fmt::format("{}{}", name, k), parts[k]);
}

}  // namespace

template <int Dim>
DoubtWatch<Dim>::DoubtWatch(const Scene& scene, const Model<Dim>& model)
    : model_(model),
      scene_{.rezones = scene.rezoning.has_value(), .touchesItself = !scene.selfContact.empty()},
      rezoned_(scene.rezoning ? &model.bodies()[scene.rezonedBody()] : nullptr),
      peaks_(model.contacts().size() + model.pairs().size()),
      toolWatch_(model),
      tipWatch_(model),
      toolDoubts_(toolWatch_.sentences().size()),
      tipDoubts_(model.contacts().size()),
      tips_(model.contacts().size()),
      touched_(model.tools().size(), false) {
  for (const ToolSpec& tool : scene.tools)
    paths_.push_back(tool.path ? std::optional(pathOf(tool)) : std::nullopt);
  passes_.resize(paths_.size());
}

template <int Dim>
void DoubtWatch<Dim>::note(Condition condition, bool holds, double time, double value) {
  if (holds) doubts_[static_cast<std::size_t>(condition)].note(time, value);
}

template <int Dim>
void DoubtWatch<Dim>::update(const RunHistory<Dim>& history, const std::function<int()>& unstableDirections) {
  const StateQuantities& s = history.current();
  note(Condition::SmallJ, s.minJ < limitOf(Condition::SmallJ), s.time, 1.0 / s.minJ);
  note(Condition::CrossesItself, s.crossesItself, s.time);
  if (rezoned_ != nullptr)
    note(Condition::NewBoundary,
         s.rezonings.boundaryError > limitOf(Condition::NewBoundary) * rezoned_->body.size(), s.time);
  if (!anyContactRubs(model_)) {
    const int unstable = unstableDirections();
    note(Condition::Unstable, unstable > limitOf(Condition::Unstable), s.time, unstable);
  }
  note(Condition::Stabilisation, s.stabilisedShare > limitOf(Condition::Stabilisation), s.time,
       s.stabilisedShare);
  watchContacts(history);
  watchPaths(s.time);
  if (history.numStates() > kCoarseStates) watchWork(history);
  watchTools(s, history.x());
}

/// Whether no new mesh was found for the body that a face is of.
template <int Dim>
bool DoubtWatch<Dim>::needsNewMesh(const FacePlace& place) const {
  return needsNewMesh_ && &model_.bodyOf(place) == rezoned_;
}

template <int Dim>
bool DoubtWatch<Dim>::hasLostResolution(const ContactPair<Dim>& pair) const {
  const int active = pair.term->state().numActive();
  return active > 0 && active < limitOf(Condition::LostContact) &&
         (needsNewMesh(pair.place) || penetrationPerSpan(*pair.term) > limitOf(Condition::Penetration));
}

template <int Dim>
void DoubtWatch<Dim>::watchContacts(const RunHistory<Dim>& history) {
  const double time = history.current().time, spanShare = limitOf(Condition::Penetration);
  double refinement = 0.0, inside = 0.0;
  bool lost = false;
  for (const auto& pair : model_.contacts()) {
    const double radius = model_.tools()[pair.tool]->shape.halfThickness();
    // On finer spans the penetration falls with the square of their size.
    refinement =
        std::max({refinement, penetrationPerSpan(*pair.term) / spanShare,
                  std::sqrt(pair.term->state().largestPenetration() / (kDoubtfulRadiusShare * radius))});
    inside = std::max(inside, forceFromInside(model_.body(), pair, history.x()));
    lost = lost || hasLostResolution(pair);
    if (pair.term->state().pressure.maxCoeff() > 0.0) touched_[pair.tool] = true;
  }
  for (const auto& pair : model_.pairs())
    refinement = std::max(refinement, penetrationPerSpan(*pair.term) / spanShare);
  for (const auto& contact : model_.selfContacts())
    refinement = std::max(refinement, penetrationPerSpan(*contact.term) / spanShare);
  std::size_t peak = 0;
  for (const auto& pair : model_.contacts()) peaks_[peak++].update(*pair.term, history.x(), time);
  for (const auto& pair : model_.pairs()) peaks_[peak++].update(*pair.term, history.x(), time);
  note(Condition::Penetration, refinement > 1.0, time, refinement);
  note(Condition::LostContact, lost, time);
  note(Condition::InsideTheBody, inside > limitOf(Condition::InsideTheBody), time, inside);
}

/// Meshes where the forces of passes are full: while a tool comes down its contact is small in any case.
template <int Dim>
void DoubtWatch<Dim>::watchPaths(double time) {
  double coarseness = 0.0;
  std::vector<std::optional<bool>> touches(paths_.size());  // of tools with a contact
  for (const auto& pair : model_.contacts()) {
    if (!paths_[pair.tool]) continue;
    touches[pair.tool] = touches[pair.tool].value_or(false) || pair.term->state().pressure.maxCoeff() > 0.0;
    if (!paths_[pair.tool]->hasFullForce(time)) continue;
    const auto [area, largestSpan] = pressedPart(*pair.term);
    if (area > 0.0) coarseness = std::max(coarseness, largestSpan / (2.0 * halfWidthOf<Dim>(area)));
  }
  for (std::size_t k = 0; k < touches.size(); ++k)
    if (touches[k]) passes_[k].update(*paths_[k], time, *touches[k]);
  constexpr double kRounding = 1e-9;  // spans of which just enough lie over the width
  note(Condition::CoarsePath, coarseness * limitOf(Condition::CoarsePath) > 1.0 + kRounding, time,
       coarseness);
}

template <int Dim>
void DoubtWatch<Dim>::watchWork(const RunHistory<Dim>& history) {
  const StateQuantities& s = history.current();
  const double imbalance =
      imbalanceOf(s.energyFound(), s.externalWork + history.otherWork(), s.largestEnergy);
  note(Condition::Balance, imbalance > limitOf(Condition::Balance), s.time, imbalance);
}

template <int Dim>
void DoubtWatch<Dim>::noteEnd(const RunHistory<Dim>& history) {
  if (history.numStates() <= kCoarseStates) watchWork(history);
}

template <int Dim>
void DoubtWatch<Dim>::watchTools(const StateQuantities& current, const Eigen::VectorXd& x) {
  const auto reached = toolWatch_.reached(current.toolPoses, x);
  for (std::size_t k = 0; k < reached.size(); ++k)
    if (reached[k]) toolDoubts_[k].note(current.time);
  const auto tips = tipWatch_.tips(current.toolPoses, x);
  for (std::size_t k = 0; k < tips.size(); ++k) {
    if (tips_[k].depth == 0.0) tips_[k] = tips[k];
    if (tips[k].depth > 0.0) tipDoubts_[k].note(current.time);
  }
}

/// Contacts with less than a share of the largest force touch in passing, and are not judged; nor is any where it is told
/// already that few control points carry a contact.
template <int Dim>
std::vector<DoubtRecord> DoubtWatch<Dim>::peakRecords() const {
  constexpr double kShare = 0.1;
  if (doubts_[static_cast<std::size_t>(Condition::LostContact)].steps > 0) return {};
  double largest = 0.0;
  for (const PeakContact& peak : peaks_) largest = std::max(largest, peak.force());
  const auto& contacts = model_.contacts();
  std::vector<DoubtRecord> records;
  for (std::size_t k = 0; k < peaks_.size(); ++k) {
    if (!peaks_[k].isCoarse() || peaks_[k].force() < kShare * largest) continue;
    const bool ofTool = k < contacts.size();
    const FacePlace& place = ofTool ? contacts[k].place : model_.pairs()[k - contacts.size()].place;
    const std::string name =
        ofTool ? model_.tools()[contacts[k].tool]->name : model_.pairs()[k - contacts.size()].name;
    records.push_back(
        {fmt::format("the largest force of contact {} is carried by {} of face {}, "
                     "and may be off by tens of per cent: finer knot spans along that face, where it touches",
                     quoted(name), fewControlPoints(), model_.faces().textOf(place)),
         peaks_[k].time(), 1, peaks_[k].pointsText()});
  }
  return records;
}

template <int Dim>
std::vector<DoubtRecord> DoubtWatch<Dim>::records() const {
  std::vector<DoubtRecord> records;
  const auto add = [&](const Doubt& doubt, std::string what, std::string detail = {}) {
    if (doubt.steps > 0)
      records.push_back({std::move(what), doubt.firstTime, doubt.steps, std::move(detail)});
  };
  for (std::size_t k = 0; k < kConditions; ++k) {
    const auto condition = static_cast<Condition>(k);
    add(doubts_[k], sentenceOf(condition, scene_), detailOf(condition, doubts_[k]));
  }
  const std::vector<std::string> sentences = toolWatch_.sentences();
  for (std::size_t k = 0; k < toolDoubts_.size(); ++k) add(toolDoubts_[k], sentences[k]);
  for (std::size_t k = 0; k < tipDoubts_.size(); ++k) add(tipDoubts_[k], tipWatch_.sentence(k, tips_[k]));
  std::ranges::move(peakRecords(), std::back_inserter(records));
  for (std::size_t k = 0; k < passes_.size(); ++k) {
    if (!paths_[k]) continue;
    const std::string& name = model_.tools()[k]->name;
    add(passes_[k].doubt(),
        fmt::format("{} touches nothing in a pass: its path leads over the body or beside it", name),
        passes_[k].passText(*paths_[k]));
    add(passes_[k].heldDoubt(),
        fmt::format(
            "{} still touches when it has been lifted: what is left in the body then is under its load; give "
            "its path a larger clearance",
            name));
  }
  return records;
}

template <int Dim>
std::vector<std::string> DoubtWatch<Dim>::idleTools() const {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < touched_.size(); ++k) {
    const auto& contacts = model_.contacts();
    const bool paired =
        std::any_of(contacts.begin(), contacts.end(), [&](const auto& pair) { return pair.tool == k; });
    if (paired && !touched_[k]) names.push_back(model_.tools()[k]->name);
  }
  return names;
}

template <int Dim>
void DoubtWatch<Dim>::continueFrom(const DoubtWatch& before) {
  doubts_ = before.doubts_;
  toolDoubts_ = before.toolDoubts_;
  tipDoubts_ = before.tipDoubts_;
  tips_ = before.tips_;
  touched_ = before.touched_;
  passes_ = before.passes_;
  peaks_ = before.peaks_;
}

template <int Dim>
void DoubtWatch<Dim>::archive(StateArchive& archive) {
  archiveAll(archive, "condition", doubts_);
  archiveAll(archive, "tool", toolDoubts_);
  archiveAll(archive, "pair", tipDoubts_);
  archiveAll(archive, "pass", passes_);
  archiveAll(archive, "contact", peaks_);
  for (std::size_t k = 0; k < tips_.size(); ++k)
    archive.together(fmt::format("tip{}", k), tips_[k].depth, tips_[k].turn, tips_[k].span);
  archive.fixedField("touched", touched_);
  archive.field("needs_new_mesh", needsNewMesh_);
}

template class DoubtWatch<2>;
template class DoubtWatch<3>;

}  // namespace burnish::inline analysis
