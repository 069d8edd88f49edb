#pragma once
#include <algorithm>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "engine/material/chaboche.h"
#include "engine/material/hyperelastic.h"
#include "engine/material/j2_plasticity.h"
#include "engine/material/law_list.h"
#include "engine/material/neo_hookean.h"
#include "engine/material/state_field.h"

/// Material laws. Every law has
///   kind                              its name in scenes, and a sentence,
///   Parameters, describe              what a scene says, and how; the law is made from them,
///   youngsModulus(), shearModulus(), poissonsRatio()   of small strains,
///   State, forEachMember              what a point has been through, and its members, to be saved,
///   evaluate<Dim>(F, old, next, out)  stress, tangent and energy, and the state that follows,
///   elasticDeformation(F, state)      b_e, whose stretches a new reference configuration keeps.
/// It may have
///   evaluate<Dim>(F, dt, old, next, out)  instead, if it depends on rates: dt is the length of the step,
///   fields()                          what of a state results and pictures show,
///   carried(), begin(stretch)         numbers of a state that go along to a new mesh, and how it begins there,
///   toSpace(F, state), fromSpace(state)   if these numbers are referred to axes that turn: the state with them in
///                                     those of space at F, and back,
///   hasSymmetricTangent()             if the tangent need not be symmetric,
///   yieldStress(e_p)                  if the material flows,
///   check(parameters, problems)       of what the rules of the keys do not say,
///   checkInPlane(parameters, problems)   the same of bodies in the plane.
/// Everything else follows from this list.
namespace burnish::inline material {

/// All material laws, one line each.
using MaterialLaws = LawList<    //
    NeoHookean,                  //
    J2Plasticity,                //
    Chaboche,                    //
    Hyperelastic<MooneyRivlin>,  //
    Hyperelastic<Yeoh>,          //
    Hyperelastic<Ogden>>;

using Material = MaterialLaws::Any;
using MaterialParameters = MaterialLaws::Parameters;

template <class Visitor>
void describe(Visitor& v, MaterialParameters& s) {
  MaterialLaws::describe(v, s, "Kind of material.");
}

/// Laws whose stress depends on the time that a step takes.
template <class Law>
concept RateDependent = requires(const Law& law, typename Law::State& state, MaterialResponse<2>& out) {
  law.template evaluate<2>(Eigen::Matrix3d(), 1.0, state, state, out);
};

/// Laws of materials that flow once a yield stress is reached.
template <class Law>
concept Flows = requires(const Law& law) {
  law.yieldStress(0.0);
};

/// Laws whose tangent may have no symmetry.
template <class Law>
concept MayBeUnsymmetric = requires(const Law& law) {
  law.hasSymmetricTangent();
};

/// Fields that a law makes of a state.
template <class Law>
std::vector<StateField<typename Law::State>> fieldsOf() {
  if constexpr (requires { Law::fields(); })
    return Law::fields();
  else
    return {};
}

template <class Law>
std::vector<FieldKind> fieldKindsOf() {
  const auto fields = fieldsOf<Law>();
  return {fields.begin(), fields.end()};
}

/// Numbers of a state that go along to a new mesh.
template <class Law>
std::vector<CarriedNumber<typename Law::State>> carriedOf() {
  if constexpr (requires { Law::carried(); })
    return Law::carried();
  else
    return {};
}

inline double youngsModulus(const Material& material) {
  return std::visit([](const auto& law) { return law.youngsModulus(); }, material);
}

inline double shearModulus(const Material& material) {
  return std::visit([](const auto& law) { return law.shearModulus(); }, material);
}

inline double poissonsRatio(const Material& material) {
  return std::visit([](const auto& law) { return law.poissonsRatio(); }, material);
}

inline bool flows(const Material& material) {
  return std::visit([]<class Law>(const Law&) { return Flows<Law>; }, material);
}

/// Numbers of the law's states that go along to a new mesh.
std::vector<CarriedKind> carriedKinds(const MaterialParameters& material);

/// Fields of all laws, each once.
std::vector<FieldKind> materialFields();

/// Names that pictures and measures may ask for: of all fields, of the scalars among them, and of scalars and
/// components.
std::vector<std::string> materialFieldNames();
std::vector<std::string> materialScalarNames();
std::vector<std::string> materialComponentNames();

/// Why a material has not the field, or component, of another law; empty if it has it, or no law has.
std::string whyWithout(const MaterialParameters& material, const std::string& field);

/// Reports what keeps the law from being made or, of a body in the plane, what would take it out of it.
void checkMaterial(const MaterialParameters& material, const Problems& problems, bool isInThePlane);

}  // namespace burnish::inline material
