#include "core/synthetic/phone_camera.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/capture/rgbd_frame.h"
#include "core/synthetic/synthetic_source.h"

namespace scantrove {
namespace {

using synthetic::PhoneCamera;

TEST(PhoneCamera, FocalLengthSwingsAboutItsMean_AndTheCenterStays) {
  const Intrinsics K{212, 214, 127.5F, 95.5F, 256, 192};
  const PhoneCamera phone{.breathing = 0.025};
  EXPECT_EQ(phone.intrinsicsAt(0, K), K);
  EXPECT_NEAR(phone.intrinsicsAt(1, K).fx, 212 * 1.025, 1e-3);
  EXPECT_NEAR(phone.intrinsicsAt(3, K).fy, 214 * 0.975, 1e-3);
  EXPECT_EQ(phone.intrinsicsAt(1, K).cx, 127.5F);
  EXPECT_EQ(PhoneCamera{}.intrinsicsAt(1.234, K), K) << "a fixed focus";
}

TEST(BlurSteps, ReadingsBesideAStepAreWrongAndOfLowConfidence) {
  cv::Mat z_m(20, 40, CV_32FC1, cv::Scalar(1));
  z_m(cv::Rect(20, 0, 20, 20)) = 2;
  z_m(cv::Rect(0, 0, 3, 3)) = 0;
  const cv::Mat confidence = synthetic::blurSteps(z_m);
  const auto at = [&](int x) { return int{confidence.at<std::uint8_t>(10, x)}; };
  // The last near reading is in column 19.
  EXPECT_EQ(at(15), kHighConfidence);
  EXPECT_EQ(at(16), kMediumConfidence);
  EXPECT_EQ(at(17), kMediumConfidence);
  for (const int x : {18, 19, 20, 21}) {
    EXPECT_EQ(at(x), kLowConfidence) << x;
    EXPECT_FLOAT_EQ(z_m.at<float>(10, x), 1.5F) << x;
  }
  EXPECT_EQ(at(22), kMediumConfidence);
  EXPECT_EQ(at(24), kHighConfidence);
  EXPECT_FLOAT_EQ(z_m.at<float>(10, 17), 1);
  EXPECT_EQ(confidence.at<std::uint8_t>(1, 1), kLowConfidence) << "no reading";
  EXPECT_EQ(z_m.at<float>(1, 1), 0);
  EXPECT_EQ(confidence.at<std::uint8_t>(1, 3), kHighConfidence) << "a hole is no step";
}

TEST(SyntheticSource, GivesFramesAsATelephoneDoes) {
  SourceOptions options;
  options.frames = 7;
  const auto source = makeSyntheticSource("tabletop:phone", options);
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_TRUE((*source)->info().is_color_optional);
  EXPECT_EQ((*source)->info().intrinsics.width, 256);
  for (int i = 0; i < 7; ++i) {
    const FrameRead read = (*source)->next();
    ASSERT_EQ(read.status, FrameRead::Status::frame);
    const RgbdFrame& frame = read.frame;
    EXPECT_EQ(frame.depth.size(), cv::Size(256, 192));
    EXPECT_EQ(frame.color.empty(), i % 3 != 0) << i;
    if (!frame.color.empty()) {
      EXPECT_EQ(frame.color.size(), cv::Size(960, 720));
    }
    EXPECT_FALSE(frame.color_camera) << "registered";
    ASSERT_TRUE(frame.intrinsics);
    EXPECT_EQ(frame.intrinsics->width, 256);
    ASSERT_EQ(frame.confidence.size(), frame.depth.size());
    // The table is slanted: many of its readings have medium confidence, which counts fully.
    EXPECT_GT(cv::countNonZero(frame.confidence >= kMediumConfidence), cv::countNonZero(frame.depth) / 2);
    EXPECT_GT(cv::countNonZero(frame.confidence == kHighConfidence), 256 * 192 / 4);
    EXPECT_GT(cv::countNonZero(frame.confidence == kLowConfidence), 100);
  }
}

TEST(SyntheticSource, RefusesAnImpossibleTelephone) {
  SyntheticOptions options;
  options.phone.breathing = 1;
  EXPECT_FALSE(makeSyntheticSource(options));
  options.phone = {.colored = 1, .cycle = 0};
  EXPECT_FALSE(makeSyntheticSource(options));
}

}  // namespace
}  // namespace scantrove
