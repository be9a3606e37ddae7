#include "core/texturing/depth_raster.h"

#include <algorithm>
#include <cmath>

namespace scantrove {
namespace {

constexpr float kNearPlane_m = 0.01F;
/// Pixels on an edge between two triangles belong to both; this tolerance keeps rounding from losing them.
constexpr float kEdgeSlack = 1e-4F;

/// A corner in the image, and 1 / depth, which is linear in the image.
struct Corner {
  float u, v, inverse;
};

float doubledArea(const Corner& a, const Corner& b, float u, float v) {
  return (b.u - a.u) * (v - a.v) - (b.v - a.v) * (u - a.u);
}

}  // namespace

DepthRaster::DepthRaster(const Intrinsics& K)
    : K_(K), depth_m_(cv::Mat::zeros(K.height, K.width, CV_32FC1)) {}

void DepthRaster::add(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
  if (!(std::min({a.z(), b.z(), c.z()}) > kNearPlane_m)) return;
  const auto project = [&](const Eigen::Vector3f& p) {
    const float inverse = 1 / p.z();
    return Corner{K_.fx * p.x() * inverse + K_.cx, K_.fy * p.y() * inverse + K_.cy, inverse};
  };
  const Corner A = project(a), B = project(b), C = project(c);
  const float area = doubledArea(A, B, C.u, C.v);
  if (!std::isfinite(area) || area == 0) return;
  const auto clamped = [](float value, int limit) {
    return static_cast<int>(std::clamp(value, -1.0F, static_cast<float>(limit)));
  };
  const int left = std::max(0, clamped(std::ceil(std::min({A.u, B.u, C.u})), K_.width));
  const int right = std::min(K_.width - 1, clamped(std::floor(std::max({A.u, B.u, C.u})), K_.width));
  const int top = std::max(0, clamped(std::ceil(std::min({A.v, B.v, C.v})), K_.height));
  const int bottom = std::min(K_.height - 1, clamped(std::floor(std::max({A.v, B.v, C.v})), K_.height));
  const float per_area = 1 / area;
  for (int y = top; y <= bottom; ++y) {
    auto* row = depth_m_.ptr<float>(y);
    for (int x = left; x <= right; ++x) {
      const auto u = static_cast<float>(x), v = static_cast<float>(y);
      const float wa = doubledArea(B, C, u, v) * per_area, wb = doubledArea(C, A, u, v) * per_area;
      const float wc = 1 - wa - wb;
      if (wa < -kEdgeSlack || wb < -kEdgeSlack || wc < -kEdgeSlack) continue;
      const float z = 1 / (wa * A.inverse + wb * B.inverse + wc * C.inverse);
      if (row[x] == 0 || z < row[x]) row[x] = z;
    }
  }
}

}  // namespace scantrove
