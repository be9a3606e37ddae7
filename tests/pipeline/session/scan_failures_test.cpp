#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>

#include "core/capture/trajectory_reader.h"
#include "core/session/session_store.h"
#include "tests/pipeline/session/failing_world.h"
#include "tests/pipeline/session/scan_worker_fixture.h"
#include "tests/support/other_program.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;
namespace failing_device = test::failing_device;
using test::OtherProgram;
using testing::AllOf;
using testing::HasSubstr;

/// Scans during which files, the catalogue or the device fail.
class ScanFailuresTest : public test::ScanWorkerTest {
 protected:
  [[nodiscard]] fs::path out() const { return folder_ / "out"; }

  /// Scans `frames` frames and pauses, so that a test can cause a failure.
  void scanAndPause(int frames, ScanRequest request) {
    request.output_folder = out();
    request.start_paused = true;
    worker_.post(StartScan{std::move(request)});
    log_.awaitState(ScanState::paused);
    for (int i = 1; i <= frames; ++i) {
      worker_.post(StepScan{});
      ASSERT_TRUE(awaitSnapshot(i));
    }
  }
  void resumeToEnd() {
    worker_.post(ResumeScan{});
    worker_.wait();
  }

  /// The number of points in the header of cloud.ply; -1: it cannot be read.
  [[nodiscard]] int pointsOfCloud() const {
    std::ifstream file(out() / "cloud.ply", std::ios::binary);
    for (std::string word; file >> word;) {
      int points = -1;
      if (word == "vertex" && file >> points) return points;
    }
    return -1;
  }
  [[nodiscard]] std::size_t posesWritten() const {
    const auto trajectory = readTrajectory(out() / "trajectory.txt");
    return trajectory ? trajectory->size() : 0;
  }
  /// Rows of the catalogue.
  [[nodiscard]] std::string sessionsWithoutEnd() const {
    return OtherProgram(request(1).database).ask("SELECT count(*) FROM sessions WHERE ended IS NULL");
  }
  void expectAllFiles() const {
    for (const char* file : {"trajectory.txt", "cloud.ply", "cloud.pcd", "labels.json", "report.json"}) {
      EXPECT_TRUE(fs::is_regular_file(out() / file)) << file;
    }
  }
};

TEST_F(ScanFailuresTest, UnwritableFileLeavesTheOthersComplete) {
  scanAndPause(3, request(6));
  fs::create_directories(out() / "cloud.ply" / "folder");
  resumeToEnd();
  EXPECT_EQ(worker_.state(), ScanState::failed);
  EXPECT_THAT(log_.failure(), HasSubstr("cloud.ply"));
  const auto trajectory = readTrajectory(out() / "trajectory.txt");
  ASSERT_TRUE(trajectory) << trajectory.error().message();
  EXPECT_EQ(trajectory->size(), 6U);
  for (const char* file : {"cloud.pcd", "labels.json", "report.json"}) {
    EXPECT_TRUE(fs::is_regular_file(out() / file)) << file;
  }
}

TEST_F(ScanFailuresTest, RemovedFolderIsReported_AndTheSessionWrittenAgain) {
  scanAndPause(2, request(4));
  fs::remove_all(out());
  resumeToEnd();
  EXPECT_EQ(worker_.state(), ScanState::failed);
  EXPECT_THAT(log_.failure(), HasSubstr(out().string())) << "the first failure";
  const auto session = SessionStore::open(out());
  ASSERT_TRUE(session) << session.error().message();
  EXPECT_EQ((*session)->load()->frames.size(), 4U) << "the session is written again";
}

TEST_F(ScanFailuresTest, UnwritableLabelImagesEndTheScan_WithTheOtherResults) {
  ScanRequest requested = request(60);
  requested.label_maps = true;
  scanAndPause(2, requested);
  fs::remove_all(out() / "labels");
  std::ofstream(out() / "labels") << "a file";
  resumeToEnd();
  EXPECT_EQ(worker_.state(), ScanState::failed);
  EXPECT_THAT(log_.failure(), HasSubstr("labels/"));
  for (const char* file : {"trajectory.txt", "cloud.ply", "cloud.pcd", "labels.json", "report.json"}) {
    EXPECT_TRUE(fs::is_regular_file(out() / file)) << file;
  }
  const auto trajectory = readTrajectory(out() / "trajectory.txt");
  ASSERT_TRUE(trajectory);
  EXPECT_LT(trajectory->size(), 60U) << "it continued without its label images";
}

TEST_F(ScanFailuresTest, LockedCatalogueDelaysObjects_AndLosesNone) {
  ScanRequest quiet = request(60);
  quiet.database = (folder_ / "quiet.sqlite").string();
  quiet.output_folder = folder_ / "quiet";  // as the other scan: refinement needs the stored key frames
  worker_.post(StartScan{quiet});
  worker_.wait();
  const std::size_t found = log_.all<ObjectAdded>().size();
  ASSERT_GE(found, 3U);
  static_cast<void>(worker_.snapshots().collect());

  scanAndPause(2, request(60));
  {
    OtherProgram other(request(1).database);
    other.execute("BEGIN IMMEDIATE");
    worker_.post(ResumeScan{});
    log_.awaitState(ScanState::finishing, 3);  // the first scan entered it before and after its refinement
    EXPECT_EQ(log_.all<ObjectAdded>().size(), found) << "only stored objects are reported";
    other.execute("ROLLBACK");
  }
  worker_.wait();
  EXPECT_EQ(worker_.state(), ScanState::finished) << log_.failure();
  EXPECT_EQ(posesWritten(), 60U);
  expectAllFiles();
  const std::vector<ObjectAdded> added = log_.all<ObjectAdded>();
  EXPECT_EQ(added.size(), 2 * found);
  const auto queries = {"SELECT group_concat(id || name || hidden || size_x_m) FROM objects",
                        "SELECT group_concat(object || ' ' || frame_index) FROM views",
                        "SELECT group_concat(action || ' ' || coalesce(object, '')) FROM events"};
  for (const char* query : queries) {
    const std::string rows = OtherProgram(request(1).database).ask(query);
    EXPECT_EQ(rows, OtherProgram(quiet.database).ask(query));
    EXPECT_NE(rows, "");
  }
  ASSERT_FALSE(log_.all<ScanFinished>().empty());
  EXPECT_GE(log_.all<ScanFinished>().back().report.objects.size(), 3U);
}

TEST_F(ScanFailuresTest, CatalogueThatStaysLockedLosesNoOtherResult) {
  ScanRequest requested = request(40);
  requested.catalogue_patience = std::chrono::seconds(1);
  scanAndPause(2, requested);
  {
    OtherProgram other(requested.database);
    other.execute("BEGIN IMMEDIATE");
    resumeToEnd();
    other.execute("ROLLBACK");
  }
  EXPECT_EQ(worker_.state(), ScanState::failed) << "the objects are not in the catalogue";
  EXPECT_THAT(log_.failure(),
              AllOf(HasSubstr("catalogue.sqlite"), HasSubstr("has not got"), HasSubstr("locked")));
  EXPECT_LE(log_.all<CatalogueFailed>().size(), 1U);
  EXPECT_TRUE(log_.all<ObjectAdded>().empty());
  EXPECT_EQ(posesWritten(), 40U);
  expectAllFiles();
}

TEST_F(ScanFailuresTest, CatalogueLockedAtTheStartIsWrittenLater) {
  ASSERT_TRUE(ObjectDatabase::open(request(1).database));
  OtherProgram other(request(1).database);
  other.execute("BEGIN IMMEDIATE");
  scanAndPause(2, request(4));
  other.execute("ROLLBACK");
  resumeToEnd();
  EXPECT_EQ(worker_.state(), ScanState::finished) << log_.failure();
  EXPECT_EQ(other.ask("SELECT count(*) FROM sessions"), "1");
}

TEST_F(ScanFailuresTest, CatalogueDamagedDuringTheScanLosesNoResult) {
  ScanRequest requested = request(8);
  requested.catalogue_patience = std::chrono::seconds(1);
  scanAndPause(2, requested);
  OtherProgram(requested.database).execute("DROP TABLE events");
  resumeToEnd();
  EXPECT_EQ(worker_.state(), ScanState::failed);
  EXPECT_THAT(log_.failure(), AllOf(HasSubstr("catalogue.sqlite"), HasSubstr("damaged")));
  EXPECT_EQ(log_.all<CatalogueFailed>().size(), 1U);
  EXPECT_EQ(posesWritten(), 8U);
  expectAllFiles();
}

TEST_F(ScanFailuresTest, ObjectsStoredInAPauseAreReportedInIt) {
  scanAndPause(2, request(60));
  OtherProgram other(request(1).database);
  other.execute("BEGIN IMMEDIATE");
  for (int frame = 3; frame <= 50; ++frame) {
    worker_.post(StepScan{});
    ASSERT_TRUE(awaitSnapshot(frame));
  }
  EXPECT_TRUE(log_.all<ObjectAdded>().empty());
  other.execute("ROLLBACK");
  std::size_t named = 0;
  for (int i = 0; i < 6000 && (log_.all<ObjectAdded>().empty() || named == 0); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const auto snapshot = worker_.snapshots().collect();
    if (!snapshot) continue;
    named = static_cast<std::size_t>(std::ranges::count_if(
        snapshot->objects, [](const SeenObject& seen) { return seen.object && !seen.name.empty(); }));
  }
  EXPECT_FALSE(log_.all<ObjectAdded>().empty());
  EXPECT_GT(named, 0U) << "a snapshot has the name";
  EXPECT_EQ(worker_.state(), ScanState::paused);
  worker_.post(StopScan{});
  worker_.wait();
}

TEST_F(ScanFailuresTest, LostDeviceKeepsTheResultsUntilThen) {
  scanAndPause(20, request(60));
  const std::size_t added = log_.all<ObjectAdded>().size();
  failing_device::failAfter(40);  // in the middle of a frame
  resumeToEnd();
  failing_device::heal();
  EXPECT_EQ(worker_.state(), ScanState::failed);
  EXPECT_THAT(log_.failure(), AllOf(HasSubstr("OpenCL device failed in frame 2"), HasSubstr("--device")));
  EXPECT_EQ(log_.all<ScanFailed>().size(), 1U);
  EXPECT_GE(posesWritten(), 20U);
  expectAllFiles();
  EXPECT_EQ(sessionsWithoutEnd(), "0");
  EXPECT_GE(log_.all<ObjectAdded>().size(), added);
  EXPECT_EQ(OtherProgram(request(1).database).ask("SELECT count(*) FROM objects"),
            std::to_string(log_.all<ObjectAdded>().size()))
      << "the objects found until then";
  worker_.post(StartScan{request(2)});
  worker_.wait();
  EXPECT_EQ(worker_.state(), ScanState::finished) << "the next scan works";
}

TEST_F(ScanFailuresTest, DeviceLostWhileResultsAreReadLosesNoOtherResult) {
  int calls_that_work = std::numeric_limits<int>::max();
  bool is_scanning = false;
  test::EventLog log;
  ScanWorker worker([&](const ScanEvent& event) {
    log.add(event);
    const auto* state = std::get_if<StateChanged>(&event);
    if (state == nullptr) return;
    // Only the first time: the same state follows the refinement.
    if (state->state == ScanState::finishing && is_scanning) failing_device::failAfter(calls_that_work);
    is_scanning = state->state == ScanState::scanning;
  });
  ScanRequest requested = request(3);
  requested.output_folder = out();
  requested.label_maps = true;
  const auto scan = [&] {
    fs::remove_all(out());
    worker.post(StartScan{requested});
    worker.wait();
    failing_device::heal();
  };
  scan();
  ASSERT_EQ(worker.state(), ScanState::finished) << log.failure();
  const int calls = failing_device::counted(), complete = pointsOfCloud();
  ASSERT_GT(calls, 5);
  ASSERT_GT(complete, 1000);
  bool was_partial = false;
  const int step = 1 + calls / 12;
  for (int lost = 1; lost <= calls; lost += step) {
    calls_that_work = calls - lost;
    scan();
    EXPECT_EQ(worker.state(), ScanState::failed);
    EXPECT_EQ(posesWritten(), 3U);
    expectAllFiles();
    EXPECT_EQ(sessionsWithoutEnd(), "0");
    const int points = pointsOfCloud();
    EXPECT_GE(points, 0);
    EXPECT_LE(points, complete);
    was_partial = was_partial || (points > 0 && points < complete);
  }
  EXPECT_TRUE(was_partial) << "a partial cloud is written";
  for (const ScanFailed& failed : log.all<ScanFailed>()) {
    EXPECT_THAT(failed.error.message(), HasSubstr("OpenCL device failed"));
  }
}

TEST_F(ScanFailuresTest, RemovedSessionIsWrittenAgain_AndReported) {
  scanAndPause(2, request(6));
  ASSERT_TRUE(fs::remove(out() / "session.sqlite"));
  resumeToEnd();
  EXPECT_EQ(worker_.state(), ScanState::failed);
  EXPECT_THAT(log_.failure(), AllOf(HasSubstr(out().string()), HasSubstr("written anew")));
  EXPECT_FALSE(log_.all<MapFailed>().empty()) << "reported during the scan";
  EXPECT_EQ(posesWritten(), 6U);
  expectAllFiles();
  const auto session = SessionStore::open(out());
  ASSERT_TRUE(session) << session.error().message();
  EXPECT_EQ((*session)->load()->frames.size(), 6U);
  worker_.post(StartScan{request(2)});
  worker_.wait();
  EXPECT_EQ(worker_.state(), ScanState::finished) << "the next scan works";
}

TEST_F(ScanFailuresTest, FolderWithForeignFilesIsRefused) {
  const fs::path mine = folder_.write("out/trajectory.txt", "mine");
  ScanRequest requested = request(2);
  requested.output_folder = out();
  requested.results = false;  // as the window requests it
  worker_.post(StartScan{requested});
  worker_.wait();
  EXPECT_EQ(worker_.state(), ScanState::failed);
  EXPECT_THAT(log_.failure(), HasSubstr(mine.string()));
  EXPECT_EQ(std::distance(fs::directory_iterator(out()), {}), 1);
}

TEST_F(ScanFailuresTest, FullDiskLosesNoObject) {
  scanAndPause(2, request(40));
  {
    const test::FullDisk full(out());
    resumeToEnd();
  }
  EXPECT_EQ(worker_.state(), ScanState::failed);
  EXPECT_THAT(log_.failure(), AllOf(HasSubstr("trajectory.txt"), HasSubstr("No space left")))
      << "the first failure";
  EXPECT_EQ(sessionsWithoutEnd(), "0");
  EXPECT_FALSE(log_.all<ObjectAdded>().empty());
  EXPECT_EQ(OtherProgram(request(1).database).ask("SELECT count(*) FROM objects"),
            std::to_string(log_.all<ObjectAdded>().size()));
  for (const char* name : {"trajectory.txt", "report.json", "cloud.ply", "cloud.pcd", "labels.json"})
    EXPECT_FALSE(fs::exists(out() / name)) << name;
  for (const auto& file : fs::recursive_directory_iterator(out()))
    EXPECT_NE(file.path().extension(), ".part") << file.path() << " is a partial file";
}

TEST_F(ScanFailuresTest, DiskFullOfLabelImagesEndsTheScan_WithTheOtherResults) {
  ScanRequest requested = request(60);
  requested.label_maps = true;
  scanAndPause(2, requested);
  {
    const test::FullDisk full(out() / "labels");
    resumeToEnd();
  }
  EXPECT_EQ(worker_.state(), ScanState::failed);
  EXPECT_THAT(log_.failure(), AllOf(HasSubstr("labels/"), HasSubstr("No space left")));
  EXPECT_LT(posesWritten(), 60U);
  expectAllFiles();
  EXPECT_EQ(sessionsWithoutEnd(), "0");
}

}  // namespace
}  // namespace scantrove
