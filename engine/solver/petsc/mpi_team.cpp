#include "engine/solver/petsc/mpi_team.h"

#include <petscsys.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "engine/solver/petsc/library.h"

namespace burnish::inline solver {
namespace {

/// A rank that has failed alone gives the others so much time to fail, too.
constexpr std::chrono::seconds kPatience{10};

double bytes(std::size_t count) {
  return static_cast<double>(count * sizeof(double));
}

}  // namespace

MpiTeam::MpiTeam() {
  petsc::begin();
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  MPI_Comm_dup(MPI_COMM_WORLD, &end_);
}

// Reduced on one rank, so that all have the same bits.
void MpiTeam::sum(std::span<double> values) const {
  const auto count = static_cast<int>(values.size());
  MPI_Reduce(rank_ == 0 ? MPI_IN_PLACE : values.data(), values.data(), count, MPI_DOUBLE, MPI_SUM, 0,
             MPI_COMM_WORLD);
  if (rank_ != 0) bytesSent_ += bytes(values.size());
  share(values, 0);
}

void MpiTeam::gather(std::span<double> values, const std::vector<int>& begins) const {
  std::vector<int> counts;
  for (std::size_t r = 0; r + 1 < begins.size(); ++r) counts.push_back(begins[r + 1] - begins[r]);
  MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, values.data(), counts.data(), begins.data(), MPI_DOUBLE,
                 MPI_COMM_WORLD);
  bytesSent_ += bytes(static_cast<std::size_t>(counts[static_cast<std::size_t>(rank_)]) *
                      static_cast<std::size_t>(size_ - 1));
}

void MpiTeam::share(std::span<double> values, int from) const {
  MPI_Bcast(values.data(), static_cast<int>(values.size()), MPI_DOUBLE, from, MPI_COMM_WORLD);
  if (rank_ == from) bytesSent_ += bytes(values.size() * static_cast<std::size_t>(size_ - 1));
}

double MpiTeam::bytesSent() const {
  return bytesSent_ + petsc_isend_len + petsc_send_len;
}

std::optional<bool> MpiTeam::meet(bool hasFailed) const {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + kPatience;
  const int mine = rank_ == 0 && hasFailed ? 1 : 0;
  int firstHasFailed = 0, isDone = 0;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(&mine, &firstHasFailed, 1, MPI_INT, MPI_MAX, end_, &request);
  for (MPI_Test(&request, &isDone, MPI_STATUS_IGNORE); isDone == 0;
       MPI_Test(&request, &isDone, MPI_STATUS_IGNORE)) {
    if (hasFailed && Clock::now() > end) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return firstHasFailed != 0;
}

void MpiTeam::abort(int exitCode) const {
  MPI_Abort(MPI_COMM_WORLD, exitCode);
  std::_Exit(exitCode);
}

}  // namespace burnish::inline solver
