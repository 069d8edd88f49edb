#include "engine/analysis/history_columns.h"

#include <algorithm>
#include <numbers>

namespace burnish {
namespace {

struct Row {
  const char* name;
  double (*value)(const HistoryRow& row);
};

constexpr Row kStep[] = {
    {"step", [](const HistoryRow& r) { return static_cast<double>(r.step); }},
    {"time", [](const HistoryRow& r) { return r.state.time; }},
};

constexpr Row kBody[] = {
    {"strain_energy", [](const HistoryRow& r) { return r.state.strainEnergy; }},
    {"contact_energy", [](const HistoryRow& r) { return r.state.contactEnergy; }},
    {"external_work", [](const HistoryRow& r) { return r.state.externalWork; }},
    {"plastic_work", [](const HistoryRow& r) { return r.state.plasticWork; }},
    {"max_plastic_strain", [](const HistoryRow& r) { return r.state.maxPlasticStrain; }},
    {"max_plastic_strain_projected", [](const HistoryRow& r) { return r.state.projectedPlasticStrain.max; }},
    {"min_plastic_strain_projected", [](const HistoryRow& r) { return r.state.projectedPlasticStrain.min; }},
    {"active_control_points",
     [](const HistoryRow& r) { return static_cast<double>(r.state.activeControlPoints); }},
    {"max_penetration", [](const HistoryRow& r) { return r.state.maxPenetration; }},
    {"min_detJ", [](const HistoryRow& r) { return r.state.minJ; }},
    {"newton_iterations", [](const HistoryRow& r) { return static_cast<double>(r.newtonIterations); }},
};

constexpr Row kSelfContact[] = {
    {"self_active_control_points",
     [](const HistoryRow& r) { return static_cast<double>(r.state.selfActiveControlPoints); }},
    {"max_self_penetration", [](const HistoryRow& r) { return r.state.maxSelfPenetration; }},
    {"self_contact_force", [](const HistoryRow& r) { return r.state.selfForce; }},
};

/// Of faces that rub on themselves.
constexpr Row kSelfFriction[] = {
    {"self_contact.friction", [](const HistoryRow& r) { return r.state.selfTouch.friction; }},
    {"self_contact.sticking",
     [](const HistoryRow& r) { return static_cast<double>(r.state.selfTouch.sticking); }},
    {"self_contact.slipping",
     [](const HistoryRow& r) { return static_cast<double>(r.state.selfTouch.slipping); }},
    {"self_contact.friction_work", [](const HistoryRow& r) { return r.state.selfTouch.frictionWork; }},
};

constexpr Row kFriction[] = {
    {"friction_work", [](const HistoryRow& r) { return r.state.frictionWork(); }},
};

constexpr Row kRezoning[] = {
    {"rezonings", [](const HistoryRow& r) { return static_cast<double>(r.state.rezonings.count); }},
    {"rezoning_energy_lost", [](const HistoryRow& r) { return r.state.rezonings.energyLost; }},
    {"rezoning_gap_work", [](const HistoryRow& r) { return r.state.rezonings.gapWork; }},
    {"rezoning_volume_drift", [](const HistoryRow& r) { return r.state.rezonings.volumeDrift; }},
    {"rezoning_boundary_error", [](const HistoryRow& r) { return r.state.rezonings.boundaryError; }},
    {"crosses_itself", [](const HistoryRow& r) { return r.state.crossesItself ? 1.0 : 0.0; }},
};

/// Which bodies have a column of a tool.
enum class Where { Everywhere, InSpace, NotInAxisymmetry };

struct ToolRow {
  const char* suffix;
  Where where;
  double (*value)(const StateQuantities& state, std::size_t tool);
};

using State = const StateQuantities&;

constexpr ToolRow kTool[] = {
    {".ux", Where::Everywhere, [](State s, std::size_t k) { return s.toolPoses[k].displacement(0); }},
    {".uy", Where::Everywhere, [](State s, std::size_t k) { return s.toolPoses[k].displacement(1); }},
    {".uz", Where::InSpace, [](State s, std::size_t k) { return s.toolPoses[k].displacement(2); }},
    {".fx", Where::Everywhere, [](State s, std::size_t k) { return s.toolForces[k](0); }},
    {".fy", Where::Everywhere, [](State s, std::size_t k) { return s.toolForces[k](1); }},
    {".fz", Where::InSpace, [](State s, std::size_t k) { return s.toolForces[k](2); }},
    {".mx", Where::InSpace, [](State s, std::size_t k) { return s.toolMoments[k](0); }},
    {".my", Where::InSpace, [](State s, std::size_t k) { return s.toolMoments[k](1); }},
    {".mz", Where::NotInAxisymmetry, [](State s, std::size_t k) { return s.toolMoments[k](2); }},
    {".angle", Where::NotInAxisymmetry,
     [](State s, std::size_t k) { return s.toolPoses[k].angle * 180.0 / std::numbers::pi; }},
};

/// Of tools that a pair touches with the integral method.
constexpr ToolRow kArea[] = {
    {".contact_area", Where::Everywhere, [](State s, std::size_t k) { return s.toolTouches[k].area; }},
};

/// Of tools that rub.
constexpr ToolRow kToolFriction[] = {
    {".friction", Where::Everywhere, [](State s, std::size_t k) { return s.toolTouches[k].friction; }},
    {".sticking", Where::Everywhere,
     [](State s, std::size_t k) { return static_cast<double>(s.toolTouches[k].sticking); }},
    {".slipping", Where::Everywhere,
     [](State s, std::size_t k) { return static_cast<double>(s.toolTouches[k].slipping); }},
    {".friction_work", Where::Everywhere,
     [](State s, std::size_t k) { return s.toolTouches[k].frictionWork; }},
};

struct PairRow {
  const char* suffix;
  bool inSpace, ofFriction;
  double (*value)(const PairTouch& pair);
};

constexpr PairRow kPair[] = {
    {".fx", false, false, [](const PairTouch& p) { return p.force(0); }},
    {".fy", false, false, [](const PairTouch& p) { return p.force(1); }},
    {".fz", true, false, [](const PairTouch& p) { return p.force(2); }},
    {".pressed", false, false, [](const PairTouch& p) { return p.pressed; }},
    {".active", false, false, [](const PairTouch& p) { return static_cast<double>(p.active); }},
    {".penetration", false, false, [](const PairTouch& p) { return p.penetration; }},
    {".friction", false, true, [](const PairTouch& p) { return p.friction; }},
    {".sticking", false, true, [](const PairTouch& p) { return static_cast<double>(p.sticking); }},
    {".slipping", false, true, [](const PairTouch& p) { return static_cast<double>(p.slipping); }},
    {".friction_work", false, true, [](const PairTouch& p) { return p.frictionWork; }},
};

/// Columns of a pair of faces.
void addPair(std::vector<HistoryColumn>& columns, const std::string& name, std::size_t pair, bool inSpace,
             bool rubs) {
  for (const PairRow& row : kPair) {
    if ((row.inSpace && !inSpace) || (row.ofFriction && !rubs)) continue;
    columns.push_back({name + row.suffix, [pair, value = row.value](const HistoryRow& r) {
                         return value(r.state.pairs[pair]);
                       }});
  }
}

struct BodyRow {
  const char* suffix;
  double BodyQuantities::*value;
};

constexpr BodyRow kEachBody[] = {{".strain_energy", &BodyQuantities::strainEnergy},
                                 {".plastic_work", &BodyQuantities::plasticWork},
                                 {".max_plastic_strain", &BodyQuantities::maxPlasticStrain},
                                 {".min_detJ", &BodyQuantities::minJ}};

/// Columns of each of several bodies.
void addBody(std::vector<HistoryColumn>& columns, const std::string& name, std::size_t body) {
  for (const BodyRow& row : kEachBody)
    columns.push_back({name + row.suffix, [body, value = row.value](const HistoryRow& r) {
                         return r.state.bodies[body].*value;
                       }});
}

template <std::size_t Count>
void add(std::vector<HistoryColumn>& columns, const Row (&rows)[Count]) {
  for (const Row& row : rows) columns.push_back({row.name, row.value});
}

template <std::size_t Count>
void addTool(std::vector<HistoryColumn>& columns, const ToolRow (&rows)[Count], const std::string& name,
             std::size_t tool, bool inSpace, bool axisymmetric) {
  for (const ToolRow& row : rows) {
    if (row.where == Where::InSpace && !inSpace) continue;
    if (row.where == Where::NotInAxisymmetry && axisymmetric) continue;
    columns.push_back(
        {name + row.suffix, [tool, value = row.value](const HistoryRow& r) { return value(r.state, tool); }});
  }
}

void addList(std::vector<HistoryColumn>& columns, const std::vector<std::string>& names,
             std::vector<double> StateQuantities::*values) {
  for (std::size_t k = 0; k < names.size(); ++k)
    columns.push_back({names[k], [k, values](const HistoryRow& r) { return (r.state.*values)[k]; }});
}

/// Whether a pair of a tool is one of those that are meant.
template <int Dim, class IsMeant>
bool hasPair(const Model<Dim>& model, std::size_t tool, const IsMeant& isMeant) {
  return std::any_of(model.contacts().begin(), model.contacts().end(), [&](const ContactPair<Dim>& pair) {
    return pair.tool == tool && isMeant(pair.term->options());
  });
}

bool isIntegral(const ContactOptions& options) {
  return options.method == Enforcement::IntegralAugmentedLagrangian;
}

bool rubs(const ContactOptions& options) {
  return options.hasFriction();
}

}  // namespace

template <int Dim>
std::vector<HistoryColumn> historyColumns(const Scene& scene, const Model<Dim>& model,
                                          const std::vector<std::string>& reactions,
                                          const std::vector<std::string>& measures) {
  std::vector<HistoryColumn> columns;
  add(columns, kStep);
  bool anyRubs = false;
  for (std::size_t k = 0; k < model.tools().size(); ++k) {
    const auto addRows = [&](const auto& rows) {
      addTool(columns, rows, model.tools()[k]->name, k, Dim == 3, model.body().axisymmetric);
    };
    addRows(kTool);
    if (hasPair(model, k, isIntegral)) addRows(kArea);
    if (!hasPair(model, k, rubs)) continue;
    addRows(kToolFriction);
    anyRubs = true;
  }
  for (std::size_t k = 0; k < model.pairs().size(); ++k) {
    const FacePair<Dim>& pair = model.pairs()[k];
    addPair(columns, pair.name, k, Dim == 3, pair.term->options().hasFriction());
    anyRubs = anyRubs || pair.term->options().hasFriction();
  }
  const bool selfRubs = std::any_of(model.selfContacts().begin(), model.selfContacts().end(),
                                    [](const auto& contact) { return rubs(contact.term->options()); });
  add(columns, kBody);
  if (anyRubs || selfRubs) add(columns, kFriction);
  if (model.bodies().size() > 1)
    for (std::size_t k = 0; k < model.bodies().size(); ++k) addBody(columns, model.bodies()[k].name, k);
  if (!model.selfContacts().empty()) add(columns, kSelfContact);
  if (selfRubs) add(columns, kSelfFriction);
  if (scene.rezoning) add(columns, kRezoning);
  if (scene.output.reactions) addList(columns, reactions, &StateQuantities::reactions);
  addList(columns, measures, &StateQuantities::measured);
  return columns;
}

template std::vector<HistoryColumn> historyColumns(const Scene&, const Model<2>&,
                                                   const std::vector<std::string>&,
                                                   const std::vector<std::string>&);
template std::vector<HistoryColumn> historyColumns(const Scene&, const Model<3>&,
                                                   const std::vector<std::string>&,
                                                   const std::vector<std::string>&);

}  // namespace burnish
