#include "core/synthetic/color_exposure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace scantrove::synthetic {
namespace {

constexpr float kUnseen = std::numeric_limits<float>::infinity();
constexpr float kNothing_m = 100;  // depth of pixels without a surface

/// Where the pixels of a later image come from.
struct Origins {
  cv::Mat z;      ///< CV_32FC1 metres, infinite where no surface point arrives
  cv::Mat moved;  ///< CV_32FC2 pixels, from the later image back to the earlier
};

Origins originsOf(const RenderedFrame& now, const Intrinsics& K, const PartMotions& motions) {
  const cv::Size size = now.z_m.size();
  Origins origins{cv::Mat(size, CV_32FC1, cv::Scalar(kUnseen)), cv::Mat::zeros(size, CV_32FC2)};
  for (int v = 0; v < size.height; ++v) {
    const std::int32_t* part = now.parts.ptr<std::int32_t>(v);
    const float* z = now.z_m.ptr<float>(v);
    for (int u = 0; u < size.width; ++u) {
      const bool is_surface = part[u] >= 0;
      const Eigen::Isometry3f& motion =
          is_surface ? motions[static_cast<std::size_t>(part[u])] : motions.back();
      const Eigen::Vector3f p = motion * K.backProject(static_cast<float>(u), static_cast<float>(v),
                                                       is_surface ? z[u] : kNothing_m);
      if (!(p.z() > 0)) continue;
      const float to_u = K.fx * p.x() / p.z() + K.cx;
      const float to_v = K.fy * p.y() / p.z() + K.cy;
      if (!(to_u > -0.5F && to_v > -0.5F && to_u < static_cast<float>(size.width) - 0.5F &&
            to_v < static_cast<float>(size.height) - 0.5F)) {
        continue;
      }
      const cv::Point to(static_cast<int>(std::lround(to_u)), static_cast<int>(std::lround(to_v)));
      float& nearest = origins.z.at<float>(to);
      if (p.z() >= nearest) continue;
      nearest = p.z();
      origins.moved.at<cv::Vec2f>(to) = {static_cast<float>(u) - to_u, static_cast<float>(v) - to_v};
    }
  }
  return origins;
}

/// Gaps of a row move as the farther of their two neighbours.
void fillGaps(Origins& origins) {
  const int width = origins.z.cols;
  for (int v = 0; v < origins.z.rows; ++v) {
    const float* z = origins.z.ptr<float>(v);
    cv::Vec2f* moved = origins.moved.ptr<cv::Vec2f>(v);
    for (int first = 0; first < width; ++first) {
      if (z[first] != kUnseen) continue;
      int end = first;
      while (end < width && z[end] == kUnseen) ++end;
      const bool has_left = first > 0;
      const bool has_right = end < width;
      if (has_left || has_right) {
        const bool is_right = !has_left || (has_right && z[end] > z[first - 1]);
        std::fill(moved + first, moved + end, moved[is_right ? end : first - 1]);
      }
      first = end;
    }
  }
}

cv::Mat colorAt(const RenderedFrame& now, const Intrinsics& K, const PartMotions& motions) {
  Origins origins = originsOf(now, K, motions);
  fillGaps(origins);
  for (int v = 0; v < origins.moved.rows; ++v) {
    cv::Vec2f* from = origins.moved.ptr<cv::Vec2f>(v);
    for (int u = 0; u < origins.moved.cols; ++u)
      from[u] += cv::Vec2f(static_cast<float>(u), static_cast<float>(v));
  }
  cv::Mat color;
  cv::remap(now.color, color, origins.moved, {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return color;
}

}  // namespace

cv::Mat exposeColor(const RenderedFrame& now, const Intrinsics& K, std::span<const PartMotions> moments) {
  cv::Mat sum = cv::Mat::zeros(now.color.size(), CV_32FC3);
  for (const PartMotions& motions : moments) {
    cv::Mat color = colorAt(now, K, motions);
    if (moments.size() == 1) return color;
    cv::add(sum, color, sum, {}, CV_32F);
  }
  cv::Mat mean;
  sum.convertTo(mean, CV_8U, 1.0 / static_cast<double>(moments.size()));
  return mean;
}

}  // namespace scantrove::synthetic
