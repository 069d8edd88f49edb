#include "engine/core/directory_lock.h"

#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <utility>

#include "engine/core/error.h"
#include "tests/engine/analysis/run_scene.h"

namespace {

int lockProblem = 0;  ///< errno of every call of flock; 0: the system answers

}  // namespace

/// Stands before that of the C library.
extern "C" int flock(int descriptor, int operation) noexcept {
  if (lockProblem == 0) return static_cast<int>(::syscall(SYS_flock, descriptor, operation));
  errno = lockProblem;
  return -1;
}

namespace burnish {
namespace {

using Children = DirectoryLock::Children;

TEST(DirectoryLock, IsHadByOneAtATimeAndGivenBack) {
  const test::ScratchDirectory directory("lock");
  {
    const DirectoryLock lock(directory.path() / "made", Children::LetGo, "taken");
    EXPECT_TRUE(lock.protects());
    try {
      const DirectoryLock second(directory.path() / "made", Children::Keep, "taken by another");
      ADD_FAILURE() << "two have the lock";
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), "taken by another");
    }
  }
  EXPECT_TRUE(DirectoryLock(directory.path() / "made", Children::Keep, "taken").protects());
}

TEST(DirectoryLock, WhatItMadeGoesWithItUnlessSomethingIsThere) {
  const test::ScratchDirectory directory("lock");
  const auto made = directory.path() / "out" / "study";
  { const DirectoryLock lock(made, Children::LetGo, "taken"); }
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "out"));
  std::filesystem::create_directories(directory.path() / "out");
  {
    DirectoryLock lock(made, Children::LetGo, "taken");
    const DirectoryLock moved = std::move(lock);
    EXPECT_TRUE(std::filesystem::exists(made));
  }
  EXPECT_FALSE(std::filesystem::exists(made));
  EXPECT_TRUE(std::filesystem::exists(directory.path() / "out"));
  {
    const DirectoryLock lock(made, Children::LetGo, "taken");
    std::ofstream(made / "runs.csv") << "name";
  }
  EXPECT_TRUE(std::filesystem::exists(made / "runs.csv"));
}

TEST(DirectoryLock, FileSystemsWithoutLocksAreNotTakenForAnotherProcess) {
  const test::ScratchDirectory directory("no_locks");
  for (const int problem : {ENOLCK, EOPNOTSUPP, EINVAL, ENOSYS}) {
    lockProblem = problem;
    EXPECT_FALSE(DirectoryLock(directory.path(), Children::Keep, "taken").protects()) << problem;
  }
  lockProblem = EWOULDBLOCK;
  EXPECT_THROW(DirectoryLock(directory.path(), Children::Keep, "taken"), Error);
  lockProblem = 0;
}

TEST(DirectoryLock, SaysWhyADirectoryCannotBeMade) {
  const test::ScratchDirectory directory("lock_place");
  std::filesystem::create_directories(directory.path());
  const std::filesystem::path file = directory.path() / "file";
  ASSERT_TRUE(std::ofstream(file).good());
  EXPECT_THROW(DirectoryLock(file / "below", Children::Keep, "taken"), Error);
}

}  // namespace
}  // namespace burnish
