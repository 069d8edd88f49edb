#include "cli/manual/manual_pages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <array>
#include <vector>

#include "cli/command.h"
#include "cli/command_tree.h"
#include "engine/core/version.h"
#include "postproc/scene/scene_listing.h"
#include "postproc/study/study_listing.h"
#include "postproc/text/roff.h"

namespace burnish {
namespace {

constexpr std::array<std::pair<ExitCode, const char*>, 8> kExitCodes{
    {{ExitCode::Fine, "All is done, or all checks hold."},
     {ExitCode::Different, "Pictures or data differ from their baselines; a check does not hold."},
     {ExitCode::BadInput, "A file, a place or an option cannot be used; one message says what to mend."},
     {ExitCode::Stopped, "A run stopped before its end; what it computed is kept."},
     {ExitCode::Incomplete, "Runs, figures or pictures failed; all else is there."},
     {ExitCode::Internal, "A fault of the program; please report it."},
     {ExitCode::Interrupted, "Interrupted by SIGINT, what was finished is kept."},
     {ExitCode::Terminated, "The same by SIGTERM or SIGHUP."}}};

std::string termOf(const CLI::Option& option) {
  std::vector<std::string> names;
  if (option.get_positional()) {
    names.push_back(roffItalic(option.get_name(true)));
  } else {
    for (const std::string& name : option.get_snames()) names.push_back(roffBold("-" + name));
    for (const std::string& name : option.get_lnames()) names.push_back(roffBold("--" + name));
  }
  std::string term = fmt::format("{}", fmt::join(names, ", "));
  if (const std::string value = valueWord(option); !value.empty()) term += " " + roffItalic(value);
  return term;
}

void addOptions(RoffPage& page, const CLI::App& command) {
  for (const bool isPositional : {true, false}) {
    const std::vector<const CLI::Option*> options = shownOptions(command, isPositional);
    if (!options.empty()) page.section(isPositional ? "ARGUMENTS" : "OPTIONS");
    for (const CLI::Option* option : options) page.item(termOf(*option), roffText(meaningOf(*option) + "."));
  }
}

std::string synopsisOf(const CLI::App& command) {
  std::string text = roffBold("burnish " + command.get_name());
  for (const CLI::Option* option : shownOptions(command, true)) {
    std::string name =
        roffItalic(option->get_name(true)) + (option->get_items_expected_max() > 1 ? " ..." : "");
    text += option->get_required() ? " " + name : " [" + name + "]";
  }
  for (const CLI::Option* option : shownOptions(command, false))
    if (option->get_required()) text += " " + termOf(*option);
  return text + " [" + roffItalic("OPTION") + " ...]";
}

std::string reference(const std::string& page, int section) {
  return roffBold(page) + fmt::format("({})", section);
}

std::string sourceName() {
  return "burnish " + version();
}

std::string programPage(const CLI::App& program) {
  RoffPage page("burnish", 1, sourceName(), "elastoplastic contact of NURBS bodies, and its pictures");
  page.section("SYNOPSIS");
  page.paragraph(roffBold("burnish") + " " + roffItalic("COMMAND") + " [" + roffItalic("ARGUMENT") + " ...]");
  page.section("DESCRIPTION");
  page.paragraph(roffText(program.get_description()));
  page.paragraph(roffText("A scene, a YAML file, says what is computed. These make, draw and follow one:"));
  page.example(
      "burnish init press.yaml\nburnish run press.yaml -o out/press\nburnish render out/press -o press.png");
  page.section("COMMANDS");
  for (const CLI::App* command : shownCommands(program))
    page.item(reference("burnish-" + command->get_name(), 1), roffText(command->get_description()) + ".");
  addOptions(page, program);
  page.section("EXIT STATUS");
  for (const auto& [code, meaning] : kExitCodes)
    page.item(roffBold(std::to_string(static_cast<int>(code))), roffText(meaning));
  page.section("SEE ALSO");
  page.paragraph(reference("burnish-scene", 5) + ", " + reference("burnish-study", 5));
  return std::move(page).text();
}

std::string commandPage(const CLI::App& command) {
  RoffPage page("burnish-" + command.get_name(), 1, sourceName(), command.get_description());
  page.section("SYNOPSIS");
  page.paragraph(synopsisOf(command));
  page.section("DESCRIPTION");
  page.paragraph(roffText(command.get_description()) + ".");
  if (const std::string more = command.get_footer(); !more.empty()) page.paragraph(roffText(more));
  addOptions(page, command);
  page.section("SEE ALSO");
  page.paragraph(reference("burnish", 1) + ", " + reference("burnish-scene", 5) + ", " +
                 reference("burnish-study", 5));
  return std::move(page).text();
}

std::string keysPage(const std::string& document, const std::string& description, const std::string& keys) {
  RoffPage page("burnish-" + document, 5, sourceName(), "keys of a " + document);
  page.section("DESCRIPTION");
  page.paragraph(roffText(description));
  page.section("KEYS");
  addMarkdown(page, keys);
  page.section("SEE ALSO");
  page.paragraph(reference("burnish", 1) + ", " + reference("burnish-explain", 1) + ", " +
                 reference("burnish-validate", 1));
  return std::move(page).text();
}

}  // namespace

std::map<std::string, std::string> manualPages(const CLI::App& program) {
  std::map<std::string, std::string> pages{{"man1/burnish.1", programPage(program)}};
  for (const CLI::App* command : shownCommands(program))
    pages[fmt::format("man1/burnish-{}.1", command->get_name())] = commandPage(*command);
  pages["man5/burnish-scene.5"] = keysPage(
      "scene",
      "A scene is a YAML file that says what is computed: a body or several, how they are held and moved, tools, "
      "contact and steps; and what is drawn. burnish explain tells of a single key.",
      describeScene());
  pages["man5/burnish-study.5"] = keysPage(
      "study",
      "A study is a YAML file that says which scenes are computed with which changes, what is drawn from the "
      "results, and what is stated about them. burnish figures computes and draws it.",
      describeStudy());
  return pages;
}

}  // namespace burnish
