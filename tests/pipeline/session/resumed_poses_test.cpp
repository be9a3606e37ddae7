#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/scan/open_session.h"
#include "tests/support/scan_session_runner.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

/// A bare wall with posters: depth leaves directions open, so poses rest on what earlier frames have seen.
ScanRequest filmedWall(const std::filesystem::path& folder, int first, int frames) {
  constexpr int kStride = 3;
  ScanRequest request;
  request.source = "demo:wall";
  request.source_options.start = first * kStride;
  request.source_options.stride = kStride;
  request.source_options.frames = frames;
  request.output_folder = folder;
  request.database = (folder.parent_path() / (folder.filename().string() + ".sqlite")).string();
  request.results = false;
  return request;
}

std::map<int, Eigen::Isometry3d> posesOf(const std::filesystem::path& folder) {
  std::map<int, Eigen::Isometry3d> poses;
  const auto session = OpenSession::open(folder);
  EXPECT_TRUE(session) << session.error().message();
  if (!session) return poses;
  for (const SavedFrame& frame : (*session)->frames()) {
    if (frame.isUsable()) poses[frame.source_index] = frame.T_world_camera;
  }
  return poses;
}

TEST(ResumedPoses, AreThoseOfAScanThatNeverStopped) {
  constexpr int kFrames = 60, kStopped = 35;
  const TemporaryFolder folder;
  ASSERT_TRUE(runScan(filmedWall(folder / "whole", 0, kFrames)).report);
  ASSERT_TRUE(runScan(filmedWall(folder / "parts", 0, kStopped)).report);
  ScanRequest rest = filmedWall(folder / "parts", kStopped, kFrames - kStopped);
  rest.resume = true;
  ASSERT_TRUE(runScan(rest).report);

  const auto whole = posesOf(folder / "whole"), parts = posesOf(folder / "parts");
  ASSERT_EQ(whole.size(), static_cast<std::size_t>(kFrames));
  ASSERT_EQ(parts.size(), whole.size());
  double worst_mm = 0;
  for (const auto& [index, pose] : whole) {
    ASSERT_TRUE(parts.contains(index)) << index;
    const double apart_mm = 1000 * (parts.at(index).translation() - pose.translation()).norm();
    worst_mm = std::max(worst_mm, apart_mm);
    EXPECT_LT(apart_mm, 3) << "frame " << index;
  }
  RecordProperty("worst_mm", std::to_string(worst_mm));
}

}  // namespace
}  // namespace scantrove::test
