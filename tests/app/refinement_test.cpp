#include <algorithm>
#include <thread>

#include "tests/app/scantrove_program.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::HasSubstr;

std::vector<std::string> argumentsInto(const fs::path& out) {
  return {"scan", "demo:tabletop:7", "--frames", "30", "--out", out};
}

nlohmann::json refinementIn(const fs::path& out) {
  const auto report = nlohmann::json::parse(readText(out / "report.json"), nullptr, false);
  return report.is_object() ? report.value("refinement", nlohmann::json()) : nlohmann::json();
}

TEST(ScanRefinement, IsToldOnStderrAndInTheReport) {
  const TemporaryFolder folder;
  const Finished run = scantrove(argumentsInto(folder / "out"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("Refining objects with "));
  const auto refinement = refinementIn(folder / "out");
  EXPECT_GT(refinement["key_frames"], 0);
  EXPECT_GT(refinement["seconds"], 0);
  EXPECT_EQ(refinement["skipped"], false);
  EXPECT_EQ(jsonOf(scantrove({"session", "show", "--json", folder / "out"}))["refined"], true);
}

TEST(ScanRefinement, IsSkippedAndDoneLater) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments = argumentsInto(folder / "out");
  arguments.push_back("--skip-refinement");
  const Finished run = scantrove(arguments);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, testing::Not(HasSubstr("Refining objects")));
  EXPECT_THAT(run.out, HasSubstr("session refine"));
  EXPECT_EQ(refinementIn(folder / "out")["skipped"], true);
  EXPECT_EQ(jsonOf(scantrove({"session", "show", "--json", folder / "out"}))["refined"], false);

  const auto refined = jsonOf(scantrove({"session", "refine", "--json", folder / "out"}));
  EXPECT_EQ(refined["skipped"], false);
  EXPECT_GT(refined["key_frames"], 0);
  EXPECT_EQ(refinementIn(folder / "out")["skipped"], false);
  EXPECT_EQ(jsonOf(scantrove({"session", "show", "--json", folder / "out"}))["refined"], true);
  const Finished again = scantrove({"session", "refine", folder / "out"});
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.out, HasSubstr("refined already"));
}

TEST(ScanRefinement, CtrlCSkipsTheRestAndKeepsTheResults) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    ChildProcess child(command(argumentsInto(folder / "out")));
    const auto end = std::chrono::steady_clock::now() + 180s;
    while (child.err().find("Refining objects") == std::string::npos && child.isRunning() &&
           std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(20ms);
    child.kill(signal);
    EXPECT_EQ(child.wait(), 0) << child.err();
    EXPECT_THAT(child.err(), HasSubstr("Skipping the rest of the refinement"));
    EXPECT_EQ(refinementIn(folder / "out")["skipped"], true);
    EXPECT_TRUE(fs::exists(folder / "out/cloud.ply"));
    EXPECT_EQ(scantrove({"session", "refine", folder / "out"}).exit_code, 0);
    EXPECT_EQ(refinementIn(folder / "out")["skipped"], false);
  }
}

TEST(SessionRefine, RefusesWhatIsNoScan) {
  const TemporaryFolder folder;
  expectJobFailure(scantrove({"session", "refine", folder / "nothing"}), {"nothing"});
  expectWrongUsage(scantrove({"session", "refine"}), {"DIR"});
}

}  // namespace
}  // namespace scantrove::test
