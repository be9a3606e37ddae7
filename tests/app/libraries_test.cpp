#include "tests/app/scantrove_program.h"

namespace scantrove::test {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Libraries, NeitherQt5BesideQt6NorTheCodecsOfRareFormatsAreLoaded) {
  const Finished run = runProgram({"ldd", SCANTROVE_BINARY});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("libQt6Core"));  // ldd did look through the libraries
  EXPECT_THAT(run.out, Not(HasSubstr("libQt5")));
  // 100 libraries, 25 MB, which only pictures of rare formats are worth.
  EXPECT_THAT(run.out, Not(HasSubstr("libopencv_imgcodecs")));
  EXPECT_THAT(run.out, Not(HasSubstr("libgdal")));
  EXPECT_THAT(run.out, Not(HasSubstr("not found")));
}

}  // namespace
}  // namespace scantrove::test
