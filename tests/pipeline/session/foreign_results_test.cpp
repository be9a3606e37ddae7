// The folder of a session may also have files of a user. Scans replace only files of scans.
#include <gmock/gmock.h>

#include <filesystem>

#include "tests/pipeline/session/scan_worker_fixture.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ForeignResultsTest : public ScanWorkerTest {
 protected:
  enum class Into { new_session, same_session };

  ScanState scan(Into into, bool results, bool label_maps) {
    ScanRequest requested = request(3);
    requested.output_folder = folder_ / "scan";
    requested.results = results;
    requested.label_maps = label_maps;
    requested.resume = into == Into::same_session;
    worker_.post(StartScan{requested});
    worker_.wait();
    return worker_.state();
  }

  /// Expects a scan with such results to fail while the scan folder has a user's file `name`.
  void expectRefused(const std::string& name, Into into, bool label_maps) {
    const fs::path file = folder_.write("scan/" + name, "a user's");
    const fs::path named = file.parent_path().filename() == "scan" ? file : file.parent_path();
    EXPECT_EQ(scan(into, true, label_maps), ScanState::failed) << name;
    EXPECT_THAT(log_.all<ScanFailed>().back().error.message(),
                HasSubstr(named.string() + " is not part of an earlier scan"));
    EXPECT_EQ(readText(file), "a user's");
    fs::remove(file);
  }
};

TEST_F(ForeignResultsTest, AreKept_WhenTheSessionHasNoResults) {
  ASSERT_EQ(scan(Into::new_session, false, false), ScanState::finished) << log_.failure();
  for (const char* name : {"trajectory.txt", "labels.json", "cloud.ply"}) {
    expectRefused(name, Into::same_session, false);
    expectRefused(name, Into::new_session, false);
  }
}

TEST_F(ForeignResultsTest, AreKept_WhenTheScanWroteNoLabelImages) {
  ASSERT_EQ(scan(Into::new_session, true, false), ScanState::finished) << log_.failure();
  for (const char* name : {"labels/000000.png", "labels-final/000003.png"}) {
    expectRefused(name, Into::same_session, true);
    expectRefused(name, Into::new_session, true);
  }
}

TEST_F(ForeignResultsTest, ScansReplaceTheResultsOfScans) {
  for (const Into into : {Into::new_session, Into::same_session, Into::new_session})
    EXPECT_EQ(scan(into, true, true), ScanState::finished) << log_.failure();
  EXPECT_EQ(scan(Into::new_session, true, false), ScanState::finished) << log_.failure();
  EXPECT_EQ(scan(Into::new_session, true, true), ScanState::finished)
      << "replaces the label images of an earlier scan";
  // As after a scan that was killed before it wrote its report.
  fs::remove(folder_ / "scan" / "report.json");
  EXPECT_EQ(scan(Into::same_session, true, true), ScanState::finished) << log_.failure();
  fs::remove(folder_ / "scan" / "report.json");
  EXPECT_EQ(scan(Into::new_session, true, true), ScanState::finished) << log_.failure();
}

}  // namespace
}  // namespace scantrove::test
