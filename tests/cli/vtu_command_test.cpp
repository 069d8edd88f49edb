#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <string>

#include "cli/command.h"
#include "engine/core/error.h"

namespace burnish {
namespace {

/// What `burnish export` says to these options and a result that does not exist.
std::string refusalOf(const std::string& options) {
  CLI::App app;
  Action action;
  addExportCommand(app, action);
  app.parse("export no_such_result " + options);
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ExportCommand, NamesTheNearestChoice) {
  EXPECT_EQ(refusalOf("--cells bezir"),
            "--cells: found \"bezir\"; expected linear, lagrange, bezier. Did you mean \"bezier\"?");
  EXPECT_EQ(
      refusalOf("--parts body,tols"),
      "--parts: found \"tols\"; expected body, tools, contact, points, net, knots. Did you mean \"tools\"?");
}

TEST(ExportCommand, RefusesEmptyParts) {
  for (const char* options : {"--parts body,", "--parts ,body", "--parts , --control-net"})
    EXPECT_THAT(refusalOf(options), testing::StartsWith("--parts: found \"\"; expected body, ")) << options;
}

TEST(ExportCommand, TakesWhatTheHelpSays) {
  for (const char* options : {"", "--cells linear", "--cells lagrange --control-net", "--cells bezier",
                              "--parts body,tools,contact,points,net,knots", "--parts net --control-net"})
    EXPECT_THAT(refusalOf(options), testing::HasSubstr("no_such_result")) << options;
}

}  // namespace
}  // namespace burnish
