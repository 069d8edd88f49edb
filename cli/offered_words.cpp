#include "cli/offered_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <sstream>

namespace burnish {
namespace {

/// CLI11 has no room for such a note at an option but the names of its checks; this one passes everything.
constexpr const char* kOffer = "offer ";

}  // namespace

void offerWords(CLI::Option& option, const std::vector<std::string>& words) {
  option.check([](const std::string&) { return std::string(); }, "",
               fmt::format("{}{}", kOffer, fmt::join(words, " ")));
}

std::vector<std::string> offeredWords(const CLI::Option& option) {
  std::vector<std::string> words;
  auto& checked = const_cast<CLI::Option&>(option);  // get_validator changes nothing, and is not const
  try {
    for (int k = 0;; ++k) {
      const std::string name = checked.get_validator(k)->get_name();
      if (!name.starts_with(kOffer)) continue;
      std::istringstream rest(name.substr(std::string(kOffer).size()));
      for (std::string word; rest >> word;) words.push_back(word);
    }
  } catch (const CLI::OptionNotFound&) {  // there is no other way to learn how many it has
  }
  return words;
}

}  // namespace burnish
