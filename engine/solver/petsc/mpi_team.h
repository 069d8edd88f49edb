#pragma once
#include <mpi.h>

#include "engine/core/team.h"

namespace burnish::inline solver {

/// All processes of MPI's world.
class MpiTeam final : public Team {
 public:
  /// Begins MPI.
  MpiTeam();

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  void sum(std::span<double> values) const override;
  void gather(std::span<double> values, const std::vector<int>& begins) const override;
  void share(std::span<double> values, int from) const override;

  /// By these calls and by the library of linear solvers.
  double bytesSent() const override;

  std::optional<bool> meet(bool hasFailed) const override;
  [[noreturn]] void abort(int exitCode) const override;

 private:
  int rank_ = 0, size_ = 1;
  MPI_Comm end_ = MPI_COMM_NULL;  ///< for `meet` alone: others may wait for something else
  mutable double bytesSent_ = 0.0;
};

}  // namespace burnish::inline solver
