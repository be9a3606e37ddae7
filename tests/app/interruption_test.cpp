#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>

#include "tests/app/scantrove_program.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// Waits until `condition` holds. False: the child ended, or three minutes passed.
template <class Condition>
bool waitUntil(ChildProcess& child, Condition&& condition) {
  const auto end = std::chrono::steady_clock::now() + 180s;
  while (std::chrono::steady_clock::now() < end) {
    if (condition()) return true;
    if (!child.isRunning()) return false;
    std::this_thread::sleep_for(50ms);
  }
  return false;
}

std::size_t objectsIn(const fs::path& database) {
  const Finished run = scantrove({"objects", "list", "--json", "--database", database});
  if (run.exit_code != 0) return 0;
  return nlohmann::json::parse(run.out).size();
}

TEST(Interruption, StoppedScanWritesItsResults) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    ChildProcess child(command({"scan", "demo", "--out", folder / "out"}));
    // The first progress line shows that frames are being processed.
    ASSERT_TRUE(waitUntil(child, [&] { return child.err().find(" fps") != std::string::npos; }))
        << child.err();
    child.kill(signal);
    EXPECT_EQ(child.wait(), 0) << child.err();
    const auto report = nlohmann::json::parse(readText(folder / "out/report.json"), nullptr, false);
    ASSERT_TRUE(report.is_object());
    EXPECT_GT(report["frames"]["read"], 0);
    EXPECT_TRUE(fs::exists(folder / "out/trajectory.txt"));
    EXPECT_TRUE(fs::exists(folder / "out/cloud.ply"));
    EXPECT_NE(child.out().find("results"), std::string::npos);
  }
}

bool catches(const ChildProcess& child, int signal) {
  const std::string status = readText("/proc/" + std::to_string(child.pid()) + "/status");
  const std::size_t at = status.find("SigCgt:");
  if (at == std::string::npos) return false;
  return (std::stoull(status.substr(at + 7), nullptr, 16) >> static_cast<unsigned>(signal - 1) & 1U) != 0;
}

// The search for OpenCL drivers blocks on a pipe without a writer.
TEST(Interruption, FirstSignalEndsScan_WhenItHangsBeforeItsFirstFrame) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "drivers");
    const fs::path pipe = folder / "drivers/stuck.icd";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    ChildProcess child(command({"scan", "demo", "--out", folder / "out"}),
                       {{"OCL_ICD_VENDORS", (folder / "drivers").string() + "/"}});
    ASSERT_TRUE(waitUntil(child, [&] { return catches(child, signal); })) << child.err();
    child.kill(signal);
    EXPECT_EQ(child.wait(60s), 128 + signal);
    EXPECT_NE(child.err().find("Stopped before"), std::string::npos) << child.err();
  }
}

// When a terminal closes, stdout and stderr lose their reader.
TEST(Interruption, ScanWritesItsResults_WhenItsOutputIsClosed) {
  const TemporaryFolder folder;
  const Finished run =
      runProgram({"sh", "-c",
                  "(" SCANTROVE_BINARY " scan demo --frames 3 --out " + (folder / "out").string() +
                      "; echo $? > " + (folder / "code").string() + ") 2>&1 | true"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(readText(folder / "code"), "1\n");  // the summary could not be printed
  EXPECT_TRUE(fs::exists(folder / "out/report.json"));
  EXPECT_TRUE(fs::exists(folder / "out/trajectory.txt"));
}

TEST(Interruption, KilledScanKeepsCommittedObjects) {
  const TemporaryFolder folder;
  const fs::path database = folder / "out/catalogue.sqlite";
  std::size_t committed = 0;
  {
    ChildProcess child(command({"scan", "demo", "--out", folder / "out"}));
    ASSERT_TRUE(waitUntil(child, [&] {
      if (!fs::exists(database)) return false;
      std::this_thread::sleep_for(300ms);
      committed = objectsIn(database);
      return committed > 0;
    })) << child.err();
    child.kill(SIGKILL);
    EXPECT_EQ(child.wait(), 128 + SIGKILL);
  }
  EXPECT_GE(objectsIn(database), committed);
  EXPECT_FALSE(fs::exists(folder / "out/report.json"));
  const auto objects = jsonOf(scantrove({"objects", "list", "--json", "--database", database}));
  for (std::size_t i = 0; i < std::min<std::size_t>(objects.size(), 3); ++i) {
    const auto& object = objects[i];
    const auto shown = jsonOf(scantrove(
        {"objects", "show", "--json", "--database", database, std::to_string(object["id"].get<int>())}));
    EXPECT_GE(shown["views"].size(), 1U);
  }

  // The catalogue can be edited and used by another scan.
  const std::string name = objects[0]["name"];
  EXPECT_EQ(scantrove({"objects", "rename", "--database", database, name, "my mug"}).exit_code, 0);
  EXPECT_EQ(
      jsonOf(scantrove({"objects", "confirm", "--json", "--database", database, "my mug"}))["confirmed"],
      true);
  EXPECT_EQ(scantrove({"scan", "demo", "--frames", "3", "--out", folder / "out"}).exit_code, 0);
  EXPECT_EQ(jsonOf(scantrove({"objects", "show", "--json", "--database", database, "my mug"}))["name"],
            "my mug");
}

TEST(Bench, ReportsStagesAndQuartersOfTheScan) {
  const auto json = jsonOf(scantrove({"bench", "demo", "--frames", "8", "--json"}));
  EXPECT_EQ(json["frames"], 8);
  EXPECT_GT(json["fps"], 0);
  EXPECT_GT(json["peak_memory_mb"], 0);
  ASSERT_FALSE(json["stages"].empty());
  double share = 0;
  for (const auto& stage : json["stages"]) share += stage["share"].get<double>();
  EXPECT_NEAR(share, 1, 1e-6);
  ASSERT_FALSE(json["quarters"].empty());
  // Two of the eight frames per quarter; the map grows.
  EXPECT_EQ(json["quarters"].size(), 4U);
  EXPECT_EQ(json["quarters"].back()["to_frame"], 8);
  EXPECT_GE(json["quarters"].back()["bricks"], json["quarters"].front()["bricks"]);
  for (const auto& quarter : json["quarters"]) {
    const auto& stage_medians = quarter["stage_median_ms"];
    EXPECT_EQ(stage_medians.size(), json["stages"].size());
    EXPECT_GT(stage_medians["raycast"], 0);
    EXPECT_LE(stage_medians["raycast"], quarter["frame_median_ms"]);
  }
}

}  // namespace
}  // namespace scantrove::test
