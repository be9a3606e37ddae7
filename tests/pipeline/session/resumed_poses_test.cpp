#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "core/database/database_connection.h"
#include "core/fusion/stored_page.h"
#include "core/labeling/kernels/label_voxel.h"
#include "core/session/session_store.h"
#include "tests/support/scan_runner.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

struct RecordingCase {
  std::string source;
  int stride, stopped, frames;  // frames: of the uninterrupted scan
};
std::ostream& operator<<(std::ostream& out, const RecordingCase& recording) {
  return out << recording.source;
}

ScanRequest partOf(const RecordingCase& recording, const std::filesystem::path& folder, int first, int last) {
  ScanRequest request;
  request.source = recording.source;
  request.source_options.start = first * recording.stride;
  request.source_options.stride = recording.stride;
  request.source_options.frames = last - first;
  request.output_folder = folder;
  request.database = (folder.parent_path() / (folder.filename().string() + ".sqlite")).string();
  request.results = false;
  request.resume = first > 0;
  return request;
}

/// To the last frame, without the refinement, which begins when all poses and distances are stored. The first
/// part of an interrupted scan has its refinement, so that scans are resumed after one.
ScanRequest lastPartOf(const RecordingCase& recording, const std::filesystem::path& folder, int first) {
  ScanRequest request = partOf(recording, folder, first, recording.frames);
  request.skip_refinement = true;
  return request;
}

/// Contents of a session: poses by frame, map pages by position.
struct SessionContents {
  std::map<int, std::vector<double>> poses;
  std::map<std::vector<int>, StoredPage> pages;
  std::map<FragmentId, int> voxels;  // of fragments that belong to a region
};

SessionContents contentsOf(const std::filesystem::path& folder) {
  SessionContents contents;
  const QtMainThread qt;
  const auto store = SessionStore::open(folder);
  EXPECT_TRUE(store) << store.error().message();
  if (!store) return contents;
  const Result<SavedScan> scan = (*store)->load();
  EXPECT_TRUE(scan) << scan.error().message();
  if (!scan) return contents;
  for (const SavedFrame& frame : scan->frames) {
    const auto& T = frame.T_world_camera.matrix();
    if (frame.isUsable()) contents.poses[frame.source_index] = {T.data(), T.data() + T.size()};
  }
  for (const SavedFragment& one : scan->fragments) {
    if (one.region) contents.voxels[one.fragment] = one.voxels;
  }
  for (const Eigen::Vector3i& position : scan->pages) {
    const auto words = (*store)->loadPage(position);
    const auto page = words ? StoredPage::fromWords(*words) : std::nullopt;
    EXPECT_TRUE(page) << position.transpose();
    if (page) contents.pages[{position.x(), position.y(), position.z()}] = *page;
  }
  return contents;
}

/// The depth of the wall constrains one of three directions of motion, so poses depend on earlier frames. In
/// the second recording a person walks through the view. The third one has poses of a device.
class ResumedPosesTest : public testing::TestWithParam<RecordingCase> {};

TEST_P(ResumedPosesTest, EqualThoseOfAnUninterruptedScan) {
  const RecordingCase& recording = GetParam();
  const TemporaryFolder folder;
  ASSERT_TRUE(runScan(lastPartOf(recording, folder / "uninterrupted", 0)).report);
  ASSERT_TRUE(runScan(partOf(recording, folder / "parts", 0, recording.stopped)).report);
  ASSERT_TRUE(runScan(lastPartOf(recording, folder / "parts", recording.stopped)).report);

  const SessionContents uninterrupted = contentsOf(folder / "uninterrupted"),
                        parts = contentsOf(folder / "parts");
  EXPECT_EQ(uninterrupted.poses.size(), static_cast<std::size_t>(recording.frames));
  for (const auto& [index, pose] : uninterrupted.poses)
    ASSERT_EQ(parts.poses.at(index), pose) << "frame " << index;
  ASSERT_EQ(parts.pages.size(), uninterrupted.pages.size());
  for (const auto& [position, page] : uninterrupted.pages) {
    ASSERT_TRUE(parts.pages.contains(position));
    const StoredPage& other = parts.pages.at(position);
    const std::string text = testing::PrintToString(position);
    EXPECT_EQ(other.bricks, page.bricks) << text;
    EXPECT_EQ(other.inactive, page.inactive) << text;
    EXPECT_TRUE(other.contents.distances == page.contents.distances) << "other distances in page " << text;
    EXPECT_TRUE(other.contents.weights == page.contents.weights) << "other weights in page " << text;
    EXPECT_TRUE(other.contents.colors == page.contents.colors) << "other colours in page " << text;
  }
}

/// Executes `how` on the session, to make it that of a killed program or of an older version.
void changeSession(const std::filesystem::path& folder, const char* how) {
  const QtMainThread qt;
  const auto database = DatabaseConnection::open((folder / "session.sqlite").string());
  ASSERT_TRUE(database) << database.error().message();
  const auto done = (*database)->execute(how);
  ASSERT_TRUE(done) << done.error().message();
}

std::map<FragmentId, int> labelsOf(const SessionContents& contents) {
  std::map<FragmentId, int> voxels;
  for (const auto& [position, page] : contents.pages) {
    for (const cl_uint label : page.contents.labels) {
      if (LABEL_OF(label) != 0) ++voxels[FragmentId{LABEL_OF(label)}];
    }
  }
  return voxels;
}

// The stored map of a killed scan may be older than its regions: it may have removed fragments and other
// voxel counts.
TEST(KilledSession, MapAndRegionsHaveTheSameFragments_WhenItResumes) {
  const RecordingCase recording{"demo:tabletop:3", 3, 12, 16};
  const TemporaryFolder folder;
  ASSERT_TRUE(runScan(partOf(recording, folder / "scan", 0, recording.stopped)).report);
  const SessionContents before = contentsOf(folder / "scan");
  ASSERT_GE(before.voxels.size(), 2U);
  EXPECT_EQ(labelsOf(before), before.voxels);

  const auto largest =
      std::ranges::max_element(before.voxels, {}, [](const auto& fragment) { return fragment.second; });
  const std::string number = std::to_string(largest->first.value);
  changeSession(folder / "scan", ("DELETE FROM fragments WHERE fragment = " + number).c_str());
  changeSession(folder / "scan", "UPDATE fragments SET voxels = voxels / 2 + 7, row_check = NULL");
  ASSERT_NE(labelsOf(contentsOf(folder / "scan")), contentsOf(folder / "scan").voxels)
      << "the session is inconsistent now";
  ASSERT_TRUE(runScan(partOf(recording, folder / "scan", recording.stopped, recording.frames)).report);
  const SessionContents after = contentsOf(folder / "scan");
  ASSERT_GE(after.voxels.size(), 2U);
  EXPECT_EQ(labelsOf(after), after.voxels);
}

/// Copies of the first part of a scan, which runs once.
class ResumedPosesByKeyFrames : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    ASSERT_TRUE(runScan(partOf(recording(), *folder_ / "first", 0, recording().stopped)).report);
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static RecordingCase recording() { return {"demo:wall", 3, 35, 45}; }
  static std::filesystem::path copyFirstPart(const std::string& name) {
    const std::filesystem::path copy = *folder_ / name;
    std::filesystem::remove_all(copy);
    std::filesystem::copy(*folder_ / "first", copy, std::filesystem::copy_options::recursive);
    return copy;
  }

  inline static std::unique_ptr<TemporaryFolder> folder_;
};

// Without the camera memory, tracking key frames locate the camera.
TEST_F(ResumedPosesByKeyFrames, AreNearThoseOfAnUninterruptedScan) {
  ASSERT_TRUE(runScan(lastPartOf(recording(), *folder_ / "uninterrupted", 0)).report);
  const SessionContents uninterrupted = contentsOf(*folder_ / "uninterrupted");
  for (const char* how : {"DELETE FROM camera", "UPDATE camera SET checksum = checksum + 1",
                          "UPDATE camera SET frame = frame - 1"}) {
    SCOPED_TRACE(how);
    const std::filesystem::path parts = copyFirstPart("parts");
    changeSession(parts, how);
    ASSERT_TRUE(runScan(lastPartOf(recording(), parts, recording().stopped)).report);
    const SessionContents resumed = contentsOf(parts);
    ASSERT_EQ(resumed.poses.size(), uninterrupted.poses.size());
    for (const auto& [index, pose] : uninterrupted.poses) {
      const std::vector<double>& other = resumed.poses.at(index);
      for (std::size_t i = 12; i < 15; ++i) EXPECT_NEAR(other[i], pose[i], 0.002) << "frame " << index;
    }
  }
}

// The camera memory is useless when the camera has moved, and must not mislead it.
TEST_F(ResumedPosesByKeyFrames, AreFoundAtOnce_WhenTheCameraHasMoved) {
  const int stride = recording().stride;
  constexpr int kFirstAgain = 10;
  const std::filesystem::path scan = copyFirstPart("moved");
  const SessionContents before = contentsOf(scan);
  const auto positionOf = [](const std::vector<double>& pose) {
    return Eigen::Vector3d(pose[12], pose[13], pose[14]);
  };
  const auto& target = before.poses.at(kFirstAgain * stride);
  ASSERT_GT((positionOf(target) - positionOf(before.poses.rbegin()->second)).norm(), 0.5)
      << "the camera has moved";

  ScanRequest request = partOf(recording(), scan, kFirstAgain, kFirstAgain + 5);
  request.skip_refinement = true;  // it changes no pose
  const auto again = runScan(request);
  ASSERT_TRUE(again.report);
  EXPECT_EQ(again.report->frames.lost, 0);
  const SessionContents after = contentsOf(scan);
  // Frames seen again are numbered after the last frame.
  const int shift = before.poses.rbegin()->first + 1 - kFirstAgain * stride;
  for (int i = kFirstAgain; i < kFirstAgain + 5; ++i) {
    const auto& pose = after.poses.at(i * stride + shift);
    EXPECT_LT((positionOf(pose) - positionOf(before.poses.at(i * stride))).norm(), 0.005) << "frame " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, ResumedPosesTest,
                         testing::Values(RecordingCase{"demo:wall", 3, 35, 60},
                                         RecordingCase{"demo:moving:3", 2, 30, 45},
                                         RecordingCase{"demo:room:device", 9, 10, 16}));

}  // namespace
}  // namespace scantrove::test
