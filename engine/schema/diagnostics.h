#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace burnish::inline schema {

/// Where a piece of YAML stands: source 0 is the scene file, source k the k-th override, sources beyond the
/// overrides are further files. Lines and columns from 1.
struct Place {
  int source = 0;
  int line = 1;
  int column = 1;
};

/// Collects everything that is wrong with a scene, so that a person sees it all at once.
class Diagnostics {
 public:
  /// `overrides` as given on the command line, "path=value" each.
  Diagnostics(std::string file, std::vector<std::string> overrides);

  /// Source number of a further file, for places in it.
  int addFile(std::string file);

  /// `key` is the full path of the value, such as `tools[0].radius`; empty for the scene as a whole.
  void add(const Place& place, const std::string& key, const std::string& problem);

  /// Whether nothing is wrong with this key, with what it stands in, and with everything below it.
  bool clean(const std::string& key) const;

  /// So much is wrong that looking further does not help.
  bool full() const { return entries_.size() >= capacity; }

  /// A line per problem, in the order of the file.
  std::string text() const;

  /// Throws one `Error` with this text if there is any problem.
  void throwIfAny() const;

 private:
  static constexpr std::size_t capacity = 200;

  struct Entry {
    Place place;
    std::string key;
    std::string problem;
  };
  std::string line(const Entry& entry) const;

  std::string file_;
  std::vector<std::string> overrides_;
  std::vector<std::string> furtherFiles_;
  std::vector<Entry> entries_;
};

}  // namespace burnish::inline schema
