#pragma once
#include <algorithm>
#include <barrier>
#include <cstdlib>
#include <functional>
#include <optional>
#include <span>
#include <thread>
#include <vector>

#include "engine/core/team.h"

namespace burnish::test {

/// Ranks that are threads of one process: what they do together, without processes.
class ThreadTeam final : public Team {
 public:
  /// What all of them have in common.
  struct Place {
    explicit Place(int size) : barrier(size), values(static_cast<std::size_t>(size)) {}
    std::barrier<> barrier;
    std::vector<std::span<double>> values;  ///< of each rank
  };

  ThreadTeam(int rank, Place& place) : rank_(rank), place_(place) {}

  int rank() const override { return rank_; }
  int size() const override { return static_cast<int>(place_.values.size()); }

  void sum(std::span<double> values) const override {
    std::vector<double> sums(values.size(), 0.0);
    meetWith(values, [&] {
      for (const auto& others : place_.values)
        std::transform(others.begin(), others.end(), sums.begin(), sums.begin(), std::plus<>());
    });
    std::copy(sums.begin(), sums.end(), values.begin());
  }

  void gather(std::span<double> values, const std::vector<int>& begins) const override {
    meetWith(values, [&] {
      for (int r = 0; r < size(); ++r)
        if (r != rank_)
          for (int k = begins[static_cast<std::size_t>(r)]; k < begins[static_cast<std::size_t>(r) + 1]; ++k)
            values[static_cast<std::size_t>(k)] =
                place_.values[static_cast<std::size_t>(r)][static_cast<std::size_t>(k)];
    });
  }

  void share(std::span<double> values, int from) const override {
    meetWith(values, [&] {
      const auto& others = place_.values[static_cast<std::size_t>(from)];
      if (from != rank_) std::copy(others.begin(), others.end(), values.begin());
    });
  }

  double bytesSent() const override { return 0.0; }
  std::optional<bool> meet(bool) const override { return false; }
  [[noreturn]] void abort(int exitCode) const override { std::exit(exitCode); }

 private:
  /// Shows the values to the others while each looks.
  template <class F>
  void meetWith(std::span<double> values, const F& look) const {
    place_.values[static_cast<std::size_t>(rank_)] = values;
    place_.barrier.arrive_and_wait();
    look();
    place_.barrier.arrive_and_wait();
  }

  int rank_;
  Place& place_;
};

/// Has each of so many ranks work.
inline void asTeam(int size, const std::function<void(const Team&)>& work) {
  ThreadTeam::Place place(size);
  std::vector<std::jthread> threads;
  for (int rank = 0; rank < size; ++rank) threads.emplace_back([&, rank] { work(ThreadTeam(rank, place)); });
}

}  // namespace burnish::test
