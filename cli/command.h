#pragma once
#include <functional>

namespace CLI {
class App;
}

/// The subcommands of `burnish`. Each adds itself, its options and their help to the command line; parsing
/// one sets `action`, which does the work, throws `Error` for what the user can mend, and returns the exit
/// code.
namespace burnish {

enum class ExitCode {
  Fine = 0,
  Different = 1,      ///< compare: pictures differ from their baselines, as diff and cmp have it
  ChecksFail = 1,     ///< verify: a check does not hold, or a run stopped
  BadInput = 2,       ///< a scene, study, result, file or option that cannot be used
  Stopped = 3,        ///< the run could not be brought to its end
  Incomplete = 4,     ///< runs or figures of a study failed, or pictures of a run
  Internal = 70,      ///< a fault of the program
  Interrupted = 130,  ///< by SIGINT
  Terminated = 143,   ///< by SIGTERM
};

using Action = std::function<ExitCode()>;

void addRunCommand(CLI::App& app, Action& action);
void addRenderCommand(CLI::App& app, Action& action);
void addAnimateCommand(CLI::App& app, Action& action);
void addSheetCommand(CLI::App& app, Action& action);
void addPlotCommand(CLI::App& app, Action& action);
void addProbeCommand(CLI::App& app, Action& action);
void addRoughnessCommand(CLI::App& app, Action& action);
void addIndentationCommand(CLI::App& app, Action& action);
void addFitCommand(CLI::App& app, Action& action);
void addExportCommand(CLI::App& app, Action& action);
void addInfoCommand(CLI::App& app, Action& action);
void addCompareCommand(CLI::App& app, Action& action);
void addReportCommand(CLI::App& app, Action& action);
void addViewCommand(CLI::App& app, Action& action);
void addFiguresCommand(CLI::App& app, Action& action);
void addVerifyCommand(CLI::App& app, Action& action);
void addSchemaCommand(CLI::App& app, Action& action);
void addExplainCommand(CLI::App& app, Action& action);
void addValidateCommand(CLI::App& app, Action& action);
void addWatchCommand(CLI::App& app, Action& action);
void addInitCommand(CLI::App& app, Action& action);
void addDoctorCommand(CLI::App& app, Action& action);
void addHelpCommand(CLI::App& app, Action& action);
void addManualCommand(CLI::App& app, Action& action);    ///< hidden: for the installation
void addCompleteCommand(CLI::App& app, Action& action);  ///< hidden: for the completions of shells

}  // namespace burnish
