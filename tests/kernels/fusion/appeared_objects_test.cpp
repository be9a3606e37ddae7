// What has come into the scene and rests there, told from what passes by.
#include "core/fusion/appeared_objects.h"

#include <gtest/gtest.h>

#include <set>

namespace scantrove::test {
namespace {

constexpr int kWidth = 160, kHeight = 120;
constexpr float kTable_m = 1.5F, kThing_m = 1.3F;
const Intrinsics kCamera{130, 130, 80, 60, kWidth, kHeight};
const cv::Rect kMug(60, 50, 20, 24);

/// A table seen from above, with things on it.
DepthView viewWith(const std::vector<cv::Rect>& things) {
  DepthView view{kCamera, Eigen::Isometry3d::Identity(), cv::Mat(kHeight, kWidth, CV_32FC1)};
  view.z_m.setTo(kTable_m);
  for (const cv::Rect& thing : things) view.z_m(thing).setTo(kThing_m);
  return view;
}

cv::Mat maskOf(const std::vector<cv::Rect>& things, int beyond_px) {
  cv::Mat mask = cv::Mat::zeros(kHeight, kWidth, CV_8UC1);
  for (const cv::Rect& thing : things)
    mask(thing + cv::Size(2 * beyond_px, 2 * beyond_px) - cv::Point(beyond_px, beyond_px)).setTo(255);
  return mask;
}

/// Frames in which all of `things` are there and `moving` (which are among them) are held to move.
void show(AppearedObjects& appeared_objects, const std::vector<cv::Rect>& things,
          const std::vector<cv::Rect>& moving, int frames) {
  // The mask covers a little of the table.
  const cv::Mat mask = moving.empty() ? cv::Mat() : maskOf(moving, 2);
  for (int i = 0; i < frames; ++i) appeared_objects.add(viewWith(things), mask, maskOf(moving, 0));
}

std::set<int> numbersIn(const cv::Mat& things, const cv::Rect& where) {
  std::set<int> numbers;
  for (int v = where.y; v < where.br().y; ++v) {
    for (int u = where.x; u < where.br().x; ++u) numbers.insert(things.at<std::uint8_t>(v, u));
  }
  return numbers;
}

TEST(AppearedObjects, WhatComesToRestIsOneThingAndTheTableIsNot) {
  AppearedObjects appeared_objects;
  show(appeared_objects, {kMug}, {kMug}, 25);
  EXPECT_TRUE(appeared_objects.atRest(viewWith({kMug}), maskOf({kMug}, 0)).empty());
  show(appeared_objects, {kMug}, {}, 1);
  const cv::Mat things = appeared_objects.atRest(viewWith({kMug}), {});
  ASSERT_EQ(things.size(), cv::Size(kWidth, kHeight));
  EXPECT_EQ(numbersIn(things, kMug), std::set<int>{1});
  EXPECT_EQ(cv::countNonZero(things), kMug.area());
}

TEST(AppearedObjects, WhatPassesByLeavesNothing) {
  AppearedObjects appeared_objects;
  for (int x = 10; x < 130; x += 2) {
    const cv::Rect at(x, 40, 12, 40);
    show(appeared_objects, {at}, {at}, 1);
  }
  // Something stands there later.
  EXPECT_TRUE(appeared_objects.atRest(viewWith({kMug}), {}).empty());
}

TEST(AppearedObjects, ThingsThatCameAtDifferentTimesAreTwo) {
  AppearedObjects appeared_objects;
  const cv::Rect beside(kMug.br().x, kMug.y, 20, kMug.height);
  show(appeared_objects, {kMug}, {kMug}, 25);
  show(appeared_objects, {kMug}, {}, 10);
  show(appeared_objects, {kMug, beside}, {beside}, 25);
  show(appeared_objects, {kMug, beside}, {}, 1);
  const cv::Mat things = appeared_objects.atRest(viewWith({kMug, beside}), {});
  ASSERT_FALSE(things.empty());
  // A cell may reach over the border: that is left open.
  const std::set<int> first = numbersIn(things, {kMug.x, kMug.y, kMug.width - 4, kMug.height});
  const std::set<int> second = numbersIn(things, {beside.x + 4, beside.y, beside.width - 4, beside.height});
  ASSERT_EQ(first.size(), 1U);
  ASSERT_EQ(second.size(), 1U);
  EXPECT_NE(*first.begin(), *second.begin());
  EXPECT_FALSE(first.contains(0) || second.contains(0));
}

TEST(AppearedObjects, AfterSomeSecondsItIsForgotten) {
  AppearedObjects appeared_objects;
  show(appeared_objects, {kMug}, {kMug}, 25);
  show(appeared_objects, {kMug}, {}, 100);
  EXPECT_FALSE(appeared_objects.atRest(viewWith({kMug}), {}).empty());
  EXPECT_FALSE(appeared_objects.memory().cells.empty());
  show(appeared_objects, {kMug}, {}, 100);
  EXPECT_TRUE(appeared_objects.atRest(viewWith({kMug}), {}).empty());
  EXPECT_TRUE(appeared_objects.memory().cells.empty());
}

}  // namespace
}  // namespace scantrove::test
