#include "postproc/probe/path_text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/quoted.h"

namespace burnish {
namespace {

/// Finite numbers with commas between them, as many as `count`, or nothing.
std::optional<Eigen::VectorXd> numbersIn(const std::string& text, int count) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    double& number = numbers.emplace_back();
    const auto [behind, error] = std::from_chars(at, end, number);
    if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
    if (behind == end) break;
    if (*behind != ',') return std::nullopt;
    at = behind + 1;
  }
  if (std::ssize(numbers) != count) return std::nullopt;
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), count);
}

/// "X,Y" or "X,Y,Z", with a text behind each.
std::string axesWords(int dim, const std::string& behind = "") {
  const std::string plane = fmt::format("X{0},Y{0}", behind);
  return dim == 2 ? plane : fmt::format("{},Z{}", plane, behind);
}

LinePath lineIn(const std::string& text, int dim) {
  const std::size_t colon = text.find(':');
  if (colon != std::string::npos) {
    const auto begin = numbersIn(text.substr(0, colon), dim), end = numbersIn(text.substr(colon + 1), dim);
    if (begin && end) return {*begin, *end};
  }
  throw Error(fmt::format("line: found {}; expected {}:{}, two points of the {}", quoted(text),
                          axesWords(dim, "0"), axesWords(dim, "1"), dim == 2 ? "plane" : "space"));
}

DepthPath depthIn(const ProbeSpec& spec, int dim) {
  const std::size_t at = spec.depth.find('@');
  if (at != std::string::npos) {
    const FaceAddress face{spec.depth.substr(0, at), spec.patch};
    const std::string place = spec.depth.substr(at + 1);
    if (const auto position = numbersIn(place, dim)) return {face, *position, spec.length};
    if (const auto length = numbersIn(place, 1); length && dim == 2) return {face, *length, spec.length};
  }
  throw Error(fmt::format("depth: found {}; expected FACE@{}, a position on the face{}", quoted(spec.depth),
                          axesWords(dim), dim == 2 ? ", or FACE@S, a length along it" : ""));
}

}  // namespace

ProbePath pathOf(const ProbeSpec& spec, int dim) {
  if (!spec.line.empty() && !spec.face.empty())
    return LaidPath{{spec.face, spec.patch}, lineIn(spec.line, dim)};
  if (!spec.line.empty()) return lineIn(spec.line, dim);
  if (!spec.face.empty()) return FacePath{{spec.face, spec.patch}};
  return depthIn(spec, dim);
}

Eigen::VectorXd pointOf(const ProbeSpec& spec, int dim, const char* body) {
  if (const auto point = numbersIn(spec.point, dim)) return *point;
  throw Error(fmt::format("point: found {}; expected {}, a position in {}", quoted(spec.point),
                          axesWords(dim), body));
}

}  // namespace burnish
