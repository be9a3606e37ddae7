#include "core/evaluation/boundary_error.h"

#include <opencv2/core.hpp>

#include "core/base/check.h"
#include "core/evaluation/label_grid.h"

namespace scantrove {

double boundaryError(const cv::Mat1b& segmentation_boundary, const cv::Mat1b& truth_boundary,
                     const cv::Mat1b& counted) {
  SCANTROVE_CHECK(segmentation_boundary.size() == truth_boundary.size());
  SCANTROVE_CHECK(counted.size() == truth_boundary.size());
  const int pixels = counted.empty() ? 0 : cv::countNonZero(counted);
  if (pixels == 0) return 0;
  return cv::norm(distanceToBoundary(truth_boundary), distanceToBoundary(segmentation_boundary), cv::NORM_L1,
                  counted) /
         pixels;
}

double boundaryShareNear(const cv::Mat1b& boundary, const cv::Mat1b& reference, double tolerance_px) {
  SCANTROVE_CHECK(boundary.size() == reference.size());
  const int all = cv::countNonZero(boundary);
  if (all == 0) return 1;
  if (cv::countNonZero(reference) == 0) return 0;
  const cv::Mat1f distance = distanceToBoundary(reference);
  cv::Mat1b found;
  cv::bitwise_and(boundary, distance <= tolerance_px, found);
  return static_cast<double>(cv::countNonZero(found)) / all;
}

}  // namespace scantrove
