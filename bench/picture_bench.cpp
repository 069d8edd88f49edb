// Contour pictures of the ironing problem (49 x 25 functions, 4 x 4 cells per knot span) on one core: the
// first of a process, which makes the GL context and compiles shaders, and further ones, alike or of another
// size.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "engine/analysis/frames.h"
#include "engine/analysis/model.h"
#include "engine/scene/reader.h"
#include "postproc/draw/contour.h"

namespace burnish {
namespace {

/// A bump of plastic strain in the undeformed slab: a picture takes as long for any field.
struct Sample {
  ModelRecord model;
  FrameRecord frame;

  Sample() {
    const Scene scene = readScene(std::string(BURNISH_SOURCE_DIR) + "/scenes/paper/plastic.yaml");
    model = makeModelRecord(scene, Model<2>(scene));
    frame.displacement = Eigen::MatrixXd::Zero(2, model.numNodes);
    frame.toolDisplacement = Eigen::MatrixXd::Zero(2, static_cast<Eigen::Index>(model.tools.size()));
    const auto x = model.patches.front().points.row(0).array();
    frame.fields["plastic_strain"] = {{}, "", (-(x - 1.5).square()).exp().matrix()};
  }
};

void contour(benchmark::State& state) {
  static const Sample sample;
  const auto file =
      std::filesystem::temp_directory_path() / ("burnish_bench_" + std::to_string(::getpid()) + ".png");
  ContourOptions options;
  options.field = "plastic_strain";
  options.size = {static_cast<int>(state.range(0)), static_cast<int>(state.range(1))};
  for (auto _ : state) drawContour(sample.model, sample.frame, options, file);
  std::filesystem::remove(file);
}

BENCHMARK(contour)->Name("first")->Args({1600, 900})->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(contour)->Name("further")->Args({1600, 900})->Args({960, 480})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace burnish
