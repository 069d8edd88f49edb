#pragma once
#include <string>
#include <vector>

namespace burnish {

/// What became of one picture or field.
enum class JunitOutcome { Passed, Failed, Error };

struct JunitCase {
  std::string name;
  JunitOutcome outcome = JunitOutcome::Passed;
  std::string verdict, message;  ///< type and text of a failure or an error
};

/// JUnit XML with one suite, which CI services show as a list of tests.
std::string junitText(const std::string& suite, const std::vector<JunitCase>& cases);

}  // namespace burnish
