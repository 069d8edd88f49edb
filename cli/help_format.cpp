#include "cli/help_format.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <sstream>
#include <string>

#include "cli/command_tree.h"
#include "cli/console.h"

namespace burnish {
namespace {

/// Words one after the other, the lines behind the first one indented. begun: letters that stand on the first line already.
std::string filled(const std::string& text, std::size_t begun, std::size_t indent, std::size_t columns) {
  std::istringstream words(text);
  std::string lines;
  std::size_t column = begun;
  bool isFirst = true;
  for (std::string word; words >> word; isFirst = false) {
    if (!isFirst && column + 1 + word.size() > columns) {
      lines += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!isFirst) {
      lines += ' ';
      ++column;
    }
    lines += word;
    column += word.size();
  }
  return lines;
}

class HelpFormat : public CLI::Formatter {
 public:
  HelpFormat()
      : columns_(::isatty(STDOUT_FILENO) != 0 ? std::max<std::size_t>(terminalColumns(), 40)
                                              : std::numeric_limits<std::size_t>::max()) {
    if (columns_ < 80) column_width(columns_ / 4);
  }

  std::string make_option(const CLI::Option* option, bool isPositional) const override {
    std::string name;
    if (isPositional) {
      name = option->get_name(true);
    } else {
      for (const std::string& letter : option->get_snames()) name += ",-" + letter;
      for (const std::string& word : option->get_lnames()) name += ",--" + word;
      name.erase(0, 1);
    }
    if (const std::string value = valueWord(*option); !value.empty()) name += " " + value;
    if (option->get_items_expected_max() > 1) name += " ...";
    if (option->get_required() && !isPositional) name += " " + get_label("REQUIRED");
    return entry(name, meaningOf(*option));
  }

  std::string make_subcommand(const CLI::App* command) const override {
    return entry(command->get_name(), command->get_description());
  }

  std::string make_description(const CLI::App* command) const override {
    return filled(command->get_description(), 0, 0, columns_) + "\n";
  }

  std::string make_footer(const CLI::App* command) const override {
    const std::string text = command->get_footer();
    return text.empty() ? "" : filled(text, 0, 0, columns_) + "\n";
  }

 private:
  std::string entry(const std::string& name, const std::string& meaning) const {
    const std::size_t indent = get_column_width();
    std::string line = "  " + name;
    if (line.size() < indent)
      line.resize(indent, ' ');
    else
      line += "\n" + std::string(indent, ' ');
    return line + filled(meaning, indent, indent, columns_) + "\n";
  }

  std::size_t columns_;
};

}  // namespace

std::shared_ptr<CLI::FormatterBase> helpFormat() {
  return std::make_shared<HelpFormat>();
}

}  // namespace burnish
