#include "core/evaluation/segmentation_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <random>
#include <set>

#include "core/evaluation/boundary_error.h"
#include "core/evaluation/label_grid.h"
#include "core/evaluation/overlap_metrics.h"

namespace scantrove {
namespace {

/// An image divided by a vertical line: label 1 left of column `x`, label 2 from it on.
cv::Mat1i cutAt(int x, int width = 10, int height = 4) {
  cv::Mat1i labels(height, width, 2);
  labels.colRange(0, x) = 1;
  return labels;
}

cv::Mat1i randomBlocks(std::mt19937& random, int width, int height) {
  cv::Mat1i labels(height, width, 0);
  for (int i = 0; i < 8; ++i) {
    const int x = static_cast<int>(random() % static_cast<unsigned>(width));
    const int y = static_cast<int>(random() % static_cast<unsigned>(height));
    const cv::Rect block(x, y, static_cast<int>(random() % 9) + 1, static_cast<int>(random() % 9) + 1);
    labels(block & cv::Rect(0, 0, width, height)) = static_cast<int>(random() % 5);
  }
  return labels;
}

TEST(Boundary, LiesOnTheLeftAndUpperSideOfAChange) {
  const cv::Mat1i labels = (cv::Mat1i(3, 4) << 1, 1, 2, 2, 1, 1, 2, 2, 3, 3, 3, 3);
  const cv::Mat1b expected = (cv::Mat1b(3, 4) << 0, 255, 0, 0, 255, 255, 255, 255, 0, 0, 0, 0);
  EXPECT_EQ(cv::norm(boundaryPixels(labels), expected, cv::NORM_INF), 0);
}

TEST(Boundary, DistanceEqualsBruteForce) {
  std::mt19937 random(11);
  for (int round = 0; round < 5; ++round) {
    const cv::Mat1b boundary = boundaryPixels(randomBlocks(random, 31, 17));
    const cv::Mat1f distance = distanceToBoundary(boundary);
    for (int y = 0; y < boundary.rows; ++y) {
      for (int x = 0; x < boundary.cols; ++x) {
        double nearest = 1e9;
        for (int v = 0; v < boundary.rows; ++v) {
          for (int u = 0; u < boundary.cols; ++u) {
            if (boundary(v, u) != 0) nearest = std::min(nearest, std::hypot(x - u, y - v));
          }
        }
        ASSERT_NEAR(distance(y, x), nearest, 1e-4);  // float against double
      }
    }
  }
}

TEST(Boundary, DistanceIsTheDiagonal_WithoutABoundary) {
  const cv::Mat1f distance = distanceToBoundary(boundaryPixels(cv::Mat1i(3, 4, 7)));
  EXPECT_FLOAT_EQ(distance(0, 0), 5);
  EXPECT_FLOAT_EQ(distance(2, 3), 5);
}

TEST(BoundaryError, IsTheMeanDistance_WhenALineIsShifted) {
  // Boundaries in columns 4 and 6 of 10: |d - d'| is 2 outside, 2 0 2 in columns 4 5 6 -> (9 * 2) / 10.
  const cv::Mat1b all(4, 10, static_cast<unsigned char>(255));
  const double error = boundaryError(boundaryPixels(cutAt(5)), boundaryPixels(cutAt(7)), all);
  EXPECT_NEAR(error, 1.8, 1e-6);
  EXPECT_EQ(boundaryError(boundaryPixels(cutAt(5)), boundaryPixels(cutAt(5)), all), 0);
}

TEST(BoundaryError, IgnoresPixels_WithoutAnnotation) {
  // Truth: 1 in columns 0-4, not annotated beyond; its boundary is column 4. Boundaries of the segments:
  // columns 4 and 8. |d - d'| is 0 in columns 0-4; in 5 ... 9 it would be 0 0 2 4 4.
  cv::Mat1i truth = cutAt(5);
  truth.setTo(0, truth == 2);
  cv::Mat1i segments = cutAt(5);
  segments.colRange(9, 10) = 3;
  const SegmentationMetrics metrics = evaluateSegmentation(segments, truth);
  EXPECT_EQ(metrics.boundary_error, 0);
  EXPECT_EQ(metrics.boundary_precision, 1) << "the boundary in column 8 is not counted";
  EXPECT_EQ(metrics.boundary_recall, 1);
  const SegmentationMetrics all = evaluateSegmentation(segments, cutAt(5));
  EXPECT_NEAR(all.boundary_error, 1.0, 1e-6);
  EXPECT_EQ(all.boundary_precision, 0.5);
  EXPECT_EQ(evaluateSegmentation(segments, cv::Mat1i(4, 10, 0)).boundary_error, 0);
}

TEST(BoundaryError, IgnoresLabelValues) {
  cv::Mat1i renamed = cutAt(5);
  renamed.setTo(77, renamed == 1);
  EXPECT_EQ(evaluateSegmentation(renamed, cutAt(5)).boundary_error, 0);
}

TEST(BoundaryShare, CountsPixelsWithinTheTolerance) {
  const cv::Mat1b at4 = boundaryPixels(cutAt(5));
  EXPECT_EQ(boundaryShareNear(boundaryPixels(cutAt(7)), at4, 2), 1);
  EXPECT_EQ(boundaryShareNear(boundaryPixels(cutAt(8)), at4, 2), 0);
  cv::Mat1i two_cuts = cutAt(5);
  two_cuts.colRange(9, 10) = 3;  // boundary columns 4 and 8
  EXPECT_EQ(boundaryShareNear(boundaryPixels(two_cuts), at4, 2), 0.5);
  const cv::Mat1b none(4, 10, static_cast<unsigned char>(0));
  EXPECT_EQ(boundaryShareNear(none, at4, 2), 1);
  EXPECT_EQ(boundaryShareNear(at4, none, 2), 0);
}

TEST(SegmentationMetrics, ReturnsKnownPrecisionRecallAndF) {
  cv::Mat1i segments = cutAt(5);
  segments.colRange(9, 10) = 3;
  const SegmentationMetrics metrics = evaluateSegmentation(segments, cutAt(5));
  EXPECT_EQ(metrics.boundary_precision, 0.5);
  EXPECT_EQ(metrics.boundary_recall, 1);
  EXPECT_NEAR(metrics.boundary_f, 2.0 / 3, 1e-12);
}

TEST(SegmentationMetrics, ReturnsKnownCoverage) {
  // Instances: 1 in columns 0-3 (16 px), 2 in columns 4-9 (24 px). Segments: 5 in columns 0-4 (20 px), 6 the
  // rest (20 px).
  cv::Mat1i segments = cutAt(5);
  segments += 4;
  const SegmentationMetrics metrics = evaluateSegmentation(segments, cutAt(4));
  const double iou_1 = 16.0 / 20;
  const double iou_2 = 20.0 / 24;
  EXPECT_NEAR(metrics.coverage, (iou_1 + iou_2) / 2, 1e-12);
  EXPECT_NEAR(metrics.coverage_weighted, (16 * iou_1 + 24 * iou_2) / 40, 1e-12);
  EXPECT_EQ(metrics.instances, 2);
  // Segment 5 covers a sixth of instance 2: instance 2 is over-segmented, segment 5 contains two instances.
  EXPECT_EQ(metrics.over_segmented, 1);
  EXPECT_EQ(metrics.under_segmented, 1);
}

TEST(SegmentationMetrics, CountsOverAndUnderSegmentation) {
  cv::Mat1i quarters(4, 10, 1);
  quarters.colRange(3, 6) = 2;
  quarters.colRange(6, 10) = 3;
  EXPECT_EQ(evaluateSegmentation(quarters, cv::Mat1i(4, 10, 1)).over_segmented, 1);
  EXPECT_EQ(evaluateSegmentation(cv::Mat1i(4, 10, 9), cutAt(5)).under_segmented, 1);
  // A leak of less than a tenth counts as neither.
  cv::Mat1i leak(10, 40, 1);
  leak.colRange(20, 40) = 2;
  cv::Mat1i with_leak = leak.clone();
  with_leak(0, 20) = 1;
  EXPECT_EQ(evaluateSegmentation(with_leak, leak).under_segmented, 0);
  EXPECT_EQ(evaluateSegmentation(with_leak, leak).over_segmented, 0);
}

TEST(SegmentationMetrics, IgnoresUnlabeledPixels) {
  cv::Mat1i truth = cutAt(5);
  truth.setTo(0, truth == 2);
  cv::Mat1i segments = cutAt(5);
  segments.setTo(0, segments == 1);
  const SegmentationMetrics metrics = evaluateSegmentation(segments, truth);
  EXPECT_EQ(metrics.instances, 1);
  EXPECT_EQ(metrics.coverage, 0);
  // A segment that leaks into the background has a larger union.
  EXPECT_NEAR(evaluateSegmentation(cv::Mat1i(4, 10, 3), truth).coverage, 0.5, 1e-12);
}

TEST(SegmentationMetrics, IgnoresSmallInstances) {
  cv::Mat1i truth = cutAt(5);
  truth(0, 0) = 9;
  EXPECT_EQ(evaluateSegmentation(cutAt(5), truth).instances, 3);
  EXPECT_EQ(evaluateSegmentation(cutAt(5), truth, {.min_instance_px = 2}).instances, 2);
}

TEST(SegmentationMetrics, CoverageEqualsBruteForceOnRandomImages) {
  std::mt19937 random(23);
  for (int round = 0; round < 20; ++round) {
    const cv::Mat1i truth = randomBlocks(random, 23, 19);
    const cv::Mat1i segments = randomBlocks(random, 23, 19);
    double sum = 0, weighted = 0, area = 0;
    int instances = 0;
    for (int instance = 1; instance < 5; ++instance) {
      const int size = cv::countNonZero(truth == instance);
      if (size == 0) continue;
      double best = 0;
      for (int segment = 1; segment < 5; ++segment) {
        const int both = cv::countNonZero((truth == instance) & (segments == segment));
        const int either = cv::countNonZero((truth == instance) | (segments == segment));
        best = std::max(best, static_cast<double>(both) / either);
      }
      sum += best;
      weighted += best * size;
      area += size;
      ++instances;
    }
    const SegmentationMetrics metrics = evaluateSegmentation(segments, truth);
    ASSERT_EQ(metrics.instances, instances);
    if (instances == 0) continue;
    EXPECT_NEAR(metrics.coverage, sum / instances, 1e-12);
    EXPECT_NEAR(metrics.coverage_weighted, weighted / area, 1e-12);
  }
}

TEST(SegmentationMetrics, SeparatesSmallAndLargeInstances) {
  // 64 x 48 pixels: a hundredth of 640 x 480, so small is 4 - 150 pixels.
  cv::Mat1i truth(48, 64, 0);
  truth(cv::Rect(0, 0, 3, 1)) = 1;     // 3: neither
  truth(cv::Rect(10, 0, 4, 1)) = 2;    // 4: small
  truth(cv::Rect(20, 0, 15, 10)) = 3;  // 150: small
  truth(cv::Rect(0, 20, 20, 10)) = 4;  // 200: large
  cv::Mat1i segments(48, 64, 0);
  segments(cv::Rect(10, 0, 2, 1)) = 5;    // half of 2, not more
  segments(cv::Rect(20, 0, 15, 9)) = 6;   // 135 of 3
  segments(cv::Rect(0, 20, 20, 8)) = 7;   // 160 of 4 ...
  segments(cv::Rect(30, 20, 34, 1)) = 7;  // ... and 34 elsewhere
  const SegmentationMetrics metrics = evaluateSegmentation(segments, truth);
  EXPECT_EQ(metrics.small.instances, 2);
  EXPECT_NEAR(metrics.small.coverage, (0.5 + 0.9) / 2, 1e-12);
  EXPECT_EQ(metrics.small.over_half, 0.5);
  EXPECT_EQ(metrics.large.instances, 1);
  EXPECT_NEAR(metrics.large.coverage, 160.0 / 234, 1e-12);
  EXPECT_EQ(metrics.large.over_half, 1);
}

TEST(SegmentationMetrics, AcceptsSixteenBitImages) {
  cv::Mat segments, truth;
  cutAt(4).convertTo(segments, CV_16UC1);
  cutAt(5).convertTo(truth, CV_8UC1);
  EXPECT_EQ(evaluateSegmentation(segments, truth).instances, 2);
}

TEST(Averaged, SumsCountsAndIgnoresImages_WithoutInstances) {
  SegmentationMetrics a, b;
  a.boundary_error = 2;
  a.coverage = 0.8;
  a.instances = 3;
  a.over_segmented = 1;
  b.boundary_error = 4;
  a.small = {3, 0.5, 1.0};
  b.small = {1, 0.9, 0.0};
  const SegmentationMetrics mean = averaged({a, b});
  EXPECT_EQ(mean.boundary_error, 3);
  EXPECT_EQ(mean.coverage, 0.8);
  EXPECT_EQ(mean.instances, 3);
  EXPECT_EQ(mean.over_segmented, 1);
  EXPECT_EQ(mean.small.instances, 4);
  EXPECT_NEAR(mean.small.coverage, (3 * 0.5 + 0.9) / 4, 1e-12);
  EXPECT_NEAR(mean.small.over_half, 0.75, 1e-12);
  EXPECT_EQ(mean.large.instances, 0);
  EXPECT_EQ(averaged({}).instances, 0);
}

}  // namespace
}  // namespace scantrove
