#include <gmock/gmock.h>

#include "core/capture/trajectory_reader.h"
#include "tests/app/scantrove_program.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// PoCL: the processor as an OpenCL device with 1 GB of memory.
const ChildProcess::Environment kSmallDevice{{"POCL_MEMORY_LIMIT", "1"}, {"SCANTROVE_DEVICE", "pthread"}};

TEST(DeviceMemory, RefusesTooSmallVoxels_AndNamesASizeThatFits) {
  const TemporaryFolder folder;
  const Finished run = scantrove(
      {"scan", "demo", "--frames", "3", "--out", folder / "out", "--set", "fusion.voxel_size_m=0.001"},
      kSmallDevice);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("voxels of 1.0 mm does not fit"));
  EXPECT_THAT(run.err, HasSubstr("--set fusion.voxel_size_m=0.0026"));
  EXPECT_FALSE(fs::exists(folder / "out/report.json"));
}

/// Arguments of a scan whose map exceeds the device's memory.
std::vector<std::string> largeScan(const fs::path& out) {
  std::vector<std::string> words{"scan", "demo:room", "--stride", "10", "--frames", "40", "--poses", "given"};
  words.insert(words.end(), {"--skip-refinement", "--out", out, "--set", "fusion.voxel_size_m=0.0027"});
  return words;
}

TEST(DeviceMemory, MovesPartsOfTheMapToDisk_WhenTheDeviceIsFull) {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  const Finished run = scantrove(largeScan(out), kSmallDevice);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto report = nlohmann::json::parse(readText(out / "report.json"), nullptr, false);
  ASSERT_TRUE(report.is_object());
  EXPECT_EQ(report["frames"]["read"], 40);
  EXPECT_LT(report["map"]["megabytes"], 1024);
  EXPECT_GT(report["map"]["disk_megabytes"], 1);
}

TEST(DeviceMemory, WritesResultsUntilTheFailure_WhenDeviceAndDiskAreFull) {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  ChildProcess::Environment no_disk = kSmallDevice;
  no_disk["TMPDIR"] = (folder / "nowhere").string();
  const Finished run = scantrove(largeScan(out), no_disk);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("No part of the map can be kept in a temporary file in "));
  EXPECT_THAT(run.err, HasSubstr("ran out of memory in frame "));
  EXPECT_THAT(run.err, HasSubstr("--set fusion.voxel_size_m=0.00"));
  const auto report = nlohmann::json::parse(readText(out / "report.json"), nullptr, false);
  ASSERT_TRUE(report.is_object());
  const int frames = report["frames"]["read"];
  EXPECT_GE(frames, 5);
  EXPECT_LT(frames, 40);
  EXPECT_GT(report["regions"], 5);
  const auto trajectory = readTrajectory(out / "trajectory.txt");
  ASSERT_TRUE(trajectory) << trajectory.error().message();
  EXPECT_EQ(static_cast<int>(trajectory->size()), frames);
  EXPECT_GT(fs::file_size(out / "cloud.ply"), 1000000U);
  EXPECT_GT(fs::file_size(out / "cloud.pcd"), 1000000U);
  EXPECT_TRUE(nlohmann::json::parse(readText(out / "labels.json"), nullptr, false).is_object());
}

}  // namespace
}  // namespace scantrove::test
