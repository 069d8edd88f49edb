#include "engine/core/reading_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <new>
#include <string>
#include <vector>

#include "engine/core/error.h"

namespace burnish {
namespace {

/// What the one who asks is told; "" where an answer came.
std::string toldBy(ReadingProcess& process, std::int64_t question = 0) {
  try {
    process.ask(question, [](const FillBytes& fill) { receiveText(fill); });
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

ReadingProcess::Send text(const std::string& answer) {
  return [answer](const TakeBytes& take) { send(answer, take); };
}

TEST(ReadingProcess, AnswersOneQuestionAfterTheOther) {
  int asked = 0;
  ReadingProcess process("a.txt", [&asked](std::int64_t question) -> ReadingProcess::Send {
    ++asked;
    return [numbers = std::vector<double>(300'000, static_cast<double>(question * asked))](
               const TakeBytes& take) { send(numbers, take); };
  });
  for (const std::int64_t question : {7, 5}) {
    std::vector<double> answer;
    process.ask(question, [&answer](const FillBytes& fill) { answer = receiveNumbers(fill); });
    EXPECT_EQ(answer, std::vector<double>(300'000, question == 7 ? 7.0 : 10.0));
  }
  EXPECT_EQ(asked, 0) << "it has a memory of its own";
}

TEST(ReadingProcess, WhatItThrowsReachesTheOneWhoAsks) {
  ReadingProcess refusing("a.txt", [](std::int64_t question) {
    if (question == 1) throw Error("a.txt: no");
    return text("yes");
  });
  EXPECT_EQ(toldBy(refusing, 1), "a.txt: no");
  EXPECT_EQ(toldBy(refusing, 2), "") << "it is there for the next question";
  EXPECT_EQ(toldBy(refusing, 1), "a.txt: no");
  ReadingProcess full("a.txt", [](std::int64_t) -> ReadingProcess::Send { throw std::bad_alloc(); });
  for (int time = 0; time < 2; ++time)
    EXPECT_EQ(toldBy(full),
              "a.txt: the file is damaged, or large: its reader needs more than 4 GB of memory");
}

TEST(ReadingProcess, ItsEndIsAMessage) {
  ReadingProcess killed("a.txt", [](std::int64_t) {
    std::raise(SIGKILL);
    return text("");
  });
  for (int time = 0; time < 2; ++time)
    EXPECT_EQ(toldBy(killed), "a.txt is damaged: its reader stopped with signal 9");
  ReadingProcess half("a.txt", [](std::int64_t) -> ReadingProcess::Send {
    return [](const TakeBytes& take) {
      send(std::int64_t{1'000}, take);  // the length of a text that does not follow
      std::raise(SIGKILL);
    };
  });
  EXPECT_EQ(toldBy(half), "a.txt is damaged: its reader stopped with signal 9");
}

TEST(ReadingProcess, KeepsWhatIsPrintedToItself) {
  testing::internal::CaptureStderr();
  ReadingProcess process("a.txt", [](std::int64_t) {
    std::fputs("words of a library\n", stderr);
    std::fflush(stderr);
    return text("fine");
  });
  EXPECT_EQ(toldBy(process), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace burnish
