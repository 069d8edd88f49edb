#pragma once
#include <string>
#include <vector>

namespace burnish {

/// What a support carries at the end of a run, and the most that it had to.
struct ReactionRecord {
  std::string support;         ///< name
  std::string place;           ///< of the support: "bottom", or "bottom of patch rim"
  std::vector<double> force;   ///< of the body on the support, one component per dimension
  std::vector<double> moment;  ///< of that force about the origin: z in two dimensions, x, y, z in three;
                               ///< empty in axisymmetry
  double largest = 0.0;        ///< magnitude of the force, of all states from t = 0 on
  double largestTime = 0.0;
};

/// "force of the body on face bottom: (0, -3.57), largest 3.57 at t = 1"; components that are rounding errors
/// of the largest are shown as 0.
std::string reactionText(const ReactionRecord& reaction);

}  // namespace burnish
