// Contour pictures of the ironing problem (49 x 25 functions, 4 x 4 cells per knot span): the first of a
// process, which makes the GL context and compiles shaders, and further ones, alike or of another size. Then
// a block in space (42 x 22 x 42 functions) with the cells that the picture takes, and with a million triangles (6 x 6
// cells of four triangles per knot span).
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <optional>
#include <string>

#include "engine/analysis/build_model.h"
#include "engine/analysis/frames.h"
#include "engine/scene/reader.h"
#include "postproc/draw/contour/contour.h"
#include "tests/engine/analysis/model_samples.h"

namespace burnish {
namespace {

struct Sample {
  ModelRecord model;
  FrameRecord frame;
};

/// A bump of plastic strain in the undeformed slab: a picture takes as long for any field.
Sample slab() {
  const Scene scene = readScene(std::string(BURNISH_SOURCE_DIR) + "/scenes/paper/plastic.yaml");
  Sample sample{makeModelRecord(scene, *buildModel<2>(scene)), {}};
  sample.frame.displacement = Eigen::MatrixXd::Zero(2, sample.model.mesh.numNodes);
  sample.frame.toolDisplacement =
      Eigen::MatrixXd::Zero(2, static_cast<Eigen::Index>(sample.model.tools.size()));
  const auto x = sample.model.mesh.patches.front().points.row(0).array();
  sample.frame.fields["plastic_strain"] = {{}, "", (-(x - 1.5).square()).exp().matrix()};
  return sample;
}

/// A block with a dent below a ball; the strain is the deeper the dent.
Sample block() {
  const KnotVector wide = KnotVector::uniform(2, 40), high = KnotVector::uniform(2, 20);
  Sample sample{samples::modelOf(refined(box({-2, -2, -2}, {4, 2, 4}), {wide, high, wide})), {}};
  sample.model.title = "Block with a dent";
  sample.model.tools = {{"ball", Sphere{{0.0, 0.6, 0.0}, 1.0}}};
  const Eigen::MatrixXd& x = sample.model.mesh.patches.front().points;
  const Eigen::RowVectorXd dent =
      (-2.0 * x.colwise().squaredNorm().array() + 2.0 * x.row(1).array()).exp().matrix();
  sample.frame.displacement = Eigen::MatrixXd::Zero(3, x.cols());
  sample.frame.displacement.row(1) = -0.4 * dent;
  sample.frame.toolDisplacement = Eigen::MatrixXd::Zero(3, 1);
  sample.frame.fields["plastic_strain"] = {{}, "", dent};
  return sample;
}

void contour(benchmark::State& state, const Sample& sample, std::optional<int> subdivision = {}) {
  const auto file =
      std::filesystem::temp_directory_path() / ("burnish_bench_" + std::to_string(::getpid()) + ".png");
  ContourOptions options;
  options.field = "plastic_strain";
  options.subdivision = subdivision;
  options.size = {static_cast<int>(state.range(0)), static_cast<int>(state.range(1))};
  for (auto _ : state) drawContour(sample.model, sample.frame, options, file);
  std::filesystem::remove(file);
}

void slabContour(benchmark::State& state) {
  static const Sample sample = slab();
  contour(state, sample);
}

const Sample& theBlock() {
  static const Sample sample = block();
  return sample;
}

void blockContour(benchmark::State& state) {
  contour(state, theBlock());
}

void millionContour(benchmark::State& state) {
  contour(state, theBlock(), 6);
}

BENCHMARK(slabContour)->Name("first")->Args({1600, 900})->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(slabContour)->Name("further")->Args({1600, 900})->Args({960, 480})->Unit(benchmark::kMillisecond);
BENCHMARK(blockContour)->Name("space")->Args({1600, 900})->Unit(benchmark::kMillisecond);
BENCHMARK(millionContour)->Name("million_triangles")->Args({1600, 900})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace burnish
