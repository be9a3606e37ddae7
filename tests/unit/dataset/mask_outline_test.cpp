#include "core/dataset/mask_outline.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <utility>

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

TEST(MaskOutline, IsExact_ForPartsThatTouch) {
  cv::Mat mask = empty();  // diagonally, at one corner each
  for (int i = 0; i < 6; ++i)
    cv::rectangle(mask, cv::Rect(10 + 20 * i, 10 + 15 * i, 20, 15), 255, cv::FILLED);
  EXPECT_EQ(differing(filled(outlineOf(mask)), mask), 0);
  mask = empty();  // squares of a chessboard, which enclose holes
  for (int i = 0; i < 16; ++i) {
    if ((i / 4 + i % 4) % 2 == 0)
      cv::rectangle(mask, cv::Rect(20 + 20 * (i % 4), 20 + 20 * (i / 4), 20, 20), 255, cv::FILLED);
  }
  EXPECT_EQ(differing(filled(outlineOf(mask)), mask), 0);
  mask = empty();  // two parts and a line of one pixel between them
  cv::rectangle(mask, {10, 20, 40, 40}, 255, cv::FILLED);
  cv::rectangle(mask, {90, 20, 40, 40}, 255, cv::FILLED);
  cv::line(mask, {50, 30}, {90, 30}, 255);
  EXPECT_EQ(differing(filled(outlineOf(mask)), mask), 0);
}

TEST(MaskOutline, IsExact_ForThinFramesAndImageBorders) {
  cv::Mat mask = empty();
  cv::rectangle(mask, {10, 20, 100, 60}, 255, 1);
  EXPECT_EQ(differing(filled(outlineOf(mask)), mask), 0);
  mask = empty();
  cv::rectangle(mask, {0, 0, 160, 120}, 255, 1);
  EXPECT_EQ(differing(filled(outlineOf(mask)), mask), 0);
  mask = empty();  // open at three borders
  mask.setTo(255);
  cv::rectangle(mask, {0, 50, 40, 30}, 0, cv::FILLED);
  cv::rectangle(mask, {100, 0, 60, 40}, 0, cv::FILLED);
  EXPECT_EQ(differing(filled(outlineOf(mask)), mask), 0);
}

TEST(MaskOutline, KeepsHolesInPartsInHoles) {
  cv::Mat mask = empty();
  for (const auto& [radius, value] : {std::pair(58, 255), {44, 0}, {31, 255}, {19, 0}, {9, 255}})
    cv::circle(mask, {80, 60}, radius, value, cv::FILLED);
  EXPECT_LE(differing(filled(outlineOf(mask)), mask), 12 + 9) << "one bridge across each gap";
}

TEST(MaskOutline, BridgesWherePartsAreNearest) {
  cv::Mat mask = empty();  // long edges face each other; their corners are far apart
  const std::vector<cv::Point> upper{{10, 10}, {150, 10}, {80, 50}};
  cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{upper}, 255);
  cv::rectangle(mask, {10, 60, 140, 50}, 255, cv::FILLED);
  EXPECT_LE(differing(filled(outlineOf(mask)), mask), 9);
}

/// What is behind a fence has many parts, each small.
TEST(MaskOutline, KeepsManySmallPartsAndHoles) {
  cv::Mat mask = empty();
  for (int i = 0; i < 15; ++i) cv::rectangle(mask, cv::Rect(5 + 10 * i, 10, 7, 100), 255, cv::FILLED);
  EXPECT_GE(test::iou(filled(outlineOf(mask)), mask), 0.98);
  mask = empty();
  for (int i = 0; i < 70; ++i)
    cv::rectangle(mask, cv::Rect(5 + 15 * (i % 10), 5 + 15 * (i / 10), 10, 10), 255, cv::FILLED);
  EXPECT_GE(test::iou(filled(outlineOf(mask)), mask), 0.92) << "each part has 1.4 % of the pixels";
  mask = empty();
  cv::rectangle(mask, {5, 5, 150, 110}, 255, cv::FILLED);
  for (int i = 0; i < 20; ++i) cv::rectangle(mask, cv::Rect(10 + 7 * i, 40, 4, 40), 0, cv::FILLED);
  EXPECT_GE(test::iou(filled(outlineOf(mask)), mask), 0.98);
}

TEST(MaskOutline, EndsSoon_ForNoise) {
  cv::Mat mask(480, 640, CV_8UC1);
  cv::theRNG().state = 7;
  cv::randu(mask, 0, 2);
  mask *= 255;
  EXPECT_GE(outlineOf(mask).size(), 3U);
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
