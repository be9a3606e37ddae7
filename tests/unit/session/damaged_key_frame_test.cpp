#include "core/session/key_frame_files.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <opencv2/core.hpp>

#include "core/image/png_encoder.h"
#include "core/session/session_store.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class DamagedKeyFrameTest : public testing::Test {
 protected:
  void SetUp() override {
    auto store = SessionStore::create(folder_ / "scan");
    ASSERT_TRUE(store) << store.error().message();
    store_ = std::move(*store);
  }

  static RgbdFrame frameOf(int depth_mm) {
    RgbdFrame frame;
    frame.depth = cv::Mat(24, 32, CV_16UC1, cv::Scalar(depth_mm));
    frame.color = cv::Mat(24, 32, CV_8UC3, cv::Scalar(1, 2, depth_mm % 200));
    return frame;
  }

  /// Writes and saves a key frame; returns it as the session loads it.
  SavedKeyFrame saved(int depth_mm) {
    const auto written = writeKeyFrame(*store_, 7, frameOf(depth_mm));
    EXPECT_TRUE(written) << written.error().message();
    EXPECT_TRUE(store_->saveKeyFrame(frame_, *written));
    return store_->load()->key_frames.at(0);
  }

  TemporaryFolder folder_;
  std::unique_ptr<SessionStore> store_;
  SavedFrame frame_{.number = 7, .state = TrackingState::tracking};
};

TEST_F(DamagedKeyFrameTest, ReadsImages_WhenUnchanged) {
  const SavedKeyFrame key = saved(1500);
  EXPECT_EQ(key.depth_file, "keyframes/000007.depth.png");
  const auto frame = readKeyFrame(store_->folder(), key, frame_);
  ASSERT_TRUE(frame) << frame.error().message();
  EXPECT_EQ(frame->depth.at<std::uint16_t>(3, 3), 1500);
  EXPECT_EQ(frame->color.at<cv::Vec3b>(3, 3)[2], 100);
}

TEST_F(DamagedKeyFrameTest, RefusesTheFrame_WhenAnotherImageReplacesItsOwn) {
  const SavedKeyFrame key = saved(1500);
  const fs::path depth = store_->folder() / key.depth_file, color = store_->folder() / key.color_file;
  const std::string intact = readText(depth);
  folder_.write("scan/" + key.depth_file.string(), encodePng(frameOf(1501).depth));
  auto frame = readKeyFrame(store_->folder(), key, frame_);
  ASSERT_FALSE(frame);
  EXPECT_THAT(frame.error().message(), AllOf(HasSubstr(depth.string()), HasSubstr("left out")));
  folder_.write("scan/" + key.depth_file.string(), intact);
  folder_.write("scan/" + key.color_file.string(), encodePng(frameOf(1501).color));
  frame = readKeyFrame(store_->folder(), key, frame_);
  ASSERT_FALSE(frame);
  EXPECT_THAT(frame.error().message(), HasSubstr(color.string()));
}

TEST_F(DamagedKeyFrameTest, RefusesTheFrame_WhenItsCameraHasAnotherSize) {
  const SavedKeyFrame key = saved(1500);
  frame_.intrinsics = Intrinsics{30, 30, 16, 12, 32, 24};
  const auto frame = readKeyFrame(store_->folder(), key, frame_);
  ASSERT_TRUE(frame) << frame.error().message();
  EXPECT_EQ(frame->intrinsics, frame_.intrinsics);
  frame_.intrinsics->width = 64;
  const auto refused = readKeyFrame(store_->folder(), key, frame_);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), AllOf(HasSubstr("another size"), HasSubstr("left out")));
}

TEST_F(DamagedKeyFrameTest, ReadsImages_WithoutChecksums) {
  SavedKeyFrame key = saved(1500);
  key.depth_checksum = key.color_checksum = std::nullopt;
  EXPECT_TRUE(readKeyFrame(store_->folder(), key, frame_));
}

TEST_F(DamagedKeyFrameTest, KeepsAForeignImage_WhenItHasTheName) {
  folder_.write("scan/keyframes/000007.depth.png", "mine");
  const SavedKeyFrame key = saved(1500);
  EXPECT_EQ(key.depth_file, "keyframes/000007-2.depth.png");
  EXPECT_EQ(readText(folder_ / "scan/keyframes/000007.depth.png"), "mine");
  EXPECT_TRUE(readKeyFrame(store_->folder(), key, frame_));
}

}  // namespace
}  // namespace scantrove::test
