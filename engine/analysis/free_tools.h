#pragma once
#include <cstddef>
#include <string>

#include "engine/analysis/model.h"

namespace burnish::inline analysis {

/// Key under `carry` of a free degree of freedom of a tool.
const char* carryKey(const Tool& tool, std::size_t dof);

/// Name of a tool that has to be held by what it carries to stay in touch with the body, in the state that
/// the terms have been evaluated at; empty if there is none.
template <int Dim>
std::string pulledTool(const Model<Dim>& model);

/// Name of a tool that its path keeps from carrying its force in the middle of a pass, in the same state; empty if there
/// is none.
template <int Dim>
std::string toolHeldBack(const Model<Dim>& model);

/// Key of a free degree of freedom (`tools[0].carry.x`) in which a tool has moved too far since the last
/// accepted state; empty if none has.
template <int Dim>
std::string runawayKey(const Model<Dim>& model);

}  // namespace burnish::inline analysis
