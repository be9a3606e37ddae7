#include "tests/app/recording.h"
#include "tests/app/scantrove_program.h"

namespace scantrove::test {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(FirstRun, AnnouncesTheKernelCompilationOnce_WithoutCompilerOutput) {
  const TemporaryFolder folder;
  writeRecording(folder / "recording", 1);
  const std::string cache = folder / "cache";
  std::filesystem::create_directory(cache);
  const auto scan = [&](const char* out) {
    const Finished run = scantrove({"scan", folder / "recording", "--out", folder / out},
                                   {{"POCL_CACHE_DIR", cache}, {"CUDA_CACHE_PATH", cache}});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.err;
  };
  const std::string first = scan("first");
  EXPECT_THAT(first, HasSubstr("Preparing the OpenCL device (once).\n"));
  EXPECT_EQ(first.find("Preparing"), first.rfind("Preparing")) << "printed more than once";
  EXPECT_THAT(first, Not(HasSubstr("generated")));
  EXPECT_THAT(scan("second"), Not(HasSubstr("Preparing")));
}

}  // namespace
}  // namespace scantrove::test
