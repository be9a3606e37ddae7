#include "core/dataset/color_outlines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <random>

namespace scantrove::test {
namespace {

constexpr int kTableTop = 1, kMug = 5, kBook = 6;
const cv::Size kImage(260, 200);
const std::map<int, cv::Vec3f> kColors{
    {kTableTop, {90, 120, 150}}, {kMug, {60, 60, 200}}, {kBook, {190, 110, 60}}};
const cv::Point2d kCenter(130.3, 90.6);
constexpr double kRadius = 45;

using Painter = std::function<int(int x, int y)>;

cv::Mat painted(const Painter& region_at) {
  cv::Mat regions(kImage, CV_32SC1);
  for (int y = 0; y < regions.rows; ++y) {
    for (int x = 0; x < regions.cols; ++x) regions.at<int>(y, x) = region_at(x, y);
  }
  return regions;
}

double distanceTo(const cv::Point2d& center, int x, int y) { return std::hypot(x - center.x, y - center.y); }

int diskAt(int x, int y) { return distanceTo(kCenter, x, y) < kRadius ? kMug : kTableTop; }

// A mug from above: the disk with a ring as its handle, 4.4 pixels thick.
const cv::Point2d kHandleCenter(178, 90);
bool isHandle(int x, int y) {
  return std::abs(distanceTo(kHandleCenter, x, y) - 16) < 2.2 && distanceTo(kCenter, x, y) >= kRadius;
}
bool isHandleHole(int x, int y) {
  return distanceTo(kHandleCenter, x, y) < 12 && distanceTo(kCenter, x, y) > kRadius + 3;
}
int mugAt(int x, int y) { return isHandle(x, y) ? kMug : diskAt(x, y); }

/// The regions as the map shows them: in steps of voxels and a few pixels off.
cv::Mat projected(const Painter& region_at, int voxel_px, const cv::Point& shift) {
  return painted([&](int x, int y) {
    const auto middle = [&](int at) {
      return static_cast<int>(std::floor(static_cast<double>(at) / voxel_px)) * voxel_px + voxel_px / 2;
    };
    return region_at(middle(x - shift.x), middle(y - shift.y));
  });
}

/// A camera's image of the regions, with its noise.
cv::Mat noisyImageOf(const cv::Mat& regions, const std::map<int, cv::Vec3f>& colors) {
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0, 3);
  cv::Mat image(regions.size(), CV_8UC3);
  for (int y = 0; y < regions.rows; ++y) {
    for (int x = 0; x < regions.cols; ++x) {
      for (int i = 0; i < 3; ++i)
        image.at<cv::Vec3b>(y, x)[i] =
            cv::saturate_cast<std::uint8_t>(colors.at(regions.at<int>(y, x))[i] + noise(random));
    }
  }
  return image;
}

/// One metre away, with depth everywhere.
cv::Mat followed(const cv::Mat& regions, const cv::Mat& image) {
  return followColorEdges(
      regions, {image, cv::Mat(kImage, CV_32FC1, cv::Scalar::all(1)), cv::Mat::zeros(kImage, CV_8UC1), 525});
}

int countOf(const std::function<bool(int x, int y)>& is_counted) {
  int count = 0;
  for (int y = 0; y < kImage.height; ++y) {
    for (int x = 0; x < kImage.width; ++x) count += is_counted(x, y) ? 1 : 0;
  }
  return count;
}

TEST(FollowColorEdges, FindsTheOutlineWithinAPixel_WhenTheMapIsCoarseAndShifted) {
  const cv::Mat exact = painted(diskAt);
  const cv::Mat map = projected(diskAt, 4, {2, -1});
  const cv::Mat result = followed(map, noisyImageOf(exact, kColors));
  const auto beyondOnePixel = [&](const cv::Mat& regions) {
    return countOf([&](int x, int y) {
      return regions.at<int>(y, x) != exact.at<int>(y, x) &&
             std::abs(distanceTo(kCenter, x, y) - kRadius) > 1;
    });
  };
  ASSERT_GT(beyondOnePixel(map), 100);
  EXPECT_LE(beyondOnePixel(result), 3);
}

TEST(FollowColorEdges, ChangesNothing_WhenBothSidesHaveOneColor) {
  const std::map<int, cv::Vec3f> one_color{{kTableTop, kColors.at(kTableTop)}, {kMug, kColors.at(kTableTop)}};
  for (const Painter& object : {Painter(diskAt), Painter(mugAt)}) {
    const cv::Mat map = projected(object, 4, {2, -1});
    cv::Mat image = noisyImageOf(painted(object), one_color);
    EXPECT_EQ(cv::countNonZero(followed(map, image) != map), 0);
    for (int x = 0; x < image.cols; ++x)
      image.col(x) -= cv::Scalar::all(60.0 * x / image.cols);  // in a shade
    EXPECT_EQ(cv::countNonZero(followed(map, image) != map), 0) << "shaded";
  }
}

TEST(FollowColorEdges, LeavesNeitherOverlapNorGap_BetweenTouchingRegions) {
  const auto twoAt = [](int x, int y) {
    if (y < 60 || y >= 140 || x < 60 || x >= 200) return kTableTop;
    return x < 130 ? kMug : kBook;
  };
  const cv::Mat exact = painted(twoAt);
  const cv::Mat map = projected(twoAt, 4, {3, 2});
  const cv::Mat result = followed(map, noisyImageOf(exact, kColors));
  const cv::Mat inner = result(cv::Rect(64, 64, 132, 72));
  EXPECT_EQ(cv::countNonZero((inner != kMug) & (inner != kBook)), 0) << "a gap";
  ASSERT_GT(cv::countNonZero(map != exact), 800);
  EXPECT_LE(cv::countNonZero(result != exact), 40);
}

TEST(FollowColorEdges, KeepsAThinHandleAndItsHole) {
  const cv::Mat exact = painted(mugAt);
  for (const auto& [voxel_px, shift] : {std::pair(4, cv::Point(2, -1)), std::pair(6, cv::Point(1, 1))}) {
    const cv::Mat result = followed(projected(mugAt, voxel_px, shift), noisyImageOf(exact, kColors));
    const auto isMug = [&](int x, int y) { return result.at<int>(y, x) == kMug; };
    const int handle = countOf(isHandle), hole = countOf(isHandleHole);
    ASSERT_GT(handle, 200);
    ASSERT_GT(hole, 150);
    EXPECT_GE(countOf([&](int x, int y) { return isHandle(x, y) && isMug(x, y); }), 0.85 * handle)
        << voxel_px;
    EXPECT_LE(countOf([&](int x, int y) { return isHandleHole(x, y) && isMug(x, y); }), 0.05 * hole)
        << voxel_px;
  }
}

TEST(FollowColorEdges, ReachesFartherWhereDepthIsMissing) {
  // Five pixels of the table to the left of the disk have its region, as in the shadow of a depth camera.
  const auto grownAt = [](int x, int y) {
    return x < 95 && distanceTo(kCenter, x, y) < kRadius + 5 ? kMug : diskAt(x, y);
  };
  const cv::Mat exact = painted(diskAt), map = painted(grownAt);
  const cv::Mat image = noisyImageOf(exact, kColors);
  cv::Mat unmeasured = cv::Mat::zeros(kImage, CV_8UC1);
  unmeasured.colRange(60, 95) = 255;
  const cv::Mat result =
      followColorEdges(map, {image, cv::Mat(kImage, CV_32FC1, cv::Scalar::all(1)), unmeasured, 525});
  ASSERT_GT(cv::countNonZero(map != exact), 250);
  EXPECT_LT(cv::countNonZero(result != exact), 60);
}

TEST(FollowColorEdges, KeepsAllRegions_InAnImageOfAFewPixels) {
  const cv::Mat regions = (cv::Mat_<int>(1, 3) << 4, 4, 0);
  const cv::Mat image(1, 3, CV_8UC3, cv::Scalar(10, 20, 30));
  const cv::Mat result =
      followColorEdges(regions, {image, cv::Mat::zeros(1, 3, CV_32FC1), cv::Mat::zeros(1, 3, CV_8UC1), 500});
  EXPECT_EQ(cv::countNonZero(result != regions), 0);
}

}  // namespace
}  // namespace scantrove::test
