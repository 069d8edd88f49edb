#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/model.h"
#include "engine/analysis/pass_watch.h"
#include "engine/analysis/peak_contact.h"
#include "engine/analysis/run_history.h"
#include "engine/analysis/tip_watch.h"
#include "engine/analysis/tool_watch.h"
#include "engine/results/doubts.h"
#include "engine/tools/tool_path.h"

namespace burnish::inline analysis {

/// Watches, state by state, for what makes the results of a run doubtful.
template <int Dim>
class DoubtWatch {
 public:
  /// Scene and model must outlive the object.
  DoubtWatch(const Scene& scene, const Model<Dim>& model);

  /// Takes in the state that the history has just taken in and the terms have been evaluated at.
  /// unstableDirections: counts them, see `Inertia`; called where they tell something.
  void update(const RunHistory<Dim>& history, const std::function<int()>& unstableDirections);

  /// The run ends with the current state.
  void noteEnd(const RunHistory<Dim>& history);

  /// A new mesh was due, and none was found.
  void noteFailedRezoning() { needsNewMesh_ = true; }

  /// Goes on with the doubts about a run of the same scene on another mesh.
  void continueFrom(const DoubtWatch& before);

  /// The conditions that held at some time, with how badly.
  std::vector<DoubtRecord> records() const;

  /// Names of the tools with contact pairs that nothing has touched so far.
  std::vector<std::string> idleTools() const;

  void archive(StateArchive& archive);

 private:
  void note(Condition condition, bool holds, double time, double value = 0.0);
  void watchContacts(const RunHistory<Dim>& history);
  void watchPaths(double time);
  void watchWork(const RunHistory<Dim>& history);
  void watchTools(const StateQuantities& current, const Eigen::VectorXd& x);
  std::vector<DoubtRecord> peakRecords() const;
  bool hasLostResolution(const ContactPair<Dim>& pair) const;
  bool needsNewMesh(const FacePlace& place) const;

  const Model<Dim>& model_;
  SceneTraits scene_;
  const ModelBody<Dim>* rezoned_;               ///< the body that is meshed anew; null for none
  std::vector<std::optional<ToolPath>> paths_;  ///< per tool
  std::vector<PassWatch> passes_;               ///< the same, of tools with a path and a contact
  std::vector<PeakContact> peaks_;              ///< per contact with a tool, then per pair of faces
  ToolWatch<Dim> toolWatch_;
  TipWatch<Dim> tipWatch_;
  std::array<Doubt, kConditions> doubts_{};
  std::vector<Doubt> toolDoubts_;  ///< one for each tool and face that `ToolWatch` watches
  std::vector<Doubt> tipDoubts_;   ///< one for each contact pair
  std::vector<FoundTip> tips_;     ///< the first ones
  std::vector<bool> touched_;      ///< per tool
  bool needsNewMesh_ = false;      ///< since a rezoning that failed; that of the next mesh begins anew
};

}  // namespace burnish::inline analysis
