#include "core/discovery/small_components.h"

#include <opencv2/imgproc.hpp>

namespace scantrove {
namespace {

/// Smaller components are removed; as parts of the mask's pixels.
constexpr double kMinPartOfMask = 0.05;
constexpr double kMinHoleOfMask = 0.02;

/// The connected components of an image's non-zero pixels, numbered from 1.
class Pieces {
 public:
  Pieces(const cv::Mat& image, int connectivity) {
    cv::Mat middles;
    count_ = cv::connectedComponentsWithStats(image, piece_of_, stats_, middles, connectivity, CV_32S) - 1;
  }

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] int pixels(int piece) const { return stats_.at<int>(piece, cv::CC_STAT_AREA); }
  [[nodiscard]] bool touchesEdge(int piece) const {
    const cv::Rect box = boxOf(piece);
    return box.x == 0 || box.y == 0 || box.br().x == piece_of_.cols || box.br().y == piece_of_.rows;
  }
  void paint(int piece, unsigned char value, cv::Mat& image) const {
    const cv::Rect box = boxOf(piece);
    image(box).setTo(value, piece_of_(box) == piece);
  }

 private:
  [[nodiscard]] cv::Rect boxOf(int piece) const {
    const int* stats = stats_.ptr<int>(piece);
    return {stats[cv::CC_STAT_LEFT], stats[cv::CC_STAT_TOP], stats[cv::CC_STAT_WIDTH],
            stats[cv::CC_STAT_HEIGHT]};
  }

  cv::Mat piece_of_, stats_;
  int count_ = 0;
};

}  // namespace

void dropSmallComponents(cv::Mat& mask, cv::Rect& box_px) {
  constexpr int kOverCorners = 8, kOverSides = 4;  // connectivities of OpenCV
  const Pieces parts(mask, kOverCorners);
  if (parts.count() == 0) return;
  int all_px = 0, largest = 1;
  for (int part = 1; part <= parts.count(); ++part) {
    all_px += parts.pixels(part);
    if (parts.pixels(part) > parts.pixels(largest)) largest = part;
  }
  for (int part = 1; part <= parts.count(); ++part) {
    if (part != largest && parts.pixels(part) < kMinPartOfMask * all_px) parts.paint(part, 0, mask);
  }
  const Pieces gaps(mask == 0, kOverSides);
  for (int gap = 1; gap <= gaps.count(); ++gap) {
    // A component that touches the edge is outside, not a hole.
    if (!gaps.touchesEdge(gap) && gaps.pixels(gap) < kMinHoleOfMask * all_px) gaps.paint(gap, 255, mask);
  }
  const cv::Rect left = cv::boundingRect(mask);
  mask = mask(left).clone();
  box_px = left + box_px.tl();
}

}  // namespace scantrove
