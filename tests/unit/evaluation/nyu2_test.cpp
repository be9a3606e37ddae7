// Error 4.1 on labels of NYUv2, the table and the curve.
#include "core/evaluation/nyu2.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "core/evaluation/nyu2_figure.h"

namespace scantrove {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(NyuInstances, NumberEachPairOfClassAndInstance) {
  const cv::Mat1w labels = (cv::Mat1w(2, 4) << 0, 7, 7, 7, 3, 3, 0, 7);
  const cv::Mat1w instances = (cv::Mat1w(2, 4) << 9, 1, 2, 1, 1, 0, 1, 0);
  const cv::Mat1i expected = (cv::Mat1i(2, 4) << 0, 4, 5, 4, 2, 1, 0, 3);
  EXPECT_EQ(cv::norm(nyuInstances(labels, instances), expected, cv::NORM_INF), 0);
}

/// Eq. 4.1 from its text: distance of each pixel to the nearest boundary pixel, by comparing it with all.
double errorByFormula(const cv::Mat1i& segmentation, const cv::Mat1i& truth, bool annotated_only) {
  const auto distances = [](const cv::Mat1i& labels) {
    std::vector<cv::Point> boundary;
    for (int y = 0; y < labels.rows; ++y) {
      for (int x = 0; x < labels.cols; ++x) {
        const bool right = x + 1 < labels.cols && labels(y, x) != labels(y, x + 1);
        const bool below = y + 1 < labels.rows && labels(y, x) != labels(y + 1, x);
        if (right || below) boundary.emplace_back(x, y);
      }
    }
    cv::Mat1d distance(labels.size(), 1e9);
    for (int y = 0; y < labels.rows; ++y) {
      for (int x = 0; x < labels.cols; ++x) {
        for (const cv::Point& p : boundary)
          distance(y, x) = std::min(distance(y, x), std::hypot(p.x - x, p.y - y));
      }
    }
    return distance;
  };
  const cv::Mat1d d_truth = distances(truth), d_segmentation = distances(segmentation);
  double sum = 0, pixels = 0;
  for (int y = 0; y < truth.rows; ++y) {
    for (int x = 0; x < truth.cols; ++x) {
      if (annotated_only && truth(y, x) == 0) continue;
      sum += std::abs(d_truth(y, x) - d_segmentation(y, x));
      ++pixels;
    }
  }
  return sum / pixels;
}

TEST(Nyu2Error, FollowsEquation41_OverAllAndOverAnnotatedPixels) {
  cv::Mat1i truth(20, 30, 1), segmentation(20, 30, 4);
  truth(cv::Rect(10, 5, 9, 8)) = 2;
  truth(cv::Rect(0, 0, 30, 3)) = 0;
  segmentation(cv::Rect(13, 4, 9, 11)) = 6;
  segmentation(cv::Rect(2, 14, 5, 5)) = 9;
  const Nyu2Error error = nyu2Error(segmentation, truth);
  EXPECT_NEAR(error.all, errorByFormula(segmentation, truth, false), 1e-4);
  EXPECT_NEAR(error.annotated, errorByFormula(segmentation, truth, true), 1e-4);
  EXPECT_GT(std::abs(error.all - error.annotated), 0.01) << "the example tells both apart";
}

TEST(Nyu2Error, IsZero_WhenBoundariesAreEqual) {
  cv::Mat1i truth(10, 10, 1);
  truth.colRange(4, 10) = 2;
  cv::Mat1i segmentation(10, 10, 8);
  segmentation.colRange(4, 10) = 5;
  EXPECT_EQ(nyu2Error(segmentation, truth).all, 0);
}

Nyu2Outcome outcome(double single, double merged, bool is_lost = false) {
  return {{single, single + 1}, {merged, merged + 1}, is_lost};
}

TEST(Nyu2Curve, AveragesOverImages_ThatHaveEveryLength) {
  const std::vector<Nyu2Image> images{{{1, outcome(20, 19)}, {8, outcome(18, 16)}},
                                      {{1, outcome(22, 21)}, {8, outcome(22, 22, true)}},
                                      {{1, outcome(90, 90)}}};
  const std::vector<int> lengths{1, 8};
  const std::vector<Nyu2Point> curve = nyu2Curve(images, lengths);
  ASSERT_EQ(curve.size(), 2U);
  EXPECT_EQ(curve[1].frames, 8);
  EXPECT_EQ(curve[1].images, 2);
  EXPECT_EQ(curve[1].lost, 1);
  EXPECT_DOUBLE_EQ(curve[0].single.all, 21);
  EXPECT_DOUBLE_EQ(curve[1].merged.all, 19);
  EXPECT_DOUBLE_EQ(curve[1].merged.annotated, 20);
  EXPECT_THAT(nyu2Curve({}, lengths), IsEmpty());
}

TEST(Nyu2Table, ComparesSingleFramesWithEightMergedOnes) {
  const std::vector<Nyu2Image> images{{{1, outcome(20, 19)}, {8, outcome(18, 16)}}};
  const std::vector<int> lengths{1, 8};
  const std::string table = nyu2Table(nyu2Curve(images, lengths));
  EXPECT_THAT(table, HasSubstr("single frame                           19.37   20.00"));
  EXPECT_THAT(table, HasSubstr("temporal, 8 frames                     17.54   16.00"));
  EXPECT_THAT(table, HasSubstr("0.91    0.80"));
  const std::vector<int> short_lengths{1};
  EXPECT_EQ(nyu2Table(nyu2Curve(images, short_lengths)), "");
}

TEST(Nyu2Csv, HasALineForEachLength) {
  const std::vector<Nyu2Image> images{{{1, outcome(20, 19)}, {8, outcome(18, 16, true)}}};
  const std::vector<int> lengths{1, 8};
  EXPECT_EQ(nyu2Csv(nyu2Curve(images, lengths)),
            "frames,images,lost,merged_error,single_error,merged_error_annotated,single_error_annotated\n"
            "1,1,0,19.0000,20.0000,20.0000,21.0000\n"
            "8,1,1,16.0000,18.0000,17.0000,19.0000\n");
}

TEST(DrawNyu2Curve, PutsThePointsWhereTheAxesSay) {
  const std::vector<Nyu2Image> images{
      {{1, outcome(19.4, 19)}, {8, outcome(18.9, 17.5)}, {20, outcome(18.8, 17)}}};
  const std::vector<int> lengths{1, 8, 20};
  const auto curve = nyu2Curve(images, lengths);
  const Nyu2Axes axes = nyu2Axes(curve);
  EXPECT_LE(axes.low, 17);
  EXPECT_GE(axes.high, 19.4);
  EXPECT_LT(axes.high - axes.low, 4) << "the curve fills the picture";
  EXPECT_LT(axes.at(8, 17).x, axes.at(20, 17).x);
  EXPECT_GT(axes.at(8, 17).y, axes.at(8, 19).y) << "larger errors are higher";
  const cv::Mat picture = drawNyu2Curve(curve);
  ASSERT_EQ(picture.type(), CV_8UC3);
  EXPECT_EQ(picture.size(), cv::Size(960, 640));
  const cv::Vec3b merged = picture.at<cv::Vec3b>(axes.at(8, 17.5)),
                  single = picture.at<cv::Vec3b>(axes.at(8, 18.9));
  EXPECT_GT(merged[0], merged[2]) << "blue";
  EXPECT_LT(single[0], single[2]) << "orange";
}

TEST(DrawNyu2Curve, DrawsASinglePoint) {
  const std::vector<Nyu2Image> images{{{1, outcome(0, 0)}}};
  const std::vector<int> lengths{1};
  EXPECT_FALSE(drawNyu2Curve(nyu2Curve(images, lengths)).empty());
}

}  // namespace
}  // namespace scantrove
