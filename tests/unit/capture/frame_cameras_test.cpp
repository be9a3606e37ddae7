// Frames with a camera of their own, without colour, and with confidence.
#include <gmock/gmock.h>

#include <opencv2/core.hpp>

#include "core/capture/color_registration.h"
#include "core/capture/usable_depth.h"
#include "core/capture/usable_depth_source.h"
#include "core/exchange/recording_writer.h"
#include "tests/unit/capture/tiny_recordings.h"

namespace scantrove {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

RgbdFrame frameWithConfidence() {
  RgbdFrame frame;
  frame.depth = (cv::Mat_<std::uint16_t>(1, 4) << 1000, 2000, 3000, 0);
  frame.confidence =
      (cv::Mat_<std::uint8_t>(1, 4) << kLowConfidence, kMediumConfidence, kHighConfidence, kHighConfidence);
  return frame;
}

bool areEqual(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

TEST(UsableDepth, LeavesOutReadings_OnlyOfLowConfidence) {
  const RgbdFrame frame = frameWithConfidence();
  EXPECT_TRUE(areEqual(usableDepth(frame), (cv::Mat_<std::uint16_t>(1, 4) << 0, 2000, 3000, 0)));
  EXPECT_EQ(frame.depth.at<std::uint16_t>(0, 0), 1000) << "the frame's own image is not changed";
}

TEST(UsableDepth, IsTheFramesImage_WithoutConfidence) {
  RgbdFrame frame = frameWithConfidence();
  frame.confidence.release();
  EXPECT_EQ(usableDepth(frame).data, frame.depth.data);
}

/// Returns one frame, then the end.
class OneFrame final : public FrameSource {
 public:
  explicit OneFrame(RgbdFrame frame) : frame_(std::move(frame)) {}
  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  [[nodiscard]] FrameRead next() override {
    if (is_over_) return {};
    is_over_ = true;
    return {FrameRead::Status::frame, frame_, {}, 0};
  }

 private:
  RgbdFrame frame_;
  SourceInfo info_;
  bool is_over_ = false;
};

TEST(UsableDepthSource, AppliesConfidenceToDepth) {
  UsableDepthSource source(std::make_unique<OneFrame>(frameWithConfidence()));
  EXPECT_FALSE(source.nextIfReady());
  const FrameRead read = source.next();
  ASSERT_EQ(read.status, FrameRead::Status::frame);
  EXPECT_TRUE(areEqual(read.frame.depth, (cv::Mat_<std::uint16_t>(1, 4) << 0, 2000, 3000, 0)));
  EXPECT_TRUE(read.frame.confidence.empty());
  EXPECT_EQ(source.next().status, FrameRead::Status::end);
}

TEST(ColorCameraFor, TakesColorAsRegistered_WhenItsAspectDiffersByUpTo1Percent) {
  const Intrinsics depth_K{577, 577, 319.5F, 239.5F, 640, 480};
  const auto scannet = colorCameraFor({}, {1296, 968}, depth_K, "here");  // 0.4 %
  ASSERT_TRUE(scannet) << scannet.error().message();
  EXPECT_FALSE(*scannet);
  EXPECT_TRUE(colorCameraFor({}, {960, 720}, {212, 212, 127.5F, 95.5F, 256, 192}, "here"));
  EXPECT_TRUE(colorCameraFor({}, {720, 960}, {212, 212, 95.5F, 127.5F, 192, 256}, "here")) << "portrait";
  const auto wider = colorCameraFor({}, {1296, 950}, depth_K, "here");  // 2.3 %
  ASSERT_FALSE(wider);
  EXPECT_THAT(wider.error().message(), AllOf(HasSubstr("1296x950"), HasSubstr("640x480")));
}

class FrameCamerasTest : public testing::Test {
 protected:
  void SetUp() override {
    writeSevenScenes(folder_.path(), 0, 3);
    folder_.write("camera-intrinsics.txt", "60 0 31\n0 61 23\n0 0 1\n");
  }
  [[nodiscard]] std::vector<FrameRead> read(const SourceOptions& options = {}) const {
    const auto source = openSource(folder_.path().string(), options);
    EXPECT_TRUE(source) << source.error().message();
    return source ? readAll(**source) : std::vector<FrameRead>();
  }
  TemporaryFolder folder_;
};

TEST_F(FrameCamerasTest, AFrameHasItsOwnCamera_WhenAFileGivesIt) {
  folder_.write("frame-000001.intrinsics.txt", "62.5 0 30.5\n0 63.25 22\n0 0 1\n");
  const auto reads = read();
  ASSERT_EQ(reads.size(), 3U);
  EXPECT_FALSE(reads[0].frame.intrinsics);
  EXPECT_EQ(reads[1].frame.intrinsics, (Intrinsics{62.5F, 63.25F, 30.5F, 22, kTinyWidth, kTinyHeight}));
}

TEST_F(FrameCamerasTest, OptionsReplaceTheCamerasOfAllFrames) {
  folder_.write("frame-000001.intrinsics.txt", "62.5 0 30.5\n0 63.25 22\n0 0 1\n");
  SourceOptions options;
  options.intrinsics = Intrinsics{58, 58, 32, 24, 0, 0};
  for (const FrameRead& one : read(options)) EXPECT_FALSE(one.frame.intrinsics);
}

TEST_F(FrameCamerasTest, SkipsAFrame_WhenItsCameraIsDamaged) {
  folder_.write("frame-000001.intrinsics.txt", "62.5 0 30.5\n");
  folder_.write("frame-000002.intrinsics.txt", "0 0 30\n0 60 22\n0 0 1\n");
  const auto reads = read();
  ASSERT_EQ(reads.size(), 3U);
  EXPECT_EQ(reads[0].status, FrameRead::Status::frame);
  for (const int i : {1, 2}) {
    const FrameRead& skipped = reads[static_cast<std::size_t>(i)];
    EXPECT_EQ(skipped.status, FrameRead::Status::skipped) << i;
    EXPECT_THAT(skipped.error.message(), HasSubstr("frame-00000" + std::to_string(i) + ".intrinsics.txt"));
  }
}

TEST_F(FrameCamerasTest, AFrameWithoutColorIsSkipped_UnlessTheRecordingSaysOtherwise) {
  std::filesystem::remove(folder_ / "frame-000001.color.png");
  EXPECT_EQ(read().at(1).status, FrameRead::Status::skipped);
  std::filesystem::remove(folder_ / "camera-intrinsics.txt");
  folder_.write("intrinsic.json", R"({"width": 64, "height": 48,
      "intrinsic_matrix": [60, 0, 0, 0, 60, 0, 31.5, 23.5, 1], "color_registered": true, "color_optional": true})");
  const auto reads = read();
  ASSERT_EQ(reads.size(), 3U);
  EXPECT_EQ(reads[1].status, FrameRead::Status::frame);
  EXPECT_TRUE(reads[1].frame.color.empty());
  EXPECT_FALSE(reads[2].frame.color.empty());
  const auto source = openSource(folder_.path().string(), {});
  ASSERT_TRUE(source);
  EXPECT_TRUE((*source)->info().is_color_optional);
}

TEST(RecordingWriter, IsReadBackWithCamerasAndUsableDepth) {
  const TemporaryFolder folder;
  SourceInfo info;
  info.intrinsics = {60, 60, 31.5F, 23.5F, kTinyWidth, kTinyHeight};
  info.is_color_optional = true;
  auto writer = RecordingWriter::create(folder / "out", info);
  ASSERT_TRUE(writer) << writer.error().message();
  RgbdFrame frame;
  frame.depth = tinyDepth(1500);
  frame.color = tinyColor(7);
  frame.confidence = cv::Mat(kTinyHeight, kTinyWidth, CV_8UC1, cv::Scalar(kHighConfidence));
  frame.confidence(cv::Rect(0, 0, 10, 10)) = kLowConfidence;
  frame.intrinsics = Intrinsics{61.123456F, 60.987654F, 31.25F, 23.75F, kTinyWidth, kTinyHeight};
  ASSERT_TRUE(writer->add(frame));
  frame.index = 1;
  frame.color.release();
  frame.intrinsics.reset();
  ASSERT_TRUE(writer->add(frame));
  const auto source = openSource((folder / "out").string(), {});
  ASSERT_TRUE(source) << source.error().message();
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 2U);
  ASSERT_EQ(reads[0].status, FrameRead::Status::frame) << reads[0].error.message();
  EXPECT_EQ(reads[0].frame.intrinsics,
            (Intrinsics{61.123456F, 60.987654F, 31.25F, 23.75F, kTinyWidth, kTinyHeight}));
  EXPECT_EQ(reads[0].frame.depth.at<std::uint16_t>(5, 5), 0);
  EXPECT_EQ(reads[0].frame.depth.at<std::uint16_t>(20, 20), 1500);
  ASSERT_EQ(reads[1].status, FrameRead::Status::frame) << reads[1].error.message();
  EXPECT_TRUE(reads[1].frame.color.empty());
  EXPECT_FALSE(reads[1].frame.intrinsics);
}

}  // namespace
}  // namespace scantrove
