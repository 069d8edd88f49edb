#include "cli/help_format.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>

#include "cli/broken_lines.h"
#include "cli/command_tree.h"

namespace burnish {
namespace {

/// A text that may have line breaks of its own, which do not count.
std::string filled(std::string text, std::size_t columns) {
  std::ranges::replace(text, '\n', ' ');
  return brokenLine(text, 0, columns) + "\n";
}

class HelpFormat : public CLI::Formatter {
 public:
  HelpFormat() : columns_(lineColumns()) {
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
    return filled(command->get_description(), columns_);
  }

  std::string make_footer(const CLI::App* command) const override {
    const std::string text = command->get_footer();
    return text.empty() ? "" : filled(text, columns_);
  }

 private:
  std::string entry(const std::string& name, const std::string& meaning) const {
    const std::size_t indent = get_column_width();
    const std::string left = "  " + name;
    const bool fits = left.size() < indent;  // beside what it means, else above
    const std::string gap(fits ? indent - left.size() : indent, ' ');
    return (fits ? "" : left + "\n") + brokenLine((fits ? left : "") + gap + meaning, indent, columns_) +
           "\n";
  }

  std::size_t columns_;
};

}  // namespace

std::shared_ptr<CLI::FormatterBase> helpFormat() {
  return std::make_shared<HelpFormat>();
}

}  // namespace burnish
