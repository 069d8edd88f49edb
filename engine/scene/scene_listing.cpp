#include "engine/scene/scene_listing.h"

#include "engine/scene/leaf_writer.h"
#include "engine/scene/schema.h"

namespace burnish {
namespace {

template <Leaf T>
std::string defaultText(const T& value, const Rule& rule) {
  YAML::Emitter out;
  writeLeaf(out, value, rule);
  return out.c_str();
}

/// Visitor that lists the fields of a struct, every alternative of a variant included.
class MappingLister {
 public:
  MappingLister(std::string& out, int level) : out_(out), level_(level) {}

  template <class T>
  void field(const char* key, T& value, const Rule& rule, const char* sentence) {
    std::string type = allowedText<T>(rule);
    if (!rule.unit.empty()) type += " (" + rule.unit + ")";
    if (rule.required) type += ", required";
    if constexpr (Leaf<T>) type += defaultOf(value, rule);
    line(fmt::format("`{}`: {}. {}", key, type, sentence));
    listBelow(value);
  }

  template <class... A>
  void alternatives(const char* key, std::variant<A...>& /*value*/,
                    const std::array<Alternative, sizeof...(A)>& alternatives, const char* sentence) {
    line(fmt::format("`{}`: required. {} One of:", key, sentence));
    std::size_t index = 0;
    const auto listOne = [&]<class T>(T fresh) {
      const Alternative& alternative = alternatives[index++];
      MappingLister below(out_, level_ + 1);
      below.line(fmt::format("`{}: {}`: {} Its keys:", key, alternative.name, alternative.sentence));
      MappingLister fields(out_, level_ + 2);
      describe(fields, fresh);
    };
    (listOne(A{}), ...);
  }

 private:
  template <class T>
  static std::string defaultOf(const T& value, const Rule& rule) {
    if (rule.required) return "";
    if constexpr (List<T>)
      if (value.empty()) return "";
    return ", default " + defaultText(value, rule);
  }

  template <class T>
  void listBelow(T& /*value*/) {
    using Struct = typename Underlying<T>::Type;
    if constexpr (!Leaf<Struct>) {
      Struct fresh{};
      MappingLister below(out_, level_ + 1);
      describe(below, fresh);
    }
  }

  /// The struct or leaf inside optionals and lists.
  template <class T>
  struct Underlying {
    using Type = T;
  };
  template <class T>
  struct Underlying<std::optional<T>> : Underlying<T> {};
  template <class T>
  struct Underlying<std::vector<T>> : Underlying<T> {};

  void line(const std::string& text) {
    out_ += std::string(static_cast<std::size_t>(2 * level_), ' ') + "- " + text + "\n";
  }

  std::string& out_;
  int level_;
};

}  // namespace

std::string describeScene() {
  std::string out;
  Scene scene;
  MappingLister lister(out, 0);
  describe(lister, scene);
  return out;
}

}  // namespace burnish
