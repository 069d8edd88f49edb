#pragma once
#include <string>
#include <utility>
#include <vector>

#include "engine/results/history.h"
#include "engine/results/run_account.h"

/// The account of a run in words: what the command prints, reports and tables show.
namespace burnish {

/// Names and what there is to say of them.
using AccountLines = std::vector<std::pair<std::string, std::string>>;

/// How a run went, in some ten lines. history: of the run; what its last row does not have is left out.
AccountLines accountLines(const RunAccount& account, const HistoryTable& history);

/// A sentence, without a full stop, for everything that makes the results doubtful.
std::vector<std::string> warningsOf(const RunAccount& account);

/// "what: first at t = 0.5, in 12.0 % of the steps": how often something was doubtful in a run of so many
/// steps.
std::string doubtText(const std::string& what, double firstTime, double doubtfulSteps, int steps);

/// "tool 'disc' has never touched the body".
std::string idleToolText(const std::string& tool);

/// "force of the body on face bottom: (0, -3.57), largest 3.57 at t = 1"; components that are rounding errors
/// of the largest are shown as 0.
std::string reactionText(const ReactionRecord& reaction);

/// Seconds by part of the program; the last row is everything else.
std::vector<std::pair<std::string, double>> timingsTable(const RunAccount& account);

}  // namespace burnish
