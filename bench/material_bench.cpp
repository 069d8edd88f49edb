// One evaluation of a material law at random deformations: stress, tangent, energy and new history.
#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "engine/material/material.h"

namespace burnish {
namespace {

/// Components of the displacement gradient are uniform in [-amplitude, amplitude].
template <int Dim, class Law>
void evaluateAt(benchmark::State& state, const Law& law, double amplitude) {
  constexpr std::size_t kPoints = 1000;
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
  std::vector<Eigen::Matrix3d> F(kPoints, Eigen::Matrix3d::Identity());
  for (auto& f : F)
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j < Dim; ++j) f(i, j) += uniform(generator);
  const typename Law::State virgin{};
  typename Law::State next{};
  MaterialResponse<Dim> response;
  std::size_t plastic = 0, point = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(law.template evaluate<Dim>(F[point], virgin, next, response));
    if constexpr (Flows<Law>) plastic += next.e_p > 0.0 ? 1 : 0;
    point = (point + 1) % kPoints;
  }
  state.counters["plastic_share"] = static_cast<double>(plastic) / static_cast<double>(state.iterations());
}

J2Plasticity alloy(ElasticLaw law) {
  return J2Plasticity({70000.0, 0.3, law, VoceHardening{79.66, 171.26, 17.8}});
}

void neoHookean2D(benchmark::State& s) {
  evaluateAt<2>(s, NeoHookean({1.0, 0.3}), 0.2);
}
void neoHookean3D(benchmark::State& s) {
  evaluateAt<3>(s, NeoHookean({1.0, 0.3}), 0.2);
}
void j2Elastic2D(benchmark::State& s) {
  evaluateAt<2>(s, alloy(ElasticLaw::NeoHookean), 1e-4);
}
void j2Plastic2D(benchmark::State& s) {
  evaluateAt<2>(s, alloy(ElasticLaw::NeoHookean), 0.05);
}
void j2Plastic3D(benchmark::State& s) {
  evaluateAt<3>(s, alloy(ElasticLaw::NeoHookean), 0.05);
}
void henckyPlastic2D(benchmark::State& s) {
  evaluateAt<2>(s, alloy(ElasticLaw::Hencky), 0.05);
}

BENCHMARK(neoHookean2D);
BENCHMARK(neoHookean3D);
BENCHMARK(j2Elastic2D);
BENCHMARK(j2Plastic2D);
BENCHMARK(j2Plastic3D);
BENCHMARK(henckyPlastic2D);

}  // namespace
}  // namespace burnish
