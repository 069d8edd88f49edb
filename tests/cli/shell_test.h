#pragma once
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/cli/shell.h"

namespace burnish {

/// That a command was refused: code 2, one message with this part, and nothing printed.
inline void expectRefusal(const Outcome& outcome, const std::string& arguments, const std::string& part) {
  EXPECT_EQ(outcome.code, 2) << arguments;
  EXPECT_THAT(outcome.err, testing::AllOf(testing::StartsWith("burnish: "), testing::HasSubstr(part)));
  EXPECT_EQ(outcome.out, "") << arguments;
}

/// A test with a directory of its own, empty at first, for lines of the shell.
class ShellTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    dir = std::filesystem::temp_directory_path() /
          fmt::format("burnish_{}_{}{}", test->test_suite_name(), test->name(), ::getpid());
    std::filesystem::remove_all(dir);
    std::filesystem::create_directories(dir);
  }
  void TearDown() override { std::filesystem::remove_all(dir); }

  std::filesystem::path dir;
};

}  // namespace burnish
