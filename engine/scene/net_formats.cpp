#include "engine/scene/net_formats.h"

#include <fmt/format.h>
#include <json/reader.h>
#include <json/value.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <string_view>
#include <utility>

#include "engine/core/quoted.h"

namespace burnish::inline scene {
namespace {

/// More numbers than these are no control net; a scene may have as many values.
constexpr std::size_t kMostNumbers = 1'000'000;

struct Fault {
  Place place;
  std::string text;
};

YamlNode keyed(const char* key, YamlNode node) {
  node.key = key;
  node.keyPlace = node.place;
  return node;
}

YamlNode listAt(const Place& place) {
  return {.kind = YamlNode::Kind::Sequence, .place = place};
}

YamlNode scalarAt(const Place& place, std::string text) {
  return {.kind = YamlNode::Kind::Scalar, .place = place, .text = std::move(text)};
}

/// Words of a text with their places.
class Words {
 public:
  Words(std::string_view text, int source) : text_(text), source_(source) { skipSpace(); }

  bool empty() const { return at_ == text_.size(); }
  Place place() const { return {source_, line_, static_cast<int>(at_ - lineBegin_) + 1}; }

  std::string_view next(const char* expected) {
    if (empty()) throw Fault{place(), fmt::format("the file ends where {} should stand", expected)};
    if (++count_ > kMostNumbers) throw Fault{place(), fmt::format("more than {} numbers", kMostNumbers)};
    const std::size_t begin = at_;
    while (!empty() && !isSpace(text_[at_])) ++at_;
    const std::string_view word = text_.substr(begin, at_ - begin);
    skipSpace();
    return word;
  }

  int whole(const char* expected, int least, int most) {
    const Place where = place();
    const std::string_view word = next(expected);
    int value = 0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc() || end != word.data() + word.size() || value < least || value > most)
      throw Fault{where, fmt::format("found {} where {} should stand; allowed: a whole number from {} to {}",
                                     shortened(std::string(word)), expected, least, most)};
    return value;
  }

  double number(const char* expected) {
    const Place where = place();
    const std::string_view word = next(expected), digits = word.starts_with('+') ? word.substr(1) : word;
    double value = 0.0;
    const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (fault != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
      throw Fault{where, fmt::format("found {} where {} should stand; allowed: a number",
                                     shortened(std::string(word)), expected)};
    return value;
  }

 private:
  static bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

  void skipSpace() {
    for (; !empty() && isSpace(text_[at_]); ++at_)
      if (text_[at_] == '\n') {
        ++line_;
        lineBegin_ = at_ + 1;
      }
  }

  std::string_view text_;
  int source_;
  std::size_t at_ = 0, lineBegin_ = 0, count_ = 0;
  int line_ = 1;
};

YamlNode numberAt(Words& words, const char* expected) {
  const Place place = words.place();
  return scalarAt(place, fmt::format("{}", words.number(expected)));
}

/// Number of directions of a class of objects.
int directionsOf(int kind, const Place& place) {
  if (kind == 100 || kind == 200) return kind / 100;
  if (kind == 700) return 3;
  throw Fault{
      place,
      fmt::format("found an object of class {}; allowed: 100 (curve), 200 (surface) or 700 (volume)", kind)};
}

/// The points of an object, and its weights if it is rational.
void readPoints(Words& words, int functions, int dim, bool isRational, YamlNode& points, YamlNode& weights) {
  for (int a = 0; a < functions; ++a) {
    YamlNode& point = points.children.emplace_back(listAt(words.place()));
    std::vector<std::pair<Place, double>> coordinates;
    for (int c = 0; c < dim; ++c) {
      const Place place = words.place();
      coordinates.emplace_back(place, words.number("a coordinate"));
    }
    double weight = 1.0;
    if (isRational) {
      const Place place = words.place();
      weight = words.number("a weight");
      if (!(weight > 0.0))
        throw Fault{place, fmt::format("found a weight of {}; allowed: a number above 0", weight)};
      weights.children.push_back(scalarAt(place, fmt::format("{}", weight)));
    }
    for (const auto& [place, value] : coordinates)
      point.children.push_back(scalarAt(place, fmt::format("{}", value / weight)));
  }
}

YamlNode readObject(Words& words) {
  constexpr int kMostOrder = 11, kMostPoints = 1'000'000;
  const Place begin = words.place();
  const int directions = directionsOf(words.whole("the class of an object", 0, 10'000), begin);
  words.whole("the major version", 0, 1000);
  words.whole("the minor version", 0, 1000);
  for (int more = words.whole("the number of further values", 0, 1000); more > 0; --more)
    words.next("a further value");
  const int dim = words.whole("the number of coordinates", 1, 3);
  const bool isRational = words.whole("0 or 1, for rational objects,", 0, 1) == 1;
  YamlNode degrees = listAt(words.place()), knots = listAt(words.place());
  double functions = 1.0;
  for (int d = 0; d < directions; ++d) {
    const int count = words.whole("the number of basis functions", 2, kMostPoints);
    const Place place = words.place();
    const int order = words.whole("the order", 2, kMostOrder);
    degrees.children.push_back(scalarAt(place, fmt::format("{}", order - 1)));
    YamlNode& direction = knots.children.emplace_back(listAt(words.place()));
    for (int k = 0; k < count + order; ++k) direction.children.push_back(numberAt(words, "a knot"));
    functions *= count;
  }
  if (functions > kMostPoints)
    throw Fault{begin,
                fmt::format("found an object of {} points; allowed: up to {}", functions, kMostPoints)};
  YamlNode points = listAt(words.place()), weights = listAt(words.place());
  readPoints(words, static_cast<int>(functions), dim, isRational, points, weights);
  YamlNode net{.kind = YamlNode::Kind::Mapping, .place = begin};
  net.children = {keyed("degrees", std::move(degrees)), keyed("knots", std::move(knots)),
                  keyed("points", std::move(points))};
  if (isRational) net.children.push_back(keyed("weights", std::move(weights)));
  return net;
}

int wholeOf(const YamlNode& node, const char* what, int least, int most) {
  int value = 0;
  const char* last = node.text.data() + node.text.size();
  const auto [stop, fault] = std::from_chars(node.text.data(), last, value);
  if (node.kind != YamlNode::Kind::Scalar || fault != std::errc() || stop != last || value < least ||
      value > most)
    throw Fault{node.place,
                fmt::format("found {}; allowed: {}, a whole number from {} to {}",
                            node.kind == YamlNode::Kind::Scalar ? shortened(node.text) : node.describe(),
                            what, least, most)};
  return value;
}

/// A number that says what follows from others may be left out; it must not say something else.
void requireSame(const YamlNode& holder, const std::string& key, std::size_t count, const char* why) {
  constexpr int kMost = 1'000'000'000;
  const YamlNode* given = holder.find(key);
  if (given == nullptr || given->kind == YamlNode::Kind::Null) return;
  if (static_cast<std::size_t>(wholeOf(*given, key.c_str(), 0, kMost)) != count)
    throw Fault{given->place, fmt::format("found {} as {}; allowed: {}, {}", given->text, key, count, why)};
}

/// Surfaces are taken whole.
void refuseTrims(const YamlNode& data) {
  const YamlNode* trims = data.find("trims");
  if (trims == nullptr) return;
  const YamlNode* curves = trims->kind == YamlNode::Kind::Mapping ? trims->find("data") : trims;
  if (curves != nullptr && !curves->children.empty())
    throw Fault{trims->place, "found a surface that is trimmed by curves; allowed: surfaces without trims"};
}

/// Value of a key of a mapping.
const YamlNode& part(const YamlNode& holder, const std::string& key, YamlNode::Kind kind) {
  const YamlNode* found = holder.kind == YamlNode::Kind::Mapping ? holder.find(key) : nullptr;
  if (found == nullptr)
    throw Fault{holder.place,
                fmt::format("found {} without {}, which NURBS in JSON have", holder.describe(), key)};
  if (found->kind != kind)
    throw Fault{found->place, fmt::format("found {} as {}; allowed: {}", found->describe(), key,
                                          kind == YamlNode::Kind::Sequence  ? "a list"
                                          : kind == YamlNode::Kind::Mapping ? "a mapping"
                                                                            : "a text or a number")};
  return *found;
}

/// The control points in the order of scenes: geomdl has the second direction fastest, then the first one.
YamlNode reordered(const YamlNode& given, const std::array<std::size_t, 3>& size, const char* what) {
  if (given.children.size() != size[0] * size[1] * size[2])
    throw Fault{given.place,
                fmt::format("found {} {}; allowed: {}, as many as the knots make basis functions",
                            given.children.size(), what, size[0] * size[1] * size[2])};
  YamlNode ordered = listAt(given.place);
  for (std::size_t w = 0; w < size[2]; ++w)
    for (std::size_t v = 0; v < size[1]; ++v)
      for (std::size_t u = 0; u < size[0]; ++u)
        ordered.children.push_back(given.children[v + size[1] * (u + size[0] * w)]);
  return ordered;
}

YamlNode readShape(const YamlNode& data) {
  using Kind = YamlNode::Kind;
  if (data.kind != Kind::Mapping)
    throw Fault{data.place,
                fmt::format("found {}; allowed: a mapping with degrees and control_points", data.describe())};
  refuseTrims(data);
  const bool isCurve = data.find("degree_u") == nullptr;
  YamlNode degrees = listAt(data.place), knots = listAt(data.place);
  std::array<std::size_t, 3> size{1, 1, 1};
  for (std::size_t d = 0; d < 3; ++d) {
    const std::string end = isCurve ? "" : fmt::format("_{}", "uvw"[d]);
    if (d > 0 && (isCurve || data.find("degree" + end) == nullptr)) break;
    const YamlNode& degree = part(data, "degree" + end, Kind::Scalar);
    const YamlNode& row = part(data, "knotvector" + end, Kind::Sequence);
    const int value = wholeOf(degree, "a degree", 1, 10);
    if (row.children.size() < 2 * (static_cast<std::size_t>(value) + 1))
      throw Fault{row.place, fmt::format("found {} knots; allowed for degree {}: at least {}",
                                         row.children.size(), value, 2 * (value + 1))};
    size[d] = row.children.size() - static_cast<std::size_t>(value) - 1;
    requireSame(data, "size" + end, size[d], "as many as the knots make basis functions");
    degrees.children.push_back(degree);
    knots.children.push_back(row);
  }
  const YamlNode& control = part(data, "control_points", Kind::Mapping);
  YamlNode net{.kind = Kind::Mapping, .place = data.place};
  net.children = {keyed("degrees", std::move(degrees)), keyed("knots", std::move(knots)),
                  keyed("points", reordered(part(control, "points", Kind::Sequence), size, "points"))};
  if (control.find("weights") != nullptr)
    net.children.push_back(
        keyed("weights", reordered(part(control, "weights", Kind::Sequence), size, "weights")));
  return net;
}

/// All shapes are of the type that a file says, which may be left out.
void requireType(const YamlNode& shape, const std::vector<YamlNode>& nets) {
  constexpr std::array kTypes{"curve", "surface", "volume"};
  const YamlNode* type = shape.find("type");
  if (type == nullptr) return;
  for (const YamlNode& net : nets) {
    const char* found = kTypes[net.find("degrees")->children.size() - 1];
    if (type->text != found)
      throw Fault{type->place,
                  fmt::format("found type {} of a file that holds a {}; allowed: {}",
                              type->kind == YamlNode::Kind::Scalar ? shortened(type->text) : type->describe(),
                              found, found)};
  }
}

/// Where a message of the reader of JSON says that something is wrong, "Line 3, Column 5".
Place placeIn(const std::string& message, int source) {
  const auto numberBehind = [&message](const char* word) {
    int number = 1;
    if (const std::size_t at = message.find(word); at != std::string::npos) {
      const char* begin = message.data() + at + std::string_view(word).size();
      std::from_chars(begin, message.data() + message.size(), number);
    }
    return number;
  };
  return {source, numberBehind("Line "), numberBehind("Column ")};
}

}  // namespace

bool isJson(const std::string& text, int source, const std::string& path, Diagnostics& errors) {
  const std::unique_ptr<Json::CharReader> reader(Json::CharReaderBuilder().newCharReader());
  Json::Value ignored;
  std::string problem;
  try {
    if (reader->parse(text.data(), text.data() + text.size(), &ignored, &problem)) return true;
  } catch (const Json::Exception& exception) {  // too deep
    problem = exception.what();
  }
  errors.add(placeIn(problem, source), path,
             "broken JSON; look at brackets, commas and quotes here and just before.");
  return false;
}

std::optional<std::vector<YamlNode>> netsOfG2(const std::string& text, int source, const std::string& path,
                                              Diagnostics& errors) {
  std::vector<YamlNode> nets;
  try {
    Words words(text, source);
    do nets.push_back(readObject(words));
    while (!words.empty());
  } catch (const Fault& fault) {
    errors.add(fault.place, path, fmt::format("{}.", fault.text));
    return std::nullopt;
  }
  return nets;
}

std::optional<std::vector<YamlNode>> netsOfJson(const YamlNode& document, const std::string& path,
                                                Diagnostics& errors) {
  std::vector<YamlNode> nets;
  try {
    const YamlNode& all = part(document, "shape", YamlNode::Kind::Mapping);
    const YamlNode& data = part(all, "data", YamlNode::Kind::Sequence);
    for (const YamlNode& shape : data.children) nets.push_back(readShape(shape));
    if (nets.empty()) throw Fault{data.place, "found a list of no shapes; allowed: at least one"};
    requireSame(all, "count", nets.size(), "as many as there are in data");
    requireType(all, nets);
  } catch (const Fault& fault) {
    errors.add(fault.place, path, fmt::format("{}.", fault.text));
    return std::nullopt;
  }
  return nets;
}

}  // namespace burnish::inline scene
