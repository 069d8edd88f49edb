#pragma once
#include <string>

/// Two bodies of unlike basis, degree, formulation and material that do not touch one another, pressed by one
/// plane.
namespace burnish::samples {

inline const std::string twoBodies = R"(
title: Two blocks under one plate
formulation: fbar
bodies:
  - name: soft
    degree: 2
    geometry: {shape: rectangle, size: [1, 1], spans: [4, 3]}
    material: {law: j2, E: 100, nu: 0.3, hardening: {law: linear, sigma0: 1, modulus: 5}}
  - name: firm
    basis: lagrange
    degree: 3
    formulation: displacement
    quadrature_points: 5
    geometry: {shape: rectangle, origin: [1.5, 0], size: [0.5, 1], spans: [2, 3]}
    material: {law: neo-hookean, E: 300, nu: 0.2}
supports:
  - {body: soft, face: bottom, fix: [x, y]}
  - {body: firm, face: bottom, fix: [x, y]}
tools:
  - {name: plate, shape: plane, origin: [0, 1], normal: [0, -1], motion: {times: [0, 1], y: [0, -0.04]}}
contact:
  - {tool: plate, body: soft, face: top}
  - {tool: plate, body: firm, face: top}
measures:
  - {name: corner, kind: point, body: firm, position: [2, 1], fields: [displacement, von_mises]}
  - {name: foot, kind: face, body: soft, face: bottom}
  - {name: tall, kind: percentile, body: soft, field: plastic_strain, share: 0.9}
solver: {tolerance: 1e-11}
steps: [{until: 1, count: 4}]
output: {every: 0.5, reactions: true}
)";

}  // namespace burnish::samples
