#include "core/dataset/frame_fitness.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

constexpr int kWallSquare_px = 24;

/// Twelve uniform boxes 20 cm in front of a wall of grey squares, seen by a camera of depth and colour.
struct Wall {
  KeyFrameInfo frame;
  cv::Mat depth{480, 640, CV_16UC1, cv::Scalar(1000)};
  cv::Mat color;

  Wall() {
    frame.K_depth = frame.K_color = {525, 525, 319.5, 239.5, 640, 480};
    cv::RNG random(2);
    cv::Mat squares(480 / kWallSquare_px, 640 / kWallSquare_px + 1, CV_8UC1), gray;
    random.fill(squares, cv::RNG::UNIFORM, 100, 160);
    cv::resize(squares, gray, {}, kWallSquare_px, kWallSquare_px, cv::INTER_NEAREST);
    cv::cvtColor(gray.colRange(0, 640), color, cv::COLOR_GRAY2BGR);
    for (int i = 0; i < 12; ++i) {
      const cv::Rect box(60 + 140 * (i % 4), 60 + 140 * (i / 4), 90, 60);
      color(box).setTo(cv::Scalar(15 + 220 * (i % 2), 15 + 220 * (i / 2 % 2), 15 + 220 * (i / 4 % 2)));
      depth(box).setTo(800);
    }
  }
  /// The colour image with a camera's noise.
  [[nodiscard]] static cv::Mat noisy(const cv::Mat& image, int seed) {
    cv::Mat noise(image.size(), CV_16SC3), result;
    cv::RNG(static_cast<std::uint64_t>(seed)).fill(noise, cv::RNG::NORMAL, 0, 3);
    cv::add(image, noise, result, cv::noArray(), CV_8U);
    return result;
  }
};

cv::Mat movedBy(const cv::Mat& image, const cv::Point2d& shift) {
  cv::Mat moved;
  const cv::Mat M = (cv::Mat_<double>(2, 3) << 1, 0, shift.x, 0, 1, shift.y);
  cv::warpAffine(image, moved, M, image.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return moved;
}

/// The unfit frames of a scan with 6 frames, of which `change` alters the one with that index.
std::map<int, std::string> unfitWith(int changed, const std::function<cv::Mat(const cv::Mat&)>& change) {
  Wall wall;
  FrameFitness fitness;
  for (int i = 0; i < 6; ++i) {
    wall.frame.index = 10 * i;
    const cv::Mat image = wall.frame.index == changed ? change(wall.color) : wall.color;
    fitness.add(wall.frame, wall.depth, Wall::noisy(image, i + 1));
  }
  return fitness.unfit();
}

TEST(FrameFitness, AcceptsFramesThatDifferInNoiseOnly) { EXPECT_TRUE(unfitWith(-1, {}).empty()); }

TEST(FrameFitness, FindsABlurredFrame) {
  const auto unfit = unfitWith(20, [](const cv::Mat& image) {
    cv::Mat blurred;
    cv::blur(image, blurred, {9, 1});  // as by motion
    return blurred;
  });
  ASSERT_EQ(unfit.size(), 1U);
  EXPECT_EQ(unfit.begin()->first, 20);
  EXPECT_NE(unfit.begin()->second.find("blurred"), std::string::npos) << unfit.begin()->second;
}

TEST(FrameFitness, AcceptsAllFrames_WhenAllAreEquallyBlurred) {
  Wall wall;
  cv::blur(wall.color, wall.color, {9, 1});
  FrameFitness fitness;
  for (int i = 0; i < 6; ++i) {
    wall.frame.index = i;
    fitness.add(wall.frame, wall.depth, Wall::noisy(wall.color, i + 1));
  }
  EXPECT_TRUE(fitness.unfit().empty());
}

TEST(FrameFitness, FindsAFrameWithShiftedColor) {
  const auto unfit = unfitWith(40, [](const cv::Mat& image) { return movedBy(image, {8, 3}); });
  ASSERT_EQ(unfit.size(), 1U);
  EXPECT_EQ(unfit.begin()->first, 40);
  EXPECT_NE(unfit.begin()->second.find("depth and colour do not fit"), std::string::npos);
}

TEST(FrameFitness, AcceptsAShiftThatAllFramesHave) {
  Wall wall;
  const cv::Mat moved = movedBy(wall.color, {3, 0});
  FrameFitness fitness;
  for (int i = 0; i < 6; ++i) {
    wall.frame.index = i;
    fitness.add(wall.frame, wall.depth, Wall::noisy(moved, i + 1));
  }
  EXPECT_TRUE(fitness.unfit().empty());
}

TEST(FrameFitness, AcceptsEmptyDepth) {
  Wall wall;
  FrameFitness fitness;
  fitness.add(wall.frame, cv::Mat::zeros(480, 640, CV_16UC1), wall.color);
  EXPECT_TRUE(fitness.unfit().empty());
}

TEST(DepthShift, IsTheShiftOfTheColorImage) {
  const Wall wall;
  for (const cv::Point2d& shift : {cv::Point2d(0, 0), cv::Point2d(7, -5), cv::Point2d(-12, 4)}) {
    const std::optional<cv::Point2f> found =
        DepthShift(wall.frame, wall.depth, movedBy(wall.color, shift)).best();
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->x, shift.x, 1.5);
    EXPECT_NEAR(found->y, shift.y, 1.5);
  }
}

TEST(DepthShift, IsUnknown_WithoutDepthEdges) {
  Wall wall;
  wall.depth.setTo(1000);
  EXPECT_FALSE(DepthShift(wall.frame, wall.depth, wall.color).best());
  EXPECT_FALSE(DepthShift(wall.frame, wall.depth, wall.color).isBetterThan({0, 0}));
}

/// The middle one of three key frames has its colour 8 pixels to the right.
void shiftMiddleImage(ScannedScene& scene) {
  const auto frames = scene.keyFrames(false);
  ASSERT_TRUE(frames);
  for (const KeyFrameInfo& frame : *frames) {
    if (frame.index != 10) continue;
    const cv::Mat image = cv::imread(frame.color_file.string());
    cv::imwrite(frame.color_file.string(), movedBy(image, {8, 0}), {cv::IMWRITE_JPEG_QUALITY, 92});
  }
}

TEST(ExportDataset, LeavesOutUnfitFramesAndSaysWhy) {
  const Exported exported(DatasetFormat::coco, shiftMiddleImage);
  EXPECT_EQ(exported.summary.images, 2);
  EXPECT_EQ(exported.summary.unfit, 1);
  ASSERT_EQ(exported.summary.skipped.size(), 1U);
  EXPECT_NE(exported.summary.skipped.front().find("Key frame 10 was left out: its depth and colour"),
            std::string::npos)
      << exported.summary.skipped.front();
  EXPECT_EQ(exported.json("annotations/instances.json")["images"].size(), 2U);
}

TEST(ExportDataset, IncludesUnfitFrames_WhenRequested) {
  ScannedScene scene;
  shiftMiddleImage(scene);
  const TemporaryFolder home;
  const auto summary =
      exportDataset(scene, {.format = DatasetFormat::coco, .folder = home / "out", .include_unfit = true});
  ASSERT_TRUE(summary) << summary.error().message();
  EXPECT_EQ(summary->images, 3);
  EXPECT_EQ(summary->unfit, 0);
  EXPECT_TRUE(summary->skipped.empty());
}

}  // namespace
}  // namespace scantrove::test
