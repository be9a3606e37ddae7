#include <filesystem>
#include <sstream>

#include "tests/app/scantrove_program.h"
#include "tests/support/source_tree.h"

namespace scantrove::test {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Libraries, ProgramLoadsNoQt5) {
  const Finished run = runProgram({"ldd", SCANTROVE_BINARY});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("libQt6Core"));  // ldd has listed the libraries
  EXPECT_THAT(run.out, Not(HasSubstr("libQt5")));
  EXPECT_THAT(run.out, Not(HasSubstr("not found")));
}

// An empty or relative element would mean the current folder.
TEST(Libraries, RunPathsAreAbsolute_AndRelocationsReadOnly) {
  const Finished run = runProgram({"readelf", "-dW", SCANTROVE_BINARY});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("BIND_NOW"));
  EXPECT_THAT(runProgram({"readelf", "-lW", SCANTROVE_BINARY}).out, HasSubstr("GNU_RELRO"));
  std::istringstream lines(run.out);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("(RPATH)") == std::string::npos && line.find("(RUNPATH)") == std::string::npos) continue;
    const std::size_t open = line.find('[') + 1;
    std::string paths = line.substr(open, line.find(']') - open) + ':';
    for (std::size_t end = 0; (end = paths.find(':')) != std::string::npos; paths.erase(0, end + 1)) {
      const std::string path = paths.substr(0, end);
      EXPECT_TRUE(path.starts_with("/") || path.starts_with("$ORIGIN")) << "'" << path << "'";
    }
  }
}

TEST(Libraries, ProgramIsPositionIndependent) {
  const Finished run = runProgram({"readelf", "-hW", SCANTROVE_BINARY});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("Position-Independent Executable"));
}

TEST(Libraries, ProgramIsBuiltWithStackProtectorAndFortify) {
  const Finished symbols = runProgram({"readelf", "--dyn-syms", "-W", SCANTROVE_BINARY});
  ASSERT_EQ(symbols.exit_code, 0) << symbols.err;
  if (symbols.out.find("__asan_init") != std::string::npos ||
      symbols.out.find("__tsan_init") != std::string::npos)
    GTEST_SKIP() << "sanitizers replace these checks";
  EXPECT_THAT(symbols.out, HasSubstr("__stack_chk_fail"));
  EXPECT_THAT(symbols.out,
              testing::ContainsRegex("__[a-z]+_chk@"));  // FORTIFY's checked read(), memcpy() ...
}

TEST(Libraries, StrippedProgramDoesNotContainTheSourcePath) {
  const TemporaryFolder folder;
  const std::string stripped = folder / "scantrove";
  const Finished run = runProgram({"strip", "-o", stripped, SCANTROVE_BINARY});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(readText(stripped).find(sourceTree().string() + "/"), std::string::npos);
}

}  // namespace
}  // namespace scantrove::test
