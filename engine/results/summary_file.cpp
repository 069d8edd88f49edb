#include "engine/results/summary_file.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <span>
#include <system_error>
#include <type_traits>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"

namespace burnish::inline results {
namespace {

std::filesystem::path summaryFile(const std::filesystem::path& directory) {
  return directory / "summary.yaml";
}

/// Visitor that writes a struct as a mapping; numbers with the fewest digits that read back exactly.
class Writer {
 public:
  explicit Writer(YAML::Emitter& yaml) : yaml_(yaml) {}

  template <class T>
  void field(const char* key, T& value, const Rule& rule, const char* /*sentence*/) {
    if (!rule.required && isEmpty(value)) return;
    yaml_ << YAML::Key << key << YAML::Value;
    write(value);
  }

 private:
  template <class T>
  static bool isEmpty(const T& value) {
    if constexpr (requires { value.empty(); }) return value.empty();
    if constexpr (requires { value.has_value(); }) return !value.has_value();
    return false;
  }

  void write(double value) { yaml_ << fmt::format("{}", value); }

  template <class T>
  void write(const std::optional<T>& value) {
    write(*value);
  }

  template <class T>
  void write(const T& value) {
    yaml_ << value;
  }

  template <class T>
  void write(std::vector<T>& list) {
    yaml_ << YAML::BeginSeq;
    for (T& item : list) {
      if constexpr (requires { describe(*this, item); }) {
        if (!std::is_same_v<T, DoubtRecord>) yaml_ << YAML::Flow;  // those are sentences
        yaml_ << YAML::BeginMap;
        describe(*this, item);
        yaml_ << YAML::EndMap;
      } else {
        write(item);
      }
    }
    yaml_ << YAML::EndSeq;
  }

  YAML::Emitter& yaml_;
};

/// Visitor that fills a struct from a mapping.
class Reader {
 public:
  explicit Reader(const YAML::Node& mapping) : mapping_(mapping) {}

  template <class T>
  void field(const char* key, T& value, const Rule& rule, const char* /*sentence*/) {
    const YAML::Node stored = mapping_[key];
    if (stored || rule.required) read(stored, value);
  }

 private:
  template <class T>
  static void read(const YAML::Node& stored, T& value) {
    value = stored.as<T>();
  }

  template <class T>
  static void read(const YAML::Node& stored, std::optional<T>& value) {
    value = stored.as<T>();
  }

  template <class T>
  requires requires(Reader& reader, T& item) { describe(reader, item); }
  static void read(const YAML::Node& stored, std::vector<T>& list) {
    for (const YAML::Node& item : stored) {
      Reader reader(item);
      describe(reader, list.emplace_back());
    }
  }

  const YAML::Node& mapping_;
};

/// Visitor that collects numbers by their names.
class NumberCollector {
 public:
  template <class T>
  void field(const char* key, const T& value, const Rule& /*rule*/, const char* /*sentence*/) {
    if constexpr (requires { value.has_value(); }) {
      names.emplace_back(key);
      if (value) numbers[key] = static_cast<double>(*value);
    } else if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      names.emplace_back(key);
      numbers[key] = static_cast<double>(value);
    }
  }

  std::map<std::string, double> numbers;
  std::vector<std::string> names;  ///< also of those that the account does not have
};

}  // namespace

void writeSummary(const std::filesystem::path& directory, const RunAccount& account) {
  YAML::Emitter yaml;
  yaml << YAML::BeginMap;
  Writer writer(yaml);
  RunAccount described = account;
  describe(writer, described);
  yaml << YAML::EndMap << YAML::Newline;
  writeFileAtomically(summaryFile(directory), std::as_bytes(std::span(yaml.c_str(), yaml.size())));
}

RunAccount readSummary(const std::filesystem::path& directory) {
  const auto file = summaryFile(directory);
  try {
    const YAML::Node stored = YAML::LoadFile(file.string());
    if (!stored.IsMap() || !stored["program"])
      throw Error(fmt::format("{}: is not the summary of a run", file.string()));
    RunAccount account;
    Reader reader(stored);
    describe(reader, account);
    return account;
  } catch (const YAML::Exception& error) {
    throw Error(fmt::format("{}: cannot be read as the summary of a run: {}", file.string(), error.what()));
  }
}

std::map<std::string, double> numbersOf(const RunAccount& account) {
  NumberCollector collector;
  RunAccount described = account;
  describe(collector, described);
  return std::move(collector.numbers);
}

std::vector<std::string> numberNames() {
  NumberCollector collector;
  RunAccount described;
  describe(collector, described);
  return std::move(collector.names);
}

void removeSummary(const std::filesystem::path& directory) {
  std::error_code status;
  std::filesystem::remove(summaryFile(directory), status);
  if (status)
    throw Error(fmt::format("cannot remove {}: {}", summaryFile(directory).string(), status.message()));
}

}  // namespace burnish::inline results
