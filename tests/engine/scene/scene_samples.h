#pragma once
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/scene/reader.h"

/// Good scenes that the tests of the reader change in one place.
namespace burnish::samples {

inline const std::string block = R"(basis: nurbs
degree: 2
geometry: {shape: rectangle, size: [3.0, 1.0], functions: [49, 25]}
material: {law: neo-hookean, E: 1.0, nu: 0.3}
supports:
  - {face: bottom, fix: [x, y]}
loads:
  - {face: left, traction: [1, 0], schedule: {times: [0, 1], values: [0, 1]}}
tools:
  - {name: cylinder, shape: cylinder, center: [0.5, 1.5], radius: 0.5, motion: {times: [0, 1, 2], x: [0, 0, 2]}}
  - {name: plate, shape: plane, origin: [0, 2], normal: [0, -1]}
contact:
  - {tool: cylinder, face: top, method: augmented-lagrangian}
steps:
  - {until: 1, count: 20}
  - {until: 2, count: 200}
output: {every: 0.1, subdivision: 4}
pictures:
  - {field: von_mises, times: [1, 1.5, 2]}
)";

inline const std::string net = R"(geometry:
  shape: control-net
  degrees: [1, 2]
  knots: [[0, 0, 1, 1], [0, 0, 0, 1, 1, 1]]
  points: [[1, 0], [2, 0], [1, 1], [2, 2], [0, 1], [0, 2]]
  weights: [1, 1, 0.7071067811865476, 0.7071067811865476, 1, 1]
material: {law: j2, E: 70000, nu: 0.3, hardening: {law: table, ep: [0, 0.1], stress: [80, 120]}}
steps: [{until: 1, count: 1}]
)";

/// A disc is pressed into an elastoplastic slab and dragged along it; a step is cut on the way, and frames
/// stand at some of the steps only.
inline const std::string ironing = R"(
geometry: {shape: rectangle, size: [2.0, 0.6], functions: [30, 8]}
material:
  law: j2
  E: 70000
  nu: 0.3
  hardening: {law: voce, sigma0: 79.66, sigma_inf: 171.26, beta: 17.8}
supports: [{face: bottom, fix: [x, y]}]
tools:
  - {name: disc, shape: cylinder, center: [0.7, 1.1], radius: 0.5,
     motion: {times: [0, 1, 2], x: [0, 0, 0.4], y: [0, -0.03, -0.03]}}
contact: [{tool: disc, face: top, method: augmented-lagrangian}]
steps: [{until: 1, count: 4}, {until: 2, count: 10}]
output: {every: 0.4}
)";

inline const std::string hardening = "hardening: {law: table, ep: [0, 0.1], stress: [80, 120]}";

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the test's text has no \"" + from + "\"");
  return text.replace(at, from.size(), to);
}

inline std::string errorOf(const std::string& yaml, const std::vector<std::string>& overrides = {}) {
  try {
    parseScene(yaml, "test.yaml", overrides);
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace burnish::samples
