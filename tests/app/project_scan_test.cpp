#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/app/scantrove_program.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

/// A project, and a list of two demos and a recording that is missing.
class ProjectScanTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(scantrove({"project", "create", project_}).exit_code, 0);
    list_ = folder_.write("lists/all.txt", "# two demos\ndemo:tabletop:1\nmissing\ndemo:tabletop:2\n");
  }

  [[nodiscard]] std::vector<std::string> scanList(const std::vector<std::string>& options) const {
    std::vector<std::string> words =
        command({"project", "scan", project_, "--list", list_, "--frames", frames_, "--skip-refinement"});
    words.insert(words.end(), options.begin(), options.end());
    return words;
  }

  [[nodiscard]] nlohmann::json scans() const {
    return jsonOf(scantrove({"project", "list", project_, "--json"}));
  }

  /// Each demo has one scan, which read each frame of its source once.
  void expectEachDemoOnce() const {
    std::vector<std::string> sources;
    for (const auto& scan : scans()) {
      sources.push_back(scan["source"].get<std::string>());
      EXPECT_EQ(scan["frames"], std::stoi(frames_)) << sources.back();
    }
    std::ranges::sort(sources);
    EXPECT_EQ(sources, (std::vector<std::string>{"demo:tabletop:1", "demo:tabletop:2"}));
    const Finished again = runProgram(scanList({"--json"}));
    const auto summary = nlohmann::json::parse(again.out, nullptr, false);
    ASSERT_TRUE(summary.is_object()) << again.out;
    EXPECT_EQ(summary["skipped"], 2);
    EXPECT_EQ(summary["done"], 0);
  }

  /// Waits until `child` says `text` on stderr.
  static bool waitFor(ChildProcess& child, const std::string& text) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(3);
    while (std::chrono::steady_clock::now() < end && child.isRunning()) {
      if (child.err().find(text) != std::string::npos) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }

  TemporaryFolder folder_;
  std::string project_ = folder_ / "project";
  std::string list_;
  std::string frames_ = "40";  ///< enough to interrupt a scan
};

TEST_F(ProjectScanTest, ScansEachOnce_WhenInterruptedAndStartedAgain) {
  {
    ChildProcess child(scanList({"--jobs", "2"}));
    ASSERT_TRUE(waitFor(child, " fps")) << child.err();
    child.kill(SIGINT);
    child.wait();
    EXPECT_NE(child.err().find("Stopping all scans"), std::string::npos) << child.err();
  }
  const Finished second = runProgram(scanList({"--jobs", "2", "--json"}));
  EXPECT_EQ(second.exit_code, 1) << second.err;  // one recording is missing
  const auto summary = nlohmann::json::parse(second.out, nullptr, false);
  ASSERT_TRUE(summary.is_object()) << second.out;
  EXPECT_EQ(summary["failed"], 1);
  EXPECT_EQ(summary["done"].get<int>() + summary["skipped"].get<int>(), 2);
  ASSERT_EQ(summary["recordings"].size(), 3U);
  EXPECT_EQ(summary["recordings"][1]["outcome"], "failed");
  EXPECT_NE(summary["recordings"][1]["reason"].get<std::string>().find("lists/missing"), std::string::npos);
  expectEachDemoOnce();
}

TEST_F(ProjectScanTest, ScansEachOnce_WhenTwoProgramsShareAList) {
  frames_ = "12";
  ChildProcess first(scanList({})), second(scanList({}));
  EXPECT_LE(first.wait(), 1);
  EXPECT_LE(second.wait(), 1);
  // A recording that the other program scanned when this one came to it was skipped.
  EXPECT_NE(first.out().find("of 3"), std::string::npos);
  EXPECT_NE(second.out().find("of 3"), std::string::npos);
  expectEachDemoOnce();
}

TEST_F(ProjectScanTest, NamesAKilledScan_AndContinuesWithTheOthers) {
  {
    ChildProcess child(scanList({"--jobs", "2", "--json"}));
    ASSERT_TRUE(waitFor(child, " fps")) << child.err();
    const std::string process = std::to_string(child.pid());
    std::istringstream children(readText("/proc/" + process + "/task/" + process + "/children"));
    pid_t scan = 0;
    if (!(children >> scan)) GTEST_SKIP() << "This kernel does not list the children of a process.";
    kill(scan, SIGKILL);
    EXPECT_EQ(child.wait(), 1);
    const auto summary = nlohmann::json::parse(child.out(), nullptr, false);
    ASSERT_TRUE(summary.is_object()) << child.out();
    EXPECT_EQ(summary["done"], 1);
    EXPECT_EQ(summary["failed"], 2);
    EXPECT_NE(child.out().find("signal 9"), std::string::npos);
  }
  EXPECT_EQ(runProgram(scanList({})).exit_code, 1);
  expectEachDemoOnce();
}

TEST_F(ProjectScanTest, TakesItsShareOfTheList) {
  frames_ = "12";
  const Finished run = runProgram(scanList({"--task", "3/3", "--json"}));
  const auto summary = jsonOf(run);
  ASSERT_EQ(summary["recordings"].size(), 1U);
  EXPECT_EQ(summary["recordings"][0]["source"], "demo:tabletop:2");
  EXPECT_EQ(summary["done"], 1);
  expectWrongUsage(runProgram(scanList({"--task", "4/3"})), {"--task", "4/3"});
}

TEST_F(ProjectScanTest, ScansAnotherPartOfARecording_AsAnotherScan) {
  const auto scanPart = [&](const std::vector<std::string>& part) {
    std::vector<std::string> words = {"project",           "scan",  project_, "demo:tabletop:1",
                                      "--skip-refinement", "--json"};
    words.insert(words.end(), part.begin(), part.end());
    return jsonOf(scantrove(words));
  };
  EXPECT_EQ(scanPart({"--frames", "3"})["done"], 1);
  EXPECT_EQ(scanPart({"--start", "5", "--frames", "2"})["done"], 1);
  EXPECT_EQ(scanPart({"--start", "5", "--frames", "2"})["skipped"], 1) << "this part is scanned";
  std::vector<std::string> parts;
  for (const auto& scan : scans()) parts.push_back(scan["part"].get<std::string>());
  std::ranges::sort(parts);
  EXPECT_EQ(parts, (std::vector<std::string>{"3 frames", "from frame 5, 2 frames"}));
}

TEST_F(ProjectScanTest, IsRefused_WithoutSourcesOrList) {
  expectWrongUsage(scantrove({"project", "scan", project_}), {"SOURCE", "--list"});
  expectWrongUsage(scantrove({"project", "scan", project_, "--list", folder_ / "none"}), {"--list", "none"});
}

}  // namespace
}  // namespace scantrove::test
