// Bodies in space that are made of several patches or of a control net are compressed between smooth walls:
// the deformation is F = diag(1, 1 - s, 1) everywhere, and the stress follows from it in closed form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "tests/engine/analysis/run_scene.h"

namespace burnish {
namespace {

constexpr double kCompression = 0.05;
constexpr double kE = 200.0, kNu = 0.3, kSigma0 = 2.0, kHardening = 50.0;

/// Two boxes beside one another with different meshes along x.
const std::string kPatches = R"(
geometry:
  shape: patches
  patches:
    - {name: one, shape: box, origin: [0, 0, 0], size: [0.8, 1, 0.5], spans: [2, 2, 1]}
    - {name: other, shape: box, origin: [0.8, 0, 0], size: [1.2, 1, 0.5], spans: [1, 2, 1]}
supports:
  - {patch: one, face: left, symmetry: true}
  - {patch: other, face: right, symmetry: true}
)";

/// A block whose parameter lines are not straight.
const std::string kNet = R"(
geometry:
  shape: patches
  patches:
    - name: one
      shape: control-net
      degrees: [2, 1, 1]
      knots: [[0, 0, 0, 0.5, 1, 1, 1], [0, 0, 1, 1], [0, 0, 1, 1]]
      points: [[0, 0, 0], [0.7, 0, 0], [1.2, 0, 0], [2, 0, 0], [0, 1, 0], [0.4, 1, 0], [1.5, 1, 0], [2, 1, 0],
        [0, 0, 0.5], [0.6, 0, 0.5], [1.4, 0, 0.5], [2, 0, 0.5], [0, 1, 0.5], [0.5, 1, 0.5], [1.3, 1, 0.5], [2, 1, 0.5]]
supports:
  - {patch: one, face: left, symmetry: true}
  - {patch: one, face: right, symmetry: true}
)";

/// P_yy of F = diag(1, λ, 1): neo-Hookean with the logarithmic volume term; J2 with logarithmic strains and
/// linear hardening, whose loading is proportional.
double stressOf(const std::string& law) {
  const double stretch = 1.0 - kCompression, strain = std::log(stretch);
  const double mu = kE / (2.0 * (1.0 + kNu)), kappa = kE / (3.0 * (1.0 - 2.0 * kNu));
  const double lambda = kappa - 2.0 / 3.0 * mu;
  if (law == "neo-hookean") return mu * (stretch - 1.0 / stretch) + lambda * strain / stretch;
  const double trial = 2.0 * mu * std::abs(strain);
  const double equivalent = kSigma0 + kHardening * (trial - kSigma0) / (3.0 * mu + kHardening);
  return (kappa * strain - 2.0 / 3.0 * equivalent) / stretch;
}

using Case = std::tuple<std::string, std::string, std::string>;

class UniformCompression : public testing::TestWithParam<Case> {};

TEST_P(UniformCompression, IsExact) {
  const auto& [body, law, formulation] = GetParam();
  const std::string material =
      law == "j2" ? fmt::format(
                        "{{law: j2, E: {}, nu: {}, elastic: hencky, hardening: {{law: linear, sigma0: {}, "
                        "modulus: {}}}}}",
                        kE, kNu, kSigma0, kHardening)
                  : fmt::format("{{law: neo-hookean, E: {}, nu: {}}}", kE, kNu);
  std::string yaml = (body == "net" ? kNet : kPatches);
  for (const char* patch : {"one", "other"}) {
    if (body == "net" && patch == std::string("other")) continue;
    yaml += fmt::format(
        "  - {{patch: {0}, face: bottom, symmetry: true}}\n"
        "  - {{patch: {0}, face: back, symmetry: true}}\n"
        "  - {{patch: {0}, face: front, symmetry: true}}\n"
        "  - {{patch: {0}, face: top, move: {{times: [0, 1], y: [0, {1}]}}}}\n",
        patch, -kCompression);
  }
  yaml += fmt::format("degree: 2\nformulation: {}\nmaterial: {}\nsteps: [{{until: 1, count: 3}}]\n",
                      formulation, material);
  const auto outcome = test::run(parseScene(yaml, "uniform"), "uniform");
  ASSERT_TRUE(outcome.summary.completed) << outcome.summary.stoppedBecause;
  for (const PatchRecord& patch : outcome.model.mesh.patches)
    for (std::size_t a = 0; a < patch.nodes.size(); ++a) {
      const auto u = outcome.lastFrame.displacement.col(patch.nodes[a]);
      const double y = patch.points(1, static_cast<Eigen::Index>(a));
      EXPECT_LT((u - Eigen::Vector3d(0.0, -kCompression * y, 0.0)).norm(), 1e-10);
    }
  const FieldRecord& stress = outcome.lastFrame.fields.at("stress");
  const auto yy =
      std::find(stress.components.begin(), stress.components.end(), "yy") - stress.components.begin();
  // Of the uniaxial state the Cauchy stress across the face is the nominal one.
  EXPECT_LT((stress.values.row(yy).array() - stressOf(law)).abs().maxCoeff(), 1e-8 * std::abs(stressOf(law)));
}

INSTANTIATE_TEST_SUITE_P(Bodies, UniformCompression,
                         testing::Combine(testing::Values("patches", "net"),
                                          testing::Values("neo-hookean", "j2"),
                                          testing::Values("displacement", "fbar")),
                         [](const auto& parameters) {
                           std::string law = std::get<1>(parameters.param) == "j2" ? "J2" : "NeoHookean";
                           return std::get<0>(parameters.param) + law + std::get<2>(parameters.param);
                         });

}  // namespace
}  // namespace burnish
