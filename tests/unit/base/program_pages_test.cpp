#include "core/base/program_pages.h"

#include <gmock/gmock.h>

#include <fstream>
#include <string>

namespace scantrove {
namespace {

/// Kilobytes of files that this process has mapped and in memory; 0 where the system does not say.
long mappedFiles_kB() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    long kilobytes = 0;
    if (word == "RssFile:" && status >> kilobytes) return kilobytes;
  }
  return 0;
}

TEST(ProgramPages, LeaveMemoryAndComeBackWhenTheyRun) {
  const long before_kB = mappedFiles_kB();
  if (before_kB == 0) GTEST_SKIP() << "this system does not say how much of files is in memory";
  releaseProgramPages();
  EXPECT_LT(mappedFiles_kB(), before_kB) << "what reads this file has come back, and little else";
  std::string text;  // the library's and the test's own code still run, and find their constants
  for (int i = 0; i < 3; ++i) text += std::to_string(i) + ", ";
  EXPECT_EQ(text, "0, 1, 2, ");
}

TEST(ProgramPages, MayLeaveAgainAndAgain) {
  for (int i = 0; i < 20; ++i) releaseProgramPages();
  EXPECT_EQ(std::stoi("42"), 42);
}

}  // namespace
}  // namespace scantrove
