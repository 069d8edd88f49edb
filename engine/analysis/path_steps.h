#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "engine/analysis/model.h"
#include "engine/core/state_archive.h"
#include "engine/results/run_account.h"
#include "engine/scene/scene.h"
#include "engine/tools/tool_path.h"

namespace burnish::inline analysis {

/// Chooses the steps of tools on paths by the half width of their contacts, which is measured when the force of a pass is
/// full for the first time.
class PathSteps {
 public:
  explicit PathSteps(const Scene& scene);

  /// Takes the half widths for which `resolution` makes the meshes of bodies for those of the contacts, as an estimate does.
  void expect(const Scene& scene);

  /// Size of equal steps from one time point to the next, between which no pass begins or ends; that of the scene,
  /// nominal, where nothing asks for smaller ones.
  double size(double from, double to, double nominal) const;

  /// Measures the contacts of the state at time t that are to be measured then.
  template <int Dim>
  void measure(const Model<Dim>& model, double t);

  /// Of the contacts that have been measured.
  std::vector<PathStepsRecord> records() const;

  void archive(StateArchive& archive);

 private:
  struct OfTool {
    std::size_t number;
    ToolPath path;
    double perHalfWidth;
    PathStepsRecord record;

    bool isMeasured() const { return record.halfWidth > 0.0; }
    void setHalfWidth(double halfWidth) {
      record.halfWidth = halfWidth;
      record.longest = perHalfWidth * halfWidth;
    }
  };
  std::vector<OfTool> tools_;
};

}  // namespace burnish::inline analysis
