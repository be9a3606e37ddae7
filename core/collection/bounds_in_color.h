#pragma once
#include <algorithm>
#include <limits>
#include <opencv2/core/types.hpp>

namespace scantrove {

/// The rectangle around some depth pixels, in the colour image.
class BoundsInColor {
 public:
  /// Adds a pixel; `place` is its entry of SurfaceInColor::places.
  void add(const cv::Vec2f& place) {
    first_ = {std::min(first_.x, place[0]), std::min(first_.y, place[1])};
    last_ = {std::max(last_.x, place[0]), std::max(last_.y, place[1])};
  }
  void add(const BoundsInColor& other) {
    first_ = {std::min(first_.x, other.first_.x), std::min(first_.y, other.first_.y)};
    last_ = {std::max(last_.x, other.last_.x), std::max(last_.y, other.last_.y)};
  }
  /// The rectangle in fractions of the colour image, widened to whole pixels of a `depth`-sized image.
  /// Requires an add().
  [[nodiscard]] cv::Rect2f box(const cv::Size& depth) const {
    const cv::Point2f half_pixel(0.5F / static_cast<float>(depth.width),
                                 0.5F / static_cast<float>(depth.height));
    return {first_ - half_pixel, last_ + half_pixel};
  }

 private:
  static constexpr float kFar = std::numeric_limits<float>::max();
  cv::Point2f first_{kFar, kFar}, last_{-kFar, -kFar};
};

}  // namespace scantrove
