#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <string>

#include "cli/command.h"
#include "cli/usage_error.h"
#include "engine/core/blas.h"
#include "engine/core/error.h"
#include "engine/core/version.h"
#include "postproc/draw/font.h"

namespace {

using namespace burnish;

/// Whether a command solves equations, itself or in processes that it starts: only then is it worth the time
/// to load the program a second time.
bool computes(const std::string& command) {
  return command == "run" || command == "figures" || command == "verify";
}

ExitCode execute(int argc, char** argv) {
  CLI::App app("Elastoplastic contact of NURBS bodies with rigid tools: compute, draw, export.", "burnish");
  app.set_version_flag("--version", programName());
  app.require_subcommand(1);
  Action action;
  addRunCommand(app, action);
  addRenderCommand(app, action);
  addAnimateCommand(app, action);
  addSheetCommand(app, action);
  addPlotCommand(app, action);
  addExportCommand(app, action);
  addInfoCommand(app, action);
  addCompareCommand(app, action);
  addReportCommand(app, action);
  addFiguresCommand(app, action);
  addVerifyCommand(app, action);
  addSchemaCommand(app, action);
  addExplainCommand(app, action);
  addValidateCommand(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {
    app.exit(request);  // prints the help or the version
    return ExitCode::Fine;
  } catch (const CLI::ParseError& error) {
    throw Error(usageMessage(app, error));
  }
  const ExitCode code = action();
  for (const std::string& warning : takeTextWarnings()) fmt::print(stderr, "warning: {}\n", warning);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file above a limit is an error with its name, not the end
  if (argc > 1 && computes(argv[1])) burnish::useFastestBlasKernels(argv);
  try {
    return static_cast<int>(execute(argc, argv));
  } catch (const burnish::Error& error) {
    fmt::print(stderr, "burnish: {}\n", error.what());
    return static_cast<int>(ExitCode::BadInput);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr,
               "burnish: the memory of this machine does not suffice; take fewer basis functions or a lower "
               "degree\n");
    return static_cast<int>(ExitCode::BadInput);
  } catch (const std::exception& error) {
    fmt::print(stderr, "burnish: internal error: {}; this is a fault of the program, please report it\n",
               error.what());
  }
  return static_cast<int>(ExitCode::Internal);
}
