// A disc is pressed into blocks of two moduli, in this process. Fields are read while the runs go on, forces from their results; the
// runs are halted at half of their way.
//
// Usage: press DIRECTORY
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <type_traits>

#include "engine/analysis/run.h"
#include "engine/core/error.h"
#include "engine/results/history.h"
#include "engine/results/result_reader.h"
#include "engine/scene/reader.h"

namespace {

// Names can be written with their room and without.
static_assert(std::is_same_v<burnish::scene::Scene, burnish::Scene>);

burnish::scene::Scene pressed(double modulus) {
  const std::string yaml = fmt::format(
      "geometry: {{shape: rectangle, size: [2, 1], functions: [17, 9]}}\n"
      "material: {{law: neo-hookean, E: {}, nu: 0.3}}\n"
      "supports: [{{face: bottom, fix: [x, y]}}]\n"
      "tools: [{{name: disc, shape: cylinder, center: [1, 1.5], radius: 0.5, motion: {{times: [0, 1], y: [0, -0.1]}}}}]\n"
      "contact: [{{tool: disc, face: top}}]\n"
      "steps: [{{until: 1, count: 20}}]\n"
      "output: {{every: 0.25}}\n",
      modulus);
  return burnish::scene::parseScene(yaml, "pressed block");
}

/// Follows a run: how far it is, and the largest stress of its frames.
class Watch : public burnish::analysis::RunObserver {
 public:
  void onStep(const burnish::analysis::RunProgress& progress) override { time = progress.time; }
  void onFrame(const burnish::results::ModelRecord&, const burnish::results::FrameRecord& frame) override {
    largestStress = std::fmax(largestStress, frame.quadrature.fields.at("von_mises").values.maxCoeff());
  }

  double time = 0.0;
  double largestStress = 0.0;
};

struct Pressed {
  double force = 0.0;
  double stress = 0.0;
};

Pressed press(double modulus, const std::filesystem::path& directory) {
  Watch watch;
  const burnish::analysis::RunOptions options{.halt = [&] { return watch.time >= 0.5; }};
  const burnish::analysis::RunSummary summary =
      burnish::analysis::runScene(pressed(modulus), directory, options, watch);
  const burnish::results::HistoryTable history = burnish::results::readHistory(directory / "history.csv");
  const double force = history.column("disc.fy").back();
  fmt::print("E = {}: {} steps, {} frames, force {:.6f}, largest stress {:.6f}\n", modulus, summary.steps,
             burnish::results::ResultReader(directory).numFrames(), force, watch.largestStress);
  return summary.halted && summary.steps == 10 ? Pressed{force, watch.largestStress} : Pressed{};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path directory = argv[1];
  try {
    const Pressed soft = press(1.0, directory / "soft"), stiff = press(2.0, directory / "stiff");
    // Elastic forces and stresses are proportional to the modulus.
    const bool isProportional =
        std::abs(stiff.force - 2.0 * soft.force) < 1e-6 && std::abs(stiff.stress - 2.0 * soft.stress) < 1e-6;
    return soft.force > 0.0 && soft.stress > 0.0 && isProportional ? 0 : 1;
  } catch (const burnish::core::Error& error) {
    fmt::print(stderr, "press: {}\n", error.what());
    return 2;
  }
}
