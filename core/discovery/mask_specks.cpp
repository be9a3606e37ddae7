#include "core/discovery/mask_specks.h"

#include <opencv2/imgproc.hpp>

namespace scantrove {
namespace {

/// Of all pixels of the mask.
constexpr double kSpeck = 0.05;
constexpr double kPinhole = 0.02;

/// Sets what is connected in `of` and smaller than `least_px`. Of a hole that the edge of the image may go on
/// beyond nothing is known.
void setSmall(const cv::Mat& of, int connectivity, double least_px, bool off_edge, unsigned char value,
              cv::Mat& mask) {
  cv::Mat labels, stats, centroids;
  const int count = cv::connectedComponentsWithStats(of, labels, stats, centroids, connectivity, CV_32S);
  for (int label = 1; label < count; ++label) {
    const int* stat = stats.ptr<int>(label);
    const cv::Rect box(stat[cv::CC_STAT_LEFT], stat[cv::CC_STAT_TOP], stat[cv::CC_STAT_WIDTH],
                       stat[cv::CC_STAT_HEIGHT]);
    if (stat[cv::CC_STAT_AREA] >= least_px) continue;
    if (off_edge && (box.x == 0 || box.y == 0 || box.br().x == of.cols || box.br().y == of.rows)) continue;
    mask(box).setTo(value, labels(box) == label);
  }
}

}  // namespace

void dropSpecks(cv::Mat& mask, cv::Rect& box_px) {
  const int all_px = cv::countNonZero(mask);
  if (all_px == 0) return;
  constexpr int kOverCorners = 8, kOverSides = 4;
  setSmall(mask.clone(), kOverCorners, kSpeck * all_px, false, 0, mask);
  setSmall(mask == 0, kOverSides, kPinhole * all_px, true, 255, mask);
  const cv::Rect left = cv::boundingRect(mask);
  if (left.empty()) return;
  mask = mask(left).clone();
  box_px = left + box_px.tl();
}

}  // namespace scantrove
