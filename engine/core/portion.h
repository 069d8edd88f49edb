#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/core/team.h"

namespace burnish::inline core {

/// Which ranks are handed what each has a part of.
enum class Receivers { All, First };

/// Of so many things, numbered from 0 on, those that a rank of a team keeps what is known of: its own ones, of
/// which every thing is that of one rank, and others that are the same where they are kept as well. Matrices have
/// a column per thing.
class Portion {
 public:
  /// All of them, kept by a process alone.
  explicit Portion(Eigen::Index count = 0) : count_(count) {}

  /// kept: ascending; own: places among those. The team must outlive the object.
  Portion(const Team& team, Eigen::Index count, std::vector<int> kept, std::vector<int> own);

  /// Of all things.
  Eigen::Index count() const { return count_; }

  /// All columns, from those of the things that each rank keeps; to be called by all ranks. A rank that is not to
  /// have them has no columns.
  Eigen::MatrixXd whole(Eigen::MatrixXd here, Receivers receivers) const;

  /// The columns that this rank keeps, of all.
  Eigen::MatrixXd part(Eigen::MatrixXd all) const;

  /// Leaves the values that this rank keeps, of all.
  template <class T>
  void reduce(std::vector<T>& values) const {
    if (team_->isAlone()) return;
    std::vector<T> part;
    part.reserve(kept_.size());
    for (const int thing : kept_) part.push_back(std::move(values[static_cast<std::size_t>(thing)]));
    values = std::move(part);
  }

 private:
  const Team* team_ = &alone();
  Eigen::Index count_;
  std::vector<int> kept_, own_;  ///< empty for a process alone
};

}  // namespace burnish::inline core
