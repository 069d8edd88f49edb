#pragma once
#include <string>
#include <vector>

namespace CLI {
class Option;
}

namespace burnish {

/// Notes words that completion proposes as values of an option; what the option allows is not changed.
void offerWords(CLI::Option& option, const std::vector<std::string>& words);

/// The first words of pairs, as `chosen` has them.
template <class Choices>
void offerChoices(CLI::Option& option, const Choices& choices) {
  std::vector<std::string> words;
  for (const auto& [word, value] : choices) words.emplace_back(word);
  offerWords(option, words);
}

/// What was noted, in its order.
std::vector<std::string> offeredWords(const CLI::Option& option);

}  // namespace burnish
