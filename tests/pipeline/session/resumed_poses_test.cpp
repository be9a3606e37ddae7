#include <gtest/gtest.h>

#include <algorithm>
#include <map>
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

struct Film {
  std::string source;
  int stride, stopped, frames;  // frames of the scan that never stops
};
std::ostream& operator<<(std::ostream& out, const Film& film) { return out << film.source; }

ScanRequest partOf(const Film& film, const std::filesystem::path& folder, int first, int last) {
  ScanRequest request;
  request.source = film.source;
  request.source_options.start = first * film.stride;
  request.source_options.stride = film.stride;
  request.source_options.frames = last - first;
  request.output_folder = folder;
  request.database = (folder.parent_path() / (folder.filename().string() + ".sqlite")).string();
  request.results = false;
  request.resume = first > 0;
  return request;
}

/// What there is of the session, by frame and by place.
struct Kept {
  std::map<int, std::vector<double>> poses;
  std::map<std::vector<int>, StoredPage> pages;
  std::map<FragmentId, int> voxels;  // of the fragments that are part of a region
};

Kept keptIn(const std::filesystem::path& folder) {
  Kept kept;
  const QtMainThread qt;
  const auto store = SessionStore::open(folder);
  EXPECT_TRUE(store) << store.error().message();
  if (!store) return kept;
  const Result<SavedScan> scan = (*store)->load();
  EXPECT_TRUE(scan) << scan.error().message();
  if (!scan) return kept;
  for (const SavedFrame& frame : scan->frames) {
    const auto& T = frame.T_world_camera.matrix();
    if (frame.isUsable()) kept.poses[frame.source_index] = {T.data(), T.data() + T.size()};
  }
  for (const SavedFragment& one : scan->fragments) {
    if (one.region) kept.voxels[one.fragment] = one.voxels;
  }
  for (const Eigen::Vector3i& position : scan->pages) {
    const auto words = (*store)->loadPage(position);
    const auto page = words ? StoredPage::fromWords(*words) : std::nullopt;
    EXPECT_TRUE(page) << position.transpose();
    if (page) kept.pages[{position.x(), position.y(), position.z()}] = *page;
  }
  return kept;
}

/// That of the wall has two of three directions of motion that its depth leaves open: poses rest on what
/// earlier frames have seen. In that of the mover something walks through the view.
class ResumedPoses : public testing::TestWithParam<Film> {};

TEST_P(ResumedPoses, AreToTheLastBitThoseOfAScanThatNeverStopped) {
  const Film& film = GetParam();
  const TemporaryFolder folder;
  ASSERT_TRUE(runScan(partOf(film, folder / "whole", 0, film.frames)).report);
  ASSERT_TRUE(runScan(partOf(film, folder / "parts", 0, film.stopped)).report);
  ASSERT_TRUE(runScan(partOf(film, folder / "parts", film.stopped, film.frames)).report);

  const Kept whole = keptIn(folder / "whole"), parts = keptIn(folder / "parts");
  EXPECT_EQ(whole.poses.size(), static_cast<std::size_t>(film.frames));
  for (const auto& [index, pose] : whole.poses) ASSERT_EQ(parts.poses.at(index), pose) << "frame " << index;
  ASSERT_EQ(parts.pages.size(), whole.pages.size());
  for (const auto& [position, page] : whole.pages) {
    ASSERT_TRUE(parts.pages.contains(position));
    const StoredPage& other = parts.pages.at(position);
    const std::string place = testing::PrintToString(position);
    EXPECT_EQ(other.bricks, page.bricks) << place;
    EXPECT_EQ(other.inactive, page.inactive) << place;
    EXPECT_TRUE(other.contents.distances == page.contents.distances) << "other distances in page " << place;
    EXPECT_TRUE(other.contents.weights == page.contents.weights) << "other weights in page " << place;
    EXPECT_TRUE(other.contents.colors == page.contents.colors) << "other colours in page " << place;
  }
}

/// As a program leaves it that was killed, or (of an older version) does not know of the camera's memory.
void changeSession(const std::filesystem::path& folder, const char* how) {
  const QtMainThread qt;
  const auto database = DatabaseConnection::open((folder / "session.sqlite").string());
  ASSERT_TRUE(database) << database.error().message();
  const auto done = (*database)->execute(how);
  ASSERT_TRUE(done) << done.error().message();
}

std::map<FragmentId, int> labelsOf(const Kept& kept) {
  std::map<FragmentId, int> voxels;
  for (const auto& [position, page] : kept.pages) {
    for (const cl_uint label : page.contents.labels) {
      if (LABEL_OF(label) != 0) ++voxels[FragmentId{LABEL_OF(label)}];
    }
  }
  return voxels;
}

/// The map of a scan that broke off may be older than its regions: it may hold fragments that were given up,
/// and other numbers of voxels.
TEST(BrokenOffSession, ItsMapHoldsTheFragmentsOfItsRegionsAndNoOthersWhenItGoesOn) {
  const Film film{"demo:tabletop:3", 3, 12, 16};
  const TemporaryFolder folder;
  ASSERT_TRUE(runScan(partOf(film, folder / "scan", 0, film.stopped)).report);
  const Kept before = keptIn(folder / "scan");
  ASSERT_GE(before.voxels.size(), 2U);
  EXPECT_EQ(labelsOf(before), before.voxels);

  const auto largest =
      std::ranges::max_element(before.voxels, {}, [](const auto& fragment) { return fragment.second; });
  const std::string number = std::to_string(largest->first.value);
  changeSession(folder / "scan", ("DELETE FROM fragments WHERE fragment = " + number).c_str());
  changeSession(folder / "scan", "UPDATE fragments SET voxels = voxels / 2 + 7, row_check = NULL");
  ASSERT_NE(labelsOf(keptIn(folder / "scan")), keptIn(folder / "scan").voxels) << "the test's own doing";
  ASSERT_TRUE(runScan(partOf(film, folder / "scan", film.stopped, film.frames)).report);
  const Kept after = keptIn(folder / "scan");
  ASSERT_GE(after.voxels.size(), 2U);
  EXPECT_EQ(labelsOf(after), after.voxels);
}

/// Without the memory of the camera the frames that show a place lead back to it.
TEST(ResumedPosesByPlaces, AreNearThoseOfAScanThatNeverStopped) {
  const Film film{"demo:wall", 3, 35, 60};
  const TemporaryFolder folder;
  ASSERT_TRUE(runScan(partOf(film, folder / "whole", 0, film.frames)).report);
  const Kept whole = keptIn(folder / "whole");
  ASSERT_TRUE(runScan(partOf(film, folder / "first", 0, film.stopped)).report);
  for (const char* how : {"DELETE FROM camera", "UPDATE camera SET checksum = checksum + 1",
                          "UPDATE camera SET frame = frame - 1"}) {
    SCOPED_TRACE(how);
    const auto parts = folder / "parts";
    std::filesystem::remove_all(parts);
    std::filesystem::copy(folder / "first", parts, std::filesystem::copy_options::recursive);
    changeSession(parts, how);
    ASSERT_TRUE(runScan(partOf(film, parts, film.stopped, film.frames)).report);
    const Kept kept = keptIn(parts);
    ASSERT_EQ(kept.poses.size(), whole.poses.size());
    for (const auto& [index, pose] : whole.poses) {
      const std::vector<double>& other = kept.poses.at(index);
      for (std::size_t i = 12; i < 15; ++i) EXPECT_NEAR(other[i], pose[i], 0.002) << "frame " << index;
    }
  }
}

/// The memory of a camera that went on is of no use to one that stands elsewhere, and does not mislead it.
TEST(ResumedPosesByPlaces, ACameraThatStandsElsewhereIsFoundAtOnce) {
  const Film film{"demo:wall", 3, 35, 60};
  constexpr int kBack = 10;
  const TemporaryFolder folder;
  ASSERT_TRUE(runScan(partOf(film, folder / "scan", 0, film.stopped)).report);
  const Kept before = keptIn(folder / "scan");
  const auto placeOf = [](const std::vector<double>& pose) {
    return Eigen::Vector3d(pose[12], pose[13], pose[14]);
  };
  const auto& there = before.poses.at(kBack * film.stride);
  ASSERT_GT((placeOf(there) - placeOf(before.poses.rbegin()->second)).norm(), 0.5) << "that is elsewhere";

  const auto again = runScan(partOf(film, folder / "scan", kBack, kBack + 5));
  ASSERT_TRUE(again.report);
  EXPECT_EQ(again.report->frames.lost, 0);
  const Kept after = keptIn(folder / "scan");
  // What is seen again counts on from the last frame.
  const int shift = before.poses.rbegin()->first + 1 - kBack * film.stride;
  for (int i = kBack; i < kBack + 5; ++i) {
    const auto& pose = after.poses.at(i * film.stride + shift);
    EXPECT_LT((placeOf(pose) - placeOf(before.poses.at(i * film.stride))).norm(), 0.005) << "frame " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, ResumedPoses,
                         testing::Values(Film{"demo:wall", 3, 35, 60}, Film{"demo:moving:3", 2, 30, 45}));

}  // namespace
}  // namespace scantrove::test
