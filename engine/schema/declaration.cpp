#include "engine/schema/declaration.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace burnish::inline schema {
namespace {

/// "a number above 0 (length), required" or "..., default 0.5".
std::string valueText(const Declaration& key) {
  std::string text = key.allowed;
  if (!key.rule.unit.empty()) text += " (" + key.rule.unit + ")";
  if (key.rule.required) text += ", required";
  if (!key.rule.unless.empty()) text += " without " + key.rule.unless;
  if (key.defaultValue) text += ", default " + *key.defaultValue;
  return text;
}

std::string slug(std::string title) {
  std::ranges::replace(title, ' ', '-');
  return title;
}

/// Keys as lists. Alternatives that stand in several places are listed once, in a section of their own behind
/// the list, to which those places link.
class Listing {
 public:
  explicit Listing(const Declarations& keys) {
    find(keys, "");
    writeLevel(keys, 0, "");
    // Sections grow while they are written: alternatives hold others.
    for (std::size_t k = 0; k < due_.size(); ++k) {
      out_ += fmt::format("\n### {}\n\n", due_[k].title);
      writeAlternatives(*due_[k].key, 0, due_[k].title);
    }
  }

  std::string text() && { return std::move(out_); }

 private:
  /// Alternatives where they stand first, by name and meaning.
  struct Place {
    std::string title;
    const Declaration* key;
    bool isShared = false;  ///< other places have some of them too
  };

  static bool areAlike(const Declarations& a, const Declarations& b) {
    return std::ranges::equal(a, b, [](const Declaration& x, const Declaration& y) {
      return x.key == y.key && valueText(x) == valueText(y) && x.sentence == y.sentence &&
             areAlike(x.below, y.below) && x.alternatives.size() == y.alternatives.size();
    });
  }

  static bool hasAllOf(const Declaration& whole, const Declaration& part) {
    return std::ranges::all_of(part.alternatives, [&](const DeclaredAlternative& wanted) {
      return std::ranges::any_of(whole.alternatives, [&](const DeclaredAlternative& held) {
        return held.about.name == wanted.about.name && held.about.sentence == wanted.about.sentence &&
               areAlike(held.keys, wanted.keys);
      });
    });
  }

  Place* placeOf(const Declaration& key) {
    const auto place = std::ranges::find_if(
        places_, [&](const Place& p) { return p.key->key == key.key && hasAllOf(*p.key, key); });
    return place == places_.end() ? nullptr : &*place;
  }

  static std::string titleOf(const std::string& above, const Declaration& key) {
    return above.empty() ? key.key : above + " " + key.key;
  }

  void find(const Declarations& keys, const std::string& above) {
    for (const Declaration& key : keys) {
      const std::string title = titleOf(above, key);
      find(key.below, title);
      if (key.alternatives.empty()) continue;
      if (Place* place = placeOf(key))
        place->isShared = true;
      else
        places_.push_back({title, &key});
      for (const auto& [about, own] : key.alternatives) find(own, title);
    }
  }

  void line(int indent, const std::string& text) {
    out_ += std::string(2 * static_cast<std::size_t>(indent), ' ') + "- " + text + "\n";
  }

  void writeLevel(const Declarations& keys, int level, const std::string& above) {
    for (const Declaration& key : keys) {
      const std::string title = titleOf(above, key);
      if (key.alternatives.empty()) {
        line(level, fmt::format("`{}`: {}. {}", key.key, valueText(key), key.sentence));
        writeLevel(key.below, level + 1, title);
        continue;
      }
      const Place& place = *placeOf(key);
      if (place.key == &key && place.isShared) due_.push_back(place);
      if (place.isShared) {
        std::vector<std::string> names;
        for (const auto& alternative : key.alternatives)
          names.push_back(fmt::format("`{}`", alternative.about.name));
        line(level, fmt::format("`{}`: required. {} One of {}: [{}](#{}).", key.key, key.sentence,
                                fmt::join(names, ", "), place.title, slug(place.title)));
      } else {
        line(level, fmt::format("`{}`: required. {} One of:", key.key, key.sentence));
        writeAlternatives(key, level + 1, title);
      }
    }
  }

  void writeAlternatives(const Declaration& key, int level, const std::string& title) {
    for (const auto& [about, own] : key.alternatives) {
      line(level, fmt::format("`{}: {}`: {}{}", key.key, about.name, about.sentence,
                              own.empty() ? "" : " Its keys:"));
      writeLevel(own, level + 1, title);
    }
  }

  std::vector<Place> places_, due_;
  std::string out_;
};

}  // namespace

std::string listKeys(const Declarations& keys) {
  return Listing(keys).text();
}

}  // namespace burnish::inline schema
