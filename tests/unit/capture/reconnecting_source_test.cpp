#include "core/capture/reconnecting_source.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/capture/adapted_frame.h"
#include "core/capture/reopened_camera.h"
#include "tests/support/faulty_camera.h"

namespace scantrove::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using Fault = FaultyCamera::Fault;

constexpr ReconnectingSource::Patience kShort{20ms, 1ms, 60s};

std::unique_ptr<ReconnectingSource> reconnecting(FaultyCamera& camera,
                                                 ReconnectingSource::Patience patience = kShort) {
  return std::make_unique<ReconnectingSource>(std::move(*camera.open()), camera.opener(), patience);
}

/// All results up to the end, which is the last one.
std::vector<FrameRead> readToEnd(FrameSource& source) {
  std::vector<FrameRead> reads;
  do {
    reads.push_back(source.next());
  } while (reads.back().status != FrameRead::Status::end && reads.size() < 100000);
  return reads;
}

std::vector<FrameRead> framesOf(const std::vector<FrameRead>& reads) {
  std::vector<FrameRead> frames;
  for (const FrameRead& read : reads)
    if (read.status == FrameRead::Status::frame) frames.push_back(read);
  return frames;
}

TEST(ReconnectingSource, GoesOn_WhenTheCameraReturns) {
  FaultyCamera camera;
  camera.frames = 8;
  camera.faults = {{3, Fault::unplugged}};
  const auto source = reconnecting(camera);
  const std::vector<FrameRead> reads = readToEnd(*source);
  const std::vector<FrameRead> frames = framesOf(reads);
  ASSERT_EQ(frames.size(), 8U);
  EXPECT_EQ(camera.openings, 2);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].frame.index, static_cast<int>(i));
    EXPECT_EQ(frames[i].is_reconnected, i == 3) << i;
    if (i > 0) {
      EXPECT_GT(frames[i].frame.timestamp_s, frames[i - 1].frame.timestamp_s);
    }
  }
  // Two openings failed before that which worked.
  int lost = 0;
  for (const FrameRead& read : reads) {
    if (read.status != FrameRead::Status::timeout) continue;
    ++lost;
    EXPECT_THAT(read.error.message(),
                HasSubstr("Camera lost: faulty camera. Reconnect it; the scan goes on."));
  }
  EXPECT_EQ(lost, 4);
  EXPECT_EQ(reads.back().error.what, "");
}

TEST(ReconnectingSource, OpensAStalledCameraAgain) {
  FaultyCamera camera;
  camera.frames = 6;
  camera.faults = {{2, Fault::stalled}};
  const auto source = reconnecting(camera);
  EXPECT_EQ(framesOf(readToEnd(*source)).size(), 6U);
  EXPECT_EQ(camera.openings, 2);
}

TEST(ReconnectingSource, PassesDamagedFramesOn) {
  FaultyCamera camera;
  camera.frames = 6;
  camera.faults = {{2, Fault::garbage}, {4, Fault::garbage}};
  const auto source = reconnecting(camera, {60s, 1ms, 60s});
  const std::vector<FrameRead> reads = readToEnd(*source);
  EXPECT_EQ(framesOf(reads).size(), 4U);
  EXPECT_EQ(reads[2].status, FrameRead::Status::skipped);
  EXPECT_EQ(camera.openings, 1);
}

TEST(ReconnectingSource, AdaptsFramesOfAnotherSize_OnceTheirCameraIsKnown) {
  FaultyCamera camera;
  camera.frames = 1000000;
  camera.faults = {{2, Fault::resized}};
  const auto source = reconnecting(camera, {2s, 1ms, 60s});
  EXPECT_EQ(framesOf({source->next(), source->next()}).size(), 2U);
  const FrameRead refused = source->next();
  EXPECT_EQ(refused.status, FrameRead::Status::skipped);
  EXPECT_THAT(refused.error.message(), HasSubstr("160 x 120"));
  EXPECT_THAT(refused.error.message(), HasSubstr("intrinsics are not known"));
  FrameRead read = source->next();
  while (read.status != FrameRead::Status::frame && read.status != FrameRead::Status::end)
    read = source->next();
  ASSERT_EQ(read.status, FrameRead::Status::frame);
  EXPECT_EQ(camera.openings, 2);
  EXPECT_EQ(read.frame.depth.size(), cv::Size(320, 240));
  EXPECT_EQ(read.frame.color.size(), cv::Size(320, 240));
  EXPECT_FALSE(read.frame.intrinsics);
}

TEST(ReconnectingSource, EndsWithAReason_WhenTheCameraStaysAway) {
  FaultyCamera camera;
  camera.faults = {{2, Fault::unplugged}};
  camera.absent_openings = 1000000;
  const auto source = reconnecting(camera, {20ms, 1ms, 30ms});
  const std::vector<FrameRead> reads = readToEnd(*source);
  EXPECT_EQ(framesOf(reads).size(), 2U);
  ASSERT_EQ(reads.back().status, FrameRead::Status::end);
  EXPECT_THAT(reads.back().error.message(), HasSubstr("faulty camera did not come back"));
}

// A plane whose depth grows to the right: z = d / (1 - s x) at the ray (x, y, 1).
TEST(AdaptedFrame, HasTheDepthOfTheRequestedCamera) {
  const Intrinsics own{200, 200, 99.5F, 74.5F, 200, 150}, wanted{300, 300, 159.5F, 119.5F, 320, 240};
  const auto depthAt = [](const Intrinsics& K, int u) {
    return 2000.0 / (1 - 0.2 * static_cast<double>((static_cast<float>(u) - K.cx) / K.fx));
  };
  RgbdFrame frame;
  frame.depth = cv::Mat(own.height, own.width, CV_16UC1);
  for (int v = 0; v < own.height; ++v)
    for (int u = 0; u < own.width; ++u)
      frame.depth.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(depthAt(own, u));
  frame.color = cv::Mat(own.height, own.width, CV_8UC3, cv::Scalar(10, 20, 30));
  frame.intrinsics = own;
  adaptToCamera(frame, own, wanted, {320, 240});
  ASSERT_EQ(frame.depth.size(), cv::Size(320, 240));
  EXPECT_EQ(frame.color.size(), cv::Size(320, 240));
  // The fields of view: 99.5 / 200 to the left of `own`, 159.5 / 300 of `wanted`.
  EXPECT_EQ(frame.depth.at<std::uint16_t>(120, 0), 0);
  EXPECT_EQ(frame.color.at<cv::Vec3b>(120, 160), cv::Vec3b(10, 20, 30));
  for (const int u : {40, 120, 160, 240, 300}) {
    // Half a pixel of `own` changes the ray by 0.0025, which is 0.05 % of the depth; and whole units.
    EXPECT_NEAR(frame.depth.at<std::uint16_t>(120, u), depthAt(wanted, u), 4) << u;
  }
}

TEST(ReopenedCamera, IsTheOnlyOneOfItsModel) {
  const CameraInfo xtion{"1d27/0601@1/7", "Xtion", "Asus"}, other{"2bc5/0401@1/8", "Astra", "Orbbec"};
  EXPECT_EQ(sameModel("1d27/0601@1/5", {other, xtion}), "1d27/0601@1/7");
  EXPECT_EQ(sameModel("1d27/0601@1/5", {other}), "");
  EXPECT_EQ(sameModel("1d27/0601@1/5", {xtion, {"1d27/0601@2/1", "Xtion", "Asus"}}), "");
  EXPECT_EQ(sameModel("Dummy", {xtion}), "");
}

}  // namespace
}  // namespace scantrove::test
