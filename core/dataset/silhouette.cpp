#include "core/dataset/silhouette.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/texturing/depth_raster.h"

namespace scantrove {

cv::Mat Silhouette::mask(cv::Size image) const {
  cv::Mat mask = cv::Mat::zeros(image, CV_8UC1);
  const cv::Rect seen = box & cv::Rect({}, image);
  if (!empty() && !seen.empty()) {
    const cv::Mat part = depth_m(seen - box.tl()) > 0;
    part.copyTo(mask(seen));
  }
  return mask;
}

cv::Rect Silhouette::tightBox() const {
  if (empty()) return {};
  const cv::Rect within = boxOf(depth_m > 0);
  return within + box.tl();
}

Silhouette silhouetteOf(const LabeledMesh& mesh, const Intrinsics& K,
                        const Eigen::Isometry3d& T_world_camera) {
  const Eigen::Isometry3f T = T_world_camera.inverse().cast<float>();
  std::vector<Eigen::Vector3f> points;
  points.reserve(mesh.vertices.size());
  float left = 1e9F, right = -1e9F, top = 1e9F, bottom = -1e9F;
  for (const SurfacePoint& vertex : mesh.vertices) {
    const Eigen::Vector3f& p = points.emplace_back(T * vertex.position_world_m);
    if (!(p.z() > 0.01F)) continue;
    const float u = K.fx * p.x() / p.z() + K.cx, v = K.fy * p.y() / p.z() + K.cy;
    left = std::min(left, u), right = std::max(right, u);
    top = std::min(top, v), bottom = std::max(bottom, v);
  }
  Silhouette seen;
  const auto begin = [](float low, int size) {
    return static_cast<int>(
        std::floor(std::clamp(low, static_cast<float>(-size), static_cast<float>(2 * size))));
  };
  const auto end = [&](float high, int size) { return begin(high, size) + 2; };
  if (left > right) return seen;
  const cv::Rect around(cv::Point(begin(left, K.width), begin(top, K.height)),
                        cv::Point(end(right, K.width), end(bottom, K.height)));
  const cv::Rect looked_at(-K.width, -K.height, 3 * K.width, 3 * K.height);
  seen.box = around & looked_at;
  if (seen.box.empty()) return seen;
  Intrinsics window = K;
  window.cx -= static_cast<float>(seen.box.x);
  window.cy -= static_cast<float>(seen.box.y);
  window.width = seen.box.width;
  window.height = seen.box.height;
  DepthRaster raster(window);
  for (const auto& face : mesh.faces) raster.add(points[face[0]], points[face[1]], points[face[2]]);
  seen.depth_m = raster.depth();
  seen.pixels = cv::countNonZero(seen.depth_m);
  return seen;
}

cv::Rect boxOf(const cv::Mat& mask) {
  cv::Mat points;
  cv::findNonZero(mask, points);
  return points.empty() ? cv::Rect() : cv::boundingRect(points);
}

}  // namespace scantrove
