#include "engine/analysis/history_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <numbers>
#include <span>

namespace burnish::inline analysis {
namespace {

/// Words in which {} stands for the name of a tool, pair or body.
struct ColumnWords {
  const char* words;
  Measured measured;
};

using enum Measured;

struct Row {
  const char* name;
  ColumnWords meaning;
  double (*value)(const HistoryRow& row);
};

constexpr Row kStep[] = {
    {"step", {"Step", Number}, [](const HistoryRow& r) { return static_cast<double>(r.step); }},
    {"time", {"Time", Number}, [](const HistoryRow& r) { return r.state.time; }},
};

constexpr Row kBody[] = {
    {"strain_energy", {"Strain energy", Energy}, [](const HistoryRow& r) { return r.state.strainEnergy; }},
    {"contact_energy", {"Contact energy", Energy}, [](const HistoryRow& r) { return r.state.contactEnergy; }},
    {"external_work",
     {"Work of supports, tools and loads", Energy},
     [](const HistoryRow& r) { return r.state.externalWork; }},
    {"plastic_work", {"Plastic work", Energy}, [](const HistoryRow& r) { return r.state.plasticWork; }},
    {"max_plastic_strain",
     {"Largest plastic strain", Number},
     [](const HistoryRow& r) { return r.state.maxPlasticStrain; }},
    {"max_plastic_strain_projected",
     {"Largest projected plastic strain", Number},
     [](const HistoryRow& r) { return r.state.projectedPlasticStrain.max; }},
    {"min_plastic_strain_projected",
     {"Smallest projected plastic strain", Number},
     [](const HistoryRow& r) { return r.state.projectedPlasticStrain.min; }},
    {"active_control_points",
     {"Active control points", Number},
     [](const HistoryRow& r) { return static_cast<double>(r.state.activeControlPoints); }},
    {"max_penetration",
     {"Largest penetration", Length},
     [](const HistoryRow& r) { return r.state.maxPenetration; }},
    {"min_detJ", {"Smallest volume ratio J", Number}, [](const HistoryRow& r) { return r.state.minJ; }},
    {"newton_iterations",
     {"Newton iterations", Number},
     [](const HistoryRow& r) { return static_cast<double>(r.newtonIterations); }},
};

constexpr Row kSelfContact[] = {
    {"self_active_control_points",
     {"Active control points of self-contact", Number},
     [](const HistoryRow& r) { return static_cast<double>(r.state.selfActiveControlPoints); }},
    {"max_self_penetration",
     {"Largest penetration of self-contact", Length},
     [](const HistoryRow& r) { return r.state.maxSelfPenetration; }},
    {"self_contact_force",
     {"Force of self-contact", Force},
     [](const HistoryRow& r) { return r.state.selfForce; }},
};

/// Of faces that rub on themselves.
constexpr Row kSelfFriction[] = {
    {"self_contact.friction",
     {"Friction of self-contact", Force},
     [](const HistoryRow& r) { return r.state.selfTouch.friction; }},
    {"self_contact.sticking",
     {"Sticking points of self-contact", Number},
     [](const HistoryRow& r) { return static_cast<double>(r.state.selfTouch.sticking); }},
    {"self_contact.slipping",
     {"Slipping points of self-contact", Number},
     [](const HistoryRow& r) { return static_cast<double>(r.state.selfTouch.slipping); }},
    {"self_contact.friction_work",
     {"Work of friction of self-contact", Energy},
     [](const HistoryRow& r) { return r.state.selfTouch.frictionWork; }},
};

constexpr Row kFriction[] = {
    {"friction_work",
     {"Work of friction", Energy},
     [](const HistoryRow& r) { return r.state.frictionWork(); }},
};

constexpr Row kRezoning[] = {
    {"rezonings",
     {"Remeshings", Number},
     [](const HistoryRow& r) { return static_cast<double>(r.state.rezonings.count); }},
    {"rezoning_energy_lost",
     {"Energy lost in remeshing", Energy},
     [](const HistoryRow& r) { return r.state.rezonings.energyLost; }},
    {"rezoning_gap_work",
     {"Work of gaps in remeshing", Energy},
     [](const HistoryRow& r) { return r.state.rezonings.gapWork; }},
    {"rezoning_volume_drift",
     {"Drift of the volume in remeshing", Number},
     [](const HistoryRow& r) { return r.state.rezonings.volumeDrift; }},
    {"rezoning_boundary_error",
     {"Error of the boundary in remeshing", Length},
     [](const HistoryRow& r) { return r.state.rezonings.boundaryError; }},
    {"crosses_itself",
     {"Whether the boundary crosses itself", Number},
     [](const HistoryRow& r) { return r.state.crossesItself ? 1.0 : 0.0; }},
};

/// Which bodies have a column of a tool.
enum class Where { Everywhere, InSpace, NotInAxisymmetry };

struct ToolRow {
  const char* suffix;
  ColumnWords meaning;
  Where where;
  double (*value)(const StateQuantities& state, std::size_t tool);
};

using State = const StateQuantities&;

double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

constexpr ToolRow kTool[] = {
    {".ux",
     {"Displacement of {} in x", Length},
     Where::Everywhere,
     [](State s, std::size_t k) { return s.toolPoses[k].displacement(0); }},
    {".uy",
     {"Displacement of {} in y", Length},
     Where::Everywhere,
     [](State s, std::size_t k) { return s.toolPoses[k].displacement(1); }},
    {".uz",
     {"Displacement of {} in z", Length},
     Where::InSpace,
     [](State s, std::size_t k) { return s.toolPoses[k].displacement(2); }},
    {".fx",
     {"Force on {} in x", Force},
     Where::Everywhere,
     [](State s, std::size_t k) { return s.toolForces[k](0); }},
    {".fy",
     {"Force on {} in y", Force},
     Where::Everywhere,
     [](State s, std::size_t k) { return s.toolForces[k](1); }},
    {".fz",
     {"Force on {} in z", Force},
     Where::InSpace,
     [](State s, std::size_t k) { return s.toolForces[k](2); }},
    {".mx",
     {"Moment on {} about x", Moment},
     Where::InSpace,
     [](State s, std::size_t k) { return s.toolMoments[k](0); }},
    {".my",
     {"Moment on {} about y", Moment},
     Where::InSpace,
     [](State s, std::size_t k) { return s.toolMoments[k](1); }},
    {".mz",
     {"Moment on {} about z", Moment},
     Where::NotInAxisymmetry,
     [](State s, std::size_t k) { return s.toolMoments[k](2); }},
    {".angle",
     {"Turn of {}", Degrees},
     Where::NotInAxisymmetry,
     [](State s, std::size_t k) { return degrees(s.toolPoses[k].angle); }},
};

/// Of balls that spin.
constexpr ToolRow kSpinning[] = {
    {".angle_x",
     {"Turn of {} about x, added up", Degrees},
     Where::InSpace,
     [](State s, std::size_t k) { return degrees(s.toolPoses[k].spin(0)); }},
    {".angle_y",
     {"Turn of {} about y, added up", Degrees},
     Where::InSpace,
     [](State s, std::size_t k) { return degrees(s.toolPoses[k].spin(1)); }},
    {".angle_z",
     {"Turn of {} about z, added up", Degrees},
     Where::InSpace,
     [](State s, std::size_t k) { return degrees(s.toolPoses[k].spin(2)); }},
};

/// Of tools that follow a surface.
constexpr ToolRow kFollowing[] = {
    {".un",
     {"Way of {} along the normal", Length},
     Where::Everywhere,
     [](State s, std::size_t k) { return s.toolPoses[k].alongNormal; }},
    {".fn",
     {"Force on {} along the normal", Force},
     Where::Everywhere,
     [](State s, std::size_t k) { return s.toolForces[k].dot(s.toolPoses[k].normal); }},
};

/// Of tools that a pair touches with the integral method.
constexpr ToolRow kArea[] = {
    {".contact_area",
     {"Contact area of {}", Area},
     Where::Everywhere,
     [](State s, std::size_t k) { return s.toolTouches[k].area; }},
};

/// Of tools that rub.
constexpr ToolRow kToolFriction[] = {
    {".friction",
     {"Friction on {}", Force},
     Where::Everywhere,
     [](State s, std::size_t k) { return s.toolTouches[k].friction; }},
    {".sticking",
     {"Sticking points of {}", Number},
     Where::Everywhere,
     [](State s, std::size_t k) { return static_cast<double>(s.toolTouches[k].sticking); }},
    {".slipping",
     {"Slipping points of {}", Number},
     Where::Everywhere,
     [](State s, std::size_t k) { return static_cast<double>(s.toolTouches[k].slipping); }},
    {".friction_work",
     {"Work of friction on {}", Energy},
     Where::Everywhere,
     [](State s, std::size_t k) { return s.toolTouches[k].frictionWork; }},
};

struct PairRow {
  const char* suffix;
  ColumnWords meaning;
  bool inSpace, ofFriction;
  double (*value)(const PairTouch& pair);
};

constexpr PairRow kPair[] = {
    {".fx", {"Force at {} in x", Force}, false, false, [](const PairTouch& p) { return p.force(0); }},
    {".fy", {"Force at {} in y", Force}, false, false, [](const PairTouch& p) { return p.force(1); }},
    {".fz", {"Force at {} in z", Force}, true, false, [](const PairTouch& p) { return p.force(2); }},
    {".pressed", {"Contact force of {}", Force}, false, false, [](const PairTouch& p) { return p.pressed; }},
    {".active",
     {"Active control points of {}", Number},
     false,
     false,
     [](const PairTouch& p) { return static_cast<double>(p.active); }},
    {".penetration",
     {"Largest penetration of {}", Length},
     false,
     false,
     [](const PairTouch& p) { return p.penetration; }},
    {".friction", {"Friction of {}", Force}, false, true, [](const PairTouch& p) { return p.friction; }},
    {".sticking",
     {"Sticking points of {}", Number},
     false,
     true,
     [](const PairTouch& p) { return static_cast<double>(p.sticking); }},
    {".slipping",
     {"Slipping points of {}", Number},
     false,
     true,
     [](const PairTouch& p) { return static_cast<double>(p.slipping); }},
    {".friction_work",
     {"Work of friction of {}", Energy},
     false,
     true,
     [](const PairTouch& p) { return p.frictionWork; }},
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
  ColumnWords meaning;
  double BodyQuantities::*value;
};

constexpr BodyRow kEachBody[] = {
    {".strain_energy", {"Strain energy of {}", Energy}, &BodyQuantities::strainEnergy},
    {".plastic_work", {"Plastic work in {}", Energy}, &BodyQuantities::plasticWork},
    {".max_plastic_strain", {"Largest plastic strain of {}", Number}, &BodyQuantities::maxPlasticStrain},
    {".min_detJ", {"Smallest volume ratio J of {}", Number}, &BodyQuantities::minJ}};

/// Columns of each of several bodies.
void addBody(std::vector<HistoryColumn>& columns, const std::string& name, std::size_t body) {
  for (const BodyRow& row : kEachBody)
    columns.push_back({name + row.suffix, [body, value = row.value](const HistoryRow& r) {
                         return r.state.bodies[body].*value;
                       }});
}

/// What a column of a tool, pair or body means, by the rows with its suffix.
template <class Row>
std::optional<ColumnMeaning> ownersMeaning(const std::string& column, const std::string& owner,
                                           std::initializer_list<std::span<const Row>> lists) {
  for (const std::span<const Row> rows : lists)
    for (const Row& row : rows)
      if (column == owner + row.suffix)
        return ColumnMeaning{fmt::format(fmt::runtime(row.meaning.words), owner), row.meaning.measured};
  return std::nullopt;
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
    if (model.tools()[k]->spins()) addRows(kSpinning);
    if (model.tools()[k]->followsSurface()) addRows(kFollowing);
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

std::optional<ColumnMeaning> columnMeaning(const std::string& column, const std::vector<std::string>& columns,
                                           const std::optional<std::vector<std::string>>& tools) {
  for (const std::span<const Row> rows :
       std::array<std::span<const Row>, 6>{kStep, kBody, kSelfContact, kSelfFriction, kFriction, kRezoning})
    for (const Row& row : rows)
      if (column == row.name) return ColumnMeaning{row.meaning.words, row.meaning.measured};
  const std::size_t dot = column.rfind('.');
  if (dot == std::string::npos) return std::nullopt;
  const std::string owner = column.substr(0, dot);
  const auto has = [&](const char* suffix) {
    return std::find(columns.begin(), columns.end(), owner + suffix) != columns.end();
  };
  const bool isTool =
      tools ? std::find(tools->begin(), tools->end(), owner) != tools->end() : has(".ux") && has(".fx");
  if (isTool)
    return ownersMeaning<ToolRow>(column, owner, {kTool, kSpinning, kFollowing, kArea, kToolFriction});
  if (has(".pressed")) return ownersMeaning<PairRow>(column, owner, {kPair});
  if (has(".min_detJ")) return ownersMeaning<BodyRow>(column, owner, {kEachBody});
  return std::nullopt;
}

template std::vector<HistoryColumn> historyColumns(const Scene&, const Model<2>&,
                                                   const std::vector<std::string>&,
                                                   const std::vector<std::string>&);
template std::vector<HistoryColumn> historyColumns(const Scene&, const Model<3>&,
                                                   const std::vector<std::string>&,
                                                   const std::vector<std::string>&);

}  // namespace burnish::inline analysis
