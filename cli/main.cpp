#include <CLI/CLI.hpp>
#include <csignal>
#include <sstream>
#include <string>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/fastest_program.h"
#include "cli/faults.h"
#include "cli/help_format.h"
#include "cli/late_vtk.h"
#include "cli/ranks.h"
#include "cli/usage_error.h"
#include "engine/core/blas.h"
#include "engine/core/error.h"
#include "engine/core/version.h"
#include "postproc/draw/page/picture_warnings.h"
#include "postproc/offscreen/quiet_libraries.h"

namespace {

using namespace burnish;

/// Whether a command solves equations, itself or in processes that it starts: only then is it worth the time
/// to load the program a second time.
bool computes(const std::string& command) {
  return command == "run" || command == "figures" || command == "verify";
}

ExitCode execute(int argc, char** argv) {
  CLI::App app("Elastoplastic contact of NURBS bodies with rigid tools: compute, draw, export.", "burnish");
  app.formatter(helpFormat());
  app.set_version_flag("--version", programName());
  app.require_subcommand(1);
  Action action;
  addRunCommand(app, action);
  addRenderCommand(app, action);
  addAnimateCommand(app, action);
  addSheetCommand(app, action);
  addPlotCommand(app, action);
  addProbeCommand(app, action);
  addRoughnessCommand(app, action);
  addIndentationCommand(app, action);
  addFitCommand(app, action);
  addExportCommand(app, action);
  addInfoCommand(app, action);
  addCompareCommand(app, action);
  addReportCommand(app, action);
  addViewCommand(app, action);
  addFiguresCommand(app, action);
  addVerifyCommand(app, action);
  addSchemaCommand(app, action);
  addExplainCommand(app, action);
  addValidateCommand(app, action);
  addWatchCommand(app, action);
  addInitCommand(app, action);
  addDoctorCommand(app, action);
  addHelpCommand(app, action);
  addManualCommand(app, action);
  addCompleteCommand(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {
    std::ostringstream text;  // the help or the version
    app.exit(request, text, text);
    printText(text.str());
    return ExitCode::Fine;
  } catch (const CLI::ParseError& error) {
    throw Error(usageMessage(app, error));
  }
  ExitCode code{};
  try {
    code = action();
  } catch (const Error& error) {
    throw Error(withOption(app, error.what()));
  }
  for (const std::string& warning : takeWarnings()) printError("warning: {}\n", warning);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  stopBlasThreads();
  openStandardDescriptors();
  std::set_terminate(endAtOnce);
  std::signal(SIGXFSZ, SIG_IGN);  // a file above a limit is an error with its name, not the end
  const bool computing = argc > 1 && computes(argv[1]);
  if (computing) {
    std::signal(SIGPIPE, SIG_IGN);  // whoever reads the progress may go away; the results are still wanted
    startFastest(argv);
  }
  whenVtkIsThere(silenceVtk);
  const ExitCode done = guarded([&] {
    if (computing) joinRanks(argv[1]);
    return execute(argc, argv);
  });
  const ExitCode printed = guarded([&] {
    requirePrinted(computing ? GoneReader::IsFine : GoneReader::Fails);
    return ExitCode::Fine;
  });
  return static_cast<int>(leaveRanks(done == ExitCode::Fine ? printed : done));
}
