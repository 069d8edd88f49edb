#include "engine/core/team.h"

#include <cstdlib>
#include <exception>

#include "engine/core/error.h"

namespace burnish::inline core {
namespace {

class Alone final : public Team {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void sum(std::span<double>) const override {}
  void gather(std::span<double>, const std::vector<int>&) const override {}
  void share(std::span<double>, int) const override {}
  double bytesSent() const override { return 0.0; }
  std::optional<bool> meet(bool hasFailed) const override { return hasFailed; }
  [[noreturn]] void abort(int exitCode) const override { std::exit(exitCode); }
};

}  // namespace

bool Team::all(bool mine) const {
  double others = mine ? 0.0 : 1.0;
  sum({&others, 1});
  return others == 0.0;
}

void Team::first(const std::function<void()>& work) const {
  if (isAlone()) return work();
  static_cast<void>(all(true));
  std::exception_ptr failure;
  if (isFirst()) {
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
  }
  if (all(!failure)) return;
  if (failure) std::rethrow_exception(failure);
  throw Error("the first rank has failed");
}

const Team& alone() {
  static const Alone team;
  return team;
}

}  // namespace burnish::inline core
