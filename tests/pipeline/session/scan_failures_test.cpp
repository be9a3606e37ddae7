#include <gmock/gmock.h>

#include <QSqlDatabase>
#include <QSqlQuery>
#include <filesystem>
#include <fstream>

#include "core/capture/trajectory_reader.h"
#include "tests/pipeline/session/scan_session_fixture.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A second program at the catalogue.
class OtherProgram {
 public:
  explicit OtherProgram(const std::string& file) {
    database_ = QSqlDatabase::addDatabase("QSQLITE", "other program");
    database_.setDatabaseName(QString::fromStdString(file));
    EXPECT_TRUE(database_.open());
  }
  ~OtherProgram() {
    database_ = {};
    QSqlDatabase::removeDatabase("other program");
  }
  OtherProgram(const OtherProgram&) = delete;
  OtherProgram& operator=(const OtherProgram&) = delete;
  void execute(const char* sql) { EXPECT_TRUE(QSqlQuery(database_).exec(sql)) << sql; }

 private:
  QSqlDatabase database_;
};

/// Scans that meet a failure of the world in the middle.
class ScanFailures : public test::ScanSessionTest {
 protected:
  [[nodiscard]] fs::path out() const { return folder_ / "out"; }

  /// Stops after `frames` frames, paused, so that the world can be changed.
  void scanAndPause(int frames, ScanRequest request) {
    request.output_folder = out();
    request.start_paused = true;
    session_.start(std::move(request));
    log_.awaitState(ScanState::paused);
    for (int i = 1; i <= frames; ++i) {
      session_.step();
      ASSERT_TRUE(awaitSnapshot(i));
    }
  }
  void goOn() {
    session_.resume();
    session_.wait();
  }
};

TEST_F(ScanFailures, AFileThatCannotBeWrittenCostsNoOther) {
  scanAndPause(3, request(6));
  fs::create_directories(out() / "cloud.ply" / "in the way");
  goOn();
  EXPECT_EQ(session_.state(), ScanState::failed);
  EXPECT_THAT(log_.failure(), HasSubstr("cloud.ply"));
  const auto trajectory = readTrajectory(out() / "trajectory.txt");
  ASSERT_TRUE(trajectory) << trajectory.error().message();
  EXPECT_EQ(trajectory->size(), 6U);
  for (const char* file : {"cloud.pcd", "labels.json", "report.json"}) {
    EXPECT_TRUE(fs::is_regular_file(out() / file)) << file;
  }
}

TEST_F(ScanFailures, AFolderThatIsGoneIsSaid) {
  scanAndPause(2, request(4));
  fs::remove_all(out());
  goOn();
  EXPECT_EQ(session_.state(), ScanState::failed);
  EXPECT_THAT(log_.failure(), HasSubstr("trajectory.txt")) << "the first that failed";
}

TEST_F(ScanFailures, LabelImagesThatCannotBeWrittenEndTheScanWithTheRest) {
  ScanRequest wanted = request(60);
  wanted.label_maps = true;
  scanAndPause(2, wanted);
  fs::remove_all(out() / "labels");
  std::ofstream(out() / "labels") << "a file";
  goOn();
  EXPECT_EQ(session_.state(), ScanState::failed);
  EXPECT_THAT(log_.failure(), HasSubstr("labels/"));
  for (const char* file : {"trajectory.txt", "cloud.ply", "cloud.pcd", "labels.json", "report.json"}) {
    EXPECT_TRUE(fs::is_regular_file(out() / file)) << file;
  }
  const auto trajectory = readTrajectory(out() / "trajectory.txt");
  ASSERT_TRUE(trajectory);
  EXPECT_LT(trajectory->size(), 60U) << "it went on without its label images";
}

TEST_F(ScanFailures, ALockedCatalogueCostsNoResult) {
  scanAndPause(2, request(40));
  {
    OtherProgram other(request(1).database);
    other.execute("BEGIN IMMEDIATE");
    goOn();
    other.execute("ROLLBACK");
  }
  EXPECT_EQ(session_.state(), ScanState::failed) << "the catalogue has not got what was found";
  EXPECT_THAT(log_.failure(), HasSubstr("catalogue.sqlite"));
  EXPECT_EQ(log_.all<CatalogueFailed>().size(), 1U);
  EXPECT_TRUE(log_.all<ObjectAdded>().empty());
  const auto trajectory = readTrajectory(out() / "trajectory.txt");
  ASSERT_TRUE(trajectory);
  EXPECT_EQ(trajectory->size(), 40U);
  for (const char* file : {"cloud.ply", "cloud.pcd", "labels.json", "report.json"}) {
    EXPECT_TRUE(fs::is_regular_file(out() / file)) << file;
  }
}

TEST_F(ScanFailures, ACatalogueThatIsDamagedMeanwhileCostsNoResult) {
  scanAndPause(2, request(8));
  OtherProgram(request(1).database).execute("DROP TABLE events");
  goOn();
  EXPECT_EQ(session_.state(), ScanState::failed);
  EXPECT_THAT(log_.failure(), HasSubstr("catalogue.sqlite"));
  ASSERT_EQ(log_.all<CatalogueFailed>().size(), 1U);
  const auto trajectory = readTrajectory(out() / "trajectory.txt");
  ASSERT_TRUE(trajectory);
  EXPECT_EQ(trajectory->size(), 8U);
  EXPECT_TRUE(fs::is_regular_file(out() / "cloud.ply"));
  EXPECT_TRUE(fs::is_regular_file(out() / "report.json"));
}

}  // namespace
}  // namespace scantrove
