#include "cli/commands/probe_paths.h"

#include <fmt/format.h>

#include "cli/arguments.h"
#include "engine/core/error.h"
#include "engine/core/quoted.h"

namespace burnish {
namespace {

/// "X,Y" or "X,Y,Z", each followed by a text.
std::string axesWords(int dim, const std::string& behind = "") {
  const std::string plane = fmt::format("X{0},Y{0}", behind);
  return dim == 2 ? plane : fmt::format("{},Z{}", plane, behind);
}

std::optional<Eigen::VectorXd> pointIn(const std::string& text, int dim) {
  const auto numbers = coordinatesFromText(text);
  if (!numbers || std::ssize(*numbers) != dim) return std::nullopt;
  return Eigen::Map<const Eigen::VectorXd>(numbers->data(), dim);
}

}  // namespace

LinePath lineFromText(const std::string& text, int dim) {
  const std::size_t colon = text.find(':');
  if (colon != std::string::npos) {
    const auto begin = pointIn(text.substr(0, colon), dim), end = pointIn(text.substr(colon + 1), dim);
    if (begin && end) return {*begin, *end};
  }
  throw Error(fmt::format("--line: found {}; expected {}:{}, two points of the {}", quoted(text),
                          axesWords(dim, "0"), axesWords(dim, "1"), dim == 2 ? "plane" : "space"));
}

Eigen::VectorXd pointFromText(const std::string& text, int dim) {
  if (const auto point = pointIn(text, dim)) return *point;
  throw Error(fmt::format("--point: found {}; expected {}, a position in the undeformed body", quoted(text),
                          axesWords(dim)));
}

DepthPath depthFromText(const std::string& text, int dim) {
  const std::size_t at = text.find('@');
  if (at != std::string::npos) {
    const std::string face = text.substr(0, at), place = text.substr(at + 1);
    if (const auto position = pointIn(place, dim)) return {{face, ""}, *position};
    if (const auto length = pointIn(place, 1); length && dim == 2) return {{face, ""}, *length};
  }
  throw Error(fmt::format("--depth: found {}; expected FACE@{}, a position on the face{}", quoted(text),
                          axesWords(dim), dim == 2 ? ", or FACE@S, a length along it" : ""));
}

}  // namespace burnish
