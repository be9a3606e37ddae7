#include "core/dataset/mask_outline.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/unit/dataset/scanned_scene.h"

namespace scantrove {
namespace {

cv::Mat empty() { return cv::Mat::zeros(120, 160, CV_8UC1); }

cv::Mat filled(const std::vector<cv::Point>& outline) {
  cv::Mat mask = empty();
  if (!outline.empty()) cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{outline}, 255);
  return mask;
}

int differing(const cv::Mat& a, const cv::Mat& b) { return cv::countNonZero(a != b); }

TEST(MaskOutline, IsExact_ForASinglePart) {
  cv::Mat mask = empty();
  cv::rectangle(mask, {10, 20, 50, 30}, 255, cv::FILLED);
  EXPECT_EQ(outlineOf(mask).size(), 4U);
  EXPECT_EQ(differing(filled(outlineOf(mask)), mask), 0);
  mask = empty();
  cv::circle(mask, {80, 60}, 37, 255, cv::FILLED);
  cv::circle(mask, {30, 60}, 20, 255, cv::FILLED);
  EXPECT_EQ(differing(filled(outlineOf(mask)), mask), 0);
  mask = empty();
  mask.setTo(255);
  EXPECT_EQ(differing(filled(outlineOf(mask)), mask), 0) << "up to the image borders";
}

TEST(MaskOutline, KeepsAHole_ThroughABridge) {
  cv::Mat mask = empty();
  cv::circle(mask, {80, 60}, 50, 255, cv::FILLED);
  cv::circle(mask, {70, 55}, 20, 0, cv::FILLED);
  cv::circle(mask, {105, 80}, 9, 0, cv::FILLED);
  EXPECT_LE(differing(filled(outlineOf(mask)), mask), 4);
  EXPECT_EQ(filled(outlineOf(mask)).at<std::uint8_t>(55, 70), 0);
}

TEST(MaskOutline, JoinsPartsByThinBridges) {
  cv::Mat mask = empty();  // an occluder divides the object
  cv::rectangle(mask, {10, 20, 50, 60}, 255, cv::FILLED);
  cv::rectangle(mask, {70, 20, 60, 60}, 255, cv::FILLED);
  EXPECT_LE(differing(filled(outlineOf(mask)), mask), 11) << "a bridge of the gap's width";
}

TEST(MaskOutline, OmitsSmallComponentsAndHoles) {
  cv::Mat clean = empty();
  cv::rectangle(clean, {10, 20, 60, 60}, 255, cv::FILLED);
  cv::Mat mask = clean.clone();
  mask.at<std::uint8_t>(50, 30) = 0;
  mask(cv::Rect(40, 40, 2, 3)) = 0;
  mask(cv::Rect(140, 100, 3, 2)) = 255;
  EXPECT_EQ(differing(filled(outlineOf(mask)), clean), 0);
}

TEST(MaskOutline, IsEmpty_WhenTheMaskIsTooSmallForAPolygon) {
  EXPECT_TRUE(outlineOf(empty()).empty());
  cv::Mat mask = empty();
  mask.at<std::uint8_t>(5, 5) = 255;
  EXPECT_TRUE(outlineOf(mask).empty());
  mask(cv::Rect(20, 20, 2, 2)) = 255;
  EXPECT_EQ(differing(filled(outlineOf(mask)), mask), 1) << "the largest part, however small";
}

}  // namespace
}  // namespace scantrove
