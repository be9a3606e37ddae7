#include "core/editing/painted_pixels.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <string>

#include "core/editing/mask_correction.h"

namespace scantrove::test {
namespace {

std::optional<PaintedPixels> read(int width, int height, const std::string& bytes) {
  return PaintedPixels::fromBytes(width, height, bytes);
}

TEST(PaintedPixels, HoldsRunsRowByRow) {
  cv::Mat mask = cv::Mat::zeros(3, 5, CV_8UC1);
  mask.at<std::uint8_t>(0, 4) = mask.at<std::uint8_t>(1, 0) = mask.at<std::uint8_t>(2, 2) = 1;
  const PaintedPixels pixels = PaintedPixels::of(mask);
  EXPECT_EQ(pixels.runs, (std::vector<std::uint32_t>{4, 2, 6, 1}));
  EXPECT_EQ(cv::countNonZero((pixels.mask() != 0) != (mask != 0)), 0);
  EXPECT_EQ(read(5, 3, pixels.toBytes()), pixels);
}

TEST(PaintedPixels, MayBeginOrEndPainted) {
  const cv::Mat all(2, 3, CV_8UC1, cv::Scalar::all(255));
  EXPECT_EQ(PaintedPixels::of(all).runs, (std::vector<std::uint32_t>{0, 6}));
  EXPECT_TRUE(PaintedPixels::of(cv::Mat::zeros(2, 3, CV_8UC1)).isEmpty());
  EXPECT_EQ(cv::countNonZero(PaintedPixels::of(all).mask()), 6);
}

TEST(PaintedPixels, AreLeb128Numbers) {
  const PaintedPixels pixels{640, 480, {300, 5}};
  EXPECT_EQ(pixels.toBytes(), std::string("\xAC\x02\x05"));  // 300 = 0b10'0101100
}

TEST(PaintedPixels, RefusesBytes_WhenTheyAreNoMaskOfTheSize) {
  EXPECT_TRUE(read(5, 3, ""));
  EXPECT_TRUE(read(5, 3, std::string("\x00\x0F", 2)));
  EXPECT_FALSE(read(5, 3, std::string("\x00\x10", 2))) << "16 of 15 pixels";
  EXPECT_FALSE(read(5, 3, "\x04")) << "ends without paint";
  EXPECT_FALSE(read(5, 3, std::string("\x04\x00", 2))) << "an empty run";
  EXPECT_FALSE(read(5, 3, "\x84")) << "a number without its end";
  EXPECT_FALSE(read(5, 3, "\xFF\xFF\xFF\xFF\xFF\x01\x01")) << "more than 32 bits";
  EXPECT_FALSE(read(65536, 65536, "\xFF\xFF\xFF\xFF\x1F\x01")) << "more than 32 bits";
  EXPECT_FALSE(read(0, 3, ""));
  EXPECT_FALSE(read(-5, 3, ""));
}

TEST(MaskCorrection, AddsAPixel_WhenItIsBoth) {
  cv::Mat added = cv::Mat::zeros(4, 4, CV_8UC1), removed = added.clone();
  added.row(1).setTo(255);
  removed.rowRange(1, 3).setTo(255);
  const MaskCorrection correction = correctionOf(added, removed);
  EXPECT_EQ(cv::countNonZero(correction.added.mask().row(1)), 4);
  EXPECT_EQ(cv::countNonZero(correction.removed.mask()), 4);
  EXPECT_EQ(cv::countNonZero(correction.removed.mask().row(2)), 4);
}

}  // namespace
}  // namespace scantrove::test
