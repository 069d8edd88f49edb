#pragma once
#include <string>

namespace burnish {

/// What became of one picture or field, as CI services tell it.
enum class CaseOutcome { Passed, Failed, Error };

struct ComparedCase {
  std::string name;
  CaseOutcome outcome = CaseOutcome::Passed;
  std::string verdict, message;  ///< type and text of a failure or an error
};

}  // namespace burnish
