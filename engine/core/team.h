#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace burnish::inline core {

/// The processes that compute a run together, its ranks, which may be one alone. All of them run the same
/// program from the same input and come to the same decisions, from numbers of the same bits. What they do
/// together is to be called by all, in the same order.
class Team {
 public:
  virtual ~Team() = default;

  /// From 0 on.
  virtual int rank() const = 0;
  virtual int size() const = 0;
  bool isAlone() const { return size() == 1; }

  /// The rank that writes and prints.
  bool isFirst() const { return rank() == 0; }

  /// The one that has the border of linear systems.
  bool isLast() const { return rank() == size() - 1; }

  /// Sums numbers over all ranks, element by element.
  virtual void sum(std::span<double> values) const = 0;

  /// Completes values of which rank r has those from begins[r] to begins[r + 1].
  virtual void gather(std::span<double> values, const std::vector<int>& begins) const = 0;

  /// Hands the values of one rank to all others.
  virtual void share(std::span<double> values, int from) const = 0;

  bool all(bool mine) const;
  bool any(bool mine) const { return !all(!mine); }

  /// Has the first rank work alone while the others wait. It begins when all have come here, so that they have
  /// read what it may replace. What it throws is thrown to the others, too.
  void first(const std::function<void()>& work) const;

  /// Sent by this rank to others so far.
  virtual double bytesSent() const = 0;

  /// At the end of the program: waits for the other ranks to come here. Returns whether the first one has
  /// failed; none if this one has failed and others are still at work, where they may wait for it for ever.
  virtual std::optional<bool> meet(bool hasFailed) const = 0;

  /// Ends all ranks at once.
  [[noreturn]] virtual void abort(int exitCode) const = 0;
};

/// The numbers of a vector.
template <class Vector>
std::span<double> asSpan(Vector& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

/// A process alone.
const Team& alone();

}  // namespace burnish::inline core
