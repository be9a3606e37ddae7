// A stand-in for usbmuxd plays an iPhone that streams with Record3D.
#include <atomic>
#include <opencv2/imgcodecs.hpp>
#include <thread>

#include "tests/app/scantrove_program.h"
#include "tests/support/played_usbmuxd.h"
#include "tests/support/record3d_bytes.h"

namespace scantrove::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kUdid = "00008101-000A1D2E3C40001E";

/// Sends `count` frames at 30 Hz that show a wall 2 m away.
PlayedUsbmuxd::Play wall(int count) {
  return [count](const PlayedUsbmuxd::Send& send) {
    Record3dBytes frame;
    frame.color_width = 64;
    frame.color_height = 48;
    frame.depth_width = 32;
    frame.depth_height = 24;
    frame.depth_m.assign(32 * 24, 2.0F);
    frame.confidence.assign(32 * 24, '\2');
    frame.intrinsics = {50, 50, 31.5F, 23.5F};
    const std::string bytes = frame.bytes();
    for (int i = 0; i < count && send(bytes); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(33));
  };
}

ChildProcess::Environment environmentOf(const PlayedUsbmuxd& service) {
  return {{"USBMUXD_SOCKET_ADDRESS", service.address()}};
}

TEST(SimulatedPhone, IsListedAsACamera) {
  const PlayedUsbmuxd service({kUdid});
  EXPECT_THAT(scantrove({"devices"}, environmentOf(service)).out,
              HasSubstr(std::string("camera:record3d:") + kUdid + "  Apple iPhone or iPad"));
}

TEST(SimulatedPhone, RecordsDepthAndColor) {
  const PlayedUsbmuxd service({kUdid}, PlayedUsbmuxd::kDone, wall(1000), true);
  const TemporaryFolder folder;
  const Finished run =
      scantrove({"record", "record3d", "--frames", "3", "--out", folder / "out"}, environmentOf(service));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  int frames = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder / "out")) {
    const std::string name = file.path().string();
    if (!name.ends_with(".depth.png")) continue;
    ++frames;
    const cv::Mat depth = cv::imread(name, cv::IMREAD_UNCHANGED);
    ASSERT_EQ(depth.size(), cv::Size(32, 24));
    EXPECT_EQ(cv::countNonZero(depth), 32 * 24);
  }
  EXPECT_EQ(frames, 3);
}

TEST(SimulatedPhone, ReportsThatTheAppWasClosed) {
  const PlayedUsbmuxd service({kUdid}, PlayedUsbmuxd::kDone, wall(5));
  const TemporaryFolder folder;
  const Finished run = scantrove({"record", "record3d", "--out", folder / "out"}, environmentOf(service));
  EXPECT_THAT(run.err,
              AllOf(HasSubstr("does not answer any more: the connection was ended"), HasSubstr(kUdid)));
}

TEST(SimulatedPhone, ReportsThatTheAppDoesNotStream) {
  const PlayedUsbmuxd service({kUdid}, PlayedUsbmuxd::kNobodyListens);
  const TemporaryFolder folder;
  expectJobFailure(scantrove({"scan", "record3d", "--out", folder / "out"}, environmentOf(service)),
                   {kUdid, "does not stream", "USB streaming"});
}

}  // namespace
}  // namespace scantrove::test
