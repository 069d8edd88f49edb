#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace burnish::inline schema {

/// What a value of a scene may be, beside its type. For a list of numbers the range holds for every entry.
struct Rule {
  bool required = false;
  std::string unless{};  ///< key of the same mapping that may stand in place of this one, if that is required
  std::optional<double> above{}, atLeast{};  ///< lower bound, exclusive or inclusive
  std::optional<double> below{}, atMost{};   ///< upper bound, exclusive or inclusive
  bool increasing = false;                   ///< a list of numbers, each greater than the one before
  bool perDimension = false;                 ///< a list with one entry per dimension of the scene
  std::size_t minEntries = 0;                ///< of a list
  std::size_t maxEntries = 0;                ///< of a list; any number when 0
  std::vector<std::string> choices{};        ///< the texts that are allowed; any when empty
  bool identifier = false;                   ///< a text of letters, digits, '-' and '_'
  std::string unit{};       ///< "stress", "length", ...; consistent units are the user's affair
  std::size_t longest = 0;  ///< most letters of a text; any number when 0, of an identifier `kLongestName`

  bool admits(double value) const;
  bool admits(const std::string& value) const;

  bool admitsEntries(std::size_t entries) const;

  /// Most letters of a text; 0: any number.
  std::size_t mostLetters() const;

  /// The rule for one entry of a list: the range holds for it, the length of the list does not.
  Rule ofEntry() const;

  /// " above 0 and at most 1", with a leading blank; empty without bounds.
  std::string range() const;

  /// "2 or more ", with a trailing blank; empty for lists of any length.
  std::string entries() const;
};

/// Names and sentences of the alternatives of a variant, in its order.
struct Alternative {
  std::string name;
  std::string sentence;
};

}  // namespace burnish::inline schema
