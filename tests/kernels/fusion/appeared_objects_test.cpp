// Newly appeared objects at rest, as opposed to passing ones.
#include "core/fusion/appeared_objects.h"

#include <gtest/gtest.h>

#include <set>

namespace scantrove::test {
namespace {

constexpr int kWidth = 160, kHeight = 120;
constexpr float kTable_m = 1.5F, kObject_m = 1.3F;
const Intrinsics kCamera{130, 130, 80, 60, kWidth, kHeight};
const cv::Rect kMug(60, 50, 20, 24);

/// A table from above, with objects on it.
DepthView viewWith(const std::vector<cv::Rect>& objects) {
  DepthView view{kCamera, Eigen::Isometry3d::Identity(), cv::Mat(kHeight, kWidth, CV_32FC1)};
  view.z_m.setTo(kTable_m);
  for (const cv::Rect& object : objects) view.z_m(object).setTo(kObject_m);
  return view;
}

cv::Mat maskOf(const std::vector<cv::Rect>& objects, int beyond_px) {
  cv::Mat mask = cv::Mat::zeros(kHeight, kWidth, CV_8UC1);
  for (const cv::Rect& object : objects)
    mask(object + cv::Size(2 * beyond_px, 2 * beyond_px) - cv::Point(beyond_px, beyond_px)).setTo(255);
  return mask;
}

/// Adds frames that show all `objects`; `moving`, a part of them, is masked as moving.
void show(AppearedObjects& appeared_objects, const std::vector<cv::Rect>& objects,
          const std::vector<cv::Rect>& moving, int frames) {
  // The mask covers a little of the table.
  const cv::Mat mask = moving.empty() ? cv::Mat() : maskOf(moving, 2);
  for (int i = 0; i < frames; ++i) appeared_objects.add(viewWith(objects), mask, maskOf(moving, 0));
}

std::set<int> numbersIn(const cv::Mat& objects, const cv::Rect& where) {
  std::set<int> numbers;
  for (int v = where.y; v < where.br().y; ++v) {
    for (int u = where.x; u < where.br().x; ++u) numbers.insert(objects.at<std::uint8_t>(v, u));
  }
  return numbers;
}

TEST(AppearedObjects, FindsOneObject_OnceItIsAtRest) {
  AppearedObjects appeared_objects;
  show(appeared_objects, {kMug}, {kMug}, 25);
  EXPECT_TRUE(appeared_objects.atRest(viewWith({kMug}), maskOf({kMug}, 0)).empty());
  show(appeared_objects, {kMug}, {}, 1);
  const cv::Mat objects = appeared_objects.atRest(viewWith({kMug}), {});
  ASSERT_EQ(objects.size(), cv::Size(kWidth, kHeight));
  EXPECT_EQ(numbersIn(objects, kMug), std::set<int>{1});
  EXPECT_EQ(cv::countNonZero(objects), kMug.area());
}

TEST(AppearedObjects, FindsNothing_AfterAnObjectPasses) {
  AppearedObjects appeared_objects;
  for (int x = 10; x < 130; x += 2) {
    const cv::Rect at(x, 40, 12, 40);
    show(appeared_objects, {at}, {at}, 1);
  }
  // Another object stands there later.
  EXPECT_TRUE(appeared_objects.atRest(viewWith({kMug}), {}).empty());
}

TEST(AppearedObjects, FindsTwoObjects_WhenTheyAppearAtDifferentTimes) {
  AppearedObjects appeared_objects;
  const cv::Rect beside(kMug.br().x, kMug.y, 20, kMug.height);
  show(appeared_objects, {kMug}, {kMug}, 25);
  show(appeared_objects, {kMug}, {}, 10);
  show(appeared_objects, {kMug, beside}, {beside}, 25);
  show(appeared_objects, {kMug, beside}, {}, 1);
  const cv::Mat objects = appeared_objects.atRest(viewWith({kMug, beside}), {});
  ASSERT_FALSE(objects.empty());
  // Cells may cross the border, so pixels near it are not checked.
  const std::set<int> first = numbersIn(objects, {kMug.x, kMug.y, kMug.width - 4, kMug.height});
  const std::set<int> second = numbersIn(objects, {beside.x + 4, beside.y, beside.width - 4, beside.height});
  ASSERT_EQ(first.size(), 1U);
  ASSERT_EQ(second.size(), 1U);
  EXPECT_NE(*first.begin(), *second.begin());
  EXPECT_FALSE(first.contains(0) || second.contains(0));
}

TEST(AppearedObjects, ForgetsAnObject_AfterSomeSeconds) {
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
