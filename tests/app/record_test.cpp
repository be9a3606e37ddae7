#include <gtest/gtest.h>

#include <set>

#include "tests/app/recording.h"
#include "tests/app/scantrove_program.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::set<std::string> namesIn(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

/// Frames with at least one file, as "frame-NNNNNN". Expects each to have all `suffixes`.
std::set<std::string> completeFramesIn(const fs::path& folder, const std::vector<std::string>& suffixes) {
  std::set<std::string> frames;
  const std::set<std::string> names = namesIn(folder);
  for (const std::string& name : names) {
    if (name.starts_with("frame-")) frames.insert(name.substr(0, name.find('.')));
  }
  for (const std::string& frame : frames) {
    for (const std::string& suffix : suffixes) EXPECT_TRUE(names.contains(frame + suffix)) << frame << suffix;
  }
  return frames;
}

const std::vector<std::string> kSyntheticSuffixes{".color.png", ".depth.png", ".pose.txt", ".instance.png"};

TEST(Record, WritesARandomSceneWithItsTruth) {
  const TemporaryFolder folder;
  const Finished run = scantrove({"record", "demo:room:3:exact", "--start", "10", "--stride", "5", "--frames",
                                  "3", "--out", folder / "room"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("frames   3"));
  EXPECT_EQ(completeFramesIn(folder / "room", kSyntheticSuffixes),
            (std::set<std::string>{"frame-000010", "frame-000015", "frame-000020"}));

  const auto instances = nlohmann::json::parse(readText(folder / "room/instances.json"));
  EXPECT_EQ(instances[0]["name"], "floor");
  EXPECT_EQ(instances[0]["object"], false);
  EXPECT_GT(instances[0]["extent_m"], 3.0);
  std::set<int> ids;
  for (const auto& instance : instances) ids.insert(instance["id"].get<int>());
  const cv::Mat mask = cv::imread((folder / "room/frame-000010.instance.png").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(mask.type(), CV_16UC1);
  ASSERT_EQ(mask.size(), cv::Size(640, 480));
  std::set<int> seen;
  for (const std::uint16_t id : cv::Mat_<std::uint16_t>(mask)) seen.insert(id);
  EXPECT_GE(seen.size(), 6U);
  for (const int id : seen) EXPECT_TRUE(id == 0 || ids.contains(id)) << id;
}

TEST(Record, WritesWhatScanAndRecordReadBack) {
  const TemporaryFolder folder;
  ASSERT_EQ(scantrove({"record", "demo:tabletop:5", "--frames", "4", "--out", folder / "table"}).exit_code,
            0);
  ASSERT_EQ(scantrove({"record", folder / "table", "--out", folder / "again"}).exit_code, 0);
  for (const char* name : {"frame-000003.depth.png", "frame-000003.color.png"}) {
    const cv::Mat once = cv::imread((folder / "table" / name).string(), cv::IMREAD_UNCHANGED);
    const cv::Mat twice = cv::imread((folder / "again" / name).string(), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(once.size(), twice.size());
    EXPECT_EQ(cv::norm(once, twice, cv::NORM_INF), 0) << name;
  }
  EXPECT_EQ(readText(folder / "table/intrinsic.json"), readText(folder / "again/intrinsic.json"));
  const Finished scan = scantrove({"scan", folder / "table", "--poses", "given", "--out", folder / "out"});
  EXPECT_EQ(scan.exit_code, 0) << scan.err;
  const auto report = nlohmann::json::parse(readText(folder / "out/report.json"));
  EXPECT_EQ(report["frames"]["tracked"], 4);
  const auto ate = jsonOf(scantrove(
      {"evaluate", "trajectory", "--estimate", folder / "out/trajectory.txt", "--truth", folder / "table"}));
  EXPECT_EQ(ate["poses"]["matched"], 4);
  EXPECT_LT(ate["ate_m"]["max"], 1e-4);
}

// 585 585 320 240 stands for the 7-Scenes Kinect with unregistered colour; the colour of a recording is
// registered.
TEST(Record, KeepsRegisteredColorUnchanged) {
  const TemporaryFolder folder;
  ASSERT_EQ(scantrove({"record", "demo:room:exact", "--intrinsics", "585,585,320,240", "--frames", "1",
                       "--out", folder / "room"})
                .exit_code,
            0);
  ASSERT_EQ(scantrove({"record", folder / "room", "--out", folder / "again"}).exit_code, 0);
  const auto color = [&](const char* name) {
    return cv::imread((folder / name / "frame-000000.color.png").string());
  };
  EXPECT_EQ(cv::norm(color("room"), color("again"), cv::NORM_INF), 0);
}

TEST(Record, KeepsTheColorCamera_WhenColorIsNotRegistered) {
  const TemporaryFolder folder;
  ASSERT_EQ(
      scantrove({"record", "demo:tabletop:exact", "--color-registration",
                 "530,531,310,250,-0.03,0.01,0.002,1,-2,0.5", "--frames", "1", "--out", folder / "table"})
          .exit_code,
      0);
  ASSERT_EQ(scantrove({"record", folder / "table", "--out", folder / "again"}).exit_code, 0);
  const auto camera = nlohmann::json::parse(readText(folder / "again/intrinsic.json"));
  const auto once = nlohmann::json::parse(readText(folder / "table/intrinsic.json"))["color_camera"];
  EXPECT_EQ(camera["color_camera"]["intrinsic_matrix"], once["intrinsic_matrix"]);
  for (std::size_t i = 0; i < 16; ++i)
    EXPECT_NEAR(camera["color_camera"]["T_color_depth"][i], once["T_color_depth"][i].get<double>(), 1e-12);
  EXPECT_EQ(camera["color_registered"], false);
  EXPECT_EQ(camera["color_camera"]["intrinsic_matrix"][4], 531);
  EXPECT_NEAR(camera["color_camera"]["T_color_depth"][3], -0.03, 1e-12);
  EXPECT_NEAR(camera["color_camera"]["T_color_depth"][7], 0.01, 1e-12);
}

TEST(Record, WritesDepthInTheGivenScale) {
  const TemporaryFolder folder;
  ASSERT_EQ(scantrove({"record", "demo:tabletop:exact", "--depth-scale", "5000", "--frames", "1", "--out",
                       folder / "fine"})
                .exit_code,
            0);
  EXPECT_NEAR(nlohmann::json::parse(readText(folder / "fine/intrinsic.json"))["depth_scale"], 5000, 1e-9);
  const auto middle = [&](const char* name) {
    return cv::imread((folder / name).string(), cv::IMREAD_UNCHANGED).at<std::uint16_t>(240, 320);
  };
  ASSERT_EQ(
      scantrove({"record", "demo:tabletop:exact", "--frames", "1", "--out", folder / "plain"}).exit_code, 0);
  EXPECT_NEAR(middle("fine/frame-000000.depth.png"), 5 * middle("plain/frame-000000.depth.png"), 3);
}

TEST(Record, WritesNoTruth_OfARealRecording) {
  const TemporaryFolder folder;
  writeRecording(folder / "recording", 2);
  ASSERT_EQ(scantrove({"record", folder / "recording", "--out", folder / "out"}).exit_code, 0);
  EXPECT_EQ(namesIn(folder / "out"),
            (std::set<std::string>{"intrinsic.json", "frame-000000.color.png", "frame-000000.depth.png",
                                   "frame-000000.pose.txt", "frame-000001.color.png",
                                   "frame-000001.depth.png", "frame-000001.pose.txt"}));
}

TEST(Record, RefusesANonEmptyFolder) {
  const TemporaryFolder folder;
  folder.write("full/notes.txt", "mine");
  expectJobFailure(scantrove({"record", "demo", "--frames", "1", "--out", folder / "full"}),
                   {(folder / "full").string(), "not empty"});
  EXPECT_EQ(namesIn(folder / "full"), (std::set<std::string>{"notes.txt"}));
  expectJobFailure(scantrove({"record", folder / "none", "--out", folder / "out"}),
                   {(folder / "none").string()});
}

// Like a full disk in the middle of a frame: no file may grow beyond 20 kB.
TEST(Record, PrintsOneMessageAndKeepsNoPartialFrame_OnAFullDisk) {
  const TemporaryFolder folder;
  const Finished run =
      runProgram({"sh", "-c",
                  "trap '' XFSZ; ulimit -f 40; exec " SCANTROVE_BINARY " record demo --frames 3 --out " +
                      (folder / "out").string()});
  expectJobFailure(run, {"Cannot write", "frame-000000.color.png"});
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_TRUE(completeFramesIn(folder / "out", {}).empty());
}

TEST(Record, KeepsCompleteFrames_AfterCtrlC) {
  const TemporaryFolder folder;
  ChildProcess child(command({"record", "demo:room:2", "--out", folder / "out"}));
  while (child.isRunning() && !fs::exists(folder / "out/frame-000002.depth.png")) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  child.kill(SIGINT);
  EXPECT_EQ(child.wait(), 0) << child.err();
  const auto frames = completeFramesIn(folder / "out", kSyntheticSuffixes);
  EXPECT_GE(frames.size(), 3U);
  EXPECT_LT(frames.size(), 300U);
  EXPECT_THAT(child.out(), HasSubstr("frames   " + std::to_string(frames.size())));
}

}  // namespace
}  // namespace scantrove::test
