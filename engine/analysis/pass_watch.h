#pragma once
#include <string>

#include "engine/core/state_archive.h"
#include "engine/results/doubts.h"
#include "engine/tools/tool_path.h"

namespace burnish::inline analysis {

/// Watches, state by state, whether a tool on a path touches the body in each of its passes, and is off it when it has been
/// lifted.
class PassWatch {
 public:
  /// Takes in whether the tool is in touch at a time.
  void update(const ToolPath& path, double time, bool touches);

  /// The states of passes, of those that are done, in which the tool was in touch at no time.
  const Doubt& doubt() const { return doubt_; }

  /// The states in which the tool, lifted by its clearance, was in touch.
  const Doubt& heldDoubt() const { return held_; }

  /// "2 of 3 passes"
  std::string passText(const ToolPath& path) const;

  void archive(StateArchive& archive);

 private:
  int pass_ = -1;          ///< that the last state was in; -1: none
  double lastTime_ = 0.0;  ///< of it
  bool touched_ = false;
  int states_ = 0, idle_ = 0;  ///< of this pass; passes that are done without touch
  Doubt doubt_, held_;
};

}  // namespace burnish::inline analysis
