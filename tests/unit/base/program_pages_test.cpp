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

int written = 1;  // by the test: not what the program's file says

TEST(ProgramPages, LeaveMemoryAndWhatWasWrittenStays) {
  const long before_kB = mappedFiles_kB();
  if (before_kB == 0) GTEST_SKIP() << "this system does not say how much of files is in memory";
  written = 7;
  releaseProgramPages();
  EXPECT_LT(mappedFiles_kB(), before_kB * 3 / 4) << "what reads this file has come back, and little else";
  EXPECT_EQ(written, 7);
}

}  // namespace
}  // namespace scantrove
