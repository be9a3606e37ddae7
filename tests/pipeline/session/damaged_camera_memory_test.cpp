// A scan resumes without its camera memory and reports that.
#include <string>
#include <vector>

#include "core/database/database_connection.h"
#include "tests/pipeline/session/scan_worker_fixture.h"

namespace scantrove::test {
namespace {

class DamagedCameraMemoryTest : public ScanWorkerTest {
 protected:
  [[nodiscard]] ScanRequest part(int first, int frames) const {
    ScanRequest scan = request(frames);
    scan.source_options.start = first;
    scan.output_folder = folder_ / "scan";
    scan.resume = first > 0;
    scan.skip_refinement = true;  // the memory is stored and read without it
    return scan;
  }

  /// Scans 6 frames, applies `change` to the session, and scans 4 more. Result: messages about damage.
  std::vector<std::string> resumeAfter(const std::string& change) {
    worker_.post(StartScan{part(0, 6)});
    worker_.wait();
    EXPECT_EQ(worker_.state(), ScanState::finished) << log_.failure();
    if (!change.empty()) {
      const auto database = DatabaseConnection::open((folder_ / "scan" / "session.sqlite").string());
      EXPECT_TRUE(database && (*database)->execute(change.c_str())) << change;
    }
    worker_.post(StartScan{part(6, 4)});
    worker_.wait();
    EXPECT_EQ(worker_.state(), ScanState::finished) << log_.failure();
    std::vector<std::string> messages;
    for (const MapFailed& failure : log_.all<MapFailed>()) messages.push_back(failure.error.message());
    return messages;
  }

  void expectOneMessage(const std::vector<std::string>& messages) {
    ASSERT_EQ(messages.size(), 1U);
    EXPECT_NE(messages[0].find("camera memory"), std::string::npos) << messages[0];
    EXPECT_NE(messages[0].find("may take longer to find its place"), std::string::npos) << messages[0];
    EXPECT_EQ(log_.all<ScanFinished>().back().report.frames.lost, 0);
  }
};

TEST_F(DamagedCameraMemoryTest, IsNotReported_WhenItIsValid) { EXPECT_TRUE(resumeAfter("").empty()); }

TEST_F(DamagedCameraMemoryTest, IsReportedOnce_WhenItsBytesChanged) {
  expectOneMessage(resumeAfter("UPDATE camera SET packed = zeroblob(40)"));
}

TEST_F(DamagedCameraMemoryTest, IsReportedOnce_WhenItIsMissing) {
  expectOneMessage(resumeAfter("DELETE FROM camera"));
}

}  // namespace
}  // namespace scantrove::test
