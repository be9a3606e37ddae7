#include "core/dataset/registered_depth.h"

#include <array>
#include <cmath>

#include "core/base/check.h"
#include "core/texturing/depth_raster.h"

namespace scantrove {
namespace {

/// Neighbouring pixels of one surface differ by less than this fraction of their depth. Steep surfaces at a
/// few metres change less per pixel, and edges of objects of a few centimetres more.
constexpr float kSameSurface = 0.03F;

/// The depth of `z`'s surface at a corner of its pixel: the mean of those of the four pixels there that
/// continue it. Pixels of a smooth surface share corners, without gaps between them.
float cornerDepth(const cv::Mat& depth_m, int x, int y, float z) {
  float sum = 0;
  int count = 0;
  for (int v = y; v <= y + 1; ++v) {
    for (int u = x; u <= x + 1; ++u) {
      if (u < 0 || v < 0 || u >= depth_m.cols || v >= depth_m.rows) continue;
      const float other = depth_m.at<float>(v, u);
      if (!(other > 0) || std::abs(other - z) > kSameSurface * z) continue;
      sum += other;
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<float>(count) : z;
}

bool isOneCamera(const KeyFrameInfo& frame) {
  return frame.K_color == frame.K_depth && frame.T_color_depth.isApprox(Eigen::Isometry3d::Identity(), 1e-9);
}

}  // namespace

cv::Mat registerDepth(const KeyFrameInfo& frame, const cv::Mat& depth) {
  const Intrinsics& K = frame.K_depth;
  SCANTROVE_CHECK(depth.type() == CV_16UC1 && depth.cols == K.width && depth.rows == K.height);
  cv::Mat depth_m;
  depth.convertTo(depth_m, CV_32F, frame.meters_per_unit);
  if (isOneCamera(frame)) return depth_m;
  const Eigen::Isometry3f T = frame.T_color_depth.cast<float>();
  DepthRaster raster(frame.K_color);
  for (int y = 0; y < K.height; ++y) {
    for (int x = 0; x < K.width; ++x) {
      const float z = depth_m.at<float>(y, x);
      if (!(z > 0)) continue;
      std::array<Eigen::Vector3f, 4> corners;
      for (int i = 0; i < 4; ++i) {
        const int right = i % 2, below = i / 2;
        const float corner_z = cornerDepth(depth_m, x - 1 + right, y - 1 + below, z);
        corners[static_cast<std::size_t>(i)] =
            T * K.backProject(static_cast<float>(x + right) - 0.5F, static_cast<float>(y + below) - 0.5F,
                              corner_z);
      }
      raster.add(corners[0], corners[1], corners[2]);
      raster.add(corners[1], corners[3], corners[2]);
    }
  }
  return raster.depth();
}

}  // namespace scantrove
