#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "postproc/text/roff.h"
#include "tests/cli/shell_test.h"

/// Help and manual pages. BURNISH_COMMAND is the program.
namespace burnish {
namespace {

namespace fs = std::filesystem;

using testing::HasSubstr;
using testing::Not;

class HelpCommand : public ShellTest {
 protected:
  Outcome burnish(const std::string& arguments) const { return shell(dir, BURNISH_COMMAND " " + arguments); }

  /// Every command that help lists.
  std::vector<std::string> commands() const {
    std::istringstream help(burnish("--help").out);
    std::vector<std::string> names;
    bool isList = false;
    for (std::string line; std::getline(help, line);) {
      if (isList && line.starts_with("  ") && line[2] != ' ')
        names.push_back(line.substr(2, line.find(' ', 2) - 2));
      isList = isList || line == "Subcommands:";
    }
    return names;
  }

  /// A page as it is read in a terminal that is wide enough for every line.
  std::string shownPage(const std::string& file) const {
    const Outcome shown =
        shell(dir, "LC_ALL=C.UTF-8 MANWIDTH=4000 MAN_KEEP_FORMATTING= man --warnings -P cat -l " + file);
    EXPECT_EQ(shown.code, 0) << file;
    EXPECT_EQ(shown.err, "") << file;
    return std::regex_replace(shown.out, std::regex(" +"), " ");  // sentences end with two
  }
};

TEST_F(HelpCommand, PrintsWhatTheOptionPrints) {
  EXPECT_EQ(burnish("help").out, burnish("--help").out);
  ASSERT_GE(commands().size(), 17u);
  for (const std::string& command : commands())
    EXPECT_EQ(burnish("help " + command).out, burnish(command + " --help").out) << command;
  EXPECT_THAT(burnish("help").out, Not(HasSubstr("\n  complete")));
  EXPECT_THAT(burnish("help").out, Not(HasSubstr("\n  manual")));
}

/// The words of a text, one blank between them.
std::string wordsOf(const std::string& text) {
  return std::regex_replace(text, std::regex("\\s+"), " ");
}

TEST_F(HelpCommand, EndsItsLinesWhereTheTerminalEnds) {
  std::vector<std::string> pages{"help", "explain contact.friction", "explain geometry"};
  for (const std::string& command : commands()) pages.push_back("help " + command);
  for (const std::string& command : pages) {
    const std::string wide = burnish(command).out;
    EXPECT_THAT(wide, Not(HasSubstr("{false}"))) << command << ": the parser's own marks";
    const std::string narrow =
        shell(dir, "script -qec 'stty cols 60; " BURNISH_COMMAND " " + command + "' /dev/null </dev/null")
            .out;
    EXPECT_EQ(wordsOf(narrow), wordsOf(wide)) << command;
    std::istringstream lines(narrow);
    for (std::string line; std::getline(lines, line);) {
      if (line.ends_with('\r')) line.pop_back();
      EXPECT_LE(line.size(), 60u) << command << ": " << line;
    }
  }
}

TEST_F(HelpCommand, TellsWhichOptionsGoTogether) {
  EXPECT_THAT(wordsOf(burnish("help run").out),
              HasSubstr("--resume DIR Go on with the run that was stopped in this "
                        "directory, instead of SCENE. Not with --output, --set, SCENE"));
  EXPECT_THAT(wordsOf(burnish("help figures").out), HasSubstr("--results DIR"));
  EXPECT_THAT(wordsOf(burnish("help figures").out), HasSubstr(". Only with --workflow"));
  EXPECT_THAT(wordsOf(burnish("help export").out), HasSubstr("[1]; from 1 to 100000. Not with --format"));
}

TEST_F(HelpCommand, RefusesWhatIsNoCommand) {
  expectRefusal(burnish("help rnder"), "help rnder", "there is no command rnder; expected run, render,");
  expectRefusal(burnish("help rnder"), "help rnder", "Did you mean \"render\"?");
  expectRefusal(burnish("help complete"), "help complete", "there is no command complete");
}

TEST_F(HelpCommand, ManualHasAPageForEveryCommandWithAllItsOptions) {
  ASSERT_EQ(burnish("manual man").code, 0);
  EXPECT_EQ(std::ranges::distance(fs::directory_iterator(dir / "man/man1"), fs::directory_iterator()),
            static_cast<std::ptrdiff_t>(commands().size() + 1));
  const std::string program = shownPage("man/man1/burnish.1");
  for (const std::string& command : commands()) {
    EXPECT_THAT(program, HasSubstr("burnish-" + command + "(1)"));
    const std::string page = shownPage("man/man1/burnish-" + command + ".1");
    EXPECT_THAT(page, HasSubstr("burnish-" + command + " - "));
    std::istringstream help(burnish("help " + command).out);
    for (std::string line; std::getline(help, line);)
      if (const std::size_t at = line.find("--"); at != std::string::npos && line.starts_with("  -")) {
        const std::string option = line.substr(at, line.find_first_of(" ,{", at) - at);
        EXPECT_THAT(page, HasSubstr(option)) << command;
      }
  }
}

TEST_F(HelpCommand, ManualHasEveryKeyOfScenesAndStudiesWithItsSentence) {
  ASSERT_EQ(burnish("manual man").code, 0);
  for (const auto& [page, option] : {std::pair{"scene", "--keys"}, std::pair{"study", "--study-keys"}}) {
    const std::string text = shownPage(std::string("man/man5/burnish-") + page + ".5");
    std::istringstream keys(burnish(std::string("info ") + option).out);
    int found = 0;
    for (std::string line; std::getline(keys, line);) {
      const std::size_t begin = line.find("- `"), end = line.find("`: ");
      if (begin == std::string::npos || end == std::string::npos) continue;
      EXPECT_THAT(text, HasSubstr(line.substr(begin + 3, end - begin - 3)));
      const std::string sentence = line.substr(end + 3);
      if (sentence.find_first_of("`[*\\") == std::string::npos) {
        EXPECT_THAT(text, HasSubstr(sentence));
        ++found;
      }
    }
    EXPECT_GT(found, 100) << page;
  }
}

TEST_F(HelpCommand, ManualIsCleanForAnotherReader) {
  ASSERT_EQ(burnish("manual man").code, 0);
  // Without a date, so that equal programs write equal pages.
  EXPECT_EQ(shell(dir, "mandoc -Tlint man/*/* | grep -v 'missing date'").out, "");
}

TEST_F(HelpCommand, ManualIsTheSameEveryTime) {
  ASSERT_EQ(burnish("manual a").code + burnish("manual b").code, 0);
  EXPECT_EQ(shell(dir, "diff -r a b").code, 0);
  expectRefusal(burnish("manual"), "manual", "DIR is required");
}

TEST(Roff, ShowsWhatItIsGiven) {
  EXPECT_EQ(roffText("--a \\n 'x' ^~`"), "\\-\\-a \\en \\(aqx\\(aq \\(ha\\(ti\\(ga");
  EXPECT_EQ(roffText("κ → ε\U0001F600"), "\\[u03BA] \\[u2192] \\[u03B5]\\[u1F600]");
  RoffPage page("a", 1, "b", "c");
  page.paragraph(".x");
  EXPECT_THAT(std::move(page).text(), HasSubstr("\n\\&.x\n")) << "no request";
}

}  // namespace
}  // namespace burnish
