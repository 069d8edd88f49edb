#pragma once
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"

namespace burnish::inline core {

/// Something that is wrong with a value of the input.
struct InputProblem {
  std::string path;  ///< of the value, such as `tools[0].carry`
  std::string text;  ///< what was found and what is allowed
};

/// What can be seen only when the input is put to use: knows the paths of the values, but not where they
/// stand in a file.
class InputError : public Error {
 public:
  InputError(const std::string& path, const std::string& text) : InputError({{path, text}}) {}
  explicit InputError(std::vector<InputProblem> problems)
      : Error(lines(problems)), problems_(std::move(problems)) {}

  const std::vector<InputProblem>& problems() const { return problems_; }

 private:
  static std::string lines(const std::vector<InputProblem>& problems) {
    std::string text;
    for (const InputProblem& problem : problems)
      text += (text.empty() ? "" : "\n") + problem.path + ": " + problem.text;
    return text;
  }

  std::vector<InputProblem> problems_;
};

/// Acts; what `Error` it throws becomes an `InputError` at this path.
template <class Act>
void placed(const std::string& path, const Act& act) {
  try {
    act();
  } catch (const InputError&) {
    throw;
  } catch (const Error& error) {
    throw InputError(path, error.what());
  }
}

/// Gathers problems that do not depend on each other, so that a person sees them all at once.
class InputProblems {
 public:
  /// Acts; keeps an `InputError` for later.
  template <class Act>
  void gather(const Act& act) {
    try {
      act();
    } catch (const InputError& error) {
      problems_.insert(problems_.end(), error.problems().begin(), error.problems().end());
    }
  }

  /// Throws one `InputError` if there is any problem.
  void throwIfAny() const {
    if (!problems_.empty()) throw InputError(problems_);
  }

 private:
  std::vector<InputProblem> problems_;
};

}  // namespace burnish::inline core
