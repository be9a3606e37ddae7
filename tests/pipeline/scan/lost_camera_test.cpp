// A live camera with faults, scanned with the worker of window and command line.
#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "core/capture/read_ahead.h"
#include "core/capture/reconnecting_source.h"
#include "tests/pipeline/session/scan_worker_fixture.h"
#include "tests/support/faulty_camera.h"

namespace scantrove::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using Fault = FaultyCamera::Fault;

class LostCameraTest : public ScanWorkerTest {
 protected:
  /// A scan of `camera_`. Without `reads_ahead` each frame is processed, so that results do not depend on
  /// the computer's speed.
  [[nodiscard]] ScanRequest cameraRequest(ReconnectingSource::Patience patience, bool reads_ahead = false) {
    ScanRequest scan = request(0);
    scan.source = "camera:faulty";
    scan.source_options.frames.reset();
    scan.skip_refinement = true;
    scan.open_frames = [this, patience, reads_ahead](const SourceOptions&) {
      return camera_.open().map([&](std::unique_ptr<FrameSource> opened) -> std::unique_ptr<FrameSource> {
        auto source = std::make_unique<ReconnectingSource>(std::move(opened), camera_.opener(), patience);
        if (!reads_ahead) return source;
        return std::make_unique<ReadAhead>(std::move(source));
      });
    };
    return scan;
  }

  [[nodiscard]] ScanReport finished() {
    const auto ended = log_.all<ScanFinished>();
    EXPECT_EQ(ended.size(), 1U) << log_.failure();
    return ended.empty() ? ScanReport{} : ended.front().report;
  }

  FaultyCamera camera_;
};

/// Longer than it takes to render a frame.
constexpr ReconnectingSource::Patience kPatient{3s, 1ms, 600s};

TEST_F(LostCameraTest, ScanGoesOnInTheSameMap_WhenTheCameraReturns) {
  camera_.faults = {{12, Fault::unplugged}};
  camera_.moments_missed = 2;  // it was moved meanwhile: four frames of its path
  worker_.post(StartScan{cameraRequest(kPatient)});
  worker_.wait();
  const ScanReport report = finished();
  EXPECT_EQ(report.frames.read, 20);  // 24 less the four
  EXPECT_LE(report.frames.lost, 1);   // the first one after the move
  ASSERT_EQ(log_.all<CameraLost>().size(), 1U);
  EXPECT_THAT(log_.all<CameraLost>().front().error.message(),
              HasSubstr("Camera lost: faulty camera. Reconnect it; the scan goes on."));
  ASSERT_EQ(log_.all<CameraReturned>().size(), 1U);
}

TEST_F(LostCameraTest, ScanGoesOn_AfterStallsAndDamagedFrames) {
  camera_.faults = {{5, Fault::garbage}, {9, Fault::stalled}, {15, Fault::garbage}};
  worker_.post(StartScan{cameraRequest(kPatient)});
  worker_.wait();
  const ScanReport report = finished();
  EXPECT_EQ(report.frames.skipped, 2);
  EXPECT_EQ(report.frames.read, 22);
  EXPECT_EQ(report.frames.lost, 0);
  EXPECT_EQ(camera_.openings, 2);
}

TEST_F(LostCameraTest, ScanGoesOn_WhenTheResolutionChanged) {
  camera_.frames = 1000000;
  camera_.faults = {{10, Fault::resized}};
  worker_.post(StartScan{cameraRequest(kPatient)});
  log_.await<CameraReturned>();
  worker_.post(StopScan{});
  worker_.wait();
  const ScanReport report = finished();
  EXPECT_GT(report.frames.skipped, 0);  // until the camera was opened again, its intrinsics were not known
  EXPECT_GT(report.frames.read, 10);
  EXPECT_EQ(log_.failure(), "");
}

TEST_F(LostCameraTest, ScanEndsWithItsResults_WhenTheCameraStaysAway) {
  camera_.faults = {{8, Fault::unplugged}};
  camera_.absent_openings = 1000000;
  ScanRequest scan = cameraRequest({50ms, 1ms, 100ms});
  scan.output_folder = folder_ / "out";
  worker_.post(StartScan{std::move(scan)});
  worker_.wait();
  EXPECT_EQ(finished().frames.read, 8);
  ASSERT_EQ(log_.all<CameraLost>().size(), 2U);
  EXPECT_THAT(log_.all<CameraLost>().back().error.message(), HasSubstr("did not come back"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/report.json"));
}

TEST_F(LostCameraTest, ScanStops_WhileItWaits) {
  camera_.faults = {{8, Fault::unplugged}};
  camera_.absent_openings = 1000000;
  worker_.post(StartScan{cameraRequest(kPatient, true)});
  log_.await<CameraLost>();
  worker_.post(StopScan{});
  log_.await<ScanFinished>();
  EXPECT_GT(finished().frames.read, 0);
}

TEST_F(LostCameraTest, ScanPausesAndResumes_WhileItWaits) {
  camera_.faults = {{8, Fault::unplugged}};
  camera_.absent_openings = 1000000;
  worker_.post(StartScan{cameraRequest(kPatient, true)});
  log_.await<CameraLost>();
  worker_.post(PauseScan{});
  log_.awaitState(ScanState::paused);
  worker_.post(ResumeScan{});
  log_.awaitState(ScanState::scanning, 2);
  camera_.comeBack();
  log_.await<CameraReturned>();
  worker_.wait();
  EXPECT_GT(finished().frames.read, 0);
}

}  // namespace
}  // namespace scantrove::test
